/* Facets that bound no gas on their own: second layers on the same nodes, flaps and tethers that end in a free edge. */
#include "airbag/surface_internal.h"

#include <stdlib.h>

#include "airbag/volume.h"
#include "solver/memory.h"

/* ---- second layers ---- */

typedef struct Layer {
    int32_t corner[4]; /* from the lowest node on, towards its lower neighbour; triangles end in -1 */
    int facet;
} Layer;

static Layer layer_of(const SurfaceInput *input, int facet)
{
    int32_t corner[4];
    int n = facet_corners(input->node + 4 * (size_t)facet, corner), low = 0;
    for (int i = 1; i < n; i++)
        if (corner[i] < corner[low]) low = i;
    int step = corner[(low + 1) % n] < corner[(low + n - 1) % n] ? 1 : n - 1;
    Layer layer = {{-1, -1, -1, -1}, facet};
    for (int i = 0; i < n; i++) layer.corner[i] = corner[(low + i * step) % n];
    return layer;
}

static int compare_layers(const void *a, const void *b)
{
    const Layer *one = a, *other = b;
    for (int i = 0; i < 4; i++)
        if (one->corner[i] != other->corner[i]) return one->corner[i] < other->corner[i] ? -1 : 1;
    return (one->facet > other->facet) - (one->facet < other->facet);
}

/* Facets on an edge of more than two, each once per such edge; returns how many. */
static int list_layers(const SurfaceWork *work, Layer *layer)
{
    int count = 0;
    for (int e = 0; e < work->table.edge_count; e++)
        for (int u = work->table.start[e]; edge_use_count(&work->table, e) > 2 && u < work->table.start[e + 1]; u++)
            layer[count++] = layer_of(work->input, work->table.use[u].facet);
    return count;
}

int surface_drop_layers(SurfaceWork *work)
{
    int count = 0;
    for (int e = 0; e < work->table.edge_count; e++)
        if (edge_use_count(&work->table, e) > 2) count += edge_use_count(&work->table, e);
    if (count == 0) return 0;
    Layer *layer = memory_alloc((size_t)count, sizeof *layer);
    if (!layer) {
        report_memory(work);
        return -1;
    }
    qsort(layer, (size_t)list_layers(work, layer), sizeof *layer, compare_layers);
    int first = 0; /* of the layers on the same nodes */
    for (int i = 1; i < count; i++) {
        bool same = true;
        for (int k = 0; k < 4; k++) same = same && layer[i].corner[k] == layer[first].corner[k];
        int facet = layer[i].facet;
        if (!same) first = i;
        if (!same || facet == layer[first].facet || work->inner[facet]) continue;
        work->inner[facet] = true;
        work->active[facet] = false;
        work->layers++;
    }
    memory_free(layer);
    return work->layers > 0 ? surface_spread(work) : 0;
}

/* ---- flaps and tethers ---- */

/* A node on a branching edge of a sheet. */
typedef struct SheetNode {
    int root;
    int32_t node;
} SheetNode;

static int compare_sheet_nodes(const void *a, const void *b)
{
    const SheetNode *one = a, *other = b;
    if (one->root != other->root) return one->root < other->root ? -1 : 1;
    return (one->node > other->node) - (one->node < other->node);
}

/* Sum of the sheet's signed uses of edge e: zero where it passes through. */
static int sheet_net(SurfaceWork *work, int e, int root)
{
    int net = 0;
    for (int u = work->table.start[e]; u < work->table.start[e + 1]; u++) {
        int flip;
        if (parity_find(&work->parity, work->table.use[u].facet, &flip) == root)
            net += flip * edge_use_sign(&work->table.use[u]);
    }
    return net;
}

/* Lists both nodes of every branching edge for each sheet that ends there; sorted. Returns how many, -1 after an error.
 */
static int list_sheet_nodes(SurfaceWork *work, SheetNode *list)
{
    const EdgeTable *table = &work->table;
    int count = 0;
    for (int e = 0; e < table->edge_count; e++) {
        if (edge_use_count(table, e) <= 2) continue;
        if (edge_use_count(table, e) > BRANCH_LIMIT) {
            report_branch(work, &table->use[table->start[e]], edge_use_count(table, e));
            return -1;
        }
        for (int u = table->start[e]; u < table->start[e + 1]; u++) {
            int flip, root = parity_find(&work->parity, table->use[u].facet, &flip);
            if (sheet_net(work, e, root) == 0) continue;
            list[count++] = (SheetNode){root, table->use[u].from};
            list[count++] = (SheetNode){root, table->use[u].to};
        }
    }
    qsort(list, (size_t)count, sizeof *list, compare_sheet_nodes);
    return count;
}

