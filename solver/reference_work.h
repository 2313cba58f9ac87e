/* The groups as the kernels see them in a run: with the constants of the reference geometry that holds now. */
#ifndef BILLOW_REFERENCE_WORK_H
#define BILLOW_REFERENCE_WORK_H

#include "elements/lane.h"
#include "elements/reference.h"

typedef struct ReferenceWork {
    ElementGroup *groups; /* (group_count); the model's own where no group has a reference geometry */
    double **own; /* constants of groups whose elements change or erode one by one (group_count), NULL elsewhere */
} ReferenceWork;

/* By the state's references. 0, or -1 without memory. */
int reference_work_create(const Model *model, const State *state, ReferenceWork *work);
void reference_work_free(const Model *model, ReferenceWork *work);

/* Points a group to the constants that hold by the state. */
void reference_work_select(const Model *model, const State *state, int number, ReferenceWork *work);

/* Constants of a group's blocks [first, end) in a reference's state (NULL: the mesh is its reference), eroded elements
 * taken out, into own (geometry_size x LANES per block). */
void reference_work_fill(const Model *model, const State *state, int number, const ReferenceState *now, int first,
                         int end, double *own);

#endif
