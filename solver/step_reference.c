/* Reference geometries in the loop: birth, return of the initial tension, liners that wait; and the step by the current
 * geometry (docs/theory.md, Reference geometry). */
#include <math.h>
#include <string.h>

#include "solver/reference_work.h"
#include "solver/workspace.h"

/* The share of the initial stretch left out comes in steps, each of which costs a call of the kernels. */
enum { SHARE_STEPS = 64 };
#define SUDDEN 0.9 /* a change that shortens the step to less than this share of the last one */

/* What becomes of a group's reference at t_n, from what it was: the same for every thread. */
static ReferenceState next_reference(const Workspace *w, const ElementGroup *group, const ReferenceState *now)
{
    const Clock *clock = w->state->clock;
    ReferenceState next = *now;
    next.born = clock->time >= group->birth;
    if (!next.born || group->rule.restore == RESTORE_NEVER) return next;
    const double value =
        group->rule.curve >= 0 ? curve_value(&w->model->curves[group->rule.curve], clock->time) : group->rule.factor;
    if (group->rule.restore == RESTORE_BY_TIME) {
        if (1.0 - value < next.share) next.share = 1.0 - value;
    } else if (clock->cycle > 0 && value > 0.0) {
        next.share *= 1.0 - value;
    }
    if (!(next.share > 0.0)) next.share = 0.0;
    next.applied = (double)(int)(next.share * SHARE_STEPS + 0.5) / SHARE_STEPS;
    return next;
}

/* Sum of the energies of all elements of the blocks by the constants in use. */
static double stored(const Workspace *w, const ElementGroup *group, int first, int end)
{
    double sum = 0.0;
    for (int64_t place = (int64_t)first * BILLOW_LANES; place < (int64_t)end * BILLOW_LANES; place++)
        sum += reference_energy(group, group->geometry + lane_offset(group, place), w->state->x, place);
    return sum;
}

/* Work of an element's stress on the way of the last step. */
static double work_of_lane(const Workspace *w, const ElementGroup *group, bool loaded, int64_t place)
{
    const double dt = w->state->clock->step;
    if (!(dt > 0.0)) return 0.0;
    const bool remembers = loaded && law_memory_size(group->law, &group->material) > 0;
    const double *memory =
        w->state->history + group->history_offset +
        (place / BILLOW_LANES * group->history_size + history_size(group->point_count)) * BILLOW_LANES +
        place % BILLOW_LANES;
    return reference_work(group, group->geometry + lane_offset(group, place), w->state->x, w->state->v, dt,
                          remembers ? memory : NULL, loaded, place);
}

/* The same of all elements of the blocks. */
static double work_of_step(const Workspace *w, const ElementGroup *group, bool loaded, int first, int end)
{
    double sum = 0.0;
    for (int64_t place = (int64_t)first * BILLOW_LANES;
         place < (int64_t)end * BILLOW_LANES && place < group->element_count; place++)
        sum += work_of_lane(w, group, loaded, place);
    return sum;
}

/* At birth: elements that are taut in the reference do not wait. */
static void find_taut(Workspace *w, int number, const KernelInput *input)
{
    const ElementGroup *group = &w->model->groups[number];
    for (int64_t place = (int64_t)input->first_block * BILLOW_LANES;
         place < (int64_t)input->end_block * BILLOW_LANES && place < group->element_count; place++)
        w->state->reached[group->first_element + place] =
            reference_is_taut(group, group->geometry + lane_offset(group, place), w->state->x, place);
}

/* Laws with unloading curves begin anew in a new reference. */
static void forget_loads(Workspace *w, const ElementGroup *group, int first, int end)
{
    ptrdiff_t size = (ptrdiff_t)law_memory_size(group->law, &group->material) > 0
                         ? (ptrdiff_t)(group->history_size - history_size(group->point_count)) * BILLOW_LANES
                         : 0;
    for (int block = first; size > 0 && block < end; block++)
        memset(w->state->history + group->history_offset +
                   ((ptrdiff_t)block * group->history_size + history_size(group->point_count)) * BILLOW_LANES,
               0, (size_t)size * sizeof(double));
}

/* The blocks' constants change: the kernel is called once more with the new ones, which fills the histories anew; the
 * energy that the change brings is counted apart (eq. R10). */
