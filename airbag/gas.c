/* Control volumes of all models: what they have in common. */
#include "airbag/gas.h"

#include <math.h>
#include <string.h>

#include "airbag/chamber.h"
#include "airbag/connection.h"

static const ChamberModel *const models[GAS_KIND_COUNT] = {
    [GAS_SIMPLE] = &chamber_ideal_gas_simple,         [GAS_WANG_NEFSKE] = &chamber_ideal_gas_wang_nefske,
    [GAS_HYBRID] = &chamber_ideal_gas_hybrid,         [GAS_CHEMKIN] = &chamber_ideal_gas_chemkin,
    [GAS_PRESSURE_VOLUME] = &chamber_pressure_volume, [GAS_ADIABATIC] = &chamber_adiabatic,
    [GAS_LOAD_CURVE] = &chamber_load_curve,           [GAS_LINEAR_FLUID] = &chamber_linear_fluid,
    [GAS_FLUID_AND_GAS] = &chamber_fluid_and_gas,
};

const char *gas_name(GasKind kind)
{
    return models[kind]->name;
}

void gas_model_reset(GasModel *gas)
{
    memset(gas, 0, sizeof *gas);
    gas->gravity_conversion = 1.0;
    gas->temperature_curve = gas->temperature_rate_curve = -1;
    gas->mass_flow_curve = gas->tank_pressure_curve = -1;
    gas->vent_coefficient_pressure_curve = gas->vent_area_pressure_curve = -1;
    gas->vent_coefficient_time_curve = gas->vent_coefficient_ratio_curve = -1;
    gas->porosity_coefficient_time_curve = gas->porosity_area_pressure_curve = -1;
    gas->exit_flow_curve = gas->heat_transfer_curve = gas->inflator.burn_curve = -1;
    gas->pressure_volume = (PressureVolumeLaw){.coefficient_curve = -1, .relative_curve = -1};
    gas->adiabatic = (AdiabaticLaw){.factor = 1.0, .preload_curve = -1};
    gas->fluid_and_gas = (FluidAndGasLaw){.up = 1.0, .level_curve = -1, .pressure_curve = -1, .gravity_curve = -1};
    gas->load_curve = (LoadCurveLaw){.pressure_curve = -1};
    gas->fluid = (LinearFluidLaw){.bulk_curve = -1,
                                  .inflow_curve = -1,
                                  .outflow_curve = -1,
                                  .outflow_pressure_curve = -1,
                                  .added_pressure_curve = -1,
                                  .pressure_curve = -1,
                                  .limit_curve = -1};
}

double chamber_next_corner(const Curve *curves, int curve, double time, double shift, double scale)
{
    if (curve < 0) return scale;
    double corner = curve_next_corner(&curves[curve], time - shift + 1e-9 * fabs(time)) + shift - time;
    return corner < scale ? corner : scale;
}

/* (G23): what the walls of the mesh feel. */
static void scale_applied(double vsca, double psca, GasState *state)
{
    state->applied *= psca;
    state->stiffness *= psca * vsca;
}

int gas_initialize(const GasModel *gas, const Curve *curves, double vsca, double psca, double vini, double volume,
                   double area, GasState *state, const char **why)
{
    memset(state, 0, sizeof *state);
    double size = vsca * area * sqrt(area), raw = vsca * volume - vini;
    state->guard = BILLOW_GAS_GUARD * size;
    state->area = area;
    state->volume = state->initial_volume = fmax(raw, state->guard);
    state->flat = raw < state->guard ? 1.0 : 0.0;
    *why = NULL;
    if (!(raw >= -BILLOW_GAS_FLAT * size)) {
        *why = "the volume of the gas, VSCA V - VINI, is negative at the start";
    } else if (!(state->volume > 0.0)) {
        *why = "the bag has neither volume nor surface";
    }
    const char *fault = models[gas->kind]->start(gas, curves, state);
    if (fault) *why = fault;
    if (*why) return -1;
    scale_applied(vsca, psca, state);
    return 0;
}

bool gas_asleep(const GasModel *gas, const GasState *state)
{
    return gas->kind >= GAS_PRESSURE_VOLUME && isinf(state->inflow_start);
}

