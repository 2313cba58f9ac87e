/* Airbag sensors in the step: on the rigid bodies at t_n, after the gas has reached t_n. */
#include <math.h>

#include "solver/vector3.h"
#include "solver/workspace.h"

static void wake(Workspace *w, int number)
{
    const Airbag *bag = &w->model->airbags[number];
    GasState *gas = &w->state->gas[number];
    gas_wake(&bag->gas, w->curves, bag->vsca, bag->psca, w->plan.time, gas);
    if (bag->gas.kind == GAS_FLUID_AND_GAS) step_fluid_begin(w, number);
}

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
        if (sensor_fires(sensor, &motion, state)) wake(w, m->sensor_airbag[i]);
    }
}
