/* *CONSTRAINED_RIGID_BODIES: which part leads which; and the cards of *CONSTRAINED_EXTRA_NODES that name no rigid part.
 */
#include <stddef.h>

#include "solver/motion_input.h"

static const char *const KEYWORD = "*CONSTRAINED_RIGID_BODIES";

/* A rigid part by its id, or -1 after an error. */
static int32_t find_rigid(const MotionInput *input, int id, const char *field, Source source, const char *keyword,
                          Diagnostics *diagnostics)
{
    int32_t part = id_map_find(&input->index->parts, id);
    if (part >= 0 && rigid_material(input, part)) return part;
    const Definitions *d = input->index->definitions;
    for (size_t k = 0; part < 0 && k < d->nodal_bodies.count; k++) {
        if (d->nodal_bodies.items[k].id != id) continue;
        diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                        "%s = %d is a nodal rigid body, to which nothing is joined here; put all nodes into its set, "
                        "or give its nodes to a rigid part by *CONSTRAINED_EXTRA_NODES_SET",
                        field, id);
        return -1;
    }
    diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                    part < 0 ? "%s = %d: there is no part of this id; define it or correct the card"
                             : "%s = %d is no rigid part; give it *MAT_RIGID or remove the card",
                    field, id);
    return -1;
}

static int merge(const MotionInput *input, const RigidMergeDefinition *card, int32_t *lead, Diagnostics *diagnostics)
{
    const PartDefinition *parts = input->index->definitions->parts.items;
    int32_t first = find_rigid(input, card->lead, "PIDL", card->source, KEYWORD, diagnostics);
    int32_t other = find_rigid(input, card->other, "PIDC", card->source, KEYWORD, diagnostics);
    if (first < 0 || other < 0) return -1;
    while (lead[first] != first) first = lead[first];
    if (lead[other] != other || first == other) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
                        first == other ? "part %d would lead itself; remove one of the cards that join it"
                                       : "part %d has been joined to another part by an earlier card; keep one of them",
                        card->other);
        return -1;
    }
    if (parts[other].has_inertia) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
                        "part %d has *PART_INERTIA, but is joined to part %d; give the inertia of them all to part %d",
                        card->other, card->lead, card->lead);
        return -1;
    }
    if (card->iflag != 0 && parts[first].has_inertia) {
        diagnostics_add(
            diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
            "IFLAG = %d: billow does not add the mass of part %d to that of *PART_INERTIA of part %d; put it "
            "into the card and set IFLAG = 0",
            card->iflag, card->other, card->lead);
        return -1;
    }
    lead[other] = first;
    return 0;
}

int rigid_merges_resolve(const MotionInput *input, int32_t *lead, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    int status = 0;
    for (size_t p = 0; p < d->parts.count; p++) lead[p] = (int32_t)p;
    for (size_t k = 0; k < d->merges.count; k++)
        if (merge(input, &d->merges.items[k], lead, diagnostics)) status = -1;
    for (size_t p = 0; p < d->parts.count; p++)
        while (lead[lead[p]] != lead[p]) lead[p] = lead[lead[p]];
    for (size_t k = 0; k < d->extra_nodes.count; k++) {
        const ExtraNodesDefinition *extra = &d->extra_nodes.items[k];
        if (find_rigid(input, extra->part, "PID", extra->source,
                       extra->is_set ? "*CONSTRAINED_EXTRA_NODES_SET" : "*CONSTRAINED_EXTRA_NODES_NODE",
                       diagnostics) < 0)
            status = -1;
    }
    return status;
}
