/* Distances of the pairs of two groups from below: which may touch in this step, and how far off the next is. */
#ifndef BILLOW_CONTACT_NEAR_KERNELS_H
#define BILLOW_CONTACT_NEAR_KERNELS_H

#include "contact/contact_motion.h"

/* A pair that may touch: lanes, and its squared distance from below but for the margin. */
typedef struct ContactNearby {
    int16_t owner, other;
    float square;
} ContactNearby;

/* Two groups. */
typedef struct ContactLook {
    const ContactLanes *owners, *others;
    const double *x;     /* positions now */
    const double *depth; /* how much farther each node looks (node_count) [L] */
    double deepest;      /* the largest depth of the owners; for edges 0 [L] */
    double reach;        /* pairs nearer than this are found [L] */
    int count;           /* of pairs found */
    double margin;       /* what rounding may have added to distances [L] */
    double nearest;      /* no pair of them is nearer; DBL_MAX without a pair that may meet */
    ContactNearby found[CONTACT_GROUP * CONTACT_GROUP];
} ContactLook;

/* One instruction set. What they find may differ by rounding; what is left out is farther than reach in all. */
typedef struct NearKernels {
    void (*faces)(ContactLook *look); /* owners are nodes, others triangles */
    void (*edges)(ContactLook *look); /* both are edges; in one group each pair once */
    /* Items whose gap is no more than more + limit of their slot, in their order; returns how many. All arrays but
     * limit are readable, and picked has room, for CONTACT_GROUP beyond count. */
    int (*pick)(const float *gap, const int32_t *slot, const int32_t *item, int count, const float *limit, float more,
                int32_t *picked);
} NearKernels;

extern const NearKernels near_kernels_v2, near_kernels_v3, near_kernels_v4;

#endif
