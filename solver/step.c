/* The central-difference loop: one call per stage, as in docs/theory.md, Time integration. */
#define _POSIX_C_SOURCE 200809L
#include "solver/step.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "elements/membrane.h"
#include "solver/memory.h"
#include "solver/step_accounts.h"
#include "solver/step_erosion.h"
#include "solver/step_ties.h"
#include "solver/team.h"
#include "solver/workspace.h"

static double wall_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void step_fail(Workspace *w, const char *advice, const char *format, ...)
{
    if (w->failure->failed) return;
    char what[160];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    w->failure->failed = true;
    snprintf(w->failure->cause, sizeof w->failure->cause, "time %g, cycle %lld: %s", w->state->clock->time,
             (long long)w->state->clock->cycle, what);
    snprintf(w->failure->advice, sizeof w->failure->advice, "%s", advice);
}

/* One chunk: blocks of one group. */
static void run_chunk(Workspace *w, int number, int chunk)
{
    const Model *m = w->model;
    const ElementGroup *group = &w->reference.groups[number];
    int block = (chunk - group->first_chunk) * BILLOW_CHUNK, last = block + BILLOW_CHUNK;
    double step = w->state->clock->step;
    KernelInput input = {.group = group,
                         .first_block = block,
                         .end_block = last < group->block_count ? last : group->block_count,
                         .x = w->state->x,
                         .inverse_step = step > 0.0 ? 1.0 / step : 0.0,
                         .origin = m->origin,
                         .history = w->state->history,
                         .rows = w->rows,
                         .restart_ledger = w->state->clock->cycle == 0};
    step_accounts_use(w, chunk, &input);
    w->chunks[chunk] = (ChunkSums){0};
    if (group->has_reference && step_reference_changes(w, number))
        input.rows = NULL;
    else if (group->has_reference)
        step_reference_wake(w, number, chunk, &input);
    kernels_for(w->kernels, group)(&input, &w->chunks[chunk]);
    if (group->has_reference) step_reference_chunk(w, number, chunk, &input, &w->chunks[chunk]);
    if (m->ties.count > 0) step_ties_watch(w, number, chunk);
    if (m->has_erosion) step_erosion_chunk(w, number, chunk);
}

int step_group_of_chunk(const Model *m, int chunk)
{
    int g = 0;
    while (g + 1 < m->group_count && m->groups[g + 1].first_chunk <= chunk) g++;
    return g;
}

void step_elements(Workspace *w, int thread, int threads)
{
    const Model *m = w->model;
    for (int i = 0; i < m->segment_count; i++) {
        int s = m->segment_order[i], first = m->segment_chunk[s], end = m->segment_chunk[s + 1];
        if (step_segment_owner(w, i, threads) != thread) continue;
        const int group = step_group_of_chunk(m, first);
        memset(w->rows + ROW_SIZE * (ptrdiff_t)m->row_start[s], 0,
               ROW_SIZE * (size_t)(m->row_start[s + 1] - m->row_start[s]) * sizeof *w->rows);
        for (int c = first; c < end; c++) run_chunk(w, group, c);
    }
}

enum { WORKSPACE_BLOCKS = 41 };

/* All arrays of allocate. */
static void list_blocks(const Workspace *w, void *blocks[WORKSPACE_BLOCKS])
{
    void *all[] = {
        w->rows,         w->chunks,        w->node_sums,       w->bag_pressure,    w->load_pressure,  w->stagnation,
        w->set_volume,   w->set_area,      w->source_pressure, w->class_gravity,   w->class_damping,  w->class_velocity,
        w->bag_volume,   w->bag_area,      w->force,           w->before,          w->acceleration,   w->velocity,
        w->part_kinetic, w->part_momentum, w->special_kind,    w->lane_rate,       w->kept_history,   w->gas_pass,
        w->drag,         w->newton,        w->walls,           w->wall_sums,       w->wall_pending,   w->wall_force,
        w->group_area,   w->part_area,     w->part_blocked,    w->fluid_volume,    w->reference_jump, w->tie_strain,
        w->tie_volume,   w->implicit,      w->implicit_before, w->wall_body_force, w->wall_body_sum};
    _Static_assert(sizeof all / sizeof *all == WORKSPACE_BLOCKS, "one place for each array");
    memcpy(blocks, all, sizeof all);
}

