/* Membrane laws for the tests of points: every kind in several forms, with numbers of a fabric or of rubber. */
#ifndef BILLOW_TESTS_LAW_CASES_H
#define BILLOW_TESTS_LAW_CASES_H

#include <string.h>

#include "elements/law_point.h"

typedef struct LawCase {
    const char *name;
    LawKind kind;
    FabricLaw law;
    CurveLaw curves;
    RubberLaw rubber;
    double storage[64 * 6];
} LawCase;

enum { LAW_CASES = 19 };

static inline LawCase *law_case_linear(LawCase *c, const char *name, LawKind kind, bool field, bool liner)
{
    *c = (LawCase){.name = name, .kind = kind};
    PlaneModuli fabric = law_orthotropic(3e8, 2e8, 0.1, 0.15, 2e7);
    law_set(&c->law, kind == LAW_LOGARITHMIC ? law_isotropic(2e8, 0.3) : fabric, law_isotropic(6e7, 0.35), 0.2, liner);
    c->law.no_compression = field;
    return c;
}

static inline void law_case_curve(LawCase *c, int direction, bool unload, int points, const double *x, const double *y,
                                  bool tension)
{
    double *storage = c->storage + 64 * (2 * direction + unload);
    LawCurve *curve = unload ? &c->curves.unload[direction] : &c->curves.load[direction];
    law_curve_make(curve, points, x, y, 1.0, tension, storage);
    if (unload) law_curve_meet(&c->curves, direction);
    c->curves.unloading = c->curves.unloading || unload;
}

/* A toe that stiffens and yields at the end; a stiff weft with a branch in compression; shear that locks. */
static const double warp_x[] = {0, 0.02, 0.05, 0.12, 0.2}, warp_y[] = {0, 1e6, 6e6, 2.6e7, 4.5e7};
static const double back_x[] = {0, 0.05, 0.12, 0.2}, back_y[] = {0, 1e6, 1.2e7, 4.5e7};
static const double weft_x[] = {-0.3, 0, 0.1, 0.3}, weft_y[] = {-3e6, 0, 1e7, 5e7};
static const double shear_x[] = {0, 0.2, 0.5}, shear_y[] = {0, 2e5, 2e6};
static const double shear_back_x[] = {0, 0.3, 0.5}, shear_back_y[] = {0, 1e5, 2e6};

typedef struct CurveChoice {
    bool engineering, tension, liner, unloading;
    double reload, hysteresis;
} CurveChoice;

static inline LawCase *law_case_curves(LawCase *c, const char *name, CurveChoice choice)
{
    *c = (LawCase){.name = name, .kind = LAW_CURVE};
    c->curves.engineering = choice.engineering;
    c->curves.reload = choice.reload;
    law_case_curve(c, CURVE_WARP, false, 5, warp_x, warp_y, choice.tension);
    law_case_curve(c, CURVE_WEFT, false, 4, weft_x, weft_y, choice.tension);
    law_case_curve(c, CURVE_SHEAR, false, 3, shear_x, shear_y, true);
    if (choice.unloading) {
        law_case_curve(c, CURVE_WARP, true, 4, back_x, back_y, true);
        law_case_curve(c, CURVE_SHEAR, true, 3, shear_back_x, shear_back_y, true);
    }
    c->curves.softening = law_softening(choice.hysteresis);
    double stiffer = law_softening_stiffer(c->curves.softening);
    PlaneModuli most = {stiffer * law_curve_tangent(&c->curves, 0), 0, stiffer * law_curve_tangent(&c->curves, 1),
                        stiffer * law_curve_tangent(&c->curves, 2)};
    law_set(&c->law, most, law_isotropic(6e7, 0.35), 0.2, choice.liner);
    if (choice.liner) law_curves_scale(&c->curves, 0.8);
    c->law.no_compression = choice.tension;
    c->law.has_memory = choice.unloading || choice.hysteresis > 0;
    c->law.curves = &c->curves;
    return c;
}

static inline LawCase *law_case_rubber(LawCase *c, const char *name, RubberLaw rubber)
{
    *c = (LawCase){.name = name, .kind = LAW_RUBBER, .rubber = rubber};
    law_rubber_moduli(&c->rubber, &c->law);
    c->law.rubber = &c->rubber;
    return c;
}

/* All of them; cases: LAW_CASES, which must stay where they are. */
static inline void law_cases_make(LawCase *cases)
{
    LawCase *c = cases;
    law_case_linear(c++, "FORM 0", LAW_BIOT, false, false);
    law_case_linear(c++, "FORM 0, CSE", LAW_BIOT, true, false);
    law_case_linear(c++, "FORM 0, CSE, liner", LAW_BIOT, true, true);
    law_case_linear(c++, "MAT_ELASTIC", LAW_LOGARITHMIC, false, false);
    law_case_linear(c++, "FORM 2", LAW_GREEN, false, false);
    law_case_linear(c++, "FORM 2, CSE", LAW_GREEN, true, false);
    law_case_linear(c++, "FORM 2, CSE, liner", LAW_GREEN, true, true);
    law_case_curves(c++, "FORM 14", (CurveChoice){0});
    law_case_curves(c++, "FORM 14, CSE", (CurveChoice){.tension = true});
    law_case_curves(c++, "FORM 14, CSE, liner", (CurveChoice){.tension = true, .liner = true});
    law_case_curves(c++, "FORM 24", (CurveChoice){.engineering = true});
    law_case_curves(c++, "FORM 24, CSE, liner", (CurveChoice){.engineering = true, .tension = true, .liner = true});
    law_case_curves(c++, "FORM 14, unloading", (CurveChoice){.unloading = true});
    law_case_curves(c++, "FORM 24, CSE, unloading, RL",
                    (CurveChoice){.engineering = true, .tension = true, .unloading = true, .reload = 0.7});
    law_case_curves(c++, "FORM -14, H = 0.4", (CurveChoice){.hysteresis = 0.4});
    law_case_curves(c++, "FORM -14, CSE, H = 0.8", (CurveChoice){.tension = true, .hysteresis = 0.8});
    law_case_rubber(c++, "neo-Hooke", (RubberLaw){.a = 2e5});
    law_case_rubber(c++, "Mooney-Rivlin", (RubberLaw){.a = 1.6e5, .b = 4e4});
    law_case_rubber(c++, "Ogden", (RubberLaw){.terms = 3, .mu = {6.3e5, 1.2e3, -1e4}, .alpha = {1.3, 5, -2}});
}

#endif
