/* *INITIAL_VELOCITY, _NODE, _GENERATION and _RIGID_BODY. */
#include <stddef.h>
#include <string.h>

#include "solver/coordinates.h"
#include "solver/memory.h"
#include "solver/motion_input.h"
#include "solver/vector3.h"

static const char *keyword_of(const InitialVelocityDefinition *card)
{
    switch (card->kind) {
    case VELOCITY_ALL:
        return "*INITIAL_VELOCITY";
    case VELOCITY_NODE:
        return "*INITIAL_VELOCITY_NODE";
    case VELOCITY_GENERATION:
        return "*INITIAL_VELOCITY_GENERATION";
    default:
        return "*INITIAL_VELOCITY_RIGID_BODY";
    }
}

/* Global components of a vector given in the card's system ICID. */
static int to_global(const MotionInput *input, const InitialVelocityDefinition *card, const double local[3],
                     double global[3], Diagnostics *diagnostics)
{
    CoordinateSystem system; /* initial values: a system that moves later serves as well */
    if (coordinates_resolve_system(input->index, card->icid, card->source, keyword_of(card), &system, diagnostics))
        return -1;
    matrix3_apply_transposed(system.axes, local, global);
    return 0;
}

/* The nodes of a card: a set, or all (id 0). */
static int find_nodes(const MotionInput *input, const InitialVelocityDefinition *card, bool all, IndexList *nodes,
                      Diagnostics *diagnostics)
{
    if (!all) {
        return sets_resolve_nodes(input->index, card->id, card->source, keyword_of(card), nodes, diagnostics);
    }
    nodes->count = 0;
    for (size_t n = 0; n < input->index->definitions->nodes.count; n++) {
        if (index_list_add(nodes, (int32_t)n)) return motion_no_memory(keyword_of(card), diagnostics);
    }
    return 0;
}

/* *INITIAL_VELOCITY: the set's nodes in the box; exempted nodes get their own velocity wherever they are. */
static int set_all(const MotionInput *input, const InitialVelocityDefinition *card, double *velocity,
                   Diagnostics *diagnostics)
{
    IndexList nodes = {0}, exempt = {0};
    const BoxDefinition *box = NULL;
    double v[3], v_exempt[3];
    int status = find_nodes(input, card, card->id == 0, &nodes, diagnostics);
    if (card->boxid > 0) {
        box = coordinates_resolve_box(input->index, card->boxid, card->source, keyword_of(card), diagnostics);
        if (!box) status = -1;
    }
    if (card->nsidex > 0 &&
        sets_resolve_nodes(input->index, card->nsidex, card->source, keyword_of(card), &exempt, diagnostics))
        status = -1;
    if (to_global(input, card, card->v, v, diagnostics) ||
        to_global(input, card, card->vx_exempt, v_exempt, diagnostics))
        status = -1;
    if (status == 0) {
        for (size_t k = 0; k < nodes.count; k++) {
            int32_t node = nodes.items[k];
            if (box && !coordinates_in_box(box, input->x + 3 * (size_t)node)) continue;
            memcpy(velocity + 3 * (size_t)node, v, sizeof v);
        }
        for (size_t k = 0; k < exempt.count; k++)
            memcpy(velocity + 3 * (size_t)exempt.items[k], v_exempt, sizeof v_exempt);
    }
    index_list_free(&nodes);
    index_list_free(&exempt);
    return status;
}

static int set_node(const MotionInput *input, const InitialVelocityDefinition *card, double *velocity,
                    Diagnostics *diagnostics)
{
    double v[3];
    int32_t node = motion_find_node(input, card->id, "NID", card->source, keyword_of(card), diagnostics);
    if (to_global(input, card, card->v, v, diagnostics) || node < 0) return -1;
    memcpy(velocity + 3 * (size_t)node, v, sizeof v);
    return 0;
}

/* Point and unit direction of the axis of rotation; NX = -999: through nodes NY and NZ. */
static int read_axis(const MotionInput *input, const InitialVelocityDefinition *card, double point[3], double axis[3],
                     Diagnostics *diagnostics)
{
    const char *keyword = keyword_of(card);
    if (card->axis[0] == -999) {
        int32_t first = motion_find_node(input, (int)card->axis[1], "NY", card->source, keyword, diagnostics);
        int32_t second = motion_find_node(input, (int)card->axis[2], "NZ", card->source, keyword, diagnostics);
        if (first < 0 || second < 0) return -1;
        memcpy(point, input->x + 3 * (size_t)first, 3 * sizeof *point);
        vector3_subtract(input->x + 3 * (size_t)second, point, axis);
    } else {
        memcpy(point, card->centre, sizeof card->centre);
        if (to_global(input, card, card->axis, axis, diagnostics)) return -1;
    }
    if (vector3_normalize(axis) > 0 || card->omega == 0) return 0;
    diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword,
                    "OMEGA = %g needs an axis; NX, NY, NZ are all zero or the two nodes coincide", card->omega);
    return -1;
}

