/* The elements with the smallest stable steps, for the report. */
#ifndef BILLOW_ELEMENT_STEPS_H
#define BILLOW_ELEMENT_STEPS_H

#include "solver/model.h"

typedef struct ElementStep {
    int element; /* deck-order index */
    double step; /* 2 / its own largest frequency in the reference state [T] */
} ElementStep;

/* Stable step of the mesh in the reference state, before DAMP and TSSFAC (eq. E20b) [T]; 0 without elements with
 * stress. */
double element_steps_mesh(const Model *model);

/* The limit smallest steps of elements with stress, in ascending order (equal steps in deck order), into list (limit).
 * Returns how many there are, 0 without memory. */
int element_steps_smallest(const Model *model, int limit, ElementStep *list);

#endif
