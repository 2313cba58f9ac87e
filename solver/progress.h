/* The progress of a run on standard output: one rewritten line on a terminal, plain lines elsewhere. */
#ifndef BILLOW_PROGRESS_H
#define BILLOW_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

#include "solver/model.h"
#include "solver/state.h"

typedef struct Progress {
    FILE *stream;
    bool quiet, terminal;
    bool open_line; /* terminal: a line without newline stands on the screen */
    bool heading_printed;
    int64_t last_cycle; /* of the last line, -1 before the first */
    double start_wall;  /* seconds, progress_now */
    double start_share; /* share of the run that was done at the start (restarts) */
    double last_wall;   /* of the last line */
    double next_share;  /* plain lines: share of the run at which the next one is due */
} Progress;

/* Monotonic wall time in seconds. */
double progress_now(void);

/* Starts at the state's time; terminal: the stream is one (isatty). */
void progress_start(Progress *progress, FILE *stream, bool terminal, bool quiet, const Model *model,
                    const Clock *clock);

/* Share of the run that is done, 0 .. 1: of the end time or of the last cycle, whichever is closer. */
double progress_share(const Model *model, const Clock *clock);

/* Prints a line if one is due: on a terminal every 0.2 s, else every 5 % of the run or 60 s. wall: progress_now(). */
void progress_update(Progress *progress, const Model *model, const State *state, double wall);

/* Prints a line now (sense switch sw2), also when quiet. */
void progress_print(Progress *progress, const Model *model, const State *state, double wall);

/* Prints the last line if the last one was of an earlier cycle, and ends it. */
void progress_finish(Progress *progress, const Model *model, const State *state);

/* Ends the rewritten line, so that other text can follow. */
void progress_finish_line(Progress *progress);

/* Seconds as "h:mm:ss", "m:ss" or "12.3 s" into text; "-" when they are not known (negative). */
void progress_format_seconds(double seconds, char *text, size_t length);

#endif
