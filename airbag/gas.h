/* Gas of one control volume: uniform pressure, mass and energy balance (docs/theory.md, section Gas). */
#ifndef BILLOW_GAS_H
#define BILLOW_GAS_H

#include <stdbool.h>

#include "solver/curve.h"

/* Smallest volume of the gas as a share of A^1.5 (A the surface area at the start): a flat bag has no volume, and the
 * gas in it none to be in. For a bag of 0.77 m2 it is 7 cm3, a gap of a fiftieth of a millimetre. docs/theory.md (G24).
 */
#define BILLOW_GAS_GUARD 1e-5

/* A bag is flat below this share of A^1.5: one that started flatter than the guard is not popped by PPOP before. */
#define BILLOW_GAS_FLAT 1e-3

typedef enum GasKind { GAS_SIMPLE, GAS_WANG_NEFSKE } GasKind;

/* Immutable description; curve members are indices into the model's curves, -1 for none. Units: the deck's.
 * Start from gas_model_reset. Where a constant and a curve are given for the same quantity, a positive constant counts;
 * an exit_flow_curve counts in place of all orifices. */
typedef struct GasModel {
    GasKind kind;
    /* Heat capacities [energy/mass/temperature]: constant cv, cp, or molar cp = a + b T over molar mass w. */
    bool temperature_dependent;
    double cv, cp;
    double a, b, molar_mass, gas_constant;
    double inflow_temperature;  /* T */
    int temperature_curve;      /* LCT, overrides inflow_temperature */
    int temperature_rate_curve; /* LCDT: dT/dt of the inflow over time, added to inflow_temperature; not with LCT */
    int mass_flow_curve;        /* LCID or LCMT with TVOL = 0 */
    int tank_pressure_curve;    /* LCMT with TVOL > 0 */
    double tank_volume;
    double initial_temperature;                                    /* IABT or T_EXT; 0: from PE and RO */
    double ambient_pressure, ambient_density, ambient_temperature; /* PE, RO, T_EXT */
    double gravity_conversion;                                     /* GC */
    /* Exit flow */
    double vent_coefficient, vent_area;                                /* MU, AREA; C23, A23 */
    int vent_coefficient_pressure_curve;                               /* MU < 0: over absolute pressure */
    int vent_area_pressure_curve;                                      /* AREA < 0, LCA23: over absolute pressure */
    int vent_coefficient_time_curve;                                   /* LCC23 > 0 */
    int vent_coefficient_ratio_curve;                                  /* LCC23 < 0: over ambient pressure / pressure */
    double porosity_coefficient, porosity_area;                        /* CP23, AP23 */
    int porosity_coefficient_time_curve, porosity_area_pressure_curve; /* LCCP23, LCAP23 */
    int exit_flow_curve;                                               /* LOU, LCEFR: mass flow over gauge pressure */
    double overpressure;                                               /* POVER: initial gauge pressure */
    double pop_pressure;                                               /* PPOP: gauge pressure that opens the exits */
    double heat_transfer;                                              /* HCONV >= 0 */
    int heat_transfer_curve;                                           /* HCONV < 0: over time */
} GasModel;

/* State of one bag; lives in the State buffer, so plain data only. */
typedef struct GasState {
    double volume;                             /* of the gas: VSCA V - VINI [L3] */
    double area;                               /* surface area without caps [L2] */
    double pressure;                           /* absolute [F/L2] */
    double temperature, density, mass, energy; /* energy: internal, mass integral of cv dT [energy] */
    double mass_flow_in, mass_flow_out, mass_flow_out_vent, mass_flow_out_porosity; /* rates of the last step [M/T] */
    double mass_in, mass_out;                                                       /* cumulated [M] */
    double enthalpy_in, enthalpy_out;                                               /* cumulated [energy] */
    double heat_out, work; /* cumulated; work = integral of p dV done by the gas */
    double cap_work;       /* part of work done on the caps (no rim force) */
    double applied;        /* PSCA (p - ambient): pressure on the walls */
    double opened;         /* 1 once the pop pressure was reached or none is needed */
    double initial_mass, initial_energy;
    double stiffness;                       /* gamma p PSCA VSCA / V: d p / d V, for the stable step */
    double reaction;                        /* jet force, abstat's column */
    double guard;                           /* smallest gas volume [L3] */
    double flat;                            /* 1 as long as a bag that started flat is flat */
    double tank_pressure, tank_temperature; /* of the tank test behind tank_pressure_curve, cp(T) only */
    double inflow_start; /* time that the inflow's curves count from: 0, or when the sensor fires; before, infinity */
    double carry[8];     /* rounding errors of the ledger's sums (gas_ledger.h) */
} GasState;

/* Everything 0, all curves -1, gravity_conversion 1. */
void gas_model_reset(GasModel *gas);

/* What the gas sees of the walls over one step. */
typedef struct GasStep {
    double time, dt; /* from time to time + dt */
    double volume;   /* at time + dt, as the mesh has it (VSCA and VINI not yet applied) [L3] */
    double area;     /* at time + dt [L2] */
} GasStep;

/* Fills state for the initial volume at time 0: SIMPLE and WANG_NEFSKE start from PE, RO (T0 = PE/(RO (cp - cv)))
 * unless IABT/POVER say otherwise. vsca, psca, vini as on card 1. Returns 0, or -1 if the state is impossible (then
 * *why is set to a constant text naming the field). */
int gas_initialize(const GasModel *gas, const Curve *curves, double vsca, double psca, double vini, double volume,
                   double area, GasState *state, const char **why);

/* Advances the gas over one step: exact adiabatic p dV for constant gamma, flows sub-cycled when they are stiff, mass,
 * energy and temperature stay positive for any dt. Returns 0, or -1 on numerical failure (*why set: "negative volume",
 * "temperature not finite", ...); the state is then the one before the step. A volume below state->guard counts as
 * the guard; a negative one is a failure unless the bag is flat (|V| < BILLOW_GAS_FLAT A^1.5). */
int gas_advance(const GasModel *gas, const Curve *curves, double vsca, double psca, double vini, const GasStep *step,
                GasState *state, const char **why);

/* A step that resolves the gas itself (used when no element sets the step): a small share of the times in which the
 * flows fill, empty or cool the bag, and at most up to the next corner of the curves over time. Finite and positive. */
double gas_time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time);

#endif
