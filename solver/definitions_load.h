/* Supports, motion, loads, velocities and damping of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_LOAD_H
#define BILLOW_DEFINITIONS_LOAD_H

#include <stdbool.h>

#include "solver/diagnostics.h"

typedef struct SpcDefinition { /* *BOUNDARY_SPC_NODE / _SET (_ID, _BIRTH_DEATH) */
    bool is_set;
    int id, cid;
    int dof[6]; /* x y z rx ry rz, 1 = fixed */
    double birth, death;
    Source source;
} SpcDefinition;

typedef struct PrescribedMotionDefinition {
    enum { MOTION_NODE, MOTION_SET, MOTION_RIGID } kind;
    int id, dof, vad, lcid, vid;
    double sf, death, birth;
    double offset1, offset2; /* card 2 for |dof| = 9, 10, 11 */
    Source source;
} PrescribedMotionDefinition;

typedef struct InitialVelocityDefinition {
    enum {
        VELOCITY_ALL,        /* *INITIAL_VELOCITY: nsid (0 = all), nsidex, boxid, irigid */
        VELOCITY_NODE,       /* *INITIAL_VELOCITY_NODE: id */
        VELOCITY_GENERATION, /* id of styp; omega about an axis */
        VELOCITY_RIGID_BODY  /* part id */
    } kind;
    int id, styp, nsidex, boxid, irigid, icid, phase, ivatn;
    double v[3], w[3];   /* translation and rotation rates */
    double vx_exempt[6]; /* card for exempted nodes: vxe vye vze vxre vyre vzre */
    double omega, centre[3], axis[3];
    Source source;
} InitialVelocityDefinition;

typedef struct NodeLoadDefinition { /* *LOAD_NODE_POINT / _SET */
    bool is_set;
    int id, dof, lcid, cid, m1, m2, m3;
    double sf;
    Source source;
} NodeLoadDefinition;

typedef struct RigidLoadDefinition { /* *LOAD_RIGID_BODY */
    int pid, dof, lcid, cid, m1, m2, m3;
    double sf;
    Source source;
} RigidLoadDefinition;

typedef struct SegmentLoadDefinition { /* *LOAD_SEGMENT / _SET (_ID): pressure from curve lcid times sf, arrival time at
                                        */
    bool is_set;
    int id; /* set id, or 0 */
    int lcid;
    double sf, at;
    int node[4];
    Source source;
} SegmentLoadDefinition;

typedef struct BodyLoadDefinition { /* *LOAD_BODY_X/Y/Z/VECTOR */
    int axis;                       /* 0, 1, 2; 3: along the vector, of length 1 */
    double vector[3];
    int lcid, lciddr, cid;
    double sf, xc, yc, zc;
    Source source;
} BodyLoadDefinition;

typedef struct GravityPartDefinition { /* *LOAD_GRAVITY_PART / _SET */
    bool is_set;
    int id, dof, lc, lcdr, stga, stgr;
    double accel;
    Source source;
} GravityPartDefinition;

typedef struct DampingDefinition { /* *DAMPING_GLOBAL (part 0) and *DAMPING_PART_MASS(_SET) */
    bool is_global, is_set;
    int id, lcid, flag;
    double sf;    /* factor on the curve, or valdmp of DAMPING_GLOBAL when lcid = 0 */
    double st[6]; /* scale factors x y z rx ry rz; all zero means all one */
    Source source;
} DampingDefinition;

#endif
