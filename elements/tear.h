/* What the tearing of fabric is judged by (docs/theory.md, Seams and tears). */
#ifndef BILLOW_TEAR_H
#define BILLOW_TEAR_H

#include "solver/model.h"

/* Principal logarithmic strains, the larger first, of the right Cauchy-Green tensor c in material axes (eq. X4). */
void tear_strains(const double c[3], double strain[2]);

/* Effective strain of two principal strains at constant volume (eq. X5). */
double tear_effective_strain(const double strain[2]);

/* Mean effective strain of an element's points, weighted by their volumes; *volume: the element's in the reference
 * [L3]. geometry: the lane's constants; place: of the element in its group. */
double tear_mean_strain(const ElementGroup *group, const double *geometry, const double *x, int64_t place,
                        double *volume);

#endif
