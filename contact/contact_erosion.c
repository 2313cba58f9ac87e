/* Shells that have eroded leave contact (docs/theory.md, Erosion): what is left of a surface follows from the Model and
 * State.eroded alone, so that a restart sees the same. */
#include "contact/contact_erosion.h"

#include <string.h>

#include "contact/contact_sides.h"
#include "solver/memory.h"

/* Marks of a node. */
enum {
    HAD_SHELLS = 1,
    HAS_SHELLS = 2, /* some of them are left */
    ON_RIM = 4,     /* of the surface at hand */
};

/* A copy of count items of some bytes, with room for more; NULL without memory. */
static void *copy_of(const void *from, size_t count, size_t bytes)
{
    void *to = memory_alloc(count + 1, bytes);
    if (to && count > 0) memcpy(to, from, count * bytes);
    return to;
}

int contact_living_create(ContactRun *run, const ContactInterface *c, int nodes)
{
    ContactInterface *l = &run->living;
    size_t triangles = (size_t)c->triangle_count, edges = (size_t)c->edge_count;
    *l = *c;
    run->erodes = true;
    l->node_side = copy_of(c->node_side, (size_t)c->node_count, 1);
    l->neighbour = copy_of(c->neighbour, 3 * triangles, sizeof *l->neighbour);
    l->triangle_side = copy_of(c->triangle_side, triangles, 1);
    l->corner_rim = copy_of(c->corner_rim, 3 * triangles, 1);
    l->fan_start = copy_of(c->fan_start, (size_t)nodes + 2, sizeof *l->fan_start);
    l->fan = copy_of(c->fan, 3 * triangles, sizeof *l->fan);
    l->edge_triangle = copy_of(c->edge_triangle, 2 * edges, sizeof *l->edge_triangle);
    l->edge_side = copy_of(c->edge_side, edges, 1);
    l->edge_radius = copy_of(c->edge_radius, edges, sizeof *l->edge_radius);
    run->contact = l;
    return l->node_side && l->neighbour && l->triangle_side && l->corner_rim && l->fan_start && l->fan &&
                   l->edge_triangle && l->edge_side && l->edge_radius
               ? 0
               : -1;
}

void contact_living_free(ContactRun *run)
{
    if (!run->erodes) return;
    memory_free(run->living.node_side);
    memory_free(run->living.neighbour);
    memory_free(run->living.triangle_side);
    memory_free(run->living.corner_rim);
    memory_free(run->living.fan_start);
    memory_free(run->living.fan);
    memory_free(run->living.edge_triangle);
    memory_free(run->living.edge_side);
    memory_free(run->living.edge_radius);
}

static bool is_gone(const ContactLoop *loop, int32_t shell)
{
    return shell >= 0 && loop->state->eroded[loop->model->element_slot[shell]] != 0;
}

/* Which nodes hang on shells. */
static void mark_nodes(ContactLoop *loop)
{
    const Model *m = loop->model;
    memset(loop->mark, 0, (size_t)m->node_count);
    for (int e = 0; e < m->element_count; e++)
        for (int k = 0; k < 4; k++)
            loop->mark[m->element_node[4 * (ptrdiff_t)e + k]] |=
                is_gone(loop, e) ? HAD_SHELLS : HAD_SHELLS | HAS_SHELLS;
}

/* Sides and neighbours of triangles. A branch stays one, as a rim. */
static void leave_triangles(const ContactLoop *loop, ContactRun *run, const ContactInterface *whole)
{
    ContactInterface *l = &run->living;
    for (int t = 0; t < l->triangle_count; t++)
        l->triangle_side[t] = is_gone(loop, l->triangle_shell[t]) ? 0 : whole->triangle_side[t];
    for (int i = 0; i < 3 * l->triangle_count; i++) {
        int32_t beyond = whole->neighbour[i];
        bool torn = l->triangle_side[i / 3] == 0 || (beyond >= 0 && l->triangle_side[beyond] == 0);
        l->neighbour[i] = torn && beyond >= 0 ? CONTACT_BOUNDARY : beyond;
    }
}

/* Triangles left at each node, ascending. */
static void leave_fans(ContactRun *run, const ContactInterface *whole, int nodes)
{
    ContactInterface *l = &run->living;
    int32_t count = 0;
    for (int n = 0; n < nodes; n++) {
        l->fan_start[n] = count;
        for (int32_t k = whole->fan_start[n]; k < whole->fan_start[n + 1]; k++)
            if (l->triangle_side[whole->fan[k]]) l->fan[count++] = whole->fan[k];
    }
    l->fan_start[nodes] = count;
}

