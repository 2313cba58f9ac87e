/* Heat capacities of an ideal gas, cv = c0 + c1 T, and what follows from them (docs/theory.md, G1 to G6). */
#ifndef BILLOW_GAS_LAW_H
#define BILLOW_GAS_LAW_H

#include <math.h>

#include "airbag/gas.h"

typedef struct GasLaw {
    double c0, c1; /* cv = c0 + c1 T [energy/mass/temperature, .../temperature^2] */
    double r;      /* gas constant per mass, cp - cv */
} GasLaw;

/* From CV and CP, or from A, B, MW and GASC. */
GasLaw gas_law_of(const GasModel *gas);

/* Temperature after an adiabatic change of the volume by the factor ratio, without friction (G6); NaN if the heat
 * capacity turns negative on the way. */
double gas_isentropic_temperature(const GasLaw *law, double temperature, double ratio);

/* Internal energy and enthalpy per mass, the integrals of cv and cp from 0 to T (G2). */
static inline double gas_internal_energy(const GasLaw *law, double temperature)
{
    return temperature * (law->c0 + 0.5 * law->c1 * temperature);
}

static inline double gas_enthalpy(const GasLaw *law, double temperature)
{
    return gas_internal_energy(law, temperature) + law->r * temperature;
}

static inline double gas_gamma(const GasLaw *law, double temperature)
{
    return 1.0 + law->r / (law->c0 + law->c1 * temperature);
}

/* T of mass u(T) + outflow R T = energy (G5): with outflow = 0 the temperature of the gas, else the temperature at
 * which the rest of the gas and the outflow left if they had mass and energy together. The root of a quadratic in the
 * form that holds for c1 = 0; NaN where cv(T) would be negative. */
static inline double gas_temperature(const GasLaw *law, double mass, double outflow, double energy)
{
    double b = mass * law->c0 + outflow * law->r;
    return 2.0 * energy / (b + sqrt(b * b + 2.0 * mass * law->c1 * energy));
}

#endif
