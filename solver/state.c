/* The State buffer: layout, start, hash. */
#include "solver/state.h"

#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/memory.h"
#include "solver/reference_work.h"
#include "solver/step_links.h"

/* Hands out aligned pieces of the buffer; with a NULL base it only counts. */
static void *take(unsigned char *base, size_t *used, size_t bytes)
{
    size_t start = (*used + 63) / 64 * 64;
    *used = start + bytes;
    return base ? base + start : NULL;
}

/* What contact remembers, from the byte used on; returns the byte after it. */
static size_t lay_out_contact(const Model *model, State *state, unsigned char *base, size_t used)
{
    size_t nodes = (size_t)model->node_count;
    state->contact = take(base, &used, sizeof *state->contact);
    state->contact_formed = take(base, &used, 3 * nodes * sizeof *state->contact_formed);
    state->contact_load = take(base, &used, 2 * nodes * sizeof *state->contact_load);
    state->contact_memory = take(base, &used, model->contact_memory_size * sizeof *state->contact_memory);
    state->entity_memory = take(base, &used, model->entity_probe_count * sizeof *state->entity_memory);
    state->contact_memories = take(base, &used, (size_t)model->contact_count * sizeof *state->contact_memories);
    return used;
}

static size_t lay_out(const Model *model, State *state)
{
    size_t used = 0, nodes = (size_t)model->node_count;
    unsigned char *base = state->buffer;
    state->clock = take(base, &used, sizeof *state->clock);
    state->energy = take(base, &used, sizeof *state->energy);
    state->x = take(base, &used, (3 * nodes + 1) * sizeof *state->x);
    state->v = take(base, &used, (3 * nodes + 1) * sizeof *state->v);
    state->history = take(base, &used, model->history_size * sizeof *state->history);
    const size_t accounts = model->has_accounts ? ACCOUNT_SIZE * (size_t)model->padded_count : 0;
    state->account = take(base, &used, accounts * sizeof *state->account);
    state->chunk_energy = take(base, &used, (size_t)model->chunk_count * sizeof *state->chunk_energy);
    state->accounts_open = take(base, &used, (size_t)model->chunk_count * sizeof *state->accounts_open);
    state->gas = take(base, &used, (size_t)model->airbag_count * sizeof *state->gas);
    state->part_energy = take(base, &used, (size_t)model->part_count * sizeof *state->part_energy);
    state->part_hourglass = take(base, &used, (size_t)model->part_count * sizeof *state->part_hourglass);
    state->group_energy = take(base, &used, (size_t)model->group_count * sizeof *state->group_energy);
    state->cap_volume = take(base, &used, (size_t)model->airbag_count * sizeof *state->cap_volume);
    state->part_area = take(base, &used, (size_t)model->bag_part_count * sizeof *state->part_area);
    state->part_blocked = take(base, &used, (size_t)model->bag_part_count * sizeof *state->part_blocked);
    size_t shares = model->blockage ? (size_t)model->element_count : 0;
    state->contact_share = take(base, &used, shares * sizeof *state->contact_share);
    state->rigid = take(base, &used, (size_t)model->rigid_body_count * sizeof *state->rigid);
    state->link_energy = take(base, &used, (size_t)model->link_count * sizeof *state->link_energy);
    state->link_peak = take(base, &used, (size_t)model->link_count * sizeof *state->link_peak);
    state->seam_torn = take(base, &used, (size_t)model->seam_count * sizeof *state->seam_torn);
    state->tie_broken = take(base, &used, (size_t)model->ties.count * sizeof *state->tie_broken);
    const bool erodes = model->has_erosion;
    state->eroded = take(base, &used, erodes ? (size_t)model->padded_count : 0);
    state->eroded_count = take(base, &used, erodes ? sizeof *state->eroded_count : 0);
    state->part_eroded = take(base, &used, erodes ? (size_t)model->bag_part_count * sizeof *state->part_eroded : 0);
    state->wall = take(base, &used, (size_t)model->wall_count * sizeof *state->wall);
    state->wall_side = take(base, &used, (size_t)model->wall_count * (size_t)model->moving_count);
    state->sensor = take(base, &used, (size_t)model->sensor_count * sizeof *state->sensor);
    state->jet = take(base, &used, (size_t)model->jet_count * sizeof *state->jet);
    state->jet_shape = take(base, &used, (size_t)model->jet_facet_count * sizeof *state->jet_shape);
    state->jet_weight = take(base, &used, (size_t)model->jet_row_count * sizeof *state->jet_weight);
    state->reference =
        take(base, &used, (model->has_reference ? (size_t)model->group_count : 0) * sizeof *state->reference);
    state->reached = take(base, &used, model->liner_waits ? (size_t)model->padded_count : 0);
    if (model_has_contact(model)) used = lay_out_contact(model, state, base, used);
    return (used + 63) / 64 * 64;
}

