/* billow run: a whole run from the deck to the last line. */
#ifndef BILLOW_RUN_H
#define BILLOW_RUN_H

#include "solver/options.h"

/* Runs the deck and prints as docs/user-guide.md says. Returns the exit code. */
int run_deck(const Options *options);

#endif