/* A flap is a sheet (facets joined over edges of two) with a free edge that starts where its branching edge ends. */
typedef struct Flaps {
    bool *is_flap; /* by the sheet's lowest facet (facet_count) */
    bool *blocked; /* another flap goes first (facet_count) */
    double *area;  /* of the flap [L2] (facet_count) */
    SheetNode *list;
} Flaps;

/* Marks the flaps and sums their areas; returns whether there are any. */
static bool find_flaps(SurfaceWork *work, int listed, Flaps *flaps)
{
    const EdgeTable *table = &work->table;
    bool found = false;
    for (int e = 0; e < table->edge_count; e++) {
        const EdgeUse *use = &table->use[table->start[e]];
        if (edge_use_count(table, e) != 1) continue;
        int flip, root = parity_find(&work->parity, use->facet, &flip);
        SheetNode ends[2] = {{root, use->from}, {root, use->to}};
        for (int i = 0; i < 2; i++)
            if (bsearch(&ends[i], flaps->list, (size_t)listed, sizeof ends[i], compare_sheet_nodes))
                found = flaps->is_flap[root] = true;
    }
    for (int f = 0; f < work->input->facet_count && found; f++) {
        int flip, root = parity_find(&work->parity, f, &flip);
        flaps->area[root] += volume_facet_area(work->input->node + 4 * (size_t)f, work->input->x);
    }
    return found;
}

/* At every branching edge only the smallest flap may go now: with it gone the edge may be a plain one. */
static void block_flaps(SurfaceWork *work, Flaps *flaps)
{
    const EdgeTable *table = &work->table;
    for (int e = 0; e < table->edge_count; e++) {
        int first = -1;
        for (int pass = 0; pass < 2 && edge_use_count(table, e) > 2; pass++)
            for (int u = table->start[e]; u < table->start[e + 1]; u++) {
                int flip, root = parity_find(&work->parity, table->use[u].facet, &flip);
                if (!flaps->is_flap[root] || sheet_net(work, e, root) == 0) continue;
                double gain = first < 0 ? -1.0 : flaps->area[root] - flaps->area[first];
                if (pass == 0 && (gain < 0.0 || (gain <= 0.0 && root < first))) first = root;
                if (pass == 1 && root != first) flaps->blocked[root] = true;
            }
    }
}

static void drop_flaps(SurfaceWork *work, const Flaps *flaps)
{
    for (int f = 0; f < work->input->facet_count; f++) {
        int flip, root = parity_find(&work->parity, f, &flip);
        if (!work->active[f] || !flaps->is_flap[root] || flaps->blocked[root]) continue;
        work->inner[f] = true;
        work->active[f] = false;
        work->flaps++;
    }
}

/* One round; 1 if flaps were taken out, 0 if there are none, -1 after an error. */
static int drop_flaps_once(SurfaceWork *work)
{
    size_t facets = (size_t)work->input->facet_count + 1, uses = (size_t)work->table.start[work->table.edge_count];
    Flaps flaps = {memory_alloc(facets, sizeof *flaps.is_flap), memory_alloc(facets, sizeof *flaps.blocked),
                   memory_alloc(facets, sizeof *flaps.area), memory_alloc(2 * uses + 1, sizeof *flaps.list)};
    int result = -1;
    if (!flaps.is_flap || !flaps.blocked || !flaps.area || !flaps.list) {
        report_memory(work);
    } else {
        int listed = list_sheet_nodes(work, flaps.list);
        result = listed < 0 ? -1 : find_flaps(work, listed, &flaps);
        if (result > 0) {
            block_flaps(work, &flaps);
            drop_flaps(work, &flaps);
        }
    }
    memory_free(flaps.is_flap);
    memory_free(flaps.blocked);
    memory_free(flaps.area);
    memory_free(flaps.list);
    return result;
}

int surface_drop_flaps(SurfaceWork *work)
{
    int dropped = 1;
    while (dropped > 0) {
        int branching = 0;
        for (int e = 0; e < work->table.edge_count && !branching; e++) branching = edge_use_count(&work->table, e) > 2;
        if (!branching) return 0;
        dropped = drop_flaps_once(work);
        if (dropped > 0 && surface_spread(work)) return -1;
    }
    return dropped;
}
