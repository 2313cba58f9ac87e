/* Slivers of hanging nodes: an edge a-b of one facet against a chain a-m-..-b of others on the same line. */
#include "airbag/surface_internal.h"

#include "solver/memory.h"

/* A hanging node lies this near to the edge, as a share of the edge's length. */
static const double seam_width = 0.01;

/* Position of node along the edge a-b (0 at a, 1 at b), or -1 if it is off the edge. */
static double place_on_edge(const double *x, int32_t a, int32_t b, int32_t node)
{
    double along = 0.0, length = 0.0, distance = 0.0;
    for (int k = 0; k < 3; k++) {
        double edge = x[3 * (size_t)b + (size_t)k] - x[3 * (size_t)a + (size_t)k];
        double reach = x[3 * (size_t)node + (size_t)k] - x[3 * (size_t)a + (size_t)k];
        along += edge * reach;
        length += edge * edge;
        distance += reach * reach;
    }
    if (!(length > 0.0)) return -1.0;
    double t = along / length, off = distance - along * t;
    return off <= seam_width * seam_width * length ? t : -1.0;
}

/* Walks from end side of edge e to its other end through nodes on the edge, nearest first. Returns the number of steps,
 * 0 if there is no such chain. */
static int follow_chain(const SurfaceWork *work, const FreeGraph *graph, int e, int from, Step *steps, int most)
{
    const FreeEdge *base = &graph->edge[e];
    int at = base->end[from], goal = base->end[1 - from], count = 0;
    double reached = 0.0;
    while (at != goal) {
        Step best = {-1, 0};
        double nearest = 2.0;
        for (int i = graph->start[at]; i < graph->start[at + 1]; i++) {
            const FreeEdge *edge = &graph->edge[graph->incident[i]];
            int side = edge->end[0] == at ? 0 : 1, next = edge->end[1 - side];
            if (edge->taken || graph->incident[i] == e) continue;
            double t = next == goal ? 1.0
                                    : place_on_edge(work->input->x, base->node[from], base->node[1 - from],
                                                    edge->node[1 - side]);
            if (t <= reached || t >= nearest || (t >= 1.0 && next != goal)) continue;
            nearest = t;
            best = (Step){graph->incident[i], side};
        }
        if (best.edge < 0 || count == most) return 0;
        steps[count++] = best;
        at = graph->edge[best.edge].end[1 - best.side];
        reached = nearest;
    }
    return count;
}

int surface_find_seams(SurfaceWork *work, FreeGraph *graph)
{
    enum { MOST = 64 }; /* five halvings between neighbours are 33 sides */
    Step steps[MOST];
    for (int e = 0; e < graph->edge_count; e++) {
        const FreeEdge *edge = &graph->edge[e];
        if (edge->taken) continue;
        int from = graph->degree[edge->end[0]] <= graph->degree[edge->end[1]] ? 0 : 1; /* fewer ways to look at */
        int count = follow_chain(work, graph, e, from, steps, MOST - 1);
        if (count < 2) continue;
        steps[count++] = (Step){e, 1 - from}; /* back along the edge itself */
        int result = loop_accept(work, graph, steps, count, true);
        if (result > 0) {
            report_one_sided(work, edge->node[0], edge->node[1], edge->facet, graph->edge[steps[0].edge].facet);
        }
        if (result != 0) return -1;
    }
    return 0;
}
