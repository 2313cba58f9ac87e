/* Unknowns, sparsity and factor of the static equilibrium. */
#define _GNU_SOURCE
#include "solver/relax_system.h"

#include <dlfcn.h>
#include <math.h>
#include <string.h>

#include "solver/dense_blas.h"
#include "solver/memory.h"
#include "solver/relax_assemble.h"

/* ---- unknowns ---- */

static void mark_elements(const Model *m, unsigned char *used)
{
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        if (group->law == LAW_SURFACE && group->part < 0) continue;
        for (int i = 0; i < group->block_count * group->corner_count * BILLOW_LANES; i++) used[group->node[i]] = 1;
    }
    for (int i = 0; i < m->link_count; i++)
        for (int end = 0; end < 2; end++)
            if (m->links[i].node[end] >= 0) used[m->links[i].node[end]] = 1;
}

/* Nodes of rigid bodies are held where they are. */
static void clear_rigid(const Model *m, unsigned char *used)
{
    for (int b = 0; b < m->rigid_body_count; b++)
        for (int i = 0; i < m->rigid_bodies[b].node_count; i++) used[m->rigid_bodies[b].node[i]] = 0;
    for (int i = m->moving_count; i < m->node_count; i++) used[i] = 0;
}

static void add_master(RelaxNode *node, int32_t master, double weight)
{
    for (int i = 0; i < node->master_count; i++)
        if (node->master[i] == master) {
            node->weight[i] += weight;
            return;
        }
    node->master[node->master_count] = master;
    node->weight[node->master_count++] = weight;
}

/* Ends that hang themselves are resolved; false if there are too many of them. */
static bool set_hanging(RelaxSystem *s)
{
    const Constraints *c = &s->model->constraints;
    for (int i = 0; i < c->hanging_count; i++) {
        RelaxNode node = {0};
        for (int e = 0; e < 2; e++) {
            const RelaxNode *end = &s->nodes[c->hanging[i].end[e]];
            for (int k = 0; k < end->master_count; k++) {
                if (node.master_count == RELAX_MASTERS) return false;
                add_master(&node, end->master[k], 0.5 * end->weight[k]);
            }
        }
        s->nodes[c->hanging[i].node] = node;
    }
    return true;
}

static void set_unknowns(RelaxSystem *s, const unsigned char *used)
{
    const Model *m = s->model;
    for (int n = 0; n < m->node_count; n++) {
        RelaxNode *node = &s->nodes[n];
        bool hangs = !(node->master_count == 1 && node->master[0] == n);
        node->first = s->unknown_count;
        node->count = 0;
        if (hangs || !used[n]) continue;
        RateRows rows = {0};
        if (n >= m->free_count) constraints_held(&m->constraints, n, s->time, &rows);
        node->count = 3 - rows.count;
        if (rows.count == 0) {
            const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
            memcpy(node->basis, unit, sizeof unit);
        } else if (rows.count < 3) {
            rate_rows_complement(&rows, node->basis);
        }
        s->unknown_count += node->count;
    }
}

static int create_unknowns(RelaxSystem *s)
{
    const Model *m = s->model;
    unsigned char *used = memory_alloc((size_t)m->node_count + 1, 1);
    s->nodes = memory_alloc((size_t)m->node_count + 1, sizeof *s->nodes);
    if (!used || !s->nodes) {
        memory_free(used);
        return -1;
    }
    for (int n = 0; n < m->node_count; n++)
        s->nodes[n] = (RelaxNode){.master = {n}, .weight = {1.0}, .master_count = 1};
    mark_elements(m, used);
    clear_rigid(m, used);
    bool resolved = set_hanging(s);
    set_unknowns(s, used);
    memory_free(used);
    if (!resolved) return -1;
    s->unknown_node = memory_alloc((size_t)s->unknown_count + 1, sizeof *s->unknown_node);
    if (!s->unknown_node) return -1;
    for (int n = 0; n < m->node_count; n++)
        for (int k = 0; k < s->nodes[n].count; k++) s->unknown_node[s->nodes[n].first + k] = n;
    return 0;
}

/* ---- sparsity ---- */

/* Calls work for each pair of nodes with unknowns that share an element, the column first. */
typedef void PairWork(RelaxSystem *s, int column, int row);

static void for_pairs_of(RelaxSystem *s, const int32_t *corner, int stride, int count, PairWork *work)
{
    for (int a = 0; a < count; a++)
        for (int b = 0; b < count; b++) {
            const RelaxNode *from = &s->nodes[corner[a * stride]], *to = &s->nodes[corner[b * stride]];
            for (int i = 0; i < from->master_count; i++)
                for (int j = 0; j < to->master_count; j++) {
                    int column = from->master[i], row = to->master[j];
                    if (row >= column && s->nodes[column].count > 0 && s->nodes[row].count > 0) work(s, column, row);
                }
        }
}

