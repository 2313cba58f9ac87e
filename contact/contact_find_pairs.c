/* Broad phase: which nodes may meet which triangles and which edges which before two nodes can have come nearer by the
 * skin. */
#include <math.h>
#include <string.h>

#include "contact/contact_grid.h"
#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "contact/contact_sides.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* Edges whose triangles are turned by less than this (1.8 degrees) are left to the nodes. */
#define SHARP_COSINE 0.9995

void contact_fill_planes(ContactRun *run, const double *x, int first, int end, bool all)
{
    const ContactInterface *c = run->contact;
    for (int t = first; t < end; t++) {
        double *plane = run->plane + 4 * (ptrdiff_t)t, a[3], b[3], n[3];
        if (!all && !run->used[t]) continue;
        const double *corner = x + 3 * (ptrdiff_t)c->triangle[3 * t];
        vector3_subtract(x + 3 * (ptrdiff_t)c->triangle[3 * t + 1], corner, a);
        vector3_subtract(x + 3 * (ptrdiff_t)c->triangle[3 * t + 2], corner, b);
        vector3_cross(a, b, n);
        double square = vector3_dot(n, n), inverse = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
        for (int k = 0; k < 3; k++) plane[k] = n[k] * inverse;
        /* a triangle without area is nowhere near */
        plane[3] = square > 0.0 ? vector3_dot(plane, corner) : 1e300;
    }
}

/* Triangles whose three neighbours lie nearly in their plane: what is close behind them is hidden by them. */
static void mark_calm(ContactRun *run)
{
    const ContactInterface *c = run->contact;
    for (int t = 0; t < c->triangle_count; t++) {
        run->calm[t] = 1;
        for (int k = 0; k < 3 && run->calm[t]; k++) {
            int other = c->neighbour[3 * t + k];
            run->calm[t] =
                other >= 0 && vector3_dot(run->plane + 4 * (ptrdiff_t)t, run->plane + 4 * (ptrdiff_t)other) > 0.9;
        }
    }
}

static inline double plane_height(const double *plane, const double *x)
{
    return plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] - plane[3];
}

/* Does the foot of x on the triangle's plane lie within it? */
static bool foot_inside(const ContactRun *run, const double *positions, int t, const double *x)
{
    const int32_t *corner = run->contact->triangle + 3 * (ptrdiff_t)t;
    const double *n = run->plane + 4 * (ptrdiff_t)t;
    for (int k = 0; k < 3; k++) {
        const double *p = positions + 3 * (ptrdiff_t)corner[k], *q = positions + 3 * (ptrdiff_t)corner[(k + 1) % 3];
        double e[3], r[3], w[3];
        vector3_subtract(q, p, e);
        vector3_subtract(x, p, r);
        vector3_cross(e, r, w);
        if (vector3_dot(w, n) < 0.0) return false;
    }
    return true;
}

/* A layer that a node would have to meet first. */
typedef struct Cover {
    const double *plane;
    double height; /* of the node over it */
} Cover;

/* The nearest calm triangle under the node on each side of the direction of the first such one. */
static int find_covers(const ContactRun *run, const double *positions, const double *x, const int32_t *found, int count,
                       const double *height, Cover cover[2])
{
    int covers = 0;
    for (int side = 0; side < 2; side++) {
        int best = -1;
        double least = INFINITY;
        for (int k = 0; k < count; k++) {
            double h = height[k];
            const double *plane = run->plane + 4 * (ptrdiff_t)found[k];
            if (!run->calm[found[k]] || !(fabs(h) < least) || h == 0.0) continue;
            /* the other side: where the way to the layer leads the other way */
            if (side == 1 && covers == 1 && vector3_dot(plane, cover[0].plane) * h * cover[0].height > 0.0) continue;
            if (!foot_inside(run, positions, found[k], x)) continue;
            least = fabs(h);
            best = k;
        }
        if (best < 0) break;
        cover[covers++] = (Cover){run->plane + 4 * (ptrdiff_t)found[best], height[best]};
    }
    return covers;
}

