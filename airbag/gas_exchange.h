/* Exchange of gas and heat at constant volume over one sub-step (docs/theory.md, G17 to G20). */
#ifndef BILLOW_GAS_EXCHANGE_H
#define BILLOW_GAS_EXCHANGE_H

#include "airbag/gas_inflow.h"

/* In- and outflow and heat loss from time to time + span at volume state->volume and surface area; updates mass,
 * energy, temperature, pressure and the sums of the ledger, mass_flow_out_vent and mass_flow_out_porosity by the masses
 * that left. Mass and temperature stay positive, and a vented bag relaxes monotonically to the ambient pressure, for
 * any span. The law of a mixture follows the composition. */
void gas_exchange(const GasModel *gas, GasLaw *law, const Curve *curves, double time, double span, double area,
                  GasState *state);

/* The exchange of gas alone, with an inflow that is known. */
void gas_exchange_flow(const GasModel *gas, GasLaw *law, const Curve *curves, double time, double span,
                       const GasInflow *inflow, GasState *state);

#endif
