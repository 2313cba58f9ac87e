/* *AIRBAG_SIMPLE_PRESSURE_VOLUME: pressure by the relative volume (docs/theory.md, G25). */
#include <math.h>

#include "airbag/chamber.h"
#include "airbag/gas_ledger.h"
#include "solver/elementary.h"

static void set_pressure(const GasModel *gas, const Curve *curves, double time, GasState *state)
{
    const PressureVolumeLaw *law = &gas->pressure_volume;
    double relative = state->volume / state->initial_volume;
    if (law->relative_curve >= 0) {
        const Curve *curve = &curves[law->relative_curve];
        state->pressure = curve_value(curve, relative);
        state->stiffness = fmax(-curve_slope(curve, relative), 0.0) / state->initial_volume;
    } else {
        state->pressure =
            law->factor * chamber_value(curves, law->coefficient_curve, time, law->coefficient) / relative;
        state->stiffness = fmax(state->pressure, 0.0) / state->volume;
    }
    state->applied = state->pressure;
}

static const char *start(const GasModel *gas, const Curve *curves, GasState *state)
{
    state->opened = 1.0;
    set_pressure(gas, curves, 0.0, state);
    return NULL;
}

static const char *advance(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state)
{
    const PressureVolumeLaw *law = &gas->pressure_volume;
    double work, before = state->volume, first = state->initial_volume;
    if (law->relative_curve >= 0) {
        work = first * curve_integral(&curves[law->relative_curve], before / first, volume / first);
    } else {
        double middle = chamber_value(curves, law->coefficient_curve, step->time + 0.5 * step->dt, law->coefficient);
        work = law->factor * middle * first * elementary_log(volume / before);
    }
    gas_book(&state->work, &state->carry[CARRY_WORK], work);
    state->volume = volume;
    state->area = step->area;
    set_pressure(gas, curves, step->time + step->dt, state);
    return NULL;
}

static double time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    (void)state;
    return chamber_next_corner(curves, gas->pressure_volume.coefficient_curve, time, 0.0, CHAMBER_NO_SCALE);
}

const ChamberModel chamber_pressure_volume = {"SIMPLE_PRESSURE_VOLUME", start, advance, time_scale, NULL, NULL};