static int allocate(Workspace *w)
{
    const Model *m = w->model;
    size_t nodes = 3 * (size_t)m->node_count, sets = (size_t)m->pressure_set_count + 1,
           bags = (size_t)m->airbag_count + 1, classes = 3 * (size_t)m->loads.class_count + 3,
           special = (size_t)(m->moving_count - m->free_count);
    w->node_chunk_count = (m->free_count + BILLOW_NODE_CHUNK - 1) / BILLOW_NODE_CHUNK;
    w->rows = memory_alloc(ROW_SIZE * ((size_t)m->row_count + 1), sizeof *w->rows);
    w->chunks = memory_alloc((size_t)m->chunk_count + 1, sizeof *w->chunks);
    w->node_sums = memory_alloc((size_t)w->node_chunk_count + 1, sizeof *w->node_sums);
    w->bag_pressure = memory_alloc(sets, sizeof(double));
    w->load_pressure = memory_alloc(sets, sizeof(double));
    w->stagnation = memory_alloc(sets, sizeof(double));
    w->set_volume = memory_alloc(sets, sizeof(double));
    w->set_area = memory_alloc(sets, sizeof(double));
    w->group_area = memory_alloc((size_t)m->group_count + 1, sizeof(double));
    w->part_area = memory_alloc((size_t)m->part_count + 1, sizeof(double));
    w->part_blocked = memory_alloc((size_t)m->part_count + 1, sizeof(double));
    w->source_pressure = memory_alloc(bags + (size_t)m->segment_load_count, sizeof(double));
    classes++; /* vector loads reach one value further */
    w->class_gravity = memory_alloc(classes, sizeof(double));
    w->class_damping = memory_alloc(classes, sizeof(double));
    w->class_velocity = memory_alloc(classes, sizeof(double));
    w->bag_volume = memory_alloc(bags, sizeof(double));
    w->bag_area = memory_alloc(bags, sizeof(double));
    w->fluid_volume = memory_alloc(bags, sizeof(double));
    w->force = memory_alloc(nodes, sizeof(double));
    w->acceleration = memory_alloc(nodes, sizeof(double));
    w->before = m->has_moving_walls ? memory_alloc(nodes, sizeof(double)) : w->acceleration;
    w->velocity = memory_alloc(nodes, sizeof(double));
    w->part_kinetic = memory_alloc((size_t)m->part_count + 1, sizeof(double));
    w->part_momentum = memory_alloc(3 * (size_t)m->part_count + 3, sizeof(double));
    w->lane_rate = memory_alloc((size_t)BILLOW_CHUNK * BILLOW_LANES, sizeof(double));
    size_t history = (size_t)history_size(4) + 4 * MEMORY_POINT_SIZE; /* of a quad at most */
    w->kept_history = memory_alloc((size_t)BILLOW_CHUNK * BILLOW_LANES * history, sizeof(double));
    w->special_kind = memory_alloc(special + 1, 1);
    w->drag = memory_alloc(3 * special + 1, sizeof(double));
    w->newton = memory_alloc(3 * special + 1, sizeof(double));
    if (reference_work_create(m, w->state, &w->reference)) return -1;
    w->reference_jump = memory_alloc(m->has_reference ? (size_t)m->chunk_count + 1 : 1, sizeof *w->reference_jump);
    w->tie_strain = memory_alloc((size_t)m->ties.slot_count + 1, sizeof(double));
    w->tie_volume = memory_alloc((size_t)m->ties.slot_count + 1, sizeof(double));
    w->gas_pass = memory_alloc(((size_t)w->node_chunk_count + 1) * bags, sizeof *w->gas_pass);
    w->implicit = memory_alloc(7 * (size_t)m->implicit.node_count + 1, sizeof(double));
    w->implicit_before = memory_alloc(m->implicit.node_count > 0 ? nodes : 1, sizeof(double));
    size_t walls = (size_t)m->wall_count;
    w->walls = memory_alloc(walls + 1, sizeof *w->walls);
    w->wall_sums = memory_alloc(walls * ((size_t)w->node_chunk_count + 1) + 1, sizeof *w->wall_sums);
    w->wall_pending = memory_alloc(m->has_moving_walls ? (size_t)m->moving_count + 1 : 1, 1);
    w->wall_force = memory_alloc(4 * walls + 1, sizeof(double));
    w->wall_body_force = memory_alloc(m->walls_push_bodies ? 3 * special + 1 : 1, sizeof(double));
    w->wall_body_sum = memory_alloc(4 * walls + 1, sizeof(double));
    void *blocks[WORKSPACE_BLOCKS];
    list_blocks(w, blocks);
    for (int i = 0; i < WORKSPACE_BLOCKS; i++)
        if (!blocks[i]) return -1;
    return step_share_allocate(w) || step_functions_allocate(w) || step_jets_allocate(w) || step_erosion_allocate(w)
               ? -1
               : 0;
}

