/* *BOUNDARY_PRESCRIBED_MOTION_NODE, _SET and _RIGID. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "solver/coordinates.h"
#include "solver/memory.h"
#include "solver/motion_input.h"
#include "solver/vector3.h"

typedef struct MotionList {
    PrescribedMotion *items;
    size_t count, capacity;
} MotionList;

static const char *keyword_of(const PrescribedMotionDefinition *card)
{
    switch (card->kind) {
    case MOTION_NODE:
        return "*BOUNDARY_PRESCRIBED_MOTION_NODE";
    case MOTION_SET:
        return "*BOUNDARY_PRESCRIBED_MOTION_SET";
    default:
        return "*BOUNDARY_PRESCRIBED_MOTION_RIGID";
    }
}

static int refuse(const PrescribedMotionDefinition *card, const char *field, int value, const char *advice,
                  Diagnostics *diagnostics)
{
    diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword_of(card), "%s = %d %s", field, value, advice);
    return -1;
}

/* DOF and VID into direction, rotation and only_direction. */
static int read_direction(const MotionInput *input, const PrescribedMotionDefinition *card, PrescribedMotion *out,
                          Diagnostics *diagnostics)
{
    int dof = card->dof, size = dof < 0 ? -dof : dof;
    bool rigid = card->kind == MOTION_RIGID;
    if (size >= 9 && size <= 11) {
        return refuse(card, "DOF", dof, "(rotation about a point of the plane) is not in billow; use 1 to 4",
                      diagnostics);
    }
    if (size == 0 || size > 8 || (dof < 0 && size != 4 && size != 8)) {
        return refuse(card, "DOF", dof, "is no degree of freedom; use 1 to 4, -4, or for rigid bodies 1 to 8",
                      diagnostics);
    }
    if (dof < 0 && rigid) return refuse(card, "DOF", dof, "does not apply to rigid bodies; use 4 or 8", diagnostics);
    if (size >= 5 && !rigid)
        return refuse(card, "DOF", dof, "is a rotation, which nodes of membranes do not have; use 1 to 4 or -4",
                      diagnostics);
    out->rotation = size >= 5;
    out->only_direction = dof == -4;
    if (size == 4 || size == 8) {
        return coordinates_resolve_vector(input->index, card->vid, card->source, keyword_of(card), out->direction,
                                          diagnostics);
    }
    out->direction[(size - 1) % 4] = 1;
    return 0;
}

/* A displacement that does not start at zero would be made up within the first step. */
static void check_start(const MotionInput *input, const PrescribedMotionDefinition *card,
                        const PrescribedMotion *motion, Diagnostics *diagnostics)
{
    if (input->relaxed || motion->vad != 2 || motion->rotation || motion->birth > 0) return;
    const CurveDefinition *curve = &input->index->definitions->curves.items[motion->curve];
    size_t k = 0;
    while (k + 1 < curve->x.count && curve->x.items[k + 1] * curve->sfa + curve->offa * curve->sfa <= 0) k++;
    if (curve->y.count <= k) return;
    double x0 = (curve->x.items[k] + curve->offa) * curve->sfa, y0 = (curve->y.items[k] + curve->offo) * curve->sfo;
    if (x0 < 0 && k + 1 < curve->y.count) {
        double x1 = (curve->x.items[k + 1] + curve->offa) * curve->sfa;
        double y1 = (curve->y.items[k + 1] + curve->offo) * curve->sfo;
        if (x1 > x0) y0 += (y1 - y0) * (0 - x0) / (x1 - x0);
    }
    double peak = 0;
    for (size_t i = 0; i < curve->y.count; i++) {
        double y = fabs((curve->y.items[i] + curve->offo) * curve->sfo);
        if (y > peak) peak = y;
    }
    if (fabs(y0) <= 1e-9 * peak) return;
    diagnostics_add(
        diagnostics, SEVERITY_WARNING, card->source, keyword_of(card),
        "the displacement curve %d is %g at time 0: the jump is made within the first step; start the curve "
        "at zero",
        card->lcid, y0 * motion->scale);
}

/* All fields but the node or body. Returns 1 if the card has no effect. */
static int read_card(const MotionInput *input, const PrescribedMotionDefinition *card, PrescribedMotion *out,
                     Diagnostics *diagnostics)
{
    *out = (PrescribedMotion){.node = -1, .rigid_body = -1};
    out->vad = card->vad;
    out->scale = card->sf;
    out->birth = card->birth;
    out->death = card->death > 0 ? card->death : 1e28;
    int status = read_direction(input, card, out, diagnostics);
    if (card->vad < 0 || card->vad > 2) {
        status =
            refuse(card, "VAD", card->vad,
                   "is not in billow; use 0 (velocity), 1 (acceleration) or 2 (displacement) over time", diagnostics);
    }
    out->curve = motion_find_curve(input, card->lcid, "LCID", card->source, keyword_of(card), diagnostics);
    if (out->curve == -1) status = -1;
    if (status == 0 && out->curve == -2) return 1;
    if (status == 0) check_start(input, card, out, diagnostics);
    return status;
}

