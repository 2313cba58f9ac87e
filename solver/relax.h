/* The phase before time 0: the membrane's static equilibrium under the loads at the start (docs/theory.md, Static
 * equilibrium). */
#ifndef BILLOW_RELAX_H
#define BILLOW_RELAX_H

#include <stdio.h>

#include "solver/model.h"
#include "solver/state.h"
#include "solver/step.h"

/* How the phase went. */
typedef struct RelaxReport {
    int steps, factorisations; /* of Newton's method */
    long cycles;               /* of dynamic relaxation */
    double residual;           /* force left over, over the loads */
    double load;               /* size of the loads; without any, of the stress forces at the start [force] */
    double energy;             /* stored in the fabric [energy] */
    double seconds;
    bool stopped; /* the user asked to stop: no state was found, and no failure is set */
} RelaxReport;

/* Whether model (the phase's) can be relaxed: laws, bags and loads that have no static equilibrium are reported as
 * errors by name. 0, or -1. */
int relax_check(const Model *model, Diagnostics *diagnostics);

/* Finds the equilibrium of phase, a model of the same deck that has the phase's loads (perhaps model itself), and
 * starts state anew from it: positions at equilibrium, velocities of the deck, gas on the relaxed volume. progress: a
 * line for each step, or NULL. 0, or -1 with
 * *failure set or report->stopped. */
int relax_run(const Model *phase, const Model *model, int threads, FILE *progress, State *state, RelaxReport *report,
              Failure *failure);

#endif
