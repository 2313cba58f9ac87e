/* *CONSTRAINED_TIED_NODES_FAILURE: nodes at one place become ties; which elements each tie watches. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/memory.h"

#define KEYWORD "*CONSTRAINED_TIED_NODES_FAILURE"

#define REFUSE(b, card, ...) diagnostics_add((b)->diagnostics, SEVERITY_ERROR, (card)->source, KEYWORD, __VA_ARGS__)

/* Nodes lie at one place if they are nearer than this share of the smallest element side there. */
static const double same_place = 1e-3;

/* Smallest side of the deformable shells at each node (node_count), infinite elsewhere. */
static void measure_sides(const Builder *b, double *side)
{
    for (int i = 0; i < b->node_count; i++) side[i] = INFINITY;
    for (int i = 0; i < b->shell_count; i++) {
        const ShellRecord *r = &b->records[i];
        for (int a = 0; a < r->corner_count && r->law != LAW_SURFACE; a++) {
            const int32_t n = r->node[a], next = r->node[(a + 1) % r->corner_count];
            const double *x = b->x + 3 * (ptrdiff_t)n, *y = b->x + 3 * (ptrdiff_t)next;
            const double length =
                sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]));
            side[n] = fmin(side[n], length);
            side[next] = fmin(side[next], length);
        }
    }
}

static bool at_one_place(const Builder *b, const double *side, int32_t one, int32_t other)
{
    const double *x = b->x + 3 * (ptrdiff_t)one, *y = b->x + 3 * (ptrdiff_t)other;
    const double limit = same_place * fmin(side[one], side[other]);
    for (int k = 0; k < 3; k++)
        if (!(fabs(x[k] - y[k]) <= limit)) return false;
    return true;
}

/* What each node is in: 0 nothing, 1 a spotweld, 2 a tie. */
static void mark_welds(const Builder *b, unsigned char *used)
{
    for (int i = 0; i < b->model->seam_count; i++)
        for (int k = 0; k < 2; k++)
            if (b->model->seams[i].node[k] >= 0) used[b->model->seams[i].node[k]] = 1;
}

static void check_node(Builder *b, const TiedNodesDefinition *card, int32_t node, unsigned char *used)
{
    const int id = b->definitions->nodes.items[node].id;
    if (used[node])
        REFUSE(b, card, "node %d is in %s already; a node can be in one seam only", id,
               used[node] == 1 ? "a spotweld" : "another set of tied nodes");
    if (!(b->mass[node] > 0.0))
        REFUSE(b, card, "node %d has no mass; this keyword ties nodes of deformable shells", id);
    used[node] = 2;
}

/* The ties of one card: each group of nodes at one place. table->node has room. */
static void add_card(Builder *b, const TiedNodesDefinition *card, const IndexList *set, const double *side,
                     unsigned char *used, TieTable *table)
{
    int32_t *left = set->items;
    size_t count = set->count, alone = 0;
    const int before = table->count;
    while (count > 0) {
        Tie *tie = &table->ties[table->count];
        *tie = (Tie){.first_node = table->count > 0 ? tie[-1].first_node + tie[-1].node_count : 0,
                     .limit = card->eppf > 0.0 ? card->eppf : INFINITY};
        const int32_t first = left[0];
        size_t rest = 0;
        for (size_t i = 0; i < count; i++) {
            if (i == 0 || at_one_place(b, side, first, left[i]))
                table->node[tie->first_node + tie->node_count++] = left[i];
            else
                left[rest++] = left[i];
        }
        count = rest;
        if (tie->node_count < 2) {
            alone++;
            continue;
        }
        for (int k = 0; k < tie->node_count; k++) check_node(b, card, table->node[tie->first_node + k], used);
        table->count++;
    }
    if (table->count == before)
        REFUSE(b, card, "no two nodes of node set %d lie at one place: there is nothing to tie", card->nsid);
    else if (alone > 0)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, KEYWORD,
                        "%zu nodes of node set %d have no other at their place and are not tied", alone, card->nsid);
}

int build_ties(Builder *b)
{
    const Definitions *d = b->definitions;
    TieTable *table = &b->model->ties;
    if (d->tied_nodes.count == 0) return 0;
    const int errors = b->diagnostics->errors;
    size_t most = 0;
    IndexList *sets = memory_alloc(d->tied_nodes.count, sizeof *sets);
    double *side = memory_alloc((size_t)b->node_count + 1, sizeof *side);
    unsigned char *used = memory_alloc((size_t)b->node_count + 1, 1);
    int status = sets && side && used ? 0 : -1;
    for (size_t i = 0; !status && i < d->tied_nodes.count; i++) {
        const TiedNodesDefinition *card = &d->tied_nodes.items[i];
        sets_resolve_nodes(&b->index, card->nsid, card->source, KEYWORD, &sets[i], b->diagnostics);
        most += sets[i].count;
    }
    if (!status) {
        table->ties = builder_alloc(b, most + 1, sizeof *table->ties);
        table->node = builder_alloc(b, most + 1, sizeof *table->node);
        status = table->ties && table->node ? 0 : -1;
    }
    if (!status) {
        measure_sides(b, side);
        mark_welds(b, used);
        for (size_t i = 0; i < d->tied_nodes.count; i++)
            if (sets[i].count > 0) add_card(b, &d->tied_nodes.items[i], &sets[i], side, used, table);
    }
    for (size_t i = 0; sets && i < d->tied_nodes.count; i++) index_list_free(&sets[i]);
    memory_free(sets);
    memory_free(side);
    memory_free(used);
    return status || b->diagnostics->errors > errors ? -1 : 0;
}

static int tied_node_count(const TieTable *table)
{
    if (table->count == 0) return 0;
    const Tie *last = &table->ties[table->count - 1];
    return last->first_node + last->node_count;
}