static int add_motion(MotionList *list, const PrescribedMotion *motion, Diagnostics *diagnostics)
{
    if (memory_reserve((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items))
        return motion_no_memory("*BOUNDARY_PRESCRIBED_MOTION", diagnostics);
    list->items[list->count++] = *motion;
    return 0;
}

static int add_rigid(const MotionInput *input, const Motion *motion, const PrescribedMotionDefinition *card,
                     PrescribedMotion *draft, MotionList *list, Diagnostics *diagnostics)
{
    int body = motion_find_body(input, motion, card->id);
    if (body < 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword_of(card),
                        body == -3 ? "PID = %d: there is no part of this id; define it or correct the card"
                                   : "PID = %d is no rigid part with elements; give it *MAT_RIGID or use _SET",
                        card->id);
        return -1;
    }
    draft->rigid_body = body;
    return add_motion(list, draft, diagnostics);
}

static int add_nodes(const MotionInput *input, const Motion *motion, const PrescribedMotionDefinition *card,
                     PrescribedMotion *draft, MotionList *list, Diagnostics *diagnostics)
{
    IndexList nodes = {0};
    int status = motion_find_nodes(input, card->kind == MOTION_SET, card->id, card->source, keyword_of(card), &nodes,
                                   diagnostics);
    for (size_t k = 0; k < nodes.count && status == 0; k++) {
        draft->node = nodes.items[k];
        if (motion->node_body[draft->node] == MOTION_DEFORMABLE) {
            status = add_motion(list, draft, diagnostics);
            continue;
        }
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword_of(card),
                        "node %d belongs to a rigid part; prescribe the part's motion by "
                        "*BOUNDARY_PRESCRIBED_MOTION_RIGID, or take the node out",
                        input->index->definitions->nodes.items[draft->node].id);
        status = -1;
    }
    index_list_free(&nodes);
    return status;
}

static bool same_target(const PrescribedMotion *a, const PrescribedMotion *b)
{
    return a->node == b->node && a->rigid_body == b->rigid_body;
}

static bool overlap(const PrescribedMotion *a, const PrescribedMotion *b)
{
    return a->birth < b->death && b->birth < a->death && a->rotation == b->rotation &&
           fabs(vector3_dot(a->direction, b->direction)) > 1 - 1e-12;
}

/* Two motions of one node or body along one direction at one time contradict each other. */
static int check_conflicts(const MotionInput *input, const Motion *motion, const MotionList *list,
                           Diagnostics *diagnostics)
{
    int status = 0;
    for (size_t i = 0; i < list->count; i++) {
        const PrescribedMotion *a = &list->items[i];
        for (size_t j = i + 1; j < list->count && same_target(a, &list->items[j]); j++) {
            if (!overlap(a, &list->items[j])) continue;
            bool rigid = a->node < 0;
            int id = rigid ? motion->rigid_bodies[a->rigid_body].part_id
                           : input->index->definitions->nodes.items[a->node].id;
            const PrescribedMotionDefinition *later = &input->index->definitions->motions.items[list->items[j].order];
            diagnostics_add(diagnostics, SEVERITY_ERROR, later->source, keyword_of(later),
                            "%s %d has two motions along the same direction at the same time; remove one, or part them "
                            "by BIRTH and DEATH",
                            rigid ? "rigid part" : "node", id);
            status = -1;
        }
        if (status) break; /* one example is enough: such sets overlap in many nodes */
    }
    return status;
}

int build_prescribed_motions(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    MotionList list = {0};
    int status = 0;
    for (size_t m = 0; m < d->motions.count; m++) {
        const PrescribedMotionDefinition *card = &d->motions.items[m];
        PrescribedMotion draft;
        int result = read_card(input, card, &draft, diagnostics);
        draft.order = (int)m;
        if (result == 0) {
            result = card->kind == MOTION_RIGID ? add_rigid(input, motion, card, &draft, &list, diagnostics)
                                                : add_nodes(input, motion, card, &draft, &list, diagnostics);
        }
        if (result < 0) status = -1;
    }
    if (list.count > 1) qsort(list.items, list.count, sizeof *list.items, motion_compare_motions);
    if (check_conflicts(input, motion, &list, diagnostics)) status = -1;
    Constraints *constraints = &motion->constraints;
    constraints->motions = list.items;
    constraints->motion_count = (int)list.count;
    while (constraints->node_motion_count < constraints->motion_count &&
           list.items[constraints->node_motion_count].node >= 0)
        constraints->node_motion_count++;
    return status;
}
