/* Gas of one control volume: uniform pressure, mass and energy balance (docs/theory.md, section Gas). */
#ifndef BILLOW_GAS_H
#define BILLOW_GAS_H

#include <stdbool.h>

#include "airbag/leakage.h"
#include "airbag/species.h"
#include "solver/curve.h"

/* Smallest volume of the gas as a share of A^1.5 (A the surface area at the start): a flat bag has no volume, and the
 * gas in it none to be in. For a bag of 0.77 m2 it is 7 cm3, a gap of a fiftieth of a millimetre. docs/theory.md (G24).
 */
#define BILLOW_GAS_GUARD 1e-5

/* A bag is flat below this share of A^1.5: one that started flatter than the guard is not popped by PPOP before. */
#define BILLOW_GAS_FLAT 1e-3

typedef enum GasKind {
    GAS_SIMPLE,
    GAS_WANG_NEFSKE,
    GAS_HYBRID, /* mixtures */
    GAS_CHEMKIN,
    GAS_PRESSURE_VOLUME, /* the laws from here on have a pressure, but no temperature */
    GAS_ADIABATIC,
    GAS_LOAD_CURVE,
    GAS_LINEAR_FLUID,
    GAS_FLUID_AND_GAS,
    GAS_KIND_COUNT
} GasKind;

/* How one gas of a mixture comes into the bag; curves over time. */
typedef struct GasSource {
    double initial_fraction; /* by mass, at the start; all sum to 1 */
    int mass_flow_curve;     /* LCIDM: its mass flow, unless the mixture has a total one */
    int temperature_curve;   /* LCIDT */
    double mole_fraction;    /* FMOLE: of the total inflow */
    int mole_fraction_curve; /* LCIDN, or LCIDM with LCIDM0: in place of it */
    double aspirated;        /* FMASS: mass of ambient gas that each mass of this one draws in */
} GasSource;

/* Card 6 of *AIRBAG_WANG_NEFSKE: a rigid chamber that burning propellant fills and an orifice empties into the bag. */
typedef struct InflatorChamber {
    double coefficient, area; /* IOC, IOA */
    double volume;            /* IVOL; 0: there is no inflator */
    double density;           /* IRO: times IVOL the mass that the whole burn releases */
    double temperature;       /* IT: of the gas released */
    int burn_curve;           /* LCBF: share burnt over time */
} InflatorChamber;

/* What opens the exits besides PPOP, and the delays (option POP). */
typedef struct PopCriterion {
    double delay;              /* TDP: after the pressure was reached */
    double acceleration[3];    /* AXP, AYP, AZP in the local axes of a rigid body; 0: inactive */
    double magnitude;          /* AMAGP; 0: inactive */
    double duration;           /* TDURP: cumulated time beyond one of them */
    double acceleration_delay; /* TDA: after that */
} PopCriterion;

/* *AIRBAG_SIMPLE_PRESSURE_VOLUME: factor coefficient / relative volume, or a curve over the relative volume. */
typedef struct PressureVolumeLaw {
    double coefficient, factor; /* CN >= 0, BETA */
    int coefficient_curve;      /* CN < 0: over time */
    int relative_curve;         /* LCID: in place of both */
} PressureVolumeLaw;

/* *AIRBAG_ADIABATIC_GAS_MODEL; PE, P0 and R0 are the model's ambient_pressure, overpressure and density. */
typedef struct AdiabaticLaw {
    double factor, gamma; /* PSF, GAMMA */
    int preload_curve;    /* LCID: P0 is held until its first value that is not zero */
} AdiabaticLaw;

/* *AIRBAG_LOAD_CURVE; PE, P0 and R0 as above. */
typedef struct LoadCurveLaw {
    double start_time;        /* STIME */
    int pressure_curve;       /* LCID: pressure over time since start_time; -1: C rho (T - T0) */
    double temperature, zero; /* T, T0 */
} LoadCurveLaw;

