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
    int64_t budget; /* nodes that may still be looked at in all; then the holes left are closed as they come */
} CycleSearch;

enum { MOST_VISITED = 4096 }; /* nodes in one search: no hole touches that many others */

/* What a path may do. */
typedef enum PathRule {
    PATH_ANY_SET, /* pass from one set of facets to another, but not around the corner of a single facet */
    PATH_OWN_SET, /* stay with one set, whose free edges can always be closed */
} PathRule;

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

/* The facet at the arc's end. */
static int end_facet(const CycleSearch *search, int arc, int side)
{
    const Arc *own = &search->arcs->arc[arc];
    return search->graph->edge[search->arcs->steps[side == 0 ? own->first : own->first + own->count - 1].edge].facet;
}

/* Whether an arc may follow the path from the first arc to node: no set of facets is walked both ways. */
static bool arc_fits(CycleSearch *search, int first, int node, int arc, int side, PathRule rule)
{
    const ArcGraph *arcs = search->arcs;
    int sense, other, root = arc_sense(search, arc, side, &sense), own = arc_sense(search, first, 0, &other);
    if (root == own && sense != other) return false;
    if (rule == PATH_OWN_SET) return root == own;
    bool at_start = node == arcs->arc[first].end[1], at_goal = arcs->arc[arc].end[1 - side] == arcs->arc[first].end[0];
    int before = at_start ? end_facet(search, first, 1)
                          : end_facet(search, search->label[node].arc, 1 - search->label[node].side);
    if (before == end_facet(search, arc, side)) return false;
    if (at_goal && end_facet(search, arc, 1 - side) == end_facet(search, first, 0)) return false;
    while (root != own && node != arcs->arc[first].end[1]) {
        const Label *label = &search->label[node];
        search->budget--;
        if (arc_sense(search, label->arc, label->side, &other) == root) return sense == other;
        node = arcs->arc[label->arc].end[label->side];
    }
    return true;
}

/* Opens the neighbours of node, which was reached by a path of the given length. */
static int open_neighbours(CycleSearch *search, int first, int node, double length, PathRule rule)
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
        if (!arc_fits(search, first, node, index, side, rule)) continue;
        *label = (Label){sum, index, side, search->stamp, false};
        if (heap_push(&search->open, (Entry){sum, next})) return -1;
    }
    return 0;
}

/* The arc's steps when walked from its end side; returns their number. */
static int arc_steps(const CycleSearch *search, int arc, int side, Step *steps)
{
    const Arc *own = &search->arcs->arc[arc];
    for (int k = 0; k < own->count; k++) {
        steps[k] = search->arcs->steps[own->first + (side == 0 ? k : own->count - 1 - k)];
        if (side == 1) steps[k].side = 1 - steps[k].side;
    }
    return own->count;
}

/* Steps of the first arc and of the path found back to its start, which is known backwards. */
static int cycle_steps(const CycleSearch *search, int first)
{
    const Arc *base = &search->arcs->arc[first];
    int count = base->count, at;
    for (int node = base->end[0]; node != base->end[1];) {
        const Label *label = &search->label[node];
        count += search->arcs->arc[label->arc].count;
        node = search->arcs->arc[label->arc].end[label->side];
    }
    at = count;
    for (int node = base->end[0]; node != base->end[1];) {
        const Label *label = &search->label[node];
        at -= search->arcs->arc[label->arc].count;
        arc_steps(search, label->arc, label->side, search->steps + at);
        node = search->arcs->arc[label->arc].end[label->side];
    }
    arc_steps(search, first, 0, search->steps);
    return count;
}

/* Shortest cycle through an arc, its steps into search->steps and its length. Returns the number of its steps, 0 if
 * there is none within reach, -1 without memory. */
