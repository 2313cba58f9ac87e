/* Ties in the step. */
#ifndef BILLOW_STEP_TIES_H
#define BILLOW_STEP_TIES_H

#include "solver/workspace.h"

/* All threads: strains of the watched elements of one chunk of a group, after its kernel. */
void step_ties_watch(Workspace *w, int number, int chunk);

/* Thread 0: breaks the ties around which the fabric is stretched too far, and makes the velocities of the others' nodes
 * agree after Newton's law (eq. X6, X7). */
void step_ties_act(Workspace *w);

#endif
