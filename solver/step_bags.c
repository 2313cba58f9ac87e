/* The gas of all bags from t_{n-1} to t_n on the walls at t_n. */
#include <math.h>

#include "airbag/gas_pop.h"
#include "solver/step_erosion.h"
#include "solver/vector3.h"
#include "solver/workspace.h"

/* Volumes and areas of the bags, areas of the parts. */
static void measure_bags(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; i < m->airbag_count; i++) {
        double cap = surface_cap_volume(&m->airbags[i].closure, w->state->x, m->origin) + step_erosion_cover(w, i);
        w->bag_volume[i] = cap;
        w->bag_area[i] = 0.0;
        w->state->gas[i].cap_work += w->state->gas[i].applied * (cap - w->state->cap_volume[i]);
        w->state->cap_volume[i] = cap;
    }
    for (int s = 0; s < m->pressure_set_count; s++) {
        const PressureSet *set = &m->pressure_sets[s];
        for (int k = 0; k < set->count; k++) {
            if (set->source[k] >= m->airbag_count) continue;
            w->bag_volume[set->source[k]] += set->sign[k] * w->set_volume[s];
            w->bag_area[set->source[k]] += w->set_area[s];
        }
    }
}

static double element_area(const double *x, const int32_t *node)
{
    double u[3], v[3], n[3];
    for (int i = 0; i < 3; i++) {
        u[i] = x[3 * (ptrdiff_t)node[2] + i] - x[3 * (ptrdiff_t)node[0] + i];
        v[i] = x[3 * (ptrdiff_t)node[3] + i] - x[3 * (ptrdiff_t)node[1] + i];
    }
    vector3_cross(u, v, n);
    return 0.5 * sqrt(vector3_dot(n, n));
}

/* A quarter of a quadrilateral for each node in contact, a third of a triangle (eq. G48). */
static void measure_blocked(Workspace *w)
{
    const Model *m = w->model;
    for (int p = 0; p < m->part_count; p++) w->part_blocked[p] = 0.0;
    for (int e = 0; m->blockage && e < m->element_count; e++) {
        double share = w->state->contact_share[e];
        if (share > 0.0)
            w->part_blocked[m->element_part[e]] +=
                share * element_area(w->state->x, m->element_node + 4 * (ptrdiff_t)e);
    }
}

/* Areas of the parts, and of each bag's share of them. Of a part on several bags each has its share of what is blocked.
 */
static void measure_parts(Workspace *w)
{
    const Model *m = w->model;
    State *state = w->state;
    measure_blocked(w);
    for (int p = 0; p < m->part_count; p++) w->part_area[p] = 0.0;
    for (int k = 0; k < m->bag_part_count; k++) state->part_area[k] = 0.0;
    for (int g = 0; g < m->group_count; g++) {
        if (m->groups[g].part >= 0) w->part_area[m->groups[g].part] += w->group_area[g];
        for (int i = 0; i < m->airbag_count; i++) {
            int place = m->group_place[(ptrdiff_t)g * m->airbag_count + i];
            if (place >= 0) state->part_area[m->airbags[i].first_part + place] += w->group_area[g];
        }
    }
    for (int i = 0; i < m->airbag_count; i++) {
        const Airbag *bag = &m->airbags[i];
        for (int k = 0; k < bag->part_count; k++) {
            double whole = w->part_area[bag->part[k]], blocked = w->part_blocked[bag->part[k]];
            double *area = state->part_area + bag->first_part + k;
            state->part_blocked[bag->first_part + k] = whole > 0.0 ? blocked * (*area / whole) : 0.0;
        }
    }
}

static GasSide side_of(const Workspace *w, int bag)
{
    const Airbag *airbag = &w->model->airbags[bag];
    return (GasSide){&airbag->gas, &w->state->gas[bag], airbag->vsca, airbag->psca};
}

static double opening_of(const Workspace *w, const GasConnection *c)
{
    if (c->part < 0) return 0.0;
    return w->part_area[c->part] - (c->blocked ? w->part_blocked[c->part] : 0.0);
}

/* Exchange between connected bags over a span, in order or in the reverse. */
static void connect_bags(Workspace *w, double time, double span, bool reverse)
{
    const Model *m = w->model;
    for (int i = 0; i < m->connection_count; i++) {
        const GasConnection *c = &m->connections[reverse ? m->connection_count - 1 - i : i];
        gas_connect(c, m->curves, side_of(w, c->bag[0]), side_of(w, c->bag[1]), time, span, opening_of(w, c));
    }
}

