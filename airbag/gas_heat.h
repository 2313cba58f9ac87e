/* Heat that the gas loses to the surroundings through the fabric (docs/theory.md, G20). */
#ifndef BILLOW_GAS_HEAT_H
#define BILLOW_GAS_HEAT_H

#include "airbag/gas_law.h"

/* Ambient temperature: TEXT, or that of PE and RO. */
double gas_ambient_temperature(const GasModel *gas, const GasLaw *law);

/* Heat transfer coefficient HCONV at a time, not below 0 [power/area/temperature]. */
double gas_heat_coefficient(const GasModel *gas, const Curve *curves, double time);

/* Convection at constant mass and volume from time begin to end over the surface area: the temperature goes to the
 * ambient one exponentially. Books heat_out and energy; the caller refreshes temperature and pressure. */
void gas_lose_heat(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end, double area,
                   GasState *state);

#endif