void mark_tie_nodes(const Builder *b, unsigned char *special)
{
    for (int i = 0; i < tied_node_count(&b->model->ties); i++) special[b->model->ties.node[i]] = 1;
}

static int compare_slots(const void *one, const void *other)
{
    const int64_t a = *(const int64_t *)one, b = *(const int64_t *)other;
    return (a > b) - (a < b);
}

static int32_t find_slot(const TieTable *table, int64_t slot)
{
    const int64_t *found = bsearch(&slot, table->slot, (size_t)table->slot_count, sizeof slot, compare_slots);
    return (int32_t)(found - table->slot);
}

/* The deformable elements at the ties: table->slot ascending, and the ties' lists of them. tie_of: of each node, -1
 * none. */
static int watch_elements(Builder *b, const int32_t *tie_of)
{
    const Model *m = b->model;
    TieTable *table = &b->model->ties;
    int entries = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int e = 0; e < m->element_count; e++) {
            const int32_t *node = m->element_node + 4 * (ptrdiff_t)e;
            const bool stressed = b->records[e].law != LAW_SURFACE;
            bool listed = false;
            for (int a = 0; stressed && a < 4; a++) {
                const int32_t tie = tie_of[node[a]];
                bool again = tie < 0;
                for (int k = 0; k < a; k++) again |= tie_of[node[k]] == tie;
                if (again) continue;
                Tie *t = &table->ties[tie];
                if (pass == 0) {
                    if (!listed) table->slot[table->slot_count++] = m->element_slot[e];
                    entries++;
                } else {
                    table->watch[t->first_watch + t->watch_count] = find_slot(table, m->element_slot[e]);
                }
                t->watch_count++;
                listed = true;
            }
        }
        if (pass > 0) break;
        qsort(table->slot, (size_t)table->slot_count, sizeof *table->slot, compare_slots);
        table->watch = builder_alloc(b, (size_t)entries + 1, sizeof *table->watch);
        if (!table->watch) return -1;
        for (int i = 0, first = 0; i < table->count; i++) {
            table->ties[i].first_watch = first;
            first += table->ties[i].watch_count;
            table->ties[i].watch_count = 0;
        }
    }
    return 0;
}

/* First watched element of each chunk. */
static int split_by_chunk(Builder *b)
{
    const Model *m = b->model;
    TieTable *table = &b->model->ties;
    table->chunk_slot = builder_alloc(b, (size_t)m->chunk_count + 1, sizeof *table->chunk_slot);
    if (!table->chunk_slot) return -1;
    int next = 0;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        for (int c = 0; c < (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK; c++) {
            table->chunk_slot[group->first_chunk + c] = next;
            const int64_t end = group->first_element + (int64_t)(c + 1) * BILLOW_CHUNK * BILLOW_LANES;
            const int64_t last = group->first_element + (int64_t)group->block_count * BILLOW_LANES;
            while (next < table->slot_count && table->slot[next] < (end < last ? end : last)) next++;
        }
    }
    table->chunk_slot[m->chunk_count] = next;
    return 0;
}

/* Ties cannot share nodes with what else acts on velocities, and their nodes start alike. */
static void check_nodes(Builder *b, const unsigned char *bound)
{
    const Model *m = b->model;
    const TiedNodesDefinition *card = &b->definitions->tied_nodes.items[0];
    for (int i = 0; i < m->ties.count; i++) {
        const int32_t *node = m->ties.node + m->ties.ties[i].first_node;
        for (int k = 0; k < m->ties.ties[i].node_count; k++) {
            if (bound[node[k]])
                REFUSE(b, card,
                       "node %d is also held, driven, hanging or part of a rigid body, which a tie cannot share; leave "
                       "it out of the set",
                       m->node_id[node[k]]);
            for (int c = 0; m->velocity && c < 3; c++)
                if (m->velocity[3 * (ptrdiff_t)node[0] + c] != m->velocity[3 * (ptrdiff_t)node[k] + c]) {
                    REFUSE(b, card, "nodes %d and %d start with different velocities", m->node_id[node[0]],
                           m->node_id[node[k]]);
                    break;
                }
        }
    }
}

int build_tie_nodes(Builder *b)
{
    Model *m = b->model;
    TieTable *table = &m->ties;
    if (table->count == 0) return 0;
    const int errors = b->diagnostics->errors, nodes = tied_node_count(table);
    unsigned char *bound = memory_alloc((size_t)m->node_count + 1, 1);
    int32_t *tie_of = memory_alloc((size_t)m->node_count + 1, sizeof *tie_of);
    table->slot = builder_alloc(b, (size_t)m->element_count + 1, sizeof *table->slot);
    int status = bound && tie_of && table->slot ? 0 : -1;
    if (!status) {
        for (int i = 0; i < nodes; i++) table->node[i] = m->deck_node[table->node[i]];
        for (int i = 0; i < m->node_count; i++) tie_of[i] = -1;
        for (int i = 0; i < table->count; i++)
            for (int k = 0; k < table->ties[i].node_count; k++) tie_of[table->node[table->ties[i].first_node + k]] = i;
        mark_bound_nodes(m, bound);
        check_nodes(b, bound);
        status = watch_elements(b, tie_of) || split_by_chunk(b) ? -1 : 0;
    }
    memory_free(bound);
    memory_free(tie_of);
    if (m->relax.kind != RELAX_NONE)
        REFUSE(b, &b->definitions->tied_nodes.items[0],
               "the phase before the run (--relax, *CONTROL_DYNAMIC_RELAXATION) does not know ties; leave out one of "
               "the two");
    return status || b->diagnostics->errors > errors ? -1 : 0;
}