static int generation_nodes(const MotionInput *input, const InitialVelocityDefinition *card, IndexList *nodes,
                            Diagnostics *diagnostics)
{
    if (card->id == 0) return find_nodes(input, card, true, nodes, diagnostics);
    if (card->styp == 3) return find_nodes(input, card, false, nodes, diagnostics);
    if (card->styp != 1 && card->styp != 2) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword_of(card),
                        "STYP = %d is none of 1 (part set), 2 (part), 3 (node set)", card->styp);
        return -1;
    }
    IndexList parts = {0};
    int status =
        motion_find_parts(input, card->styp == 1, card->id, card->source, keyword_of(card), &parts, diagnostics);
    if (status == 0 && sets_part_nodes(input->index, parts.items, parts.count, nodes))
        status = motion_no_memory(keyword_of(card), diagnostics);
    index_list_free(&parts);
    return status;
}

/* IRIGID = 1: bodies of these nodes take their velocities in place of those of their INERTIA cards. */
static void mark_overwritten(Motion *motion, const IndexList *nodes)
{
    for (size_t k = 0; k < nodes->count; k++)
        if (motion->node_body[nodes->items[k]] >= 0)
            motion->rigid_bodies[motion->node_body[nodes->items[k]]].overwritten = true;
}

static int set_generation(const MotionInput *input, const InitialVelocityDefinition *card, Motion *motion,
                          Diagnostics *diagnostics)
{
    double *velocity = motion->velocity;
    double v[3], point[3], axis[3];
    IndexList nodes = {0};
    int status = generation_nodes(input, card, &nodes, diagnostics);
    if (to_global(input, card, card->v, v, diagnostics) || read_axis(input, card, point, axis, diagnostics))
        status = -1;
    for (size_t k = 0; k < nodes.count && status == 0; k++) {
        double arm[3], turning[3];
        size_t n = 3 * (size_t)nodes.items[k];
        vector3_subtract(input->x + n, point, arm);
        vector3_cross(axis, arm, turning);
        for (size_t i = 0; i < 3; i++) velocity[n + i] = v[i] + card->omega * turning[i];
    }
    if (card->irigid == 1 && status == 0) mark_overwritten(motion, &nodes);
    index_list_free(&nodes);
    return status;
}

/* Velocity and spin of a body with the momentum and angular momentum of its nodes. */
static void body_from_nodes(RigidBody *body, const double *x, const double *mass, const double *velocity)
{
    double momentum[3] = {0, 0, 0}, angular[3] = {0, 0, 0}, local[3];
    for (int k = 0; k < body->node_count; k++) {
        size_t n = 3 * (size_t)body->node[k];
        double m = mass[body->node[k]], arm[3], part[3];
        vector3_subtract(x + n, body->centre, arm);
        vector3_cross(arm, velocity + n, part);
        for (size_t i = 0; i < 3; i++) {
            momentum[i] += m * velocity[n + i];
            angular[i] += m * part[i];
        }
    }
    matrix3_apply(body->axes, angular, local);
    for (int i = 0; i < 3; i++) {
        body->velocity[i] = body->mass > 0 ? momentum[i] / body->mass : 0;
        local[i] = body->inertia[i] > 0 ? local[i] / body->inertia[i] : 0;
    }
    matrix3_apply_transposed(body->axes, local, body->spin);
    /* What is only the rounding of a sum of equal velocities is no spin. */
    double reach = 0, speed = vector3_norm(body->velocity);
    for (int k = 0; k < body->node_count; k++) {
        double r = vector3_norm(body->offset + 3 * (size_t)k);
        if (r > reach) reach = r;
    }
    if (vector3_norm(body->spin) * reach <= 1e-12 * speed) memset(body->spin, 0, sizeof body->spin);
}

