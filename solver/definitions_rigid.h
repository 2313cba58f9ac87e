/* Parts, rigid bodies and rigid walls of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_RIGID_H
#define BILLOW_DEFINITIONS_RIGID_H

#include <stdbool.h>

#include "solver/billow.h"
#include "solver/diagnostics.h"

/* Cards of *PART_INERTIA and *CONSTRAINED_NODAL_RIGID_BODY_INERTIA. */
typedef struct InertiaCard {
    double centre[3], tm;
    int ircs, nodeid;
    double i[6]; /* xx xy xz yy yz zz */
    double v[3], w[3];
    double x_axis[3], in_plane[3]; /* IRCS = 1: vectors of the local axes, unless cid */
    int cid;
    Source source, tensor_source, axes_source;
} InertiaCard;

typedef struct PartDefinition {
    int id, section, material, eosid, hourglass, grav, adpopt, tmid;
    char title[BILLOW_TITLE_LENGTH];
    bool has_inertia;
    InertiaCard inertia;
    Source source;
} PartDefinition;

typedef struct RigidMergeDefinition { /* *CONSTRAINED_RIGID_BODIES: part other becomes one body with part lead */
    int lead, other, iflag;
    Source source;
} RigidMergeDefinition;

typedef struct ExtraNodesDefinition { /* *CONSTRAINED_EXTRA_NODES_NODE / _SET: nodes that follow a rigid part */
    bool is_set;
    int part, id, iflag;
    Source source;
} ExtraNodesDefinition;

typedef struct NodalRigidBodyDefinition { /* *CONSTRAINED_NODAL_RIGID_BODY: a node set as a rigid body */
    int id, cid, nsid, pnode, iprt, drflag, rrflag;
    bool has_spc, has_inertia;
    double cmo, con1, con2;
    char title[BILLOW_TITLE_LENGTH];
    InertiaCard inertia;
    Source source, spc_source;
} NodalRigidBodyDefinition;

/* *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC_FLAT, _SPHERE, _CYLINDER, _PRISM with their options. */
typedef struct RigidWallDefinition {
    enum { RIGIDWALL_PLANAR, RIGIDWALL_FLAT, RIGIDWALL_SPHERE, RIGIDWALL_CYLINDER, RIGIDWALL_PRISM } kind;
    bool finite, moving, motion; /* options: card with edges, with mass, with a curve */
    int id;                      /* 0 without _ID */
    char title[BILLOW_TITLE_LENGTH];
    int nsid, nsidex, boxid;
    double offset, birth, death, rwksf;
    double tail[3], head[3], fric, wvel;
    double edge[3], lenl, lenm, lenp; /* edge: head of the vector l, whose tail is that of n */
    double radius, lencyl;
    double mass, v0;
    int lcid, opt;
    double v[3];
    Source source, plane_source, edge_source, moving_source;
} RigidWallDefinition;

#endif
