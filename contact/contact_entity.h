/* Contact entities: smooth shapes that go with a rigid body and that nodes meet by their exact distance
 * (*CONTACT_ENTITY). Theory: docs/theory.md, Smooth impactors. */
#ifndef BILLOW_CONTACT_ENTITY_H
#define BILLOW_CONTACT_ENTITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "contact/convex_hull.h"
#include "contact/revolved_profile.h"
#include "solver/billow.h"
#include "solver/diagnostics.h"

typedef enum EntityShape {
    ENTITY_PLANE,     /* through the origin, normal to the third axis */
    ENTITY_SPHERE,    /* about the origin, radius size[0] */
    ENTITY_CYLINDER,  /* about the third axis, infinite, radius size[0] */
    ENTITY_ELLIPSOID, /* about the origin, half axes size along the axes */
    ENTITY_HULL,      /* the convex mesh of the part, about its origin within the radius size[0] */
    ENTITY_TORUS, /* about the third axis, around the origin: size[0] from the axis to the tube's middle, size[1] the
                   * tube's radius */
    ENTITY_RECTANGLE, /* of ENTITY_PLANE, with the half sides size[0], size[1] along the first two axes */
    ENTITY_PROFILE,   /* a body of revolution about the third axis, within size[0] of the origin */
} EntityShape;

/* Immutable; built by solver/build_entities.c, arrays owned by the Model. A probe is a point that must stay clear of
 * the shape: first the nodes, then points inside segments, which are means of the segment's nodes. */
typedef struct ContactEntity {
    int id; /* counted from 1 in deck order */
    Source source;
    EntityShape shape;
    bool inside;                 /* the nodes belong inside the shape */
    bool open;                   /* a surface with a rim: only what comes through it is held (eq. I13) */
    int part_id;                 /* of the rigid part that it goes with */
    int body;                    /* index into Model.rigid_bodies, -1: the part never moves */
    double origin[3], axes[9];   /* at time 0; axes as rows [L] */
    double size[3];              /* radius, half axes or half sides [L] */
    ConvexHull hull;             /* of ENTITY_HULL */
    RevolvedProfile profile;     /* of ENTITY_PROFILE */
    double friction;             /* Coulomb's coefficient, CF */
    double damping;              /* share of critical, DF/100 */
    double stiffness;            /* share of the stability limit 4 m/dt^2, SF/10 */
    double birth, death;         /* it acts while birth <= t_n < death [T] */
    int probe_count, node_count; /* the first node_count probes are nodes themselves */
    int32_t *node;               /* of each probe, the single node repeated (probe_count x 4) */
    double *weight;              /* (probe_count x 4), sums of 1 */
    double *radius;              /* half the shell's thickness with ITHK, else 0 (probe_count) [L] */
    double thickest;             /* largest of them [L] */
    size_t first_memory;         /* of probe 0 in State.entity_memory */
} ContactEntity;

/* Where a point is: signed distance, negative where it must not be, and the unit vector of the force on it. */
typedef struct EntityGap {
    double distance; /* INFINITY beyond the rim of an open surface [L] */
    double normal[3];
} EntityGap;

/* r: position along the shape's axes from its origin, the normal likewise. Equations (I1) to (I4), (I9) to
 * (I12). */
EntityGap entity_gap(const ContactEntity *entity, const double r[3]);

#endif
