/* Words for what was found and done on a bag's surface. */
#include <stdio.h>

#include "airbag/surface_internal.h"

enum { REPORT_LOOPS = 20, REPORT_NODES = 6, REPORT_SHELLS = 10, TEXT_LENGTH = 160 };

/* Facets and volume of one closed shell, with the box around it. */
typedef struct ShellReport {
    int first, facets;
    double volume;
    double low[3], high[3];
} ShellReport;

static void note(const SurfaceWork *work, Severity severity, const char *text)
{
    diagnostics_add(work->diagnostics, severity, work->input->source, work->input->keyword, "%s: %s", work->input->name,
                    text);
}

void report_memory(const SurfaceWork *work)
{
    note(work, SEVERITY_ENVIRONMENT, "not enough memory to close the bag's surface");
}

void report_empty(const SurfaceWork *work)
{
    note(work, SEVERITY_ERROR, "the bag's surface has no shell or segment with three different nodes; check its set");
}

void report_one_sided(const SurfaceWork *work, int32_t a, int32_t b, int facet, int other)
{
    const SurfaceInput *input = work->input;
    char text[4 * TEXT_LENGTH];
    snprintf(
        text, sizeof text,
        "the surface cannot be oriented: on the edge between nodes %d and %d shells %d and %d are asked for opposite "
        "sides (a one-sided strip); correct the mesh there or take one of them out of the bag's set",
        input->node_id[a], input->node_id[b], input->facet_id[facet], input->facet_id[other]);
    note(work, SEVERITY_ERROR, text);
}

void report_branch(const SurfaceWork *work, const EdgeUse *uses, int count)
{
    const SurfaceInput *input = work->input;
    char list[TEXT_LENGTH] = "", text[4 * TEXT_LENGTH];
    int used = 0;
    for (int i = 0; i < count && i < REPORT_NODES; i++)
        used +=
            snprintf(list + used, sizeof list - (size_t)used, "%s%d", i ? ", " : "", input->facet_id[uses[i].facet]);
    snprintf(text, sizeof text,
             "the surface cannot be oriented: %d shells (%s%s) meet on the edge between nodes %d and %d and it is not "
             "clear which of them lie inside the bag; take the inner ones out of the bag's set",
             count, list, count > REPORT_NODES ? ", ..." : "", input->node_id[uses->from], input->node_id[uses->to]);
    note(work, SEVERITY_ERROR, text);
}

void report_stray(const SurfaceWork *work, const FreeEdge *edge)
{
    const SurfaceInput *input = work->input;
    char text[4 * TEXT_LENGTH];
    snprintf(
        text, sizeof text,
        "the bag is open: the free edge between nodes %d and %d (shell %d) belongs to no loop that could be capped; "
        "correct the mesh there",
        input->node_id[edge->node[0]], input->node_id[edge->node[1]], input->facet_id[edge->facet]);
    note(work, SEVERITY_ERROR, text);
}

/* The first nodes of a loop as text. */
static void list_nodes(const SurfaceWork *work, const int32_t *node, int count, char list[TEXT_LENGTH])
{
    int used = 0;
    list[0] = '\0';
    for (int i = 0; i < count && i < REPORT_NODES; i++)
        used += snprintf(list + used, TEXT_LENGTH - (size_t)used, "%s%d", i ? ", " : "", work->input->node_id[node[i]]);
    if (count > REPORT_NODES) snprintf(list + used, TEXT_LENGTH - (size_t)used, ", ...");
}

void report_open(const SurfaceWork *work, const Loop *loop, int facets, Severity severity)
{
    char list[TEXT_LENGTH], text[4 * TEXT_LENGTH];
    const int32_t *node = loop_nodes(work, loop);
    SurfaceCap cap = {.count = loop->count, .node = work->loop_node};
    cap_measure(&cap, work->input->x);
    list_nodes(work, node, loop->count, list);
    snprintf(
        text, sizeof text,
        "%s %d shells at node %d are a flat sheet that encloses nothing: their free-edge loop of %d edges (nodes %s; "
        "centre %g %g %g, size %g) is as large as the sheet; %s",
        severity == SEVERITY_ERROR ? "the bag is open: its" : "left out of the bag:", facets,
        work->input->node_id[node[0]], loop->count, list, cap.centre[0], cap.centre[1], cap.centre[2], cap.size,
        severity == SEVERITY_ERROR ? "add the missing part to the bag's set or merge the nodes along the loop"
                                   : "merge the nodes along the loop if they belong to the bag's wall");
    note(work, severity, text);
}

void report_large_caps(const SurfaceWork *work, int facet, double share)
{
    char text[4 * TEXT_LENGTH];
    snprintf(
        text, sizeof text,
        "the caps over the holes of the closed surface at shell %d have %.0f %% of its shells' area: is a part missing "
        "from the bag's set?",
        work->input->facet_id[facet], 100.0 * share);
    note(work, SEVERITY_WARNING, text);
}

