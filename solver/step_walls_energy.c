/* The energy ledger's share of rigid walls: what the node loops have summed with Newton's velocities is corrected for
 * the nodes that a wall has stopped (W10). */
#include "solver/step_walls.h"
#include "solver/vector3.h"

/* Area vector of a free node: sum over its corners in element order. */
static void gather_area(const Workspace *w, int node, double s[3])
{
    const Model *m = w->model;
    s[0] = s[1] = s[2] = 0.0;
    for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++)
        for (int c = 0; c < 3; c++) s[c] += w->rows[ROW_SIZE * (ptrdiff_t)m->node_row[k] + ROW_AREA + c];
}

/* Mass damping and stagnation pressure act on the mean velocity. */
static double damping_change(const Workspace *w, int node, const double before[3], const double free_v[3],
                             const double change[3], const double s[3])
{
    const Model *m = w->model;
    int class = m->node_class ? m->node_class[node] : 0;
    double sum = 0.0, area2 = vector3_dot(s, s), normal = vector3_dot(s, before);
    for (int k = 0; k < 3; k++) {
        double mean = 0.5 * (before[k] + free_v[k]);
        double drag = w->class_damping[3 * class + k] * (mean - w->class_velocity[3 * class + k]);
        sum += m->mass[node] * drag * 0.5 * change[k];
    }
    if (area2 > 0.0) {
        double speed = normal < 0.0 ? -normal : normal;
        sum += w->stagnation[m->node_pressure[node]] * normal * speed / area2 * 0.5 * vector3_dot(s, change);
    }
    return sum * w->plan.dt_mean;
}

void step_walls_account(Workspace *w, int node, const double before[3], const double free_v[3], NodeSums *sums)
{
    const Model *m = w->model;
    const double *v = w->state->v + 3 * (ptrdiff_t)node;
    double mass = m->mass[node], share = w->plan.dt_mean > 0.0 ? 0.5 * w->plan.dt_before / w->plan.dt_mean : 0.0;
    double change[3], s[3], kinetic = 0.0;
    int set = m->node_pressure[node], class = m->node_class ? m->node_class[node] : 0;
    vector3_subtract(v, free_v, change);
    if (change[0] == 0.0 && change[1] == 0.0 && change[2] == 0.0) return;
    gather_area(w, node, s);
    sums->stopped += 0.5 * mass * vector3_dot(change, change);
    for (int k = 0; k < 3; k++) {
        double old = before[k] + share * (free_v[k] - before[k]), full = before[k] + share * (v[k] - before[k]);
        kinetic += 0.5 * mass * (full * full - old * old);
        sums->kinetic_steps += 0.5 * mass * before[k] * change[k];
        sums->support_before += mass * change[k] * before[k];
        sums->support_after += mass * change[k] * (w->plan.dt_before > 0.0 ? v[k] : 0.5 * (before[k] + v[k]));
        sums->load_after += mass * w->class_gravity[3 * class + k] * change[k];
        if (!w->plan.emit) continue;
        double acceleration = w->plan.dt_mean > 0.0 ? change[k] / w->plan.dt_mean : 0.0;
        w->acceleration[3 * node + k] += acceleration;
        w->velocity[3 * node + k] += share * change[k];
        w->force[3 * node + k] += mass * acceleration;
    }
    sums->kinetic += kinetic;
    sums->bag_after += w->bag_pressure[set] * vector3_dot(s, change);
    sums->load_after += w->load_pressure[set] * vector3_dot(s, change);
    if (w->general) sums->damping += damping_change(w, node, before, free_v, change, s);
}
