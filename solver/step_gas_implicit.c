/* The gas of a nearly empty bag is far stiffer than its walls: its pressure is then taken at the mean volume of the
 * step, which bounds the frequency of the breathing mode for any step (docs/theory.md, Time integration, eq. T9 to
 * T11).
 *
 * With k = -dp/dV, s the area vectors and M the masses, (M + b dt^2 k s s^T) a = f, b = 1/4, is solved by one scalar:
 * a = M^-1 (f + dp s), dp = -b dt^2 k (s.M^-1 f) / (1 + b dt^2 k s.M^-1 s). At rest dp = 0. */
#include "solver/rate_rows.h"
#include "solver/vector3.h"
#include "solver/workspace.h"

void step_node_force(const Workspace *w, int node, double f[3])
{
    const Model *m = w->model;
    f[0] = f[1] = f[2] = 0.0;
    for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++) {
        const double *force = w->rows + ROW_SIZE * (ptrdiff_t)m->node_row[k], *share = force + ROW_AREA;
        int set = m->row_set[m->node_row[k]];
        double pressure = set < 0 ? 0.0 : w->bag_pressure[set] + w->load_pressure[set];
        if (m->has_fluid && set >= 0) pressure += step_hydrostatic(w, set, w->state->x + 3 * (ptrdiff_t)node);
        for (int i = 0; i < 3; i++) f[i] += force[i] + pressure * share[i];
    }
}

/* The area vector of a node in a bag's pressure. */
static void node_area(const Workspace *w, int node, int bag, double s[3])
{
    const Model *m = w->model;
    s[0] = s[1] = s[2] = 0.0;
    for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++) {
        int row = m->node_row[k];
        if (m->row_set[row] < 0) continue;
        const PressureSet *set = &m->pressure_sets[m->row_set[row]];
        const double *share = w->rows + ROW_SIZE * (ptrdiff_t)row + ROW_AREA;
        for (int j = 0; j < set->count; j++)
            for (int i = 0; set->source[j] == bag && i < 3; i++) s[i] += set->push[j] * share[i];
    }
}

/* Adds one node's share to every bag that presses on it; the directions in which it is held take no part. */
static void add_node(const Workspace *w, int node, const RateRows *held, GasPass *bags)
{
    double f[3], inverse = w->model->inverse_mass[node];
    step_node_force(w, node, f);
    if (held) rate_rows_apply(held, f);
    for (int b = 0; b < w->model->airbag_count; b++) {
        double s[3];
        node_area(w, node, b, s);
        if (held) rate_rows_apply(held, s);
        bags[b].compliance += (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) * inverse;
        bags[b].opening += (s[0] * f[0] + s[1] * f[1] + s[2] * f[2]) * inverse;
    }
}

/* Directions in which a rigid body is held or driven now. */
static void held_rates(const Workspace *w, int index, RateRows *translation, RateRows *rotation)
{
    const RigidBody *body = &w->model->rigid_bodies[index];
    const CyclePlan *plan = &w->plan;
    RigidPrescription driven = {0};
    rigid_body_prescribe(&w->model->constraints, index, body, &w->state->rigid[index], w->model->curves, plan->time,
                         plan->dt_mean, plan->dt_next, &driven);
    for (int k = 0; k < driven.count; k++)
        rate_rows_add(driven.item[k].rotation ? rotation : translation, driven.item[k].direction, 0.0);
    for (int i = 0; i < 3; i++) {
        if (body->fix_translation[i]) rate_rows_add(translation, body->constraint_axes + 3 * i, 0.0);
        if (body->fix_rotation[i]) rate_rows_add(rotation, body->constraint_axes + 3 * i, 0.0);
    }
}

