/* Fabric by curves: the stress-strain curves that a material names -> CurveLaw. */
#include <math.h>

#include "solver/builder.h"

/* A direction's fields as the material's card calls them. */
typedef struct DirectionCard {
    const char *load_name, *unload_name, *modulus_name;
    int load, unload;
    double modulus; /* in place of a curve */
} DirectionCard;

/* What the curves of one material are made from, and where its messages go. */
typedef struct CurveBuild {
    Builder *builder;
    const MaterialDefinition *material;
    const char *keyword;
    bool quiet;   /* a second part with the material: its messages are out */
    bool tension; /* fibres carry no compression */
    CurveLaw *law;
    int status;
} CurveBuild;

static void report(CurveBuild *c, Severity severity, Source source, const char *keyword, const char *name, int id,
                   const char *what)
{
    if (severity == SEVERITY_ERROR) c->status = -1;
    if (!c->quiet)
        diagnostics_add(c->builder->diagnostics, severity, source, keyword, "material %d, %s = %d: %s", c->material->id,
                        name, id, what);
}

static const char *fault_text(CurveFault fault)
{
    switch (fault) {
    case CURVE_TOO_SHORT:
        return "a curve of stress over strain, or of a force, needs two points at least";
    case CURVE_FALLS:
        return "the stress falls at this point; with growing strain it must grow or stay, and so must a force";
    case CURVE_OFF_ORIGIN:
        return "the curve does not go through the origin; start it with the point 0, 0";
    case CURVE_FLAT:
        return "the curve has no stress or force at any positive abscissa; give it some stiffness";
    case CURVE_NOT_ODD:
        return "shear of both senses must meet the same stress: leave out the negative strains or mirror the others";
    case CURVE_FINE:
        break;
    }
    return "";
}

static const CurveDefinition *find_curve(const Builder *b, int id, const Curve **curve)
{
    for (size_t i = 0; i < b->definitions->curves.count; i++) {
        if (b->definitions->curves.items[i].id != id) continue;
        *curve = &b->model->curves[i];
        return &b->definitions->curves.items[i];
    }
    return NULL;
}

/* One curve of the material, checked and made; -1 after an error. */
static int take_curve(CurveBuild *c, const char *name, int id, bool shear, bool tension, double scale, LawCurve *to)
{
    const Curve *curve;
    const CurveDefinition *definition = find_curve(c->builder, id, &curve);
    if (!definition) {
        report(c, SEVERITY_ERROR, c->material->source, c->keyword, name, id,
               "the deck has no *DEFINE_CURVE of this number (tables and functions cannot stand here)");
        return -1;
    }
    if (!curve->area) return c->status = -1; /* its own message is out */
    int point;
    CurveFault fault = law_curve_check(curve->count, curve->x, curve->y, shear, &point);
    if (fault != CURVE_FINE) {
        Source source = {definition->source.file, definition->lines.items[point]};
        report(c, SEVERITY_ERROR, source, "*DEFINE_CURVE", name, id, fault_text(fault));
        return -1;
    }
    double *storage = builder_alloc(c->builder, law_curve_size(curve->count), sizeof *storage);
    if (!storage) return c->status = -1;
    law_curve_make(to, curve->count, curve->x, curve->y, scale, tension, storage);
    return 0;
}

/* The unloading curve must come back below the loading curve and meet it at its end. */
static void take_unloading(CurveBuild *c, int direction, const DirectionCard *card)
{
    CurveLaw *law = c->law;
    if (take_curve(c, card->unload_name, card->unload, direction == CURVE_SHEAR, true, 1.0, &law->unload[direction]))
        return;
    double factor = law_curve_meet(law, direction);
    if (law_curve_crossing(law, direction) >= 0.0)
        report(
            c, SEVERITY_ERROR, c->material->source, c->keyword, card->unload_name, card->unload,
            "the unloading curve lies above the loading curve, so that cycles would create energy; it must stay below "
            "and meet the loading curve at its last point");
    else if (fabs(factor - 1.0) > 0.01)
        report(c, SEVERITY_WARNING, c->material->source, c->keyword, card->unload_name, card->unload,
               "the unloading curve does not end on the loading curve; its stresses are scaled so that it does");
    law->unloading = true;
}

static void take_direction(CurveBuild *c, int direction, const DirectionCard *card)
{
    CurveLaw *law = c->law;
    bool shear = direction == CURVE_SHEAR, tension = shear || c->tension;
    if (card->load) {
        if (take_curve(c, card->load_name, card->load, shear, tension, 1.0, &law->load[direction])) return;
    } else {
        double *storage = builder_alloc(c->builder, law_curve_size(1), sizeof *storage);
        if (!(card->modulus > 0.0))
            report(c, SEVERITY_ERROR, c->material->source, c->keyword, card->load_name, 0,
                   c->material->fabric.is_map     ? "this curve must be given"
                   : card->modulus_name[0] == 'G' ? "without this curve GAB must be positive"
                                                  : "without this curve the modulus EA or EB must be positive");
        if (!storage || !(card->modulus > 0.0)) {
            c->status = -1;
            return;
        }
        law_curve_make_line(&law->load[direction], card->modulus, tension, storage);
    }
    if (card->unload) take_unloading(c, direction, card);
}

