/* Between the passes: sums over elements, gas of every bag, pressures, the next step. */
#include <math.h>
#include <stddef.h>

#include "solver/step_accounts.h"
#include "solver/step_dampers.h"
#include "solver/step_erosion.h"
#include "solver/step_links.h"
#include "solver/workspace.h"

/* Chunk sums -> parts and pressure sets, in chunk order. Laws with a stored energy give its value, those with a
 * stress-work ledger its increment. */
static double sum_chunks(Workspace *w)
{
    const Model *m = w->model;
    State *state = w->state;
    double rate = 0.0, stored_change = 0.0, largest = -1.0;
    for (int s = 0; s < m->pressure_set_count; s++) w->set_volume[s] = w->set_area[s] = 0.0;
    for (int p = 0; p < m->part_count; p++) state->part_hourglass[p] = 0.0;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        int chunks = (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK;
        ChunkSums sum = {0};
        for (int c = 0; c < chunks; c++) {
            const ChunkSums *chunk = &w->chunks[group->first_chunk + c];
            sum.volume += chunk->volume;
            sum.area += chunk->area;
            sum.energy += chunk->energy;
            sum.viscous += chunk->viscous;
            sum.hourglass += chunk->hourglass;
            sum.rate = chunk->rate > sum.rate || chunk->rate != chunk->rate ? chunk->rate : sum.rate;
            if (chunk->rate > largest) {
                largest = chunk->rate;
                w->critical_chunk = group->first_chunk + c;
                w->critical_group = g;
            }
        }
        w->group_area[g] = sum.area;
        if (group->pressure_set >= 0) {
            w->set_volume[group->pressure_set] += sum.volume;
            w->set_area[group->pressure_set] += sum.area;
        }
        if (group->law == LAW_SURFACE) continue;
        if (!law_stores_energy(group->law, &group->material)) {
            state->part_energy[group->part] += sum.energy;
        } else {
            double change = sum.energy - state->group_energy[g];
            state->part_energy[group->part] += change;
            for (int c = 0; group->has_reference && c < chunks; c++)
                change -= w->reference_jump[group->first_chunk + c].energy;
            if (group->has_history && state->clock->cycle > 0) stored_change += sum.viscous - change;
            state->group_energy[g] = sum.energy;
        }
        state->part_hourglass[group->part] += sum.hourglass;
        /* stiffness-proportional damping shortens the stable step: 2/w (sqrt(1 + z^2) - z) (eq. T7) */
        double z = group->material.damping, shorter = sqrt(1.0 + z * z) - z;
        double effective = sum.rate / (shorter * shorter);
        rate = effective > rate || effective != effective ? effective : rate;
    }
    state->energy->material_damping += stored_change;
    if (m->has_reference) state->energy->external_half += step_reference_advance(w);
    return rate;
}

/* Pressure sources at time t_n, then the net pressure of each set. */
static void set_pressures(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; i < m->airbag_count; i++) w->source_pressure[i] = w->state->gas[i].applied;
    for (int i = 0; i < m->segment_load_count; i++)
        w->source_pressure[m->airbag_count + i] = loads_segment_pressure(&m->segment_loads[i], m->curves, w->plan.time);
    for (int s = 0; s < m->pressure_set_count; s++) {
        const PressureSet *set = &m->pressure_sets[s];
        w->bag_pressure[s] = w->load_pressure[s] = w->stagnation[s] = 0.0;
        for (int k = 0; k < set->count; k++) {
            int source = set->source[k];
            if (source >= m->airbag_count) {
                w->load_pressure[s] += set->push[k] * w->source_pressure[source];
                continue;
            }
            w->bag_pressure[s] += set->push[k] * w->source_pressure[source];
            if (set->push[k] != 0) w->stagnation[s] += m->airbags[source].spsf * m->airbags[source].gas.ambient_density;
        }
    }
}

/* Body classes at t_n, and the mean velocities that mass-weighted damping refers to (eq. T5). */
static void set_classes(Workspace *w)
{
    const Model *m = w->model;
    for (int c = 0; c < m->loads.class_count; c++) {
        const BodyClass *class = &m->loads.classes[c];
        double *velocity = w->class_velocity + 3 * c;
        loads_class_at(class, m->curves, w->plan.time, w->class_gravity + 3 * c, w->class_damping + 3 * c);
        if (class->airbag < 0) continue;
        const Airbag *bag = &m->airbags[class->airbag];
        double mass = 0.0, momentum[3] = {0};
        for (int i = 0; i < bag->node_count; i++) {
            int node = bag->node[i];
            mass += m->mass[node];
            for (int k = 0; k < 3; k++) momentum[k] += m->mass[node] * w->state->v[3 * node + k];
        }
        for (int k = 0; k < 3; k++) {
            double other = w->class_damping[3 * c + k];
            velocity[k] = mass > 0.0 ? momentum[k] / mass : 0.0;
            /* both dampings in one: the mean of their references, weighted */
            w->class_damping[3 * c + k] += class->airbag_damping;
            if (w->class_damping[3 * c + k] > 0.0)
                velocity[k] *= class->airbag_damping / (other + class->airbag_damping);
        }
    }
}

