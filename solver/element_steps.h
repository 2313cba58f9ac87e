/* The elements with the smallest stable steps, for the report. */
#ifndef BILLOW_ELEMENT_STEPS_H
#define BILLOW_ELEMENT_STEPS_H

#include "solver/model.h"

typedef struct ElementStep {
    int element; /* deck-order index */
    double step; /* 2 / largest frequency in the reference state, before TSSFAC [T] */
} ElementStep;

/* The limit smallest steps of elements with stress, in ascending order (equal steps in deck order), into list (limit).
 * Returns how many there are, 0 without memory. */
int element_steps_smallest(const Model *model, int limit, ElementStep *list);

#endif
