/* What opens the exits for good: a pressure, an acceleration, delays (docs/theory.md, section Gas, Exit flow). */
#ifndef BILLOW_GAS_POP_H
#define BILLOW_GAS_POP_H

#include "airbag/gas.h"

/* Whether an acceleration may open the exits. */
bool gas_pops_by_acceleration(const GasModel *gas);

/* At the start. */
void gas_start_pop(const GasModel *gas, GasState *state);

/* Opens the exits at a time if the gauge pressure has reached PPOP (not in a bag that is still flat) and TDP is over,
 * or if the time has come that an acceleration set. */
void gas_check_pop(const GasModel *gas, double time, GasState *state);

/* The acceleration of the rigid body in its local axes acted for dt up to a time. */
void gas_sense_pop(const GasModel *gas, const double acceleration[3], double time, double dt, GasState *state);

#endif
