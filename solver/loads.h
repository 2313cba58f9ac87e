/* Point loads, pressure loads on segments, gravity and mass-proportional damping. */
#ifndef BILLOW_LOADS_H
#define BILLOW_LOADS_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/curve.h"
#include "solver/rigid_loads.h"

/* *LOAD_NODE: force scale * curve(t) along a direction, or following a triangle's normal. */
typedef struct NodeLoad {
    int32_t node;
    int curve;
    double scale;
    double direction[3]; /* unit, global axes */
    bool follower;       /* direction is the current normal of nodes m[0..2]: (m1 - m0) x (m2 - m0) */
    int32_t m[3];
} NodeLoad;

/* *LOAD_SEGMENT: p(t) = scale * curve(t - arrival) from the arrival on, acting against the segment's normal. */
typedef struct SegmentLoad {
    int curve;
    double scale, arrival;
} SegmentLoad;

enum { BILLOW_GRAVITIES = 9, BILLOW_DAMPINGS = 6 };

/* A class of nodes with equal body acceleration and mass damping. Index 0 is always the empty class.
 * a += g(t); damping force -m D (v - v_ref), D per axis. */
typedef struct BodyClass {
    int gravity_count;
    struct {
        int axis, curve; /* curve -1: constant 1 */
        double scale;
    } gravity[BILLOW_GRAVITIES]; /* acceleration of the nodes = scale * curve(t) along axis */
    int damping_count;
    struct {
        int curve; /* -1: constant 1 */
        double scale;
        double factor[6]; /* D = scale * curve(t) * factor; x y z, and for rigid bodies rotation about x y z */
    } damping[BILLOW_DAMPINGS];
    int airbag; /* mass-weighted damping of this bag against its mean velocity, -1 none */
    double airbag_damping;
} BodyClass;

typedef struct Loads {
    int node_load_count, class_count, rigid_load_count;
    NodeLoad *node_loads;
    RigidLoad *rigid_loads;
    BodyClass *classes;
} Loads;

/* Value of a class at time t: g (acceleration added to every node of the class) and D (1/T), without the airbag's. */
void loads_class_at(const BodyClass *body_class, const Curve *curves, double time, double g[3], double damping[3]);

/* The same with the rotational rates of rigid bodies in damping[3..5]. */
void loads_body_at(const BodyClass *body_class, const Curve *curves, double time, double g[3], double damping[6]);

/* Adds the point loads at time to f (.. x 3); x are the positions at time. */
void loads_apply_points(const Loads *loads, const Curve *curves, double time, const double *x, double *f);

/* Work of the point loads over one step: sum of f . (v_before + v) / 2 * dt_mean, v half-step velocities (.. x 3). */
double loads_points_work(const Loads *loads, const Curve *curves, double time, const double *x, const double *v_before,
                         const double *v, double dt_mean);

/* Pressure of one segment load at time; 0 before its arrival. */
double loads_segment_pressure(const SegmentLoad *load, const Curve *curves, double time);

#endif
