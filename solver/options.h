/* The command line: billow's own spelling and LS-DYNA's. */
#ifndef BILLOW_OPTIONS_H
#define BILLOW_OPTIONS_H

#include <stdbool.h>
#include <stdio.h>

#include "solver/build.h"

typedef enum Command {
    COMMAND_RUN,
    COMMAND_CHECK,
    COMMAND_FOLD,
    COMMAND_VERSION,
    COMMAND_HELP,
    COMMAND_RUN_HELP,
    COMMAND_CHECK_HELP,
    COMMAND_FOLD_HELP,
} Command;

enum { BILLOW_OPTION_NOTES = 4, BILLOW_OPTION_TEXT = 320 };

/* Strings point into argv. */
typedef struct Options {
    Command command;
    const char *deck;      /* run, check, fold */
    const char *folds;     /* fold: the file of folds */
    const char *directory; /* -o DIR (fold: FILE), NULL: from the deck's or the job's name */
    const char *job;       /* jobid=NAME, NULL: none */
    const char *restart;   /* --restart FILE, NULL: from time 0 */
    int threads;           /* -j, 0: not given */
    bool quiet;
    BuildOptions build;
    int note_count; /* words accepted without effect, for the log */
    char notes[BILLOW_OPTION_NOTES][BILLOW_OPTION_TEXT];
    char error[BILLOW_OPTION_TEXT]; /* what is wrong and what to do, when options_parse returns -1 */
} Options;

/* Reads the command line. Returns 0, or -1 with options->error set: a usage error, exit BILLOW_EXIT_INPUT. */
int options_parse(int argc, char *const *argv, Options *options);

/* Prints the help text of COMMAND_HELP or of one of the commands. */
void options_print_help(Command command, FILE *stream);

/* The folder of results: -o as given, else NAME.results for jobid=NAME, else the deck's file name without folder and
 * last suffix + ".results", in the working directory. Returns 0, or -1 if it does not fit into length. */
int options_directory(const Options *options, char *directory, size_t length);

/* Threads to use: -j, else the first number of OMP_NUM_THREADS (environment, may be NULL), else the processors this
 * process may run on. At least 1, at most BILLOW_MAX_THREADS. */
int options_threads(const Options *options, const char *environment, int processors);

/* Processors that this process may run on, at least 1. */
int options_processors(void);

#endif
