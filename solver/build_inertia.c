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
    memcpy(body->velocity, card->v, sizeof body->velocity);
    memcpy(body->spin, card->w, sizeof body->spin);
    return 1;
}
