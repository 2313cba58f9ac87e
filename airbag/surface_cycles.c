/* Holes that touch at nodes: the shortest cycles of arcs are taken out first, by length along the edges. */
#include "airbag/surface_internal.h"

#include <math.h>

#include "solver/memory.h"

/* Both heaps hold a length and an arc or node; the smaller length first, then the lower index. */
typedef struct Entry {
    double length;
    int index;
} Entry;

typedef struct Heap {
    Entry *entry;
    size_t count, capacity;
} Heap;

/* How the search came to a node of the free graph. */
typedef struct Label {
    double length;
    int arc, side; /* by this arc, leaving from its end side */
    int stamp;     /* number of the search that wrote it */
    bool settled;
} Label;

typedef struct CycleSearch {
    SurfaceWork *work;
    FreeGraph *graph;
    ArcGraph *arcs;
    Label *label;
    Step *steps; /* of the cycle found last */
    Heap open, queue;
    int stamp;
} CycleSearch;

static bool entry_before(const Entry *a, const Entry *b)
{
    if (a->length < b->length || a->length > b->length) return a->length < b->length;
    return a->index < b->index;
}

static int heap_push(Heap *heap, Entry entry)
{
    if (memory_reserve((void **)&heap->entry, &heap->capacity, heap->count + 1, sizeof *heap->entry)) return -1;
    size_t at = heap->count++;
    for (; at > 0 && entry_before(&entry, &heap->entry[(at - 1) / 2]); at = (at - 1) / 2)
        heap->entry[at] = heap->entry[(at - 1) / 2];
    heap->entry[at] = entry;
    return 0;
}

static Entry heap_pop(Heap *heap)
{
    Entry top = heap->entry[0], last = heap->entry[--heap->count];
    size_t at = 0;
    for (size_t child = 1; child < heap->count; child = 2 * at + 1) {
        if (child + 1 < heap->count && entry_before(&heap->entry[child + 1], &heap->entry[child])) child++;
        if (!entry_before(&heap->entry[child], &last)) break;
        heap->entry[at] = heap->entry[child];
        at = child;
    }
    heap->entry[at] = last;
    return top;
}

static bool arc_taken(const CycleSearch *search, int arc)
{
    return search->graph->edge[search->arcs->steps[search->arcs->arc[arc].first].edge].taken;
}

/* The set of facets along an arc, and its winding relative to the walk from the arc's end side. */
static int arc_sense(CycleSearch *search, int arc, int side, int *sense)
{
    const Step *step = &search->arcs->steps[search->arcs->arc[arc].first];
    int root = parity_find(&search->work->parity, search->graph->edge[step->edge].facet, sense);
    if (step->side != side) *sense = -*sense;
    return root;
}

/* Whether an arc may follow the path that ends at node: no set of facets is walked both ways. */
static bool arc_fits(CycleSearch *search, int first, int node, int arc, int side, bool own_set_only)
{
    int sense, other, root = arc_sense(search, arc, side, &sense);
    int own = arc_sense(search, first, 0, &other);
    if (root == own) return sense == other;
    if (own_set_only) return false;
    while (node != search->arcs->arc[first].end[1]) {
        const Label *label = &search->label[node];
        if (arc_sense(search, label->arc, label->side, &other) == root) return sense == other;
        node = search->arcs->arc[label->arc].end[label->side];
    }
    return true;
}

/* Opens the neighbours of node, which was reached by a path of the given length. */
static int open_neighbours(CycleSearch *search, int first, int node, double length, bool own_set_only)
{
    for (int i = search->arcs->start[node]; i < search->arcs->start[node + 1]; i++) {
        int index = search->arcs->incident[i];
        const Arc *arc = &search->arcs->arc[index];
        int side = arc->end[0] == node ? 0 : 1, next = arc->end[1 - side];
        if (arc_taken(search, index) || index == first || next == node) continue;
        Label *label = &search->label[next];
        bool known = label->stamp == search->stamp;
        double sum = length + arc->length;
        if (known && (label->settled || label->length <= sum)) continue;
        if (!arc_fits(search, first, node, index, side, own_set_only)) continue;
        *label = (Label){sum, index, side, search->stamp, false};
        if (heap_push(&search->open, (Entry){sum, next})) return -1;
    }
    return 0;
}

