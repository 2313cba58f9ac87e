/* *AIRBAG_LOAD_CURVE: a pressure over time, or a gas of constant temperature (docs/theory.md, G28, G29). */
#include <math.h>

#include "airbag/chamber.h"
#include "airbag/gas_ledger.h"
#include "solver/elementary.h"

static void set_pressure(const GasModel *gas, const Curve *curves, double time, GasState *state)
{
    const LoadCurveLaw *law = &gas->load_curve;
    double since = time - law->start_time;
    state->stiffness = 0.0;
    state->density = state->mass / state->volume;
    if (law->pressure_curve >= 0) {
        state->pressure = since >= 0.0 ? curve_value(&curves[law->pressure_curve], since) : 0.0;
        state->applied = state->pressure;
        return;
    }
    /* C of the initial state: C R0 (T - T0) = PE + P0 */
    double absolute = law->temperature - law->zero;
    double constant = (gas->ambient_pressure + gas->overpressure) / (gas->density * absolute);
    state->temperature = absolute;
    state->pressure = constant * state->density * absolute;
    state->applied = since >= 0.0 ? state->pressure - gas->ambient_pressure : 0.0;
    if (since >= 0.0) state->stiffness = state->pressure / state->volume;
}

static const char *start(const GasModel *gas, const Curve *curves, GasState *state)
{
    const LoadCurveLaw *law = &gas->load_curve;
    state->opened = 1.0;
    if (law->pressure_curve < 0) {
        if (!(gas->density > 0.0)) return "R0 must be positive where LCID = 0";
        if (!(law->temperature > law->zero)) return "T must exceed T0, the absolute zero of its scale, where LCID = 0";
        if (!(gas->ambient_pressure + gas->overpressure >= 0.0)) return "PE + P0 must not be negative";
        state->mass = state->initial_mass = gas->density * state->volume;
    }
    set_pressure(gas, curves, 0.0, state);
    return NULL;
}

/* The work of the pressure inside; at constant temperature the heat that keeps it is the work. */
static const char *advance(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state)
{
    double before = state->volume, pressure = state->pressure;
    state->volume = volume;
    state->area = step->area;
    set_pressure(gas, curves, step->time + step->dt, state);
    double work = 0.5 * (pressure + state->pressure) * (volume - before);
    if (gas->load_curve.pressure_curve < 0) work = pressure * before * elementary_log(volume / before);
    gas_book(&state->work, &state->carry[CARRY_WORK], work);
    gas_book(&state->heat_out, &state->carry[CARRY_HEAT], -work);
    return NULL;
}

static double time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    (void)state;
    const LoadCurveLaw *law = &gas->load_curve;
    double scale = law->start_time > time * (1.0 + 1e-9) ? law->start_time - time : CHAMBER_NO_SCALE;
    return chamber_next_corner(curves, law->pressure_curve, time, law->start_time, scale);
}

/* A pressure by curve does not know the mass: a reservoir. */
static double pressure_at_mass(const GasModel *gas, const Curve *curves, double time, const GasState *state,
                               double mass)
{
    GasState other = *state;
    other.mass = mass;
    set_pressure(gas, curves, time, &other);
    return other.pressure;
}

const ChamberModel chamber_load_curve = {"LOAD_CURVE", start, advance, time_scale, set_pressure, pressure_at_mass};
