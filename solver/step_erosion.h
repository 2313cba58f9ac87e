/* Erosion in the step. */
#ifndef BILLOW_STEP_EROSION_H
#define BILLOW_STEP_EROSION_H

#include "solver/workspace.h"

/* Values of State.eroded. */
enum { EROSION_NONE, EROSION_DONE, EROSION_FRESH, EROSION_RECENT /* in the last cycle */ };

int step_erosion_allocate(Workspace *w); /* -1 without memory */
void step_erosion_release(Workspace *w);

/* All threads: takes out the elements of one chunk of a group that fail at t_n; their forces of this cycle still act.
 */
void step_erosion_chunk(Workspace *w, int number, int chunk);

/* Thread 0, after the gas has been advanced to t_n: energy, areas and covers of what was taken out in this cycle. */
void step_erosion_close(Workspace *w);

/* Volume under the covers of a bag's holes [L3]. */
double step_erosion_cover(const Workspace *w, int airbag);

#endif
