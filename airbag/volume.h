/* Volume and area of facets: the reference formulas that the element kernels repeat in blocks (docs/theory.md). */
#ifndef BILLOW_VOLUME_H
#define BILLOW_VOLUME_H

#include <stdint.h>

/* Points are double[3] [L]; a facet is node[4] (indices into x, .. x 3), a triangle repeats its third node. Volumes are
 * those of the cone from origin over the facet, positive if the facet's normal (right-hand rule on its corners) points
 * away from the origin. A quad is the bilinear patch through its corners, whose volume is the mean of its two
 * triangulations. None of the functions can fail. */

/* V = (a - o) . ((b - o) x (c - o)) / 6  (S1) [L3] */
double volume_triangle(const double a[3], const double b[3], const double c[3], const double origin[3]);

/* Exact volume under the bilinear patch a b c d (S2) [L3]. */
double volume_quad(const double a[3], const double b[3], const double c[3], const double d[3], const double origin[3]);

/* dV/dx of every corner (S3, S4) [L2]; depends on the origin, the sum over a closed surface does not. */
void volume_triangle_gradient(const double a[3], const double b[3], const double c[3], const double origin[3],
                              double gradient[3][3]);
void volume_quad_gradient(const double a[3], const double b[3], const double c[3], const double d[3],
                          const double origin[3], double gradient[4][3]);

/* Each corner's share of the area vector, the integral of N_i n dA (S5, S6) [L2]: the nodal forces of unit pressure.
 * Over a closed surface their sum at every node equals the sum of the gradients. */
void volume_triangle_shares(const double a[3], const double b[3], const double c[3], double share[3][3]);
void volume_quad_shares(const double a[3], const double b[3], const double c[3], const double d[3], double share[4][3]);

/* Volume under one facet, triangle or quad [L3]. */
double volume_facet(const int32_t node[4], const double *x, const double origin[3]);

/* Area of one facet: length of its area vector, half the cross product of the diagonals [L2]. */
double volume_facet_area(const int32_t node[4], const double *x);

/* Sum of sign x volume over facets node (facet_count x 4); sign (facet_count) of -1, 0, +1, or NULL for all +1 [L3]. */
double volume_surface(int facet_count, const int32_t *node, const int *sign, const double *x, const double origin[3]);

#endif