static int shortest_cycle(CycleSearch *search, int first, PathRule rule, double *length)
{
    const Arc *base = &search->arcs->arc[first];
    int goal = base->end[0], node = base->end[1];
    search->open.count = 0;
    search->stamp++;
    search->label[node] = (Label){0.0, -1, 0, search->stamp, true};
    double reached = 0.0;
    for (int visited = 0; node != goal; visited++) {
        if (visited == MOST_VISITED || --search->budget < 0) return 0;
        if (open_neighbours(search, first, node, reached, rule)) return -1;
        do {
            if (search->open.count == 0) return 0;
            Entry entry = heap_pop(&search->open);
            node = entry.index;
            reached = entry.length;
        } while (search->label[node].settled);
        search->label[node].settled = true;
    }
    *length = base->length + reached;
    return cycle_steps(search, first);
}

/* The cycle found for an arc can only grow as others are taken: one that grew goes back into the queue. */
static int take_shortest_first(CycleSearch *search)
{
    while (search->queue.count > 0 && search->budget > 0) {
        Entry entry = heap_pop(&search->queue);
        if (arc_taken(search, entry.index)) continue;
        double length = 0.0;
        int count = shortest_cycle(search, entry.index, PATH_ANY_SET, &length);
        if (count == 0) count = shortest_cycle(search, entry.index, PATH_OWN_SET, &length);
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

/* The next arc from node in the same set and sense, with its side; -1 if there is none. */
static Entry next_of_set(CycleSearch *search, int node, int root, int sense)
{
    for (int i = search->arcs->start[node]; i < search->arcs->start[node + 1]; i++) {
        int arc = search->arcs->incident[i], own;
        for (int side = 0; side < 2 && !arc_taken(search, arc); side++)
            if (search->arcs->arc[arc].end[side] == node && arc_sense(search, arc, side, &own) == root && own == sense)
                return (Entry){side, arc};
    }
    return (Entry){0.0, -1};
}

/* Walks the free edges of one set as they come and takes a loop whenever the walk meets itself. The path lies in
 * search->open: arcs with their sides. Returns 0, or -1 without memory. */
static int walk_out(CycleSearch *search, int first)
{
    int sense, root = arc_sense(search, first, 0, &sense), node = search->arcs->arc[first].end[0];
    Heap *path = &search->open;
    path->count = 0;
    search->stamp++;
    for (;;) {
        Label *label = &search->label[node];
        if (label->stamp == search->stamp &&
            label->arc < (int)path->count) { /* met: take the loop off the path's end */
            int count = 0;
            for (size_t i = (size_t)label->arc; i < path->count; i++) {
                int side = path->entry[i].length > 0.0;
                search->label[search->arcs->arc[path->entry[i].index].end[side]].stamp = 0;
                count += arc_steps(search, path->entry[i].index, side, search->steps + count);
            }
            path->count = (size_t)label->arc;
            if (loop_accept(search->work, search->graph, search->steps, count, false) < 0) return -1;
        }
        *label = (Label){0.0, (int)path->count, 0, search->stamp, false};
        Entry next = next_of_set(search, node, root, sense);
        if (next.index < 0) return 0;
        if (memory_reserve((void **)&path->entry, &path->capacity, path->count + 1, sizeof *path->entry)) return -1;
        path->entry[path->count++] = next;
        node = search->arcs->arc[next.index].end[next.length > 0.0 ? 0 : 1];
    }
}

/* Closes every arc; 0, or -1 without memory. */
static int take_all(CycleSearch *search)
{
    for (int a = 0; a < search->arcs->arc_count; a++)
        if (heap_push(&search->queue, (Entry){search->arcs->arc[a].length, a})) return -1;
    if (take_shortest_first(search)) return -1;
    for (int a = 0; a < search->arcs->arc_count; a++)
        if (!arc_taken(search, a) && walk_out(search, a)) return -1;
    return 0;
}

int surface_find_cycles(SurfaceWork *work, FreeGraph *graph, ArcGraph *arcs)
{
    CycleSearch search = {.work = work, .graph = graph, .arcs = arcs};
    search.label = memory_alloc((size_t)graph->node_count, sizeof *search.label);
    search.steps = memory_alloc((size_t)graph->edge_count, sizeof *search.steps);
    search.budget = 1000000 + 128 * (int64_t)arcs->arc_count;
    int failed = !search.label || !search.steps || take_all(&search);
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
