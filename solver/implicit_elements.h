/* Small elements whose stress is integrated implicitly, so that the rest of the mesh sets the step (docs/theory.md,
 * Small elements). */
#ifndef BILLOW_IMPLICIT_ELEMENTS_H
#define BILLOW_IMPLICIT_ELEMENTS_H

#include <stdint.h>

/* Their nodes that move, and the factor A = L D L^T of the matrix of eq. T14, the same for x, y and z; in the order of
 * the factor. */
typedef struct ImplicitElements {
    int element_count; /* 0: all elements are explicit */
    int node_count;
    double explicit_step;  /* stable step that the mesh would have without (eq. E20b), before DAMP and TSSFAC [T] */
    int32_t *node;         /* (node_count) */
    int32_t *start;        /* entries of each column of L below the diagonal (node_count + 1) */
    int32_t *row;          /* place of each entry (start[node_count]) */
    double *entry;         /* of L, likewise */
    double *inverse_pivot; /* 1/D (node_count) [1/M] */
} ImplicitElements;

enum { IMPLICIT_WIDTH = 4 }; /* x, y, z and nothing, so that a register holds a node */

/* Solves A a = f in place (node_count x IMPLICIT_WIDTH, in the order of the factor). */
void implicit_elements_solve(const ImplicitElements *elements, double *a);

/* Products u . (A - M) u, u . (A - M) w and w . (A - M) w: the inertia that the elements add to their nodes' (eq. T18).
 */
typedef struct ImplicitInertia {
    double uu, uw, ww;
} ImplicitInertia;

/* mass, u, w: of all nodes of the model (1, 3 and 3 of each). */
ImplicitInertia implicit_elements_inertia(const ImplicitElements *elements, const double *mass, const double *u,
                                          const double *w);

#endif
