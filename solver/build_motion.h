/* From the deck: supports, prescribed motion, hanging nodes, loads, damping, initial velocities and rigid bodies.
 * All node indices are in deck order until motion_renumber. */
#ifndef BILLOW_BUILD_MOTION_H
#define BILLOW_BUILD_MOTION_H

#include "solver/constraints.h"
#include "solver/deck_index.h"
#include "solver/loads.h"
#include "solver/point_mass.h"
#include "solver/rigid_body.h"
#include "solver/sets.h"

enum {
    MOTION_DEFORMABLE = -1, /* codes of Motion.part_body and node_body beside a body's index */
    MOTION_FIXED = -2,      /* rigid part that never moves */
};

/* Nodes of an airbag with mass-weighted damping (MWD). */
typedef struct AirbagNodes {
    int node_count;
    const int32_t *node; /* deck-order indices */
    double mwd;          /* [1/T]; 0: no damping, the bag is skipped */
} AirbagNodes;

/* What the builders need from the model in the making; nothing is owned. */
typedef struct MotionInput {
    const DeckIndex *index;
    const double *x;          /* initial positions (node count x 3) [L] */
    const double *shell_mass; /* of each shell in deck order [M]; weights of part-boundary nodes */
    const double *node_mass;  /* lumped (node count) [M]; set by build_motion */
    int point_mass_count;
    const PointMass *point_masses; /* in node_mass already (point_mass_count) */
    int airbag_count;
    const AirbagNodes *airbags; /* (airbag_count), index = the model's airbag index */
    bool relaxation_phase;      /* the model of the phase before the run: the other curves act (SIDR) */
    bool relaxed;               /* such a phase comes before the run */
} MotionInput;

/* Everything built. Arrays are owned until the Model takes them over; release with motion_free. */
typedef struct Motion {
    int node_count;
    Constraints constraints; /* supports of nodes that never move are left out: see fixed */
    Loads loads;
    int32_t *node_class;  /* index into loads.classes (node_count); NULL if there is no body load or damping */
    unsigned char *fixed; /* 1: the node never moves (node_count) */
    double *velocity;     /* initial, consistent with supports and hanging nodes (node_count x 3) [L/T] */
    int *part_body;       /* of each part in deck order: rigid body index, MOTION_DEFORMABLE or MOTION_FIXED */
    int32_t *node_body;   /* of each node, the same code (node_count) */
    int rigid_body_count;
    RigidBody *rigid_bodies; /* moving ones */
    int segment_load_count;
    SegmentLoad *segment_loads;
    int segment_count;
    int32_t *segment_node;  /* of the pressure segments (segment_count x 4) */
    int *segment_load;      /* index into segment_loads (segment_count) */
    Source *segment_source; /* card of each segment's load (segment_count) */
} Motion;

/* The parts in order; each returns 0, or -1 if it reported an error (the others can still be called). build_motion
 * calls them all: rigid bodies, constraints, fold of the mass, inertia, velocities, loads. mass: lumped nodal masses
 * (node count) [M]; those of hanging nodes are moved to their edge's ends. */
int build_motion(const MotionInput *input, double *mass, Motion *motion, Diagnostics *diagnostics);

/* *MAT_RIGID parts: part_body, node_body, fixed, and bodies with nodes and constraints (no mass yet). */
int build_rigid_bodies(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* *BOUNDARY_SPC, TC of *NODE, *BOUNDARY_PRESCRIBED_MOTION, *CONSTRAINED_ADAPTIVITY. After build_rigid_bodies. */
int build_constraints(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* *INITIAL_VELOCITY...: velocity, and velocity and spin of rigid bodies by momentum; bodies need their inertia. */
int build_velocities(const MotionInput *input, const double *mass, Motion *motion, Diagnostics *diagnostics);

/* *LOAD_NODE, *LOAD_BODY, *LOAD_GRAVITY_PART, *DAMPING, airbags' MWD, *LOAD_SEGMENT. After build_constraints. */
int build_loads(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* Marks with 1 (leaving others) every node that needs the general path: supports, prescribed motion, hanging nodes and
 * their ends, moving rigid bodies, point loads. special: (node_count). */
void motion_mark_special(const Motion *motion, unsigned char *special);

/* Renumbers all node indices: node i of the deck becomes new_index[i] (node_count, a permutation); per-node arrays are
 * permuted, lists sorted anew. 0, or -1 without memory (nothing is then changed). */
int motion_renumber(Motion *motion, const int32_t *new_index);

void motion_free(Motion *motion);

#endif
