/* Parts of a model that nothing holds. Private to solver/relax*.c. */
#ifndef BILLOW_RELAX_FREE_H
#define BILLOW_RELAX_FREE_H

#include "solver/relax_system.h"

/* Nodes under load that have no stiffness, and pieces of the model that nothing holds against the sum of their loads at
 * x. 1 and a message that names them, else 0; -1 without memory. */
int relax_find_free(RelaxSystem *system, const double *x, char *message, size_t length);

#endif