/* Corners on the rims of what is left. */
static void leave_rims(ContactLoop *loop, ContactRun *run)
{
    ContactInterface *l = &run->living;
    for (int n = 0; n < loop->model->node_count; n++) loop->mark[n] &= (unsigned char)~ON_RIM;
    for (int i = 0; i < 3 * l->triangle_count; i++) {
        if (l->triangle_side[i / 3] == 0 || l->neighbour[i] >= 0) continue;
        for (int k = 0; k < 3; k++)
            if (k != i % 3) loop->mark[l->triangle[i / 3 * 3 + k]] |= ON_RIM;
    }
    for (int i = 0; i < 3 * l->triangle_count; i++) l->corner_rim[i] = (loop->mark[l->triangle[i]] & ON_RIM) != 0;
}

/* Triangles left at each edge; one of two makes it a free edge. */
static void leave_edges(ContactRun *run)
{
    ContactInterface *l = &run->living;
    for (int e = 0; e < l->edge_count; e++) {
        int32_t from = l->edge[2 * e], to = l->edge[2 * e + 1], found[2] = {-1, -1};
        double radius = 0.0;
        int count = 0;
        l->edge_side[e] = 0;
        for (int32_t k = l->fan_start[from]; k < l->fan_start[from + 1]; k++) {
            const int32_t t = l->fan[k], *corner = l->triangle + 3 * (ptrdiff_t)t;
            if (corner[0] != to && corner[1] != to && corner[2] != to) continue;
            if (count < 2) found[count] = t;
            l->edge_side[e] |= l->triangle_side[t];
            radius = fmax(radius, l->triangle_radius[t]);
            count++;
        }
        if (count == 0) continue;
        l->edge_triangle[2 * e] = found[0];
        l->edge_triangle[2 * e + 1] = count == 2 ? found[1] : -1;
        l->edge_radius[e] = radius;
    }
}

/* A node meets others for the sides of the triangles left at it; where it has its side from a set of nodes, as long as
 * some shell holds it. */
static void leave_nodes(const ContactLoop *loop, ContactRun *run, const ContactInterface *whole)
{
    ContactInterface *l = &run->living;
    if (loop->model->eroded_nodes_stay) return;
    for (int i = 0; i < l->node_count; i++) {
        int32_t n = l->node[i];
        int before = 0, left = 0;
        for (int32_t k = whole->fan_start[n]; k < whole->fan_start[n + 1]; k++) {
            before |= whole->triangle_side[whole->fan[k]];
            left |= l->triangle_side[whole->fan[k]];
        }
        bool held = loop->mark[n] & HAS_SHELLS || !(loop->mark[n] & HAD_SHELLS);
        l->node_side[i] = whole->node_side[i] & (unsigned char)(left | (held ? ~before : 0));
    }
}

/* Pairs of what is gone are none. Their force ends; what it had stored stays in the ledger, for nobody gets it back. */
static void forget(ContactList *list, const unsigned char *own, const unsigned char *all)
{
    for (int i = 0; i < list->owner_count; i++) {
        for (int k = 0; k < list->held[i]; k++) {
            ContactMemory *m = contact_slot(list, i, k);
            if (m->side && !contact_sides_meet(own[i], all[m->pair[1]])) *m = (ContactMemory){0};
        }
        contact_count_held(list, i);
    }
}

void contact_erode(ContactLoop *loop)
{
    mark_nodes(loop);
    for (int i = 0; i < loop->model->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        const ContactInterface *whole = &loop->model->contacts[i];
        ContactItems items[3];
        leave_triangles(loop, run, whole);
        leave_fans(run, whole, loop->model->node_count);
        leave_rims(loop, run);
        leave_edges(run);
        leave_nodes(loop, run, whole);
        contact_records_fill(run, loop->model);
        contact_items(run, items);
        contact_groups_renew(&run->nodes, &items[0]);
        contact_groups_renew(&run->triangles, &items[1]);
        contact_groups_renew(&run->lines, &items[2]);
        forget(&run->faces, run->living.node_side, run->living.triangle_side);
        forget(&run->edges, run->living.edge_side, run->living.edge_side);
        contact_awake(&run->faces), contact_awake(&run->edges);
    }
}