/* FLUID_AND_GAS: the volume below the level that the card tells, or the one that was. */
static void measure_fluid(Workspace *w, double time, bool step)
{
    const Model *m = w->model;
    for (int i = 0; m->has_fluid && i < m->airbag_count; i++)
        if (gas_fluid_level(&m->airbags[i].gas, m->curves, time, step, &w->state->gas[i]) ||
            (!step && m->airbags[i].gas.kind == GAS_FLUID_AND_GAS && w->state->clock->cycle == 0 &&
             !gas_asleep(&m->airbags[i].gas, &w->state->gas[i])))
            w->fluid_volume[i] = step_fluid_volume(w, i, w->state->gas[i].fluid_level);
        else
            w->fluid_volume[i] = w->state->gas[i].fluid_volume;
    for (int i = 0; m->has_fluid && !step && i < m->airbag_count; i++)
        w->state->gas[i].fluid_volume = w->fluid_volume[i];
}

static int advance_bag(Workspace *w, int i, double time, double dt)
{
    const Airbag *bag = &w->model->airbags[i];
    GasStep step = {
        .time = time,
        .dt = dt,
        .volume = w->bag_volume[i],
        .area = w->bag_area[i],
        .fluid_volume = w->model->has_fluid ? w->fluid_volume[i] : 0.0,
        .areas = {w->state->part_area + bag->first_part, w->state->part_blocked + bag->first_part,
                  w->model->has_erosion ? w->state->part_eroded + bag->first_part : NULL},
    };
    const char *why = "";
    if (bag->function_count > 0) step_functions_select(w, i);
    if (!gas_advance(&bag->gas, w->curves, bag->vsca, bag->psca, bag->vini, &step, &w->state->gas[i], &why)) return 0;
    step_fail(w,
              "look at the last state written: walls that pass through each other or a step that is too large "
              "do this; lower TSSFAC, or close the bag",
              "airbag %d: %s (volume %g)", bag->id, why, w->bag_volume[i]);
    return -1;
}

/* A global vector along the principal axes of a body. */
static void to_local(const RigidBody *body, const RigidState *state, const double v[3], double local[3])
{
    double turn[9], initial[3];
    quaternion_matrix(state->rotation, turn);
    for (int i = 0; i < 3; i++) initial[i] = turn[i] * v[0] + turn[3 + i] * v[1] + turn[6 + i] * v[2];
    for (int i = 0; i < 3; i++)
        local[i] =
            body->axes[3 * i] * initial[0] + body->axes[3 * i + 1] * initial[1] + body->axes[3 * i + 2] * initial[2];
}

/* Option POP: the acceleration of a rigid body over the step before, in its local axes. */
static void sense_pop(Workspace *w, int i, double time, double dt)
{
    const Airbag *bag = &w->model->airbags[i];
    GasState *gas = &w->state->gas[i];
    if (bag->pop_part < 0 || gas->opened > 0.0) return;
    int number = w->model->parts[bag->pop_part].rigid_body;
    if (number < 0) return; /* it never moves */
    double local[3] = {0};
    to_local(&w->model->rigid_bodies[number], &w->state->rigid[number], w->state->rigid[number].a, local);
    gas_sense_pop(&bag->gas, local, time + dt, dt, gas);
}

/* Half of the exchange at the old volumes, each bag by itself, the other half at the new ones: Strang's splitting, as
 * within a bag (eq. G46). */
int step_bags(Workspace *w)
{
    double dt = w->plan.dt_before, time = w->plan.time - dt;
    measure_bags(w);
    measure_parts(w);
    measure_fluid(w, w->plan.time, dt > 0.0);
    for (int i = 0; i < w->model->airbag_count; i++) /* the values of all before any gas is advanced */
        if (w->model->airbags[i].function_count > 0 && step_functions_evaluate(w, i)) return -1;
    if (!(dt > 0.0)) return 0;
    connect_bags(w, time, 0.5 * dt, false);
    for (int i = 0; i < w->model->airbag_count; i++) sense_pop(w, i, time, dt);
    for (int i = 0; i < w->model->airbag_count; i++)
        if (advance_bag(w, i, time, dt)) return -1;
    connect_bags(w, time + 0.5 * dt, 0.5 * dt, true);
    for (int i = 0; w->model->has_fluid && i < w->model->airbag_count; i++)
        if (w->model->airbags[i].gas.kind == GAS_FLUID_AND_GAS) step_fluid_settle(w, i);
    return 0;
}

double step_bags_scale(Workspace *w)
{
    const Model *m = w->model;
    double scale = 1e20;
    for (int i = 0; i < m->airbag_count; i++) {
        if (m->airbags[i].function_count > 0) step_functions_select(w, i);
        double own = gas_time_scale(&m->airbags[i].gas, w->curves, &w->state->gas[i], w->plan.time);
        scale = own < scale ? own : scale;
    }
    for (int i = 0; i < m->connection_count; i++) {
        const GasConnection *c = &m->connections[i];
        double own = gas_connection_scale(c, m->curves, side_of(w, c->bag[0]), side_of(w, c->bag[1]), w->plan.time,
                                          opening_of(w, c));
        scale = own < scale ? own : scale;
    }
    return scale;
}
