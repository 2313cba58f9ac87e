/* Nodes against triangles: the closest point of each candidate, which of them count, on which side the node is, and
 * what it is pushed by. */
#include "contact/contact_geometry.h"
#include "contact/contact_push.h"
#include "contact/contact_sides.h"
#include "solver/memory.h"

enum { MOST_NEAR = 32 }; /* triangles near one node that are looked at in one cycle */

/* One candidate of a node that is near or in contact. */
typedef struct NearFace {
    ClosestPoint at;
    ContactMemory *memory;  /* NULL: none */
    const MeetFaces *block; /* where it has been found */
    int lane;
    int32_t triangle;
    int32_t on[2]; /* corners that hold the closest point, of an edge both, else the first of them twice */
    bool rim;      /* the closest point is on the surface's rim */
    bool kept;
    bool counts; /* it has a memory, or may touch in this step */
} NearFace;

static bool has_corner(const NearFace *f, int32_t node)
{
    return (f->at.corner[0] == node) | (f->at.corner[1] == node) | (f->at.corner[2] == node);
}

/* Does triangle g have all the corners on which f's closest point lies? f's is not inside. */
static bool shares_feature(const NearFace *f, const NearFace *g)
{
    return has_corner(g, f->on[0]) & has_corner(g, f->on[1]);
}

/* Corners that hold the closest point, by feature. */
static void note_corners(NearFace *f)
{
    static const unsigned char first[8] = {0, 0, 1, 0, 2, 0, 1, 0}, second[8] = {0, 0, 1, 1, 2, 2, 2, 0};
    f->on[0] = f->at.corner[first[f->at.feature]];
    f->on[1] = f->at.corner[second[f->at.feature]];
}

/* Of triangles that share the edge or corner closest to the node, the nearest counts; if they are equally far, the one
 * that faces the node most. */
static bool is_nearer(const NearFace *g, const NearFace *f, bool first)
{
    if (g->at.distance < f->at.distance * (1.0 - 1e-9)) return true;
    if (g->at.distance > f->at.distance * (1.0 + 1e-9)) return false;
    if (g->at.feature == 7) return true;
    double a = fabs(g->at.height), b = fabs(f->at.height);
    return a > b || (a == b && first);
}

static bool is_nearest(const NearFace *near, int count, int i)
{
    for (int j = 0; j < count && near[i].at.feature != 7; j++)
        if (j != i && shares_feature(&near[i], &near[j]) && is_nearer(&near[j], &near[i], j < i)) return false;
    return true;
}

static bool touch_each_other(const NearFace *f, const NearFace *g)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (f->at.corner[i] == g->at.corner[j]) return true;
    return false;
}

/* A node that has slid from one triangle onto the next keeps what it remembers. */
static void inherit(NearFace *near, int count, int heir)
{
    for (int i = 0; i < count; i++) {
        if (near[i].kept || !near[i].memory || !touch_each_other(&near[i], &near[heir])) continue;
        near[heir].memory = near[i].memory;
        near[heir].memory->pair[1] = near[heir].triangle;
        near[i].memory = NULL;
        return;
    }
}

/* Which of the near ones are kept, as far as they count; and all, where one with a memory is not and may leave it to
 * another. */
static void keep_nearest(NearFace *near, int count)
{
    bool leaves = false;
    for (int i = 0; i < count; i++) {
        near[i].kept = near[i].counts && is_nearest(near, count, i);
        leaves = leaves || (near[i].memory && !near[i].kept);
    }
    if (!leaves) return;
    for (int i = 0; i < count; i++) near[i].kept = near[i].kept || (!near[i].counts && is_nearest(near, count, i));
    for (int i = 0; i < count; i++)
        if (near[i].kept && !near[i].memory) inherit(near, count, i);
}

/* Normal at corner p of a triangle, whose others are q and r. */
static void corner_normal(const double *x, int32_t p, int32_t q, int32_t r, double u[3], double w[3], double n[3])
{
    vector3_subtract(x + 3 * (ptrdiff_t)q, x + 3 * (ptrdiff_t)p, u);
    vector3_subtract(x + 3 * (ptrdiff_t)r, x + 3 * (ptrdiff_t)p, w);
    vector3_cross(u, w, n);
}

