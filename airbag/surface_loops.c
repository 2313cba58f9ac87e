/* The free edges left after the seams become loops; chains between branching nodes become arcs for the cycle search. */
#include "airbag/surface_internal.h"

#include <math.h>

#include "solver/memory.h"

/* Walks from step through nodes of degree two until a branching node or the start again; marks the edges seen and
 * returns the number of steps. */
static int walk(const FreeGraph *graph, Step step, bool *seen, Step *steps)
{
    int count = 0;
    while (step.edge >= 0) {
        steps[count++] = step;
        seen[step.edge] = true;
        int node = graph->edge[step.edge].end[1 - step.side];
        step.edge = -1;
        if (graph->degree[node] != 2) break;
        for (int i = graph->start[node]; i < graph->start[node + 1]; i++) {
            int e = graph->incident[i];
            if (!graph->edge[e].taken && !seen[e]) step = (Step){e, graph->edge[e].end[0] == node ? 0 : 1};
        }
    }
    return count;
}

static double step_length(const SurfaceWork *work, const FreeEdge *edge)
{
    const double *a = work->input->x + 3 * (size_t)edge->node[0], *b = work->input->x + 3 * (size_t)edge->node[1];
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += (b[k] - a[k]) * (b[k] - a[k]);
    return sqrt(sum);
}

/* Chains that start at branching nodes, in the order of the nodes. */
static void find_arcs(const SurfaceWork *work, const FreeGraph *graph, bool *seen, ArcGraph *arcs)
{
    int used = 0;
    for (int n = 0; n < graph->node_count; n++) {
        int branches = graph->degree[n];
        if (branches == 0 || branches == 2) continue;
        for (int i = graph->start[n]; i < graph->start[n + 1]; i++) {
            int e = graph->incident[i];
            if (graph->edge[e].taken || seen[e]) continue;
            Arc *arc = &arcs->arc[arcs->arc_count++];
            arc->first = used;
            arc->count = walk(graph, (Step){e, graph->edge[e].end[0] == n ? 0 : 1}, seen, arcs->steps + used);
            used += arc->count;
            for (int k = arc->first; k < used; k++) arc->length += step_length(work, &graph->edge[arcs->steps[k].edge]);
            const Step *last = &arcs->steps[used - 1];
            arc->end[0] = n;
            arc->end[1] = graph->edge[last->edge].end[1 - last->side];
        }
    }
}

/* Lists the arcs at every node (an arc back to its start stands there twice). */
static void link_arcs(const FreeGraph *graph, ArcGraph *arcs)
{
    int *start = arcs->start;
    for (int a = 0; a < arcs->arc_count; a++)
        for (int side = 0; side < 2; side++) start[arcs->arc[a].end[side] + 2]++;
    for (int n = 0; n < graph->node_count; n++) start[n + 2] += start[n + 1];
    for (int a = 0; a < arcs->arc_count; a++)
        for (int side = 0; side < 2; side++) arcs->incident[start[arcs->arc[a].end[side] + 1]++] = a;
}

/* Loops through nodes of degree two alone, in the order of their lowest edges. */
static int take_plain_loops(SurfaceWork *work, FreeGraph *graph, bool *seen, Step *steps)
{
    for (int e = 0; e < graph->edge_count; e++) {
        if (graph->edge[e].taken || seen[e]) continue;
        int count = walk(graph, (Step){e, 0}, seen, steps);
        int result = loop_accept(work, graph, steps, count, false);
        if (result > 0) report_stray(work, &graph->edge[e]);
        if (result != 0) return -1;
    }
    return 0;
}

int surface_find_loops(SurfaceWork *work, FreeGraph *graph)
{
    size_t edges = (size_t)graph->edge_count + 1, nodes = (size_t)graph->node_count + 3;
    bool *seen = memory_alloc(edges, sizeof *seen);
    Step *steps = memory_alloc(edges, sizeof *steps);
    ArcGraph arcs = {0, memory_alloc(edges, sizeof *arcs.arc), memory_alloc(edges, sizeof *arcs.steps),
                     memory_alloc(nodes, sizeof *arcs.start), memory_alloc(2 * edges, sizeof *arcs.incident)};
    int result = -1;
    if (!seen || !steps || !arcs.arc || !arcs.steps || !arcs.start || !arcs.incident) {
        report_memory(work);
    } else {
        find_arcs(work, graph, seen, &arcs);
        link_arcs(graph, &arcs);
        result = take_plain_loops(work, graph, seen, steps);
        if (result == 0 && arcs.arc_count > 0) result = surface_find_cycles(work, graph, &arcs);
    }
    memory_free(seen);
    memory_free(steps);
    memory_free(arcs.arc);
    memory_free(arcs.steps);
    memory_free(arcs.start);
    memory_free(arcs.incident);
    return result;
}
