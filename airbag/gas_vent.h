/* Exit flow of gas through vents and leaking fabric (docs/theory.md, G13 to G16). */
#ifndef BILLOW_GAS_VENT_H
#define BILLOW_GAS_VENT_H

#include "airbag/gas_law.h"

typedef struct GasExit {
    double vent, porosity; /* mass flows [M/T], >= 0 */
} GasExit;

/* Mass flow per effective area through an orifice from pressure and temperature to ambient (G13), choked below the
 * critical ratio (G14); 0 if the ambient pressure is not below. conversion is GC [M L/(F T2)]. */
double gas_orifice_flux(const GasLaw *law, double conversion, double ambient, double pressure, double temperature);

/* Mass flow through one leak of the bag in a state, for the law with its areas. */
double gas_leak_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasLeak *leak, double time,
                     double pressure, double temperature);

/* Share of the last step's outflow of each part of the bag (count), vents and leakage: what the state's columns say,
 * shared out as the flows of this moment. weight: workspace (count). */
void gas_part_flows(const GasModel *gas, const Curve *curves, const GasAreas *areas, const GasState *state, double time,
                    int count, double *weight, double *flow);

/* Mass flows out of the bag at a time and state. */
GasExit gas_exit_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double pressure,
                      double temperature);

#endif
