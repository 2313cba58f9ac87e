/* GMRES, right preconditioned, for systems that are not symmetric. Saad and Schultz 1986. */
#ifndef BILLOW_GMRES_H
#define BILLOW_GMRES_H

#include <stddef.h>

enum { GMRES_WIDTH = 40 }; /* directions at most */

/* What is solved: out = A v, and out near A^-1 v. Each returns 0, or -1 out of memory. */
typedef struct GmresProblem {
    int count; /* unknowns */
    int (*apply)(void *user, const double *v, double *out);
    int (*precondition)(void *user, const double *v, double *out);
    void *user;
} GmresProblem;

/* Doubles of the workspace. */
#define GMRES_SIZE(count) ((2 * (size_t)GMRES_WIDTH + 1) * (size_t)(count))

/* A x = right, until what is left of it is the share tolerance, or the directions are used up. work: GMRES_SIZE(count)
 * doubles. 0, or -1 out of memory. */
int gmres_solve(const GmresProblem *problem, const double *right, double tolerance, double *work, double *x);

#endif
