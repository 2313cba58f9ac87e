/* Inflow of gas from the pressure history of a tank test (TVOL): rigid adiabatic tank (docs/theory.md, G10 to G12). */
#include "airbag/gas_inflow.h"

/* Temperature of a tank filled from vacuum: u(T) = h(T_in). */
static double filled_from_vacuum(const GasLaw *law, double inflow_temperature)
{
    return gas_temperature(law, 1.0, 0.0, gas_enthalpy(law, inflow_temperature));
}

GasSupply gas_tank_initial(const GasModel *gas, const GasLaw *law, const Curve *curves, double temperature)
{
    GasSupply tank = {.pressure = gas->ambient_pressure, .temperature = temperature};
    if (tank.pressure <= 0.0) tank.temperature = filled_from_vacuum(law, gas_inflow_temperature(gas, curves, 0.0));
    return tank;
}

/* (G10): constant heat capacities; the tank's own state cancels. */
static GasInflow inflow_constant(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                                 double rise)
{
    static const double place[3] = {-0.77459666924148337704, 0.0, 0.77459666924148337704}; /* sqrt(3/5) */
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double inverse = 0.0; /* mean of 1/T */
    for (int i = 0; i < 3; i++) {
        double time = begin + 0.5 * (end - begin) * (1.0 + place[i]);
        double temperature = gas_inflow_temperature(gas, curves, time);
        if (!(temperature > 0.0)) return (GasInflow){0};
        inverse += weight[i] / temperature;
    }
    double share = law->c0 / (law->c0 + law->r); /* 1/gamma */
    return (GasInflow){.mass = gas->tank_volume * rise * share / law->r * inverse,
                       .enthalpy = gas->tank_volume * rise * law->c0 / law->r};
}

/* (G11): d ln T / d ln p of the tank's gas while it is filled. */
static double tank_exponent(const GasLaw *law, double inflow_enthalpy, double temperature)
{
    double surplus = inflow_enthalpy - gas_internal_energy(law, temperature);
    double sensible = (law->c0 + law->c1 * temperature) * temperature;
    return surplus / (surplus + sensible);
}

/* Runge and Kutta's fourth order over a rise of the pressure by the factor 1 + ratio, in p. */
static double tank_step(const GasLaw *law, const double enthalpy[3], double pressure, double rise, double temperature)
{
    double mid = pressure + 0.5 * rise, end = pressure + rise;
    double k1 = temperature / pressure * tank_exponent(law, enthalpy[0], temperature);
    double t2 = temperature + 0.5 * rise * k1;
    double k2 = t2 / mid * tank_exponent(law, enthalpy[1], t2);
    double t3 = temperature + 0.5 * rise * k2;
    double k3 = t3 / mid * tank_exponent(law, enthalpy[1], t3);
    double t4 = temperature + rise * k3;
    double k4 = t4 / end * tank_exponent(law, enthalpy[2], t4);
    return temperature + rise * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
}

static double fill_tank(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                        double rise, const GasSupply *tank)
{
    if (tank->pressure <= 0.0) return filled_from_vacuum(law, gas_inflow_temperature(gas, curves, begin));
    int count = (int)fmin(1.0 + rise / (0.1 * tank->pressure), 200.0);
    double temperature = tank->temperature;
    for (int i = 0; i < count; i++) {
        double enthalpy[3];
        for (int j = 0; j < 3; j++) {
            double time = begin + (end - begin) * (i + 0.5 * j) / count;
            enthalpy[j] = gas_enthalpy(law, gas_inflow_temperature(gas, curves, time));
        }
        temperature = tank_step(law, enthalpy, tank->pressure + rise * i / count, rise / count, temperature);
    }
    return temperature;
}

GasInflow gas_tank_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                          GasSupply *tank)
{
    const Curve *curve = &curves[gas->tank_pressure_curve];
    double rise = curve_value(curve, end) - curve_value(curve, begin);
    if (law->c1 == 0.0) {
        if (rise <= 0.0) return (GasInflow){0};
        return inflow_constant(gas, law, curves, begin, end, rise);
    }
    GasSupply before = *tank;
    tank->pressure = fmax(before.pressure + rise, 0.0);
    if (rise <= 0.0) { /* the tank cools: its mass stays */
        if (before.pressure > 0.0) tank->temperature = before.temperature * (tank->pressure / before.pressure);
        return (GasInflow){0};
    }
    tank->temperature = fill_tank(gas, law, curves, begin, end, rise, &before);
    double density_before = before.pressure > 0.0 ? before.pressure / before.temperature : 0.0; /* times R */
    double density = tank->pressure / tank->temperature;
    double energy_before = density_before * gas_internal_energy(law, before.temperature);
    double energy = density * gas_internal_energy(law, tank->temperature);
    return (GasInflow){.mass = gas->tank_volume * (density - density_before) / law->r,
                       .enthalpy = gas->tank_volume * (energy - energy_before) / law->r}; /* (G12) */
}
