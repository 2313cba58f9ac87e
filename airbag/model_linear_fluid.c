/* *AIRBAG_LINEAR_FLUID: a compressible liquid that flows in and out (docs/theory.md, G30 to G33). */
#include <math.h>

#include "airbag/chamber.h"
#include "airbag/gas_ledger.h"
#include "solver/elementary.h"

/* What the law is at one time. */
typedef struct Liquid {
    double bulk, added, limit; /* limit: +infinity where there is none */
} Liquid;

static Liquid liquid_at(const LinearFluidLaw *law, const Curve *curves, double time)
{
    Liquid liquid = {chamber_value(curves, law->bulk_curve, time, law->bulk),
                     chamber_value(curves, law->added_pressure_curve, time, 0.0), law->limit};
    if (law->limit_curve >= 0)
        liquid.limit = curve_value(&curves[law->limit_curve], time);
    else if (law->limit == 0.0)
        liquid.limit = INFINITY;
    return liquid;
}

/* (G30). A bag without mass has no pressure but the added one. */
static double pressure_of(const Liquid *liquid, double density, double mass, double volume)
{
    if (!(mass > 0.0)) return fmin(liquid->added, liquid->limit);
    return fmin(liquid->bulk * elementary_log(mass / (density * volume)) + liquid->added, liquid->limit);
}

static void set_pressure(const GasModel *gas, const Curve *curves, double time, GasState *state)
{
    const LinearFluidLaw *law = &gas->fluid;
    Liquid liquid = liquid_at(law, curves, time);
    state->density = state->mass / state->volume;
    if (law->pressure_curve >= 0) {
        state->pressure = fmin(curve_value(&curves[law->pressure_curve], time), liquid.limit);
        state->stiffness = 0.0;
    } else {
        state->pressure = pressure_of(&liquid, gas->density, state->mass, state->volume);
        state->stiffness = state->mass > 0.0 && state->pressure < liquid.limit ? liquid.bulk / state->volume : 0.0;
    }
    state->applied = state->pressure;
}

static const char *start(const GasModel *gas, const Curve *curves, GasState *state)
{
    const LinearFluidLaw *law = &gas->fluid;
    if (!(gas->density > 0.0)) return "RO must be positive";
    if (law->pressure_curve < 0 && law->bulk_curve < 0 && !(law->bulk > 0.0))
        return "BULK must be positive unless LCBULK or LCID is given";
    state->opened = 1.0;
    state->mass = state->initial_mass = gas->density * state->volume;
    set_pressure(gas, curves, 0.0, state);
    return NULL;
}

/* Mass left after an outflow H(p) over the span, the root of mass + span weight H(p(mass)) = total. H may have jumps
 * and any slope: bisection and secant within a bracket. */
static double drain(const Liquid *liquid, const Curve *curve, double density, double volume, double span, double total)
{
    double low = 0.0, high = total;
    double mass = total;
    for (int i = 0; i < 200 && high - low > 1e-15 * total; i++) {
        double flow = fmax(curve_value(curve, pressure_of(liquid, density, mass, volume)), 0.0);
        double target = total - span * flow;
        if (target >= mass) low = mass;
        if (target <= mass) high = mass;
        mass = i % 2 == 0 && target > low && target < high ? target : 0.5 * (low + high);
    }
    return 0.5 * (low + high);
}

static double flow_at(const Liquid *liquid, const Curve *curve, double density, double mass, double volume)
{
    return fmax(curve_value(curve, pressure_of(liquid, density, mass, volume)), 0.0);
}

/* (G32): trapezoidal where the flow is slow and goes on, else implicit. */
static double outflow_by_pressure(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                                  double pressure, double mass)
{
    const Curve *curve = &curves[gas->fluid.outflow_pressure_curve];
    Liquid liquid = liquid_at(&gas->fluid, curves, step->time + step->dt);
    double early = 0.5 * step->dt * fmax(curve_value(curve, pressure), 0.0);
    double slope = fabs(curve_slope(curve, pressure)) * liquid.bulk / mass;
    if (slope * step->dt < 1.0 && early < 0.1 * mass) {
        double left = drain(&liquid, curve, gas->density, volume, 0.5 * step->dt, mass - early);
        if (flow_at(&liquid, curve, gas->density, left, volume) > 0.0) return mass - left;
    }
    return mass - drain(&liquid, curve, gas->density, volume, step->dt, mass);
}

