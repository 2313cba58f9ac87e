/* Equilibrium of laws that have no energy, by the exact tangent (docs/theory.md, Q20 to Q22). Private to
 * solver/relax*.c. */
#ifndef BILLOW_RELAX_EXACT_H
#define BILLOW_RELAX_EXACT_H

#include "solver/relax_newton.h"

/* Does some law of the model have a tangent that is not symmetric? */
bool relax_needs_exact(const RelaxSystem *system);

/* Goes on from x (node_count x 3) with the shift and the counts of result, which receive what becomes of them. size: of
 * the model [L]. 0; 1: not converged; -1: out of memory. */
int relax_exact(RelaxSystem *system, const NewtonOptions *options, double size, double *x, NewtonResult *result);

#endif
