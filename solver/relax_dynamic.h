/* Dynamic relaxation: damped explicit steps to the static equilibrium. Private to solver/relax*.c. */
#ifndef BILLOW_RELAX_DYNAMIC_H
#define BILLOW_RELAX_DYNAMIC_H

#include "solver/relax.h"

/* From x (node_count x 3) to equilibrium, in place. pressure: of each bag (airbag_count). 0; 1: the
 * user asked to stop; -1 with *failure set. */
int relax_dynamic(const Model *phase, const double *pressure, int threads, FILE *progress, double *x,
                  RelaxReport *report, Failure *failure);

#endif
