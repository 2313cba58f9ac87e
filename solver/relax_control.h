/* What the phase before the run does: --relax, or IDRFLG of *CONTROL_DYNAMIC_RELAXATION. */
#ifndef BILLOW_RELAX_CONTROL_H
#define BILLOW_RELAX_CONTROL_H

#include "solver/diagnostics.h"

typedef enum RelaxKind {
    RELAX_NONE,
    RELAX_STATIC, /* Newton's method with CHOLMOD: --relax, IDRFLG = 5 */
    RELAX_DYNAMIC /* damped explicit steps: IDRFLG = 1 */
} RelaxKind;

typedef struct RelaxControl {
    RelaxKind kind;
    bool phase_curves; /* loads by the curves with SIDR = 1 or 2, else by those of the run at time 0 */
    double time;       /* at which the curves are read (static), or at which the phase ends (dynamic; 0: no end) [T] */
    double tolerance;  /* residual force over the loads (static), or kinetic energy over its largest (dynamic: DRTOL) */
    int check_cycles;  /* NRCYCK */
    double factor;     /* DRFCTR: velocities are multiplied by it each cycle */
    double step_scale; /* TSSFDR */
    bool automatic;    /* IRELAL = 1: the damping follows the lowest frequency that moves */
    double automatic_tolerance; /* EDTTL: largest change of that frequency from check to check that counts as settled */
    Source source;              /* of the card; none for --relax */
} RelaxControl;

#endif