/* Adds the normals of the triangles at a node, of length sine of the angle over the sides. */
static void add_fan(const ContactRun *run, const double *x, int32_t node, double sum[3])
{
    const ContactInterface *c = run->contact;
    for (int32_t k = c->fan_start[node]; k < c->fan_start[node + 1]; k++) {
        const int32_t *next = run->ring + 2 * (ptrdiff_t)k;
        double u[3], w[3], n[3];
        corner_normal(x, node, next[0], next[1], u, w, n);
        if (!(vector3_dot(n, n) > 0.0)) continue;
        double scale = 1.0 / (vector3_dot(u, u) * vector3_dot(w, w));
        for (int i = 0; i < 3; i++) sum[i] += scale * n[i];
    }
}

/* Adds the unit normal of a triangle. */
static void add_triangle(const ContactRun *run, const double *x, int t, double sum[3])
{
    const int32_t *corner = run->triangle[t].corner;
    double u[3], w[3], n[3];
    corner_normal(x, corner[0], corner[1], corner[2], u, w, n);
    double square = vector3_dot(n, n);
    if (!(square > 0.0)) return;
    double scale = 1.0 / sqrt(square);
    for (int i = 0; i < 3; i++) sum[i] += scale * n[i];
}

/* Which side of the surface the node is on, seen from the edge or corner closest to it: that of the mean normal of the
 * triangles there, which no fold however sharp turns over (eq. C1a). 0: on it. */
static int side_of_feature(const ContactRun *run, const double *x, const NearFace *f, double n[3])
{
    n[0] = n[1] = n[2] = 0.0;
    int corners = 0, place = 0;
    for (int k = 0; k < 3; k++) {
        corners += f->at.feature >> k & 1;
        if (f->at.feature >> k & 1) place = k;
    }
    if (corners == 1) {
        add_fan(run, x, f->at.corner[place], n);
    } else {
        int other = run->triangle[f->triangle].neighbour[f->at.feature == 3 ? 2 : f->at.feature == 5 ? 1 : 0];
        add_triangle(run, x, f->triangle, n);
        if (other >= 0) add_triangle(run, x, other, n);
    }
    vector3_normalize(n);
    double height = vector3_dot(n, f->at.toward);
    return (height > 0.0) - (height < 0.0);
}

/* Gap and direction by the side remembered, or found: that of a step ago, as far as the relative velocity tells. False
 * if the pair is none: it has gone round a rim, or its side is not known yet. */
static bool take_side(const ContactLaw *law, const ContactRun *run, const double *x, NearFace *f, int known,
                      ContactTouch *t)
{
    bool inside = f->at.feature == 7 || f->at.distance == 0.0;
    double mean[3];
    int now = inside ? (f->at.height > 0.0) - (f->at.height < 0.0) : side_of_feature(run, x, f, mean);
    const double *normal = inside ? f->at.normal : mean;
    double height = inside ? f->at.height : vector3_dot(mean, f->at.toward);
    double before = height - law->before * vector3_dot(t->speed, normal);
    t->side = known ? known : f->rim ? now : before > 0.0 ? 1 : before < 0.0 ? -1 : now;
    if (t->side == 0) return false;
    if (inside) {
        t->gap = t->side * f->at.height;
        for (int k = 0; k < 3; k++) t->direction[k] = t->side * f->at.normal[k];
        return true;
    }
    if (f->rim && known && now != known && now != 0) return false;
    if (f->rim || now == t->side || now == 0) {
        t->gap = f->at.distance;
        for (int k = 0; k < 3; k++) t->direction[k] = f->at.toward[k] / f->at.distance;
    } else { /* behind: r / |r| would turn over where the node comes through */
        t->gap = t->side * vector3_dot(mean, f->at.toward);
        for (int k = 0; k < 3; k++) t->direction[k] = t->side * mean[k];
    }
    return true;
}

/* Of the candidates [first, end) of node i those that are near. What it has no memory of it may meet
 * (contact/near_kernels.c). */
