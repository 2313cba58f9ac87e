/* Small elements are integrated implicitly: their nodes' accelerations by eq. T14, and the energy of what that adds. */
#include "solver/workspace.h"

void step_implicit(Workspace *w)
{
    const Model *m = w->model;
    const ImplicitElements *s = &m->implicit;
    double *a = w->implicit, *f = a + IMPLICIT_WIDTH * (ptrdiff_t)s->node_count;
    for (int k = 0; k < s->node_count; k++) {
        const int class = m->node_class ? m->node_class[s->node[k]] : 0;
        step_node_force(w, s->node[k], f + 3 * (ptrdiff_t)k);
        for (int i = 0; i < 3; i++) f[3 * k + i] += m->mass[s->node[k]] * w->class_gravity[3 * class + i];
        for (int i = 0; i < 3; i++) a[IMPLICIT_WIDTH * k + i] = f[3 * k + i];
        a[IMPLICIT_WIDTH * k + 3] = 0.0;
    }
    implicit_elements_solve(s, a);
    for (int k = 0; k < s->node_count; k++) {
        double *row = w->rows + ROW_SIZE * (ptrdiff_t)m->node_row[m->node_row_start[s->node[k]]];
        for (int i = 0; i < 3; i++) {
            w->implicit_before[3 * s->node[k] + i] = w->state->v[3 * s->node[k] + i];
            /* the node pass adds the weight and divides by the mass */
            row[i] += m->mass[s->node[k]] * a[IMPLICIT_WIDTH * k + i] - f[3 * k + i];
        }
    }
}

void step_implicit_energy(const Workspace *w, NodeSums *sums)
{
    const Model *m = w->model;
    const ImplicitInertia of =
        implicit_elements_inertia(&m->implicit, m->mass, w->implicit_before, w->state->v); /* v-, v+ */
    const double passed = w->plan.dt_before / (w->plan.dt_before + w->plan.dt_next); /* of the change, by eq. T3 */
    const double left = 1.0 - passed;
    sums->kinetic += 0.5 * (left * left * of.uu + 2.0 * passed * left * of.uw + passed * passed * of.ww);
    sums->kinetic_steps += 0.5 * of.uw;
}