static void for_pairs(RelaxSystem *s, PairWork *work)
{
    const Model *m = s->model;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        for (int b = 0; b < group->block_count; b++)
            for (int l = 0; l < BILLOW_LANES; l++)
                for_pairs_of(s, group->node + (ptrdiff_t)b * group->corner_count * BILLOW_LANES + l, BILLOW_LANES,
                             group->corner_count, work);
    }
    for (int i = 0; i < m->link_count; i++) for_pairs_of(s, m->links[i].node, 1, m->links[i].node[1] < 0 ? 1 : 2, work);
}

static void count_pair(RelaxSystem *s, int column, int row)
{
    (void)row;
    s->block_start[column + 1]++;
}

/* block_start[column] counts up to the end of the column's list; rows are put in once, in order. */
static void put_pair(RelaxSystem *s, int column, int row)
{
    int first = s->block_start[column], count = s->block_row[first];
    int32_t *list = s->block_node + first;
    int place = count;
    while (place > 0 && list[place - 1] > row) place--;
    if (place > 0 && list[place - 1] == row) return;
    memmove(list + place + 1, list + place, (size_t)(count - place) * sizeof *list);
    list[place] = row;
    s->block_row[first]++;
}

/* Closes the gaps that pairs counted twice have left, and numbers the entries. */
static void pack_blocks(RelaxSystem *s)
{
    int node_count = s->model->node_count, to = 0, next = 0;
    for (int n = 0; n < node_count; n++) {
        int from = next, count = s->nodes[n].count > 0 && s->block_start[n + 1] > from ? s->block_row[from] : 0,
            row = 0;
        next = s->block_start[n + 1];
        s->block_start[n] = to;
        for (int i = 0; i < count; i++) {
            s->block_node[to] = s->block_node[from + i];
            s->block_row[to++] = row;
            row += s->nodes[s->block_node[to - 1]].count;
        }
    }
    s->block_start[node_count] = to;
}

static int create_blocks(RelaxSystem *s)
{
    int node_count = s->model->node_count;
    s->block_start = memory_alloc((size_t)node_count + 2, sizeof *s->block_start);
    if (!s->block_start) return -1;
    for_pairs(s, count_pair);
    for (int n = 0; n < node_count; n++) s->block_start[n + 1] += s->block_start[n];
    size_t most = (size_t)s->block_start[node_count] + 1;
    s->block_node = memory_alloc(most, sizeof *s->block_node);
    s->block_row = memory_alloc(most, sizeof *s->block_row);
    if (!s->block_node || !s->block_row) return -1;
    for_pairs(s, put_pair);
    pack_blocks(s);
    return 0;
}

/* Columns of the lower triangle: the diagonal block gives column c its rows from c on. */
static int create_matrix(RelaxSystem *s)
{
    const Model *m = s->model;
    size_t entries = 0, n = (size_t)s->unknown_count;
    for (int node = 0; node < m->node_count; node++) {
        int height = 0, width = s->nodes[node].count;
        for (int b = s->block_start[node]; b < s->block_start[node + 1]; b++)
            height += s->nodes[s->block_node[b]].count;
        entries += (size_t)(width * height - width * (width - 1) / 2);
    }
    cholmod_common *cm = &s->common;
    s->matrix = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_REAL, cm);
    s->right = cholmod_zeros(n, 1, CHOLMOD_REAL, cm);
    if (!s->matrix || !s->right) return -1;
    int *start = s->matrix->p, *row = s->matrix->i, next = 0;
    for (int node = 0; node < m->node_count; node++)
        for (int c = 0; c < s->nodes[node].count; c++) {
            start[s->nodes[node].first + c] = next;
            for (int b = s->block_start[node]; b < s->block_start[node + 1]; b++) {
                const RelaxNode *other = &s->nodes[s->block_node[b]];
                for (int k = s->block_node[b] == node ? c : 0; k < other->count; k++) row[next++] = other->first + k;
            }
        }
    start[n] = next;
    return 0;
}

/* CHOLMOD asks OpenMP for a fixed number of threads, which would wait for each other at every supernode. It gets one
 * when no level of parallel regions may be active. The program itself does not use OpenMP. */
static void forbid_threads(void)
{
    void *symbol = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels");
    void (*set_levels)(int);
    if (!symbol) return;
    memcpy(&set_levels, &symbol, sizeof set_levels);
    set_levels(0);
}

