/* The bag before its folds: edges, facets of nodes, seams, panels a gap apart. */
#include <math.h>
#include <stdlib.h>

#include "fold/fold.h"
#include "solver/memory.h"
#include "solver/vector3.h"

static int compare_edges(const void *one, const void *other)
{
    const int32_t *a = one, *b = other;
    if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
    return (a[1] > b[1]) - (a[1] < b[1]);
}

static int find_edges(FoldBag *bag)
{
    bag->edge = memory_alloc((size_t)bag->facet_count * 4 + 1, 2 * sizeof *bag->edge);
    if (!bag->edge) return -1;
    ptrdiff_t count = 0;
    for (int f = 0; f < bag->facet_count; f++) {
        const int32_t *node = bag->facet + 4 * (ptrdiff_t)f;
        for (int c = 0; c < 4; c++) {
            const int32_t a = node[c], b = node[(c + 1) % 4];
            if (a == b) continue;
            bag->edge[2 * count] = a < b ? a : b;
            bag->edge[2 * count + 1] = a < b ? b : a;
            count++;
        }
    }
    qsort(bag->edge, (size_t)count, 2 * sizeof *bag->edge, compare_edges);
    bag->edge_count = 0;
    for (ptrdiff_t i = 0; i < count; i++) {
        if (i > 0 && compare_edges(bag->edge + 2 * i, bag->edge + 2 * (i - 1)) == 0) continue;
        bag->edge[2 * (ptrdiff_t)bag->edge_count] = bag->edge[2 * i];
        bag->edge[2 * (ptrdiff_t)bag->edge_count++ + 1] = bag->edge[2 * i + 1];
    }
    return 0;
}

static int find_node_facets(FoldBag *bag)
{
    bag->first_facet = memory_alloc((size_t)bag->node_count + 2, sizeof *bag->first_facet);
    bag->node_facet = memory_alloc((size_t)bag->facet_count * 4 + 1, sizeof *bag->node_facet);
    if (!bag->first_facet || !bag->node_facet) return -1;
    for (int pass = 0; pass < 2; pass++) {
        for (int f = 0; f < bag->facet_count; f++) {
            const int32_t *node = bag->facet + 4 * (ptrdiff_t)f;
            for (int c = 0; c < (node[3] == node[2] ? 3 : 4); c++) {
                if (pass)
                    bag->node_facet[bag->first_facet[node[c] + 1]++] = f;
                else
                    bag->first_facet[node[c] + 2]++;
            }
        }
        if (!pass)
            for (int n = 0; n < bag->node_count; n++) bag->first_facet[n + 2] += bag->first_facet[n + 1];
    }
    return 0;
}

/* Squared distance of every node from the nearest seam node. */
static double seam_distance(const FoldBag *bag, const int *seam, int count, int node)
{
    double least = INFINITY;
    for (int i = 0; i < count; i++) {
        double d[3];
        vector3_subtract(bag->flat + 3 * (ptrdiff_t)node, bag->flat + 3 * (ptrdiff_t)seam[i], d);
        least = fmin(least, vector3_dot(d, d));
    }
    return sqrt(least);
}

/* Lens of the two panels: half a gap up or down beyond the ramp, zero on the seam (eq. O1). */
static int part_panels(FoldBag *bag, const FoldPlan *plan)
{
    int *seam = memory_alloc((size_t)bag->node_count + 1, sizeof *seam), count = 0;
    if (!seam) return -1;
    for (int n = 0; n < bag->node_count; n++)
        if (bag->panel[n] == 0) seam[count++] = n;
    const double ramp = plan->ramp > 0.0 ? plan->ramp : 0.1 * bag->size;
    for (int n = 0; n < bag->node_count; n++) {
        const double share = bag->panel[n] ? fmin(seam_distance(bag, seam, count, n) / ramp, 1.0) : 0.0;
        for (int k = 0; k < 3; k++) bag->x[3 * (ptrdiff_t)n + k] = bag->flat[3 * (ptrdiff_t)n + k];
        bag->x[3 * (ptrdiff_t)n + 2] += 0.5 * plan->gap * bag->panel[n] * share * (2.0 - share);
        if (bag->panel[n] == 0) bag->line[n] = FOLD_SEAM_LINE;
    }
    memory_free(seam);
    return 0;
}

int fold_bag_open(FoldBag *bag, const FoldPlan *plan)
{
    bag->x = memory_alloc((size_t)bag->node_count, 3 * sizeof *bag->x);
    bag->start = memory_alloc((size_t)bag->node_count, 3 * sizeof *bag->start);
    bag->line = memory_alloc((size_t)bag->node_count, sizeof *bag->line);
    bag->across = memory_alloc((size_t)bag->node_count, sizeof *bag->across);
    if (!bag->x || !bag->start || !bag->line || !bag->across || find_edges(bag) || find_node_facets(bag)) return -1;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int n = 0; n < bag->node_count; n++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], bag->flat[3 * (ptrdiff_t)n + k]);
            high[k] = fmax(high[k], bag->flat[3 * (ptrdiff_t)n + k]);
        }
    bag->size = fmax(high[0] - low[0], high[1] - low[1]);
    return part_panels(bag, plan);
}

void fold_bag_free(FoldBag *bag)
{
    void *blocks[] = {bag->flat,  bag->x,    bag->facet,  bag->edge,  bag->first_facet, bag->node_facet,
                      bag->panel, bag->line, bag->across, bag->rigid, bag->start};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
    *bag = (FoldBag){0};
}

static double facet_area(const double *x, const int32_t *node)
{
    double u[3], v[3], n[3];
    vector3_subtract(x + 3 * (ptrdiff_t)node[2], x + 3 * (ptrdiff_t)node[0], u);
    vector3_subtract(x + 3 * (ptrdiff_t)node[3], x + 3 * (ptrdiff_t)node[1], v);
    vector3_cross(u, v, n);
    return 0.5 * vector3_norm(n);
}

static double edge_length(const double *x, const int32_t *edge)
{
    double u[3];
    vector3_subtract(x + 3 * (ptrdiff_t)edge[1], x + 3 * (ptrdiff_t)edge[0], u);
    return vector3_norm(u);
}

void fold_measure(const FoldBag *bag, FoldMeasure *measure)
{
    *measure = (FoldMeasure){.stretched_edge = -1, .shrunk_edge = -1};
    for (int e = 0; e < bag->edge_count; e++) {
        const int32_t *edge = bag->edge + 2 * (ptrdiff_t)e;
        const double change = edge_length(bag->x, edge) / edge_length(bag->flat, edge) - 1.0;
        if (change > measure->stretch) measure->stretch = change, measure->stretched_edge = e;
        if (-change > measure->shrink) measure->shrink = -change, measure->shrunk_edge = e;
    }
    for (int f = 0; f < bag->facet_count; f++) {
        const int32_t *node = bag->facet + 4 * (ptrdiff_t)f;
        const double area = facet_area(bag->x, node), flat = facet_area(bag->flat, node);
        measure->area += area;
        measure->flat_area += flat;
        if (fabs(area / flat - 1.0) > fabs(measure->area_change)) measure->area_change = area / flat - 1.0;
    }
}
