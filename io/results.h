/* Results of a run: results.vtkhdf and results.xdmf, CSV histories and the same data in LS-DYNA's ASCII layouts.
 *
 * Files are made at their first write, so a history that is never written leaves no file. All functions return 0, or -1
 * with an environment error (disk full, no permission, no memory) added to the diagnostics given to results_open; after
 * a failure of one file the others can still be written. Times must grow: a write at a time that is not later than the
 * last one of the same file changes nothing, so that the first cycle after a restart may be emitted again. */
#ifndef BILLOW_RESULTS_H
#define BILLOW_RESULTS_H

#include <stdbool.h>

#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/state.h"
#include "solver/step.h"

typedef struct Results Results;

/* Opens the results of the existing folder dir. append false: files of an earlier run that this module could write are
 * removed. append true (restart): every file keeps its states and rows up to restart_time and the run goes on behind
 * them; files that are missing start anew. model and diagnostics are borrowed until results_close. On failure *results
 * is NULL. */
int results_open(const char *dir, const Model *model, bool append, double restart_time, Results **results,
                 Diagnostics *diagnostics);

/* One state of results.vtkhdf and results.xdmf; on disk when the call returns, so live and killed runs open. */
int results_write_state(Results *results, const Model *model, const State *state, const StepView *view);

/* Rows at state->clock->time. Nothing happens where the model has no such entity (no bag, no history node, ...). */
int results_write_glstat(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_abstat(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_nodout(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_rbdout(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_rcforc(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_rwforc(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_gceout(Results *results, const Model *model, const State *state, const StepView *view);
int results_write_matsum(Results *results, const Model *model, const State *state, const StepView *view);

/* Hands all rows to the system: call before a checkpoint is written, so that no row before it can be lost. */
int results_flush(Results *results);

/* Flushes, closes and frees; -1 if data could not be written. NULL is allowed. */
int results_close(Results *results);

#endif