static void release(Workspace *w)
{
    if (w->before == w->acceleration) w->before = NULL;
    void *blocks[WORKSPACE_BLOCKS];
    list_blocks(w, blocks);
    for (int i = 0; i < WORKSPACE_BLOCKS; i++) memory_free(blocks[i]);
    reference_work_free(w->model, &w->reference);
    memory_free(w->segment_middle);
    step_functions_release(w);
    step_jets_release(w);
    step_erosion_release(w);
    contact_free(w->contact);
}

static int prepare(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; i < m->constraints.hanging_count; i++)
        if (m->constraints.hanging[i].node >= m->free_count && m->constraints.hanging[i].node < m->moving_count)
            w->special_kind[m->constraints.hanging[i].node - m->free_count] = 1;
    for (int b = 0; b < m->rigid_body_count; b++)
        for (int i = 0; i < m->rigid_bodies[b].node_count; i++)
            if (m->rigid_bodies[b].node[i] < m->moving_count)
                w->special_kind[m->rigid_bodies[b].node[i] - m->free_count] = 2;
    w->general = m->node_class != NULL;
    w->general |= m->has_fluid;
    for (int i = 0; i < m->airbag_count; i++) w->general |= m->airbags[i].spsf > 0.0;
    w->closed = true;
    /* velocities of nodes that never move stay zero; the view shows so */
    memcpy(w->velocity, w->state->v, 3 * (size_t)m->node_count * sizeof(double));
    if (!model_has_contact(m)) return 0;
    w->contact = contact_create(m, w->state, w->rows, w->bag_pressure);
    return w->contact ? 0 : -1;
}

/* Ends the cycle: the clock moves on. */
void step_tick(Workspace *w)
{
    Clock *clock = w->state->clock;
    double left = w->model->end_time - clock->time;
    clock->time = w->plan.dt_next == left ? w->model->end_time : clock->time + w->plan.dt_next;
    clock->step = w->plan.dt_next;
    clock->cycle++;
}

static double lap(double *since)
{
    double now = wall_clock(), spent = now - *since;
    *since = now;
    return spent;
}

/* Contact forces at x_n into the corner buffer. */
static void step_contact(Workspace *w, int thread, int threads, Team *team)
{
    contact_prepare(w->contact, w->plan.time, w->plan.dt_before, w->plan.dt_next, thread, team);
    team_barrier(team);
    contact_forces(w->contact, thread, threads);
    team_barrier(team);
    contact_gather(w->contact, thread, threads);
    team_barrier(team);
}

