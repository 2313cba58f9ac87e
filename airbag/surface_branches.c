/* Edges of three and more facets: which facets lie between two chambers of one bag and count for nothing.
 *
 * On every edge the signed uses of the facets that count must cancel (S10). A set of facets left alone on an edge is
 * out at once; else the regions of space around the edges decide: a wall has bounded regions on both sides. Where a
 * flat bag has no such regions, two sets left alone on an edge follow each other. */
#include "airbag/surface_internal.h"

#include <math.h>
#include <stdlib.h>

#include "solver/memory.h"

/* Signed uses of one set of facets on an edge. */
typedef struct EdgeNet {
    int root, net;
} EdgeNet;

typedef struct Branches {
    SurfaceWork *work;
    int count;
    int *edge;        /* edges of three and more (count) */
    bool *out;        /* set of facets that counts for nothing, at its lowest facet (facet_count) */
    double *volume;   /* of the sets (facet_count) */
    double *region;   /* volume of a region at its lowest side (2 facet_count) */
    int *region_root; /* 1 + a set on an outer region, signed by its winding (2 facet_count) */
    bool *ordered;    /* the set's place around an edge is known (facet_count) */
    Parity sides;     /* sides 2 root (the normal's) and 2 root + 1 of the sets, joined into regions */
} Branches;

/* The sets whose uses of edge e do not cancel; returns how many. */
static int edge_nets(const Branches *branches, int e, EdgeNet nets[BRANCH_LIMIT])
{
    SurfaceWork *work = branches->work;
    int count = 0, kept = 0;
    for (int u = work->table.start[e]; u < work->table.start[e + 1]; u++) {
        int flip, root = parity_find(&work->parity, work->table.use[u].facet, &flip), i = 0;
        if (branches->out[root]) continue;
        while (i < count && nets[i].root != root) i++;
        if (i == count) nets[count++] = (EdgeNet){root, 0};
        nets[i].net += flip * edge_use_sign(&work->table.use[u]);
    }
    for (int i = 0; i < count; i++)
        if (nets[i].net != 0) nets[kept++] = nets[i];
    return kept;
}

/* A set alone on an edge cannot count. If pairs is true, two sets alone on an edge follow each other. Returns how many
 * edges stay undecided. */
static int settle_edges(Branches *branches, bool pairs)
{
    int undecided = 0;
    for (bool changed = true; changed;) {
        changed = false;
        undecided = 0;
        for (int i = 0; i < branches->count; i++) {
            EdgeNet nets[BRANCH_LIMIT];
            int sets = edge_nets(branches, branches->edge[i], nets);
            if (sets == 1) {
                branches->out[nets[0].root] = changed = true;
            } else if (pairs && sets == 2 && abs(nets[0].net) == abs(nets[1].net)) {
                int relation = nets[0].net == nets[1].net ? -1 : 1;
                parity_join(&branches->work->parity, nets[0].root, nets[1].root, relation);
                changed = true;
            } else if (sets > 0) {
                undecided++;
            }
        }
    }
    return undecided;
}

/* A facet around an edge: monotone in the angle, from 0 to 4. */
typedef struct Spoke {
    double angle;
    int before, after; /* its sides towards smaller and larger angles */
} Spoke;

static int compare_spokes(const void *a, const void *b)
{
    const Spoke *one = a, *other = b;
    if (one->angle < other->angle || one->angle > other->angle) return one->angle < other->angle ? -1 : 1;
    return (one->before > other->before) - (one->before < other->before);
}

/* Direction from the edge a-b into the facet, at right angles to the edge. */
static void spoke_direction(const SurfaceInput *input, int facet, int32_t a, const double along[3], double w[3])
{
    const int32_t *node = input->node + 4 * (size_t)facet;
    double shift = 0.0;
    for (int k = 0; k < 3; k++) {
        w[k] = 0.0;
        for (int i = 0; i < 4; i++)
            w[k] += 0.25 * (input->x[3 * (size_t)node[i] + (size_t)k] - input->x[3 * (size_t)a + (size_t)k]);
        shift += w[k] * along[k];
    }
    for (int k = 0; k < 3; k++) w[k] -= shift * along[k];
}

static double scale_to_unit(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) v[k] = length > 0.0 ? v[k] / length : 0.0;
    return length;
}

/* Puts the facets around edge e in order; returns how many, 0 if two point the same way or one has no direction. */
static int order_spokes(const Branches *branches, int e, Spoke spoke[BRANCH_LIMIT])
{
    SurfaceWork *work = branches->work;
    const EdgeUse *use = &work->table.use[work->table.start[e]];
    int32_t a = use->from < use->to ? use->from : use->to, b = use->from < use->to ? use->to : use->from;
    double along[3], first[3] = {0.0, 0.0, 0.0}, second[3], w[3];
    for (int k = 0; k < 3; k++)
        along[k] = work->input->x[3 * (size_t)b + (size_t)k] - work->input->x[3 * (size_t)a + (size_t)k];
    scale_to_unit(along);
    int count = 0;
    for (int u = 0; u < edge_use_count(&work->table, e); u++) {
        int flip, root = parity_find(&work->parity, use[u].facet, &flip);
        if (branches->out[root]) continue;
        spoke_direction(work->input, use[u].facet, a, along, w);
        if (!(scale_to_unit(w) > 0.0)) return 0;
        if (count == 0) {
            for (int k = 0; k < 3; k++) first[k] = w[k];
            for (int k = 0; k < 3; k++)
                second[k] = along[(k + 1) % 3] * w[(k + 2) % 3] - along[(k + 2) % 3] * w[(k + 1) % 3];
        }
        double c = w[0] * first[0] + w[1] * first[1] + w[2] * first[2];
        double s = w[0] * second[0] + w[1] * second[1] + w[2] * second[2];
        double reach = s / (fabs(c) + fabs(s));             /* the diamond's angle instead of the circle's */
        bool with_edge = flip * edge_use_sign(&use[u]) > 0; /* then the normal looks towards larger angles */
        spoke[count++] = (Spoke){c < 0.0       ? 2.0 - reach
                                 : reach < 0.0 ? 4.0 + reach
                                               : reach,
                                 with_edge ? 2 * root + 1 : 2 * root, with_edge ? 2 * root : 2 * root + 1};
    }
    qsort(spoke, (size_t)count, sizeof *spoke, compare_spokes);
    for (int i = 0; i < count; i++) {
        double gap = spoke[(i + 1) % count].angle - spoke[i].angle;
        if (fabs(i + 1 < count ? gap : gap + 4.0) < 1e-6) return 0;
    }
    return count;
}

