/* The membrane laws at one point in scalar form: for the writers, static equilibrium and tests. The very functions of
 * the kernels on one lane. */
#ifndef BILLOW_LAW_POINT_H
#define BILLOW_LAW_POINT_H

#include <stddef.h>

#include "elements/law.h"

typedef struct LawPoint {
    double stress[3]; /* second Piola-Kirchhoff in material axes (11, 22, 12) [F/L2] */
    double strain[3]; /* the law's own: U - 1, ln U or Green's (11, 22, tensor 12) */
    double energy;    /* per reference volume, where law_stores_energy [F/L2]; else 0 */
    double rate;      /* bound of the squared frequency for GEOMETRY_RATE and GEOMETRY_STRESS_RATE as given */
} LawPoint;

/* c: right Cauchy-Green tensor in material axes (11, 22, 12). memory: the point's, law_memory_size values with the
 * stride, NULL: untouched material; it is updated like a kernel does.
 * reference_rate, stress_rate: see elements/kernels.h; 0 where the rate is of no interest. LAW_SURFACE: all zero. */
void law_point(LawKind kind, const FabricLaw *law, const double c[3], double *memory, ptrdiff_t stride,
               double reference_rate, double stress_rate, LawPoint *point);

#endif