size_t state_size(const Model *model)
{
    State none = {0};
    return lay_out(model, &none);
}

void state_bind(const Model *model, State *state)
{
    lay_out(model, state);
}

/* References that act from the start, and the elements that are taut in them. */
static void start_references(const Model *model, State *state)
{
    for (int g = 0; model->has_reference && g < model->group_count; g++) {
        const ElementGroup *group = &model->groups[g];
        state->reference[g] = (ReferenceState){group->birth <= 0.0, 1.0, 1.0};
        for (int64_t e = 0; group->rule.liner_waits && state->reference[g].born && e < group->element_count; e++)
            state->reached[group->first_element + e] =
                reference_is_taut(group, group->geometry + lane_offset(group, e), state->x, e);
    }
}

/* Volume and area of every bag at the initial positions, with the very kernels of the step. */
static int initial_volumes(const Model *model, State *state, double *volume, double *area)
{
    const KernelTable *kernels = kernels_select(NULL);
    ReferenceWork reference;
    if (!kernels || reference_work_create(model, state, &reference)) return -1;
    for (int i = 0; i < model->airbag_count; i++)
        volume[i] = state->cap_volume[i] = surface_cap_volume(&model->airbags[i].closure, state->x, model->origin);
    for (int g = 0; g < model->group_count; g++) {
        const ElementGroup *group = &reference.groups[g];
        ChunkSums sums = {0};
        KernelInput input = {.group = group,
                             .end_block = group->block_count,
                             .x = state->x,
                             .origin = model->origin,
                             .history = state->history,
                             .restart_ledger = true};
        kernels_for(kernels, group)(&input, &sums);
        if (law_stores_energy(group->law, &group->material)) {
            state->group_energy[g] = sums.energy;
            state->part_energy[group->part] += sums.energy;
        } else if (group->has_reference) {
            for (int64_t e = 0; e < group->element_count; e++)
                state->part_energy[group->part] +=
                    reference_energy(group, group->geometry + lane_offset(group, e), state->x, e);
        }
        if (group->law != LAW_SURFACE) state->part_hourglass[group->part] += sums.hourglass;
        if (group->pressure_set < 0) continue;
        const PressureSet *set = &model->pressure_sets[group->pressure_set];
        for (int s = 0; s < set->count; s++) {
            if (set->source[s] >= model->airbag_count) continue;
            volume[set->source[s]] += set->sign[s] * sums.volume;
            area[set->source[s]] += sums.area;
        }
    }
    reference_work_free(model, &reference);
    return 0;
}

static int start_gas(const Model *model, State *state)
{
    double *volume = memory_alloc((size_t)model->airbag_count + 1, sizeof *volume);
    double *area = memory_alloc((size_t)model->airbag_count + 1, sizeof *area);
    int status = volume && area ? initial_volumes(model, state, volume, area) : -1;
    const char *why; /* an impossible state was reported by the build */
    for (int i = 0; !status && i < model->airbag_count; i++) {
        const Airbag *bag = &model->airbags[i];
        status = gas_initialize(&bag->gas, model->curves, bag->vsca, bag->psca, bag->vini, volume[i], area[i],
                                &state->gas[i], &why);
    }
    memory_free(volume);
    memory_free(area);
    return status;
}

