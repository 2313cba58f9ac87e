/* The element pass of triangles without a material, with and without what a gas needs of it. */
#ifndef BILLOW_AREA_PASS_H
#define BILLOW_AREA_PASS_H

#include "elements/kernels.h"

/* Gathers the corners of a group's blocks and adds the edges as forces to the rows of corner sums. plain: no more;
 * with_gas: also area vectors (to the rows), volume and area (to sums). */
typedef struct AreaPass {
    ElementKernel *plain, *with_gas;
} AreaPass;
extern const AreaPass area_pass_v2, area_pass_v3, area_pass_v4;

#endif
