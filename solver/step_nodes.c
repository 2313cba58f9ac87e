/* The node pass: whole chunks of free nodes with the loops of the chosen instruction set (solver/node_kernels.c). */
#include <string.h>

#include "solver/workspace.h"

void step_nodes(Workspace *w, int thread, int threads)
{
    const NodeKernels *kernels = w->kernels->level == 4   ? &node_kernels_v4
                                 : w->kernels->level == 3 ? &node_kernels_v3
                                                          : &node_kernels_v2;
    int chunks = w->node_chunk_count;
    int first = (int)((int64_t)chunks * thread / threads), end = (int)((int64_t)chunks * (thread + 1) / threads);
    for (int c = first; c < end; c++) {
        int from = c * BILLOW_NODE_CHUNK, to = from + BILLOW_NODE_CHUNK;
        double before[3 * BILLOW_NODE_CHUNK];
        if (to > w->model->free_count) to = w->model->free_count;
        if (w->model->wall_count > 0)
            memcpy(before, w->state->v + 3 * (ptrdiff_t)from, 3 * (size_t)(to - from) * sizeof *before);
        if (w->general)
            kernels->general(w, from, to, &w->node_sums[c]);
        else
            kernels->lean(w, from, to, &w->node_sums[c]);
        if (w->model->wall_count > 0) step_walls_chunk(w, c, from, to, before, &w->node_sums[c]);
    }
}

void step_advance_positions(Workspace *w, int thread, int threads)
{
    int64_t values = 3 * (int64_t)w->model->moving_count;
    int64_t first = values * thread / threads, end = values * (thread + 1) / threads;
    double dt = w->plan.dt_next, *x = w->state->x;
    const double *v = w->state->v;
    for (int64_t i = first; i < end; i++) x[i] += dt * v[i];
}
