/* Nodes moved onto the line of a fold: a membrane mesh bends only along its edges. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fold/fold.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* A facet should not get flatter than the first (twice its area over its longest side squared), and may not get flatter
 * than the second. */
static const double flattest[] = {0.1, 0.02};

/* An edge that crosses the line. */
typedef struct Crossing {
    double share; /* of the edge from its nearer end to the line, 0 to 0.5 */
    int edge;
    bool bound; /* both ends are bound to a line that they share, along which they must move: these come first */
} Crossing;

static int compare_crossings(const void *one, const void *other)
{
    const Crossing *a = one, *b = other;
    if (a->bound != b->bound) return a->bound ? -1 : 1;
    if (a->share != b->share) return a->share < b->share ? -1 : 1;
    return (a->edge > b->edge) - (a->edge < b->edge);
}

static bool crosses(const FoldBag *bag, int edge)
{
    return bag->across[bag->edge[2 * (ptrdiff_t)edge]] * bag->across[bag->edge[2 * (ptrdiff_t)edge + 1]] < 0.0;
}

/* Twice the area with its sign about the panel's normal z, of three corners. */
static double turn(const FoldBag *bag, int32_t a, int32_t b, int32_t c)
{
    const double *p = bag->flat + 3 * (ptrdiff_t)a, *q = bag->flat + 3 * (ptrdiff_t)b,
                 *r = bag->flat + 3 * (ptrdiff_t)c;
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static double side_length(const FoldBag *bag, int32_t a, int32_t b)
{
    double u[3];
    vector3_subtract(bag->flat + 3 * (ptrdiff_t)a, bag->flat + 3 * (ptrdiff_t)b, u);
    return vector3_norm(u);
}

/* Least turn of the facet's corners over its longest side squared, with the sign of its winding. */
static double shape_of(const FoldBag *bag, int facet, double winding)
{
    const int32_t *node = bag->facet + 4 * (ptrdiff_t)facet;
    const int corners = node[3] == node[2] ? 3 : 4;
    double least = INFINITY, longest = 0.0;
    for (int c = 0; c < corners; c++) {
        const int32_t a = node[c], b = node[(c + 1) % corners], d = node[(c + 2) % corners];
        least = fmin(least, winding * turn(bag, a, b, d));
        longest = fmax(longest, side_length(bag, a, b));
    }
    return least / (longest * longest);
}

static double winding_of(const FoldBag *bag, int facet)
{
    const int32_t *node = bag->facet + 4 * (ptrdiff_t)facet;
    return turn(bag, node[0], node[1], node[2]) < 0.0 ? -1.0 : 1.0;
}

/* Moves node along the edge to its other end by share, in every state of the mesh; undone if a facet gets flatter
 * than least. */
static bool move_node(FoldBag *bag, int node, int other, double share, double least)
{
    double *flat = bag->flat + 3 * (ptrdiff_t)node, *x = bag->x + 3 * (ptrdiff_t)node, kept[3];
    const int32_t first = bag->first_facet[node], end = bag->first_facet[node + 1];
    double winding[64];
    if (end - first > 64) return false;
    for (int32_t i = first; i < end; i++) winding[i - first] = winding_of(bag, bag->node_facet[i]);
    for (int k = 0; k < 3; k++) {
        kept[k] = flat[k];
        flat[k] += share * (bag->flat[3 * (ptrdiff_t)other + k] - flat[k]);
    }
    for (int32_t i = first; i < end; i++)
        if (shape_of(bag, bag->node_facet[i], winding[i - first]) < least) {
            for (int k = 0; k < 3; k++) flat[k] = kept[k];
            return false;
        }
    double *start = bag->start + 3 * (ptrdiff_t)node;
    for (int k = 0; k < 3; k++) {
        x[k] += share * (bag->x[3 * (ptrdiff_t)other + k] - x[k]);
        start[k] += share * (bag->start[3 * (ptrdiff_t)other + k] - start[k]);
    }
    bag->across[node] = 0.0;
    return true;
}

/* A node on lines may move only towards a node on the same lines. */
static bool may_move(const FoldBag *bag, int node, int other)
{
    return (bag->line[node] & ~bag->line[other]) == 0;
}

static bool resolve(FoldBag *bag, int edge)
{
    int near = bag->edge[2 * (ptrdiff_t)edge], far = bag->edge[2 * (ptrdiff_t)edge + 1];
    if (fabs(bag->across[far]) < fabs(bag->across[near])) {
        const int swap = near;
        near = far;
        far = swap;
    }
    const double length = fabs(bag->across[near]) + fabs(bag->across[far]);
    const double share = fabs(bag->across[near]) / length;
    for (int pass = 0; pass < 2; pass++) {
        if (may_move(bag, near, far) && move_node(bag, near, far, share, flattest[pass])) return true;
        if (may_move(bag, far, near) && move_node(bag, far, near, 1.0 - share, flattest[pass])) return true;
    }
    return false;
}

/* Nodes that lie on the line but for rounding. */
static void take_near_nodes(FoldBag *bag)
{
    for (int n = 0; n < bag->node_count; n++)
        if (fabs(bag->across[n]) < 1e-6 * bag->size) bag->across[n] = 0.0;
}

static int refuse_edge(const FoldBag *bag, int edge, char problem[FOLD_TEXT])
{
    const double *x = bag->flat + 3 * (ptrdiff_t)bag->edge[2 * (ptrdiff_t)edge];
    snprintf(problem, FOLD_TEXT,
             "no node of the mesh can be moved onto the line near (%.6g, %.6g) of the flat bag; move the line or make "
             "the mesh finer",
             x[0], x[1]);
    return -1;
}

static int find_crossings(const FoldBag *bag, Crossing *crossing)
{
    int count = 0;
    for (int e = 0; e < bag->edge_count; e++) {
        if (!crosses(bag, e)) continue;
        const int32_t *node = bag->edge + 2 * (ptrdiff_t)e;
        const double a = fabs(bag->across[node[0]]), b = fabs(bag->across[node[1]]);
        crossing[count++] = (Crossing){fmin(a, b) / (a + b), e, (bag->line[node[0]] & bag->line[node[1]]) != 0};
    }
    qsort(crossing, (size_t)count, sizeof *crossing, compare_crossings);
    return count;
}

/* A quadrilateral with corners on both sides would be bent along its diagonal. */
static int check_facets(const FoldBag *bag, char problem[FOLD_TEXT])
{
    for (int f = 0; f < bag->facet_count; f++) {
        const int32_t *node = bag->facet + 4 * (ptrdiff_t)f;
        double low = 0.0, high = 0.0;
        for (int c = 0; c < 4; c++) {
            low = fmin(low, bag->across[node[c]]);
            high = fmax(high, bag->across[node[c]]);
        }
        if (low == 0.0 || high == 0.0) continue;
        const double *x = bag->flat + 3 * (ptrdiff_t)node[0];
        snprintf(
            problem, FOLD_TEXT,
            "the line runs along the diagonal of a quadrilateral near (%.6g, %.6g) of the flat bag; use triangles, "
            "or put the line along the mesh",
            x[0], x[1]);
        return -1;
    }
    return 0;
}

int fold_snap(FoldBag *bag, uint64_t bit, char problem[FOLD_TEXT])
{
    take_near_nodes(bag);
    Crossing *crossing = memory_alloc((size_t)bag->edge_count + 1, sizeof *crossing);
    if (!crossing) {
        snprintf(problem, FOLD_TEXT, "not enough memory");
        return -1;
    }
    const int count = find_crossings(bag, crossing);
    int status = 0;
    for (int i = 0; i < count && !status; i++)
        if (crosses(bag, crossing[i].edge) && !resolve(bag, crossing[i].edge))
            status = refuse_edge(bag, crossing[i].edge, problem);
    memory_free(crossing);
    if (status || check_facets(bag, problem)) return -1;
    for (int n = 0; n < bag->node_count; n++)
        if (bag->across[n] == 0.0) bag->line[n] |= bit;
    return 0;
}