/* Shortest cycle through an arc, its steps into search->steps. *length is its length, HUGE_VAL if there is none.
 * Returns the number of its steps, -1 without memory. */
static int shortest_cycle(CycleSearch *search, int first, bool own_set_only, double *length)
{
    const Arc *base = &search->arcs->arc[first];
    int goal = base->end[0], node = base->end[1];
    search->open.count = 0;
    search->stamp++;
    search->label[node] = (Label){0.0, -1, 0, search->stamp, true};
    double reached = 0.0;
    while (node != goal) {
        if (open_neighbours(search, first, node, reached, own_set_only)) return -1;
        do {
            if (search->open.count == 0) {
                *length = HUGE_VAL;
                return 0;
            }
            Entry entry = heap_pop(&search->open);
            node = entry.index;
            reached = entry.length;
        } while (search->label[node].settled);
        search->label[node].settled = true;
    }
    *length = base->length + reached;
    /* the path is known backwards: fill the steps from the end */
    int count = base->count, at;
    for (node = goal; node != base->end[1];
         node = search->arcs->arc[search->label[node].arc].end[search->label[node].side])
        count += search->arcs->arc[search->label[node].arc].count;
    for (node = goal, at = count; node != base->end[1];) {
        const Label *label = &search->label[node];
        const Arc *arc = &search->arcs->arc[label->arc];
        for (int k = 0; k < arc->count; k++) {
            Step step = search->arcs->steps[label->side == 0 ? arc->first + arc->count - 1 - k : arc->first + k];
            if (label->side == 1) step.side = 1 - step.side;
            search->steps[--at] = step;
        }
        node = arc->end[label->side];
    }
    for (int k = 0; k < base->count; k++) search->steps[k] = search->arcs->steps[base->first + k];
    return count;
}

/* The cycle found for an arc can only grow as others are taken: one that grew goes back into the queue. */
static int take_shortest_first(CycleSearch *search)
{
    while (search->queue.count > 0) {
        Entry entry = heap_pop(&search->queue);
        if (arc_taken(search, entry.index)) continue;
        double length;
        int count = shortest_cycle(search, entry.index, false, &length);
        if (count == 0) count = shortest_cycle(search, entry.index, true, &length);
        if (count < 0) return -1;
        if (count == 0) continue;
        if (length > entry.length) {
            if (heap_push(&search->queue, (Entry){length, entry.index})) return -1;
        } else if (loop_accept(search->work, search->graph, search->steps, count, false) < 0) {
            return -1;
        }
    }
    return 0;
}

int surface_find_cycles(SurfaceWork *work, FreeGraph *graph, ArcGraph *arcs)
{
    CycleSearch search = {.work = work, .graph = graph, .arcs = arcs};
    search.label = memory_alloc((size_t)graph->node_count, sizeof *search.label);
    search.steps = memory_alloc((size_t)graph->edge_count, sizeof *search.steps);
    int failed = !search.label || !search.steps;
    for (int a = 0; a < arcs->arc_count && !failed; a++)
        failed = heap_push(&search.queue, (Entry){arcs->arc[a].length, a});
    failed = failed || take_shortest_first(&search);
    memory_free(search.label);
    memory_free(search.steps);
    memory_free(search.open.entry);
    memory_free(search.queue.entry);
    if (failed) {
        report_memory(work);
        return -1;
    }
    for (int e = 0; e < graph->edge_count; e++)
        if (!graph->edge[e].taken) {
            report_stray(work, &graph->edge[e]);
            return -1;
        }
    return 0;
}
