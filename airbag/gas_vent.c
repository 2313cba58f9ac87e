/* Exit flow of gas: orifices of Wang and Nefske or a curve of the mass flow over the gauge pressure. */
#include "airbag/gas_vent.h"

#include "solver/elementary.h"

double gas_orifice_flux(const GasLaw *law, double conversion, double ambient, double pressure, double temperature)
{
    if (!(pressure > ambient)) return 0.0;
    double gamma = gas_gamma(law, temperature), exponent = (gamma - 1.0) / gamma;
    double critical = 2.0 / (gamma + 1.0); /* Q_crit^((gamma-1)/gamma) */
    double log_q = ambient > 0.0 ? elementary_log(ambient / pressure) : -INFINITY;
    double power = elementary_exp(exponent * log_q); /* Q^((gamma-1)/gamma) */
    if (power < critical) {
        power = critical;
        log_q = elementary_log(critical) / exponent;
    }
    double speed2 = 2.0 * conversion / exponent * (1.0 - power); /* over R T */
    return pressure * elementary_exp(log_q / gamma) * sqrt(speed2 / (law->r * temperature));
}

/* A positive constant, else the curve at x, else 0. */
static double constant_or_curve(double constant, const Curve *curves, int curve, double x)
{
    if (constant > 0.0 || curve < 0) return fmax(constant, 0.0);
    return fmax(curve_value(&curves[curve], x), 0.0);
}

static bool is_hole(const GasModel *gas, int place)
{
    for (int i = 0; i < gas->hole_count; i++)
        if (gas->holes[i].place == place) return true;
    return false;
}

/* Eroded area of a part that is no vent by itself (eq. X11). */
static double eroded_area(const GasModel *gas, const GasAreas *areas, int place)
{
    return areas && areas->eroded && gas->vents_eroded && !is_hole(gas, place) ? areas->eroded[place] : 0.0;
}

static double vent_opening(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double pressure)
{
    double area = constant_or_curve(gas->vent_area, curves, gas->vent_area_pressure_curve, pressure);
    for (int i = 0; law->areas && i < gas->hole_count; i++) area += gas_hole_area(&gas->holes[i], law->areas);
    for (int k = 0; gas->vents_eroded && k < gas->surface_parts; k++) area += eroded_area(gas, law->areas, k);
    if (!(area > 0.0)) return 0.0;
    double coefficient = gas->vent_coefficient;
    if (gas->vent_coefficient_time_curve >= 0) {
        coefficient = constant_or_curve(coefficient, curves, gas->vent_coefficient_time_curve, time);
    } else if (gas->vent_coefficient_ratio_curve >= 0) {
        double ratio = gas->ambient_pressure / pressure;
        coefficient = constant_or_curve(coefficient, curves, gas->vent_coefficient_ratio_curve, ratio);
    } else {
        coefficient = constant_or_curve(coefficient, curves, gas->vent_coefficient_pressure_curve, pressure);
    }
    return coefficient * area;
}

static double conversion_of(const GasModel *gas)
{
    return gas->gravity_conversion > 0.0 ? gas->gravity_conversion : 1.0;
}

/* (G49) to (G51). */
double gas_leak_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasLeak *leak, double time,
                     double pressure, double temperature)
{
    double ambient = gas->ambient_pressure, gauge = pressure - ambient;
    if (!(gauge > 0.0) || !law->areas) return 0.0;
    double area = gas_leak_area(leak, curves, law->areas, time, pressure, ambient);
    if (!(area > 0.0)) return 0.0;
    double density = pressure / (law->r * temperature);
    switch ((leak->option + 1) / 2) {
    case 1:
        return area * gas_orifice_flux(law, conversion_of(gas), ambient, pressure, temperature);
    case 2:
        return area * sqrt(2.0 * gauge * density);
    case 3:
        return area * gauge;
    default:
        return area * density;
    }
}

static double leakage(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double pressure,
                      double temperature)
{
    double flow = 0.0;
    for (int i = 0; i < gas->leak_count; i++)
        flow += gas_leak_flow(gas, law, curves, &gas->leaks[i], time, pressure, temperature);
    return flow;
}

GasExit gas_exit_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double pressure,
                      double temperature)
{
    if (!(pressure > gas->ambient_pressure)) return (GasExit){0.0, 0.0};
    if (gas->exit_flow_curve >= 0) {
        double gauge = pressure - gas->ambient_pressure;
        return (GasExit){fmax(curve_value(&curves[gas->exit_flow_curve], gauge), 0.0), 0.0};
    }
    double vent = vent_opening(gas, law, curves, time, pressure);
    double porosity = constant_or_curve(gas->porosity_area, curves, gas->porosity_area_pressure_curve, pressure);
    porosity *= constant_or_curve(gas->porosity_coefficient, curves, gas->porosity_coefficient_time_curve, time);
    double leak = leakage(gas, law, curves, time, pressure, temperature);
    if (!(vent > 0.0) && !(porosity > 0.0)) return (GasExit){0.0, leak};
    double flux = gas_orifice_flux(law, conversion_of(gas), gas->ambient_pressure, pressure, temperature);
    return (GasExit){vent * flux, porosity * flux + leak};
}

/* Scales what was gathered so that it sums to a total, and adds it. */
static void share_flow(const double *weight, int count, double total, double *flow)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) sum += weight[k];
    for (int k = 0; sum > 0.0 && k < count; k++) flow[k] += total * (weight[k] / sum);
}

/* What of the vents' flow leaves through parts of these areas, and not through an exit of the card. */
static double by_parts(const GasModel *gas, const Curve *curves, const GasState *state, const double *area, int count)
{
    const double exit = constant_or_curve(gas->vent_area, curves, gas->vent_area_pressure_curve, state->pressure);
    double sum = 0.0;
    for (int k = 0; k < count; k++) sum += area[k];
    return sum > 0.0 ? state->mass_flow_out_vent * (sum / (sum + exit)) : 0.0;
}

void gas_part_flows(const GasModel *gas, const Curve *curves, const GasAreas *areas, const GasState *state, double time,
                    int count, double *weight, double *flow)
{
    for (int k = 0; k < count; k++) flow[k] = 0.0;
    if (gas->hole_count + gas->leak_count == 0 && !gas->vents_eroded) return;
    GasLaw law = gas_law_of(gas, state);
    law.areas = areas;
    for (int k = 0; k < count; k++) weight[k] = 0.0;
    for (int i = 0; i < gas->leak_count; i++)
        weight[gas->leaks[i].place] +=
            gas_leak_flow(gas, &law, curves, &gas->leaks[i], time, state->pressure, state->temperature);
    share_flow(weight, count, state->mass_flow_out_porosity, flow);
    for (int k = 0; k < count; k++) weight[k] = 0.0;
    for (int i = 0; i < gas->hole_count; i++) weight[gas->holes[i].place] += gas_hole_area(&gas->holes[i], areas);
    for (int k = 0; k < count && k < gas->surface_parts; k++) weight[k] += eroded_area(gas, areas, k);
    share_flow(weight, count, gas->exit_flow_curve < 0 ? by_parts(gas, curves, state, weight, count) : 0.0, flow);
}