void gas_sleep(const GasModel *gas, GasState *state)
{
    state->inflow_start = INFINITY;
    if (!gas_asleep(gas, state)) return;
    *state = (GasState){.volume = state->volume,
                        .area = state->area,
                        .guard = state->guard,
                        .flat = state->flat,
                        .initial_volume = state->initial_volume,
                        .pressure = gas->ambient_pressure,
                        .inflow_start = INFINITY};
}

void gas_wake(const GasModel *gas, const Curve *curves, double vsca, double psca, double time, GasState *state)
{
    bool begins = gas_asleep(gas, state);
    state->inflow_start = time;
    if (!begins) return;
    state->initial_volume = state->volume;
    models[gas->kind]->start(gas, curves, state); /* what it refuses it has refused at the build */
    scale_applied(vsca, psca, state);
}

/* The time that a model's curves count from: that of laws begins with the bag. */
static double own_time(const GasModel *gas, const GasState *state, double time)
{
    return gas->kind >= GAS_PRESSURE_VOLUME ? time - state->inflow_start : time;
}

/* Volume of the gas at the end of the step, or NAN with *why set. */
static double next_volume(const GasState *state, double vsca, double vini, const GasStep *step, const char **why)
{
    double raw = vsca * step->volume - vini, flat = state->guard * (BILLOW_GAS_FLAT / BILLOW_GAS_GUARD);
    if (!isfinite(raw)) {
        *why = "the volume of the bag is not finite";
        return NAN;
    }
    if (raw < -flat || (raw < 0.0 && state->volume > flat) || !(fmax(raw, state->guard) > 0.0)) {
        *why = "the volume of the gas became negative: the bag is turned inside out or VINI is too large";
        return NAN;
    }
    return fmax(raw, state->guard);
}

int gas_advance(const GasModel *gas, const Curve *curves, double vsca, double psca, double vini, const GasStep *step,
                GasState *state, const char **why)
{
    double volume = next_volume(state, vsca, vini, step, why);
    if (isnan(volume)) return -1;
    GasState next = *state;
    next.mass_flow_out_vent = next.mass_flow_out_porosity = next.mass_flow_inflator = 0.0;
    if (gas_asleep(gas, state)) {
        next.volume = volume;
        next.area = step->area;
        *state = next;
        return 0;
    }
    GasStep own = *step;
    own.time = own_time(gas, state, step->time);
    *why = models[gas->kind]->advance(gas, curves, &own, volume, &next);
    if (!*why && !(isfinite(next.pressure) && isfinite(next.applied))) *why = "the pressure of the gas is not finite";
    if (*why) return -1;
    if (next.volume > next.guard * (BILLOW_GAS_FLAT / BILLOW_GAS_GUARD)) next.flat = 0.0;
    double rate = step->dt > 0.0 ? 1.0 / step->dt : 0.0; /* masses of the step to mean flows */
    next.mass_flow_in = (next.mass_in - state->counted_in) * rate;
    next.mass_flow_out = (next.mass_out - state->counted_out) * rate;
    next.counted_in = next.mass_in;
    next.counted_out = next.mass_out;
    next.mass_flow_inflator *= rate;
    next.mass_flow_out_vent *= rate;
    next.mass_flow_out_porosity *= rate;
    scale_applied(vsca, psca, &next);
    *state = next;
    return 0;
}

void gas_refresh(GasSide *side, const Curve *curves, double time)
{
    models[side->gas->kind]->refresh(side->gas, curves, own_time(side->gas, side->state, time), side->state);
    scale_applied(side->vsca, side->psca, side->state);
}

bool gas_connects(GasKind kind)
{
    return models[kind]->refresh != NULL;
}

double chamber_pressure(const GasModel *gas, const Curve *curves, double time, const GasState *state, double mass)
{
    return models[gas->kind]->pressure(gas, curves, own_time(gas, state, time), state, mass);
}

double gas_time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time)
{
    if (gas_asleep(gas, state)) return CHAMBER_NO_SCALE;
    return models[gas->kind]->time_scale(gas, curves, state, own_time(gas, state, time));
}
