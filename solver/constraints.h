/* Supports, prescribed motion and hanging nodes: what acts on velocities after Newton's law. */
#ifndef BILLOW_CONSTRAINTS_H
#define BILLOW_CONSTRAINTS_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/curve.h"
#include "solver/rate_rows.h"

/* A support: components fixed in a local frame between birth and death (birth <= t_n < death). */
typedef struct Support {
    int32_t node;
    bool fixed[3];
    bool local;     /* axes below differ from the global ones */
    double axes[9]; /* rows */
    double birth, death;
} Support;

/* Prescribed displacement (vad 2), velocity (0) or acceleration (1) of a node or rigid body along a direction. */
typedef struct PrescribedMotion {
    int32_t node;   /* -1: rigid body */
    int rigid_body; /* index into Model.rigid_bodies or -1 */
    int vad;
    bool rotation;       /* rigid bodies: dof 5, 6, 7 or 8: rate or angle about direction */
    double direction[3]; /* unit, global axes */
    bool only_direction; /* dof -4: no movement across the direction; else the other components stay free */
    int curve;
    double scale, birth, death; /* the curve's abscissa is t - birth */
    int order;                  /* of its card in the deck: earlier cards go first where directions depend */
} PrescribedMotion;

/* Node tied to the middle of an edge (hanging node of mesh refinement). */
typedef struct HangingNode {
    int32_t node, end[2];
} HangingNode;

typedef struct Constraints {
    int support_count, motion_count, hanging_count;
    Support *supports;         /* sorted by node */
    PrescribedMotion *motions; /* of nodes, sorted by node, then those of rigid bodies */
    HangingNode *hanging;      /* masters first where chains occur */
    int node_motion_count;     /* the first so many motions are of nodes */
} Constraints;

/* Adds each hanging node's force, half to each end (slaves of slaves first), and clears it. f: (.. x 3). */
void constraints_fold_forces(const Constraints *constraints, double *f);

/* Mass of hanging nodes goes to the ends likewise, once, at build. mass: (..). */
void constraints_fold_mass(const Constraints *constraints, double *mass);

/* Applies supports and prescribed motion to the half-step velocities v (.. x 3, after Newton's law) for the step from
 * time to time + dt_next; v_before (.. x 3) are the velocities at the previous half step, mass (..) the nodal masses:
 * the reaction's work over the mean velocity is added to *work (may be NULL). x: positions at time, initial: positions
 * at 0: displacements with birth 0 are met exactly at time + dt_next. dt_mean = (dt_{n-1/2} + dt_{n+1/2}) / 2.
 * A prescribed motion goes before a support in the same direction. Rigid bodies' motions are skipped. */
void constraints_apply(const Constraints *constraints, const Curve *curves, double time, double dt_mean, double dt_next,
                       const double *x, const double *initial, const double *mass, const double *v_before, double *v,
                       double *work);

/* Velocity rule of one motion for the step from time to time + dt_next: the component along its direction at the coming
 * half step. before: this component at the previous half step; path: displacement along the direction at time since the
 * start (not for rotations). False if the motion is not active. */
bool constraints_motion_rate(const PrescribedMotion *motion, const Curve *curves, double time, double dt_mean,
                             double dt_next, double before, double path, double *rate);

/* Adds to rows the directions in which a node is held or driven at the time, with rate 0. */
void constraints_held(const Constraints *constraints, int32_t node, double time, RateRows *rows);

/* Velocities of hanging nodes: the mean of their ends', so that a node keeps its place relative to the edge's middle
 * and the forces folded to the ends do the same work. v: (.. x 3). */
void constraints_place_hanging(const Constraints *constraints, double *v);

/* Makes initial velocities v (.. x 3) agree with the supports active at time 0 and the hanging nodes. */
void constraints_start(const Constraints *constraints, double *v);

#endif
