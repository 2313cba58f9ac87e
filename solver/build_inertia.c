/* Mass, centre and inertia of a rigid body from *PART_INERTIA or *CONSTRAINED_NODAL_RIGID_BODY_INERTIA. */
#include <string.h>

#include "solver/motion_input.h"
#include "solver/vector3.h"

/* The body's card, and the keyword it stands in; NULL if it has none. */
static const InertiaCard *find_card(const MotionInput *input, const RigidBody *body, const char **keyword)
{
    const Definitions *d = input->index->definitions;
    *keyword = body->nodal ? "*CONSTRAINED_NODAL_RIGID_BODY_INERTIA" : "*PART_INERTIA";
    for (size_t k = 0; body->nodal && k < d->nodal_bodies.count; k++)
        if (d->nodal_bodies.items[k].id == body->part_id)
            return d->nodal_bodies.items[k].has_inertia ? &d->nodal_bodies.items[k].inertia : NULL;
    int32_t part = body->nodal ? -1 : id_map_find(&input->index->parts, body->part_id);
    return part >= 0 && d->parts.items[part].has_inertia ? &d->parts.items[part].inertia : NULL;
}

/* Rows: the axes in which the tensor is given. */
static int find_axes(const MotionInput *input, const InertiaCard *card, const char *keyword, double axes[9],
                     Diagnostics *diagnostics)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(axes, identity, sizeof identity);
    if (card->ircs == 0) return 0;
    if (card->cid != 0) return motion_find_axes(input, card->cid, card->axes_source, keyword, axes, diagnostics);
    memcpy(axes, card->x_axis, sizeof card->x_axis);
    vector3_cross(card->x_axis, card->in_plane, axes + 6);
    if (vector3_normalize(axes) > 0 && vector3_normalize(axes + 6) > 0) {
        vector3_cross(axes + 6, axes, axes + 3);
        return 0;
    }
    diagnostics_add(
        diagnostics, SEVERITY_ERROR, card->axes_source, keyword,
        "XL, YL, ZL and XLIP, YLIP, ZLIP are zero or parallel; give the local x axis and a vector in the local "
        "xy plane, or CID");
    return -1;
}

/* Global tensor A^T I A of the local one. */
static void turn_tensor(const double axes[9], const double local[6], double tensor[9])
{
    const double full[9] = {local[0], local[1], local[2], local[1], local[3], local[4], local[2], local[4], local[5]};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++) sum += axes[3 * k + i] * full[3 * k + l] * axes[3 * l + j];
            tensor[3 * i + j] = sum;
        }
}

/* Axes about which the body has no inertia do not turn, whatever spin the card gives. */
static void warn_of_zero(const RigidBody *body, const InertiaCard *card, const char *keyword, Diagnostics *diagnostics)
{
    const double *moment = body->inertia;
    if (moment[0] > 0 && moment[1] > 0 && moment[2] > 0) return;
    diagnostics_add(diagnostics, SEVERITY_WARNING, card->tensor_source, keyword,
                    "rigid body %d does not turn about axes without inertia: its principal moments are %g, %g, %g; "
                    "give IXX to IZZ",
                    body->part_id, moment[0], moment[1], moment[2]);
}

/* Mass that deformable shells give to the body's nodes, and its moments about the principal axes. */
static void fabric_on_body(const MotionInput *input, const Motion *motion, int number, double *mass, double moment[3])
{
    const RigidBody *body = &motion->rigid_bodies[number];
    const DeckIndex *index = input->index;
    const Definitions *d = index->definitions;
    for (size_t p = 0; p < d->parts.count; p++) {
        if (motion->part_body[p] != MOTION_DEFORMABLE) continue;
        for (int32_t k = index->part_shell_start[p]; k < index->part_shell_start[p + 1]; k++) {
            const ShellDefinition *shell = &d->shells.items[index->part_shell[k]];
            int corners = shell->node[3] == shell->node[2] ? 3 : 4;
            double share = input->shell_mass[index->part_shell[k]] / corners, arm[3], local[3];
            for (int c = 0; c < corners; c++) {
                int32_t node = id_map_find(&index->nodes, shell->node[c]);
                if (node < 0 || motion->node_body[node] != number) continue;
                vector3_subtract(input->x + 3 * (size_t)node, body->centre, arm);
                matrix3_apply(body->axes, arm, local);
                double square = vector3_dot(local, local);
                *mass += share;
                for (int i = 0; i < 3; i++) moment[i] += share * (square - local[i] * local[i]);
            }
        }
    }
}

void rigid_inertia_check(const MotionInput *input, const Motion *motion, int number, Diagnostics *diagnostics)
{
    const RigidBody *body = &motion->rigid_bodies[number];
    const char *keyword;
    const InertiaCard *card = find_card(input, body, &keyword);
    double mass = 0, moment[3] = {0, 0, 0};
    if (!card || !input->shell_mass) return;
    fabric_on_body(input, motion, number, &mass, moment);
    if (mass > body->mass)
        diagnostics_add(diagnostics, SEVERITY_WARNING, card->source, keyword,
                        "TM = %g of rigid body %d is less than the %g that deformable shells give to its nodes: the "
                        "stable step is too long for it; raise TM or lower TSSFAC",
                        card->tm, body->part_id, mass);
    for (int i = 0; i < 3; i++) {
        if (!(body->inertia[i] > 0) || moment[i] <= body->inertia[i]) continue;
        diagnostics_add(diagnostics, SEVERITY_WARNING, card->tensor_source, keyword,
                        "the moment of inertia %g of rigid body %d about (%.4g, %.4g, %.4g) is less than the %g of "
                        "the deformable shells at its nodes: the stable step is too long for it; correct the moments "
                        "or lower TSSFAC",
                        body->inertia[i], body->part_id, body->axes[3 * i], body->axes[3 * i + 1],
                        body->axes[3 * i + 2], moment[i]);
        return;
    }
}

int rigid_inertia_apply(const MotionInput *input, RigidBody *body, Diagnostics *diagnostics)
{
    const char *keyword;
    const InertiaCard *card = find_card(input, body, &keyword);
    double axes[9], tensor[9], centre[3];
    if (!card) return 0;
    int status = find_axes(input, card, keyword, axes, diagnostics);
    memcpy(centre, card->centre, sizeof centre);
    if (card->nodeid != 0) {
        int32_t node = motion_find_node(input, card->nodeid, "NODEID", card->source, keyword, diagnostics);
        if (node < 0) return -1;
        memcpy(centre, input->x + 3 * (size_t)node, sizeof centre);
    }
    if (!(card->tm > 0)) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword,
                        "TM = %g must be positive: it is the mass of rigid body %d", card->tm, body->part_id);
        status = -1;
    }
    if (status) return -1;
    turn_tensor(axes, card->i, tensor);
    if (rigid_body_give_inertia(body, input->x, card->tm, centre, tensor)) {
        diagnostics_add(
            diagnostics, SEVERITY_ERROR, card->tensor_source, keyword,
            "the moments of inertia of rigid body %d are those of no body: its principal moments %g, %g, %g must "
            "not be negative, nor one larger than the sum of the others",
            body->part_id, body->inertia[0], body->inertia[1], body->inertia[2]);
        return -1;
    }
    warn_of_zero(body, card, keyword, diagnostics);
    memcpy(body->velocity, card->v, sizeof body->velocity);
    memcpy(body->spin, card->w, sizeof body->spin);
    return 1;
}
