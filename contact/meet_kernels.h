/* What is near or crosses, of the candidates that a group of owners may touch: eight at a time in double precision. */
#ifndef BILLOW_CONTACT_MEET_KERNELS_H
#define BILLOW_CONTACT_MEET_KERNELS_H

#include <stdint.h>

#include "solver/model.h"

enum { MEET_LANES = 8 };

/* Nodes of each pair; all lanes have some. */
typedef struct MeetNodes {
    _Alignas(64) int32_t node[4][MEET_LANES];
} MeetNodes;

/* Nodes with triangles: a node and three corners each; lanes without a pair have four times the same node. */
typedef struct MeetFaces {
    MeetNodes nodes;
    ContactMemory *memory[MEET_LANES]; /* NULL: none */
    _Alignas(64) double thickness[MEET_LANES];
    double depth[MEET_LANES], remembered[MEET_LANES]; /* how much farther the node looks [L] */
    /* found; contact/contact_geometry.h */
    double weight[3][MEET_LANES], normal[3][MEET_LANES], toward[3][MEET_LANES];
    double height[MEET_LANES], distance[MEET_LANES];
    double speed[3][MEET_LANES]; /* of the node against the closest point [L/T] */
    int64_t feature[MEET_LANES];
    unsigned near;  /* lanes within reach */
    unsigned touch; /* lanes that may touch in this step by their own velocity */
} MeetFaces;

/* Edges with edges: the ends of both. */
typedef struct MeetEdges {
    MeetNodes nodes;
    int32_t own[MEET_LANES], other[MEET_LANES];
    ContactMemory *memory[MEET_LANES]; /* NULL: none */
    _Alignas(64) double thickness[MEET_LANES];
    double remembered[MEET_LANES]; /* how much farther they look [L] */
    double slack[MEET_LANES];      /* by which share of an edge a crossing may be beyond its ends */
    /* found */
    double weight[4][MEET_LANES]; /* of the ends, signed, at the crossing */
    double normal[3][MEET_LANES]; /* unit normal of both lines: first x second */
    double height[MEET_LANES];    /* of the first line over the second */
    double speed[3][MEET_LANES];  /* of the first against the second [L/T] */
    unsigned cross;               /* lanes whose lines cross within both and within reach */
} MeetEdges;

/* Nodes now, and the step that contact reckons with. */
typedef struct MeetStep {
    const double *x, *v;
    double longer;
} MeetStep;

/* One instruction set; the bits are those of any other. */
typedef struct MeetKernels {
    void (*faces)(const MeetStep *step, MeetFaces *block, int blocks);
    /* Lanes whose edges may cross: all that do, and few that do not. */
    unsigned (*may_cross)(const MeetStep *step, const MeetNodes *nodes);
    void (*edges)(const MeetStep *step, MeetEdges *block, int blocks);
} MeetKernels;

extern const MeetKernels meet_kernels_v2, meet_kernels_v3, meet_kernels_v4;

#endif
