/* Newton's method for the static equilibrium (docs/theory.md, Static equilibrium). Private to solver/relax*.c. */
#ifndef BILLOW_RELAX_NEWTON_H
#define BILLOW_RELAX_NEWTON_H

#include "solver/relax_system.h"

typedef struct NewtonOptions {
    double tolerance; /* residual over the size of the loads */
    int iterations;   /* most factorisations */
    FILE *progress;   /* a line for each step, NULL: none */
} NewtonOptions;

typedef struct NewtonResult {
    int steps, factorisations;
    double residual; /* over the size of the loads */
    double shift;    /* of the last step */
    double load;     /* size of the loads; without any, of the stress forces at the start [force] */
    int worst;       /* node of the largest residual, -1 none */
    bool far;        /* a node went further than the model is large */
    bool stopped;    /* the user asked to stop */
} NewtonResult;

/* From x (node_count x 3) to equilibrium, in place. 0; 1: not converged; -1: out of memory. */
int relax_newton(RelaxSystem *system, const NewtonOptions *options, double *x, NewtonResult *result);

#endif
