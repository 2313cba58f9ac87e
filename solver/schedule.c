/* When results are due: LS-DYNA's rule, every result at the last cycle that does not pass a multiple of its interval.
 */
#include "solver/schedule.h"

#include <math.h>
#include <stddef.h>

enum { SCHEDULE_COUNT = 9, DEFAULT_STATES = 20, DEFAULT_ROWS = 200 };

/* Share of a due time by which the end of a step may pass it: rounding of time sums. */
static const double due_tolerance = 1e-12;

/* Where the interval and the next time of kind i (bit i of the mask) are kept. */
static const struct {
    size_t interval, next;
} members[SCHEDULE_COUNT] = {
    {offsetof(OutputPlan, states), offsetof(Clock, next_states)},
    {offsetof(OutputPlan, glstat), offsetof(Clock, next_glstat)},
    {offsetof(OutputPlan, abstat), offsetof(Clock, next_abstat)},
    {offsetof(OutputPlan, nodout), offsetof(Clock, next_nodout)},
    {offsetof(OutputPlan, rbdout), offsetof(Clock, next_rbdout)},
    {offsetof(OutputPlan, rcforc), offsetof(Clock, next_rcforc)},
    {offsetof(OutputPlan, rwforc), offsetof(Clock, next_rwforc)},
    {offsetof(OutputPlan, matsum), offsetof(Clock, next_matsum)},
    {offsetof(OutputPlan, gceout), offsetof(Clock, next_gceout)},
};

static double interval_of(const OutputPlan *plan, int kind)
{
    return *(const double *)(const void *)((const char *)plan + members[kind].interval);
}

static double next_of(const Clock *clock, int kind)
{
    return *(const double *)(const void *)((const char *)clock + members[kind].next);
}

/* True if time is reached now or passed by the coming step. */
static bool step_passes(const Clock *clock, double time)
{
    return clock->time >= time || clock->time + clock->step_next > time * (1.0 + due_tolerance);
}

void schedule_fill_plan(OutputPlan *plan, double end_time, Diagnostics *diagnostics)
{
    const bool bare = schedule_kinds(plan) == 0;
    if (!(end_time > 0.0)) return;
    const double rows = end_time / DEFAULT_ROWS;
    if (bare) {
        plan->nodout = plan->rbdout = plan->rcforc = plan->rwforc = plan->gceout = plan->matsum = rows;
        diagnostics_add(diagnostics, SEVERITY_NOTE, BILLOW_NO_SOURCE, NULL,
                        "no *DATABASE card asks for results: %d states and %d rows of every history are written",
                        DEFAULT_STATES, DEFAULT_ROWS);
    } else if (!(plan->states > 0.0)) {
        diagnostics_add(diagnostics, SEVERITY_NOTE, BILLOW_NO_SOURCE, NULL,
                        "no *DATABASE_BINARY_D3PLOT card: %d states are written", DEFAULT_STATES);
    }
    if (!(plan->states > 0.0)) plan->states = end_time / DEFAULT_STATES;
    if (!(plan->glstat > 0.0)) plan->glstat = rows;
    if (!(plan->abstat > 0.0)) plan->abstat = rows;
}

unsigned schedule_due(const OutputPlan *plan, const Clock *clock)
{
    unsigned due = 0;
    for (int kind = 0; kind < SCHEDULE_COUNT; kind++)
        if (interval_of(plan, kind) > 0.0 && step_passes(clock, next_of(clock, kind))) due |= 1u << kind;
    return due;
}

unsigned schedule_kinds(const OutputPlan *plan)
{
    unsigned kinds = 0;
    for (int kind = 0; kind < SCHEDULE_COUNT; kind++)
        if (interval_of(plan, kind) > 0.0) kinds |= 1u << kind;
    return kinds;
}

void schedule_advance(const OutputPlan *plan, Clock *clock, unsigned due)
{
    for (int kind = 0; kind < SCHEDULE_COUNT; kind++) {
        if (!(due & 1u << kind)) continue;
        const double interval = interval_of(plan, kind);
        double *next = (double *)(void *)((char *)clock + members[kind].next);
        /* Multiples are counted, not summed, so that a thousand rows end at a thousand intervals to the last bit. */
        double multiple = floor((clock->time + clock->step_next) / interval) - 1.0;
        for (int i = 0; i < 4 && step_passes(clock, multiple * interval); i++) multiple += 1.0;
        *next = multiple * interval;
    }
}

bool schedule_checkpoint_due(const OutputPlan *plan, const Clock *clock)
{
    if (!(plan->restart >= 1.0 && plan->restart < 1e15) || clock->cycle < 1) return false;
    return clock->cycle % (int64_t)plan->restart == 0;
}
