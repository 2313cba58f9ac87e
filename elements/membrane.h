/* Membrane elements: what the rest of the program sees of them. */
#ifndef BILLOW_MEMBRANE_H
#define BILLOW_MEMBRANE_H

#include "solver/model.h"
#include "solver/state.h"

/* Stress and strain of one element at its centre (mean over points) for output, by the reference geometry of the state:
 * symmetric tensors in global axes, order xx yy zz xy yz zx; Cauchy stress [F/L2]; strain U - 1, logarithmic or Green
 * as the law has it. thickness is the current [L]. element is the deck-order index. Rigid and surface elements give
 * zero stress. */
typedef struct ElementResult {
    double stress[6], strain[6], thickness;
} ElementResult;
void membrane_result(const Model *model, const State *state, const double *x, int element, ElementResult *result);

#endif
