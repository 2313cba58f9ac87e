/* Numbering for locality: nodes by compact patches inside their class, elements by their nodes inside their group. */
#include <stdlib.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/memory.h"

/* Records at each node, CSR. */
typedef struct Adjacency {
    int32_t *start, *record;
} Adjacency;

static int build_adjacency(const Builder *b, Adjacency *a)
{
    size_t nodes = (size_t)b->node_count;
    a->start = memory_alloc(nodes + 2, sizeof *a->start);
    a->record = memory_alloc((size_t)b->record_count * 4 + 1, sizeof *a->record);
    if (!a->start || !a->record) return -1;
    for (int i = 0; i < b->record_count; i++)
        for (int c = 0; c < b->records[i].corner_count; c++) a->start[b->records[i].node[c] + 2]++;
    for (size_t n = 0; n < nodes; n++) a->start[n + 2] += a->start[n + 1];
    for (int i = 0; i < b->record_count; i++)
        for (int c = 0; c < b->records[i].corner_count; c++) a->record[a->start[b->records[i].node[c] + 1]++] = i;
    return 0;
}

/* Appends the nodes with the label inside that are reached from seed to queue, level by level, and gives them the label
 * reached; returns the last, the farthest. */
static int32_t walk_levels(const Builder *b, const Adjacency *a, int32_t seed, int32_t *label, int32_t inside,
                           int32_t reached, int32_t *queue, int *count)
{
    int head = *count;
    queue[(*count)++] = seed;
    label[seed] = reached;
    while (head < *count) {
        int32_t node = queue[head++];
        for (int32_t k = a->start[node]; k < a->start[node + 1]; k++) {
            const ShellRecord *record = &b->records[a->record[k]];
            for (int c = 0; c < record->corner_count; c++) {
                int32_t next = record->node[c];
                if (label[next] != inside) continue;
                label[next] = reached;
                queue[(*count)++] = next;
            }
        }
    }
    return queue[*count - 1];
}

/* Sorts the nodes queue[first .. end) by breadth-first levels, every component from one of its ends. *label: the last
 * label in use. */
static void sort_levels(const Builder *b, const Adjacency *a, int32_t *queue, int32_t *nodes, int first, int end,
                        int32_t *labels, int32_t *label)
{
    int32_t inside = ++*label, seen = ++*label, done = ++*label;
    int count = first;
    memcpy(nodes, queue + first, (size_t)(end - first) * sizeof *nodes);
    for (int i = 0; i < end - first; i++) labels[nodes[i]] = inside;
    for (int i = 0; i < end - first; i++) {
        if (labels[nodes[i]] != inside) continue;
        int start = count;
        int32_t far = walk_levels(b, a, nodes[i], labels, inside, seen, queue, &count);
        count = start;
        walk_levels(b, a, far, labels, seen, done, queue, &count);
    }
}

enum { PATCH_NODES = 64 }; /* patches of this size are not cut further */

/* position[node]: place of each node in an order of compact patches: levels, each half by levels of its own, and so on.
 * Segments of elements then share few nodes with others. */
static int patch_order(const Builder *b, const Adjacency *a, int32_t *position)
{
    size_t nodes = (size_t)b->node_count + 1;
    int32_t *labels = memory_alloc(nodes, sizeof *labels), *queue = memory_alloc(nodes, sizeof *queue),
            *scratch = memory_alloc(nodes, sizeof *scratch), label = 0;
    int status = labels && queue && scratch ? 0 : -1;
    for (int i = 0; !status && i < b->node_count; i++) queue[i] = i;
    /* pieces of count / parts nodes, parts = 1, 2, 4 ... */
    for (int64_t parts = 1; !status && b->node_count / parts > PATCH_NODES; parts *= 2)
        for (int64_t part = 0; part < parts; part++)
            sort_levels(b, a, queue, scratch, (int)(b->node_count * part / parts),
                        (int)(b->node_count * (part + 1) / parts), labels, &label);
    for (int i = 0; !status && i < b->node_count; i++) position[queue[i]] = i;
    memory_free(labels);
    memory_free(queue);
    memory_free(scratch);
    return status;
}