static void change_reference(Workspace *w, int number, const KernelInput *input, const ReferenceState *next,
                             ChunkSums *sums, ReferenceJump *jump)
{
    const Model *m = w->model;
    ElementGroup later = w->reference.groups[number];
    const bool by_work = !law_stores_energy(later.law, &later.material);
    const double before = by_work ? stored(w, &later, input->first_block, input->end_block) : sums->energy;
    const double held = work_of_step(w, &later, true, input->first_block, input->end_block);
    if (next->born && !w->state->reference[number].born && later.rule.liner_waits) find_taut(w, number, input);
    if (w->reference.own[number]) {
        reference_work_fill(m, w->state, number, next, input->first_block, input->end_block, w->reference.own[number]);
        later.geometry = w->reference.own[number];
    } else {
        later.geometry = next->born ? m->groups[number].geometry : m->groups[number].mesh_geometry;
    }
    forget_loads(w, &later, input->first_block, input->end_block);
    KernelInput again = *input;
    ChunkSums changed = {0};
    again.group = &later;
    again.rows = w->rows; /* from t_n on the new stress acts; the call before has left the rows alone */
    again.restart_ledger = true;
    again.inverse_step = 0.0; /* no strain rate from one reference to the other */
    kernels_for(w->kernels, &later)(&again, &changed);
    const double after = by_work ? stored(w, &later, input->first_block, input->end_block) : changed.energy;
    jump->energy += after - before;
    jump->outside += (changed.hourglass - sums->hourglass) + 0.5 * held;
    jump->pull += 0.5 * work_of_step(w, &later, false, input->first_block, input->end_block);
    sums->energy += after - before;
    sums->hourglass = changed.hourglass;
    sums->rate = changed.rate > sums->rate ? changed.rate : sums->rate;
}

void step_reference_wake(Workspace *w, int number, int chunk, const KernelInput *input)
{
    const ElementGroup *group = &w->reference.groups[number];
    const ReferenceState *now = &w->state->reference[number];
    ReferenceJump *jump = &w->reference_jump[chunk];
    *jump = (ReferenceJump){0};
    if (!group->rule.liner_waits || !now->born) return;
    double *own = w->reference.own[number];
    for (int64_t place = (int64_t)input->first_block * BILLOW_LANES;
         place < (int64_t)input->end_block * BILLOW_LANES && place < group->element_count; place++) {
        unsigned char *reached = &w->state->reached[group->first_element + place];
        double *lane = own + lane_offset(group, place);
        if (*reached || (group->erosion && w->state->eroded[group->first_element + place]) ||
            !reference_is_taut(group, lane, w->state->x, place))
            continue;
        *reached = 1;
        double held = work_of_lane(w, group, true, place); /* of its hourglass control, which does not wait */
        reference_constants(&w->model->groups[number], now->applied, true, place, lane);
        jump->energy +=
            reference_energy(group, lane, w->state->x, place) - 0.5 * (work_of_lane(w, group, true, place) - held);
    }
}

bool step_reference_changes(const Workspace *w, int number)
{
    const ElementGroup *group = &w->reference.groups[number];
    const ReferenceState *now = &w->state->reference[number], next = next_reference(w, group, now);
    return next.born != now->born || next.applied != now->applied;
}

void step_reference_chunk(Workspace *w, int number, int chunk, const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = &w->reference.groups[number];
    const ReferenceState *now = &w->state->reference[number], next = next_reference(w, group, now);
    ReferenceJump *jump = &w->reference_jump[chunk];
    if (next.born != now->born || next.applied != now->applied) {
        *jump = (ReferenceJump){0};
        change_reference(w, number, input, &next, sums, jump);
    } else if (!law_stores_energy(group->law, &group->material)) {
        sums->energy += jump->energy; /* of the liners that woke */
    }
    if (!next.born) return;
    const double *geometry = w->reference.own[number] ? w->reference.own[number] : w->model->groups[number].geometry;
    double rate = reference_rate(group, geometry, input->first_block, input->end_block, w->state->x, input->lane_rate);
    if (rate > sums->rate || (reference_replaces_rate(group) && isfinite(sums->rate))) sums->rate = rate;
}

double step_reference_advance(Workspace *w)
{
    const Model *m = w->model;
    double sum = 0.0;
    w->reference_pull = 0.0;
    w->reference_changed = false;
    for (int g = 0; g < m->group_count; g++) {
        ElementGroup *group = &w->reference.groups[g];
        if (!group->has_reference) continue;
        int chunks = (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK;
        for (int c = 0; c < chunks; c++) {
            const ReferenceJump *jump = &w->reference_jump[group->first_chunk + c];
            sum += jump->energy + jump->outside;
            w->reference_pull += jump->pull;
        }
        w->reference_changed = w->reference_changed || step_reference_changes(w, g);
        w->state->reference[g] = next_reference(w, group, &w->state->reference[g]);
        reference_work_select(m, w->state, g, &w->reference);
    }
    return sum - w->reference_pull;
}

void step_reference_shorten(Workspace *w)
{
    CyclePlan *plan = &w->plan;
    if (!w->reference_changed || !(plan->dt_next < SUDDEN * plan->dt_before)) return;
    w->state->energy->external_half += (1.0 - plan->dt_next / plan->dt_before) * w->reference_pull;
    plan->dt_before = plan->dt_next;
}
