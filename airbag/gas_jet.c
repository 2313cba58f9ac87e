/* What the inflator's jet is made of. Equations (J1), (J1a) of docs/theory.md. */
#include "airbag/gas_jet.h"

#include <math.h>

#include "airbag/gas_inflow.h"
#include "airbag/gas_law.h"

/* (J1a): temperature of the gases that flow in, mixed at constant pressure; law: their mixture. 0 if none does. */
static double mixed_temperature(const GasModel *gas, const Curve *curves, double since, GasLaw *law)
{
    GasInflow rate = gas_mixture_rate(gas, curves, since);
    if (!(rate.mass > 0.0)) return 0.0;
    gas_law_mix(law, rate.species);
    return gas_mixture_temperature(law, rate.mass, rate.mass, rate.enthalpy);
}

/* Of what leaves the outlet. */
static double outlet_temperature(const GasModel *gas, const Curve *curves, const GasState *state, double since,
                                 GasLaw *law)
{
    if (gas->species_count > 0) return mixed_temperature(gas, curves, since, law);
    if (gas->inflator.volume > 0.0)
        return state->inflator_mass > 0.0 ? gas_temperature(law, state->inflator_mass, 0.0, state->inflator_energy)
                                          : 0.0;
    return gas_inflow_temperature(gas, curves, since);
}

GasJet gas_jet(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    GasJet jet = {.mass_flow = state->mass_flow_inflator,
                  .density = gas->ambient_density,
                  .conversion = gas->gravity_conversion > 0.0 ? gas->gravity_conversion : 1.0};
    if (!(jet.mass_flow > 0.0) || !(time >= state->inflow_start)) return (GasJet){.conversion = 1.0};
    GasLaw law = gas_law_of(gas, state);
    double temperature = outlet_temperature(gas, curves, state, time - state->inflow_start, &law);
    if (!(temperature > 0.0)) return (GasJet){.conversion = 1.0};
    jet.speed = sqrt(gas_gamma(&law, temperature) * law.r * temperature * jet.conversion); /* (J1) */
    return jet;
}
