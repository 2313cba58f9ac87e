/* What the inflator's jet is made of (docs/theory.md, J1). */
#ifndef BILLOW_GAS_JET_H
#define BILLOW_GAS_JET_H

#include "airbag/gas.h"

typedef struct GasJet {
    double mass_flow;  /* of the last step [M/T] */
    double speed;      /* at the outlet, that of sound in the gas that flows in [L/T] */
    double density;    /* outside [M/L3] */
    double conversion; /* GC: force = mass flow times speed over this */
} GasJet;

/* The jet at a time of the run, after the step that ends there. No flow: mass_flow 0. */
GasJet gas_jet(const GasModel *gas, const Curve *curves, const GasState *state, double time);

#endif
