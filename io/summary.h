/* summary.json: the outcome of a run for scripts. */
#ifndef BILLOW_SUMMARY_H
#define BILLOW_SUMMARY_H

#include <stdint.h>

#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/step.h"

#define BILLOW_SUMMARY_NAME "summary.json"

/* Numbers are those of this run alone; after a restart cycles counts the cycles since the checkpoint, last_cycle and
 * end_time the whole run. */
typedef struct Summary {
    const char *status; /* "normal", "stopped_by_user", "failed", "input_error" */
    const char *deck;   /* as given on the command line */
    int threads;
    int64_t cycles, last_cycle;
    int elements, nodes;         /* deformable elements; nodes of the deck */
    double end_time;             /* time reached */
    double wall_seconds;         /* of the whole program, reading and writing included */
    double loop_seconds;         /* of the time loop without output */
    double ns_per_element_cycle; /* 0 when there is no element or no cycle */
    double energy_ratio_min, energy_ratio_max;
    StageTimes timing;
    size_t memory_bytes; /* model, state and buffers of the loop and the writers */
    int warnings;
    uint64_t state_hash;
    const char *cause, *advice; /* of a failure, NULL otherwise */
} Summary;

/* Writes DIR/summary.json through a temporary file and a rename. Numbers that are not finite become null. Returns 0, or
 * -1 with an environment error. */
int summary_write(const char *directory, const Summary *summary, Diagnostics *diagnostics);

#endif