/* Joins the sides that face each other around the branching edges and sums the regions' volumes. */
static void find_regions(Branches *branches)
{
    for (int i = 0; i < branches->count; i++) {
        Spoke spoke[BRANCH_LIMIT];
        int count = order_spokes(branches, branches->edge[i], spoke);
        for (int k = 0; k < count; k++) {
            parity_join(&branches->sides, spoke[k].after, spoke[(k + 1) % count].before, 1);
            branches->ordered[spoke[k].after / 2] = true;
        }
    }
    for (int side = 0; side < 2 * branches->work->input->facet_count; side++) {
        int flip, lowest = parity_find(&branches->sides, side, &flip);
        branches->region[lowest] += side % 2 == 0 ? -branches->volume[side / 2] : branches->volume[side / 2];
    }
}

/* The set at root counts if just one of its sides looks to the outer region, whose volume is negative; it then follows
 * the others around that region. A region without volume decides nothing. */
static void place_set(Branches *branches, int root)
{
    double size = branches->work->size, least = 1e-9 * size * size * size;
    int flip, side[2];
    for (int i = 0; i < 2; i++) {
        side[i] = parity_find(&branches->sides, 2 * root + i, &flip);
        if (fabs(branches->region[side[i]]) <= least) return;
    }
    bool outside[2] = {branches->region[side[0]] < 0.0, branches->region[side[1]] < 0.0};
    if (outside[0] == outside[1]) {
        branches->out[root] = true;
        return;
    }
    int outer = side[outside[0] ? 0 : 1], winding = outside[0] ? 1 : -1;
    if (branches->region_root[outer] == 0) branches->region_root[outer] = winding * (root + 1);
    int first = abs(branches->region_root[outer]) - 1, first_winding = branches->region_root[outer] > 0 ? 1 : -1;
    parity_join(&branches->work->parity, first, root, first_winding * winding);
}

/* Decides by regions where there are any. Returns 0, or -1 with an error reported. */
static int settle_regions(Branches *branches)
{
    SurfaceWork *work = branches->work;
    size_t facets = (size_t)work->input->facet_count;
    branches->volume = memory_alloc(facets, sizeof *branches->volume);
    branches->region = memory_alloc(2 * facets, sizeof *branches->region);
    branches->region_root = memory_alloc(2 * facets, sizeof *branches->region_root);
    branches->ordered = memory_alloc(facets, sizeof *branches->ordered);
    if (!branches->volume || !branches->region || !branches->region_root || !branches->ordered ||
        parity_create(2 * work->input->facet_count, &branches->sides)) {
        report_memory(work);
        return -1;
    }
    surface_sum_volumes(work, branches->volume);
    find_regions(branches);
    for (int root = 0; root < work->input->facet_count; root++)
        if (branches->ordered[root]) place_set(branches, root);
    return 0;
}

/* Takes the sets out that count for nothing, after a last check that all edges cancel. */
static int apply_branches(Branches *branches)
{
    SurfaceWork *work = branches->work;
    for (int i = 0; i < branches->count; i++) {
        EdgeNet nets[BRANCH_LIMIT];
        int e = branches->edge[i];
        if (edge_nets(branches, e, nets) == 0) continue;
        report_branch(work, &work->table.use[work->table.start[e]], edge_use_count(&work->table, e));
        return -1;
    }
    for (int f = 0; f < work->input->facet_count; f++) {
        int flip;
        if (!work->active[f] || !branches->out[parity_find(&work->parity, f, &flip)]) continue;
        work->active[f] = false;
        work->inner[f] = true;
        work->walls++;
    }
    return 0;
}

int surface_resolve_branches(SurfaceWork *work)
{
    const EdgeTable *table = &work->table;
    Branches branches = {.work = work};
    for (int e = 0; e < table->edge_count; e++) branches.count += edge_use_count(table, e) > 2;
    if (branches.count == 0) return 0;
    branches.edge = memory_alloc((size_t)branches.count, sizeof *branches.edge);
    branches.out = memory_alloc((size_t)work->input->facet_count, sizeof *branches.out);
    int result = -1, count = 0;
    if (!branches.edge || !branches.out) {
        report_memory(work);
    } else {
        for (int e = 0; e < table->edge_count; e++)
            if (edge_use_count(table, e) > 2) branches.edge[count++] = e;
        result = settle_edges(&branches, false) > 0 ? settle_regions(&branches) : 0;
        if (result == 0) {
            settle_edges(&branches, true);
            result = apply_branches(&branches);
        }
    }
    memory_free(branches.edge);
    memory_free(branches.out);
    memory_free(branches.volume);
    memory_free(branches.region);
    memory_free(branches.region_root);
    memory_free(branches.ordered);
    parity_free(&branches.sides);
    return result;
}
