/* Gas from the inflator: mass and enthalpy over a span of time (docs/theory.md, G8 to G12). */
#ifndef BILLOW_GAS_INFLOW_H
#define BILLOW_GAS_INFLOW_H

#include "airbag/gas_law.h"

typedef struct GasInflow {
    double mass, enthalpy; /* [M], [energy] */
} GasInflow;

/* Gas of the tank test, tracked only with temperature-dependent heat capacities. */
typedef struct GasTank {
    double pressure, temperature; /* absolute */
} GasTank;

/* Temperature of the inflow at a time: LCT, or T plus the integral of LCDT from 0; not below 0. */
double gas_inflow_temperature(const GasModel *gas, const Curve *curves, double time);

/* The tank before the test: ambient gas. */
GasTank gas_tank_initial(const GasModel *gas, const GasLaw *law, const Curve *curves, double temperature);

/* Mass and enthalpy that flow in from time begin to end, counted from the start of the inflow: nothing before 0. Exact
 * for piecewise linear mass flow and temperature. The spans of successive calls follow each other: the tank is carried
 * along. */
GasInflow gas_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                     GasTank *tank);

/* The part of it that comes from a tank pressure curve, between two corners of all curves over time (gas_tank.c). */
GasInflow gas_tank_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                          GasTank *tank);

/* The first corner after time of the curves that feed the inflow, or +infinity. */
double gas_inflow_next_corner(const GasModel *gas, const Curve *curves, double time);

#endif
