/* From the command line's deck to a model and its state at time 0, with the messages users see. */
#ifndef BILLOW_ACCEPT_H
#define BILLOW_ACCEPT_H

#include <stdio.h>

#include "solver/definitions.h"
#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/options.h"
#include "solver/state.h"

/* Everything that comes from one deck; zero-initialise. */
typedef struct Accepted {
    Diagnostics diagnostics;
    Definitions definitions;
    Model model;
    Model phase; /* of the phase before the run, where the deck gives it other loads; else empty */
    State state;
} Accepted;

/* Reads, builds and starts the deck; every error of the deck goes to accepted->diagnostics. Returns 0, or -1 if there
 * is an error. Free with accept_free in both cases. */
int accept_deck(const Options *options, Accepted *accepted);

/* Prints errors and warnings, then, if there was an error, a line that counts them. */
void accept_print_problems(const Diagnostics *diagnostics, const char *deck, FILE *stream);

void accept_free(Accepted *accepted);

#endif
