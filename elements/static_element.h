/* One element for the static equilibrium: forces and stiffness of its stress, area vectors and their change
 * (docs/theory.md, Static equilibrium). The same kinematics as elements/kernels.c, in scalars. */
#ifndef BILLOW_STATIC_ELEMENT_H
#define BILLOW_STATIC_ELEMENT_H

#include "elements/static_law.h"
#include "solver/model.h"

enum { STATIC_CORNERS = 4, STATIC_SIZE = 3 * STATIC_CORNERS };

typedef struct StaticElement {
    int corners;
    double force[STATIC_CORNERS][3];             /* of the stress on the corners */
    double area[STATIC_CORNERS][3];              /* area vectors that take the pressure, orientation included */
    double stiffness[STATIC_SIZE * STATIC_SIZE]; /* row-major, leading dimension STATIC_SIZE: -d force/dx, made positive
                                                   semidefinite, less the change of pressure x area */
    double scale[STATIC_CORNERS];                /* stiffness of the corner in the reference, of any direction */
    double energy;                               /* stored [energy], hourglass energy apart */
    double hourglass;
    double volume; /* below it, about the origin [L3] */
} StaticElement;

/* Element number lane of a block, with its corners x (corner_count rows). stiffness: whether the change is wanted too;
 * then pressure is that on the area vectors. */
void static_element(const ElementGroup *group, const StaticLaw *law, int block, int lane, double x[][3],
                    const double origin[3], bool stiffness, double pressure, StaticElement *element);

#endif