enum { CLASS_FREE, CLASS_SPECIAL, CLASS_FIXED };

/* Class of each node: special where the lean loop does not do, fixed where nothing moves. */
static void classify_nodes(Builder *b, const Adjacency *a, unsigned char *class)
{
    motion_mark_special(&b->motion, class);
    mark_link_nodes(b, class);
    mark_jet_nodes(b, class);
    mark_seam_nodes(b, class);
    mark_tie_nodes(b, class);
    for (int i = 0; b->options->caps_push_rim && i < b->model->airbag_count; i++)
        for (int k = 0; k < b->closures[i].cap_count; k++)
            for (int c = 0; c < b->closures[i].caps[k].count; c++)
                class[b->closures[i].caps[k].node[c]] = CLASS_SPECIAL;
    for (int n = 0; n < b->node_count; n++) {
        int first = a->start[n], last = a->start[n + 1];
        for (int k = first + 1; k < last; k++)
            if (b->records[a->record[k]].pressure_set != b->records[a->record[first]].pressure_set)
                class[n] = CLASS_SPECIAL;
        if (!(b->mass[n] > 0.0) && class[n] == CLASS_FREE) class[n] = CLASS_FIXED; /* nothing to accelerate */
        if (b->motion.fixed && b->motion.fixed[n]) class[n] = CLASS_FIXED;
    }
}

typedef struct NodeKey {
    int class;
    int32_t position, node;
} NodeKey;

static int compare_node_keys(const void *left, const void *right)
{
    const NodeKey *a = left, *b = right;
    if (a->class != b->class) return a->class - b->class;
    return (a->position > b->position) - (a->position < b->position);
}

typedef struct ElementKey {
    int surface, part, kind, set, reference; /* group; laws with stress first */
    int32_t position, record;
} ElementKey;

static int compare_element_keys(const void *left, const void *right)
{
    const ElementKey *a = left, *b = right;
    if (a->surface != b->surface) return a->surface - b->surface;
    if (a->part != b->part) return a->part - b->part;
    if (a->kind != b->kind) return a->kind - b->kind;
    if (a->set != b->set) return a->set - b->set;
    if (a->reference != b->reference) return a->reference - b->reference;
    if (a->position != b->position) return (a->position > b->position) - (a->position < b->position);
    return (a->record > b->record) - (a->record < b->record);
}

static int order_elements(Builder *b, const int32_t *position)
{
    ElementKey *keys = memory_alloc((size_t)b->record_count + 1, sizeof *keys);
    b->order = memory_alloc((size_t)b->record_count + 1, sizeof *b->order);
    if (!keys || !b->order) {
        memory_free(keys);
        return -1;
    }
    for (int i = 0; i < b->record_count; i++) {
        const ShellRecord *r = &b->records[i];
        int32_t least = position[r->node[0]];
        for (int c = 1; c < r->corner_count; c++) least = position[r->node[c]] < least ? position[r->node[c]] : least;
        keys[i] = (ElementKey){r->law == LAW_SURFACE, r->part, (int)r->kind, r->pressure_set, r->reference, least, i};
    }
    qsort(keys, (size_t)b->record_count, sizeof *keys, compare_element_keys);
    for (int i = 0; i < b->record_count; i++) b->order[i] = keys[i].record;
    memory_free(keys);
    return 0;
}

