/* Ties: nodes at one place that move as one until the fabric around them is stretched too far. */
#include "solver/step_ties.h"

#include "elements/lane.h"
#include "elements/tear.h"

void step_ties_watch(Workspace *w, int number, int chunk)
{
    const TieTable *t = &w->model->ties;
    const ElementGroup *group = &w->reference.groups[number];
    for (int i = t->chunk_slot[chunk]; i < t->chunk_slot[chunk + 1]; i++) {
        const int64_t place = t->slot[i] - group->first_element;
        w->tie_strain[i] =
            tear_mean_strain(group, group->geometry + lane_offset(group, place), w->state->x, place, &w->tie_volume[i]);
    }
}

/* Mean effective strain of the elements around a tie by their volumes (eq. X6). */
static double strain_around(const Workspace *w, const Tie *tie)
{
    double sum = 0.0, volume = 0.0;
    for (int k = 0; k < tie->watch_count; k++) {
        const int i = w->model->ties.watch[tie->first_watch + k];
        sum += w->tie_volume[i] * w->tie_strain[i];
        volume += w->tie_volume[i];
    }
    return volume > 0.0 ? sum / volume : 0.0;
}

/* The velocity that keeps the momentum of all (eq. X7). */
static void join(const Model *m, const Tie *tie, double *v)
{
    const int32_t *node = m->ties.node + tie->first_node;
    double mass = 0.0, momentum[3] = {0};
    for (int k = 0; k < tie->node_count; k++) {
        mass += m->mass[node[k]];
        for (int c = 0; c < 3; c++) momentum[c] += m->mass[node[k]] * v[3 * (ptrdiff_t)node[k] + c];
    }
    for (int k = 0; k < tie->node_count; k++)
        for (int c = 0; c < 3; c++) v[3 * (ptrdiff_t)node[k] + c] = momentum[c] / mass;
}

void step_ties_act(Workspace *w)
{
    const TieTable *t = &w->model->ties;
    for (int i = 0; i < t->count; i++) {
        if (w->state->tie_broken[i] >= 0.0) continue;
        if (strain_around(w, &t->ties[i]) > t->ties[i].limit)
            w->state->tie_broken[i] = w->state->clock->time;
        else
            join(w->model, &t->ties[i], w->state->v);
    }
}
