/* How stiff contact may be at each node in each direction: elements are stiff in their own plane only (eq. C12). */
#include <string.h>

#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "solver/vector3.h"

/* Cycles from room to room. */
enum { ROOM_CYCLES = 16 };

/* Components xx yy zz xy yz zx of a symmetric matrix. */
static void add_square(double *sum, const double n[3], double weight)
{
    for (int k = 0; k < 3; k++) {
        sum[k] += weight * n[k] * n[k];
        sum[3 + k] += weight * n[k] * n[(k + 1) % 3];
    }
}

static void invert(double a[6])
{
    double xx = a[1] * a[2] - a[4] * a[4], yy = a[0] * a[2] - a[5] * a[5], zz = a[0] * a[1] - a[3] * a[3];
    double xy = a[4] * a[5] - a[3] * a[2], yz = a[3] * a[5] - a[0] * a[4], zx = a[3] * a[4] - a[1] * a[5];
    double inverse = 1.0 / (a[0] * xx + a[3] * xy + a[5] * zx);
    const double adjoint[6] = {xx, yy, zz, xy, yz, zx};
    for (int k = 0; k < 6; k++) a[k] = adjoint[k] * inverse;
}

/* Unit normal of an element; false if it has no area. */
static bool element_normal(const double *x, const int32_t *node, double n[3])
{
    double u[3], w[3];
    bool triangle = node[3] == node[2];
    vector3_subtract(x + 3 * (ptrdiff_t)node[2], x + 3 * (ptrdiff_t)node[0], u);
    vector3_subtract(x + 3 * (ptrdiff_t)node[triangle ? 1 : 3], x + 3 * (ptrdiff_t)node[triangle ? 0 : 1], w);
    vector3_cross(u, w, n);
    return vector3_normalize(n) > 0.0;
}

/* (w dt)^2 that elements may have. */
static double stiffest_elements(const Model *m)
{
    return 4.0 * m->step_scale * m->step_scale;
}

double contact_room_left(const Model *m)
{
    double room = 3.8 - stiffest_elements(m);
    return room < 0.2 ? 0.2 : room;
}

/* Adds what an element gives to its nodes in [first, end). */
static void add_element(ContactLoop *loop, int e, int32_t first, int32_t end)
{
    const Model *m = loop->model;
    const int32_t *node = m->element_node + 4 * (ptrdiff_t)e;
    int corners = node[3] == node[2] ? 3 : 4, own = 0;
    double n[3], weight = m->element_mass[e];
    for (int k = 0; k < corners; k++) own += node[k] >= first && node[k] < end;
    if (own == 0) return;
    bool flat = element_normal(loop->state->contact_formed, node, n);
    for (int k = 0; k < corners; k++) {
        if (node[k] < first || node[k] >= end) continue;
        loop->around[node[k]] += weight;
        if (flat) add_square(loop->node[node[k]].room, n, weight);
    }
}

void contact_fill_room(ContactLoop *loop, int thread, int threads)
{
    const Model *m = loop->model;
    double *mass = loop->around, elements = stiffest_elements(m), rest = 0.5 * contact_room_left(m);
    int32_t first = contact_first_of(m->node_count, thread, threads),
            end = contact_first_of(m->node_count, thread + 1, threads);
    for (int32_t n = first; n < end; n++) memset(loop->node[n].room, 0, sizeof loop->node[n].room);
    memset(mass + first, 0, (size_t)(end - first) * sizeof *mass);
    for (int e = 0; e < m->element_count; e++) add_element(loop, e, first, end);
    for (int b = 0; b < m->rigid_body_count; b++) /* what is rigid has no stiffness of its own */
        for (int i = 0; i < m->rigid_bodies[b].node_count; i++) {
            int32_t node = m->rigid_bodies[b].node[i];
            if (node < first || node >= end) continue;
            mass[node] = 1.0;
            memcpy(loop->node[node].room, (double[6]){1.0, 1.0, 1.0}, 6 * sizeof(double));
        }
    for (int32_t n = first; n < end; n++) {
        double *room = loop->node[n].room, scale = mass[n] > 0.0 ? elements / mass[n] : 0.0;
        for (int k = 0; k < 6; k++) room[k] = scale * room[k] + (k < 3 ? rest : 0.0);
        invert(room);
    }
}

/* Each thread its share of the nodes. */
static void keep_positions(ContactLoop *loop, int thread, int threads)
{
    int32_t first = contact_first_of(loop->model->node_count, thread, threads),
            end = contact_first_of(loop->model->node_count, thread + 1, threads);
    memcpy(loop->state->contact_formed + 3 * (ptrdiff_t)first, loop->state->x + 3 * (ptrdiff_t)first,
           3 * (size_t)(end - first) * sizeof(double));
}

void contact_renew_room(ContactLoop *loop, int thread, Team *team)
{
    ContactClock *clock = loop->state->contact;
    int threads = team_size(team);
    if (clock->started && clock->unseen < ROOM_CYCLES) return;
    keep_positions(loop, thread, threads);
    team_barrier(team); /* all have read the clock, too */
    if (thread == 0) {
        clock->started = 1;
        clock->unseen = 0;
    }
    contact_fill_room(loop, thread, threads);
}
