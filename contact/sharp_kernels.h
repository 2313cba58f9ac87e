/* Edges at which a surface is turned, the lanes of a group at a time. */
#ifndef BILLOW_CONTACT_SHARP_KERNELS_H
#define BILLOW_CONTACT_SHARP_KERNELS_H

#include "contact/contact_motion.h"

/* One instruction set; all give the same. */
typedef struct SharpKernels {
    /* Lanes of edges at which the surface is folded over, or turned by more than the angles whose sines squared are
     * given; x: positions (node_count x 3). */
    void (*turned)(const ContactLanes *edges, const double *x, const float square[2], unsigned set[2]);
} SharpKernels;

extern const SharpKernels sharp_kernels_v2, sharp_kernels_v3, sharp_kernels_v4;

#endif