/* Is this triangle, nearly parallel to a cover, behind it as seen from the node? */
static bool is_hidden(const Cover *cover, int covers, const double *plane, double height, double margin)
{
    for (int i = 0; i < covers; i++) {
        double alike = vector3_dot(plane, cover[i].plane);
        if (fabs(alike) < 0.9 || alike * height * cover[i].height < 0.0) continue;
        if (fabs(height) > fabs(cover[i].height) + margin) return true;
    }
    return false;
}

/* Nodes that are behind a surface they should not pass see all layers: the State keeps which, for a restart. */
static void mark_deep(const ContactRun *run, unsigned char *deep)
{
    const ContactMemory *m = run->faces.memory;
    memset(deep, 0, (size_t)run->contact->node_count);
    for (int i = 0; i < run->contact->node_count; i++)
        for (int k = 0; k < CONTACT_SLOTS; k++, m++)
            if (m->side && m->gap < 0.0) deep[i] = 1;
}

/* Candidates of one node out of the triangles found near it. */
static int choose_faces(const ContactLoop *loop, const ContactRun *run, ContactPart *part, int i, int found,
                        double skin)
{
    const ContactInterface *c = run->contact;
    const double *positions = loop->state->contact_searched, *x = positions + 3 * (ptrdiff_t)c->node[i];
    int32_t *near = part->found.item;
    int count = 0, covers = 0, kept = 0;
    Cover cover[2];
    if (memory_reserve((void **)&part->height, &part->height_capacity, (size_t)found + 1, sizeof *part->height))
        return -1;
    for (int k = 0; k < found; k++) {
        int t = near[k];
        double h = plane_height(run->plane + 4 * (ptrdiff_t)t, x);
        if (fabs(h) > c->node_radius[i] + c->triangle_radius[t] + skin || !contact_node_meets(loop->model, c, i, t))
            continue;
        near[count] = t;
        part->height[count++] = h;
    }
    if (!loop->state->contact_sharp[c->first_deep + (size_t)i])
        covers = find_covers(run, positions, x, near, count, part->height, cover);
    for (int k = 0; k < count; k++) {
        double margin = 0.5 * (c->node_radius[i] + c->triangle_radius[near[k]]);
        if (!is_hidden(cover, covers, run->plane + 4 * (ptrdiff_t)near[k], part->height[k], margin))
            near[kept++] = near[k];
    }
    contact_sort(near, kept);
    for (int k = 0; k < kept; k++)
        if (contact_part_add(part, near[k])) return -1;
    return 0;
}

/* Boxes and planes of a thread's share of the triangles. */
static void box_faces(ContactLoop *loop, ContactRun *run, int thread, int threads)
{
    const ContactInterface *c = run->contact;
    const double *x = loop->state->contact_searched;
    double widest = 0.0, skin = loop->state->contact->skin;
    int first = contact_first_of(c->triangle_count, thread, threads),
        end = contact_first_of(c->triangle_count, thread + 1, threads);
    for (int i = 0; i < c->node_count; i++) widest = c->node_radius[i] > widest ? c->node_radius[i] : widest;
    for (int t = first; t < end; t++) {
        ContactBox *box = &loop->box[t];
        for (int k = 0; k < 3; k++)
            (k ? contact_box_add : contact_box_start)(box, x + 3 * (ptrdiff_t)c->triangle[3 * t + k]);
        contact_box_grow(box, c->triangle_radius[t] + widest + skin);
    }
    contact_fill_planes(run, x, first, end, true);
}

static void find_faces(ContactLoop *loop, ContactRun *run, int thread, int threads)
{
    const ContactInterface *c = run->contact;
    ContactPart *part = &loop->parts[thread];
    part->count = 0;
    part->failed = false;
    for (int i = contact_first_of(c->node_count, thread, threads);
         i < contact_first_of(c->node_count, thread + 1, threads); i++) {
        ContactBox point;
        run->faces.pairs.start[i] = (int32_t)part->count;
        contact_box_start(&point, loop->state->contact_searched + 3 * (ptrdiff_t)c->node[i]);
        int found = contact_grid_query(&loop->grid, &point, &part->found);
        if (found < 0 || choose_faces(loop, run, part, i, found, loop->state->contact->skin)) {
            part->failed = true;
            return;
        }
    }
}