/* *AIRBAG_LINEAR_FLUID; RO is the model's density. */
typedef struct LinearFluidLaw {
    double bulk;                     /* BULK */
    int bulk_curve;                  /* LCBULK: over time, in place of it */
    int inflow_curve, outflow_curve; /* LCINT, LCOUTT: mass flow over time */
    int outflow_pressure_curve;      /* LCOUTP: mass flow over pressure */
    int added_pressure_curve;        /* LFIT: over time */
    int pressure_curve;              /* LCID: pressure over time in place of all that */
    double limit;                    /* P_LIMIT, 0: none */
    int limit_curve;                 /* P_LIMLC: over time, in place of it */
} LinearFluidLaw;

/* *AIRBAG_FLUID_AND_GAS; RHO is the model's density. */
typedef struct FluidAndGasLaw {
    int axis;                                      /* |GDIR| - 1 */
    double up;                                     /* +1 if gravity acts along the negative axis, else -1 */
    double initial_level, level_step, final_level; /* XWINI, XWADD, XW: coordinates on the axis */
    int level_curve;                               /* LCXW: over time, in place of them */
    double pressure, end_time;                     /* P, TEND */
    int pressure_curve;                            /* LCP: over time, in place of them */
    double kappa, bulk;                            /* KAPPA, KBM */
    int gravity_curve;                             /* of *LOAD_BODY along the axis, -1 none */
    double gravity;                                /* its factor */
} FluidAndGasLaw;

/* Immutable description; curve members are indices into the model's curves, -1 for none. Units: the deck's.
 * Start from gas_model_reset. Where a constant and a curve are given for the same quantity, a positive constant counts;
 * an exit_flow_curve counts in place of all orifices. */
typedef struct GasModel {
    GasKind kind;
    /* Heat capacities [energy/mass/temperature]: constant cv, cp, or molar cp = a + b T over molar mass w. */
    bool temperature_dependent;
    double cv, cp;
    double a, b, molar_mass, gas_constant;
    int species_count; /* of a mixture; 0: one gas by the capacities above */
    const GasSpecies *species;
    const GasSource *sources;
    bool total_inflow;          /* mass_flow_curve is the whole mixture's, shared out by mole fractions */
    double inflow_temperature;  /* T */
    int temperature_curve;      /* LCT, overrides inflow_temperature */
    int temperature_rate_curve; /* LCDT: dT/dt of the inflow over time, added to inflow_temperature; not with LCT */
    int mass_flow_curve;        /* LCID or LCMT with TVOL = 0 */
    int tank_pressure_curve;    /* LCMT with TVOL > 0 */
    double tank_volume;
    InflatorChamber inflator;
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
    int hole_count, leak_count;
    bool vents_eroded; /* VNTOPT 2, 10: what erodes of the surface's parts (surface_parts) is a vent */
    int surface_parts;
    GasHole *holes;      /* A23 < 0: vents that are parts (hole_count) */
    GasLeak *leaks;      /* OPT > 0: leaking parts (leak_count) */
    int exit_flow_curve; /* LOU, LCEFR: mass flow over gauge pressure */
    double overpressure; /* POVER: initial gauge pressure */
    double pop_pressure; /* PPOP: gauge pressure that opens the exits */
    PopCriterion pop;
    double heat_transfer;    /* HCONV >= 0 */
    int heat_transfer_curve; /* HCONV < 0: over time */
    /* Laws without a temperature */
    double density; /* R0, RO of what fills the bag at the start */
    PressureVolumeLaw pressure_volume;
    AdiabaticLaw adiabatic;
    LoadCurveLaw load_curve;
    LinearFluidLaw fluid;
    FluidAndGasLaw fluid_and_gas;
} GasModel;

