/* Inflow of gas by a curve of mass flow over time, at a temperature that may change in time. */
#include "airbag/gas_inflow.h"

double gas_inflow_temperature(const GasModel *gas, const Curve *curves, double time)
{
    double temperature = gas->inflow_temperature;
    if (gas->temperature_curve >= 0) {
        temperature = curve_value(&curves[gas->temperature_curve], time);
    } else if (gas->temperature_rate_curve >= 0) {
        temperature += curve_integral(&curves[gas->temperature_rate_curve], 0.0, time);
    }
    return fmax(temperature, 0.0);
}

static double next_corner_of(const Curve *curves, int curve, double time, double nearest)
{
    return curve < 0 ? nearest : fmin(nearest, curve_next_corner(&curves[curve], time));
}

double gas_inflow_next_corner(const GasModel *gas, const Curve *curves, double time)
{
    double corner = INFINITY;
    corner = next_corner_of(curves, gas->mass_flow_curve, time, corner);
    corner = next_corner_of(curves, gas->tank_pressure_curve, time, corner);
    corner = next_corner_of(curves, gas->inflator.burn_curve, time, corner);
    for (int i = 0; i < gas->species_count; i++) {
        corner = next_corner_of(curves, gas->sources[i].mass_flow_curve, time, corner);
        corner = next_corner_of(curves, gas->sources[i].temperature_curve, time, corner);
        corner = next_corner_of(curves, gas->sources[i].mole_fraction_curve, time, corner);
    }
    corner = next_corner_of(curves, gas->temperature_curve, time, corner);
    return next_corner_of(curves, gas->temperature_rate_curve, time, corner);
}

/* (G9): between corners the mass flow is linear and the temperature at most quadratic in time, so that mdot h(T) has at
 * most the degree 5 which Gauss's rule of three points integrates exactly. */
static double integrate_enthalpy(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end)
{
    static const double place[3] = {-0.77459666924148337704, 0.0, 0.77459666924148337704}; /* sqrt(3/5) */
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double half = 0.5 * (end - begin), sum = 0.0;
    for (int i = 0; i < 3; i++) {
        double time = begin + half * (1.0 + place[i]);
        double flow = fmax(curve_value(&curves[gas->mass_flow_curve], time), 0.0);
        sum += weight[i] * flow * gas_enthalpy(law, gas_inflow_temperature(gas, curves, time));
    }
    return sum * (end - begin);
}

/* Between two corners; a negative mass flow counts as none, so the piece is cut where the curve crosses zero. */
static GasInflow curve_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end)
{
    const Curve *flow = &curves[gas->mass_flow_curve];
    double first = curve_value(flow, begin), last = curve_value(flow, end);
    if (first <= 0.0 && last <= 0.0) return (GasInflow){0};
    if (first < 0.0) {
        begin += (end - begin) * (first / (first - last));
        first = 0.0;
    } else if (last < 0.0) {
        end = begin + (end - begin) * (first / (first - last));
        last = 0.0;
    }
    GasInflow inflow = {.mass = 0.5 * (end - begin) * (first + last)};
    if (gas->temperature_curve < 0 && gas->temperature_rate_curve < 0) {
        inflow.enthalpy = inflow.mass * gas_enthalpy(law, gas->inflow_temperature);
    } else {
        inflow.enthalpy = integrate_enthalpy(gas, law, curves, begin, end);
    }
    return inflow;
}

GasInflow gas_inflow(const GasModel *gas, const GasLaw *law, const Curve *curves, double begin, double end,
                     GasSupply *supply)
{
    GasInflow total = {0};
    begin = fmax(begin, 0.0);
    while (begin < end) {
        double stop = fmin(end, gas_inflow_next_corner(gas, curves, begin));
        GasInflow piece = {0};
        if (gas->species_count > 0) {
            piece = gas_mixture_inflow(gas, curves, begin, stop);
            for (int i = 0; i < gas->species_count; i++) total.species[i] += piece.species[i];
        } else if (gas->mass_flow_curve >= 0) {
            piece = curve_inflow(gas, law, curves, begin, stop);
        } else if (gas->inflator.volume > 0.0) {
            piece = gas_inflator_flow(gas, law, curves, begin, stop, supply);
        } else if (gas->tank_pressure_curve >= 0) {
            piece = gas_tank_inflow(gas, law, curves, begin, stop, supply);
        }
        total.mass += piece.mass;
        total.enthalpy += piece.enthalpy;
        begin = stop;
    }
    return total;
}
