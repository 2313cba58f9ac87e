/* Nodes against triangles: the closest point of each candidate, which of them count, on which side the node is, and
 * what it is pushed by. */
#include "contact/contact_geometry.h"
#include "contact/contact_law.h"
#include "contact/contact_sides.h"

enum { MOST_NEAR = 32 }; /* triangles near one node that are looked at in one cycle */

/* One candidate of a node that is near or in contact. */
typedef struct NearFace {
    ClosestPoint at;
    ContactMemory *memory; /* NULL: none */
    int32_t triangle;
    bool rim; /* the closest point is on the surface's rim */
    bool kept;
    bool counts; /* it has a memory, or may touch in this step */
} NearFace;

/* Does triangle g have all the corners on which f's closest point lies? */
static bool shares_feature(const NearFace *f, const NearFace *g)
{
    for (int k = 0; k < 3; k++) {
        int32_t node = f->at.corner[k];
        if ((f->at.feature & 1 << k) && g->at.corner[0] != node && g->at.corner[1] != node && g->at.corner[2] != node)
            return false;
    }
    return true;
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

/* Adds the normal of triangle t, weighted at one of its corners or, corner -1, of unit length. */
static void add_normal(const ContactInterface *c, const double *x, int t, int32_t corner, double sum[3])
{
    const int32_t *node = c->triangle + 3 * (ptrdiff_t)t;
    int first = corner == node[1] ? 1 : corner == node[2] ? 2 : 0;
    const double *p = x + 3 * (ptrdiff_t)node[first];
    double u[3], w[3], n[3];
    vector3_subtract(x + 3 * (ptrdiff_t)node[(first + 1) % 3], p, u);
    vector3_subtract(x + 3 * (ptrdiff_t)node[(first + 2) % 3], p, w);
    vector3_cross(u, w, n);
    double square = vector3_dot(n, n), scale = vector3_dot(u, u) * vector3_dot(w, w);
    if (!(square > 0.0)) return;
    scale = corner < 0 ? 1.0 / sqrt(square) : 1.0 / scale;
    for (int k = 0; k < 3; k++) sum[k] += scale * n[k];
}

/* Which side of the surface the node is on, seen from the edge or corner closest to it: that of the mean normal of the
 * triangles there, which no fold however sharp turns over (eq. C1a). 0: on it. */
static int side_of_feature(const ContactInterface *c, const double *x, const NearFace *f, double n[3])
{
    n[0] = n[1] = n[2] = 0.0;
    int corners = 0, place = 0;
    for (int k = 0; k < 3; k++) {
        corners += f->at.feature >> k & 1;
        if (f->at.feature >> k & 1) place = k;
    }
    if (corners == 1) {
        int32_t node = f->at.corner[place];
        for (int32_t k = c->fan_start[node]; k < c->fan_start[node + 1]; k++) add_normal(c, x, c->fan[k], node, n);
    } else {
        int other = c->neighbour[3 * f->triangle + (f->at.feature == 3 ? 2 : f->at.feature == 5 ? 1 : 0)];
        add_normal(c, x, f->triangle, -1, n);
        if (other >= 0) add_normal(c, x, other, -1, n);
    }
    vector3_normalize(n);
    double height = vector3_dot(n, f->at.toward);
    return (height > 0.0) - (height < 0.0);
}

/* Gap and direction by the side remembered, or found: that of a step ago, as far as the relative velocity tells. False
 * if the pair is none: it has gone round a rim, or its side is not known yet. */
static bool take_side(const ContactLaw *law, const ContactInterface *c, const double *x, NearFace *f, ContactMemory *m,
                      ContactTouch *t)
{
    bool inside = f->at.feature == 7 || f->at.distance == 0.0;
    double mean[3];
    int now = inside ? (f->at.height > 0.0) - (f->at.height < 0.0) : side_of_feature(c, x, f, mean);
    const double *normal = inside ? f->at.normal : mean;
    double height = inside ? f->at.height : vector3_dot(mean, f->at.toward);
    double before = height - law->before * vector3_dot(t->speed, normal);
    t->side = m->side ? m->side : f->rim ? now : before > 0.0 ? 1 : before < 0.0 ? -1 : now;
    if (t->side == 0) return false;
    if (inside) {
        t->gap = t->side * f->at.height;
        for (int k = 0; k < 3; k++) t->direction[k] = t->side * f->at.normal[k];
        return true;
    }
    if (f->rim && m->side && now != m->side && now != 0) return false;
    if (f->rim || now == t->side || now == 0) {
        t->gap = f->at.distance;
        for (int k = 0; k < 3; k++) t->direction[k] = f->at.toward[k] / f->at.distance;
    } else { /* behind: r / |r| would turn over where the node comes through */
        t->gap = t->side * vector3_dot(mean, f->at.toward);
        for (int k = 0; k < 3; k++) t->direction[k] = t->side * mean[k];
    }
    return true;
}

/* How fast a node and a triangle may come nearer at most. */
static double closing_speed(const double *v, int32_t node, const int32_t corner[3])
{
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        double u[3];
        vector3_subtract(v + 3 * (ptrdiff_t)corner[i], v + 3 * (ptrdiff_t)node, u);
        most = larger(most, vector3_dot(u, u));
    }
    return sqrt(most);
}

