/* *MAT_RIGID parts: which never move, which become rigid bodies, and their constraints. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/motion_input.h"

/* Global constraint codes of CON1 and CON2 (and TC of *NODE): which of x, y, z they fix. */
static const bool CODE_FIXES[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                      {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};

static const char *const KEYWORD = "*MAT_RIGID";

static const MaterialDefinition *rigid_material(const MotionInput *input, int32_t part)
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

static bool has_motion(const Definitions *d, int part_id)
{
    for (size_t m = 0; m < d->motions.count; m++) {
        if (d->motions.items[m].kind == MOTION_RIGID && d->motions.items[m].id == part_id) return true;
    }
    return false;
}

/* Gives the part's nodes its code; a node of two rigid parts is an error unless neither ever moves. */
static int claim_nodes(const MotionInput *input, Motion *motion, int32_t part, int code, const IndexList *nodes,
                       int32_t *owner, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    for (size_t k = 0; k < nodes->count; k++) {
        int32_t node = nodes->items[k];
        if (owner[node] > 0 && !(code == MOTION_FIXED && motion->node_body[node] == MOTION_FIXED)) {
            diagnostics_add(
                diagnostics, SEVERITY_ERROR, d->parts.items[part].source, "*PART",
                "rigid parts %d and %d share node %d; LS-DYNA needs *CONSTRAINED_RIGID_BODIES for that: give "
                "the parts nodes of their own or make them one part",
                d->parts.items[owner[node] - 1].id, d->parts.items[part].id, d->nodes.items[node].id);
            return -1;
        }
        owner[node] = part + 1;
        motion->node_body[node] = code;
        if (code == MOTION_FIXED) motion->fixed[node] = 1;
    }
    return 0;
}

/* Takes the nodes into a new body. */
static int add_body(Motion *motion, const RigidBody *draft, const IndexList *nodes)
{
    RigidBody *body = &motion->rigid_bodies[motion->rigid_body_count];
    *body = *draft;
    body->node_count = (int)nodes->count;
    body->node = memory_alloc(nodes->count, sizeof *body->node);
    if (!body->node) return -1;
    memcpy(body->node, nodes->items, nodes->count * sizeof *body->node);
    motion->rigid_body_count++;
    return 0;
}

static int build_part(const MotionInput *input, Motion *motion, int32_t part, int32_t *owner, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    const MaterialDefinition *material = rigid_material(input, part);
    if (!material) return 0;
    RigidBody draft = {.part_id = d->parts.items[part].id};
    int status = refuse_coupling(material, diagnostics);
    if (read_constraints(input, material, &draft, diagnostics)) status = -1;
    bool moves = has_motion(d, draft.part_id);
    for (int i = 0; i < 3; i++) moves = moves || !draft.fix_translation[i] || !draft.fix_rotation[i];
    motion->part_body[part] = moves ? motion->rigid_body_count : MOTION_FIXED;
    IndexList nodes = {0};
    if (sets_part_nodes(input->index, &part, 1, &nodes)) {
        index_list_free(&nodes);
        return motion_no_memory(KEYWORD, diagnostics);
    }
    if (nodes.count == 0) {
        motion->part_body[part] = MOTION_FIXED; /* no shells: nothing to move */
    } else {
        if (claim_nodes(input, motion, part, motion->part_body[part], &nodes, owner, diagnostics)) status = -1;
        if (moves && add_body(motion, &draft, &nodes)) status = motion_no_memory(KEYWORD, diagnostics);
    }
    index_list_free(&nodes);
    return status;
}

int build_rigid_bodies(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    size_t nodes = d->nodes.count, parts = d->parts.count;
    motion->node_count = (int)nodes;
    motion->part_body = memory_alloc(parts + 1, sizeof *motion->part_body);
    motion->node_body = memory_alloc(nodes + 1, sizeof *motion->node_body);
    motion->fixed = memory_alloc(nodes + 1, sizeof *motion->fixed);
    motion->velocity = memory_alloc(3 * nodes + 1, sizeof *motion->velocity);
    motion->rigid_bodies = memory_alloc(parts + 1, sizeof *motion->rigid_bodies);
    int32_t *owner = memory_alloc(nodes + 1, sizeof *owner); /* part + 1 */
    int status = 0;
    if (!motion->part_body || !motion->node_body || !motion->fixed || !motion->velocity || !motion->rigid_bodies ||
        !owner) {
        status = motion_no_memory(KEYWORD, diagnostics);
    } else {
        for (size_t p = 0; p < parts; p++) motion->part_body[p] = MOTION_DEFORMABLE;
        for (size_t n = 0; n < nodes; n++) motion->node_body[n] = MOTION_DEFORMABLE;
        for (size_t p = 0; p < parts; p++) {
            if (build_part(input, motion, (int32_t)p, owner, diagnostics)) status = -1;
        }
    }
    memory_free(owner);
    return status;
}