static int look_around(const ContactLoop *loop, const ContactRun *run, int i, const ContactPart *part, int first,
                       int end, NearFace *near)
{
    bool moves = loop->node[run->contact->node[i]].inverse > 0.0;
    int count = 0;
    for (int place = first; place < end; place++) {
        const MeetFaces *block = &part->faces[place / MEET_LANES];
        int l = place % MEET_LANES;
        ContactMemory *m = block->memory[l];
        if (block->near >> l & 1 && count < MOST_NEAR - 1) {
            NearFace *f = &near[count];
            f->memory = m;
            f->block = block;
            f->lane = l;
            f->triangle = part->other[place];
            for (int k = 0; k < 3; k++) f->at.corner[k] = block->nodes.node[k + 1][l];
            f->at.height = block->height[l];
            f->at.distance = block->distance[l];
            f->at.feature = (int)block->feature[l];
            note_corners(f);
            f->counts = m || block->touch >> l & 1;
            count += m || moves || run->triangle[f->triangle].moves;
        } else if (m) {
            *m = (ContactMemory){0};
        }
    }
    return count;
}

/* Does the closest point lie on the surface's rim? An edge between two corners of the rim may be none of it. */
static bool is_on_rim(const ContactTriangle *t, const NearFace *f)
{
    if (f->at.feature == 7) return false;
    for (int k = 0; k < 3; k++) {
        if (f->at.feature == 1 << k) return t->rims >> k & 1;
        if (f->at.feature == (7 & ~(1 << k))) return t->neighbour[k] < 0;
    }
    return false;
}

/* One near triangle: the node's pair with it is to be pushed. */
static void add_face(const ContactLoop *loop, const ContactRun *run, const ContactLaw *law, int i, NearFace *f,
                     ContactPart *part)
{
    const ContactInterface *c = run->contact;
    ContactMemory *m = f->memory;
    ContactTouch t = {.node = {c->node[i], f->at.corner[0], f->at.corner[1], f->at.corner[2]},
                      .weight = {1.0},
                      .thickness = f->block->thickness[f->lane],
                      .stiffness = c->stiffness[c->node_side[i] == CONTACT_SIDE_B]};
    for (int k = 0; k < 3; k++) {
        t.weight[k + 1] = -f->block->weight[k][f->lane];
        t.speed[k] = f->block->speed[k][f->lane];
        f->at.normal[k] = f->block->normal[k][f->lane];
        f->at.toward[k] = f->block->toward[k][f->lane];
    }
    f->rim = is_on_rim(&run->triangle[f->triangle], f);
    if (!f->kept || !take_side(law, run, loop->state->x, f, m ? m->side : 0, &t)) {
        if (m) *m = (ContactMemory){0};
        return;
    }
    contact_push_add(loop, part, &t, m, i, f->triangle);
}

/* One node with what is near it or in contact with it. */
static void meet_node(const ContactLoop *loop, ContactRun *run, const ContactLaw *law, int i, ContactPart *part,
                      int first, int end)
{
    NearFace near[MOST_NEAR];
    int count = look_around(loop, run, i, part, first, end, near);
    run->faces.depth[i] = 0.0;
    keep_nearest(near, count);
    for (int k = 0; k < count; k++)
        if (near[k].memory || (near[k].kept && near[k].counts)) add_face(loop, run, law, i, &near[k], part);
}

/* Takes the forces of the group's pairs, and what they remember. */
static void take_pushed(ContactRun *run, const ContactPart *part, ContactSums *sums, ContactForce *forces)
{
    for (int place = 0; place < part->push_count; place++) {
        const PushPairs *block = &part->push[place / PUSH_LANES];
        const int l = place % PUSH_LANES, i = block->owner[l];
        ContactForce *out = &forces[sums->count];
        bool counts = contact_push_take(&run->faces, block, l, sums, out);
        if (block->keep >> l & 1 && -block->gap[l] > run->faces.depth[i]) run->faces.depth[i] = -(float)block->gap[l];
        double sign = run->contact->node_side[i] & CONTACT_SIDE_A ? 1.0 : -1.0;
        for (int a = 0; a < 3 && counts; a++) sums->force[a] += sign * out->force[a];
    }
}

