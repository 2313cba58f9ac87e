/* Exchange of gas and heat at constant volume: a trapezoidal rule that turns implicit where the vents are stiff. */
#include "airbag/gas_exchange.h"

#include "airbag/gas_heat.h"
#include "airbag/gas_inflow.h"
#include "airbag/gas_ledger.h"
#include "airbag/gas_pop.h"
#include "airbag/gas_vent.h"

static const double RESIDUAL = 1e-14; /* of (G18), relative to the mass */

/* What the implicit part of the outflow needs: gas of mass and energy in volume, of which a part leaves at time. */
typedef struct Discharge {
    const GasModel *gas;
    const GasLaw *law;
    const Curve *curves;
    double mass, energy, volume;
    double time, span; /* end of the sub-step; weight of its implicit part times its length */
    GasExit exit;      /* the last flow that was not zero */
} Discharge;

static void update_state_of_gas(GasLaw *law, GasState *state)
{
    if (state->mass > 0.0) state->temperature = gas_temperature(law, state->mass, 0.0, state->energy);
    law->near = state->temperature;
    state->density = state->mass / state->volume;
    state->pressure = state->density * law->r * state->temperature;
}

/* (G18): mass that leaves if rest stays, less the mass that the exits let out in that state. Falls with rest. */
static double discharge_residual(Discharge *discharge, double rest)
{
    double out = discharge->mass - rest;
    double temperature = gas_temperature(discharge->law, discharge->mass, out, discharge->energy);
    double pressure = rest * discharge->law->r * temperature / discharge->volume;
    GasExit exit =
        gas_exit_flow(discharge->gas, discharge->law, discharge->curves, discharge->time, pressure, temperature);
    double flow = exit.vent + exit.porosity;
    if (flow > 0.0) discharge->exit = exit;
    return out - discharge->span * flow;
}

/* Where the flow hardly changes over the sub-step, the iteration mass - span flow(rest) gains its digits at once; it
 * starts from the flow before. Returns false where it does not. */
static bool iterate_discharge(Discharge *discharge, double flow, double *rest)
{
    double guess = discharge->mass - discharge->span * flow, last = 1e-2 * discharge->mass;
    for (int i = 0; i < 4 && guess > 0.0; i++) {
        double value = discharge_residual(discharge, guess);
        if (fabs(value) <= RESIDUAL * discharge->mass) {
            *rest = guess;
            return true;
        }
        if (!(fabs(value) < 0.1 * last)) return false;
        last = fabs(value);
        guess += value;
    }
    return false;
}

/* Mass that stays: root of (G18) in (0, mass], by the secant of the bracket (Illinois), halving it where that stalls,
 * as at the jump of an exit curve that starts above zero. */
static double bracket_discharge(Discharge *discharge)
{
    double high = discharge->mass, at_high = discharge_residual(discharge, high);
    if (!(at_high < 0.0)) return high;
    double low = 0.0, at_low = high, width = high;
    double rest = high * (high / (high - at_high)); /* the flow taken as proportional to the mass */
    int side = 0;
    for (int i = 0; i < 100; i++) {
        double value = discharge_residual(discharge, rest);
        if (fabs(value) <= RESIDUAL * discharge->mass) return rest;
        if (value > 0.0) {
            low = rest, at_low = value;
            if (side > 0) at_high *= 0.5;
            side = 1;
        } else {
            high = rest, at_high = value;
            if (side < 0) at_low *= 0.5;
            side = -1;
        }
        if (high - low <= 1e-15 * high) break;
        rest = high - at_high * ((high - low) / (at_high - at_low));
        if (i % 3 == 2) {
            if (high - low > 0.5 * width) rest = 0.5 * (low + high);
            width = high - low;
        }
        if (!(rest > low && rest < high)) break; /* the bracket is down to neighbours */
    }
    return high;
}

/* Shares the mass out between vents and fabric as the flows were. */
static void count_outflow(GasState *state, double out, GasExit exit)
{
    double flow = exit.vent + exit.porosity;
    if (!(out > 0.0) || !(flow > 0.0)) return;
    state->mass_flow_out_vent += out * (exit.vent / flow);
    state->mass_flow_out_porosity += out * (exit.porosity / flow);
}

/* Takes an outflow of the composition before and adds the inflow; what is left of the mixture is then in the state. */
static void mix_species(const GasLaw *law, const GasInflow *inflow, double outflow, GasState *state)
{
    for (int i = 0; i < law->count; i++) state->species[i] += inflow->species[i] - outflow * law->fraction[i];
}