static int analyse(RelaxSystem *s)
{
    cholmod_common *cm = &s->common;
    forbid_threads();
    dense_blas_start();
    cm->supernodal = CHOLMOD_SUPERNODAL;
    cm->final_ll = 1;
    cm->nmethods = 2; /* the better of two orderings; without METIS the other is left */
    cm->method[0].ordering = CHOLMOD_METIS;
    cm->method[1].ordering = CHOLMOD_AMD;
    cm->print = 0;
    cm->quick_return_if_not_posdef = 1;
    s->shifted = cholmod_copy_sparse(s->matrix, cm);
    s->factor = s->shifted ? cholmod_analyze(s->shifted, cm) : NULL;
    return s->factor && cm->status >= 0 ? 0 : -1;
}

int relax_system_create(const Model *model, double time, RelaxSystem *s)
{
    const Model *m = model;
    *s = (RelaxSystem){.model = model, .time = time};
    size_t nodes = 3 * (size_t)m->node_count + 1;
    s->laws = memory_alloc((size_t)m->group_count + 1, sizeof *s->laws);
    s->pressure = memory_alloc((size_t)m->pressure_set_count + 1, sizeof(double));
    s->bag = memory_alloc((size_t)m->airbag_count + 1, sizeof(double));
    s->gravity = memory_alloc(3 * (size_t)m->loads.class_count + 3, sizeof(double));
    s->force = memory_alloc(nodes, sizeof(double));
    s->loads = memory_alloc(nodes, sizeof(double));
    if (!s->laws || !s->pressure || !s->bag || !s->gravity || !s->force || !s->loads) return -1;
    for (int g = 0; g < m->group_count; g++) s->laws[g] = static_law_make(m->groups[g].law, &m->groups[g].material);
    for (int c = 0; c < m->loads.class_count; c++) {
        double damping[3];
        loads_class_at(&m->loads.classes[c], m->curves, time, s->gravity + 3 * c, damping);
    }
    if (create_unknowns(s)) return -1;
    s->scale = memory_alloc((size_t)s->unknown_count + 1, sizeof(double));
    if (!s->scale || create_blocks(s)) return -1;
    cholmod_start(&s->common);
    s->started = true;
    if (s->unknown_count == 0) return 0;
    return create_matrix(s) || analyse(s) ? -1 : 0;
}

void relax_system_free(RelaxSystem *s)
{
    if (s->started) {
        cholmod_free_sparse(&s->matrix, &s->common);
        cholmod_free_sparse(&s->shifted, &s->common);
        cholmod_free_factor(&s->factor, &s->common);
        cholmod_free_dense(&s->right, &s->common);
        cholmod_finish(&s->common);
    }
    void *blocks[] = {s->laws,  s->pressure,    s->bag,        s->gravity,   s->nodes, s->unknown_node,
                      s->scale, s->block_start, s->block_node, s->block_row, s->force, s->loads};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
    *s = (RelaxSystem){0};
}

/* ---- solution ---- */

int relax_system_solve(RelaxSystem *s, double shift, const double *residual, double *step)
{
    cholmod_common *cm = &s->common;
    const int *start = s->matrix->p;
    const double *value = s->matrix->x;
    double *shifted = s->shifted->x;
    memcpy(shifted, value, (size_t)start[s->unknown_count] * sizeof *shifted);
    for (int i = 0; i < s->unknown_count; i++) shifted[start[i]] += shift * s->scale[i];
    if (!cholmod_factorize(s->shifted, s->factor, cm) && cm->status < 0) return -1;
    if (cm->status == CHOLMOD_NOT_POSDEF || s->factor->minor < (size_t)s->unknown_count) return 1;
    return relax_system_backsolve(s, residual, step);
}

int relax_system_backsolve(RelaxSystem *s, const double *residual, double *step)
{
    cholmod_common *cm = &s->common;
    memcpy(s->right->x, residual, (size_t)s->unknown_count * sizeof *residual);
    cholmod_dense *solution = cholmod_solve(CHOLMOD_A, s->factor, s->right, cm);
    if (!solution) return -1;
    memcpy(step, solution->x, (size_t)s->unknown_count * sizeof *step);
    cholmod_free_dense(&solution, cm);
    return 0;
}

void relax_system_move(const RelaxSystem *s, const double *from, double factor, const double *step, double *x)
{
    const Model *m = s->model;
    for (int n = 0; n < m->node_count; n++) {
        const RelaxNode *node = &s->nodes[n];
        double move[3] = {0};
        for (int i = 0; i < node->master_count; i++) {
            const RelaxNode *master = &s->nodes[node->master[i]];
            for (int k = 0; k < master->count; k++)
                for (int j = 0; j < 3; j++)
                    move[j] += node->weight[i] * step[master->first + k] * master->basis[3 * k + j];
        }
        for (int j = 0; j < 3; j++) x[3 * n + j] = from[3 * n + j] + factor * move[j];
    }
}