/* State of one bag; lives in the State buffer, so plain data only. */
typedef struct GasState {
    double volume;                             /* of the gas: VSCA V - VINI [L3] */
    double area;                               /* surface area without caps [L2] */
    double pressure;                           /* absolute [F/L2] */
    double temperature, density, mass, energy; /* energy: internal, mass integral of cv dT [energy] */
    double mass_flow_in, mass_flow_out, mass_flow_out_vent, mass_flow_out_porosity; /* rates of the last step [M/T] */
    double mass_flow_inflator;        /* of the last step, what the inflator alone blew in: the jet's [M/T] */
    double mass_in, mass_out;         /* cumulated [M] */
    double counted_in, counted_out;   /* the part of them that the rates have told */
    double enthalpy_in, enthalpy_out; /* cumulated [energy] */
    double heat_out, work;            /* cumulated; work = integral of p dV done by the gas */
    double cap_work;                  /* part of work done on the caps (no rim force) */
    double applied;                   /* PSCA (p - ambient): pressure on the walls */
    double opened;         /* 1 once the pop pressure was reached or none is needed; of GAS_ADIABATIC: preload over */
    double initial_volume; /* of the gas */
    double species[BILLOW_GAS_SPECIES]; /* masses of a mixture's gases [M] */
    double initial_mass, initial_energy;
    double stiffness;                       /* PSCA VSCA times -dp/dV of the gas, for the stable step */
    double reaction;                        /* jet force, abstat's column */
    double guard;                           /* smallest gas volume [L3] */
    double flat;                            /* 1 as long as a bag that started flat is flat */
    double tank_pressure, tank_temperature; /* of the tank test behind tank_pressure_curve, cp(T) only */
    double inflator_mass, inflator_energy;  /* in the inflator's chamber */
    double open_time;                       /* at which the exits open; 1e300: nothing has tripped them yet */
    double pop_time;                        /* cumulated beyond the acceleration that opens the exits */
    double fluid_level, fluid_volume;       /* GAS_FLUID_AND_GAS: coordinate on its axis [L]; times VSCA [L3] */
    double inflow_start; /* time that the inflow's curves count from: 0, or when the sensor fires; before, infinity */
    double carry[8];     /* rounding errors of the ledger's sums (gas_ledger.h) */
} GasState;

/* The keyword without *AIRBAG_. */
const char *gas_name(GasKind kind);

/* Everything 0, all curves -1, factors of pressure and volume 1. */
void gas_model_reset(GasModel *gas);

/* What the gas sees of the walls over one step. */
typedef struct GasStep {
    double time, dt;     /* from time to time + dt */
    double volume;       /* at time + dt, as the mesh has it (VSCA and VINI not yet applied) [L3] */
    double area;         /* at time + dt [L2] */
    double fluid_volume; /* GAS_FLUID_AND_GAS: below the level, times VSCA [L3] */
    GasAreas areas;      /* of the bag's parts at time + dt, for holes and leaks */
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

/* A bag of a law without inflow (GAS_PRESSURE_VOLUME and on) whose sensor has not fired: it has no pressure. */
bool gas_asleep(const GasModel *gas, const GasState *state);

/* Puts such a bag to sleep at the start; the others keep their state. */
void gas_sleep(const GasModel *gas, GasState *state);

/* Begins it at a time on the volume that it has; its curves over time count from there. Of others, the inflow. */
void gas_wake(const GasModel *gas, const Curve *curves, double vsca, double psca, double time, GasState *state);

/* FLUID_AND_GAS while it is filled: sets the level that the card prescribes at a time (step: one more XWADD). False
 * once the fluid's volume is what is kept, and for all other models. */
bool gas_fluid_level(const GasModel *gas, const Curve *curves, double time, bool step, GasState *state);

struct GasSide; /* airbag/connection.h */

/* Pressure, temperature and what the walls feel, after mass and energy were changed from outside (connection.h). */
void gas_refresh(struct GasSide *side, const Curve *curves, double time);

/* Whether bags of a kind may be connected. */
bool gas_connects(GasKind kind);

/* A step that resolves the gas itself (used when no element sets the step): a small share of the times in which the
 * flows fill, empty or cool the bag, and at most up to the next corner of the curves over time. Finite and positive. */
double gas_time_scale(const GasModel *gas, const Curve *curves, const GasState *state, double time);

#endif
