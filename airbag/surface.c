/* Orients a bag's facets outwards and closes its holes: the order of the steps and the result. */
#include <math.h>
#include <string.h>

#include "airbag/surface_internal.h"
#include "airbag/volume.h"
#include "solver/memory.h"

/* A closed shell in the winding of its lowest facet. */
typedef struct Shell {
    double volume, area, cap_area;
    int facets, against; /* facets, and how many of them are stored the other way */
    int largest_loop;    /* index of its loop with the largest cap, -1 without */
    double largest_area;
} Shell;

/* Middle and diagonal of the box around all facets. */
static void find_box(SurfaceWork *work)
{
    const SurfaceInput *input = work->input;
    double low[3], high[3], sum = 0.0;
    for (int k = 0; k < 3; k++) low[k] = high[k] = input->x[3 * (size_t)input->node[0] + (size_t)k];
    for (size_t i = 0; i < 4 * (size_t)input->facet_count; i++)
        for (int k = 0; k < 3; k++) {
            double x = input->x[3 * (size_t)input->node[i] + (size_t)k];
            low[k] = fmin(low[k], x);
            high[k] = fmax(high[k], x);
        }
    for (int k = 0; k < 3; k++) {
        work->origin[k] = 0.5 * (low[k] + high[k]);
        sum += (high[k] - low[k]) * (high[k] - low[k]);
    }
    work->size = sqrt(sum);
}

static int prepare(SurfaceWork *work)
{
    const SurfaceInput *input = work->input;
    size_t count = (size_t)input->facet_count;
    int corners = 0;
    work->active = memory_alloc(count + 1, sizeof *work->active);
    work->inner = memory_alloc(count + 1, sizeof *work->inner);
    work->sense = memory_alloc(count + 1, sizeof *work->sense);
    work->volume = memory_alloc(count + 1, sizeof *work->volume);
    if (!work->active || !work->inner || !work->sense || !work->volume) {
        report_memory(work);
        return -1;
    }
    for (size_t f = 0; f < count; f++) {
        int32_t corner[4];
        work->active[f] = facet_corners(input->node + 4 * f, corner) > 0;
        corners += work->active[f];
    }
    if (corners == 0) {
        report_empty(work);
        return -1;
    }
    find_box(work);
    return 0;
}

static int close_holes(SurfaceWork *work)
{
    FreeGraph graph;
    if (free_graph_build(&work->table, &graph)) {
        report_memory(work);
        return -1;
    }
    int result = surface_find_seams(work, &graph);
    if (result == 0) result = surface_find_loops(work, &graph);
    free_graph_free(&graph);
    work->loop_node = memory_alloc(work->loops.side_count + 1, sizeof *work->loop_node);
    if (result == 0 && !work->loop_node) {
        report_memory(work);
        return -1;
    }
    return result;
}

const int32_t *loop_nodes(const SurfaceWork *work, const Loop *loop)
{
    for (int i = 0; i < loop->count; i++) work->loop_node[i] = work->loops.sides[loop->start + (size_t)i].from;
    return work->loop_node;
}

int loop_flip(SurfaceWork *work, const Loop *loop, int *root)
{
    const LoopSide *side = &work->loops.sides[loop->start];
    int flip;
    *root = parity_find(&work->parity, side->facet, &flip);
    return -side->along * flip;
}

void surface_sum_volumes(SurfaceWork *work, double *volume)
{
    const SurfaceInput *input = work->input;
    for (int f = 0; f < input->facet_count; f++) {
        int flip, root = parity_find(&work->parity, f, &flip);
        if (work->active[f]) volume[root] += flip * volume_facet(input->node + 4 * (size_t)f, input->x, work->origin);
    }
    for (size_t i = 0; i < work->loops.count; i++) {
        const Loop *loop = &work->loops.loops[i];
        if (!work->active[work->loops.sides[loop->start].facet]) continue;
        int root, flip = loop_flip(work, loop, &root);
        volume[root] += flip * fan_volume(loop_nodes(work, loop), loop->count, input->x, work->origin);
    }
}

/* Gives each shell the sign of its volume; without volume the winding of most of its facets. Sets sign of all facets.
 */
static void turn_outwards(SurfaceWork *work, const Shell *shell, int *sign, SurfaceClosure *closure)
{
    for (int f = 0; f < work->input->facet_count; f++) {
        int flip, root = parity_find(&work->parity, f, &flip);
        sign[f] = work->inner[f] ? 0 : 1;
        closure->inner += work->inner[f];
        if (!work->active[f]) continue;
        const Shell *own = &shell[root];
        bool flat = shell_is_flat(own->volume, own->area);
        bool turn = flat ? 2 * own->against > own->facets : own->volume < 0.0;
        sign[f] = turn ? -flip : flip;
        closure->turned += sign[f] < 0;
        closure->components += f == root;
        work->flat += f == root && flat;
        if (f == root) closure->volume += turn ? -own->volume : own->volume;
        closure->area += volume_facet_area(work->input->node + 4 * (size_t)f, work->input->x);
    }
}

