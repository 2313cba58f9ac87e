/* The law of pairs that are near: penalty, damping, friction and limit (docs/theory.md, Contact), eight pairs at a time
 * in double precision. */
#ifndef BILLOW_CONTACT_PUSH_KERNELS_H
#define BILLOW_CONTACT_PUSH_KERNELS_H

#include <stdint.h>

#include "solver/model.h"

enum { PUSH_LANES = 8 };

/* (w dt)^2 of a pair by itself at a share of 1, as SOFSCL gives it; 0.1 is the default (eq. C4). */
#define CONTACT_STIFFNESS 5.0

/* What a pair needs to know of each of its nodes. */
typedef struct ContactNode {
    _Alignas(32) double load; /* of its pairs in the last cycle, eq. C6 */
    double firm;              /* of those of them at the limit of eq. C13 */
    double inverse;           /* inverse mass that contact feels [1/M] */
    double unused;
    double room[8]; /* as of State.contact_formed: (w dt)^2 that contact may add in direction d is 1/(d . room d); xx yy
                     * zz xy yz zx, two zeros */
} ContactNode;

/* Acceleration of a node by its elements and the gas. */
typedef struct ContactPull {
    _Alignas(32) double a[3]; /* [L/T^2] */
    double unused;
} ContactPull;

/* Coefficients of one interface in one cycle. */
typedef struct ContactLaw {
    const ContactNode *nodes; /* (node_count) */
    const ContactPull *pull;  /* formed of all nodes of the pairs (node_count) */
    double before, next;      /* dt_{n-1/2}, dt_{n+1/2} */
    double longer;            /* the step that stiffness and limit reckon with, eq. C4b */
    double sliding;           /* b for friction's springs */
    double damping;           /* share of critical */
    double static_friction, dynamic_friction, decay;
    double deepest; /* penetration at which a pair is given up [L] */
} ContactLaw;

/* Pairs that are near: nodes and their weights, the first side's positive, whose sum is 0. */
typedef struct PushPairs {
    _Alignas(64) int32_t node[4][PUSH_LANES];
    double weight[4][PUSH_LANES];
    double gap[PUSH_LANES];          /* distance on the side where the pair is taken to be; negative behind [L] */
    double thickness[PUSH_LANES];    /* distance at which it should stay [L] */
    double direction[3][PUSH_LANES]; /* unit vector of the force on the first weights */
    double speed[3][PUSH_LANES];     /* sum of weight v: velocity of the first against the second [L/T] */
    double stiffness[PUSH_LANES];    /* share of the stability limit */
    double known[PUSH_LANES];        /* 1: the pair was in contact and remembers what follows; 0: nothing */
    /* as ContactMemory has them; then what the pair is to remember */
    double last[PUSH_LANES], distance[PUSH_LANES], k[PUSH_LANES], limit[PUSH_LANES], friction[3][PUSH_LANES];
    /* whose these are: for who adds the pairs and takes what becomes of them */
    ContactMemory *memory[PUSH_LANES]; /* NULL: new */
    int32_t owner[PUSH_LANES], other[PUSH_LANES], side[PUSH_LANES];
    /* found */
    _Alignas(64) double force[3][PUSH_LANES]; /* [F] */
    double load[PUSH_LANES];                  /* C of eq. C6 */
    double firm[PUSH_LANES];                  /* the same if the limit acts, else 0 */
    double power[PUSH_LANES];                 /* of the force on the speed [F L/T] */
    unsigned count; /* lanes that count for their nodes' loads: they touch or will in the coming step */
    unsigned keep;  /* lanes that touch: these remember, the others forget */
    unsigned lost;  /* lanes that were in contact and have gone too deep */
    unsigned fast;  /* lanes that met faster than one thickness in a step */
} PushPairs;

/* One instruction set; the bits are those of any other. */
typedef struct PushKernels {
    void (*push)(const ContactLaw *law, PushPairs *block, int blocks);
} PushKernels;

extern const PushKernels push_kernels_v2, push_kernels_v3, push_kernels_v4;

#endif
