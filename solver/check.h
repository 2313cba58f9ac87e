/* billow check: reads, validates and reports a deck; no steps, no files. */
#ifndef BILLOW_CHECK_H
#define BILLOW_CHECK_H

#include "solver/options.h"

/* Prints the report to standard output and errors to standard error. Returns the exit code. */
int check_deck(const Options *options);

#endif
