/* Acceleration of special nodes in contact: what elements and gas do to a node that supports may hold (eq. C13). */
#include "contact/contact_loop.h"
#include "solver/memory.h"

/* Nodes with supports, but not those that follow bodies, edges or partners. */
unsigned char *contact_list_pulled(const Model *m)
{
    unsigned char *pulled = memory_alloc((size_t)(m->moving_count - m->free_count) + 1, 1);
    if (!pulled) return NULL;
    unsigned char *of_node = pulled - m->free_count;
    for (int i = 0; i < m->constraints.support_count; i++) {
        int32_t node = m->constraints.supports[i].node;
        if (node >= m->free_count && node < m->moving_count) of_node[node] = 1;
    }
    for (int b = 0; b < m->rigid_body_count; b++)
        for (int i = 0; i < m->rigid_bodies[b].node_count; i++) {
            int32_t node = m->rigid_bodies[b].node[i];
            if (node >= m->free_count && node < m->moving_count) of_node[node] = 0;
        }
    for (int i = 0; i < m->constraints.hanging_count; i++) {
        int32_t node = m->constraints.hanging[i].node;
        if (node >= m->free_count && node < m->moving_count) of_node[node] = 0;
    }
    for (int i = 0; i < m->seam_count; i++)
        for (int k = 0; k < 2; k++) {
            int32_t node = m->seams[i].node[k];
            if (node >= m->free_count && node < m->moving_count) of_node[node] = 0;
        }
    for (int i = 0; i < m->ties.count; i++)
        for (int k = 0; k < m->ties.ties[i].node_count; k++) {
            int32_t node = m->ties.node[m->ties.ties[i].first_node + k];
            if (node >= m->free_count && node < m->moving_count) of_node[node] = 0;
        }
    return pulled;
}

/* Sum of the forces of elements and gas. */
static void sum_forces(const ContactLoop *loop, int32_t node, double sum[3])
{
    const Model *m = loop->model;
    for (int i = 0; i < 3; i++) sum[i] = 0.0;
    for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++) {
        int32_t row = m->node_row[k];
        if (row >= m->contact_row) break;
        const double *force = loop->rows + ROW_SIZE * (ptrdiff_t)row;
        double pressure = m->row_set[row] >= 0 ? loop->pressure[m->row_set[row]] : 0.0;
        for (int i = 0; i < 3; i++) sum[i] += force[i] + pressure * force[ROW_AREA + i];
    }
}

/* 0 of special nodes but for those that supports alone make special. */
void contact_form_pull(const ContactLoop *loop, int32_t node, double a[3])
{
    const Model *m = loop->model;
    bool special = node >= m->free_count;
    if (special && (node >= m->moving_count || !loop->pulled[node - m->free_count])) {
        a[0] = a[1] = a[2] = 0.0;
        return;
    }
    sum_forces(loop, node, a);
    if (special) {
        RateRows held = {0};
        constraints_held(&m->constraints, node, loop->step.time, &held);
        rate_rows_apply(&held, a);
    }
    for (int i = 0; i < 3; i++) a[i] *= m->inverse_mass[node];
}
