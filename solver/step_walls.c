/* Rigid walls: nodes that would enter one get the velocity that puts them on it (docs/theory.md, Rigid walls). Free
 * nodes chunk by chunk after their node loop, while they are in the cache; special nodes on thread 0. */
#include <math.h>
#include <string.h>

#include "solver/step_walls.h"
#include "solver/vector3.h"

enum { SWEEPS = 8 }; /* over the walls of a node in a corner of several */

/* A wall's normal that the supports of a node leave less of than this (squared) cannot move it. */
static const double HELD_NORMAL = 1e-6;

static const RateRows nothing_held = {0};

/* Displacement of a driven wall along its direction at a time (W6). */
static double driven_shift(const RigidWall *wall, const Curve *curves, double time)
{
    if (wall->curve < 0 || !(time > wall->birth)) return 0.0;
    double since = time - wall->birth;
    const Curve *curve = &curves[wall->curve];
    return wall->displacement ? curve_value(curve, since) : curve_integral(curve, 0.0, since);
}

void step_walls_begin(Workspace *w)
{
    const Model *m = w->model;
    double now = w->plan.time, dt = w->plan.dt_next;
    for (int i = 0; i < m->wall_count; i++) {
        const RigidWall *wall = &m->walls[i];
        WallState *state = &w->state->wall[i];
        WallPlan *plan = &w->walls[i];
        plan->acts = now >= wall->birth && now < wall->death;
        plan->fresh = plan->acts && !state->born;
        if (plan->acts) state->born = 1;
        double from = driven_shift(wall, m->curves, now), to = driven_shift(wall, m->curves, now + dt);
        double speed = plan->acts ? state->speed : 0.0;
        for (int k = 0; k < 3; k++) {
            double move = wall->direction[k] * (to - from) + wall->axes[6 + k] * dt * speed;
            plan->before[k] = wall->origin[k] + wall->direction[k] * from + wall->axes[6 + k] * state->shift;
            plan->origin[k] = plan->before[k] + move;
            plan->velocity[k] = dt > 0.0 ? move / dt : 0.0;
        }
    }
}

/* The part of n that the held directions leave free; returns its square. */
static double free_part(const RateRows *held, const double n[3], double part[3])
{
    memcpy(part, n, 3 * sizeof *part);
    for (int r = 0; r < held->count; r++) {
        double along = vector3_dot(held->direction + 3 * r, n);
        for (int k = 0; k < 3; k++) part[k] -= along * held->direction[3 * r + k];
    }
    return vector3_dot(part, n);
}

/* Friction of the normal impulse, both per mass (W8). */
static void slow_sliding(const RigidWall *wall, const WallPlan *plan, const RateRows *held, const double n[3],
                         double normal, double v[3], double impulse[3])
{
    if (wall->sliding != WALL_NO_SLIDING && wall->friction == 0.0) return;
    double u[3], slip[3];
    vector3_subtract(v, plan->velocity, u);
    double along = vector3_dot(u, n);
    for (int k = 0; k < 3; k++) u[k] -= along * n[k];
    free_part(held, u, slip);
    double size = vector3_norm(slip);
    if (!(size > 0.0)) return;
    double stopped = wall->sliding == WALL_NO_SLIDING ? 1.0 : fmin(1.0, wall->friction * fmax(normal, 0.0) / size);
    for (int k = 0; k < 3; k++) {
        v[k] -= stopped * slip[k];
        impulse[k] -= stopped * slip[k];
    }
}

/* Which side of a wall in its first cycle the node is on. */
static void find_side(const RigidWall *wall, const WallPlan *plan, const double x[3], unsigned char *side)
{
    double r[3];
    vector3_subtract(x, plan->before, r);
    WallGap gap = rigid_wall_gap(wall, r);
    *side = gap.distance >= -wall->tolerance ? WALL_SIDE_FRONT : gap.over ? WALL_SIDE_BEHIND : WALL_SIDE_PASSED;
}

/* True if the wall may act on a node that Newton's law takes to the gap; keeps its side up to date. */
static bool may_act(const RigidWall *wall, const WallGap *gap, unsigned char *side)
{
    if (*side == WALL_SIDE_WELDED) return true;
    if (gap->distance >= 0.0 || (*side != WALL_SIDE_FRONT && gap->distance >= -wall->tolerance))
        *side = WALL_SIDE_FRONT;
    else if (!gap->over && gap->distance < -wall->tolerance)
        *side = WALL_SIDE_PASSED;
    return gap->distance < 0.0 && gap->over && *side != WALL_SIDE_PASSED;
}