static void report_caps(const SurfaceWork *work, const SurfaceClosure *closure)
{
    char list[TEXT_LENGTH], text[4 * TEXT_LENGTH];
    for (int i = 0; i < closure->holes; i++) {
        const SurfaceCap *cap = &closure->caps[i];
        bool far_from_plane = cap->planarity > 0.1;
        if (i >= REPORT_LOOPS && !far_from_plane) continue;
        list_nodes(work, cap->node, cap->count, list);
        int used = snprintf(
            text, sizeof text,
            "hole of %d edges capped: nodes %s; centre %g %g %g, size %g, area %g, out of plane %g of its size",
            cap->count, list, cap->centre[0], cap->centre[1], cap->centre[2], cap->size, cap->area, cap->planarity);
        if (work->input->fixed)
            used += snprintf(text + used, sizeof text - (size_t)used, ", %d of its nodes fixed", cap->fixed_count);
        if (far_from_plane)
            snprintf(text + used, sizeof text - (size_t)used,
                     "; far from plane, so that the bag's volume depends on the cap: close the hole with shells");
        note(work, far_from_plane ? SEVERITY_WARNING : SEVERITY_NOTE, text);
    }
    if (closure->holes > REPORT_LOOPS) {
        snprintf(text, sizeof text, "%d holes capped in all", closure->holes);
        note(work, SEVERITY_NOTE, text);
    }
    if (closure->seams > 0) {
        list_nodes(work, closure->caps[closure->holes].node, closure->caps[closure->holes].count, list);
        snprintf(text, sizeof text, "%d slivers of hanging nodes closed as seams, the first at nodes %s",
                 closure->seams, list);
        note(work, SEVERITY_NOTE, text);
    }
}

static void report_inner(const SurfaceWork *work, const SurfaceClosure *closure)
{
    if (closure->inner == 0) return;
    char text[4 * TEXT_LENGTH];
    int first = 0;
    while (!work->inner[first]) first++;
    snprintf(text, sizeof text,
             "%d shells, the first %d, bound no gas and take no pressure from the bag: %d in second layers on the same "
             "nodes, %d in flaps and tethers, %d in inner walls, %d in loose sheets",
             closure->inner, work->input->facet_id[first], work->layers, work->flaps, work->walls, work->sheets);
    note(work, SEVERITY_NOTE, text);
}

/* Gathers the shells; returns how many, at most REPORT_SHELLS are filled. */
static int gather_shells(SurfaceWork *work, const int *sign, ShellReport shell[REPORT_SHELLS])
{
    const SurfaceInput *input = work->input;
    int count = 0;
    for (int f = 0; f < input->facet_count; f++) {
        int flip, root = parity_find(&work->parity, f, &flip), i = 0;
        if (!work->active[f]) continue;
        if (f == root && count < REPORT_SHELLS) {
            const double *x = input->x + 3 * (size_t)input->node[4 * (size_t)f];
            shell[count] = (ShellReport){f, 0, sign[f] * work->volume[f], {x[0], x[1], x[2]}, {x[0], x[1], x[2]}};
        }
        count += f == root;
        while (i < count && i < REPORT_SHELLS && shell[i].first != root) i++;
        if (i == count || i == REPORT_SHELLS) continue;
        shell[i].facets++;
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 3; k++) {
                double x = input->x[3 * (size_t)input->node[4 * (size_t)f + (size_t)c] + (size_t)k];
                if (x < shell[i].low[k]) shell[i].low[k] = x;
                if (x > shell[i].high[k]) shell[i].high[k] = x;
            }
    }
    return count;
}

static void report_shells(SurfaceWork *work, const int *sign)
{
    ShellReport shell[REPORT_SHELLS];
    char text[4 * TEXT_LENGTH];
    int count = gather_shells(work, sign, shell);
    for (int i = 0; i < count && i < REPORT_SHELLS && count > 1; i++) {
        snprintf(text, sizeof text, "closed surface %d of %d: %d shells from shell %d on, volume %g", i + 1, count,
                 shell[i].facets, work->input->facet_id[shell[i].first], shell[i].volume);
        note(work, SEVERITY_NOTE, text);
        for (int j = 0; j < count && j < REPORT_SHELLS; j++) {
            bool within = i != j;
            for (int k = 0; k < 3; k++)
                within = within && shell[i].low[k] > shell[j].low[k] && shell[i].high[k] < shell[j].high[k];
            if (!within) continue;
            snprintf(
                text, sizeof text,
                "closed surface %d lies within the box around closed surface %d: both are turned outwards and their "
                "volumes are added; an inner wall that shall not hold gas belongs to a bag of its own",
                i + 1, j + 1);
            note(work, SEVERITY_WARNING, text);
        }
    }
    if (count > REPORT_SHELLS) {
        snprintf(text, sizeof text, "%d closed surfaces in all", count);
        note(work, SEVERITY_NOTE, text);
    }
}

void report_closure(SurfaceWork *work, const int *sign, const SurfaceClosure *closure)
{
    char text[4 * TEXT_LENGTH];
    snprintf(
        text, sizeof text,
        "%d shells in %d closed surface%s, %d turned to point outwards, %d free edges; volume %.9g, area %.9g without "
        "caps",
        work->input->facet_count, closure->components, closure->components == 1 ? "" : "s", closure->turned,
        closure->free_edges, closure->volume, closure->area);
    note(work, SEVERITY_NOTE, text);
    if (work->flat > 0) {
        snprintf(
            text, sizeof text,
            "%d of its closed surfaces start%s without volume, so that the outer side does not follow from the shape: "
            "the winding of most of the shells was kept",
            work->flat, work->flat == 1 ? "s" : "");
        note(work, SEVERITY_NOTE, text);
    }
    report_shells(work, sign);
    report_caps(work, closure);
    report_inner(work, closure);
}