/* A body whose inertia a card gives and that IRIGID lets move as its nodes do; their masses only weigh them. */
static int given_body_from_nodes(RigidBody *body, const double *x, const double *mass, const double *velocity)
{
    RigidBody lumped = {.node_count = body->node_count, .node = body->node};
    double arm[3], turning[3];
    bool moves = false;
    for (int k = 0; k < body->node_count; k++)
        for (size_t i = 0; i < 3; i++) moves = moves || velocity[3 * (size_t)body->node[k] + i] != 0;
    if (!moves) return 0;
    int status = rigid_body_build(&lumped, x, mass);
    if (status == 0) {
        body_from_nodes(&lumped, x, mass, velocity);
        vector3_subtract(body->centre, lumped.centre, arm);
        vector3_cross(lumped.spin, arm, turning);
        for (int i = 0; i < 3; i++) body->velocity[i] = lumped.velocity[i] + turning[i];
        memcpy(body->spin, lumped.spin, sizeof body->spin);
    }
    memory_free(lumped.offset);
    return status < 0 ? -1 : 0;
}

/* The first card that gives nodes a velocity; there is one where nodes have any. */
static const InitialVelocityDefinition *nodes_card(const MotionInput *input)
{
    const Definitions *d = input->index->definitions;
    size_t k = 0;
    while (k + 1 < d->velocities.count && d->velocities.items[k].kind == VELOCITY_RIGID_BODY) k++;
    return &d->velocities.items[k];
}

/* The velocities of an INERTIA card go before those of nodes, as in LS-DYNA with IRIGID = 0; if the two differ, that is
 * told. */
static int keep_card(const MotionInput *input, RigidBody *body, const double *mass, const double *velocity,
                     Diagnostics *diagnostics)
{
    double v[3], spin[3], change[3], turn[3];
    memcpy(v, body->velocity, sizeof v);
    memcpy(spin, body->spin, sizeof spin);
    int status = given_body_from_nodes(body, input->x, mass, velocity);
    vector3_subtract(body->velocity, v, change);
    vector3_subtract(body->spin, spin, turn);
    if (vector3_norm(change) > 1e-9 * vector3_norm(v) || vector3_norm(turn) > 1e-9 * vector3_norm(spin))
        diagnostics_add(
            diagnostics, SEVERITY_WARNING, nodes_card(input)->source, keyword_of(nodes_card(input)),
            "rigid body %d starts with the velocity (%g, %g, %g) and spin (%g, %g, %g) of its INERTIA card, "
            "as in LS-DYNA, not with what *INITIAL_VELOCITY gives its nodes; set IRIGID there, or use "
            "*INITIAL_VELOCITY_RIGID_BODY",
            body->part_id, v[0], v[1], v[2], spin[0], spin[1], spin[2]);
    memcpy(body->velocity, v, sizeof v);
    memcpy(body->spin, spin, sizeof spin);
    return status;
}

/* IRIGID of *INITIAL_VELOCITY: bodies with INERTIA cards whose centre is in the box (-1), all (-2), or those of a part
 * set. */
static int overwrite_bodies(const MotionInput *input, const InitialVelocityDefinition *card, Motion *motion,
                            Diagnostics *diagnostics)
{
    IndexList parts = {0};
    const BoxDefinition *box = NULL;
    double v[3], spin[3];
    if (card->irigid == 0) return 0;
    if (card->irigid < -2) {
        diagnostics_add(
            diagnostics, SEVERITY_ERROR, card->source, keyword_of(card),
            "IRIGID = %d is none of 0, -1 (all rigid bodies with INERTIA cards in the box), -2 (all) or a part "
            "set",
            card->irigid);
        return -1;
    }
    if (card->irigid > 0 &&
        motion_find_parts(input, true, card->irigid, card->source, keyword_of(card), &parts, diagnostics))
        return -1;
    if (card->boxid > 0 && card->irigid != -2)
        box = coordinates_resolve_box(input->index, card->boxid, card->source, keyword_of(card), diagnostics);
    int status = to_global(input, card, card->v, v, diagnostics) || to_global(input, card, card->w, spin, diagnostics);
    for (int b = 0; !status && b < motion->rigid_body_count; b++) {
        RigidBody *body = &motion->rigid_bodies[b];
        bool named = card->irigid < 0;
        for (size_t k = 0; k < parts.count && !named; k++) named = motion->part_body[parts.items[k]] == b;
        if (!named || !body->given || (box && !coordinates_in_box(box, body->centre))) continue;
        memcpy(body->velocity, v, sizeof v);
        memcpy(body->spin, spin, sizeof spin);
        body->overwritten = true;
    }
    index_list_free(&parts);
    return status ? -1 : 0;
}

