/* Airbag sensors in the step: on the rigid bodies at t_n, after the gas has reached t_n. */
#include <math.h>

#include "solver/vector3.h"
#include "solver/workspace.h"

void step_sensors(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; i < m->sensor_count; i++) {
        const Sensor *sensor = &m->sensors[i];
        SensorState *state = &w->state->sensor[i];
        if (state->fired > 0.0 || (sensor->rigid_body < 0 && !sensor->function)) continue;
        SensorMotion motion = {.time = w->plan.time, .step = w->plan.dt_before, .turn = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
        if (sensor->rigid_body >= 0) {
            const RigidState *body = &w->state->rigid[sensor->rigid_body];
            for (int k = 0; k < 3; k++) {
                motion.acceleration[k] = body->a[k];
                motion.velocity[k] = body->v[k] - state->start[k];
                motion.displacement[k] = body->x[k] - m->rigid_bodies[sensor->rigid_body].centre[k];
            }
            quaternion_matrix(body->rotation, motion.turn);
        }
        if (sensor_fires(sensor, &motion, state)) w->state->gas[m->sensor_airbag[i]].inflow_start = w->plan.time;
    }
}