/* Triangles that are candidates: their planes are kept up to date. */
static void mark_used(ContactRun *run)
{
    const ContactPairs *pairs = &run->faces.pairs;
    memset(run->used, 0, (size_t)run->contact->triangle_count);
    for (size_t k = 0; k < pairs->count; k++) run->used[pairs->other[k]] = 1;
}

/* A free edge, a branch, or an edge at which the surface is turned. Planes are those at the search. */
static bool is_sharp(const ContactRun *run, int e)
{
    const ContactInterface *c = run->contact;
    int32_t t = c->edge_triangle[2 * e], u = c->edge_triangle[2 * e + 1];
    return u < 0 || vector3_dot(run->plane + 4 * (ptrdiff_t)t, run->plane + 4 * (ptrdiff_t)u) < SHARP_COSINE;
}

static bool edges_meet(const ContactLoop *loop, const ContactInterface *c, int e, int f)
{
    const int32_t *a = c->edge + 2 * (ptrdiff_t)e, *b = c->edge + 2 * (ptrdiff_t)f;
    const double *inverse = loop->model->contact_inverse;
    if (!contact_sides_meet(c->edge_side[e], c->edge_side[f])) return false;
    if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return false;
    int32_t t = c->edge_triangle[2 * e], u = c->edge_triangle[2 * f];
    if (c->triangle_body[t] != -1 && c->triangle_body[t] == c->triangle_body[u]) return false;
    if (c->triangle_shell[t] >= 0 && c->triangle_shell[t] == c->triangle_shell[u]) return false;
    return inverse[a[0]] > 0.0 || inverse[a[1]] > 0.0 || inverse[b[0]] > 0.0 || inverse[b[1]] > 0.0;
}

/* Edges that are sharp now, or in contact and were so before; the State keeps them for a restart. */
static void mark_sharp(const ContactRun *run, unsigned char *sharp)
{
    const ContactInterface *c = run->contact;
    const ContactPairs *pairs = &run->edges.pairs;
    for (int e = 0; e < c->edge_count; e++) sharp[e] = is_sharp(run, e);
    for (int e = 0; pairs->start && e < c->edge_count; e++)
        for (int32_t k = pairs->start[e]; k < pairs->start[e + 1]; k++)
            if (pairs->slot[k]) sharp[e] = sharp[pairs->other[k]] = 1;
}

static void box_edges(const ContactInterface *c, const double *x, double skin, const unsigned char *sharp,
                      ContactBox *box)
{
    for (int e = 0; e < c->edge_count; e++) {
        box[e] = (ContactBox){{1, 1, 1}, {0, 0, 0}};
        if (!sharp[e]) continue;
        contact_box_start(&box[e], x + 3 * (ptrdiff_t)c->edge[2 * e]);
        contact_box_add(&box[e], x + 3 * (ptrdiff_t)c->edge[2 * e + 1]);
        contact_box_grow(&box[e], c->edge_radius[e] + 0.5 * skin);
    }
}

/* Is every point of the edge p-q farther than reach from one side of a plane? */
static bool is_beyond(const double *plane, const double *p, const double *q, double reach)
{
    double a = plane_height(plane, p), b = plane_height(plane, q);
    return (a > reach && b > reach) || (a < -reach && b < -reach);
}

/* Too far for the skin: each edge lies in the plane of its triangle. */
static bool edges_apart(const ContactRun *run, const double *x, int e, int f, double skin)
{
    const ContactInterface *c = run->contact;
    const int32_t *a = c->edge + 2 * (ptrdiff_t)e, *b = c->edge + 2 * (ptrdiff_t)f;
    double reach = c->edge_radius[e] + c->edge_radius[f] + skin;
    return is_beyond(run->plane + 4 * (ptrdiff_t)c->edge_triangle[2 * e], x + 3 * (ptrdiff_t)b[0],
                     x + 3 * (ptrdiff_t)b[1], reach) ||
           is_beyond(run->plane + 4 * (ptrdiff_t)c->edge_triangle[2 * f], x + 3 * (ptrdiff_t)a[0],
                     x + 3 * (ptrdiff_t)a[1], reach);
}

