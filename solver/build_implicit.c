/* Which small elements are integrated implicitly, and the factor of their matrix (docs/theory.md, Small elements). */
#include <cholmod.h>
#include <math.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/node_rates.h"

#define LEAST_GAIN 1.5       /* of the step, or it is not worth it */
#define MOST_SHARE 0.1       /* of the elements that may be implicit */
#define THRESHOLD_RATIO 1.25 /* between the squared frequencies from which on elements are tried as implicit */
#define NODE_COST 4.0        /* of a node in the solution, in elements */
#define STRETCH_RESERVE 2.0  /* s of eq. T14: the stretched stiffness that the matrix allows for, to the reference's */

/* What one threshold would bring. */
typedef struct Choice {
    double threshold; /* elements with a larger squared frequency are implicit */
    double rate;      /* squared frequency of the rest, that of the mesh */
    double cost;      /* elements to work through in unit time */
    int elements, nodes;
} Choice;

/* Implicit are laws with constant moduli and one geometry, on nodes that have no conditions or never move. */
static bool may_be_implicit(const Builder *b, int group, int record)
{
    const Model *m = b->model;
    const ShellRecord *r = &b->records[record];
    int geometries = 0;
    if (r->law != LAW_BIOT && r->law != LAW_LOGARITHMIC && r->law != LAW_GREEN) return false;
    if (r->kind == ELEMENT_QUAD_ONE || b->parts[r->part].erosion) return false;
    for (int which = 0; which < GEOMETRY_COUNT; which++)
        geometries += b->constants[group * GEOMETRY_COUNT + which] != NULL;
    for (int a = 0; a < r->corner_count; a++)
        if (r->node[a] >= m->free_count && r->node[a] < m->moving_count) return false;
    return geometries == 1;
}

/* Marks the elements above the threshold, counts them and their nodes that move. */
static void mark_elements(const Builder *b, double threshold, unsigned char *implicit, unsigned char *touched,
                          Choice *choice)
{
    const Model *m = b->model;
    const int32_t *order = b->order;
    *choice = (Choice){.threshold = threshold};
    memset(implicit, 0, (size_t)b->record_count);
    memset(touched, 0, (size_t)m->node_count);
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count) {
        if (m->groups[g].law == LAW_SURFACE) continue;
        for (int place = 0; place < m->groups[g].element_count; place++) {
            const ShellRecord *r = &b->records[order[place]];
            if (!(node_rates_own(b, g, place) > threshold) || !may_be_implicit(b, g, order[place])) continue;
            implicit[order[place]] = 1;
            choice->elements++;
            for (int a = 0; a < r->corner_count; a++) {
                choice->nodes += r->node[a] < m->free_count && !touched[r->node[a]];
                touched[r->node[a]] = 1;
            }
        }
    }
}

/* The threshold that costs least; its elements are marked. rate: the squared frequency with all explicit. */
static Choice choose(const Builder *b, double rate, unsigned char *implicit, unsigned char *touched, NodeRates *rates)
{
    const Model *m = b->model;
    const double all = m->deformable_count;
    Choice none = {.threshold = INFINITY, .rate = rate, .cost = all * sqrt(rate)}, best = none;
    double threshold = 0.0;
    for (int g = 0; g < m->group_count; g++)
        for (int e = 0; m->groups[g].law != LAW_SURFACE && e < m->groups[g].element_count; e++)
            threshold = fmax(threshold, node_rates_own(b, g, e));
    for (; threshold > 0.01 * rate; threshold /= THRESHOLD_RATIO) {
        Choice choice;
        mark_elements(b, threshold / THRESHOLD_RATIO, implicit, touched, &choice);
        if (choice.elements > MOST_SHARE * all) break;
        choice.rate = node_rates_sum(b, implicit, rates);
        choice.cost = (all + NODE_COST * choice.nodes) * sqrt(choice.rate);
        if (choice.elements > 0 && choice.cost < best.cost) best = choice;
    }
    if (sqrt(best.rate) * LEAST_GAIN > sqrt(rate)) best = none;
    mark_elements(b, best.threshold, implicit, touched, &none);
    return best;
}

/* Adds the matrix of one element to the triplets (eq. T14); place: of each node among the unknowns, -1 none. */
static void add_element(const Builder *b, int record, double factor, const int32_t *place, cholmod_triplet *triplets)
{
    const ShellRecord *r = &b->records[record];
    double x[12], k[16];
    ElementInput input = record_input(b, record, b->model->initial, GEOMETRY_REFERENCE, x);
    if (geometry_gradient_stiffness(&input, k)) return; /* build_groups has refused such an element */
    int *row = triplets->i, *column = triplets->j;
    double *value = triplets->x;
    for (int i = 0; i < r->corner_count; i++)
        for (int j = 0; j < r->corner_count; j++) {
            int32_t from = place[r->node[i]], to = place[r->node[j]];
            if (from < 0 || to < 0 || from < to) continue;
            row[triplets->nnz] = from;
            column[triplets->nnz] = to;
            value[triplets->nnz++] = factor * k[r->corner_count * i + j];
        }
}

