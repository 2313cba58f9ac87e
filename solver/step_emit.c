/* The full-step view of one cycle for the writers. */
#include <math.h>
#include <string.h>

#include "contact/entity_loop.h"
#include "solver/memory.h"
#include "solver/workspace.h"

/* Kinetic energy and momentum of the parts from the elements' share of mass. */
static void sum_parts(Workspace *w)
{
    const Model *m = w->model;
    memset(w->part_kinetic, 0, (size_t)m->part_count * sizeof(double));
    memset(w->part_momentum, 0, 3 * (size_t)m->part_count * sizeof(double));
    for (int e = 0; e < m->element_count; e++) {
        const int32_t *node = m->element_node + 4 * (ptrdiff_t)e;
        int corners = node[3] == node[2] ? 3 : 4, part = m->element_part[e];
        double share = m->element_mass[e] / corners;
        for (int a = 0; a < corners; a++) {
            const double *v = w->velocity + 3 * (ptrdiff_t)node[a];
            w->part_kinetic[part] += 0.5 * share * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            for (int k = 0; k < 3; k++) w->part_momentum[3 * part + k] += share * v[k];
        }
    }
    for (int i = 0; i < m->solid_count; i++) {
        const Solid *solid = &m->solids[i];
        for (int a = 0; a < 8; a++) {
            const double *v = w->velocity + 3 * (ptrdiff_t)solid->node[a];
            w->part_kinetic[solid->part] += 0.5 * solid->share[a] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            for (int k = 0; k < 3; k++) w->part_momentum[3 * solid->part + k] += solid->share[a] * v[k];
        }
    }
    for (int i = 0; i < m->point_mass_count; i++) {
        const PointMass *point = &m->point_masses[i];
        const double *v = w->velocity + 3 * (ptrdiff_t)point->node;
        if (point->part < 0) continue;
        w->part_kinetic[point->part] += 0.5 * point->mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        for (int k = 0; k < 3; k++) w->part_momentum[3 * point->part + k] += point->mass * v[k];
    }
    for (int p = 0; p < m->part_count; p++) { /* what a card gives goes before what the nodes have */
        int b = m->parts[p].rigid_body;
        if (b < 0 || !m->rigid_bodies[b].given || m->rigid_bodies[b].part_id != m->parts[p].id) continue;
        w->part_kinetic[p] = w->state->rigid[b].kinetic;
        for (int k = 0; k < 3; k++)
            w->part_momentum[3 * p + k] = m->rigid_bodies[b].mass * w->state->rigid[b].output.v[k];
    }
}

/* The element with the largest frequency: its chunk is run once more, its histories kept. */
static int find_critical(Workspace *w)
{
    const Model *m = w->model;
    if (m->deformable_count == 0) return -1;
    const ElementGroup *group = &w->reference.groups[w->critical_group];
    int first = (w->critical_chunk - group->first_chunk) * BILLOW_CHUNK, end = first + BILLOW_CHUNK;
    if (end > group->block_count) end = group->block_count;
    size_t per_block = (size_t)group->history_size * BILLOW_LANES, size = (size_t)(end - first) * per_block;
    double *history = w->state->history + group->history_offset + (size_t)first * per_block;
    memcpy(w->kept_history, history, size * sizeof *history);
    KernelInput input = {.group = group,
                         .first_block = first,
                         .end_block = end,
                         .x = w->state->x,
                         .origin = m->origin,
                         .history = w->state->history,
                         .lane_rate = w->lane_rate};
    ChunkSums sums = {0};
    kernels_for(w->kernels, group)(&input, &sums);
    memcpy(history, w->kept_history, size * sizeof *history);
    if (group->has_reference && w->state->reference[w->critical_group].born)
        reference_rate(group, group->geometry, first, end, w->state->x, w->lane_rate);
    int critical = -1;
    double largest = 0.0;
    int64_t from = group->first_element + (int64_t)first * BILLOW_LANES,
            to = group->first_element + (int64_t)end * BILLOW_LANES;
    for (int e = 0; e < m->element_count; e++) {
        if (m->element_slot[e] < from || m->element_slot[e] >= to) continue;
        double rate = w->lane_rate[m->element_slot[e] - from];
        if (rate > largest) {
            largest = rate;
            critical = e;
        }
    }
    return critical;
}

void step_emit(Workspace *w)
{
    const Model *m = w->model;
    if (w->contact) {
        contact_sum(w->contact);
        contact_store(w->contact);
    }
    if (!w->failure->failed) step_close_energies(w);
    sum_parts(w);
    if (m->wall_count > 0) step_walls_forces(w);
    StepView view = {.x = w->state->x,
                     .v = w->velocity,
                     .a = w->acceleration,
                     .f = w->force,
                     .part_kinetic = w->part_kinetic,
                     .part_momentum = w->part_momentum,
                     .wall_force = w->wall_force,
                     .contact = w->contact ? w->contact->corner : NULL,
                     .resultant = w->contact ? w->contact->resultant : NULL,
                     .entity = m->entity_count > 0 ? w->contact->entities->resultant : NULL,
                     .element_step = w->element_step,
                     .critical_element = find_critical(w)};
    w->plan.stop = w->hooks->emit(w->hooks->user, m, w->state, &view, w->plan.last) != 0;
}