/* Inflow with the exits closed. */
static void exchange_closed(const GasLaw *law, const GasInflow *inflow, GasState *state)
{
    mix_species(law, inflow, 0.0, state);
    gas_book(&state->mass, &state->carry[CARRY_MASS], inflow->mass);
    gas_book(&state->energy, &state->carry[CARRY_ENERGY], inflow->enthalpy);
}

/* (G17) to (G19). A mixture's early outflow has the composition before, the late one that after the inflow. */
static void exchange_open(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double span,
                          const GasInflow *inflow, GasState *state)
{
    GasExit before = gas_exit_flow(gas, law, curves, time, state->pressure, state->temperature);
    double flow = before.vent + before.porosity, early = 0.0, weight = 1.0;
    if (flow > 0.0) {
        /* The explicit half may go half the way to the ambient pressure, so that the end stays above it. */
        double gap = (state->pressure - gas->ambient_pressure) / state->pressure;
        early = fmin(0.5 * span * flow, 0.5 * state->mass * gap / gas_gamma(law, state->temperature));
        weight = 1.0 - early / (span * flow);
    }
    GasLaw mixed;
    Discharge discharge = {.gas = gas, .law = law, .curves = curves, .volume = state->volume};
    discharge.mass = state->mass + inflow->mass - early;
    discharge.energy = state->energy + inflow->enthalpy - early * gas_enthalpy(law, state->temperature);
    discharge.time = time + span;
    discharge.span = weight * span;
    if (!(discharge.mass > 0.0)) return;
    if (law->count > 0) {
        mixed = *law;
        mix_species(law, inflow, early, state);
        gas_law_mix(&mixed, state->species);
        discharge.law = &mixed;
    }
    double rest;
    if (!iterate_discharge(&discharge, flow, &rest)) rest = bracket_discharge(&discharge);
    double late = discharge.mass - rest;
    if (!(early > 0.0) && !(late > 0.0)) {
        gas_book(&state->mass, &state->carry[CARRY_MASS], inflow->mass);
        gas_book(&state->energy, &state->carry[CARRY_ENERGY], inflow->enthalpy);
        return;
    }
    for (int i = 0; i < law->count; i++) state->species[i] *= rest / discharge.mass;
    double temperature = gas_temperature(discharge.law, discharge.mass, late, discharge.energy);
    double energy = rest * gas_internal_energy(discharge.law, temperature);
    double mass_out = gas_settle(&state->mass, &state->carry[CARRY_MASS], inflow->mass, rest);
    double enthalpy_out = gas_settle(&state->energy, &state->carry[CARRY_ENERGY], inflow->enthalpy, energy);
    gas_book(&state->mass_out, &state->carry[CARRY_MASS_OUT], mass_out);
    gas_book(&state->enthalpy_out, &state->carry[CARRY_ENTHALPY_OUT], enthalpy_out);
    count_outflow(state, early, before);
    count_outflow(state, late, discharge.exit);
}

void gas_exchange_flow(const GasModel *gas, GasLaw *law, const Curve *curves, double time, double span,
                       const GasInflow *inflow, GasState *state)
{
    if (state->opened > 0.0) {
        exchange_open(gas, law, curves, time, span, inflow, state);
    } else {
        exchange_closed(law, inflow, state);
    }
    gas_law_mix(law, state->species);
    gas_book(&state->mass_in, &state->carry[CARRY_MASS_IN], inflow->mass);
    gas_book(&state->enthalpy_in, &state->carry[CARRY_ENTHALPY_IN], inflow->enthalpy);
    update_state_of_gas(law, state);
}

void gas_exchange(const GasModel *gas, GasLaw *law, const Curve *curves, double time, double span, double area,
                  GasState *state)
{
    gas_check_pop(gas, time, state);
    gas_lose_heat(gas, law, curves, time, time + 0.5 * span, area, state);
    update_state_of_gas(law, state);
    GasSupply supply = gas_supply_of(state);
    double since = time - state->inflow_start;
    GasInflow inflow = gas_inflow(gas, law, curves, since, time + span - state->inflow_start, &supply);
    state->tank_pressure = supply.pressure;
    state->tank_temperature = supply.temperature;
    state->inflator_mass = supply.inflator_mass;
    state->inflator_energy = supply.inflator_energy;
    state->mass_flow_inflator += inflow.mass; /* gas_advance makes it a rate */
    gas_exchange_flow(gas, law, curves, time, span, &inflow, state);
    gas_lose_heat(gas, law, curves, time + 0.5 * span, time + span, area, state);
    update_state_of_gas(law, state);
}
