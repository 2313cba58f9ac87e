/* What opens the exits for good. */
#include "airbag/gas_pop.h"

#include <math.h>

static const double NEVER = 1e300;

bool gas_pops_by_acceleration(const GasModel *gas)
{
    const double *a = gas->pop.acceleration;
    return a[0] > 0.0 || a[1] > 0.0 || a[2] > 0.0 || gas->pop.magnitude > 0.0;
}

/* Without PPOP the pressure counts as reached, unless an acceleration is waited for. */
void gas_start_pop(const GasModel *gas, GasState *state)
{
    bool waits = gas->pop_pressure > 0.0 || gas_pops_by_acceleration(gas);
    state->open_time = waits ? NEVER : gas->pop.delay;
    state->opened = state->open_time <= 0.0 ? 1.0 : 0.0;
    gas_check_pop(gas, 0.0, state);
}

void gas_check_pop(const GasModel *gas, double time, GasState *state)
{
    if (state->opened > 0.0) return;
    bool pressure =
        gas->pop_pressure > 0.0 && !(state->flat > 0.0) && state->pressure - gas->ambient_pressure >= gas->pop_pressure;
    if (pressure) state->open_time = fmin(state->open_time, time + gas->pop.delay);
    if (time >= state->open_time) state->opened = 1.0;
}

void gas_sense_pop(const GasModel *gas, const double acceleration[3], double time, double dt, GasState *state)
{
    const PopCriterion *pop = &gas->pop;
    double square = 0.0;
    bool beyond = false;
    for (int i = 0; i < 3; i++) {
        square += acceleration[i] * acceleration[i];
        beyond |= pop->acceleration[i] > 0.0 && fabs(acceleration[i]) > pop->acceleration[i];
    }
    beyond |= pop->magnitude > 0.0 && sqrt(square) > pop->magnitude;
    if (!beyond) return;
    state->pop_time += dt;
    if (state->pop_time >= pop->duration * (1.0 - 1e-9))
        state->open_time = fmin(state->open_time, time + pop->acceleration_delay);
}
