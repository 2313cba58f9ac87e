/* log.txt: what LS-DYNA puts into d3hsp and messag. Its first line marks a folder as billow's. */
#ifndef BILLOW_LOG_H
#define BILLOW_LOG_H

#include <stdbool.h>
#include <stdio.h>

#include "io/summary.h"
#include "solver/definitions.h"
#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/state.h"

#define BILLOW_LOG_NAME "log.txt"

/* Last line of the log and of standard output, spelled so because users' scripts look for it. */
#define BILLOW_NORMAL_TERMINATION "N o r m a l    t e r m i n a t i o n"
#define BILLOW_ERROR_TERMINATION "E r r o r   t e r m i n a t i o n"

/* The log of one run. */
typedef struct Log {
    FILE *file;
    Diagnostics *diagnostics;
    size_t messages; /* how many of the diagnostics' messages are in the file */
} Log;

/* True if directory holds a log.txt that billow has begun. */
bool log_marks_folder(const char *directory);

/* Opens DIR/log.txt anew or, with append, behind what is there, and writes the heading with version, date and deck.
 * Returns 0, or -1 with an environment error. diagnostics is borrowed until log_close. */
int log_open(Log *log, const char *directory, bool append, const char *deck, Diagnostics *diagnostics);

/* The report of the accepted deck (io/report.h), threads and output intervals, then all messages so far. */
void log_write_deck(Log *log, const Definitions *definitions, const Model *model, const State *state,
                    const OutputPlan *plan, int threads, int processors);

/* The messages that came since the last call. */
void log_write_messages(Log *log);

/* One line with cycle and time in front, on the disk at once. */
void log_write_event(Log *log, const Clock *clock, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Outcome, energies, timing table and memory. */
void log_write_end(Log *log, const State *state, const Summary *summary);

/* Writes what messages are left and the last line (normal or error termination), and closes; nothing if never opened.
 */
void log_close(Log *log, bool normal);

#endif
