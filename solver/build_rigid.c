/* *MAT_RIGID parts, alone or merged, and nodal rigid bodies: which never move, which become bodies, what holds them. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/motion_input.h"

/* Global constraint codes of CON1 and CON2 (and TC of *NODE): which of x, y, z they fix. */
static const bool CODE_FIXES[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                      {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};

static const char *const KEYWORD = "*MAT_RIGID";

const MaterialDefinition *rigid_material(const MotionInput *input, int32_t part)
{
    const Definitions *d = input->index->definitions;
    int32_t found = id_map_find(&input->index->materials, d->parts.items[part].material);
    if (found < 0 || d->materials.items[found].kind != MATERIAL_RIGID) return NULL;
    return &d->materials.items[found];
}

/* A code 0 to 7 in a real field. */
static int read_code(const MaterialDefinition *material, double value, const char *field, bool fixed[3],
                     Diagnostics *diagnostics)
{
    if (!(value >= 0 && value <= 7) || value != floor(value)) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, material->source, KEYWORD,
                        "%s = %g of material %d is none of the codes 0 to 7", field, value, material->id);
        return -1;
    }
    memcpy(fixed, CODE_FIXES[(int)value], 3 * sizeof *fixed);
    return 0;
}

/* CMO = -1: CON1 is a coordinate system, CON2 six digits 0 or 1 for x y z and rotations about them. */
static int read_local(const MotionInput *input, const MaterialDefinition *material, RigidBody *body,
                      Diagnostics *diagnostics)
{
    const RigidCard *card = &material->rigid;
    long digits = (long)card->con2;
    bool good = card->con2 >= 0 && card->con2 <= 111111 && card->con2 == floor(card->con2);
    for (int i = 5; i >= 0 && good; i--, digits /= 10) {
        good = digits % 10 <= 1;
        bool *target = i < 3 ? &body->fix_translation[i] : &body->fix_rotation[i - 3];
        *target = digits % 10 == 1;
    }
    if (!good) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, material->source, KEYWORD,
                        "CON2 = %g of material %d: with CMO = -1 it must be six digits 0 or 1, such as 110111",
                        card->con2, material->id);
        return -1;
    }
    return motion_find_axes(input, (int)card->con1, material->source, KEYWORD, body->constraint_axes, diagnostics);
}

/* Constraints of the material into the body; -1 after an error. */
static int read_constraints(const MotionInput *input, const MaterialDefinition *material, RigidBody *body,
                            Diagnostics *diagnostics)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const RigidCard *card = &material->rigid;
    memcpy(body->constraint_axes, identity, sizeof identity);
    if (card->cmo == 0) return 0;
    if (card->cmo == -1) return read_local(input, material, body, diagnostics);
    if (card->cmo != 1) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, material->source, KEYWORD,
                        "CMO = %g of material %d is none of -1, 0, 1", card->cmo, material->id);
        return -1;
    }
    int status = read_code(material, card->con1, "CON1", body->fix_translation, diagnostics);
    return read_code(material, card->con2, "CON2", body->fix_rotation, diagnostics) ? -1 : status;
}

static int refuse_coupling(const MaterialDefinition *material, Diagnostics *diagnostics)
{
    const RigidCard *card = &material->rigid;
    const char *field = card->couple != 0 ? "COUPLE" : card->m != 0 ? "M" : card->alias[0] ? "ALIAS" : NULL;
    if (!field) return 0;
    diagnostics_add(diagnostics, SEVERITY_ERROR, material->source, KEYWORD,
                    "%s of material %d couples the body to another program, which billow does not do; leave it blank",
                    field, material->id);
    return -1;
}

static bool has_motion(const Definitions *d, int id)
{
    for (size_t m = 0; m < d->motions.count; m++) {
        if (d->motions.items[m].kind == MOTION_RIGID && d->motions.items[m].id == id) return true;
    }
    return false;
}

/* One body in the making: a lead part with those merged into it, or a node set. */
typedef struct Group {
    RigidBody draft;
    int code;    /* index of the body, or MOTION_FIXED */
    bool driven; /* some prescribed motion names it */
    IndexList nodes;
    Source source; /* of the card that messages name */
    const char *keyword;
} Group;

/* The tables while bodies are collected. */
typedef struct Bodies {
    int32_t *lead;  /* of each part: the part whose body it belongs to; itself if it was not merged (part count) */
    int32_t *owner; /* of each node: number of its group + 1 (node count) */
    int *group_id;  /* user's id of each group (part count + nodal bodies) */
    int group_count;
} Bodies;

