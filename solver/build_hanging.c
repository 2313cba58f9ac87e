/* *CONSTRAINED_ADAPTIVITY: hanging nodes of mesh refinement, masters first. */
#include <stddef.h>
#include <stdlib.h>

#include "solver/memory.h"
#include "solver/motion_input.h"
#include "solver/vector3.h"

static const char *const KEYWORD = "*CONSTRAINED_ADAPTIVITY";

/* A tie under way. */
typedef struct Tie {
    HangingNode hanging;
    Source source;
    int depth; /* 0: not yet known, -1: being found, else 1 + the depth of its deepest end */
} Tie;

typedef struct TieList {
    Tie *items;
    size_t count, capacity;
    int32_t *of_node; /* tie of each node + 1, 0 none (node count) */
} TieList;

static int read_tie(const MotionInput *input, const AdaptivityDefinition *card, TieList *list, Diagnostics *diagnostics)
{
    Tie tie = {.source = card->source};
    tie.hanging.node = motion_find_node(input, card->dnid, "DNID", card->source, KEYWORD, diagnostics);
    tie.hanging.end[0] = motion_find_node(input, card->nid1, "NID1", card->source, KEYWORD, diagnostics);
    tie.hanging.end[1] = motion_find_node(input, card->nid2, "NID2", card->source, KEYWORD, diagnostics);
    const HangingNode *h = &tie.hanging;
    if (h->node < 0 || h->end[0] < 0 || h->end[1] < 0) return -1;
    if (h->node == h->end[0] || h->node == h->end[1] || h->end[0] == h->end[1]) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
                        "DNID = %d, NID1 = %d, NID2 = %d must be three different nodes", card->dnid, card->nid1,
                        card->nid2);
        return -1;
    }
    if (list->of_node[h->node] > 0) {
        const HangingNode *other = &list->items[list->of_node[h->node] - 1].hanging;
        bool same = (other->end[0] == h->end[0] && other->end[1] == h->end[1]) ||
                    (other->end[0] == h->end[1] && other->end[1] == h->end[0]);
        if (same) return 0;
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
                        "DNID = %d is already tied to another edge; remove one of the cards", card->dnid);
        return -1;
    }
    if (memory_reserve((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items))
        return motion_no_memory(KEYWORD, diagnostics);
    list->items[list->count++] = tie;
    list->of_node[h->node] = (int32_t)list->count;
    return 0;
}

/* Depth of a tie in the chain of ties, 0 if a chain bites its own tail. Refinement nests a few levels only; a recursion
 * as deep as the deck pleases is bounded by giving up beyond 1000. */
static int find_depth(TieList *list, Tie *tie, int level)
{
    if (tie->depth > 0) return tie->depth;
    if (tie->depth < 0 || level > 1000) return 0;
    tie->depth = -1;
    int deepest = 0;
    for (int e = 0; e < 2; e++) {
        int32_t next = list->of_node[tie->hanging.end[e]];
        if (next == 0) continue;
        int depth = find_depth(list, &list->items[next - 1], level + 1);
        if (depth == 0) return 0;
        if (depth > deepest) deepest = depth;
    }
    tie->depth = deepest + 1;
    return tie->depth;
}

static int order_ties(const MotionInput *input, TieList *list, Diagnostics *diagnostics)
{
    for (size_t t = 0; t < list->count; t++) {
        Tie *tie = &list->items[t];
        if (find_depth(list, tie, 0) > 0) continue;
        diagnostics_add(diagnostics, SEVERITY_ERROR, tie->source, KEYWORD,
                        "node %d hangs, through other cards, on itself; remove one card of the circle",
                        input->index->definitions->nodes.items[tie->hanging.node].id);
        return -1;
    }
    return 0;
}

static int compare_ties(const void *a, const void *b)
{
    const Tie *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return (p->hanging.node > q->hanging.node) - (p->hanging.node < q->hanging.node);
}

/* Whether the tie is kept: rigid nodes follow their part, nodes between two fixed ones stand still. */
static bool keep_tie(const MotionInput *input, Motion *motion, const Tie *tie, Diagnostics *diagnostics)
{
    const HangingNode *h = &tie->hanging;
    int body = motion->node_body[h->node];
    if (body != MOTION_DEFORMABLE) {
        if (motion->node_body[h->end[0]] != body || motion->node_body[h->end[1]] != body) {
            diagnostics_add(diagnostics, SEVERITY_WARNING, tie->source, KEYWORD,
                            "node %d belongs to a rigid part and follows it, not the edge; the mesh opens there",
                            input->index->definitions->nodes.items[h->node].id);
        }
        return false;
    }
    if (motion->fixed[h->end[0]] && motion->fixed[h->end[1]]) {
        motion->fixed[h->node] = 1;
        return false;
    }
    motion->fixed[h->node] = 0; /* whatever held the node itself: it follows the edge */
    return true;
}

static void warn_place(const MotionInput *input, const Tie *tie, Diagnostics *diagnostics)
{
    const HangingNode *h = &tie->hanging;
    const double *x = input->x + 3 * (size_t)h->node;
    const double *a = input->x + 3 * (size_t)h->end[0], *b = input->x + 3 * (size_t)h->end[1];
    double edge[3], off[3];
    vector3_subtract(b, a, edge);
    for (int i = 0; i < 3; i++) off[i] = x[i] - 0.5 * (a[i] + b[i]);
    if (vector3_norm(off) <= 0.05 * vector3_norm(edge)) return;
    const NodeDefinition *nodes = input->index->definitions->nodes.items;
    diagnostics_add(diagnostics, SEVERITY_WARNING, tie->source, KEYWORD,
                    "node %d is %.3g away from the middle of the edge %d-%d (length %.3g) and keeps this distance",
                    nodes[h->node].id, vector3_norm(off), nodes[h->end[0]].id, nodes[h->end[1]].id, vector3_norm(edge));
}

static int keep_ties(const MotionInput *input, Motion *motion, TieList *list, Diagnostics *diagnostics)
{
    Constraints *constraints = &motion->constraints;
    constraints->hanging = memory_alloc(list->count + 1, sizeof *constraints->hanging);
    if (!constraints->hanging) return motion_no_memory(KEYWORD, diagnostics);
    for (size_t t = 0; t < list->count; t++) {
        if (!keep_tie(input, motion, &list->items[t], diagnostics)) continue;
        warn_place(input, &list->items[t], diagnostics);
        constraints->hanging[constraints->hanging_count++] = list->items[t].hanging;
    }
    return 0;
}

int build_hanging_nodes(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    if (d->adaptivities.count == 0) return 0;
    TieList list = {0};
    list.of_node = memory_alloc(d->nodes.count + 1, sizeof *list.of_node);
    if (!list.of_node) return motion_no_memory(KEYWORD, diagnostics);
    int status = 0;
    for (size_t c = 0; c < d->adaptivities.count; c++) {
        if (read_tie(input, &d->adaptivities.items[c], &list, diagnostics)) status = -1;
    }
    if (order_ties(input, &list, diagnostics)) status = -1;
    if (status == 0) {
        if (list.count > 1) qsort(list.items, list.count, sizeof *list.items, compare_ties);
        status = keep_ties(input, motion, &list, diagnostics);
    }
    memory_free(list.items);
    memory_free(list.of_node);
    return status;
}
