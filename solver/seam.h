/* Seams: pairs of nodes that move as one until the force between them tears them apart, *CONSTRAINED_SPOTWELD.
 * docs/theory.md, section "Seams". */
#ifndef BILLOW_SEAM_H
#define BILLOW_SEAM_H

#include <stdbool.h>
#include <stdint.h>

typedef struct Seam {
    int32_t node[2];
    double normal, shear;   /* SN, SS: forces that tear it; 0: this one does not */
    double normal_exponent; /* N */
    double shear_exponent;  /* M */
    double end;             /* TF: time at which it opens in any case */
} Seam;

/* The seam tears under the force (3) on its first node, with the nodes at x and y (eq. X3). */
bool seam_tears(const Seam *seam, const double force[3], const double x[3], const double y[3]);

#endif
