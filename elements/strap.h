/* Straps of *MAT_SEATBELT: force over engineering strain, along one curve out, along another back (docs/theory.md, K6
 * to K8). */
#ifndef BILLOW_STRAP_H
#define BILLOW_STRAP_H

#include "elements/law_curve.h"

typedef struct Strap {
    LawCurve load;   /* force over strain */
    LawCurve unload; /* count 0: none, the way back is load */
    double yield;    /* strain of the first point of load after the origin; up to it there is no other way back */
} Strap;

/* Force at the strain, peak the largest strain so far; *work receives the work done so far per length without force. */
double strap_force(const Strap *strap, double strain, double peak, double *work);

/* Largest slope of both curves. */
double strap_steepest(const Strap *strap);

/* A strain from which on the way back is less steep than the way out, so that cycles would create energy, or -1. */
double strap_creates_energy(const Strap *strap);

#endif