/* One wall on one node at x whose velocity v Newton's law has given: true if it changed v (W5 to W9). */
static bool meet_wall(Workspace *w, int i, int node, const double x[3], const RateRows *held, double v[3],
                      WallSums *sums)
{
    const Model *m = w->model;
    const RigidWall *wall = &m->walls[i];
    const WallPlan *plan = &w->walls[i];
    unsigned char *side = w->state->wall_side + (ptrdiff_t)i * m->moving_count + node;
    double r[3], part[3], impulse[3], dt = w->plan.dt_next;
    if (plan->fresh) find_side(wall, plan, x, side);
    for (int k = 0; k < 3; k++) r[k] = x[k] + dt * v[k] - plan->origin[k];
    WallGap gap = rigid_wall_gap(wall, r);
    if (!may_act(wall, &gap, side)) return false;
    double square = free_part(held, gap.normal, part);
    if (square < HELD_NORMAL) return false;
    double u[3], normal = -gap.distance / (dt * square);
    vector3_subtract(v, plan->velocity, u);
    if (*side == WALL_SIDE_BEHIND) {
        normal = -vector3_dot(u, gap.normal) / square;
        if (!(normal > 0.0)) return false;
    }
    if (wall->welds && *side == WALL_SIDE_FRONT && -vector3_dot(u, gap.normal) > wall->weld_speed)
        *side = WALL_SIDE_WELDED;
    for (int k = 0; k < 3; k++) {
        v[k] += normal * part[k];
        impulse[k] = normal * gap.normal[k];
    }
    slow_sliding(wall, plan, held, gap.normal, normal, v, impulse);
    for (int k = 0; k < 3; k++) sums->impulse[k] += m->mass[node] * impulse[k];
    sums->normal += m->mass[node] * normal;
    return true;
}

/* All walls without mass on one node; where several act, again until none has to. */
static void meet_walls(Workspace *w, int node, const double x[3], const RateRows *held, double v[3], WallSums *sums)
{
    const Model *m = w->model;
    for (int sweep = 0, acting = 2; sweep < SWEEPS && acting > 1; sweep++) {
        acting = 0;
        for (int i = 0; i < m->wall_count; i++)
            if (w->walls[i].acts && m->walls[i].tracked[node] && m->walls[i].mass == 0.0)
                acting += meet_wall(w, i, node, x, held, v, &sums[i]);
    }
}

/* Marks the nodes that the wall has to look at closely; in its first cycle all. */
static void find_hits(const Workspace *w, int i, int first, int count, const double *moved, unsigned char *hit)
{
    const Model *m = w->model;
    const RigidWall *wall = &m->walls[i];
    const unsigned char *side = w->state->wall_side + (ptrdiff_t)i * m->moving_count + first;
    const unsigned char *tracked = wall->tracked + first;
    const double *origin = w->walls[i].origin, *n = wall->axes + 6;
    double gap[BILLOW_NODE_CHUNK];
    for (int k = 0; k < count; k++)
        gap[k] = n[0] * (moved[3 * k] - origin[0]) + n[1] * (moved[3 * k + 1] - origin[1]) +
                 n[2] * (moved[3 * k + 2] - origin[2]);
    for (int k = 0; k < count && wall->shape != WALL_PLANE; k++) {
        double r[3];
        vector3_subtract(moved + 3 * (ptrdiff_t)k, origin, r);
        gap[k] = tracked[k] ? rigid_wall_gap(wall, r).distance : 0.0;
    }
    for (int k = 0; k < count; k++) {
        bool quiet =
            side[k] == WALL_SIDE_FRONT ? gap[k] >= 0.0 : side[k] == WALL_SIDE_PASSED && gap[k] < -wall->tolerance;
        hit[k] |= (unsigned char)(tracked[k] & (!quiet | w->walls[i].fresh));
    }
}

/* A wall with mass: the node waits for its speed if it may meet it. */
static bool await_wall(Workspace *w, int i, int node, const double x[3], const double v[3])
{
    const Model *m = w->model;
    unsigned char *side = w->state->wall_side + (ptrdiff_t)i * m->moving_count + node;
    double r[3];
    if (w->walls[i].fresh) find_side(&m->walls[i], &w->walls[i], x, side);
    for (int k = 0; k < 3; k++) r[k] = x[k] + w->plan.dt_next * v[k] - w->walls[i].origin[k];
    WallGap gap = rigid_wall_gap(&m->walls[i], r);
    return may_act(&m->walls[i], &gap, side);
}