/* Turns the loops that still bound something into the closure's caps, holes first, seams after them. */
static int store_caps(SurfaceWork *work, const int *sign, SurfaceClosure *closure)
{
    size_t stored = 0;
    closure->caps = memory_alloc(work->loops.count + 1, sizeof *closure->caps);
    closure->node_store = memory_alloc(work->loops.side_count + 1, sizeof *closure->node_store);
    if (!closure->caps || !closure->node_store) {
        report_memory(work);
        return -1;
    }
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < work->loops.count; i++) {
            const Loop *loop = &work->loops.loops[i];
            const LoopSide *side = &work->loops.sides[loop->start];
            if (!work->active[side->facet] || loop->seam != (pass == 1)) continue;
            SurfaceCap *cap = &closure->caps[closure->cap_count++];
            cap->count = loop->count;
            cap->node = closure->node_store + stored;
            stored += (size_t)loop->count;
            /* the cap's outward walk goes against the facets' */
            bool backwards = side->along * sign[side->facet] > 0;
            for (int k = 0; k < loop->count; k++) {
                cap->node[k] = side[backwards ? loop->count - 1 - k : k].from;
                cap->fixed_count += work->input->fixed && work->input->fixed[cap->node[k]];
            }
            cap_measure(cap, work->input->x);
            closure->holes += pass == 0;
            closure->seams += pass == 1;
            if (pass == 0) closure->cap_area += cap->area;
            closure->free_edges += loop->count;
        }
    return 0;
}

bool shell_is_flat(double volume, double area)
{
    return fabs(volume) <= 1e-8 * area * sqrt(area);
}

/* Volumes, areas, windings and caps of the shells; marks loops that are narrow as seams. */
static void measure_shells(SurfaceWork *work, Shell *shell)
{
    const SurfaceInput *input = work->input;
    surface_sum_volumes(work, work->volume);
    for (int f = 0; f < input->facet_count; f++) {
        int flip, root = parity_find(&work->parity, f, &flip);
        shell[f].largest_loop = -1;
        shell[f].volume = work->volume[f];
        if (!work->active[f]) continue;
        shell[root].area += volume_facet_area(input->node + 4 * (size_t)f, input->x);
        shell[root].facets++;
        shell[root].against += flip < 0;
    }
    for (size_t i = 0; i < work->loops.count; i++) {
        Loop *loop = &work->loops.loops[i];
        SurfaceCap cap = {.count = loop->count, .node = work->loop_node};
        int root;
        loop_flip(work, loop, &root);
        loop->seam = loop->seam || loop_is_narrow(loop_nodes(work, loop), loop->count, input->x);
        cap_measure(&cap, input->x);
        if (loop->seam || !work->active[work->loops.sides[loop->start].facet]) continue;
        shell[root].cap_area += cap.area;
        if (shell[root].largest_loop < 0 || cap.area > shell[root].largest_area) {
            shell[root].largest_area = cap.area;
            shell[root].largest_loop = (int)i;
        }
    }
}

/* A sheet whose caps lie on itself encloses nothing. */
static bool shell_is_open(const Shell *shell)
{
    return shell->largest_loop >= 0 && shell->cap_area >= 0.95 * shell->area &&
           fabs(shell->volume) <= 1e-6 * shell->area * sqrt(shell->area);
}

/* Open sheets beside closed shells bound no gas and are left out; a bag of nothing else is an error. */
static int leave_out_open(SurfaceWork *work, const Shell *shell)
{
    enum { MOST_WARNINGS = 5 };
    int closed = 0, open = -1, warned = 0;
    for (int f = 0; f < work->input->facet_count; f++) {
        closed += shell[f].facets > 0 && !shell_is_open(&shell[f]);
        if (open < 0 && shell_is_open(&shell[f])) open = f;
    }
    if (closed == 0 && open >= 0) {
        report_open(work, &work->loops.loops[shell[open].largest_loop], shell[open].facets, SEVERITY_ERROR);
        return -1;
    }
    for (int f = 0; f < work->input->facet_count; f++) {
        int flip;
        const Shell *own = &shell[parity_find(&work->parity, f, &flip)];
        bool speak = own == &shell[f] && warned < MOST_WARNINGS;
        warned += speak && (shell_is_open(own) || own->cap_area > 0.5 * own->area);
        if (speak && shell_is_open(own))
            report_open(work, &work->loops.loops[own->largest_loop], own->facets, SEVERITY_WARNING);
        else if (speak && own->cap_area > 0.5 * own->area)
            report_large_caps(work, f, own->cap_area / own->area);
        if (!work->active[f] || !shell_is_open(own)) continue;
        work->inner[f] = true;
        work->active[f] = false;
        work->sheets++;
    }
    return 0;
}

static int finish(SurfaceWork *work, int *sign, SurfaceClosure *closure)
{
    size_t count = (size_t)work->input->facet_count;
    Shell *shell = memory_alloc(count, sizeof *shell);
    if (!shell) {
        report_memory(work);
        return -1;
    }
    measure_shells(work, shell);
    int result = leave_out_open(work, shell);
    if (result == 0) turn_outwards(work, shell, sign, closure);
    if (result == 0) result = store_caps(work, sign, closure);
    memory_free(shell);
    return result;
}

int surface_close(const SurfaceInput *input, int *sign, SurfaceClosure *closure, Diagnostics *diagnostics)
{
    SurfaceWork work = {.input = input, .diagnostics = diagnostics};
    memset(closure, 0, sizeof *closure);
    int result = prepare(&work);
    if (result == 0) result = surface_spread(&work);
    if (result == 0) result = surface_drop_layers(&work);
    if (result == 0) result = surface_drop_flaps(&work);
    if (result == 0) result = close_holes(&work);
    if (result == 0) result = surface_resolve_branches(&work);
    if (result == 0) result = finish(&work, sign, closure);
    if (result == 0)
        report_closure(&work, sign, closure);
    else
        surface_closure_free(closure);
    memory_free(work.active);
    memory_free(work.inner);
    memory_free(work.sense);
    memory_free(work.volume);
    memory_free(work.loop_node);
    memory_free(work.loops.loops);
    memory_free(work.loops.sides);
    edge_table_free(&work.table);
    parity_free(&work.parity);
    return result;
}
