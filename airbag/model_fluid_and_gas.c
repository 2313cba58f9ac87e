/* *AIRBAG_FLUID_AND_GAS: an incompressible fluid up to a level with gas above it (docs/theory.md, G52 to G56). The
 * level is a matter of the mesh: solver/step_fluid.c measures the volume below it. */
#include <math.h>

#include "airbag/chamber.h"
#include "airbag/gas_ledger.h"
#include "solver/elementary.h"

static const double FULL = 1e-9; /* share of the chamber below which there is no room for gas */

/* While the level is still given by the card; afterwards the fluid's volume is kept. */
static bool is_filling(const GasModel *gas, const GasState *state)
{
    const FluidAndGasLaw *law = &gas->fluid_and_gas;
    return law->level_curve >= 0 || (state->fluid_level != law->final_level && law->level_step != 0.0);
}

/* (G53): prescribed up to TEND or by a curve. False afterwards. */
static bool prescribed_pressure(const FluidAndGasLaw *law, const Curve *curves, double time, double *pressure)
{
    if (law->pressure_curve >= 0) {
        *pressure = curve_value(&curves[law->pressure_curve], time);
        return true;
    }
    if (time > law->end_time) return false;
    *pressure = law->end_time > 0.0 ? law->pressure * (time / law->end_time) : law->pressure;
    return true;
}

static void set_applied(const GasModel *gas, GasState *state)
{
    double room = state->volume - state->fluid_volume;
    bool full = !(room > FULL * state->volume);
    state->applied = state->pressure;
    state->mass = gas->density * state->fluid_volume;
    state->density = state->mass / state->volume;
    state->stiffness =
        full ? gas->fluid_and_gas.bulk / state->volume : gas->fluid_and_gas.kappa * fmax(state->pressure, 0.0) / room;
}

bool gas_fluid_level(const GasModel *gas, const Curve *curves, double time, bool step, GasState *state)
{
    const FluidAndGasLaw *law = &gas->fluid_and_gas;
    if (gas->kind != GAS_FLUID_AND_GAS || gas_asleep(gas, state) || !is_filling(gas, state)) return false;
    if (law->level_curve >= 0) {
        state->fluid_level = curve_value(&curves[law->level_curve], time - state->inflow_start);
    } else if (step) {
        double next = state->fluid_level + law->level_step;
        bool past = law->level_step > 0.0 ? next >= law->final_level : next <= law->final_level;
        state->fluid_level = past ? law->final_level : next;
    }
    return true;
}

static const char *start(const GasModel *gas, const Curve *curves, GasState *state)
{
    const FluidAndGasLaw *law = &gas->fluid_and_gas;
    if (!(gas->density >= 0.0)) return "RHO must not be negative";
    if (!(law->kappa > 0.0)) return "KAPPA must be positive";
    state->opened = 1.0;
    state->fluid_level = law->level_curve >= 0 ? curve_value(&curves[law->level_curve], 0.0) : law->initial_level;
    prescribed_pressure(law, curves, 0.0, &state->pressure);
    set_applied(gas, state);
    return NULL;
}

/* (G53) to (G55): the gas has what the fluid leaves it; a full chamber has the pressure of the fluid's bulk modulus. */
static const char *advance(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state)
{
    const FluidAndGasLaw *law = &gas->fluid_and_gas;
    double before = state->volume - state->fluid_volume, pressure = state->pressure, old = state->volume;
    state->volume = volume;
    state->area = step->area;
    state->fluid_volume = step->fluid_volume;
    double room = volume - state->fluid_volume;
    if (!(room > FULL * volume)) {
        state->pressure = fmax(law->bulk * (state->fluid_volume / volume - 1.0), 0.0);
    } else if (!prescribed_pressure(law, curves, step->time + step->dt, &state->pressure)) {
        if (before > FULL * old) state->pressure *= elementary_pow(before / room, law->kappa);
    }
    set_applied(gas, state);
    gas_book(&state->work, &state->carry[CARRY_WORK], 0.5 * (pressure + state->pressure) * (volume - old));
    return NULL;
}

static double time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    (void)state;
    const FluidAndGasLaw *law = &gas->fluid_and_gas;
    double scale = time < law->end_time ? law->end_time - time : CHAMBER_NO_SCALE;
    scale = chamber_next_corner(curves, law->level_curve, time, 0.0, scale);
    return chamber_next_corner(curves, law->pressure_curve, time, 0.0, scale);
}

const ChamberModel chamber_fluid_and_gas = {"FLUID_AND_GAS", start, advance, time_scale, NULL, NULL};