static bool await_walls(Workspace *w, int node, const double x[3], const double v[3])
{
    bool waits = false;
    for (int i = 0; i < w->model->wall_count; i++)
        if (w->walls[i].acts && w->model->walls[i].mass > 0.0 && w->model->walls[i].tracked[node])
            waits |= await_wall(w, i, node, x, v);
    return waits;
}

void step_walls_chunk(Workspace *w, int chunk, int first, int end, const double *before, NodeSums *sums)
{
    const Model *m = w->model;
    WallSums *wall_sums = w->wall_sums + (ptrdiff_t)chunk * m->wall_count;
    double moved[3 * BILLOW_NODE_CHUNK], *x = w->state->x + 3 * (ptrdiff_t)first,
                                         *v = w->state->v + 3 * (ptrdiff_t)first;
    unsigned char hit[BILLOW_NODE_CHUNK] = {0};
    int count = end - first;
    double dt = w->plan.dt_next, advance = w->plan.emit ? 0.0 : dt;
    memset(wall_sums, 0, (size_t)m->wall_count * sizeof *wall_sums);
    for (int k = 0; k < 3 * count; k++) moved[k] = x[k] + dt * v[k];
    for (int i = 0; i < m->wall_count; i++)
        if (w->walls[i].acts) find_hits(w, i, first, count, moved, hit);
    for (int k = 0; k < count; k++) {
        if (!hit[k]) continue;
        double free_v[3], now[3], *vk = v + 3 * (ptrdiff_t)k, *xk = x + 3 * (ptrdiff_t)k;
        memcpy(free_v, vk, sizeof free_v);
        memcpy(now, vk, sizeof now);
        meet_walls(w, first + k, xk, &nothing_held, now, wall_sums);
        memcpy(vk, now, sizeof now); /* whole, as the node loops store: their loads reach one value beyond a chunk */
        step_walls_account(w, first + k, before + 3 * (ptrdiff_t)k, free_v, sums);
        for (int c = 0; c < 3; c++) moved[3 * k + c] = xk[c] + dt * now[c];
        if (!m->has_moving_walls || !await_walls(w, first + k, xk, now)) continue;
        w->wall_pending[first + k] = 1;
        memcpy(w->before + 3 * (ptrdiff_t)(first + k), before + 3 * (ptrdiff_t)k, 3 * sizeof *before);
        memcpy(moved + 3 * (ptrdiff_t)k, xk, 3 * sizeof *moved); /* it moves when the wall's speed is known */
    }
    for (int k = 0; advance > 0.0 && k < count; k++)
        memcpy(x + 3 * (ptrdiff_t)k, moved + 3 * (ptrdiff_t)k, 3 * sizeof *x);
}

/* Directions in which a special node is held or driven. */
static void held_directions(const Workspace *w, int node, RateRows *held)
{
    held->count = 0;
    if (w->special_kind[node - w->model->free_count] == 0)
        constraints_held(&w->model->constraints, node, w->plan.time, held);
}

/* Share of the momentum balance (W11) of the nodes that wait for a wall's speed: its value and slope at the speed. */
static void press_on_wall(Workspace *w, int i, double speed, double *value, double *slope)
{
    const Model *m = w->model;
    const RigidWall *wall = &m->walls[i];
    const double *n = wall->axes + 6;
    const unsigned char *side = w->state->wall_side + (ptrdiff_t)i * m->moving_count;
    for (int node = 0; node < m->moving_count; node++) {
        if (!w->wall_pending[node] || !wall->tracked[node] || side[node] == WALL_SIDE_PASSED) continue;
        RateRows held = {0};
        double r[3], part[3];
        if (node >= m->free_count) held_directions(w, node, &held);
        double square = free_part(&held, n, part);
        if (square < HELD_NORMAL) continue;
        vector3_subtract(w->state->x + 3 * (ptrdiff_t)node, w->walls[i].before, r);
        double closing = side[node] == WALL_SIDE_BEHIND ? 0.0 : vector3_dot(n, r) / w->plan.dt_next;
        double needed = speed - closing - vector3_dot(n, w->state->v + 3 * (ptrdiff_t)node);
        if (needed <= 0.0 && side[node] != WALL_SIDE_WELDED) continue;
        *value += m->mass[node] / square * needed;
        *slope += m->mass[node] / square;
    }
}

/* Speed of a wall with mass that keeps the momentum of wall and nodes (W11): Newton's method from the speed without
 * contact, which comes down to the root of a convex, piecewise linear function in finitely many steps. */
