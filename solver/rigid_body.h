/* Moving rigid bodies: six degrees of freedom, inertia from their shells' lumped nodal masses. */
#ifndef BILLOW_RIGID_BODY_H
#define BILLOW_RIGID_BODY_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/constraints.h"

/* Immutable. Built by rigid_body_build; arrays owned by the Model. */
typedef struct RigidBody {
    int part_id;      /* user's id of the part, of the lead of merged ones, or of the nodal rigid body */
    bool nodal;       /* of *CONSTRAINED_NODAL_RIGID_BODY: no part of that id need be there */
    bool merged;      /* of several parts, or with nodes of other parts */
    bool given;       /* mass, centre and inertia are those of a card, not of the nodes */
    bool overwritten; /* it does not start with what that card says (IRIGID, *INITIAL_VELOCITY_RIGID_BODY) */
    int node_count;
    int32_t *node;     /* internal indices, ascending (node_count) */
    double *offset;    /* from the centre of mass, along the principal axes, at time 0 (node_count x 3) [L] */
    double mass;       /* [M] */
    double centre[3];  /* initial centre of mass [L] */
    double inertia[3]; /* principal moments [M L2]; a vanishing one (all mass on a line) does not rotate freely */
    double axes[9];    /* principal axes as rows, at time 0 */
    bool fix_translation[3], fix_rotation[3]; /* in the frame of constraint_axes (CMO, CON1, CON2) */
    double constraint_axes[9];                /* rows, fixed in space; identity for CMO = 1 */
    double velocity[3], spin[3];              /* initial, of the centre and about it */
    double reach;                             /* largest distance of a node from the centre [L] */
    int body_class;                           /* its part's gravity and damping: index into Loads.classes */
} RigidBody;

/* Motion at a full step, for output. */
typedef struct RigidOutput {
    double x[3];        /* centre of mass */
    double v[3];        /* of the centre */
    double rotation[4]; /* unit quaternion: initial body axes -> current */
    double spin[3];     /* global axes */
} RigidOutput;

/* Mutable, plain data in the State buffer. Between steps x and rotation are those of the coming t_n; rigid_body_step
 * moves them on to t_{n+1}, so writers called within the step take output instead. */
typedef struct RigidState {
    double x[3];                /* centre of mass at t_n */
    double v[3];                /* at the half step */
    double a[3];                /* at t_n */
    double rotation[4];         /* unit quaternion (w, x, y, z): initial body axes -> current, at t_n */
    double spin[3];             /* angular velocity, global axes, at the half step */
    double momentum[3];         /* angular momentum about the centre, global axes, at the half step */
    double alpha[3];            /* angular acceleration at t_n */
    double force[3], moment[3]; /* resultants of the nodal forces of the last step, about the centre */
    double kinetic;             /* at t_n of the last step (at the start: initial) */
    RigidOutput output;         /* at t_n of the last step (at the start: initial) */
} RigidState;

enum { BILLOW_RIGID_RATES = 12 };

/* Prescribed rates of one body for the coming half step; earlier entries go before later ones. */
typedef struct RigidPrescription {
    int count;
    struct {
        bool rotation;
        double direction[3]; /* unit, global axes */
        double rate;         /* velocity of the centre, or spin, along direction */
    } item[BILLOW_RIGID_RATES];
} RigidPrescription;

/* Body acceleration, mass damping and what acts beside the nodal forces on one body at t_n. */
typedef struct RigidField {
    double gravity[3];
    double damping[6];          /* translation, rotation about the global axes [1/T] */
    double force[3], moment[3]; /* of contact entities and *LOAD_RIGID_BODY, about the centre */
} RigidField;

/* Work done on the body over a step, by cause; rigid_body_step adds to it. The nodal forces' work is not in it. */
typedef struct RigidWork {
    double reaction; /* of constraints and prescribed motion */
    double gravity;
    double damping; /* energy taken out, >= 0 */
    double forces;  /* of the gathered nodal forces: resultants on the mean velocity and spin */
} RigidWork;

/* Mass, centre, principal inertia and offsets of body->node from nodal masses and positions (x: .. x 3). Returns 0; -1
 * without memory; 1 if the nodes have no mass. */
int rigid_body_build(RigidBody *body, const double *x, const double *mass);

/* Mass, centre and inertia tensor (global axes, about the centre) of a card in place of those of the nodes. Returns 0;
 * 1 if the tensor is none of a body: a principal moment is negative or larger than the sum of the others. */
int rigid_body_give_inertia(RigidBody *body, const double *x, double mass, const double centre[3],
                            const double tensor[9]);

/* Initial state from body->velocity and spin; constrained components start at rest. */
void rigid_body_start(const RigidBody *body, RigidState *state);

/* The prescribed motions of body number index for the step from time to time + dt_next. */
void rigid_body_prescribe(const Constraints *constraints, int index, const RigidBody *body, const RigidState *state,
                          const Curve *curves, double time, double dt_mean, double dt_next,
                          RigidPrescription *prescription);

/* One step: gathers force and moment of f (.. x 3) at the body's nodes at positions x, adds the field's gravity and
 * damping, integrates translation and rotation (angular momentum conserved to rounding, exact for constant spin about a
 * principal axis, second order), and sets the nodes' velocities v = (x_{n+1} - x_n) / dt_next so that x + dt_next v is
 * rigid to rounding. dt_mean = (dt_{n-1/2} + dt_{n+1/2}) / 2. field, prescription and work may be NULL. */
void rigid_body_step(const RigidBody *body, RigidState *state, const double *x, const double *f,
                     const RigidField *field, const RigidPrescription *prescription, double dt_mean, double dt_next,
                     double *v, RigidWork *work);

/* Spin that an angular momentum about the centre (global axes) means at the present rotation: I^-1 L. */
void rigid_body_spin_of(const RigidBody *body, const RigidState *state, const double momentum[3], double spin[3]);

/* Kinetic energy at the half step of the state as it stands. */
double rigid_body_kinetic(const RigidBody *body, const RigidState *state);

#endif
