/* The recorder: the hooks of a run. It decides each cycle what is written, and serves signals, d3kil and progress. */
#ifndef BILLOW_RECORDER_H
#define BILLOW_RECORDER_H

#include <stdbool.h>

#include "io/log.h"
#include "io/results.h"
#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/progress.h"
#include "solver/state.h"
#include "solver/step.h"

/* Filled by run.c: everything but the last group, which starts as zero. Nothing is owned. */
typedef struct Recorder {
    State *state; /* the state the loop works on: the recorder moves the times of the next outputs in it */
    Results *results;
    Diagnostics *diagnostics; /* failures of writing, the energy warning */
    Log *log;
    OutputPlan plan;
    Progress progress;
    const char *checkpoint;  /* path of the checkpoint */
    const char *switch_file; /* "d3kil" */

    bool asked;                              /* due was called for the cycle that is emitted */
    bool want_states, want_checkpoint, stop; /* requests to be served at this cycle */
    unsigned due;                            /* of schedule_due */
    bool stopped_by_user;
    bool write_failed; /* results or checkpoint could not be written: the run ends */
    bool energy_warned, fabric_warned, fast_warned, lost_warned;
    int energy_off; /* cycles in a row with the balance beyond the warning's limit */
    bool seams_watched;
    int64_t next_eroded;      /* so many eroded elements are worth a line in the log; 0: at the start */
    double seams_from;        /* time of the last cycle if seams_watched: those that tore since are logged */
    double next_look;         /* wall time of the next look at d3kil */
    double last_time;         /* of the last cycle that was emitted; a run's last cycle always is */
    size_t memory;            /* bytes held when a cycle was last emitted: model, state and buffers */
    int64_t checkpoint_cycle; /* clock->cycle of the last checkpoint written, 0 none */
} Recorder;

/* The hooks with recorder as their user. */
RunHooks recorder_hooks(Recorder *recorder);

/* Writes a checkpoint of the state now. Returns 0, or -1 with an environment error. */
int recorder_write_checkpoint(Recorder *recorder, const Model *model, const State *state);

/* Share by which the energy balance is off: the two sums' difference over the largest given so far; 0 when all vanish.
 */
double recorder_energy_error(const Energies *energy);

#endif
