/* The gas of a nearly empty bag is far stiffer than its walls: its pressure is then taken at the mean volume of the
 * step, which bounds the frequency of the breathing mode for any step (docs/theory.md, Time integration, eq. T9 to
 * T11).
 *
 * With k = -dp/dV, s the area vectors and M the masses, (M + b dt^2 k s s^T) a = f, b = 1/4, is solved by one scalar:
 * a = M^-1 (f + dp s), dp = -b dt^2 k (s.M^-1 f) / (1 + b dt^2 k s.M^-1 s). At rest dp = 0. */
#include "solver/workspace.h"

/* Adds one node's share to every bag that presses on it. */
static void add_node(const Workspace *w, int node, GasPass *bags)
{
    const Model *m = w->model;
    double f[3] = {0}, inverse = m->inverse_mass[node];
    for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++) {
        const double *force = w->rows + ROW_SIZE * (ptrdiff_t)m->node_row[k], *share = force + ROW_AREA;
        int set = m->row_set[m->node_row[k]];
        double pressure = set < 0 ? 0.0 : w->bag_pressure[set] + w->load_pressure[set];
        if (m->has_fluid && set >= 0) pressure += step_hydrostatic(w, set, w->state->x + 3 * (ptrdiff_t)node);
        for (int i = 0; i < 3; i++) f[i] += force[i] + pressure * share[i];
    }
    for (int b = 0; b < m->airbag_count; b++) {
        double s[3] = {0};
        for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++) {
            int row = m->node_row[k];
            if (m->row_set[row] < 0) continue;
            const PressureSet *set = &m->pressure_sets[m->row_set[row]];
            const double *share = w->rows + ROW_SIZE * (ptrdiff_t)row + ROW_AREA;
            for (int j = 0; j < set->count; j++)
                for (int i = 0; set->source[j] == b && i < 3; i++) s[i] += set->push[j] * share[i];
        }
        bags[b].compliance += (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) * inverse;
        bags[b].opening += (s[0] * f[0] + s[1] * f[1] + s[2] * f[2]) * inverse;
    }
}

static void add_range(const Workspace *w, int from, int to, GasPass *bags)
{
    for (int b = 0; b < w->model->airbag_count; b++) bags[b] = (GasPass){0};
    for (int node = from; node < to; node++) add_node(w, node, bags);
}

void step_gas_pass(Workspace *w, int thread, int threads)
{
    const Model *m = w->model;
    int chunks = w->node_chunk_count;
    int first = (int)((int64_t)chunks * thread / threads), end = (int)((int64_t)chunks * (thread + 1) / threads);
    for (int c = first; c < end; c++) {
        int from = c * BILLOW_NODE_CHUNK, to = from + BILLOW_NODE_CHUNK;
        add_range(w, from, to < m->free_count ? to : m->free_count, w->gas_pass + (ptrdiff_t)c * m->airbag_count);
    }
    if (thread == 0) add_range(w, m->free_count, m->moving_count, w->gas_pass + (ptrdiff_t)chunks * m->airbag_count);
}

void step_gas_implicit(Workspace *w)
{
    const Model *m = w->model;
    double step = w->plan.dt_next;
    for (int b = 0; b < m->airbag_count; b++) {
        GasPass sum = {0};
        for (int c = 0; c <= w->node_chunk_count; c++) {
            const GasPass *pass = &w->gas_pass[(ptrdiff_t)c * m->airbag_count + b];
            sum.compliance += pass->compliance;
            sum.opening += pass->opening;
        }
        double stiffness = 0.25 * step * step * w->state->gas[b].stiffness;
        double change = -stiffness * sum.opening / (1.0 + stiffness * sum.compliance);
        for (int s = 0; s < m->pressure_set_count; s++) {
            const PressureSet *set = &m->pressure_sets[s];
            for (int j = 0; j < set->count; j++)
                if (set->source[j] == b) w->bag_pressure[s] += set->push[j] * change;
        }
    }
}
