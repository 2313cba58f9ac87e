/* Accounts of fabric: chunks of elements that have given back more energy than they got are held to what they get from
 * then on (eq. F7a). */
#include "solver/step_accounts.h"

#include "elements/kernels.h"

/* A chunk is let give so much of its equal part of what the loads have given, so that rounding opens no account. */
static const double LIMIT = 1e-2;

enum { ACCOUNTS_CLOSED, ACCOUNTS_OPENING, ACCOUNTS_OPEN };

void step_accounts_use(const Workspace *w, int chunk, KernelInput *input)
{
    const State *state = w->state;
    if (!w->model->has_accounts || state->accounts_open[chunk] == ACCOUNTS_CLOSED) return;
    input->account = state->account;
    input->open_account = state->accounts_open[chunk] == ACCOUNTS_OPENING;
}

void step_accounts_sum(Workspace *w)
{
    const Model *m = w->model;
    State *state = w->state;
    const double least = -LIMIT * state->energy->largest / m->chunk_count;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        if (!law_keeps_account(group->law, &group->material)) continue;
        const int chunks = (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK;
        for (int c = group->first_chunk; c < group->first_chunk + chunks; c++) {
            state->chunk_energy[c] += w->chunks[c].energy;
            if (state->accounts_open[c] == ACCOUNTS_OPENING)
                state->accounts_open[c] = ACCOUNTS_OPEN;
            else if (state->accounts_open[c] == ACCOUNTS_CLOSED && state->chunk_energy[c] < least)
                state->accounts_open[c] = ACCOUNTS_OPENING;
        }
    }
}