/* Too far for its own velocity: a new pair that cannot touch in this step. */
static bool cannot_touch(const ContactLaw *law, const NearFace *f, int32_t node, double thickness)
{
    double beyond = f->at.distance - thickness;
    if (!(beyond > 0.0)) return false;
    ContactTouch t = {.node = {node, f->at.corner[0], f->at.corner[1], f->at.corner[2]},
                      .weight = {1.0, -f->at.weight[0], -f->at.weight[1], -f->at.weight[2]}};
    contact_speed(law, &t);
    return beyond > contact_ahead(law->longer * vector3_norm(t.speed), thickness) * (1.0 + 1e-9);
}

/* Of the triangles [first, end) of others those that the node may touch in this step. What it has no memory of it may
 * meet (contact/near_kernels.c). */
static int look_around(const ContactLoop *loop, ContactRun *run, const ContactLaw *law, int i, const int32_t *other,
                       int others, NearFace *near)
{
    const ContactInterface *c = run->contact;
    const double *x = loop->state->x, *at = x + 3 * (ptrdiff_t)c->node[i], *inverse = loop->model->contact_inverse;
    double depth = run->faces.depth[i]; /* behind a surface: the next triangle may be as far away */
    int count = 0;
    for (int k = 0; k < others; k++) {
        int32_t t = other[k];
        NearFace *f = &near[count];
        double thickness = run->thinness * (c->node_radius[i] + c->triangle_radius[t]), bound;
        f->memory = contact_recall(&run->faces, i, t);
        f->triangle = t;
        memcpy(f->at.corner, c->triangle + 3 * (ptrdiff_t)t, sizeof f->at.corner);
        double way = closing_speed(loop->state->v, c->node[i], f->at.corner) * loop->step.longer;
        double reach = thickness + contact_ahead(way, thickness) + depth;
        if (f->memory)
            reach += contact_deepest(c);
        else if (!contact_moves(inverse, c->node[i], f->at.corner, 3))
            continue;
        if (closest_point(&f->at, at, x, reach, &bound) && count < MOST_NEAR - 1) {
            f->counts = f->memory || !cannot_touch(law, f, c->node[i], thickness);
            count++;
        } else if (f->memory) {
            *f->memory = (ContactMemory){0};
        }
    }
    return count;
}

