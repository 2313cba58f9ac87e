/* Gas of one control volume: initial state and the common update of a step. */
#include "airbag/gas.h"

#include <string.h>

#include "airbag/gas_exchange.h"
#include "airbag/gas_heat.h"
#include "airbag/gas_inflow.h"
#include "airbag/gas_law.h"
#include "airbag/gas_ledger.h"
#include "airbag/gas_vent.h"

enum { SUBSTEPS_MAX = 64 };
static const double SUBSTEP_CHANGE = 0.05; /* relative change of mass, energy or volume that one sub-step may take */

void gas_model_reset(GasModel *gas)
{
    memset(gas, 0, sizeof *gas);
    gas->gravity_conversion = 1.0;
    gas->temperature_curve = gas->temperature_rate_curve = -1;
    gas->mass_flow_curve = gas->tank_pressure_curve = -1;
    gas->vent_coefficient_pressure_curve = gas->vent_area_pressure_curve = -1;
    gas->vent_coefficient_time_curve = gas->vent_coefficient_ratio_curve = -1;
    gas->porosity_coefficient_time_curve = gas->porosity_area_pressure_curve = -1;
    gas->exit_flow_curve = gas->heat_transfer_curve = -1;
}

/* (G23): applied pressure and its stiffness against the volume of the mesh. */
static void update_applied(const GasModel *gas, const GasLaw *law, double vsca, double psca, GasState *state)
{
    state->applied = psca * (state->pressure - gas->ambient_pressure);
    state->stiffness = 0.0;
    if (state->mass > 0.0)
        state->stiffness = gas_gamma(law, state->temperature) * state->pressure * psca * vsca / state->volume;
}

/* Names the field that makes the gas impossible, or NULL. */
static const char *find_fault(const GasModel *gas)
{
    if (gas->temperature_dependent) {
        if (!(gas->molar_mass > 0.0)) return "MW must be positive where CV = 0";
        if (!(gas->gas_constant > 0.0)) return "GASC must be positive where CV = 0";
        if (!(gas->a > gas->gas_constant)) return "A must be greater than GASC: cv would not be positive";
    } else {
        if (!(gas->cv > 0.0)) return "CV must be positive";
        if (!(gas->cp > gas->cv)) return "CP must be greater than CV";
    }
    if (!(gas->ambient_pressure >= 0.0)) return "PE must not be negative";
    if (!(gas->ambient_pressure + gas->overpressure >= 0.0)) return "PE + POVER must not be negative";
    if (gas->ambient_pressure + gas->overpressure > 0.0 && !(gas->initial_temperature > 0.0) &&
        !(gas->ambient_pressure > 0.0 && gas->ambient_density > 0.0))
        return "PE and RO must be positive: they give the temperature of the gas at the start";
    if ((gas->mass_flow_curve >= 0 || gas->tank_pressure_curve >= 0) && gas->temperature_curve < 0 &&
        gas->temperature_rate_curve < 0 && !(gas->inflow_temperature > 0.0))
        return "T must be positive: it is the temperature of the gas that flows in";
    if (gas->tank_pressure_curve >= 0 && !(gas->tank_volume > 0.0)) return "TVOL must be positive";
    return NULL;
}

int gas_initialize(const GasModel *gas, const Curve *curves, double vsca, double psca, double vini, double volume,
                   double area, GasState *state, const char **why)
{
    *why = find_fault(gas);
    if (*why) return -1;
    GasLaw law = gas_law_of(gas);
    memset(state, 0, sizeof *state);
    double size = vsca * area * sqrt(area), raw = vsca * volume - vini;
    state->guard = BILLOW_GAS_GUARD * size;
    state->area = area;
    state->volume = fmax(raw, state->guard);
    state->flat = raw < state->guard ? 1.0 : 0.0;
    if (!(raw >= -BILLOW_GAS_FLAT * size)) {
        *why = "the volume of the gas, VSCA V - VINI, is negative at the start";
        return -1;
    }
    if (!(state->volume > 0.0)) {
        *why = "the bag has neither volume nor surface";
        return -1;
    }
    double pressure = gas->ambient_pressure + gas->overpressure;
    double temperature = gas->initial_temperature;
    if (!(temperature > 0.0) && pressure > 0.0) temperature = gas->ambient_pressure / (gas->ambient_density * law.r);
    if (!(temperature > 0.0)) temperature = gas_inflow_temperature(gas, curves, 0.0);
    if (!(law.c0 + law.c1 * temperature > 0.0)) {
        *why = "A and B give a heat capacity that is not positive at the temperature of the start";
        return -1;
    }
    state->temperature = temperature; /* (G7) */
    state->mass = pressure > 0.0 ? pressure * state->volume / (law.r * temperature) : 0.0;
    state->energy = state->mass * gas_internal_energy(&law, temperature);
    state->initial_mass = state->mass;
    state->initial_energy = state->energy;
    state->density = state->mass / state->volume;
    state->pressure = pressure;
    state->opened = gas->pop_pressure > 0.0 ? 0.0 : 1.0;
    gas_check_pop(gas, state);
    GasTank tank = gas_tank_initial(gas, &law, curves, temperature);
    state->tank_pressure = tank.pressure;
    state->tank_temperature = tank.temperature;
    update_applied(gas, &law, vsca, psca, state);
    return 0;
}

