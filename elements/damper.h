/* Dampers between two nodes, or a node and the ground: force along the line between them by the rate of its length. */
#ifndef BILLOW_DAMPER_H
#define BILLOW_DAMPER_H

#include <stdint.h>

#include "elements/law_curve.h"

typedef struct Damper {
    int id;   /* user's number of the element */
    int part; /* index into Model.parts */
    int32_t node[2];
    double ground[3];      /* the second end's place where node[1] is -1 [L] */
    double coefficient;    /* force over rate, with a curve its steepest [force T/L] */
    const LawCurve *curve; /* force over rate; NULL: coefficient times the rate. The Model's */
    double inverse[2];     /* 1/m of each end times the dampers that share it, at most; 0: it does not move [1/M] */
} Damper;

/* Pull at this rate of the length (negative: push), K9. */
double damper_tension(const Damper *damper, double rate);

/* Upper bound of the rate at which dampers alone slow down the masses at their ends (K11) [1/T]. */
double damper_rate(const Damper *damper);

#endif
