/* Gas from the inflator: mass and enthalpy over a span of time (docs/theory.md, G8 to G12). */
#ifndef BILLOW_GAS_INFLOW_H
#define BILLOW_GAS_INFLOW_H

#include "airbag/gas_law.h"

typedef struct GasInflow {
    double mass, enthalpy;              /* [M], [energy] */
    double species[BILLOW_GAS_SPECIES]; /* masses of a mixture's gases */
} GasInflow;

/* What stands before the bag: the gas of the tank test, tracked only with temperature-dependent heat capacities, or the
 * inflator's chamber. */
typedef struct GasSupply {
    double pressure, temperature; /* of the tank, absolute */
    double inflator_mass, inflator_energy;
    double bag_pressure; /* against which the inflator blows */
} GasSupply;

/* As the state has it. */
static inline GasSupply gas_supply_of(const GasState *state)
{
    return (GasSupply){state->tank_pressure, state->tank_temperature, state->inflator_mass, state->inflator_energy,
                       state->pressure};
}

/* Temperature of the inflow at a time: LCT, or T plus the integral of LCDT from 0; not below 0. */
double gas_inflow_temperature(const GasModel *gas, const Curve *curves, double time);

/* The tank before the test: ambient gas. */
GasSupply gas_tank_initial(const GasModel *gas, const GasLaw *law, const Curve *curves, double temperature);

/* Mass and enthalpy that flow in from time begin to end, counted from the start of the inflow: nothing before 0. Exact
 * for piecewise linear mass flow and temperature. The spans of successive calls follow each other: the tank is carried
 * along. */
GasInflow gas_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                     GasSupply *supply);

/* The part of it that comes from a tank pressure curve, between two corners of all curves over time (gas_tank.c). */
GasInflow gas_tank_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                          GasSupply *supply);

/* What the inflator's chamber blows into the bag, against the supply's bag_pressure (inflator.c). */
GasInflow gas_inflator_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                            GasSupply *supply);

/* A mixture's inflow between two corners of all its curves (gas_inflow_mixture.c). */
GasInflow gas_mixture_inflow(const GasModel *gas, const Curve *curves, double begin, double end);

/* Its mass flows and enthalpy flow at a time since the start of the inflow [M/T], [energy/T]. */
GasInflow gas_mixture_rate(const GasModel *gas, const Curve *curves, double time);

/* The first corner after time of the curves that feed the inflow, or +infinity. */
double gas_inflow_next_corner(const GasModel *gas, const Curve *curves, double time);

#endif
