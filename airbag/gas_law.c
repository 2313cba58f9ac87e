/* Heat capacities of an ideal gas: setting up and the isentropic change of state. */
#include "airbag/gas_law.h"

#include "solver/elementary.h"

GasLaw gas_law_of(const GasModel *gas, const GasState *state)
{
    GasLaw law = {.count = gas->species_count, .species = gas->species, .near = state->temperature};
    if (law.count > 0) {
        for (int i = 0; i < law.count; i++) law.fraction[i] = gas->sources[i].initial_fraction;
        gas_law_mix(&law, state->mass > 0.0 ? state->species : law.fraction);
    } else if (gas->temperature_dependent) {
        law.r = gas->gas_constant / gas->molar_mass;
        law.c0 = gas->a / gas->molar_mass - law.r;
        law.c1 = gas->b / gas->molar_mass;
    } else {
        law.c0 = gas->cv;
        law.r = gas->cp - gas->cv;
    }
    return law;
}

/* (G6): c0 y + c1 T (e^y - 1) + R ln ratio = 0 for y = ln(T1/T). Newton from the solution for constant cv; the function
 * is monotone where cv > 0. */
static double solve_entropy(const GasLaw *law, double temperature, double ratio)
{
    double drop = law->r * elementary_log(ratio);
    double y = -drop / (law->c0 + law->c1 * temperature), factor = 1.0;
    for (int i = 0; i < 40; i++) {
        factor = elementary_exp(y);
        double slope = law->c0 + law->c1 * temperature * factor;
        if (!(slope > 0.0)) return NAN;
        double change = (law->c0 * y + law->c1 * temperature * (factor - 1.0) + drop) / slope;
        y -= change;
        if (fabs(change) < 1e-9) break; /* Newton's next error is below 1e-18 */
    }
    return temperature * elementary_exp(y);
}

double gas_isentropic_temperature(const GasLaw *law, double temperature, double ratio)
{
    if (law->count > 0) return gas_mixture_isentropic(law, temperature, ratio);
    if (law->c1 == 0.0) return temperature * elementary_pow(ratio, -law->r / law->c0);
    return solve_entropy(law, temperature, ratio);
}