static int compare_indices(const void *a, const void *b)
{
    const int32_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* Ascending, each once. */
static void sort_nodes(IndexList *nodes)
{
    if (nodes->count < 2) return;
    qsort(nodes->items, nodes->count, sizeof *nodes->items, compare_indices);
    size_t kept = 1;
    for (size_t k = 1; k < nodes->count; k++)
        if (nodes->items[k] != nodes->items[kept - 1]) nodes->items[kept++] = nodes->items[k];
    nodes->count = kept;
}

/* Gives the group's nodes its code; a node of two bodies is an error unless neither ever moves. */
static int claim_nodes(const MotionInput *input, Motion *motion, const Group *group, Bodies *bodies,
                       Diagnostics *diagnostics)
{
    int status = 0;
    for (size_t k = 0; k < group->nodes.count; k++) {
        int32_t node = group->nodes.items[k];
        int before = bodies->owner[node];
        if (before > 0 && !(group->code == MOTION_FIXED && motion->node_body[node] == MOTION_FIXED)) {
            if (status == 0)
                diagnostics_add(diagnostics, SEVERITY_ERROR, group->source, group->keyword,
                                "rigid bodies %d and %d share node %d; join the parts by *CONSTRAINED_RIGID_BODIES, or "
                                "give each nodes of its own",
                                bodies->group_id[before - 1], group->draft.part_id,
                                input->index->definitions->nodes.items[node].id);
            status = -1;
            continue;
        }
        bodies->owner[node] = bodies->group_count + 1;
        motion->node_body[node] = group->code;
        if (group->code == MOTION_FIXED) motion->fixed[node] = 1;
    }
    bodies->group_id[bodies->group_count++] = group->draft.part_id;
    return status;
}

/* Takes the nodes into a new body. */
static int add_body(Motion *motion, const Group *group)
{
    RigidBody *body = &motion->rigid_bodies[motion->rigid_body_count];
    *body = group->draft;
    body->node_count = (int)group->nodes.count;
    body->node = memory_alloc(group->nodes.count, sizeof *body->node);
    if (!body->node) return -1;
    memcpy(body->node, group->nodes.items, group->nodes.count * sizeof *body->node);
    motion->rigid_body_count++;
    return 0;
}

/* Decides whether the group moves, and takes it in; frees its nodes. */
static int close_group(const MotionInput *input, Motion *motion, Group *group, Bodies *bodies, Diagnostics *diagnostics)
{
    bool moves = group->driven || has_motion(input->index->definitions, group->draft.part_id);
    int status = 0;
    for (int i = 0; i < 3; i++) moves = moves || !group->draft.fix_translation[i] || !group->draft.fix_rotation[i];
    group->code = moves && group->nodes.count > 0 ? motion->rigid_body_count : MOTION_FIXED;
    sort_nodes(&group->nodes);
    if (group->nodes.count > 0) {
        status = claim_nodes(input, motion, group, bodies, diagnostics);
        if (moves && add_body(motion, group)) status = motion_no_memory(KEYWORD, diagnostics);
    }
    index_list_free(&group->nodes);
    return status;
}

/* Nodes of *CONSTRAINED_EXTRA_NODES for the parts of this lead. */
static int add_extra_nodes(const MotionInput *input, const Bodies *bodies, int32_t lead, Group *group,
                           Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    int status = 0;
    for (size_t k = 0; k < d->extra_nodes.count; k++) {
        const ExtraNodesDefinition *extra = &d->extra_nodes.items[k];
        const char *keyword = extra->is_set ? "*CONSTRAINED_EXTRA_NODES_SET" : "*CONSTRAINED_EXTRA_NODES_NODE";
        int32_t part = id_map_find(&input->index->parts, extra->part);
        IndexList nodes = {0};
        if (part < 0 || bodies->lead[part] != lead) continue;
        if (motion_find_nodes(input, extra->is_set, extra->id, extra->source, keyword, &nodes, diagnostics))
            status = -1;
        for (size_t n = 0; n < nodes.count; n++)
            if (index_list_add(&group->nodes, nodes.items[n])) status = motion_no_memory(keyword, diagnostics);
        if (extra->iflag != 0 && d->parts.items[lead].has_inertia) {
            diagnostics_add(diagnostics, SEVERITY_ERROR, extra->source, keyword,
                            "IFLAG = %d: billow does not add the nodes' mass to that of *PART_INERTIA of part %d; put "
                            "it into the card and set IFLAG = 0",
                            extra->iflag, extra->part);
            status = -1;
        }
        if (nodes.count > 0) {
            group->draft.merged = true;
            group->source = extra->source;
            group->keyword = keyword;
        }
        index_list_free(&nodes);
    }
    return status;
}

/* The body of one lead part with all that were merged into it. */
static int build_part(const MotionInput *input, Motion *motion, int32_t lead, Bodies *bodies, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    const MaterialDefinition *material = rigid_material(input, lead);
    if (!material || bodies->lead[lead] != lead) return 0;
    Group group = {
        .draft = {.part_id = d->parts.items[lead].id}, .source = d->parts.items[lead].source, .keyword = "*PART"};
    IndexList parts = {0};
    int status = refuse_coupling(material, diagnostics);
    if (read_constraints(input, material, &group.draft, diagnostics)) status = -1;
    for (size_t p = 0; p < d->parts.count; p++)
        if (bodies->lead[p] == lead && rigid_material(input, (int32_t)p) && index_list_add(&parts, (int32_t)p))
            status = motion_no_memory(KEYWORD, diagnostics);
    for (size_t k = 0; k < parts.count; k++)
        group.driven = group.driven || has_motion(d, d->parts.items[parts.items[k]].id);
    group.draft.merged = parts.count > 1;
    if (sets_part_nodes(input->index, parts.items, parts.count, &group.nodes))
        status = motion_no_memory(KEYWORD, diagnostics);
    if (add_extra_nodes(input, bodies, lead, &group, diagnostics)) status = -1;
    if (close_group(input, motion, &group, bodies, diagnostics)) status = -1;
    for (size_t k = 0; k < parts.count; k++) motion->part_body[parts.items[k]] = group.code;
    index_list_free(&parts);
    return status;
}

/* One *CONSTRAINED_NODAL_RIGID_BODY. */
static int build_nodal(const MotionInput *input, Motion *motion, const NodalRigidBodyDefinition *card, Bodies *bodies,
                       Diagnostics *diagnostics)
{
    static const char *const keyword = "*CONSTRAINED_NODAL_RIGID_BODY";
    const MaterialDefinition held = {.id = card->id,
                                     .source = card->has_spc ? card->spc_source : card->source,
                                     .rigid = {.cmo = card->cmo, .con1 = card->con1, .con2 = card->con2}};
    Group group = {
        .draft = {.part_id = card->id, .nodal = true, .merged = true}, .source = card->source, .keyword = keyword};
    int status = read_constraints(input, &held, &group.draft, diagnostics);
    if (id_map_find(&input->index->parts, card->id) >= 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword,
                        "PID = %d is the number of a *PART as well; a nodal rigid body needs one of its own", card->id);
        status = -1;
    }
    if (sets_resolve_nodes(input->index, card->nsid, card->source, keyword, &group.nodes, diagnostics)) status = -1;
    if (close_group(input, motion, &group, bodies, diagnostics)) status = -1;
    return status;
}

