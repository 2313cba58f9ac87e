/* The jet of an inflator: where it points, how its pressure is spread over the bag (docs/theory.md, J1 to J9). */
#ifndef BILLOW_JET_H
#define BILLOW_JET_H

#include <stdbool.h>
#include <stdint.h>

#include "airbag/gas_jet.h"

/* One facet of the bag's surface. */
typedef struct JetFacet {
    int32_t row[4];      /* rows of corner sums of its corners, counted from its chunk's first */
    int8_t corner_count; /* 3 or 4 */
    bool target;         /* in PSID, or PSID = 0: takes the jet's pressure */
    int64_t slot;        /* padded element index, for State.eroded */
} JetFacet;

/* Immutable. Curve members are indices, -1 none; their time counts from the start of the inflow. */
typedef struct Jet {
    int airbag;
    bool multiple;      /* velocity over the angle by a curve instead of a cone */
    bool same_momentum; /* _CM */
    bool wedge;         /* two foci */
    bool moving;        /* foci and head are nodes */
    double focus[3], head[3], second[3];
    int32_t focus_node, head_node, second_node;
    double angle; /* CA [rad] */
    int angle_curve;
    double efficiency; /* BETA */
    int efficiency_curve;
    int velocity_curve;           /* LCJRV over the angle in degrees */
    double cut_off;               /* ANGLE [degrees] */
    double spread[2][2];          /* of LCJRV: integrals over the angle, see jet_spread */
    int knock_curve;              /* KNKDN */
    int32_t react_node;           /* NREACT, -1 none */
    int facet_count, first_facet; /* first: in State.jet_shape */
    int chunk_count;              /* facets of one segment of elements each: no two chunks share a row */
    int *chunk_start;             /* first facet of each chunk (chunk_count + 1) */
    JetFacet *facet;              /* (facet_count) */
    int8_t *side;                 /* +1: the normal by the order of the nodes points out of the bag (facet_count) */
    int32_t *node;                /* nodes of the facets (facet_count x 4), triangles repeat the third */
    int row_count, first_weight;  /* rows of corner sums of all chunks; first: in State.jet_weight */
    int *segment_chunk;           /* chunk of each segment of elements, -1 none (segment_count) */
    int *chunk_row;               /* first row of each chunk in the model's table (chunk_count) */
    int *chunk_weight;            /* place of that row among the jet's (chunk_count + 1) */
    int8_t *chunk_sign;           /* +1: the rows' area vectors point out of the bag (chunk_count) */
    int32_t *row_node;            /* node of each of the jet's rows (row_count) */
} Jet;

/* What acts on one row of corner sums, in the State buffer (J12). */
typedef struct JetWeight {
    double shape;  /* the jet's pressure there is strength times it */
    double hidden; /* share of the row's area that the jet does not see, if KNKDN asks for it */
} JetWeight;

/* Plain data in the State buffer. */
typedef struct JetState {
    double next_view; /* time at which the line of sight is looked at again */
    int64_t looks;    /* how often it was */
    double force[3];  /* sum of the jet's forces on the surface */
} JetState;

/* The jet at one time. */
typedef struct JetFrame {
    double focus[3], axis[3]; /* axis: unit vector along the jet */
    double across[3],
        distance; /* from the first to the second focus, normal to the axis: unit vector, length; 0: cone */
    double angle;
    double strength; /* pressure = strength times shape */
    bool active;     /* gas flows in, and the jet has a direction */
    double knock;    /* factor of the bag's pressure on facets that the jet does not see */
} JetFrame;

/* Time integrals of LCJRV, once at the build: spread[0] of the velocity, [1] of its square; [0] times sine, [1] plain
 * (J8). */
void jet_spread(Jet *jet, const Curve *curves);

/* The frame at a time for the gas's jet; x positions (.. x 3). A degenerate axis gives no jet. */
JetFrame jet_frame(const Jet *jet, const Curve *curves, const double *x, const GasJet *gas, double time);

/* The point of the focal line that the jet comes from to a point. */
void jet_origin(const JetFrame *frame, const double point[3], double origin[3]);

/* Shape of the pressure at a point that the jet comes to from origin (J5 to J9), bounded by the facet's area [1/L2, for
 * jets without _CM 1/L4]. 0 where the jet does not reach. */
double jet_shape(const Jet *jet, const Curve *curves, const JetFrame *frame, const double point[3],
                 const double origin[3], double area);

#endif
