/* Accounts of fabric whose stress has no stored energy (eq. F7a, F7b). */
#ifndef BILLOW_STEP_ACCOUNTS_H
#define BILLOW_STEP_ACCOUNTS_H

#include "solver/workspace.h"

/* Gives the kernel the accounts of a chunk that has them. */
void step_accounts_use(const Workspace *w, int chunk, KernelInput *input);

/* After the element pass of a cycle, on one thread: the chunks' energies; opens accounts. Model.has_accounts. */
void step_accounts_sum(Workspace *w);

#endif
