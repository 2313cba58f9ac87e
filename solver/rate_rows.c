/* Linear conditions on a velocity, made orthonormal one after the other (Gram and Schmidt). */
#include "solver/rate_rows.h"

#include <string.h>

#include "solver/vector3.h"

static const double PARALLEL = 1e-8; /* sine of the angle below which a direction counts as dependent */

bool rate_rows_add(RateRows *rows, const double direction[3], double rate)
{
    if (rows->count == 3) return false;
    double d[3] = {direction[0], direction[1], direction[2]};
    double length = vector3_norm(d);
    /* The second sweep removes what rounding left of the first. */
    for (int sweep = 0; sweep < 2; sweep++) {
        for (int k = 0; k < rows->count; k++) {
            const double *e = rows->direction + 3 * k;
            double part = vector3_dot(d, e);
            for (int i = 0; i < 3; i++) d[i] -= part * e[i];
            rate -= part * rows->rate[k];
        }
    }
    double rest = vector3_norm(d);
    if (!(rest > PARALLEL * length)) return false;
    double *e = rows->direction + 3 * rows->count;
    for (int i = 0; i < 3; i++) e[i] = d[i] / rest;
    rows->rate[rows->count++] = rate / rest;
    return true;
}

void rate_rows_apply(const RateRows *rows, double v[3])
{
    double projected[3] = {v[0], v[1], v[2]};
    for (int k = 0; k < rows->count; k++) {
        const double *e = rows->direction + 3 * k;
        double part = vector3_dot(projected, e);
        for (int i = 0; i < 3; i++) projected[i] -= part * e[i];
    }
    /* Components are removed before rates are added, so that rates along axes are met to the last bit. */
    for (int k = 0; k < rows->count; k++) {
        for (int i = 0; i < 3; i++) projected[i] += rows->rate[k] * rows->direction[3 * k + i];
    }
    memcpy(v, projected, sizeof projected);
}

void rate_rows_complement(const RateRows *rows, double others[9])
{
    static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    RateRows all = *rows;
    for (int found = 0, want = 3 - rows->count; found < want; found++) {
        /* The axis with the largest part outside the rows gives the best conditioned direction. */
        int best = 0;
        double best_rest = -1;
        for (int axis = 0; axis < 3; axis++) {
            double rest = 1;
            for (int k = 0; k < all.count; k++) rest -= all.direction[3 * k + axis] * all.direction[3 * k + axis];
            if (rest > best_rest) best_rest = rest, best = axis;
        }
        rate_rows_add(&all, unit[best], 0);
        memcpy(others + 3 * found, all.direction + 3 * (all.count - 1), 3 * sizeof *others);
    }
}
