/* Inside of the walls' stage: shared by solver/step_walls*.c. */
#ifndef BILLOW_STEP_WALLS_H
#define BILLOW_STEP_WALLS_H

#include "solver/rate_rows.h"
#include "solver/workspace.h"

/* Puts into the sums, and into the full-step view when emitting, that walls have changed the half-step velocity of a
 * free node from free_v to what it is now; before: at n - 1/2. */
void step_walls_account(Workspace *w, int node, const double before[3], const double free_v[3], NodeSums *sums);

#endif
