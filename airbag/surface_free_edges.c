/* The graph of free edges and the loops taken out of it. */
#include "airbag/surface_internal.h"

#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"

static int compare_nodes(const void *a, const void *b)
{
    int32_t one = *(const int32_t *)a, other = *(const int32_t *)b;
    return (one > other) - (one < other);
}

static int index_of(const FreeGraph *graph, int32_t node)
{
    const int32_t *found = bsearch(&node, graph->node, (size_t)graph->node_count, sizeof *graph->node, compare_nodes);
    return (int)(found - graph->node);
}

/* Lists the edges of one use and their nodes, ascending and each once. */
static void list_free_edges(const EdgeTable *table, FreeGraph *graph)
{
    int nodes = 0;
    for (int e = 0; e < table->edge_count; e++) {
        const EdgeUse *use = &table->use[table->start[e]];
        if (table->start[e + 1] - table->start[e] != 1) continue;
        FreeEdge *edge = &graph->edge[graph->edge_count++];
        edge->facet = use->facet;
        edge->node[0] = graph->node[nodes++] = use->from;
        edge->node[1] = graph->node[nodes++] = use->to;
    }
    qsort(graph->node, (size_t)nodes, sizeof *graph->node, compare_nodes);
    for (int i = 0; i < nodes; i++)
        if (i == 0 || graph->node[i] != graph->node[i - 1]) graph->node[graph->node_count++] = graph->node[i];
}

int free_graph_build(const EdgeTable *table, FreeGraph *graph)
{
    size_t count = 0;
    for (int e = 0; e < table->edge_count; e++) count += table->start[e + 1] - table->start[e] == 1;
    memset(graph, 0, sizeof *graph);
    graph->edge = memory_alloc(count + 1, sizeof *graph->edge);
    graph->node = memory_alloc(2 * count + 1, sizeof *graph->node);
    graph->start = memory_alloc(2 * count + 2, sizeof *graph->start);
    graph->incident = memory_alloc(2 * count + 1, sizeof *graph->incident);
    graph->degree = memory_alloc(2 * count + 1, sizeof *graph->degree);
    if (!graph->edge || !graph->node || !graph->start || !graph->incident || !graph->degree) {
        free_graph_free(graph);
        return -1;
    }
    list_free_edges(table, graph);
    int *start = graph->start;
    for (int e = 0; e < graph->edge_count; e++)
        for (int side = 0; side < 2; side++) {
            graph->edge[e].end[side] = index_of(graph, graph->edge[e].node[side]);
            start[graph->edge[e].end[side] + 1]++;
            graph->degree[graph->edge[e].end[side]]++;
        }
    for (int n = 0; n < graph->node_count; n++) start[n + 1] += start[n];
    for (int e = graph->edge_count - 1; e >= 0; e--) /* backwards, and start[n + 1] counts down to the list's begin */
        for (int side = 0; side < 2; side++) graph->incident[--start[graph->edge[e].end[side] + 1]] = e;
    memmove(start, start + 1, (size_t)graph->node_count * sizeof *start);
    start[graph->node_count] = 2 * graph->edge_count;
    return 0;
}

void free_graph_free(FreeGraph *graph)
{
    memory_free(graph->edge);
    memory_free(graph->node);
    memory_free(graph->start);
    memory_free(graph->incident);
    memory_free(graph->degree);
    memset(graph, 0, sizeof *graph);
}

/* Whether the steps ask each set of facets for one winding only. */
static bool steps_agree(SurfaceWork *work, const FreeGraph *graph, const Step *steps, int count)
{
    bool agree = true;
    int flip;
    for (int i = 0; i < count; i++) {
        int root = parity_find(&work->parity, graph->edge[steps[i].edge].facet, &flip);
        int sense = steps[i].side == 0 ? flip : -flip;
        if (work->sense[root] == 0) work->sense[root] = (signed char)sense;
        agree = agree && work->sense[root] == sense;
    }
    for (int i = 0; i < count; i++)
        work->sense[parity_find(&work->parity, graph->edge[steps[i].edge].facet, &flip)] = 0;
    return agree;
}

int loop_accept(SurfaceWork *work, FreeGraph *graph, const Step *steps, int count, bool seam)
{
    LoopList *list = &work->loops;
    if (!steps_agree(work, graph, steps, count)) return 1;
    if (memory_reserve((void **)&list->loops, &list->capacity, list->count + 1, sizeof *list->loops) ||
        memory_reserve((void **)&list->sides, &list->side_capacity, list->side_count + (size_t)count,
                       sizeof *list->sides)) {
        report_memory(work);
        return -1;
    }
    list->loops[list->count++] = (Loop){list->side_count, count, seam};
    for (int i = 0; i < count; i++) {
        FreeEdge *edge = &graph->edge[steps[i].edge];
        /* a cap walks its facets' sides all with or all against their windings */
        parity_join(&work->parity, graph->edge[steps[0].edge].facet, edge->facet,
                    steps[i].side == steps[0].side ? 1 : -1);
        edge->taken = true;
        for (int side = 0; side < 2; side++) graph->degree[edge->end[side]]--;
        list->sides[list->side_count++] =
            (LoopSide){edge->node[steps[i].side], edge->facet, steps[i].side == 0 ? 1 : -1};
    }
    return 0;
}
