/* Sums that keep their rounding error, so that mass and energy balance after any number of steps (docs/theory.md, G22).
 */
#ifndef BILLOW_GAS_LEDGER_H
#define BILLOW_GAS_LEDGER_H

#include "airbag/gas.h"

/* Places in GasState.carry. */
enum {
    CARRY_MASS,
    CARRY_ENERGY,
    CARRY_MASS_IN,
    CARRY_MASS_OUT,
    CARRY_ENTHALPY_IN,
    CARRY_ENTHALPY_OUT,
    CARRY_HEAT,
    CARRY_WORK
};

/* sum + carry grows by amount; sum is the nearest double (Neumaier). */
static inline void gas_book(double *sum, double *carry, double amount)
{
    double total = *sum + amount, back = total - *sum;
    double error = (*sum - (total - back)) + (amount - back) + *carry;
    *sum = total + error;
    *carry = error - (*sum - total);
}

/* Puts rest in the place of sum and returns sum + inflow - rest without losing digits where rest is near the sum: what
 * left. */
static inline double gas_settle(double *sum, double *carry, double inflow, double rest)
{
    double total = *sum + inflow, back = total - *sum;
    double error = (*sum - (total - back)) + (inflow - back) + *carry;
    *sum = rest;
    *carry = 0.0;
    return (total - rest) + error;
}

#endif
