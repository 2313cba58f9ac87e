/* *LOAD_RIGID_BODY: forces on the centres of mass of rigid bodies and moments about them. */
#ifndef BILLOW_RIGID_LOADS_H
#define BILLOW_RIGID_LOADS_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/curve.h"

/* Immutable; built by solver/build_rigid_loads.c. The load is scale * curve(t) along a direction. */
typedef struct RigidLoad {
    int body;  /* index into Model.rigid_bodies */
    int curve; /* index into Model.curves */
    bool moment;
    bool follower; /* direction is the current normal of nodes m[0..2]: (m1 - m0) x (m2 - m0) */
    double scale;
    double direction[3]; /* unit, global axes */
    int32_t m[3];
} RigidLoad;

/* Force and moment about the centre of mass, global axes. */
typedef struct RigidWrench {
    double force[3], moment[3];
} RigidWrench;

/* Sum of the loads (count) of one body at time; x are the positions of all nodes then (eq. M24). */
void rigid_loads_at(const RigidLoad *loads, int count, int body, const Curve *curves, double time, const double *x,
                    RigidWrench *wrench);

/* Work of a wrench over a step of dt_mean, on the means of the velocities and spins before and after (eq. M25). */
double rigid_loads_work(const RigidWrench *wrench, const double v_before[3], const double v_after[3],
                        const double spin_before[3], const double spin_after[3], double dt_mean);

#endif
