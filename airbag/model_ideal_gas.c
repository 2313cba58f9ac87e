/* Ideal gas with flows: SIMPLE_AIRBAG_MODEL and WANG_NEFSKE, one gas; HYBRID and HYBRID_CHEMKIN, a mixture. */
#include "airbag/chamber.h"
#include "airbag/gas_exchange.h"
#include "airbag/gas_heat.h"
#include "airbag/gas_inflow.h"
#include "airbag/gas_law.h"
#include "airbag/gas_ledger.h"
#include "airbag/gas_pop.h"
#include "airbag/gas_vent.h"

enum { SUBSTEPS_MAX = 64 };
static const double SUBSTEP_CHANGE = 0.05; /* relative change of mass, energy or volume that one sub-step may take */

/* Pressure on the walls and its stiffness, adiabatic (G23). */
static void update_applied(const GasModel *gas, const GasLaw *law, GasState *state)
{
    state->applied = state->pressure - gas->ambient_pressure;
    state->stiffness = state->mass > 0.0 ? gas_gamma(law, state->temperature) * state->pressure / state->volume : 0.0;
}

/* Names the field that makes the gas impossible, or NULL. */
static const char *find_fault(const GasModel *gas)
{
    if (gas->species_count > 0) return gas->ambient_temperature > 0.0 ? NULL : "ATMOST must be positive";
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
    const InflatorChamber *inflator = &gas->inflator;
    if (inflator->volume > 0.0 && !(inflator->coefficient > 0.0 && inflator->area > 0.0 && inflator->density > 0.0 &&
                                    inflator->temperature > 0.0))
        return "IOC, IOA, IRO and IT must be positive: they make the inflator with IVOL";
    if (gas->tank_pressure_curve >= 0 && !(gas->tank_volume > 0.0)) return "TVOL must be positive";
    return NULL;
}

static const char *start(const GasModel *gas, const Curve *curves, GasState *state)
{
    const char *fault = find_fault(gas);
    if (fault) return fault;
    GasLaw law = gas_law_of(gas, state);
    double pressure = gas->ambient_pressure + gas->overpressure;
    double temperature = gas->initial_temperature;
    if (!(temperature > 0.0) && pressure > 0.0) temperature = gas->ambient_pressure / (gas->ambient_density * law.r);
    if (!(temperature > 0.0)) temperature = gas_inflow_temperature(gas, curves, 0.0);
    if (!(gas_cv(&law, temperature) > 0.0))
        return "A, B (and C) give a heat capacity that is not positive at the temperature of the start";
    state->temperature = temperature; /* (G7) */
    state->mass = pressure > 0.0 ? pressure * state->volume / (law.r * temperature) : 0.0;
    state->energy = state->mass * gas_internal_energy(&law, temperature);
    for (int i = 0; i < law.count; i++) state->species[i] = state->mass * law.fraction[i];
    state->initial_mass = state->mass;
    state->initial_energy = state->energy;
    state->density = state->mass / state->volume;
    state->pressure = pressure;
    gas_start_pop(gas, state);
    if (gas->inflator.volume > 0.0 && pressure > 0.0) { /* full of ambient gas */
        state->inflator_mass = gas->ambient_pressure * gas->inflator.volume / (law.r * temperature);
        state->inflator_energy = state->inflator_mass * gas_internal_energy(&law, temperature);
    }
    GasSupply tank = gas_tank_initial(gas, &law, curves, temperature);
    state->tank_pressure = tank.pressure;
    state->tank_temperature = tank.temperature;
    update_applied(gas, &law, state);
    return NULL;
}

/* Sub-steps by how much the step changes the gas; 1 where nothing is split and the update is exact. */
static int count_substeps(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasStep *step,
                          double volume, const GasState *state)
{
    GasSupply supply = gas_supply_of(state);
    GasInflow inflow = gas_inflow(gas, law, curves, step->time - state->inflow_start,
                                  step->time + step->dt - state->inflow_start, &supply);
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
static void advance_substeps(const GasModel *gas, GasLaw *law, const Curve *curves, const GasStep *step, double volume,
                             GasState *state)
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
    if (!(gas_cv(law, state->temperature) > 0.0)) return "the heat capacity of the gas is not positive: see A, B and C";
    return NULL;
}

static const char *advance(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state)
{
    GasLaw law = gas_law_of(gas, state);
    if (step->areas.part) law.areas = &step->areas;
    advance_substeps(gas, &law, curves, step, volume, state);
    const char *failure = find_failure(&law, state);
    if (failure) return failure;
    if (state->volume > state->guard * (BILLOW_GAS_FLAT / BILLOW_GAS_GUARD)) state->flat = 0.0;
    gas_check_pop(gas, step->time + step->dt, state);
    update_applied(gas, &law, state);
    return NULL;
}

static void refresh(const GasModel *gas, const Curve *curves, double time, GasState *state)
{
    (void)curves;
    GasLaw law = gas_law_of(gas, state);
    if (state->mass > 0.0) state->temperature = gas_temperature(&law, state->mass, 0.0, state->energy);
    state->density = state->mass / state->volume;
    state->pressure = state->density * law.r * state->temperature;
    gas_check_pop(gas, time, state);
    update_applied(gas, &law, state);
}

#define IDEAL_GAS(name)                                                                                                \
    {                                                                                                                  \
        name, start, advance, ideal_gas_time_scale, refresh, NULL                                                      \
    }
const ChamberModel chamber_ideal_gas_simple = IDEAL_GAS("SIMPLE_AIRBAG_MODEL");
const ChamberModel chamber_ideal_gas_wang_nefske = IDEAL_GAS("WANG_NEFSKE");
const ChamberModel chamber_ideal_gas_hybrid = IDEAL_GAS("HYBRID");
const ChamberModel chamber_ideal_gas_chemkin = IDEAL_GAS("HYBRID_CHEMKIN");