static void settle_speed(Workspace *w, int i, NodeSums *sums)
{
    const RigidWall *wall = &w->model->walls[i];
    WallState *state = &w->state->wall[i];
    WallPlan *plan = &w->walls[i];
    double old = state->speed, speed = old, dt = w->plan.dt_next;
    for (int iteration = 0; plan->acts && iteration < 50; iteration++) {
        double value = wall->mass * (speed - old), slope = wall->mass;
        press_on_wall(w, i, speed, &value, &slope);
        double next = speed - value / slope;
        if (fabs(next - speed) <= 1e-16 * (fabs(speed) + fabs(old))) break;
        speed = next;
    }
    double share = w->plan.dt_mean > 0.0 ? 0.5 * w->plan.dt_before / w->plan.dt_mean : 0.0;
    double full = old + share * (speed - old), impulse = wall->mass * (speed - old);
    sums->kinetic += 0.5 * wall->mass * full * full;
    sums->kinetic_steps += 0.5 * wall->mass * old * speed;
    sums->support_before += impulse * old;
    sums->support_after += impulse * speed;
    state->speed = speed;
    if (plan->acts) state->shift += dt * speed;
    for (int k = 0; k < 3; k++) {
        plan->velocity[k] = wall->axes[6 + k] * speed;
        plan->origin[k] = plan->before[k] + dt * plan->velocity[k];
    }
}

/* Walls with mass: their speeds, then the nodes that waited. */
static void settle_walls(Workspace *w, NodeSums *special)
{
    const Model *m = w->model;
    for (int i = 0; i < m->wall_count; i++)
        if (m->walls[i].mass > 0.0) settle_speed(w, i, special);
    for (int node = 0; node < m->moving_count; node++) {
        if (!w->wall_pending[node]) continue;
        bool is_free = node < m->free_count;
        int chunk = is_free ? node / BILLOW_NODE_CHUNK : w->node_chunk_count;
        double free_v[3], *v = w->state->v + 3 * (ptrdiff_t)node, *x = w->state->x + 3 * (ptrdiff_t)node;
        RateRows held = {0};
        if (!is_free) held_directions(w, node, &held);
        memcpy(free_v, v, sizeof free_v);
        for (int i = 0; i < m->wall_count; i++)
            if (m->walls[i].mass > 0.0 && w->walls[i].acts && m->walls[i].tracked[node])
                meet_wall(w, i, node, x, &held, v, w->wall_sums + (ptrdiff_t)chunk * m->wall_count + i);
        w->wall_pending[node] = 0;
        if (!is_free) continue;
        step_walls_account(w, node, w->before + 3 * (ptrdiff_t)node, free_v, &w->node_sums[chunk]);
        for (int k = 0; k < 3 && !w->plan.emit; k++) x[k] += w->plan.dt_next * v[k];
    }
}

void step_walls_special(Workspace *w, NodeSums *sums)
{
    const Model *m = w->model;
    WallSums *wall_sums = w->wall_sums + (ptrdiff_t)w->node_chunk_count * m->wall_count;
    memset(wall_sums, 0, (size_t)m->wall_count * sizeof *wall_sums);
    for (int node = m->free_count; node < m->moving_count; node++) {
        if (w->special_kind[node - m->free_count] != 0) continue;
        const double *x = w->state->x + 3 * (ptrdiff_t)node;
        double *v = w->state->v + 3 * (ptrdiff_t)node;
        double free_v[3], change[3];
        RateRows held;
        held_directions(w, node, &held);
        memcpy(free_v, v, sizeof free_v);
        meet_walls(w, node, x, &held, v, wall_sums);
        vector3_subtract(v, free_v, change);
        sums->stopped += 0.5 * m->mass[node] * vector3_dot(change, change);
        if (m->has_moving_walls) w->wall_pending[node] = await_walls(w, node, x, v);
    }
    if (m->has_moving_walls) settle_walls(w, sums);
}

void step_walls_forces(Workspace *w)
{
    int walls = w->model->wall_count;
    double per_time = w->plan.dt_mean > 0.0 ? 1.0 / w->plan.dt_mean : 0.0;
    memset(w->wall_force, 0, 4 * (size_t)walls * sizeof *w->wall_force);
    for (int c = 0; c <= w->node_chunk_count; c++)
        for (int i = 0; i < walls; i++) {
            const WallSums *sums = w->wall_sums + (ptrdiff_t)c * walls + i;
            for (int k = 0; k < 3; k++) w->wall_force[4 * i + k] += per_time * sums->impulse[k];
            w->wall_force[4 * i + 3] += per_time * sums->normal;
        }
}