/* Applies new_index[deck node] to records, closures, bags and history nodes. */
static void renumber_lists(Builder *b, const int32_t *new_index)
{
    Model *m = b->model;
    for (int i = 0; i < b->record_count; i++)
        for (int c = 0; c < 4; c++) b->records[i].node[c] = new_index[b->records[i].node[c]];
    for (int i = 0; i < m->solid_count; i++)
        for (int a = 0; a < 8; a++) m->solids[i].node[a] = new_index[m->solids[i].node[a]];
    for (int i = 0; i < m->point_mass_count; i++) m->point_masses[i].node = new_index[m->point_masses[i].node];
    renumber_links(b, new_index);
    for (int i = 0; i < m->airbag_count; i++) {
        for (int k = 0; k < m->airbags[i].node_count; k++) m->airbags[i].node[k] = new_index[m->airbags[i].node[k]];
        for (int k = 0; k < b->closures[i].cap_count; k++) {
            SurfaceCap *cap = &b->closures[i].caps[k];
            for (int c = 0; c < cap->count; c++) {
                cap->fixed_count += b->motion.fixed && b->motion.fixed[cap->node[c]];
                cap->node[c] = new_index[cap->node[c]];
            }
        }
    }
    for (int i = 0; i < m->output.history_count; i++) m->output.history_node[i] = new_index[m->output.history_node[i]];
}

/* Node arrays of the model in the new order. */
static int fill_nodes(Builder *b, const NodeKey *keys)
{
    Model *m = b->model;
    size_t n = (size_t)b->node_count;
    bool moves = false;
    m->node_count = b->node_count;
    m->node_id = builder_alloc(b, n, sizeof *m->node_id);
    m->deck_node = builder_alloc(b, n, sizeof *m->deck_node);
    m->initial = builder_alloc(b, 3 * n, sizeof *m->initial);
    for (size_t i = 0; i < 3 * n && !moves; i++) moves = b->motion.velocity[i] != 0.0;
    m->velocity = moves ? builder_alloc(b, 3 * n, sizeof *m->velocity) : NULL;
    m->mass = builder_alloc(b, n, sizeof *m->mass);
    m->inverse_mass = builder_alloc(b, n, sizeof *m->inverse_mass);
    if (!m->node_id || !m->deck_node || !m->initial || (moves && !m->velocity) || !m->mass || !m->inverse_mass)
        return -1;
    for (size_t i = 0; i < n; i++) {
        size_t old = (size_t)keys[i].node;
        m->node_id[i] = b->definitions->nodes.items[old].id;
        m->deck_node[old] = (int)i;
        m->mass[i] = b->mass[old];
        m->inverse_mass[i] = b->mass[old] > 0.0 && keys[i].class != CLASS_FIXED ? 1.0 / b->mass[old] : 0.0;
        for (size_t k = 0; k < 3; k++) {
            m->initial[3 * i + k] = b->x[3 * old + k];
            if (moves) m->velocity[3 * i + k] = keys[i].class == CLASS_FIXED ? 0.0 : b->motion.velocity[3 * old + k];
        }
        if (keys[i].class == CLASS_FREE) m->free_count++;
        if (keys[i].class != CLASS_FIXED) m->moving_count++;
    }
    return 0;
}

int build_renumber(Builder *b)
{
    size_t n = (size_t)b->node_count;
    Adjacency adjacency = {0};
    int32_t *position = memory_alloc(n, sizeof *position), *new_index = memory_alloc(n, sizeof *new_index);
    unsigned char *class = memory_alloc(n, 1);
    NodeKey *keys = memory_alloc(n, sizeof *keys);
    int status = position && new_index && class && keys && !build_adjacency(b, &adjacency) ? 0 : -1;
    if (!status) status = patch_order(b, &adjacency, position);
    if (!status) {
        classify_nodes(b, &adjacency, class);
        for (int32_t i = 0; i < b->node_count; i++) keys[i] = (NodeKey){class[i], position[i], i};
        qsort(keys, n, sizeof *keys, compare_node_keys);
        for (int32_t i = 0; i < b->node_count; i++) new_index[keys[i].node] = i;
        status = order_elements(b, position);
    }
    if (!status) status = fill_nodes(b, keys);
    if (!status) {
        renumber_lists(b, new_index);
        renumber_functions(b, new_index);
        status = motion_renumber(&b->motion, new_index);
    }
    void *blocks[] = {position, new_index, class, keys, adjacency.start, adjacency.record};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
    return status;
}
