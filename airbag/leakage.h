/* Leakage through the fabric itself, and vents that are parts of the mesh (docs/theory.md, G47 to G51). */
#ifndef BILLOW_LEAKAGE_H
#define BILLOW_LEAKAGE_H

#include <stdbool.h>

#include "solver/curve.h"

/* Current areas of a bag's parts, by their place in the bag's list [L2]. */
typedef struct GasAreas {
    const double *part;    /* whole area */
    const double *blocked; /* the share of it that contact covers, as an area */
    const double *eroded;  /* what has eroded of it, which is not in part any more; NULL: nothing erodes */
} GasAreas;

typedef enum LeakForm {
    LEAK_FACTORS,    /* X0 = 0: FLC(t) FAC(p) times the current area */
    LEAK_STRETCH,    /* X0 = 1: FLC(area stretch) FAC(pressure ratio) times the initial area */
    LEAK_POLYNOMIAL, /* A0 (X0 + X1 rs + X2 rp + X3 rs rp) */
    LEAK_SEAL,       /* X0 = -1 alone: what the area has grown by */
} LeakForm;

/* One leaking part. Curve members are indices into the model's curves, -1 for none. */
typedef struct GasLeak {
    int place;  /* in the bag's list of parts */
    int option; /* 1 to 8, OPT or FVOPT; even: blocked by contact */
    LeakForm form;
    double coefficient; /* FLC >= 0 */
    int coefficient_curve;
    double factor; /* FAC >= 0 */
    int factor_curve;
    double x[4];         /* X0 to X3 */
    double open;         /* ELA: share of the blocked area that leaks */
    int open_curve;      /* ELA < 0: over time */
    double initial_area; /* A0 */
    bool of_reference;   /* A0REF = 1: A0 is that of the reference geometry */
} GasLeak;

/* One vent that is a part (A23 < 0). */
typedef struct GasHole {
    int place;           /* in the bag's list of parts */
    bool increase;       /* VNTOPT 1, 10: only what its area has grown by counts */
    bool blocked;        /* OPT is even */
    double initial_area; /* A0 */
} GasHole;

/* Open area of a hole. */
double gas_hole_area(const GasHole *hole, const GasAreas *areas);

/* Effective area of a leak at a time, a pressure inside and outside: with the options 1 to 6 an area [L2] (5, 6: times
 * FAC's unit), with 7 and 8 a volume flow [L3/T]. Not below 0. */
double gas_leak_area(const GasLeak *leak, const Curve *curves, const GasAreas *areas, double time, double pressure,
                     double ambient);

#endif
