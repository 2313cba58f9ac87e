/* *LOAD_NODE and *LOAD_SEGMENT; gravity and damping are in build_classes.c. */
#include <stddef.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/motion_input.h"

typedef struct PointList {
    NodeLoad *items;
    size_t count, capacity;
} PointList;

/* DOF, CID and the follower's nodes. */
static int read_direction(const MotionInput *input, const NodeLoadDefinition *card, const char *keyword, NodeLoad *load,
                          Diagnostics *diagnostics)
{
    if (card->dof == 4) {
        static const char *const fields[] = {"M1", "M2", "M3"};
        int ids[3] = {card->m1, card->m2, card->m3}, status = 0;
        for (int k = 0; k < 3; k++) {
            load->m[k] = motion_find_node(input, ids[k], fields[k], card->source, keyword, diagnostics);
            if (load->m[k] < 0) status = -1;
        }
        load->follower = true;
        return status;
    }
    if (card->dof < 1 || card->dof > 3) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword,
                        "DOF = %d %s; use 1, 2, 3, or 4 for a force that follows a plane", card->dof,
                        card->dof >= 5 && card->dof <= 8 ? "is a moment, which nodes of membranes do not take"
                                                         : "is no degree of freedom");
        return -1;
    }
    double axes[9];
    if (motion_find_axes(input, card->cid, card->source, keyword, axes, diagnostics)) return -1;
    memcpy(load->direction, axes + 3 * (card->dof - 1), sizeof load->direction);
    return 0;
}

static int add_point_load(const MotionInput *input, const Motion *motion, const NodeLoadDefinition *card,
                          PointList *list, Diagnostics *diagnostics)
{
    const char *keyword = card->is_set ? "*LOAD_NODE_SET" : "*LOAD_NODE_POINT";
    NodeLoad load = {.scale = card->sf};
    IndexList nodes = {0};
    int status = read_direction(input, card, keyword, &load, diagnostics);
    load.curve = motion_find_curve(input, card->lcid, "LCID", card->source, keyword, diagnostics);
    if (load.curve == -1) status = -1;
    if (motion_find_nodes(input, card->is_set, card->id, card->source, keyword, &nodes, diagnostics)) status = -1;
    for (size_t k = 0; k < nodes.count && status == 0 && load.curve >= 0; k++) {
        load.node = nodes.items[k];
        if (motion->fixed[load.node]) continue;
        if (memory_reserve((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items)) {
            status = motion_no_memory(keyword, diagnostics);
        } else {
            list->items[list->count++] = load;
        }
    }
    index_list_free(&nodes);
    return status;
}

static int build_point_loads(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    PointList list = {0};
    int status = 0;
    for (size_t k = 0; k < d->node_loads.count; k++) {
        if (add_point_load(input, motion, &d->node_loads.items[k], &list, diagnostics)) status = -1;
    }
    motion->loads.node_loads = list.items;
    motion->loads.node_load_count = (int)list.count;
    return status;
}

/* Nodes of the card's segments, four each. */
static int find_segments(const MotionInput *input, const SegmentLoadDefinition *card, const char *keyword,
                         IndexList *out, Diagnostics *diagnostics)
{
    static const char *const fields[] = {"N1", "N2", "N3", "N4"};
    if (card->is_set) return sets_resolve_segments(input->index, card->id, card->source, keyword, out, diagnostics);
    int status = 0;
    out->count = 0;
    for (int k = 0; k < 4; k++) {
        int id = k == 3 && card->node[3] == 0 ? card->node[2] : card->node[k];
        int32_t node = motion_find_node(input, id, fields[k], card->source, keyword, diagnostics);
        if (node < 0) {
            status = -1;
        } else if (index_list_add(out, node)) {
            return motion_no_memory(keyword, diagnostics);
        }
    }
    return status;
}

/* Grows the segment arrays together. */
static int grow_segments(Motion *motion, int count)
{
    size_t wanted = (size_t)(motion->segment_count + count);
    int32_t *node = memory_resize(motion->segment_node, 4 * wanted, sizeof *node);
    if (node) motion->segment_node = node;
    int *load = memory_resize(motion->segment_load, wanted, sizeof *load);
    if (load) motion->segment_load = load;
    Source *source = memory_resize(motion->segment_source, wanted, sizeof *source);
    if (source) motion->segment_source = source;
    return node && load && source ? 0 : -1;
}

static int add_segment_load(const MotionInput *input, Motion *motion, const SegmentLoadDefinition *card,
                            Diagnostics *diagnostics)
{
    const char *keyword = card->is_set ? "*LOAD_SEGMENT_SET" : "*LOAD_SEGMENT";
    IndexList nodes = {0};
    int curve = motion_find_curve(input, card->lcid, "LCID", card->source, keyword, diagnostics);
    int status = curve == -1 ? -1 : 0;
    if (find_segments(input, card, keyword, &nodes, diagnostics)) status = -1;
    int count = (int)(nodes.count / 4);
    if (status == 0 && curve >= 0 && count > 0) {
        if (grow_segments(motion, count)) {
            status = motion_no_memory(keyword, diagnostics);
        } else {
            memcpy(motion->segment_node + 4 * (size_t)motion->segment_count, nodes.items,
                   nodes.count * sizeof *nodes.items);
            for (int s = 0; s < count; s++) {
                motion->segment_load[motion->segment_count + s] = motion->segment_load_count;
                motion->segment_source[motion->segment_count + s] = card->source;
            }
            motion->segment_count += count;
            motion->segment_loads[motion->segment_load_count++] = (SegmentLoad){curve, card->sf, card->at};
        }
    }
    index_list_free(&nodes);
    return status;
}

static int build_segment_loads(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    int status = 0;
    if (d->segment_loads.count == 0) return 0;
    motion->segment_loads = memory_alloc(d->segment_loads.count, sizeof *motion->segment_loads);
    if (!motion->segment_loads) return motion_no_memory("*LOAD_SEGMENT", diagnostics);
    for (size_t k = 0; k < d->segment_loads.count; k++) {
        if (add_segment_load(input, motion, &d->segment_loads.items[k], diagnostics)) status = -1;
    }
    return status;
}

int build_loads(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    if (!motion_ready(motion)) return -1;
    int status = build_point_loads(input, motion, diagnostics);
    if (build_segment_loads(input, motion, diagnostics)) status = -1;
    if (build_rigid_loads(input, motion, diagnostics)) status = -1;
    if (build_body_classes(input, motion, diagnostics)) status = -1;
    return status;
}
