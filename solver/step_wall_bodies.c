/* Rigid walls and moving rigid bodies, RWPNAL > 0: a penalty on the bodies' nodes. Equations (W12) to (W14). */
#include <math.h>
#include <string.h>

#include "solver/vector3.h"
#include "solver/workspace.h"

/* Side of a node from where it is, once in a wall's first cycle and then as it moves on: true if the wall pushes it. */
static bool pushes(const RigidWall *wall, const WallPlan *plan, const WallGap *gap, unsigned char *side)
{
    if (plan->fresh)
        *side = gap->distance >= -wall->tolerance ? WALL_SIDE_FRONT : gap->over ? WALL_SIDE_BEHIND : WALL_SIDE_PASSED;
    else if (gap->distance >= -wall->tolerance && *side != WALL_SIDE_FRONT)
        *side = WALL_SIDE_FRONT;
    else if (!gap->over && gap->distance < -wall->tolerance)
        *side = WALL_SIDE_PASSED;
    return *side == WALL_SIDE_FRONT && gap->over && gap->distance < 0.0;
}

/* Force of a wall on a node within it (W12), with what rubs (W13); share is k dt^2. */
static void push_node(const RigidWall *wall, const WallPlan *plan, const WallGap *gap, const double v[3], double share,
                      double dt, double force[3])
{
    double press = -gap->distance * share / (dt * dt), slip[3], rate = share / dt;
    vector3_subtract(v, plan->velocity, slip);
    double along = vector3_dot(slip, gap->normal);
    for (int k = 0; k < 3; k++) slip[k] -= along * gap->normal[k];
    double speed = vector3_norm(slip);
    if (wall->sliding != WALL_NO_SLIDING && rate * speed > wall->friction * press)
        rate = wall->friction * press / speed;
    for (int k = 0; k < 3; k++) force[k] = press * gap->normal[k] - rate * slip[k];
}

/* True if no node of the body can be behind the plane: most bodies are far from most walls. */
static bool is_clear(const RigidWall *wall, const WallPlan *plan, const RigidBody *body, const RigidState *state)
{
    double r[3];
    if (wall->shape != WALL_PLANE || wall->length[0] > 0.0 || wall->length[1] > 0.0 || wall->behind_count > 0 ||
        wall->birth > 0.0 || plan->fresh)
        return false;
    vector3_subtract(state->x, plan->before, r);
    return vector3_dot(r, wall->axes + 6) > body->reach;
}

/* One wall on the nodes of one body at t_n. */
static void push_body(Workspace *w, int i, int b)
{
    const Model *m = w->model;
    const RigidWall *wall = &m->walls[i];
    const WallPlan *plan = &w->walls[i];
    const RigidBody *body = &m->rigid_bodies[b];
    double *sum = w->wall_body_sum + 4 * (ptrdiff_t)i, dt = fmax(w->plan.dt_before, w->plan.dt_next);
    if (is_clear(wall, plan, body, &w->state->rigid[b])) return;
    for (int k = 0; k < body->node_count; k++) {
        int node = body->node[k];
        if (!wall->pushed[node]) continue;
        unsigned char *side = w->state->wall_side + (ptrdiff_t)i * m->moving_count + node;
        double r[3], force[3];
        vector3_subtract(w->state->x + 3 * (ptrdiff_t)node, plan->before, r);
        WallGap gap = rigid_wall_gap(wall, r);
        if (!pushes(wall, plan, &gap, side)) continue;
        push_node(wall, plan, &gap, w->state->v + 3 * (ptrdiff_t)node, wall->body_penalty[b], dt, force);
        double *all = w->wall_body_force + 3 * (ptrdiff_t)(node - m->free_count);
        for (int c = 0; c < 3; c++) {
            all[c] += force[c];
            w->force[3 * (ptrdiff_t)node + c] += force[c];
            sum[c] += force[c];
        }
        sum[3] += vector3_dot(force, gap.normal);
    }
}

void step_wall_bodies_push(Workspace *w)
{
    const Model *m = w->model;
    memset(w->wall_body_force, 0, 3 * (size_t)(m->moving_count - m->free_count) * sizeof *w->wall_body_force);
    memset(w->wall_body_sum, 0, 4 * (size_t)m->wall_count * sizeof *w->wall_body_sum);
    for (int i = 0; i < m->wall_count; i++)
        for (int b = 0; m->walls[i].pushed && w->walls[i].acts && b < m->rigid_body_count; b++) push_body(w, i, b);
}

void step_wall_bodies_count(Workspace *w, NodeSums *sums)
{
    const Model *m = w->model;
    const double *before = w->plan.dt_before > 0.0 ? w->before : w->state->v;
    WallSums *wall_sums = w->wall_sums + (ptrdiff_t)w->node_chunk_count * m->wall_count;
    for (int i = 0; i < m->wall_count; i++) {
        for (int k = 0; k < 3; k++) wall_sums[i].impulse[k] += w->plan.dt_mean * w->wall_body_sum[4 * (ptrdiff_t)i + k];
        wall_sums[i].normal += w->plan.dt_mean * w->wall_body_sum[4 * (ptrdiff_t)i + 3];
    }
    for (int b = 0; b < m->rigid_body_count; b++) {
        const RigidBody *body = &m->rigid_bodies[b];
        for (int k = 0; k < body->node_count; k++) {
            ptrdiff_t n = 3 * (ptrdiff_t)body->node[k], s = n - 3 * (ptrdiff_t)m->free_count;
            for (int c = 0; c < 3; c++)
                sums->reaction +=
                    0.5 * w->wall_body_force[s + c] * (before[n + c] + w->state->v[n + c]) * w->plan.dt_mean;
        }
    }
}
