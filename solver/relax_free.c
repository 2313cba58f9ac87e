/* Free mechanisms: loaded nodes without stiffness, and pieces that nothing holds against their loads. */
#include "solver/relax_free.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/vector3.h"

enum { LISTED = 5 };
#define LEAST_LOAD 1e-9 /* of the loads: rounding of a closed surface's pressure */

static int find_root(int32_t *parent, int node)
{
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
}

static void join(int32_t *parent, int a, int b)
{
    int ra = find_root(parent, a), rb = find_root(parent, b);
    if (ra < rb)
        parent[rb] = ra;
    else
        parent[ra] = rb;
}

static void join_all(const Model *m, int32_t *parent)
{
    for (int n = 0; n < m->node_count; n++) parent[n] = n;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        for (int e = 0; e < group->element_count; e++)
            for (int a = 1; a < group->corner_count; a++) {
                const int32_t *node =
                    group->node + (ptrdiff_t)(e / BILLOW_LANES) * group->corner_count * BILLOW_LANES + e % BILLOW_LANES;
                join(parent, node[0], node[a * BILLOW_LANES]);
            }
    }
    for (int i = 0; i < m->link_count; i++)
        if (m->links[i].node[1] >= 0) join(parent, m->links[i].node[0], m->links[i].node[1]);
    for (int i = 0; i < m->constraints.hanging_count; i++) {
        const HangingNode *hanging = &m->constraints.hanging[i];
        join(parent, hanging->node, hanging->end[0]);
        join(parent, hanging->node, hanging->end[1]);
    }
}

static void list_node(const Model *m, int node, int *listed, char *message, size_t length)
{
    size_t used = strlen(message);
    if (*listed < LISTED)
        snprintf(message + used, length - used, "%s%d", *listed > 0 ? ", " : "", m->node_id[node]);
    else if (*listed == LISTED)
        snprintf(message + used, length - used, " and more");
    (*listed)++;
}

/* Unknowns of no stiffness that a load acts on. */
static int find_loose(const RelaxSystem *s, const double *load, double size, char *message, size_t length)
{
    int listed = 0, last = -1;
    snprintf(message, length, "no static equilibrium: nothing resists the load at node ");
    for (int i = 0; i < s->unknown_count; i++) {
        if (s->scale[i] > 0.0 || !(fabs(load[i]) > LEAST_LOAD * size) || s->unknown_node[i] == last) continue;
        last = s->unknown_node[i];
        list_node(s->model, last, &listed, message, length);
    }
    return listed > 0;
}

/* Sum of the loads on the pieces that are free in some direction. held: bits of the directions x, y, z in which at
 * least one node of the piece does not move freely. */
static int find_drifting(const RelaxSystem *s, int32_t *parent, double *sum, unsigned char *held, double size,
                         char *message, size_t length)
{
    const Model *m = s->model;
    for (int n = 0; n < m->node_count; n++) {
        int root = find_root(parent, n);
        const RelaxNode *node = &s->nodes[n];
        bool hangs = !(node->master_count == 1 && node->master[0] == n);
        if (!hangs && node->count < 3) /* a held direction, or all */
            for (int k = 0; k < 3; k++) {
                double kept = 0.0;
                for (int i = 0; i < node->count; i++) kept += node->basis[3 * i + k] * node->basis[3 * i + k];
                if (kept < 1.0 - 1e-9) held[root] |= (unsigned char)(1u << k);
            }
        for (int k = 0; k < 3; k++) sum[3 * root + k] += s->loads[3 * n + k];
    }
    for (int i = 0; i < m->link_count; i++) /* springs to the ground */
        if (m->links[i].node[1] < 0) held[find_root(parent, m->links[i].node[0])] = 7;
    for (int n = 0; n < m->node_count; n++) {
        if (find_root(parent, n) != n) continue;
        for (int k = 0; k < 3; k++) {
            if (held[n] & 1u << k || !(fabs(sum[3 * n + k]) > LEAST_LOAD * size)) continue;
            int listed = 0;
            snprintf(message, length,
                     "no static equilibrium: a load of %g along %c moves the unsupported piece of node ",
                     sum[3 * n + k], "xyz"[k]);
            for (int i = n; i < m->node_count && listed <= LISTED; i++)
                if (find_root(parent, i) == n) list_node(m, i, &listed, message, length);
            return 1;
        }
    }
    return 0;
}

int relax_find_free(RelaxSystem *s, const double *x, char *message, size_t length)
{
    const Model *m = s->model;
    size_t nodes = (size_t)m->node_count + 1;
    int32_t *parent = memory_alloc(nodes, sizeof *parent);
    double *sum = memory_alloc(3 * nodes, sizeof *sum);
    double *residual = memory_alloc((size_t)s->unknown_count + 1, sizeof *residual), size = 0.0;
    unsigned char *held = memory_alloc(nodes, 1);
    int found = -1;
    if (parent && sum && residual && held && s->unknown_count > 0) {
        relax_system_assemble(s, x, true, residual, &size);
        double total = 0.0; /* of all loads, held nodes' too */
        for (int i = 0; i < 3 * m->node_count; i++) total += s->loads[i] * s->loads[i];
        found = find_loose(s, residual, size, message, length);
        if (!found) {
            join_all(m, parent);
            found = find_drifting(s, parent, sum, held, sqrt(total) + size, message, length);
        }
    } else if (parent && sum && residual && held) {
        found = 0;
    }
    memory_free(parent);
    memory_free(sum);
    memory_free(residual);
    memory_free(held);
    return found;
}