static void check_shares(CurveBuild *c, double reload, double hysteresis)
{
    const char *what =
        !(reload >= 0.0 && reload <= 1.0)          ? "RL must lie between 0 and 1"
        : !(hysteresis >= 0.0 && hysteresis < 1.0) ? "the hysteresis must lie between 0 and 1, 1 left out"
        : hysteresis > 0.0 && c->law->unloading    ? "give either unloading curves or a hysteresis, not both"
                                                   : NULL;
    if (!what) return;
    c->status = -1;
    if (!c->quiet)
        diagnostics_add(c->builder->diagnostics, SEVERITY_ERROR, c->material->source, c->keyword, "material %d: %s",
                        c->material->id, what);
}

/* Curves, then the moduli that bound their tangents, shares of fabric and liner, law of the part. */
static int finish_law(CurveBuild *c, double hysteresis, PlaneModuli liner, double liner_share, bool has_liner,
                      PartRecord *part)
{
    CurveLaw *law = c->law;
    law->softening = law_softening(hysteresis);
    double stiffer = law_softening_stiffer(law->softening), tangent[CURVE_DIRECTIONS];
    for (int d = 0; d < CURVE_DIRECTIONS; d++) tangent[d] = stiffer * law_curve_tangent(law, d);
    PlaneModuli largest = {tangent[CURVE_WARP], 0.0, tangent[CURVE_WEFT], tangent[CURVE_SHEAR]};
    law_set(&part->fabric, largest, liner, liner_share, has_liner);
    if (has_liner) law_curves_scale(law, 1.0 - liner_share);
    part->fabric.curves = law;
    part->fabric.has_memory = law->unloading || law->softening > 0.0;
    part->law = LAW_CURVE;
    return 0;
}

int material_curve(Builder *b, const MaterialDefinition *m, const char *field, int id, LawCurve *curve)
{
    CurveBuild c = {.builder = b, .material = m, .keyword = m->keyword};
    return take_curve(&c, field, id, false, true, 1.0, curve);
}

int material_force_curve(Builder *b, const MaterialDefinition *m, const char *field, int id, double scale,
                         LawCurve *curve)
{
    CurveBuild c = {.builder = b, .material = m, .keyword = m->keyword};
    const Curve *points = NULL;
    if (take_curve(&c, field, id, false, false, scale, curve)) return -1;
    const CurveDefinition *definition = find_curve(b, id, &points);
    if (!points || points->x[0] < 0.0) return 0;
    report(&c, SEVERITY_ERROR, definition->source, "*DEFINE_CURVE", field, id,
           "the curve needs points at negative abscissae too, before those at positive ones");
    return -1;
}

/* From a curve over E12 to one over 2 E12. */
static void widen_curve(LawCurve *curve)
{
    for (int i = 0; i < curve->count; i++) {
        curve->x[i] *= 2.0;
        curve->slope[i] *= 0.5;
        curve->area[i] *= 2.0;
    }
}

int fabric_curve_law(Builder *b, const MaterialDefinition *m, bool first_use, PartRecord *part)
{
    const FabricCard *f = &m->fabric;
    double eb = f->eb > 0.0 ? f->eb : f->ea, gab = f->gab > 0.0 ? f->gab : 0.5 * f->ea / (1.0 + f->prba);
    CurveLaw *law = builder_alloc(b, 1, sizeof *law);
    if (!law) return -1;
    CurveBuild c = {
        .builder = b, .material = m, .keyword = m->keyword, .quiet = !first_use, .tension = f->cse == 1.0, .law = law};
    const DirectionCard map[CURVE_DIRECTIONS] = {
        {"PXX", "", "EA", f->lca, 0, 0.0}, {"PYY", "", "EB", f->lcb, 0, 0.0}, {"SXY", "", "GAB", f->lcab, 0, 0.0}};
    const DirectionCard cards[CURVE_DIRECTIONS] = {{"LCA", "LCUA", "EA", f->lca, f->lcua, f->ea},
                                                   {"LCB", "LCUB", "EB", f->lcb, f->lcub, eb},
                                                   {"LCAB", "LCUAB", "GAB", f->lcab, f->lcuab, gab}};
    law->engineering = f->form == 24;
    law->reload = f->rl;
    for (int d = 0; d < CURVE_DIRECTIONS; d++) take_direction(&c, d, f->is_map ? &map[d] : &cards[d]);
    if (f->is_map && !c.status) widen_curve(&law->load[CURVE_SHEAR]);
    check_shares(&c, f->rl, f->h);
    if (c.status) return -1;
    if (first_use && (f->prba != 0.0 || f->prab != 0.0))
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, m->source, m->keyword,
            "material %d: PRBA and PRAB have no effect with FORM = %d and curves; each fibre follows its own "
            "curve",
            m->id, f->form);
    bool has_liner = f->lratio > 0.0 && f->el > 0.0;
    PlaneModuli liner = has_liner ? law_isotropic(f->el, f->prl) : (PlaneModuli){0};
    return finish_law(&c, f->h, liner, f->lratio, has_liner, part);
}
