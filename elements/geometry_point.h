/* One point of an element in its reference; private to elements/geometry.c. */
#ifndef BILLOW_GEOMETRY_POINT_H
#define BILLOW_GEOMETRY_POINT_H

#include "elements/geometry.h"

/* Points of an element. */
int point_number(ElementKind kind);

/* Tangents dX/d(natural) (3 each); for triangles the two edges. */
void point_tangents(const ElementInput *input, int point, double *t1, double *t2);

/* M (2 x 2, layout of elements/kernels.h) and the area factor, |dX/d(natural)| times the natural weight. */
GeometryStatus point_gradients(const ElementInput *input, int point, double m[4], double *area);

/* Of a quad with corners x (4 x 3): its reference hourglass vector in natural directions (skew), the squared lengths of
 * its mean tangents and of what is left of the vector, q (eq. E15, E16). */
void point_hourglass(const double *x, double skew[2], double *aa, double *bb, double *qq);

/* Has the metric a term of its own in q.q (eq. E4a)? What a unit of it adds, as M^T E M in material axes (11, 22, 12).
 */
bool point_has_fold(const ElementInput *input);
void point_fold_metric(int point, const double m[4], double e[3]);

#endif
