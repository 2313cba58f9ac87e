/* The inflator as a chamber of its own (docs/theory.md, G12a): it is a bag of constant volume whose exit is the orifice
 * and whose surroundings are the airbag. */
#include <math.h>

#include "airbag/gas_exchange.h"
#include "airbag/gas_vent.h"

enum { PIECES_MAX = 256 };
static const double PIECE_CHANGE = 0.02; /* of the chamber's mass that one piece may bring or take */

/* The chamber as a gas model; the airbag's pressure is what it blows against. */
static GasModel chamber_model(const GasModel *gas, double pressure)
{
    GasModel chamber = *gas;
    chamber.ambient_pressure = pressure;
    chamber.vent_coefficient = gas->inflator.coefficient;
    chamber.vent_area = gas->inflator.area;
    chamber.vent_coefficient_pressure_curve = chamber.vent_coefficient_time_curve = -1;
    chamber.vent_coefficient_ratio_curve = chamber.vent_area_pressure_curve = chamber.exit_flow_curve = -1;
    chamber.porosity_coefficient = chamber.porosity_area = 0.0;
    chamber.porosity_coefficient_time_curve = chamber.porosity_area_pressure_curve = -1;
    return chamber;
}

static GasState chamber_state(const GasModel *gas, const GasLaw *law, const GasSupply *supply)
{
    GasState state = {.volume = gas->inflator.volume,
                      .mass = supply->inflator_mass,
                      .energy = supply->inflator_energy,
                      .opened = 1.0};
    if (state.mass > 0.0) state.temperature = gas_temperature(law, state.mass, 0.0, state.energy);
    state.pressure = state.mass * law->r * state.temperature / state.volume;
    return state;
}

/* Pieces by how fast the chamber fills and empties. */
static int count_pieces(const GasModel *chamber, const GasLaw *law, const GasState *state, double released, double span)
{
    double flow = 0.0;
    if (state->mass > 0.0 && state->pressure > chamber->ambient_pressure)
        flow = chamber->vent_coefficient * chamber->vent_area *
               gas_orifice_flux(law, chamber->gravity_conversion, chamber->ambient_pressure, state->pressure,
                                state->temperature);
    double change = (released + flow * span) / (fmax(state->mass, 1e-3 * released) + 1e-300);
    double count = ceil(change / PIECE_CHANGE);
    return !(count > 1.0) ? 1 : count < PIECES_MAX ? (int)count : PIECES_MAX;
}

GasInflow gas_inflator_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                            GasSupply *supply)
{
    const InflatorChamber *inflator = &gas->inflator;
    const Curve *burn = &curves[inflator->burn_curve];
    GasModel chamber = chamber_model(gas, supply->bag_pressure);
    GasState state = chamber_state(gas, law, supply);
    GasLaw own = *law;
    double whole = inflator->density * inflator->volume, before = curve_value(burn, begin);
    double enthalpy = gas_enthalpy(law, inflator->temperature);
    int count = count_pieces(&chamber, law, &state, whole * fabs(curve_value(burn, end) - before), end - begin);
    double span = (end - begin) / count;
    for (int i = 0; i < count; i++) {
        double after = curve_value(burn, i + 1 < count ? begin + span * (i + 1) : end);
        double mass = fmax(whole * (after - before), 0.0);
        GasInflow released = {.mass = mass, .enthalpy = mass * enthalpy};
        gas_exchange_flow(&chamber, &own, curves, begin + span * i, span, &released, &state);
        before = after;
    }
    supply->inflator_mass = state.mass;
    supply->inflator_energy = state.energy;
    return (GasInflow){.mass = state.mass_out, .enthalpy = state.enthalpy_out};
}
