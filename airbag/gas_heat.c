/* Heat that the gas loses to the surroundings through the fabric. */
#include "airbag/gas_heat.h"

#include "airbag/gas_ledger.h"
#include "solver/elementary.h"

double gas_ambient_temperature(const GasModel *gas, const GasLaw *law)
{
    if (gas->ambient_temperature > 0.0) return gas->ambient_temperature;
    if (gas->ambient_density > 0.0) return gas->ambient_pressure / (gas->ambient_density * law->r);
    return 0.0;
}

double gas_heat_coefficient(const GasModel *gas, const Curve *curves, double time)
{
    if (gas->heat_transfer > 0.0 || gas->heat_transfer_curve < 0) return fmax(gas->heat_transfer, 0.0);
    return fmax(curve_value(&curves[gas->heat_transfer_curve], time), 0.0);
}

/* Integral of the coefficient over time; a curve may not turn it negative. */
static double coefficient_integral(const GasModel *gas, const Curve *curves, double begin, double end)
{
    if (gas->heat_transfer > 0.0 || gas->heat_transfer_curve < 0) return (end - begin) * fmax(gas->heat_transfer, 0.0);
    return fmax(curve_integral(&curves[gas->heat_transfer_curve], begin, end), 0.0);
}

void gas_lose_heat(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end, double area,
                   GasState *state)
{
    if (gas->heat_transfer_curve < 0 && !(gas->heat_transfer > 0.0)) return;
    double dose = coefficient_integral(gas, curves, begin, end) * area;
    if (!(dose > 0.0) || !(state->mass > 0.0)) return;
    double ambient = gas_ambient_temperature(gas, law), before = state->temperature, after = before;
    bool constant = law->count == 0 && law->c1 == 0.0;
    for (int i = 0; i < (constant ? 1 : 3); i++) { /* where cv is linear in T its mean is that of the mean T */
        double cv = gas_cv(law, 0.5 * (before + after));
        after = ambient + (before - ambient) * elementary_exp(-dose / (state->mass * cv));
    }
    double heat = state->mass * (gas_internal_energy(law, before) - gas_internal_energy(law, after));
    gas_book(&state->energy, &state->carry[CARRY_ENERGY], -heat);
    gas_book(&state->heat_out, &state->carry[CARRY_HEAT], heat);
}
