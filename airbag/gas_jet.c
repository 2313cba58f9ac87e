/* What the inflator's jet is made of. */
#include "airbag/gas_jet.h"

#include <math.h>

#include "airbag/gas_inflow.h"
#include "airbag/gas_law.h"

GasJet gas_jet(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    GasJet jet = {.mass_flow = state->mass_flow_in,
                  .density = gas->ambient_density,
                  .conversion = gas->gravity_conversion > 0.0 ? gas->gravity_conversion : 1.0};
    if (!(jet.mass_flow > 0.0) || !(time >= state->inflow_start)) return (GasJet){.conversion = 1.0};
    GasLaw law = gas_law_of(gas, state);
    double temperature = gas_inflow_temperature(gas, curves, time - state->inflow_start);
    jet.speed = sqrt(gas_gamma(&law, temperature) * law.r * temperature * jet.conversion); /* (J1) */
    return jet;
}