static void find_edges(ContactLoop *loop, ContactRun *run, int thread, int threads)
{
    const ContactInterface *c = run->contact;
    const double *x = loop->state->contact_searched, skin = loop->state->contact->skin;
    ContactPart *part = &loop->parts[thread];
    part->count = 0;
    part->failed = false;
    for (int e = contact_first_of(c->edge_count, thread, threads);
         e < contact_first_of(c->edge_count, thread + 1, threads); e++) {
        int kept = 0, found = 0;
        run->edges.pairs.start[e] = (int32_t)part->count;
        if (loop->box[e].low[0] > loop->box[e].high[0]) continue;
        found = contact_grid_query(&loop->grid, &loop->box[e], &part->found);
        int32_t *near = part->found.item;
        for (int k = 0; k < found; k++)
            if (near[k] > e && !edges_apart(run, x, e, near[k], skin) && edges_meet(loop, c, e, near[k]))
                near[kept++] = near[k];
        contact_sort(near, kept);
        part->failed = found < 0;
        for (int k = 0; k < kept && !part->failed; k++) part->failed = contact_part_add(part, near[k]);
        if (part->failed) return;
    }
}

static void wait_for(Team *team)
{
    if (team) team_barrier(team);
}

static int begin_faces(ContactLoop *loop, ContactRun *run)
{
    const ContactInterface *c = run->contact;
    if (!loop->restored) mark_deep(run, loop->state->contact_sharp + c->first_deep);
    mark_calm(run);
    return contact_grid_fill(&loop->grid, loop->box, c->triangle_count) || contact_pairs_begin(&run->faces);
}

static int end_faces(ContactLoop *loop, ContactRun *run, int threads)
{
    if (contact_pairs_join(loop, &run->faces, threads) || contact_pairs_end(&run->faces)) return -1;
    mark_used(run);
    return 0;
}

static int begin_edges(ContactLoop *loop, ContactRun *run)
{
    const ContactInterface *c = run->contact;
    unsigned char *sharp = loop->state->contact_sharp + c->first_edge;
    if (!loop->restored) mark_sharp(run, sharp);
    box_edges(c, loop->state->contact_searched, loop->state->contact->skin, sharp, loop->box);
    return contact_grid_fill(&loop->grid, loop->box, c->edge_count) || contact_pairs_begin(&run->edges);
}

static int end_edges(ContactLoop *loop, ContactRun *run, int threads)
{
    return contact_pairs_join(loop, &run->edges, threads) || contact_pairs_end(&run->edges);
}

/* One contact; all threads of the team, which part the work between barriers. */
static void find_pairs(ContactLoop *loop, ContactRun *run, int thread, Team *team)
{
    int threads = team ? team_size(team) : 1;
    const ContactInterface *c = run->contact;
    size_t boxes = (size_t)(c->triangle_count > c->edge_count ? c->triangle_count : c->edge_count);
    if (thread == 0 && memory_reserve((void **)&loop->box, &loop->box_capacity, boxes + 1, sizeof *loop->box))
        loop->out_of_memory = true;
    wait_for(team);
    if (loop->out_of_memory) return;
    box_faces(loop, run, thread, threads);
    wait_for(team);
    if (thread == 0 && begin_faces(loop, run)) loop->out_of_memory = true;
    wait_for(team);
    if (loop->out_of_memory) return;
    find_faces(loop, run, thread, threads);
    wait_for(team);
    if (thread == 0 && (end_faces(loop, run, threads) || (c->edge_count > 0 && begin_edges(loop, run))))
        loop->out_of_memory = true;
    if (c->edge_count == 0) return;
    wait_for(team);
    if (loop->out_of_memory) return;
    find_edges(loop, run, thread, threads);
    wait_for(team);
    if (thread == 0 && end_edges(loop, run, threads)) loop->out_of_memory = true;
}

void contact_find_pairs(ContactLoop *loop, int thread, Team *team)
{
    for (int i = 0; i < loop->model->contact_count; i++) find_pairs(loop, &loop->runs[i], thread, team);
    wait_for(team);
    for (int i = 0; thread == 0 && loop->out_of_memory && i < loop->model->contact_count; i++) {
        loop->runs[i].alive = false;
        contact_pairs_forget(&loop->runs[i].faces);
        contact_pairs_forget(&loop->runs[i].edges);
    }
}