static void loop(void *context, int thread, Team *team)
{
    Workspace *w = context;
    int threads = team_size(team);
    double since = wall_clock();
    StageTimes none = {0}, *times = thread == 0 ? w->times : &none;
    for (;;) {
        step_elements(w, thread, threads);
        times->elements += lap(&since);
        team_barrier(team);
        times->waiting += lap(&since);
        if (thread == 0) step_gas(w);
        times->gas += lap(&since);
        team_barrier(team);
        if (w->failure->failed) break;
        times->waiting += lap(&since);
        if (w->contact) step_contact(w, thread, threads, team);
        times->contact += lap(&since);
        if (w->jets) step_jets_push(w, thread, team);
        if (w->plan.implicit_gas) {
            step_gas_pass(w, thread, threads);
            team_barrier(team);
            if (thread == 0) step_gas_implicit(w);
            team_barrier(team);
        }
        if (w->model->implicit.element_count > 0) {
            if (thread == 0) step_implicit(w);
            team_barrier(team);
        }
        if (thread == 0 && !w->model->has_moving_walls) step_special(w);
        times->special += lap(&since);
        step_nodes(w, thread, threads);
        times->nodes += lap(&since);
        team_barrier(team);
        if (w->model->has_moving_walls) { /* their speed follows from all nodes that meet them */
            if (thread == 0) step_special(w);
            team_barrier(team);
        }
        if (w->jets) step_jets_count(w, thread, team);
        times->waiting += lap(&since);
        if (w->contact) contact_follow(w->contact, thread, threads, w->plan.emit ? w->plan.dt_next : 0.0);
        if (w->model->walls_block) step_walls_block(w, thread, threads);
        times->contact += lap(&since);
        if (!w->plan.emit) continue;
        if (w->contact || w->model->walls_block) team_barrier(team);
        if (thread == 0) step_emit(w);
        team_barrier(team);
        times->output += lap(&since);
        if (w->failure->failed) break;
        step_advance_positions(w, thread, threads);
        times->nodes += lap(&since);
        team_barrier(team);
        if (thread == 0) {
            step_tick(w);
            if (w->hooks->completed) w->hooks->completed(w->hooks->user, w->model, w->state);
        }
        times->output += lap(&since);
        team_barrier(team);
        if (w->plan.stop || w->plan.last) break;
    }
}

/* The state at a failure, if its positions are finite; otherwise the last one written is the last good one. */
static void emit_failed(Workspace *w)
{
    for (int i = 0; i < 3 * w->model->node_count; i++)
        if (!isfinite(w->state->x[i]) || !isfinite(w->state->v[i])) return;
    memcpy(w->velocity, w->state->v, 3 * (size_t)w->model->node_count * sizeof(double));
    w->plan.last = true;
    step_emit(w);
}

int solver_run(const Model *model, State *state, int threads, const RunHooks *hooks, StageTimes *times,
               Failure *failure)
{
    Workspace w = {.model = model,
                   .state = state,
                   .hooks = hooks,
                   .times = times,
                   .failure = failure,
                   .kernels = kernels_select(NULL)};
    double start = wall_clock();
    *failure = (Failure){0};
    if (!w.kernels) {
        step_fail(&w, "use v2, v3 or v4, as far as the processor has them, or unset it",
                  "BILLOW_KERNELS names kernels that are not available here");
        return -1;
    }
    if (allocate(&w)) {
        step_fail(&w, "use a smaller mesh or a machine with more memory", "no memory for the time loop");
        release(&w);
        return -1;
    }
    if (prepare(&w)) {
        step_fail(&w, "use a smaller mesh or a machine with more memory", "no memory for contact");
        release(&w);
        return -1;
    }
    int count = threads < 1 ? 1 : threads > BILLOW_MAX_THREADS ? BILLOW_MAX_THREADS : threads;
    if (team_run(&count, loop, &w)) step_fail(&w, "use fewer threads", "no memory for the threads");
    if (failure->failed) emit_failed(&w);
    times->total = wall_clock() - start;
    if (w.contact) times->search = w.contact->search_seconds;
    release(&w);
    return failure->failed ? -1 : 0;
}
