/* *BOUNDARY_SPC and the constraint codes of *NODE. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/motion_input.h"

static const double IDENTITY[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

typedef struct SupportList {
    Support *items;
    size_t count, capacity;
} SupportList;

static int add_support(SupportList *list, const Support *support, Diagnostics *diagnostics)
{
    if (memory_reserve((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items))
        return motion_no_memory("*BOUNDARY_SPC", diagnostics);
    list->items[list->count++] = *support;
    return 0;
}

/* A rigid body's nodes cannot be held one by one. */
static int report_rigid_node(const MotionInput *input, const Motion *motion, int32_t node, Source source,
                             const char *keyword, Diagnostics *diagnostics)
{
    diagnostics_add(
        diagnostics, SEVERITY_ERROR, source, keyword,
        "node %d belongs to the moving rigid part %d and cannot be held by itself; constrain the part by CON1 "
        "and CON2 of *MAT_RIGID, or take its nodes out",
        input->index->definitions->nodes.items[node].id, motion->rigid_bodies[motion->node_body[node]].part_id);
    return -1;
}

static int add_spc(const MotionInput *input, const Motion *motion, const SpcDefinition *card, SupportList *list,
                   Diagnostics *diagnostics)
{
    const char *keyword = card->is_set ? "*BOUNDARY_SPC_SET" : "*BOUNDARY_SPC_NODE";
    Support support = {.birth = card->birth, .death = card->death > 0 ? card->death : 1e20};
    IndexList nodes = {0};
    int status = motion_find_axes(input, card->cid, card->source, keyword, support.axes, diagnostics);
    support.local = memcmp(support.axes, IDENTITY, sizeof IDENTITY) != 0;
    for (int i = 0; i < 3; i++) support.fixed[i] = card->dof[i] != 0;
    if (motion_find_nodes(input, card->is_set, card->id, card->source, keyword, &nodes, diagnostics)) status = -1;
    bool any = support.fixed[0] || support.fixed[1] || support.fixed[2];
    for (size_t k = 0; k < nodes.count && any && status == 0; k++) {
        support.node = nodes.items[k];
        if (motion->node_body[support.node] >= 0) {
            status = report_rigid_node(input, motion, support.node, card->source, keyword, diagnostics);
        } else {
            status = add_support(list, &support, diagnostics);
        }
    }
    index_list_free(&nodes);
    return status;
}

/* TC of the *NODE cards: codes 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz. */
static int add_codes(const MotionInput *input, const Motion *motion, SupportList *list, Diagnostics *diagnostics)
{
    static const bool fixes[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                     {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
    const Definitions *d = input->index->definitions;
    int status = 0;
    for (size_t n = 0; n < d->nodes.count; n++) {
        const NodeDefinition *node = &d->nodes.items[n];
        if (node->tc == 0) continue;
        if (node->tc < 0 || node->tc > 7) {
            diagnostics_add(diagnostics, SEVERITY_ERROR, node->source, "*NODE",
                            "TC = %d of node %d is none of the codes 0 to 7", node->tc, node->id);
            status = -1;
            continue;
        }
        if (motion->node_body[n] >= 0) {
            status = report_rigid_node(input, motion, (int32_t)n, node->source, "*NODE", diagnostics);
            continue;
        }
        Support support = {.node = (int32_t)n, .birth = 0, .death = 1e20};
        memcpy(support.axes, IDENTITY, sizeof IDENTITY);
        memcpy(support.fixed, fixes[node->tc], sizeof support.fixed);
        if (add_support(list, &support, diagnostics)) return -1;
    }
    return status;
}

/* One support for each node, frame and time; sorted by node. */
static void merge(SupportList *list)
{
    if (list->count > 1) qsort(list->items, list->count, sizeof *list->items, motion_compare_supports);
    size_t kept = 0;
    for (size_t s = 0; s < list->count; s++) {
        if (kept > 0 && motion_compare_supports(&list->items[kept - 1], &list->items[s]) == 0) {
            for (int i = 0; i < 3; i++) {
                list->items[kept - 1].fixed[i] = list->items[kept - 1].fixed[i] || list->items[s].fixed[i];
            }
        } else {
            list->items[kept++] = list->items[s];
        }
    }
    list->count = kept;
}

static void note_rotations(const Definitions *d, Diagnostics *diagnostics)
{
    for (size_t c = 0; c < d->spcs.count; c++) {
        const SpcDefinition *card = &d->spcs.items[c];
        if (card->dof[3] == 0 && card->dof[4] == 0 && card->dof[5] == 0) continue;
        diagnostics_add(diagnostics, SEVERITY_NOTE, card->source, "*BOUNDARY_SPC",
                        "DOFRX, DOFRY and DOFRZ have no effect here nor on later cards: membranes have no rotations");
        return;
    }
}

int build_supports(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    SupportList list = {0};
    int status = add_codes(input, motion, &list, diagnostics);
    for (size_t c = 0; c < d->spcs.count; c++) {
        if (add_spc(input, motion, &d->spcs.items[c], &list, diagnostics)) status = -1;
    }
    note_rotations(d, diagnostics);
    merge(&list);
    motion->constraints.supports = list.items;
    motion->constraints.support_count = (int)list.count;
    return status;
}
