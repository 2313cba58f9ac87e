/* Links in the step: forces on their nodes, energy of their parts, their share of the stable step. */
#ifndef BILLOW_STEP_LINKS_H
#define BILLOW_STEP_LINKS_H

#include "solver/model.h"
#include "solver/state.h"

/* Adds the forces at the positions state->x to f (.. x 3) of nodes that move, and the change of the energy stored since
 * the last call to the parts' energies; f may be NULL. */
void links_act(const Model *model, State *state, double *f);

/* The largest of the links' rates: with the elements' it bounds the squared frequency of the whole (K5). */
double links_rate(const Model *model, const double *x);

#endif