/* Does the closest point lie on the surface's rim? An edge between two corners of the rim may be none of it. */
static bool is_on_rim(const ContactInterface *c, const NearFace *f)
{
    const ptrdiff_t first = 3 * (ptrdiff_t)f->triangle;
    if (f->at.feature == 7) return false;
    for (int k = 0; k < 3; k++) {
        if (f->at.feature == 1 << k) return c->corner_rim[first + k];
        if (f->at.feature == (7 & ~(1 << k))) return c->neighbour[first + k] < 0;
    }
    return false;
}

/* One near triangle: the node's pair with it, pushed. */
static void meet_face(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int i, NearFace *f, ContactSums *sums,
                      ContactForce *forces)
{
    const ContactInterface *c = run->contact;
    ContactMemory fresh = {0}, *m = f->memory;
    ContactTouch t = {.node = {c->node[i], f->at.corner[0], f->at.corner[1], f->at.corner[2]},
                      .weight = {1.0, -f->at.weight[0], -f->at.weight[1], -f->at.weight[2]},
                      .thickness = run->thinness * (c->node_radius[i] + c->triangle_radius[f->triangle]),
                      .stiffness = c->stiffness[c->node_side[i] == CONTACT_SIDE_B]};
    if (f->kept) contact_speed(law, &t);
    f->rim = is_on_rim(c, f);
    if (!f->kept || !take_side(law, c, loop->state->x, f, m ? m : &fresh, &t)) {
        if (m) *m = (ContactMemory){0};
        return;
    }
    ContactForce *out = &forces[sums->count];
    int counts = contact_push(law, &t, m ? m : &fresh, out, sums);
    if (m && m->side != 0 && -m->gap > run->faces.depth[i]) run->faces.depth[i] = -m->gap;
    if (!m && fresh.side != 0) contact_keep(&run->faces, i, f->triangle, &fresh);
    if (!counts) return;
    sums->count++;
    double sign = c->node_side[i] & CONTACT_SIDE_A ? 1.0 : -1.0;
    for (int a = 0; a < 3; a++) sums->force[a] += sign * out->force[a];
}

/* One node with what is near it or in contact with it. */
static void meet_node(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int i, const int32_t *other,
                      int others, ContactSums *sums, ContactForce *forces)
{
    NearFace near[MOST_NEAR];
    int count = look_around(loop, run, law, i, other, others, near);
    run->faces.depth[i] = 0.0;
    keep_nearest(near, count);
    for (int k = 0; k < count; k++)
        if (near[k].memory || (near[k].kept && near[k].counts)) meet_face(loop, run, law, i, &near[k], sums, forces);
    contact_count_held(&run->faces, i);
}

/* No node of the group has anything near it. */
static void forget_depths(ContactList *list, const ContactLanes *lanes)
{
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) list->depth[lanes->item[k]] = 0.0;
}

void contact_meet_faces(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int group, int thread, int place)
{
    ContactList *list = &run->faces;
    ContactPart *part = &loop->parts[thread];
    ContactSums *sums = &list->sums[group];
    const ContactLanes *lanes = &run->nodes.lanes[group];
    int start[CONTACT_GROUP + 1];
    *sums = (ContactSums){0};
    list->pieces[group] = (ContactPiece){.thread = thread, .first = (int32_t)part->force_count};
    contact_find_near(loop, run, false, group, thread, place, start);
    list->deepest[group] = 0.0;
    if (part->failed) return;
    if (start[CONTACT_GROUP] == 0) {
        forget_depths(list, lanes);
        return;
    }
    ContactForce *forces = contact_force_room(part, (size_t)CONTACT_GROUP * MOST_NEAR);
    if (!forces) return;
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) {
        int i = lanes->item[k];
        if (start[k + 1] == start[k])
            list->depth[i] = 0.0;
        else
            meet_node(loop, run, law, i, part->other + start[k], start[k + 1] - start[k], sums, forces);
        list->deepest[group] = larger(list->deepest[group], list->depth[i]);
    }
    if (list->deepest[group] > list->allowed[group]) part->deep = true;
    part->force_count += (size_t)sums->count;
}
