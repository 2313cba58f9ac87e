/* Seams in the step. */
#ifndef BILLOW_STEP_SEAMS_H
#define BILLOW_STEP_SEAMS_H

#include "solver/model.h"
#include "solver/state.h"

/* Makes the velocities of closed seams' nodes agree after Newton's law, or opens the seams that tear (eq. X1, X2).
 * dt_mean: the step of the velocities. */
void seams_act(const Model *model, State *state, double dt_mean);

#endif
