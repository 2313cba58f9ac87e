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

static double vent_opening(const GasModel *gas, const Curve *curves, double time, double pressure)
{
    double area = constant_or_curve(gas->vent_area, curves, gas->vent_area_pressure_curve, pressure);
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

GasExit gas_exit_flow(const GasModel *gas, const GasLaw *law, const Curve *curves, double time, double pressure,
                      double temperature)
{
    if (!(pressure > gas->ambient_pressure)) return (GasExit){0.0, 0.0};
    if (gas->exit_flow_curve >= 0) {
        double gauge = pressure - gas->ambient_pressure;
        return (GasExit){fmax(curve_value(&curves[gas->exit_flow_curve], gauge), 0.0), 0.0};
    }
    double vent = vent_opening(gas, curves, time, pressure);
    double porosity = constant_or_curve(gas->porosity_area, curves, gas->porosity_area_pressure_curve, pressure);
    porosity *= constant_or_curve(gas->porosity_coefficient, curves, gas->porosity_coefficient_time_curve, time);
    if (!(vent > 0.0) && !(porosity > 0.0)) return (GasExit){0.0, 0.0};
    double conversion = gas->gravity_conversion > 0.0 ? gas->gravity_conversion : 1.0;
    double flux = gas_orifice_flux(law, conversion, gas->ambient_pressure, pressure, temperature);
    return (GasExit){vent * flux, porosity * flux};
}