int build_rigid_bodies(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    size_t nodes = d->nodes.count, parts = d->parts.count, bodies_at_most = parts + d->nodal_bodies.count;
    motion->node_count = (int)nodes;
    motion->part_body = memory_alloc(parts + 1, sizeof *motion->part_body);
    motion->node_body = memory_alloc(nodes + 1, sizeof *motion->node_body);
    motion->fixed = memory_alloc(nodes + 1, sizeof *motion->fixed);
    motion->velocity = memory_alloc(3 * nodes + 1, sizeof *motion->velocity);
    motion->rigid_bodies = memory_alloc(bodies_at_most + 1, sizeof *motion->rigid_bodies);
    Bodies bodies = {.lead = memory_alloc(parts + 1, sizeof *bodies.lead),
                     .owner = memory_alloc(nodes + 1, sizeof *bodies.owner),
                     .group_id = memory_alloc(bodies_at_most + 1, sizeof *bodies.group_id)};
    int status = 0;
    if (!motion->part_body || !motion->node_body || !motion->fixed || !motion->velocity || !motion->rigid_bodies ||
        !bodies.lead || !bodies.owner || !bodies.group_id) {
        status = motion_no_memory(KEYWORD, diagnostics);
    } else {
        for (size_t p = 0; p < parts; p++) motion->part_body[p] = MOTION_DEFORMABLE;
        for (size_t n = 0; n < nodes; n++) motion->node_body[n] = MOTION_DEFORMABLE;
        status = rigid_merges_resolve(input, bodies.lead, diagnostics);
        for (size_t p = 0; p < parts; p++) {
            if (build_part(input, motion, (int32_t)p, &bodies, diagnostics)) status = -1;
        }
        for (size_t k = 0; k < d->nodal_bodies.count; k++) {
            if (build_nodal(input, motion, &d->nodal_bodies.items[k], &bodies, diagnostics)) status = -1;
        }
    }
    memory_free(bodies.lead);
    memory_free(bodies.owner);
    memory_free(bodies.group_id);
    return status;
}
