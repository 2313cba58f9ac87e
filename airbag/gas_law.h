/* Heat capacities of an ideal gas or a mixture, and what follows from them (docs/theory.md, G1 to G6, G34 to G38). */
#ifndef BILLOW_GAS_LAW_H
#define BILLOW_GAS_LAW_H

#include <math.h>

#include "airbag/gas.h"

typedef struct GasLaw {
    double c0, c1; /* one gas: cv = c0 + c1 T [energy/mass/temperature, .../temperature^2] */
    double r;      /* gas constant per mass, cp - cv */
    double near;   /* mixtures: a temperature from which to look for one, > 0 */
    int count;     /* gases of a mixture; 0: one gas */
    const GasSpecies *species;
    double fraction[BILLOW_GAS_SPECIES]; /* by mass */
    const GasAreas *areas;               /* of the walls, for the exits; NULL: none are known */
    SpeciesPiece mixed;                  /* the mixture's heat capacity around near */
} GasLaw;

/* From CV and CP, or from A, B, MW and GASC; of a mixture at the composition and temperature of the state. */
GasLaw gas_law_of(const GasModel *gas, const GasState *state);

/* Takes the composition from masses: sets r, the fractions and the piece around near. Without mass they stay. */
void gas_law_mix(GasLaw *law, const double *mass);

/* Of a mixture: cp, enthalpy, the temperature of mass u(T) + outflow R T = energy, the isentropic one. */
double gas_mixture_cp(const GasLaw *law, double temperature);
double gas_mixture_enthalpy(const GasLaw *law, double temperature);
double gas_mixture_temperature(const GasLaw *law, double mass, double outflow, double energy);
double gas_mixture_isentropic(const GasLaw *law, double temperature, double ratio);

/* Temperature after an adiabatic change of the volume by the factor ratio, without friction (G6); NaN if the heat
 * capacity turns negative on the way. */
double gas_isentropic_temperature(const GasLaw *law, double temperature, double ratio);

/* Heat capacity at constant volume at a temperature. */
static inline double gas_cv(const GasLaw *law, double temperature)
{
    return law->count > 0 ? gas_mixture_cp(law, temperature) - law->r : law->c0 + law->c1 * temperature;
}

/* Internal energy and enthalpy per mass, the integrals of cv and cp from 0 to T (G2). */
static inline double gas_internal_energy(const GasLaw *law, double temperature)
{
    if (law->count > 0) return gas_mixture_enthalpy(law, temperature) - law->r * temperature;
    return temperature * (law->c0 + 0.5 * law->c1 * temperature);
}

static inline double gas_enthalpy(const GasLaw *law, double temperature)
{
    if (law->count > 0) return gas_mixture_enthalpy(law, temperature);
    return gas_internal_energy(law, temperature) + law->r * temperature;
}

static inline double gas_gamma(const GasLaw *law, double temperature)
{
    return 1.0 + law->r / gas_cv(law, temperature);
}

/* T of mass u(T) + outflow R T = energy (G5): with outflow = 0 the temperature of the gas, else the temperature at
 * which the rest of the gas and the outflow left if they had mass and energy together. The root of a quadratic in the
 * form that holds for c1 = 0; NaN where cv(T) would be negative. Mixtures: Newton's iteration (G38). */
static inline double gas_temperature(const GasLaw *law, double mass, double outflow, double energy)
{
    if (law->count > 0) return gas_mixture_temperature(law, mass, outflow, energy);
    double b = mass * law->c0 + outflow * law->r;
    return 2.0 * energy / (b + sqrt(b * b + 2.0 * mass * law->c1 * energy));
}

#endif
