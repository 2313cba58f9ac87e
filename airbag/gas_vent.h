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

/* Mass flows out of the bag at a time and state. */
GasExit gas_exit_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double pressure,
                      double temperature);

#endif