/* A step that resolves the gas when no element asks for one: its own time scale, and a thousandth of the period scale
 * of walls that move on it. */
static double gas_step(Workspace *w, double gas_rate)
{
    const Model *m = w->model;
    double step = m->end_time / 1000.0, own = step_bags_scale(w);
    step = own < step ? own : step;
    if (gas_rate > 0.0 && 0.001 / sqrt(gas_rate) < step) step = 0.001 / sqrt(gas_rate);
    double intervals[] = {m->output.states, m->output.glstat, m->output.abstat, m->output.nodout};
    for (int i = 0; i < 4; i++)
        if (intervals[i] > 0.0 && intervals[i] / 10.0 < step) step = intervals[i] / 10.0;
    for (int i = 0; i < m->curve_count; i++) {
        double corner = curve_next_corner(&m->curves[i], w->plan.time) - w->plan.time;
        if (m->airbag_count == 0 && corner > 1e-9 * m->end_time && corner < step) step = corner;
    }
    return step;
}

/* The stable step: elements, then gas (eq. T6, T8), then what the deck limits. */
static int choose_step(Workspace *w, double rate)
{
    const Model *m = w->model;
    Clock *clock = w->state->clock;
    double stiffness = 0.0, left = m->end_time - clock->time;
    for (int i = 0; i < m->airbag_count; i++)
        stiffness = w->state->gas[i].stiffness > stiffness ? w->state->gas[i].stiffness : stiffness;
    double gas_rate = stiffness * clock->compliance;
    if (!isfinite(rate) || !isfinite(gas_rate)) {
        step_fail(w, "look at the last state written; lower TSSFAC, or check loads and contact there",
                  "forces or positions are not finite");
        return -1;
    }
    if (m->link_count > 0) rate += links_rate(m, w->state->x);
    if (m->damper_count > 0) rate = dampers_rate(m, rate);
    w->element_step = rate > 0.0 ? 2.0 / sqrt(rate) : 0.0;
    double step = rate > 0.0 ? m->step_scale * 2.0 / sqrt(rate) : 0.0;
    if (!(m->deformable_count > 0 && step > 0.0)) {
        double slow = gas_step(w, gas_rate);
        step = step > 0.0 && step < slow ? step : slow;
    }
    if (clock->cycle == 0 && m->step_initial > 0.0 && m->step_initial < step) step = m->step_initial;
    if (m->step_limit_curve >= 0) {
        double limit = curve_value(&m->curves[m->step_limit_curve], clock->time);
        if (limit > 0.0 && limit < step) step = limit;
    }
    if (clock->cycle == 0) clock->step_first = step;
    if (m->deformable_count > 0 && (step < clock->step_first * 1e-6 || step < m->step_minimum * clock->step_first)) {
        step_fail(w,
                  "an element has collapsed or is stretched far beyond its size; look at it in the last state, or add "
                  "mass with DT2MS",
                  "the time step fell to %g from %g", step, clock->step_first);
        return -1;
    }
    /* the end is met exactly, by a last step that is not less than half of the others */
    if (!w->plan.last && step >= left * (1.0 - 1e-9))
        step = left;
    else if (!w->plan.last && 1.5 * step > left)
        step = 0.5 * left;
    clock->step_next = w->plan.dt_next = step;
    /* at the start the compliance is not known yet */
    w->plan.implicit_gas = m->airbag_count > 0 && m->deformable_count > 0 &&
                           (clock->cycle == 0 || gas_rate * step * step > BILLOW_EXPLICIT_GAS);
    return 0;
}

void step_gas(Workspace *w)
{
    const Model *m = w->model;
    Clock *clock = w->state->clock;
    if (w->contact) contact_sum(w->contact);
    if (w->contact && w->contact->out_of_memory)
        step_fail(w, "use a smaller mesh or a machine with more memory", "no memory for the pairs in contact");
    if (!w->closed) step_close_energies(w);
    if (w->failure->failed) return;
    w->plan.time = clock->time;
    w->plan.dt_before = clock->step;
    double rate = sum_chunks(w);
    if (m->has_accounts) step_accounts_sum(w);
    if (step_bags(w)) return;
    if (m->has_erosion) step_erosion_close(w);
    if (m->sensor_count > 0) step_sensors(w);
    set_pressures(w);
    if (m->loads.class_count > 0) set_classes(w);
    w->plan.last = clock->time >= m->end_time || (m->end_cycle > 0 && clock->cycle >= m->end_cycle);
    if (choose_step(w, rate)) return;
    if (m->has_reference) step_reference_shorten(w);
    w->plan.dt_mean = 0.5 * (w->plan.dt_before + w->plan.dt_next);
    w->plan.emit = w->hooks->due(w->hooks->user, m, w->state, w->plan.last) || w->plan.last;
    w->plan.node_advance = w->plan.emit || m->wall_count > 0 ? 0.0 : w->plan.dt_next;
    w->closed = w->plan.emit;
    if (m->wall_count > 0) step_walls_begin(w);
    if (w->jets) step_jets_prepare(w);
    if (!w->plan.emit) step_tick(w);
}
