/* A mass on one node, of *ELEMENT_MASS (docs/theory.md, M26). */
#ifndef BILLOW_POINT_MASS_H
#define BILLOW_POINT_MASS_H

#include <stdint.h>

typedef struct PointMass {
    int32_t node;
    int part;    /* for which it counts: index into Model.parts, -1 none */
    double mass; /* [M] */
    int card;    /* place in Definitions.masses */
} PointMass;

#endif