/* The matrix of eq. T14, its lower half, for elements that are stable by themselves at the step. */
static cholmod_sparse *create_matrix(const Builder *b, double step, const int32_t *place, cholmod_common *common)
{
    const Model *m = b->model;
    const ImplicitElements *s = &m->implicit;
    size_t n = (size_t)s->node_count;
    cholmod_triplet *triplets =
        cholmod_allocate_triplet(n, n, n + 16 * (size_t)s->element_count, -1, CHOLMOD_REAL, common);
    if (!triplets) return NULL;
    for (int node = 0; node < m->free_count; node++) {
        if (place[node] < 0) continue;
        ((int *)triplets->i)[triplets->nnz] = ((int *)triplets->j)[triplets->nnz] = place[node];
        ((double *)triplets->x)[triplets->nnz++] = m->mass[node];
    }
    const int32_t *order = b->order;
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count)
        for (int e = 0; e < m->groups[g].element_count; e++) {
            if (!b->implicit[order[e]]) continue;
            double damping = m->groups[g].material.damping / sqrt(node_rates_own(b, g, e));
            add_element(b, order[e], STRETCH_RESERVE * step * (0.25 * step + damping), place, triplets);
        }
    cholmod_sparse *matrix = cholmod_triplet_to_sparse(triplets, triplets->nnz, common);
    cholmod_free_triplet(&triplets, common);
    return matrix;
}

/* Takes over the factor. */
static int keep_factor(Builder *b, const cholmod_factor *factor, const int32_t *node)
{
    ImplicitElements *s = &b->model->implicit;
    const int *start = factor->p, *count = factor->nz, *row = factor->i, *order = factor->Perm;
    const double *value = factor->x;
    size_t n = (size_t)s->node_count, entries = 0;
    for (size_t j = 0; j < n; j++) entries += (size_t)count[j] - 1;
    s->node = builder_alloc(b, n, sizeof *s->node);
    s->start = builder_alloc(b, n + 1, sizeof *s->start);
    s->row = builder_alloc(b, entries + 1, sizeof *s->row);
    s->entry = builder_alloc(b, entries + 1, sizeof *s->entry);
    s->inverse_pivot = builder_alloc(b, n, sizeof *s->inverse_pivot);
    if (!s->node || !s->start || !s->row || !s->entry || !s->inverse_pivot) return -1;
    int32_t next = 0;
    for (size_t j = 0; j < n; j++) {
        s->node[j] = node[order[j]];
        s->start[j] = next;
        s->inverse_pivot[j] = 1.0 / value[start[j]];
        for (int k = start[j] + 1; k < start[j] + count[j]; k++) {
            s->row[next] = row[k];
            s->entry[next++] = value[k];
        }
    }
    s->start[n] = next;
    return 0;
}

static int factorize(Builder *b, double step, const int32_t *place, const int32_t *node)
{
    cholmod_common common;
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL; /* no BLAS: the same bits everywhere */
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    cholmod_sparse *matrix = create_matrix(b, step, place, &common);
    cholmod_factor *factor = matrix ? cholmod_analyze(matrix, &common) : NULL;
    bool done = factor && cholmod_factorize(matrix, factor, &common) && common.status == CHOLMOD_OK &&
                cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, factor, &common);
    int status = done ? keep_factor(b, factor, node) : -1;
    cholmod_free_sparse(&matrix, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
    return status;
}

/* Numbers the nodes, makes the factor, and gives each element a frequency that keeps the step to it (eq. T16). */
static int make_implicit(Builder *b, const Choice *choice, const unsigned char *touched)
{
    Model *m = b->model;
    int32_t *place = memory_alloc(2 * (size_t)m->node_count + 1, sizeof *place), *node = place + m->node_count;
    if (!place) return -1;
    for (int n = 0; n < m->node_count; n++) {
        place[n] = n < m->free_count && touched[n] ? m->implicit.node_count : -1;
        if (place[n] >= 0) node[m->implicit.node_count++] = n;
    }
    m->implicit.element_count = choice->elements;
    int status = factorize(b, m->step_scale * 2.0 / sqrt(choice->rate), place, node);
    memory_free(place);
    const int32_t *order = b->order;
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count)
        for (int e = 0; e < m->groups[g].element_count; e++)
            if (b->implicit[order[e]])
                node_rates_scale(b, g, e, choice->rate / (STRETCH_RESERVE * node_rates_own(b, g, e)));
    return status;
}

int build_implicit(Builder *b)
{
    const size_t nodes = (size_t)b->model->node_count;
    NodeRates rates = {.mass = memory_alloc(nodes + 1, sizeof(double)),
                       .mass_rate = memory_alloc(nodes + 1, sizeof(double))};
    unsigned char *touched = memory_alloc(nodes + 1, 1);
    b->implicit = memory_alloc((size_t)b->record_count + 1, 1);
    Choice choice = {0};
    int status = rates.mass && rates.mass_rate && touched && b->implicit ? 0 : -1;
    if (!status && !b->options->all_explicit) {
        double rate = node_rates_sum(b, NULL, &rates);
        b->model->implicit.explicit_step = rate > 0.0 ? 2.0 / sqrt(rate) : 0.0;
        choice = choose(b, rate, b->implicit, touched, &rates);
    }
    if (!status) build_node_shares(b, &rates);
    if (!status && choice.elements > 0) status = make_implicit(b, &choice, touched);
    memory_free(rates.mass);
    memory_free(rates.mass_rate);
    memory_free(touched);
    if (status)
        diagnostics_add(b->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory for the model");
    return status;
}
