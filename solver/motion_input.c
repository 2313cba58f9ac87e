/* Nodes, parts, curves and axes by the ids of a card, with messages that name it. */
#include "solver/motion_input.h"

#include <string.h>

#include "solver/coordinates.h"

int motion_no_memory(const char *keyword, Diagnostics *diagnostics)
{
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, keyword, "not enough memory");
    return -1;
}

int motion_find_body(const MotionInput *input, const Motion *motion, int id)
{
    const Definitions *d = input->index->definitions;
    int32_t part = id_map_find(&input->index->parts, id);
    if (part >= 0) return motion->part_body[part];
    for (int b = 0; b < motion->rigid_body_count; b++)
        if (motion->rigid_bodies[b].nodal && motion->rigid_bodies[b].part_id == id) return b;
    for (size_t k = 0; k < d->nodal_bodies.count; k++)
        if (d->nodal_bodies.items[k].id == id) return MOTION_FIXED;
    return -3;
}

int32_t motion_find_node(const MotionInput *input, int id, const char *field, Source source, const char *keyword,
                         Diagnostics *diagnostics)
{
    int32_t node = id_map_find(&input->index->nodes, id);
    if (node < 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                        "%s = %d: there is no node of this id; define it or correct the card", field, id);
    }
    return node;
}

int motion_find_nodes(const MotionInput *input, bool is_set, int id, Source source, const char *keyword, IndexList *out,
                      Diagnostics *diagnostics)
{
    if (is_set) return sets_resolve_nodes(input->index, id, source, keyword, out, diagnostics);
    out->count = 0;
    int32_t node = motion_find_node(input, id, "NID", source, keyword, diagnostics);
    if (node < 0) return -1;
    return index_list_add(out, node) ? motion_no_memory(keyword, diagnostics) : 0;
}

int motion_find_parts(const MotionInput *input, bool is_set, int id, Source source, const char *keyword, IndexList *out,
                      Diagnostics *diagnostics)
{
    if (is_set) return sets_resolve_parts(input->index, id, source, keyword, out, diagnostics);
    out->count = 0;
    int32_t part = id_map_find(&input->index->parts, id);
    if (part < 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                        "PID = %d: there is no part of this id; define it or correct the card", id);
        return -1;
    }
    return index_list_add(out, part) ? motion_no_memory(keyword, diagnostics) : 0;
}

int motion_find_curve(const MotionInput *input, int id, const char *field, Source source, const char *keyword,
                      Diagnostics *diagnostics)
{
    const Definitions *definitions = input->index->definitions;
    int curve = deck_index_curve(input->index, id, field, source, keyword, diagnostics);
    if (curve < 0 || definitions->curves.items[curve].sidr != (input->relaxation_phase ? 0 : 1)) return curve;
    int flag = definitions->control.relaxation.given ? definitions->control.relaxation.idrflg : 0;
    if (flag == 1 || flag == 5) return -2;
    diagnostics_add(diagnostics, SEVERITY_NOTE, source, keyword,
                    "curve %d acts in dynamic relaxation only (SIDR = 1): this card has no effect", id);
    return -2;
}

int motion_find_axes(const MotionInput *input, int cid, Source source, const char *keyword, double axes[9],
                     Diagnostics *diagnostics)
{
    CoordinateSystem system;
    if (coordinates_resolve_system(input->index, cid, source, keyword, &system, diagnostics)) return -1;
    if (system.moves) {
        diagnostics_add(
            diagnostics, SEVERITY_ERROR, source, keyword,
            "coordinate system %d moves with the model (FLAG = 1 or NID); billow applies this card in fixed "
            "axes only: set FLAG = 0, or give the axes by *DEFINE_COORDINATE_SYSTEM",
            cid);
        return -1;
    }
    memcpy(axes, system.axes, sizeof system.axes);
    return 0;
}

int motion_compare_supports(const void *a, const void *b)
{
    const Support *p = a, *q = b;
    if (p->node != q->node) return p->node < q->node ? -1 : 1;
    if (p->birth != q->birth) return p->birth < q->birth ? -1 : 1;
    if (p->death != q->death) return p->death < q->death ? -1 : 1;
    return memcmp(p->axes, q->axes, sizeof p->axes);
}

int motion_compare_motions(const void *a, const void *b)
{
    const PrescribedMotion *p = a, *q = b;
    if ((p->node < 0) != (q->node < 0)) return p->node < 0 ? 1 : -1;
    if (p->node != q->node) return p->node < q->node ? -1 : 1;
    if (p->rigid_body != q->rigid_body) return p->rigid_body < q->rigid_body ? -1 : 1;
    return (p->order > q->order) - (p->order < q->order);
}
