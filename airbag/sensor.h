/* Sensors that start the inflow of an airbag: levels of acceleration, velocity and displacement of a rigid body, or a
 * user's function (docs/theory.md, N1 to N4). */
#ifndef BILLOW_SENSOR_H
#define BILLOW_SENSOR_H

#include <stdbool.h>

#include "airbag/billow_sensor.h"

typedef struct Sensor {
    int airbag_id, part_id;
    int rigid_body; /* index into the model's, -1: a part that never moves, whose sensor sees nothing */
    double axes[9]; /* local x, y, z as rows at time 0, global components */
    /* levels of x, y, z and the magnitude; 0: inactive */
    double acceleration[4], velocity[4], displacement[4];
    double duration;                /* cumulated time above a level of the acceleration */
    BillowSensorFunction *function; /* RBID > 0; NULL: the levels decide */
    int constant_count;
    double constant[BILLOW_SENSOR_CONSTANTS];
} Sensor;

/* Plain data in the State buffer. */
typedef struct SensorState {
    double exceeded[4]; /* time above each level of the acceleration [T] */
    double start[3];    /* the body's velocity at time 0 [L/T] */
    double fired;       /* 1 once it has */
    double history[BILLOW_SENSOR_HISTORY];
} SensorState;

/* Motion of the body's centre, global axes: acceleration of the last step, velocity and displacement less those at the
 * start; turn: rotation matrix since the start. */
typedef struct SensorMotion {
    double time, step;
    double acceleration[3], velocity[3], displacement[3], turn[9];
} SensorMotion;

/* True if the sensor fires in this cycle; state->fired is set. */
bool sensor_fires(const Sensor *sensor, const SensorMotion *motion, SensorState *state);

#endif