/* The inflow of bags with a sensor waits for it. */
static void start_sensors(const Model *model, State *state)
{
    for (int i = 0; i < model->sensor_count; i++) {
        int body = model->sensors[i].rigid_body;
        int airbag = model->sensor_airbag[i];
        gas_sleep(&model->airbags[airbag].gas, &state->gas[airbag]);
        if (body >= 0) memcpy(state->sensor[i].start, state->rigid[body].v, sizeof state->sensor[i].start);
    }
}

static void start_energies(const Model *model, State *state)
{
    Energies *e = state->energy;
    for (int i = 0; i < model->node_count; i++) {
        const double *v = state->v + 3 * (ptrdiff_t)i;
        e->kinetic += 0.5 * model->mass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    for (int b = 0; b < model->rigid_body_count; b++) { /* a body's inertia may be a card's */
        const RigidBody *body = &model->rigid_bodies[b];
        for (int k = 0; k < body->node_count; k++) {
            const double *v = state->v + 3 * (ptrdiff_t)body->node[k];
            e->kinetic -= 0.5 * model->mass[body->node[k]] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        }
        e->kinetic += state->rigid[b].kinetic;
    }
    for (int w = 0; w < model->wall_count; w++)
        e->kinetic += 0.5 * model->walls[w].mass * model->walls[w].speed * model->walls[w].speed;
    if (model->implicit.element_count > 0)
        e->kinetic += 0.5 * implicit_elements_inertia(&model->implicit, model->mass, state->v, state->v).uu;
    for (int p = 0; p < model->part_count; p++) {
        e->internal += state->part_energy[p];
        e->hourglass += state->part_hourglass[p];
    }
    e->initial = e->kinetic + e->internal + e->hourglass;
    e->largest = fabs(e->initial);
    e->ratio = e->ratio_min = e->ratio_max = 1.0;
}

void state_start_energies(const Model *model, const double *stored, State *state)
{
    for (int g = 0; g < model->group_count; g++) /* what the kernels have counted is there already */
        if (model->groups[g].part >= 0 && state->group_energy[g] == 0.0 && !model->groups[g].has_reference)
            state->part_energy[model->groups[g].part] += stored[g];
    *state->energy = (Energies){0};
    start_energies(model, state);
}

int state_start_at(const Model *model, const double *x, State *state)
{
    memset(state->buffer, 0, state->size);
    memcpy(state->x, x, 3 * (size_t)model->node_count * sizeof *state->x);
    if (model->velocity) memcpy(state->v, model->velocity, 3 * (size_t)model->node_count * sizeof *state->v);
    for (int i = 0; i < model->rigid_body_count; i++) rigid_body_start(&model->rigid_bodies[i], &state->rigid[i]);
    for (int i = 0; i < model->wall_count; i++) state->wall[i].speed = model->walls[i].speed;
    start_references(model, state);
    for (int i = 0; i < model->seam_count; i++) state->seam_torn[i] = -1.0;
    for (int i = 0; i < model->ties.count; i++) state->tie_broken[i] = -1.0;
    if (start_gas(model, state)) {
        state_free(state);
        return -1;
    }
    links_act(model, state, NULL);
    start_sensors(model, state);
    start_energies(model, state);
    return 0;
}

int state_create(const Model *model, State *state)
{
    *state = (State){.size = state_size(model)};
    state->buffer = memory_alloc(state->size, 1);
    if (!state->buffer) return -1;
    state_bind(model, state);
    return state_start_at(model, model->initial, state);
}

uint64_t state_hash(const State *state)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i + 8 <= state->size; i += 8) {
        uint64_t word;
        memcpy(&word, state->buffer + i, sizeof word);
        hash = (hash ^ word) * 0x100000001b3u;
        hash ^= hash >> 29; /* words instead of bytes: the shift spreads the high bits */
    }
    return hash;
}

void state_free(State *state)
{
    memory_free(state->buffer);
    *state = (State){0};
}
