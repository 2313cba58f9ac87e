/* Reference geometry of one element: natural gradients, weights, exact largest frequency. */
#ifndef BILLOW_GEOMETRY_H
#define BILLOW_GEOMETRY_H

#include <stdbool.h>

#include "elements/law.h"
#include "solver/model.h"

/* How the fibre direction 1 lies in an element (AOPT, BETA). */
typedef struct FibreAxis {
    enum { FIBRE_EDGE, FIBRE_VECTOR, FIBRE_CROSS } kind; /* edge n1-n2; vector projected; vector x normal */
    double vector[3];                                    /* global, for the last two */
    double angle;                                        /* added about the normal [rad] */
} FibreAxis;

/* Input for one element of the given kind: reference corners (corner_count x 3), thickness, mass carried by the
 * element. With start (corners in the mesh, corner_count x 3) the stretch that the reference has in the mesh beyond 1
 * is added to the reference, so that the element starts without tension (eq. R3, R4). */
typedef struct ElementInput {
    ElementKind kind;
    const double *x, *start; /* start: NULL if nothing is taken out */
    double thickness, mass;
    FibreAxis axis;
    const FabricLaw *law; /* NULL for surfaces */
} ElementInput;

typedef enum GeometryStatus { GEOMETRY_OK, GEOMETRY_ZERO_AREA, GEOMETRY_INVERTED, GEOMETRY_NO_FIBRE } GeometryStatus;

/* Number of doubles per lane for a kind and law. */
int geometry_size(ElementKind kind, LawKind law);

/* Fills the lane's constants (stride BILLOW_LANES between values, layout of elements/kernels.h); sign as given. */
GeometryStatus geometry_fill(const ElementInput *input, double sign, double *lane);

/* Whether geometry_fill will accept the element. */
GeometryStatus geometry_check(const ElementInput *input);

/* Area of an element: sum of its points' areas; zero for degenerate ones. x: corners (corner_count x 3). */
double geometry_area(int corner_count, const double *x);

/* Largest squared frequency of the free element with its lumped mass, membrane stiffness in the reference state (eq.
 * E20): exact for triangles and quads. */
double geometry_rate(const ElementInput *input);

/* A stiffness that is the same for each component of the corners' displacements, k (corners x corners, row-major), and
 * not less than the element's in any direction (eq. T15); not for one-point quads. -1 for degenerate elements. */
int geometry_gradient_stiffness(const ElementInput *input, double *k);

/* The largest eigenvalue of a symmetric n x n matrix (row-major, destroyed), n <= 12, by Jacobi rotations. */
double geometry_largest_eigenvalue(int n, double *matrix);

#endif