/* No node of the group has anything near it. */
static void forget_depths(ContactList *list, const ContactLanes *lanes)
{
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) list->depth[lanes->item[k]] = 0.0;
}

/* Candidates before its turn that a triangle is asked for. */
enum { ASK_AHEAD = 12 };

/* Puts the others of node i into lanes of blocks from place on; left: others of it and of the nodes after it. */
static void add_others(const ContactRun *run, int i, const int32_t *other, int count, int left, MeetFaces *faces,
                       int place)
{
    const ContactInterface *c = run->contact;
    double depth = run->faces.depth[i]; /* behind a surface: the next triangle may be as far away */
    for (int k = 0; k < count; k++, place++) {
        MeetFaces *block = &faces[place / MEET_LANES];
        const int l = place % MEET_LANES;
        const ContactTriangle *t = &run->triangle[other[k]];
        if (k + ASK_AHEAD < left) __builtin_prefetch(&run->triangle[other[k + ASK_AHEAD]]);
        ContactMemory *m = contact_ask(&run->faces, i, other[k]);
        block->nodes.node[0][l] = c->node[i];
        for (int a = 0; a < 3; a++) block->nodes.node[a + 1][l] = t->corner[a];
        block->memory[l] = m;
        block->thickness[l] = run->thinness * (c->node_radius[i] + run->radius[t->radius]);
        block->depth[l] = depth;
        block->remembered[l] = m ? contact_deepest(c) : 0.0;
    }
}

/* Closest points of all candidates of a group, in lanes of the thread's blocks. -1 without memory. */
static int find_closest(const ContactLoop *loop, const ContactRun *run, const ContactLanes *lanes, ContactPart *part,
                        const int start[CONTACT_GROUP + 1])
{
    const MeetStep step = {.x = loop->state->x, .v = loop->state->v, .longer = loop->step.longer};
    int count = start[CONTACT_GROUP], blocks = (count + MEET_LANES - 1) / MEET_LANES;
    if (memory_reserve((void **)&part->faces, &part->faces_capacity, (size_t)blocks, sizeof *part->faces)) return -1;
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++)
        add_others(run, lanes->item[k], part->other + start[k], start[k + 1] - start[k], count - start[k], part->faces,
                   start[k]);
    for (int place = count; place < blocks * MEET_LANES; place++)
        for (int a = 0; a < 4; a++)
            part->faces[place / MEET_LANES].nodes.node[a][place % MEET_LANES] = run->contact->node[lanes->item[0]];
    loop->meet_kernels->faces(&step, part->faces, blocks);
    return 0;
}

void contact_meet_faces(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int group, int thread, int turn)
{
    ContactList *list = &run->faces;
    ContactPart *part = &loop->parts[thread];
    ContactSums *sums = &list->sums[group];
    const ContactLanes *lanes = &run->nodes.lanes[group];
    int start[CONTACT_GROUP + 1];
    *sums = (ContactSums){0};
    list->pieces[group] = (ContactPiece){.thread = thread, .first = (int32_t)part->force_count};
    contact_find_near(loop, run, false, group, thread, turn, start);
    list->deepest[group] = 0.0;
    if (part->failed) return;
    if (start[CONTACT_GROUP] == 0) {
        forget_depths(list, lanes);
        return;
    }
    if (find_closest(loop, run, lanes, part, start)) {
        part->failed = true;
        return;
    }
    ContactForce *forces = contact_force_room(part, (size_t)CONTACT_GROUP * MOST_NEAR);
    if (!forces || contact_push_begin(part, CONTACT_GROUP * MOST_NEAR)) return;
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++)
        if (start[k + 1] == start[k])
            list->depth[lanes->item[k]] = 0.0;
        else
            meet_node(loop, run, law, lanes->item[k], part, start[k], start[k + 1]);
    contact_push_all(loop, law, part);
    take_pushed(run, part, sums, forces);
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) {
        int i = lanes->item[k];
        if (start[k + 1] > start[k]) contact_count_held(list, i);
        list->deepest[group] = larger(list->deepest[group], list->depth[i]);
    }
    if (list->deepest[group] > list->allowed[group]) part->deep = true;
    part->force_count += (size_t)sums->count;
}
