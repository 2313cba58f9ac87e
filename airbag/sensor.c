/* Airbag sensors: levels in the rigid body's own axes, or a user's function. */
#include "airbag/sensor.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* (N1): components along the axes that turn with the body. */
static void local_of(const double axes[9], const double global[3], double local[3])
{
    for (int i = 0; i < 3; i++)
        local[i] = axes[3 * i] * global[0] + axes[3 * i + 1] * global[1] + axes[3 * i + 2] * global[2];
}

static double size_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Whether x, y, z (i < 3) or the magnitude has reached its level. */
static bool reached(const double level[4], const double local[3], int i)
{
    double size = i < 3 ? fabs(local[i]) : size_of(local);
    return level[i] > 0.0 && size >= level[i];
}

/* (N2), (N3). */
static bool levels_reached(const Sensor *sensor, const BillowSensorInput *motion, SensorState *state)
{
    bool fires = false;
    for (int i = 0; i < 4; i++) {
        if (reached(sensor->acceleration, motion->acceleration, i)) {
            state->exceeded[i] += motion->step;
            fires |= state->exceeded[i] >= sensor->duration && state->exceeded[i] > 0.0;
        }
        fires |= reached(sensor->velocity, motion->velocity, i);
        fires |= reached(sensor->displacement, motion->displacement, i);
    }
    return fires;
}

bool sensor_fires(const Sensor *sensor, const SensorMotion *motion, SensorState *state)
{
    if (state->fired > 0.0) return false;
    BillowSensorInput input = {.version = BILLOW_SENSOR_VERSION,
                               .airbag = sensor->airbag_id,
                               .part = sensor->part_id,
                               .count = sensor->constant_count,
                               .constant = sensor->constant,
                               .time = motion->time,
                               .step = motion->step};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) /* the turned axis: turn applied to the row */
            input.axes[3 * i + k] = motion->turn[3 * k] * sensor->axes[3 * i] +
                                    motion->turn[3 * k + 1] * sensor->axes[3 * i + 1] +
                                    motion->turn[3 * k + 2] * sensor->axes[3 * i + 2];
    memcpy(input.global_acceleration, motion->acceleration, sizeof input.global_acceleration);
    memcpy(input.global_velocity, motion->velocity, sizeof input.global_velocity);
    memcpy(input.global_displacement, motion->displacement, sizeof input.global_displacement);
    local_of(input.axes, motion->acceleration, input.acceleration);
    local_of(input.axes, motion->velocity, input.velocity);
    local_of(input.axes, motion->displacement, input.displacement);
    bool fires =
        sensor->function ? sensor->function(&input, state->history) != 0 : levels_reached(sensor, &input, state);
    if (fires) state->fired = 1.0;
    return fires;
}
