/* What every control-volume model provides; airbag/gas.c does what they have in common: volume, scales, guard.
 *
 * A model fills pressure (absolute where it has an ambient pressure), applied (what acts on the walls, before PSCA) and
 * stiffness (-d applied/dV of the gas) of the state, and books mass, energy and work in the ledger. */
#ifndef BILLOW_CHAMBER_H
#define BILLOW_CHAMBER_H

#include "airbag/gas.h"

typedef struct ChamberModel {
    const char *name; /* keyword without *AIRBAG_ */
    /* The state at time 0; volume, area, guard and flat are set. NULL, or why it cannot be, naming the field. */
    const char *(*start)(const GasModel *gas, const Curve *curves, GasState *state);
    /* From the state before the step to the one after it, on the gas volume at its end. NULL, or what failed. */
    const char *(*advance)(const GasModel *gas, const Curve *curves, const GasStep *step, double volume,
                           GasState *state);
    /* A step that resolves the model itself from a time on; see gas_time_scale. */
    double (*time_scale)(const GasModel *gas, const Curve *curves, const GasState *state, double time);
    /* Pressure, applied and stiffness from the other quantities of the state at a time. NULL: connections are refused.
     */
    void (*refresh)(const GasModel *gas, const Curve *curves, double time, GasState *state);
    /* Models without a temperature: the pressure if the mass were another one. NULL for the others. */
    double (*pressure)(const GasModel *gas, const Curve *curves, double time, const GasState *state, double mass);
} ChamberModel;

double chamber_pressure(const GasModel *gas, const Curve *curves, double time, const GasState *state, double mass);

extern const ChamberModel chamber_ideal_gas_simple, chamber_ideal_gas_wang_nefske, chamber_ideal_gas_hybrid,
    chamber_ideal_gas_chemkin, chamber_pressure_volume, chamber_adiabatic, chamber_load_curve, chamber_linear_fluid,
    chamber_fluid_and_gas;

/* time_scale of the ideal gas (gas_time_scale.c). */
double ideal_gas_time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time);

/* Any step will do. */
#define CHAMBER_NO_SCALE 1e20

/* Time to the next corner of a curve over time, but not one within rounding of time; at most scale. A curve of -1 has
 * none. shift: the curve is read at time - shift. */
double chamber_next_corner(const Curve *curves, int curve, double time, double shift, double scale);

/* A curve's value, or the constant where there is none. */
static inline double chamber_value(const Curve *curves, int curve, double x, double constant)
{
    return curve >= 0 ? curve_value(&curves[curve], x) : constant;
}

#endif
