/* Linear conditions on a velocity: up to three orthonormal directions with prescribed rates. */
#ifndef BILLOW_RATE_ROWS_H
#define BILLOW_RATE_ROWS_H

#include <stdbool.h>

typedef struct RateRows {
    int count;           /* 0..3 */
    double direction[9]; /* orthonormal rows (count x 3) */
    double rate[3];
} RateRows;

/* Adds direction . v = rate (direction need not have length 1). Conditions added earlier go first: false if the
 * direction depends on theirs, and nothing is added. */
bool rate_rows_add(RateRows *rows, const double direction[3], double rate);

/* The nearest velocity that meets all rows. */
void rate_rows_apply(const RateRows *rows, double v[3]);

/* Completes the rows to an orthonormal basis: the 3 - count other directions (rows of others). */
void rate_rows_complement(const RateRows *rows, double others[9]);

#endif
