/* The step that resolves an ideal gas without elements around it. */
#include "airbag/chamber.h"
#include "airbag/gas_exchange.h"
#include "airbag/gas_heat.h"
#include "airbag/gas_inflow.h"
#include "airbag/gas_vent.h"

static const double MASS_SHARE = 0.01;  /* of the gas that may flow in or out in a step */
static const double GAP_SHARE = 0.05;   /* of the way to the ambient pressure */
static const double GAP_LEAST = 1e-3;   /* of the pressure: nearer, the way no longer counts */
static const double EMPTY_SHARE = 1e-6; /* of the time to the next corner, while there is no gas to measure by */
static const double HEAT_SHARE = 0.01;  /* of the time constant of the heat loss */

/* The next corner of a curve over time, but not one within rounding of time. */
static double corner_after(const Curve *curves, int curve, double time, double margin, double nearest)
{
    if (curve < 0) return nearest;
    return fmin(nearest, curve_next_corner(&curves[curve], time + margin));
}

static double next_corner(const GasModel *gas, const Curve *curves, double start, double time, double margin)
{
    double corner = start < INFINITY ? start + gas_inflow_next_corner(gas, curves, time - start + margin) : INFINITY;
    corner = corner_after(curves, gas->vent_coefficient_time_curve, time, margin, corner);
    corner = corner_after(curves, gas->porosity_coefficient_time_curve, time, margin, corner);
    return corner_after(curves, gas->heat_transfer_curve, time, margin, corner);
}

/* Time up to a horizon in which the inflow brings a share of the mass and energy that are there. The horizon shrinks by
 * the share found, but not by more than ten at once: a flow that rises from zero is far below its mean at first. */
static double fill_scale(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasState *state,
                         double time, double horizon)
{
    for (int i = 0; i < 100; i++) {
        GasSupply supply = gas_supply_of(state);
        GasInflow inflow =
            gas_inflow(gas, law, curves, time - state->inflow_start, time - state->inflow_start + horizon, &supply);
        if (!(inflow.mass > 0.0)) return horizon;
        if (!(state->mass > 0.0)) return EMPTY_SHARE * horizon;
        double share = fmax(inflow.mass / state->mass, inflow.enthalpy / state->energy);
        if (share <= 1.001 * MASS_SHARE) return horizon;
        horizon *= fmax(MASS_SHARE / share, 0.1);
    }
    return horizon;
}

static double exit_scale(const GasModel *gas, const GasLaw *law, const Curve *curves, const GasState *state,
                         double time)
{
    if (!(state->opened > 0.0)) return CHAMBER_NO_SCALE;
    GasExit exit = gas_exit_flow(gas, law, curves, time, state->pressure, state->temperature);
    double flow = exit.vent + exit.porosity;
    if (gas->hole_count + gas->leak_count > 0 || gas->vents_eroded)
        flow = fmax(flow, state->mass_flow_out); /* as far as it is known */
    if (!(flow > 0.0)) return CHAMBER_NO_SCALE;
    double gap = fmax((state->pressure - gas->ambient_pressure) / state->pressure, GAP_LEAST);
    return fmin(MASS_SHARE, GAP_SHARE * gap) * state->mass / flow;
}

double ideal_gas_time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    GasLaw law = gas_law_of(gas, state);
    double scale = exit_scale(gas, &law, curves, state, time);
    double coefficient = gas_heat_coefficient(gas, curves, time);
    if (coefficient > 0.0 && state->mass > 0.0 && state->area > 0.0) {
        double cv = gas_cv(&law, state->temperature);
        scale = fmin(scale, HEAT_SHARE * state->mass * cv / (coefficient * state->area));
    }
    double margin = 1e-9 * fabs(time); /* the inflow is integrated exactly over a corner that is passed */
    double corner = next_corner(gas, curves, state->inflow_start, time, margin);
    double horizon = fmin(scale, fmin(corner - time, CHAMBER_NO_SCALE));
    return fill_scale(gas, &law, curves, state, time, horizon);
}
