/* Gravity and mass damping of the cards: what acts on each part, and what on all. */
#include "solver/class_cards.h"

#include <stddef.h>

#include "solver/deck_index.h"
#include "solver/vector3.h"

bool class_report_full(const char *keyword, Source source, Diagnostics *diagnostics)
{
    diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                    "more than %d gravity or %d damping terms with different curves act on one part or node; combine "
                    "their curves",
                    BILLOW_GRAVITIES, BILLOW_DAMPINGS);
    return false;
}

static int add_body_load(const MotionInput *input, const BodyLoadDefinition *card, BodyClass *everywhere,
                         Diagnostics *diagnostics)
{
    static const char *const keywords[] = {"*LOAD_BODY_X", "*LOAD_BODY_Y", "*LOAD_BODY_Z", "*LOAD_BODY_VECTOR"};
    const char *keyword = keywords[card->axis];
    double axes[9], direction[3];
    int id = card->lcid;
    if (input->relaxation_phase && card->lciddr != 0) id = card->lciddr;
    if (id == 0 && card->lciddr != 0 && !input->relaxed) {
        diagnostics_add(diagnostics, SEVERITY_NOTE, card->source, keyword,
                        "LCID = 0: the load acts in dynamic relaxation only, which this run has none of");
        return 0;
    }
    if (id == 0 && card->lciddr != 0) return 0;
    int curve = id == card->lciddr && id != card->lcid
                    ? deck_index_curve(input->index, id, "LCIDDR", card->source, keyword, diagnostics)
                    : motion_find_curve(input, id, "LCID", card->source, keyword, diagnostics);
    if (motion_find_axes(input, card->cid, card->source, keyword, axes, diagnostics) || curve == -1) return -1;
    const double unit[3] = {card->axis == 0, card->axis == 1, card->axis == 2};
    matrix3_apply_transposed(axes, card->axis < 3 ? unit : card->vector, direction);
    bool fits = true;
    for (int i = 0; i < 3 && curve >= 0; i++) /* a base acceleration: the nodes feel its opposite */
        fits = body_class_add_gravity(everywhere, i, curve, -card->sf * direction[i]) && fits;
    return fits || class_report_full(keyword, card->source, diagnostics) ? 0 : -1;
}

static int add_gravity(const MotionInput *input, const GravityPartDefinition *card, BodyClass *of_part,
                       Diagnostics *diagnostics)
{
    const char *keyword = card->is_set ? "*LOAD_GRAVITY_PART_SET" : "*LOAD_GRAVITY_PART";
    IndexList parts = {0};
    int status = motion_find_parts(input, card->is_set, card->id, card->source, keyword, &parts, diagnostics);
    int curve = -1; /* LC = 0: constant */
    if (card->lc != 0) {
        curve = motion_find_curve(input, card->lc, "LC", card->source, keyword, diagnostics);
        if (curve == -1) status = -1;
    }
    if (card->dof < 1 || card->dof > 3) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword, "DOF = %d is none of 1, 2, 3", card->dof);
        status = -1;
    }
    if (card->stga != 0 || card->stgr != 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, keyword,
                        "%s = %d: construction stages are not in billow; leave STGA and STGR blank",
                        card->stga != 0 ? "STGA" : "STGR", card->stga != 0 ? card->stga : card->stgr);
        status = -1;
    }
    for (size_t k = 0; k < parts.count && status == 0 && curve != -2; k++) {
        if (!body_class_add_gravity(&of_part[parts.items[k]], card->dof - 1, curve, -card->accel)) {
            class_report_full(keyword, card->source, diagnostics);
            status = -1;
        }
    }
    index_list_free(&parts);
    return status;
}

static int add_damping(const MotionInput *input, const DampingDefinition *card, ClassCards *cards,
                       Diagnostics *diagnostics)
{
    const char *keyword = card->is_global ? "*DAMPING_GLOBAL"
                          : card->is_set  ? "*DAMPING_PART_MASS_SET"
                                          : "*DAMPING_PART_MASS";
    static const double all_one[6] = {1, 1, 1, 1, 1, 1};
    bool none = true;
    for (int i = 0; i < 6; i++) none = none && card->st[i] == 0;
    const double *factor = none ? all_one : card->st;
    int curve = -1;
    double scale = card->sf;
    if (card->lcid != 0 || !card->is_global) {
        curve = motion_find_curve(input, card->lcid, "LCID", card->source, keyword, diagnostics);
        if (curve < 0) return curve == -2 ? 0 : -1;
        if (card->is_global) scale = 1; /* VALDMP counts without a curve only */
    }
    if (card->is_global) {
        return body_class_add_damping(&cards->everywhere, curve, scale, factor) ||
                       class_report_full(keyword, card->source, diagnostics)
                   ? 0
                   : -1;
    }
    IndexList parts = {0};
    int status = motion_find_parts(input, card->is_set, card->id, card->source, keyword, &parts, diagnostics);
    for (size_t k = 0; k < parts.count && status == 0; k++) {
        if (!body_class_add_damping(&cards->of_part[parts.items[k]], curve, scale, factor)) {
            class_report_full(keyword, card->source, diagnostics);
            status = -1;
        }
    }
    index_list_free(&parts);
    return status;
}

int class_cards_read(const MotionInput *input, ClassCards *cards, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    int status = 0;
    for (size_t k = 0; k < d->body_loads.count; k++) {
        if (add_body_load(input, &d->body_loads.items[k], &cards->everywhere, diagnostics)) status = -1;
    }
    for (size_t k = 0; k < d->gravity_parts.count; k++) {
        if (add_gravity(input, &d->gravity_parts.items[k], cards->of_part, diagnostics)) status = -1;
    }
    for (size_t k = 0; k < d->dampings.count; k++) {
        if (add_damping(input, &d->dampings.items[k], cards, diagnostics)) status = -1;
    }
    return status;
}
