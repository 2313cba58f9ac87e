/* Frequencies that a mesh has at its nodes, for its stable step (eq. E20a). Private to solver/build_*.c. */
#ifndef BILLOW_NODE_RATES_H
#define BILLOW_NODE_RATES_H

#include "solver/builder.h"

/* Of all elements with stress: mass, and mass times squared frequency of those that are explicit (node_count each). */
typedef struct NodeRates {
    double *mass;      /* [M] */
    double *mass_rate; /* [M/T2] */
} NodeRates;

/* The largest squared frequency of the element at a place of a group over its geometries. */
double node_rates_own(const Builder *builder, int group, int64_t place);

/* Fills the sums, without the elements that implicit marks (by record, NULL: none); returns the largest mean of a node,
 * which no frequency of the mesh exceeds (squared). */
double node_rates_sum(const Builder *builder, const unsigned char *implicit, NodeRates *rates);

/* Multiplies the constants of an element's frequency by a share. */
void node_rates_scale(Builder *builder, int group, int64_t place, double share);

#endif
