/* History files of one subject (glstat, abstat, ...): a CSV table and, beside it, LS-DYNA's ASCII layout. Both hold the
 * same times; a block (all rows of one time) is written whole or not at all. */
#ifndef BILLOW_HISTORY_H
#define BILLOW_HISTORY_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

#include "solver/diagnostics.h"

/* What a subject's files are called and how they begin; constant texts. */
typedef struct HistoryFormat {
    const char *csv_name;
    const char *csv_header; /* column names, no newline; the first is time */
    const char *ascii_name; /* NULL: no ASCII file */
    const char *ascii_mark; /* the line with which every block of the ASCII file begins, as a prefix */
} HistoryFormat;

/* One growing text file. */
typedef struct HistoryFile {
    char *path;      /* owned */
    FILE *stream;    /* NULL while closed */
    off_t committed; /* bytes of the file that hold whole blocks */
    bool fresh;      /* the file was empty when the block was begun: headings are due */
    bool reported;   /* its failure is already in the diagnostics */
} HistoryFile;

typedef struct History {
    const HistoryFormat *format;
    HistoryFile csv, ascii;
    double last_time; /* of the last block; minus infinity for none */
    Diagnostics *diagnostics;
} History;

/* Sets up the history in folder dir; opens nothing. 0, or -1 without memory (reported). */
int history_create(History *history, const HistoryFormat *format, const char *dir, Diagnostics *diagnostics);

/* Deletes both files if they exist. 0, or -1 with an environment error. */
int history_remove(History *history);

/* Cuts both files down to the blocks at times up to restart_time, so that writing goes on behind them. A broken last
 * row is dropped. 0, or -1 with an environment error. */
int history_truncate(History *history, double restart_time);

/* Opens the files for a block and writes the headings of new ones (history->ascii.fresh tells the caller to add a
 * legend to the ASCII file). Returns 1 to go on, 0 if there is already a block at this time or a later one, -1 with an
 * environment error. */
int history_begin(History *history, double time, const char *title);

/* Ends the block: hands it to the system. 0, or -1 with an environment error; both files then end before the block. */
int history_commit(History *history, double time);

/* Hands to the system what stdio may hold (nothing, after a commit). 0, or -1 with an environment error. */
int history_flush(History *history);

/* Closes and frees. 0, or -1 with an environment error. */
int history_close(History *history);

/* A number that fits LS-DYNA's fixed columns: exponents of three digits become 0 or 9.9e99. */
double history_clip(double value);

#endif
