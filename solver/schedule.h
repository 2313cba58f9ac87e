/* When results are due: LS-DYNA's rule, every result at the last cycle that does not pass a multiple of its interval.
 */
#ifndef BILLOW_SCHEDULE_H
#define BILLOW_SCHEDULE_H

#include <stdbool.h>

#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/state.h"

/* Kinds of results as bits of a mask. */
enum ScheduleKind {
    SCHEDULE_STATES = 1 << 0,
    SCHEDULE_GLSTAT = 1 << 1,
    SCHEDULE_ABSTAT = 1 << 2,
    SCHEDULE_NODOUT = 1 << 3,
    SCHEDULE_RBDOUT = 1 << 4,
    SCHEDULE_RCFORC = 1 << 5,
    SCHEDULE_RWFORC = 1 << 6,
    SCHEDULE_MATSUM = 1 << 7,
    SCHEDULE_GCEOUT = 1 << 8,
    SCHEDULE_ALL = (1 << 9) - 1,
};

/* Fills in the intervals the deck left out. Without any *DATABASE card: 20 states and 200 rows of every history over
 * end_time; with some, only the states, glstat and (with bags) abstat, so that no run ends without results. Notes say
 * so. */
void schedule_fill_plan(OutputPlan *plan, double end_time, Diagnostics *diagnostics);

/* Mask of the kinds that are due at clock->time: those whose next time is reached or lies before clock->time +
 * clock->step_next (relative tolerance 1e-12). At time 0 every kind with an interval is due. */
unsigned schedule_due(const OutputPlan *plan, const Clock *clock);

/* Mask of the kinds with an interval: what the last cycle writes. */
unsigned schedule_kinds(const OutputPlan *plan);

/* Moves the next times of the kinds in due (a value of schedule_due at this clock) to the first multiple of the
 * interval that is not reached by the coming step. */
void schedule_advance(const OutputPlan *plan, Clock *clock, unsigned due);

/* True if a checkpoint is due after the cycle: plan->restart counts cycles, 0 is never. */
bool schedule_checkpoint_due(const OutputPlan *plan, const Clock *clock);

#endif
