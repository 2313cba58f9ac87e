/* Inflow of a mixture: a mass flow for each gas, or one for all that mole fractions share out (docs/theory.md, G39 to
 * G41). */
#include <math.h>

#include "airbag/gas_inflow.h"

/* Adds the mass of one gas at a time, and the ambient gas that it draws in. */
static void add_gas(const GasModel *gas, const Curve *curves, int i, double time, double mass, GasInflow *inflow)
{
    const GasSource *source = &gas->sources[i];
    double temperature = fmax(curve_value(&curves[source->temperature_curve], time), 0.0);
    inflow->mass += mass;
    inflow->species[i] += mass;
    inflow->enthalpy += mass * species_enthalpy(&gas->species[i], temperature);
    if (!(source->aspirated > 0.0)) return;
    for (int k = 0; k < gas->species_count; k++) {
        double drawn = mass * source->aspirated * gas->sources[k].initial_fraction;
        inflow->mass += drawn;
        inflow->species[k] += drawn;
        inflow->enthalpy += drawn * species_enthalpy(&gas->species[k], gas->ambient_temperature);
    }
}

/* Mass fractions of the total inflow at a time from the mole fractions (G40). */
static void share_out(const GasModel *gas, const Curve *curves, double time, double *fraction)
{
    double sum = 0.0;
    for (int i = 0; i < gas->species_count; i++) {
        const GasSource *source = &gas->sources[i];
        double mole = source->mole_fraction;
        if (source->mole_fraction_curve >= 0) mole = curve_value(&curves[source->mole_fraction_curve], time);
        fraction[i] = fmax(mole, 0.0) * gas->species[i].molar_mass;
        sum += fraction[i];
    }
    for (int i = 0; i < gas->species_count; i++) fraction[i] = sum > 0.0 ? fraction[i] / sum : 0.0;
}

/* What flows in over a short span, as at one time. */
static void add_point(const GasModel *gas, const Curve *curves, double time, double span, GasInflow *inflow)
{
    double fraction[BILLOW_GAS_SPECIES];
    if (gas->total_inflow) {
        double flow = fmax(curve_value(&curves[gas->mass_flow_curve], time), 0.0);
        if (!(flow > 0.0)) return;
        share_out(gas, curves, time, fraction);
        for (int i = 0; i < gas->species_count; i++)
            if (fraction[i] > 0.0) add_gas(gas, curves, i, time, span * flow * fraction[i], inflow);
        return;
    }
    for (int i = 0; i < gas->species_count; i++) {
        int curve = gas->sources[i].mass_flow_curve;
        double flow = curve >= 0 ? curve_value(&curves[curve], time) : 0.0;
        if (flow > 0.0) add_gas(gas, curves, i, time, span * flow, inflow);
    }
}

/* The next time from begin at which a linear flow changes its sign, at most end: a negative flow counts as none. */
static double next_sign_change(const Curve *curves, int curve, double begin, double end)
{
    if (curve < 0) return end;
    double first = curve_value(&curves[curve], begin), last = curve_value(&curves[curve], end);
    if (!(first * last < 0.0)) return end;
    return begin + (end - begin) * (first / (first - last));
}

GasInflow gas_mixture_inflow(const GasModel *gas, const Curve *curves, double begin, double end)
{
    static const double place[3] = {-0.77459666924148337704, 0.0, 0.77459666924148337704}; /* sqrt(3/5) */
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    GasInflow inflow = {0};
    while (begin < end) {
        double stop = next_sign_change(curves, gas->mass_flow_curve, begin, end);
        for (int i = 0; i < gas->species_count; i++)
            stop = next_sign_change(curves, gas->sources[i].mass_flow_curve, begin, stop);
        if (!(stop > begin)) stop = end;
        for (int k = 0; k < 3; k++)
            add_point(gas, curves, begin + 0.5 * (stop - begin) * (1.0 + place[k]), weight[k] * (stop - begin),
                      &inflow);
        begin = stop;
    }
    return inflow;
}

GasInflow gas_mixture_rate(const GasModel *gas, const Curve *curves, double time)
{
    GasInflow rate = {0};
    add_point(gas, curves, time, 1.0, &rate);
    return rate;
}
