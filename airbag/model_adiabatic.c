/* *AIRBAG_ADIABATIC_GAS_MODEL: a closed gas, held at P0 during preload (docs/theory.md, G26, G27). */
#include <math.h>

#include "airbag/chamber.h"
#include "airbag/gas_ledger.h"
#include "solver/elementary.h"

static bool released(const GasModel *gas, const Curve *curves, double time)
{
    int curve = gas->adiabatic.preload_curve;
    return curve < 0 || curve_value(&curves[curve], time) != 0.0;
}

/* The gas's pressure follows from its energy; the walls feel PSF P0 in preload, then PSF (p - PE). */
static void set_pressure(const GasModel *gas, GasState *state)
{
    const AdiabaticLaw *law = &gas->adiabatic;
    state->density = state->mass / state->volume;
    if (state->opened > 0.0) {
        state->pressure = (law->gamma - 1.0) * state->energy / state->volume;
        state->applied = law->factor * (state->pressure - gas->ambient_pressure);
        state->stiffness = law->factor * law->gamma * state->pressure / state->volume;
    } else {
        state->pressure = gas->ambient_pressure + gas->overpressure;
        state->applied = law->factor * gas->overpressure;
        state->stiffness = 0.0;
    }
}

static const char *start(const GasModel *gas, const Curve *curves, GasState *state)
{
    if (!(gas->adiabatic.gamma > 1.0)) return "GAMMA must exceed 1";
    if (!(gas->ambient_pressure >= 0.0)) return "PE must not be negative";
    if (!(gas->ambient_pressure + gas->overpressure >= 0.0)) return "PE + P0 must not be negative";
    if (!(gas->density > 0.0)) return "R0 must be positive";
    state->opened = released(gas, curves, 0.0) ? 1.0 : 0.0;
    state->mass = state->initial_mass = gas->density * state->volume;
    state->energy = (gas->ambient_pressure + gas->overpressure) * state->volume / (gas->adiabatic.gamma - 1.0);
    state->initial_energy = state->energy;
    set_pressure(gas, state);
    return NULL;
}

/* Preload: what keeps pressure and density constant flows in with the enthalpy that this takes (G27). */
static void hold_pressure(const GasModel *gas, double volume, GasState *state)
{
    double change = volume - state->volume, pressure = gas->ambient_pressure + gas->overpressure;
    double mass = gas->density * change, work = pressure * change, energy = work / (gas->adiabatic.gamma - 1.0);
    gas_book(&state->mass, &state->carry[CARRY_MASS], mass);
    gas_book(&state->mass_in, &state->carry[CARRY_MASS_IN], mass);
    gas_book(&state->energy, &state->carry[CARRY_ENERGY], energy);
    gas_book(&state->enthalpy_in, &state->carry[CARRY_ENTHALPY_IN], energy + work);
    gas_book(&state->work, &state->carry[CARRY_WORK], work);
}

static const char *advance(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state)
{
    if (!(state->opened > 0.0)) {
        hold_pressure(gas, volume, state);
        if (released(gas, curves, step->time + step->dt)) state->opened = 1.0;
    } else if (volume != state->volume) {
        double exponent = 1.0 - gas->adiabatic.gamma;
        double change = state->energy * (elementary_pow(volume / state->volume, exponent) - 1.0);
        gas_book(&state->energy, &state->carry[CARRY_ENERGY], change);
        gas_book(&state->work, &state->carry[CARRY_WORK], -change);
    }
    state->volume = volume;
    state->area = step->area;
    set_pressure(gas, state);
    return NULL;
}

static double time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    (void)state;
    return chamber_next_corner(curves, gas->adiabatic.preload_curve, time, 0.0, CHAMBER_NO_SCALE);
}

const ChamberModel chamber_adiabatic = {"ADIABATIC_GAS_MODEL", start, advance, time_scale, NULL, NULL};
