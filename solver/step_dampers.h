/* Dampers in the step: forces on their nodes, their work, their share of the stable step. */
#ifndef BILLOW_STEP_DAMPERS_H
#define BILLOW_STEP_DAMPERS_H

#include "solver/model.h"

/* Adds the forces at the positions x and the velocities v before the step to f (all .. x 3), for nodes that move. */
void dampers_act(const Model *model, const double *x, const double *v, double *f);

/* Energy that they take from the nodes over dt_mean: v_before before the step (of nodes that move), v after it (K10).
 */
double dampers_work(const Model *model, const double *x, const double *v_before, const double *v, double dt_mean);

/* The square of the frequency that bounds the step, from that without dampers (K11). */
double dampers_rate(const Model *model, double rate);

#endif