/* A rigid body moves as a whole: its share is that of its resultants (eq. T10a). */
static void add_body(const Workspace *w, int index, GasPass *bags)
{
    const RigidBody *body = &w->model->rigid_bodies[index];
    const RigidState *state = &w->state->rigid[index];
    RateRows translation = {0}, rotation = {0};
    double force[3] = {0}, moment[3] = {0}, turn[3];
    held_rates(w, index, &translation, &rotation);
    for (int k = 0; k < body->node_count; k++) {
        double f[3], arm[3], part[3];
        step_node_force(w, body->node[k], f);
        vector3_subtract(w->state->x + 3 * (ptrdiff_t)body->node[k], state->x, arm);
        vector3_cross(arm, f, part);
        for (int i = 0; i < 3; i++) {
            force[i] += f[i];
            moment[i] += part[i];
        }
    }
    rate_rows_apply(&translation, force);
    rate_rows_apply(&rotation, moment);
    for (int b = 0; b < w->model->airbag_count; b++) {
        double area[3] = {0}, turning[3] = {0};
        for (int k = 0; k < body->node_count; k++) {
            double s[3], arm[3], part[3];
            node_area(w, body->node[k], b, s);
            vector3_subtract(w->state->x + 3 * (ptrdiff_t)body->node[k], state->x, arm);
            vector3_cross(arm, s, part);
            for (int i = 0; i < 3; i++) {
                area[i] += s[i];
                turning[i] += part[i];
            }
        }
        rate_rows_apply(&translation, area);
        rate_rows_apply(&rotation, turning);
        rigid_body_spin_of(body, state, turning, turn);
        bags[b].compliance += vector3_dot(area, area) / body->mass + vector3_dot(turning, turn);
        bags[b].opening += vector3_dot(area, force) / body->mass + vector3_dot(moment, turn);
    }
}

/* Special nodes: those of bodies move with them, hanging ones with their ends. */
static void add_special(const Workspace *w, GasPass *bags)
{
    const Model *m = w->model;
    for (int b = 0; b < m->airbag_count; b++) bags[b] = (GasPass){0};
    for (int node = m->free_count; node < m->moving_count; node++) {
        RateRows held = {0};
        if (w->special_kind[node - m->free_count]) continue;
        constraints_held(&m->constraints, node, w->plan.time, &held);
        add_node(w, node, held.count ? &held : NULL, bags);
    }
    for (int i = 0; i < m->rigid_body_count; i++) add_body(w, i, bags);
}

static void add_range(const Workspace *w, int from, int to, GasPass *bags)
{
    for (int b = 0; b < w->model->airbag_count; b++) bags[b] = (GasPass){0};
    for (int node = from; node < to; node++) add_node(w, node, NULL, bags);
}

void step_gas_pass(Workspace *w, int thread, int threads)
{
    const Model *m = w->model;
    int chunks = w->node_chunk_count;
    int first = (int)((int64_t)chunks * thread / threads), end = (int)((int64_t)chunks * (thread + 1) / threads);
    for (int c = first; c < end; c++) {
        int from = c * BILLOW_NODE_CHUNK, to = from + BILLOW_NODE_CHUNK;
        add_range(w, from, to < m->free_count ? to : m->free_count, w->gas_pass + (ptrdiff_t)c * m->airbag_count);
    }
    if (thread == 0) add_special(w, w->gas_pass + (ptrdiff_t)chunks * m->airbag_count);
}

void step_gas_implicit(Workspace *w)
{
    const Model *m = w->model;
    double step = w->plan.dt_next;
    for (int b = 0; b < m->airbag_count; b++) {
        GasPass sum = {0};
        for (int c = 0; c <= w->node_chunk_count; c++) {
            const GasPass *pass = &w->gas_pass[(ptrdiff_t)c * m->airbag_count + b];
            sum.compliance += pass->compliance;
            sum.opening += pass->opening;
        }
        double stiffness = 0.25 * step * step * w->state->gas[b].stiffness;
        double change = -stiffness * sum.opening / (1.0 + stiffness * sum.compliance);
        for (int s = 0; s < m->pressure_set_count; s++) {
            const PressureSet *set = &m->pressure_sets[s];
            for (int j = 0; j < set->count; j++)
                if (set->source[j] == b) w->bag_pressure[s] += set->push[j] * change;
        }
    }
}