static int set_rigid_body(const MotionInput *input, const InitialVelocityDefinition *card, Motion *motion,
                          Diagnostics *diagnostics)
{
    int found = motion_find_body(input, motion, card->id);
    if (found == -3 || found == MOTION_DEFORMABLE) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword_of(card),
                        found == -3
                            ? "PID = %d: there is no part of this id; define it or correct the card"
                            : "PID = %d is no rigid part; give it *MAT_RIGID or use *INITIAL_VELOCITY_GENERATION",
                        card->id);
        return -1;
    }
    if (found == MOTION_FIXED) {
        diagnostics_add(diagnostics, SEVERITY_WARNING, card->source, keyword_of(card),
                        "part %d is fixed by CON1 and CON2 of its *MAT_RIGID; its velocity stays zero", card->id);
        return 0;
    }
    RigidBody *body = &motion->rigid_bodies[found];
    body->overwritten = true;
    if (to_global(input, card, card->v, body->velocity, diagnostics)) return -1;
    return to_global(input, card, card->w, body->spin, diagnostics);
}

/* Nodes of bodies take the velocity that the body starts with, constraints heeded. */
static void place_bodies(const MotionInput *input, Motion *motion)
{
    for (int b = 0; b < motion->rigid_body_count; b++) {
        const RigidBody *body = &motion->rigid_bodies[b];
        RigidState start;
        rigid_body_start(body, &start);
        for (int k = 0; k < body->node_count; k++) {
            size_t n = 3 * (size_t)body->node[k];
            double arm[3], turning[3];
            vector3_subtract(input->x + n, body->centre, arm);
            vector3_cross(start.spin, arm, turning);
            for (size_t i = 0; i < 3; i++) motion->velocity[n + i] = start.v[i] + turning[i];
        }
    }
}

/* Cards of one kind, in deck order; later ones overwrite earlier ones. */
static int run_cards(const MotionInput *input, Motion *motion, int kind, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    int status = 0;
    for (size_t k = 0; k < d->velocities.count; k++) {
        const InitialVelocityDefinition *card = &d->velocities.items[k];
        int result = 0;
        if ((int)card->kind != kind) continue;
        switch (card->kind) {
        case VELOCITY_ALL:
            result = set_all(input, card, motion->velocity, diagnostics);
            break;
        case VELOCITY_NODE:
            result = set_node(input, card, motion->velocity, diagnostics);
            break;
        case VELOCITY_GENERATION:
            result = set_generation(input, card, motion, diagnostics);
            break;
        case VELOCITY_RIGID_BODY:
            result = set_rigid_body(input, card, motion, diagnostics);
            break;
        }
        if (result) status = -1;
    }
    return status;
}

int build_velocities(const MotionInput *input, const double *mass, Motion *motion, Diagnostics *diagnostics)
{
    if (!motion_ready(motion)) return -1;
    int status = run_cards(input, motion, VELOCITY_ALL, diagnostics);
    if (run_cards(input, motion, VELOCITY_GENERATION, diagnostics)) status = -1;
    if (run_cards(input, motion, VELOCITY_NODE, diagnostics)) status = -1;
    for (int b = 0; b < motion->rigid_body_count; b++) {
        RigidBody *body = &motion->rigid_bodies[b];
        if (!body->offset) continue;
        if (!body->given)
            body_from_nodes(body, input->x, mass, motion->velocity);
        else if (body->overwritten && given_body_from_nodes(body, input->x, mass, motion->velocity))
            status = motion_no_memory("*INITIAL_VELOCITY", diagnostics);
    }
    const Definitions *d = input->index->definitions;
    for (size_t k = 0; k < d->velocities.count; k++)
        if (d->velocities.items[k].kind == VELOCITY_ALL &&
            overwrite_bodies(input, &d->velocities.items[k], motion, diagnostics))
            status = -1;
    if (run_cards(input, motion, VELOCITY_RIGID_BODY, diagnostics)) status = -1;
    for (int b = 0; b < motion->rigid_body_count; b++) {
        RigidBody *body = &motion->rigid_bodies[b];
        if (body->offset && body->given && !body->overwritten &&
            keep_card(input, body, mass, motion->velocity, diagnostics))
            status = motion_no_memory("*INITIAL_VELOCITY", diagnostics);
    }
    place_bodies(input, motion);
    for (int n = 0; n < motion->node_count; n++) {
        if (motion->fixed[n]) memset(motion->velocity + 3 * (size_t)n, 0, 3 * sizeof *motion->velocity);
    }
    constraints_start(&motion->constraints, motion->velocity);
    return status;
}
