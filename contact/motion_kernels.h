/* What contact follows from cycle to cycle, once per instruction set: velocities of groups, the slack of their pairs,
 * the ways of nodes since the last search. */
#ifndef BILLOW_CONTACT_MOTION_KERNELS_H
#define BILLOW_CONTACT_MOTION_KERNELS_H

#include "contact/contact_motion.h"

/* Pairs of one group with others, and the step (eq. C15). */
typedef struct ContactWatch {
    const ContactGroups *own, *others;
    int group;
    float before;  /* step that led here [T] */
    float longer;  /* the step that contact reckons with, not less than that or the next [T] */
    float least;   /* no more than the largest thickness of two items of each pair [L] */
    float deepest; /* a pair is awake that its items may meet by so much earlier [L] */
} ContactWatch;

/* One instruction set; the bits of what is found are those of any other, or err on the safe side alone. */
typedef struct MotionKernels {
    /* Velocities of the watched groups [first, end). */
    void (*follow)(ContactGroups *groups, const double *v, int first, int end);
    /* Up to CONTACT_GROUP pairs: takes the last step off their slack; bits of those that are awake, and how fast each
     * may close (CONTACT_GROUP numbers, aligned). */
    unsigned (*wake)(const ContactWatch *watch, const int32_t *other, float *slack, int count, float *speed);
    ContactOverlap *overlap;
    /* Ways x + pending v and speeds of count nodes against the origin's into drift and fastest of *motion. */
    void (*drift)(ContactMotion *motion, const double *x, const double *v, const DriftOrigin *origin, double pending,
                  int count);
} MotionKernels;

extern const MotionKernels motion_kernels_v2, motion_kernels_v3, motion_kernels_v4;

#endif
