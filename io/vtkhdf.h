/* results.vtkhdf: the deformed mesh over time as a VTKHDF 2.0 temporal UnstructuredGrid (ParaView 5.12 or newer).
 * The topology is stored once; Points, velocities and the elements' results are appended for every state. */
#ifndef BILLOW_VTKHDF_H
#define BILLOW_VTKHDF_H

#include <stdbool.h>

#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/state.h"

typedef struct VtkHdf VtkHdf;

/* Creates the file at path, replacing what is there; points and cells in deck order. model is read during the call
 * only, diagnostics is borrowed. 0, or -1 with an environment error. */
int vtkhdf_create(const char *path, const Model *model, VtkHdf **grid, Diagnostics *diagnostics);

/* Opens an existing file of the same model and drops its states later than restart_time. A file that cannot be opened
 * (cut off by a crash) is kept as PATH.damaged, with a warning, and a new one takes its place. 0, or -1 with an
 * environment error. */
int vtkhdf_append(const char *path, const Model *model, double restart_time, VtkHdf **grid, Diagnostics *diagnostics);

/* States in the file, and the time of state index (0 .. count - 1). */
int vtkhdf_state_count(const VtkHdf *grid);
double vtkhdf_state_time(const VtkHdf *grid, int index);

/* Appends a state and flushes the file: x and v are positions and velocities at this time in the model's node order
 * (node_count x 3), state tells the reference geometry that holds, contact the rows of contact (force and load, eight
 * of each node, NULL: none). A time not later than the last state's changes nothing. 0, or -1 with an environment
 * error; the file then still holds its earlier states. */
int vtkhdf_write_state(VtkHdf *grid, const Model *model, const State *state, double time, const double *x,
                       const double *v, const double *contact);

/* Closes and frees. 0, or -1 with an environment error. NULL is allowed. */
int vtkhdf_close(VtkHdf *grid);

#endif