/* Volume of the gas at the end of the step, or NAN with *why set. */
static double next_volume(const GasState *state, double vsca, double vini, const GasStep *step, const char **why)
{
    double raw = vsca * step->volume - vini, flat = state->guard * (BILLOW_GAS_FLAT / BILLOW_GAS_GUARD);
    if (!isfinite(raw)) {
        *why = "the volume of the bag is not finite";
        return NAN;
    }
    if (raw < -flat || (raw < 0.0 && state->volume > flat) || !(fmax(raw, state->guard) > 0.0)) {
        *why = "the volume of the gas became negative: the bag is turned inside out or VINI is too large";
        return NAN;
    }
    return fmax(raw, state->guard);
}

/* Sub-steps by how much the step changes the gas; 1 where nothing is split and the update is exact. */
static int count_substeps(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasStep *step,
                          double volume, const GasState *state)
{
    GasTank tank = {state->tank_pressure, state->tank_temperature};
    GasInflow inflow = gas_inflow(gas, law, curves, step->time - state->inflow_start,
                                  step->time + step->dt - state->inflow_start, &tank);
    GasExit exit = gas_exit_flow(gas, law, curves, step->time, state->pressure, state->temperature);
    double out = (exit.vent + exit.porosity) * step->dt;
    int heat = gas->heat_transfer > 0.0 || gas->heat_transfer_curve >= 0;
    if (!(inflow.mass > 0.0) && !(out > 0.0) && !heat) return 1;
    if (!(state->mass > 0.0)) return SUBSTEPS_MAX;
    double change = fabs(volume - state->volume) / fmin(volume, state->volume);
    change += (inflow.mass + out) / state->mass + inflow.enthalpy / state->energy;
    double count = ceil(change / SUBSTEP_CHANGE);
    return !(count > 1.0) ? 1 : count < SUBSTEPS_MAX ? (int)count : SUBSTEPS_MAX;
}

/* (G6): adiabatic change of the volume; the work is the change of the energy, so that the ledger closes. */
static void compress_gas(const GasLaw *law, double volume, GasState *state)
{
    double ratio = volume / state->volume;
    state->volume = volume;
    if (state->mass > 0.0 && ratio != 1.0) {
        double temperature = gas_isentropic_temperature(law, state->temperature, ratio);
        double change = gas_internal_energy(law, temperature) - gas_internal_energy(law, state->temperature);
        gas_book(&state->energy, &state->carry[CARRY_ENERGY], state->mass * change);
        gas_book(&state->work, &state->carry[CARRY_WORK], -state->mass * change);
        state->temperature = gas_temperature(law, state->mass, 0.0, state->energy);
    }
    state->density = state->mass / volume;
    state->pressure = state->density * law->r * state->temperature;
}

/* Half of the exchange, compression, the other half, for each sub-step (Strang's splitting, G21). The exchange comes
 * last, so that a stiffly vented bag ends the step relaxed. */
static void advance_substeps(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasStep *step,
                             double volume, GasState *state)
{
    int count = count_substeps(gas, law, curves, step, volume, state);
    double start = state->volume, area = state->area;
    double half = 0.5 * step->dt / count;
    for (int i = 0; i < count; i++) {
        double time = step->time + 2.0 * half * i, share = (double)(i + 1) / count;
        double end = i + 1 < count ? step->time + 2.0 * half * (i + 1) : step->time + step->dt;
        gas_exchange(gas, law, curves, time, half, area, state);
        state->area = area + share * (step->area - area);
        compress_gas(law, i + 1 < count ? start + share * (volume - start) : volume, state);
        gas_exchange(gas, law, curves, time + half, end - (time + half), state->area, state);
    }
    state->area = step->area;
}

/* NULL, or why the state after a step cannot be. */
static const char *find_failure(const GasLaw *law, const GasState *state)
{
    if (!isfinite(state->mass) || state->mass < 0.0) return "the mass of the gas is not finite";
    if (!isfinite(state->temperature) || state->temperature < 0.0) return "the temperature of the gas is not finite";
    if (!(law->c0 + law->c1 * state->temperature > 0.0))
        return "the heat capacity of the gas is not positive: see A and B";
    if (!isfinite(state->pressure)) return "the pressure of the gas is not finite";
    return NULL;
}

int gas_advance(const GasModel *gas, const Curve *curves, double vsca, double psca, double vini, const GasStep *step,
                GasState *state, const char **why)
{
    double volume = next_volume(state, vsca, vini, step, why);
    if (isnan(volume)) return -1;
    GasLaw law = gas_law_of(gas);
    GasState next = *state;
    next.mass_flow_out_vent = next.mass_flow_out_porosity = 0.0;
    advance_substeps(gas, &law, curves, step, volume, &next);
    *why = find_failure(&law, &next);
    if (*why) return -1;
    if (next.volume > next.guard * (BILLOW_GAS_FLAT / BILLOW_GAS_GUARD)) next.flat = 0.0;
    gas_check_pop(gas, &next);
    double rate = step->dt > 0.0 ? 1.0 / step->dt : 0.0; /* masses of the step to mean flows */
    next.mass_flow_in = (next.mass_in - state->mass_in) * rate;
    next.mass_flow_out = (next.mass_out - state->mass_out) * rate;
    next.mass_flow_out_vent *= rate;
    next.mass_flow_out_porosity *= rate;
    update_applied(gas, &law, vsca, psca, &next);
    *state = next;
    return 0;
}
