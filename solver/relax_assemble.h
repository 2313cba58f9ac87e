/* Forces and stiffness of the static equilibrium summed over the elements: relax_system_assemble (relax_system.h). */
#ifndef BILLOW_RELAX_ASSEMBLE_H
#define BILLOW_RELAX_ASSEMBLE_H

#include "solver/relax_system.h"

/* Stored energy of the elements at x, by group (group_count), hourglass energy apart; links are not counted. */
void relax_stored_energy(const Model *model, const double *x, double *energy);

#endif