/* (G31): the flows by time are exact. */
static void exchange(const GasModel *gas, const Curve *curves, const GasStep *step, double volume, GasState *state)
{
    const LinearFluidLaw *law = &gas->fluid;
    double end = step->time + step->dt;
    double in = law->inflow_curve >= 0 ? curve_integral(&curves[law->inflow_curve], step->time, end) : 0.0;
    double out = law->outflow_curve >= 0 ? curve_integral(&curves[law->outflow_curve], step->time, end) : 0.0;
    double rest = fmax(state->mass + in - out, 0.0);
    out = state->mass + in - rest;
    if (law->outflow_pressure_curve >= 0 && rest > 0.0)
        out += outflow_by_pressure(gas, curves, step, volume, state->pressure, rest);
    gas_book(&state->mass, &state->carry[CARRY_MASS], in);
    gas_book(&state->mass, &state->carry[CARRY_MASS], -out);
    gas_book(&state->mass_in, &state->carry[CARRY_MASS_IN], in);
    gas_book(&state->mass_out, &state->carry[CARRY_MASS_OUT], out);
    state->mass_flow_out_vent += out;
}

static const char *advance(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state)
{
    double before = state->volume, pressure = state->pressure;
    if (gas->fluid.pressure_curve >= 0) { /* the mass follows the volume */
        double change = gas->density * volume - state->mass;
        gas_book(&state->mass, &state->carry[CARRY_MASS], change);
        if (change > 0.0) gas_book(&state->mass_in, &state->carry[CARRY_MASS_IN], change);
        if (change < 0.0) gas_book(&state->mass_out, &state->carry[CARRY_MASS_OUT], -change);
    } else {
        exchange(gas, curves, step, volume, state);
    }
    state->volume = volume;
    state->area = step->area;
    set_pressure(gas, curves, step->time + step->dt, state);
    gas_book(&state->work, &state->carry[CARRY_WORK], 0.5 * (pressure + state->pressure) * (volume - before));
    return NULL;
}

static double time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    const LinearFluidLaw *law = &gas->fluid;
    double scale = CHAMBER_NO_SCALE;
    const int of_time[] = {law->bulk_curve,           law->inflow_curve,   law->outflow_curve,
                           law->added_pressure_curve, law->pressure_curve, law->limit_curve};
    for (size_t i = 0; i < sizeof of_time / sizeof *of_time; i++)
        scale = chamber_next_corner(curves, of_time[i], time, 0.0, scale);
    if (law->pressure_curve >= 0) return scale;
    double flow = fabs(chamber_value(curves, law->inflow_curve, time, 0.0)) +
                  fabs(chamber_value(curves, law->outflow_curve, time, 0.0)) +
                  fabs(chamber_value(curves, law->outflow_pressure_curve, state->pressure, 0.0));
    if (flow > 0.0 && state->mass > 0.0) { /* a hundredth of the pressure, or of the modulus near none */
        double bulk = liquid_at(law, curves, time).bulk;
        double share = fmax(fabs(state->pressure), 1e-3 * bulk) / bulk;
        scale = fmin(scale, 0.01 * fmin(share, 1.0) * state->mass / flow);
    }
    return scale;
}

static double pressure_at_mass(const GasModel *gas, const Curve *curves, double time, const GasState *state,
                               double mass)
{
    GasState other = *state;
    other.mass = mass;
    set_pressure(gas, curves, time, &other);
    return other.pressure;
}

const ChamberModel chamber_linear_fluid = {"LINEAR_FLUID", start, advance, time_scale, set_pressure, pressure_at_mass};
