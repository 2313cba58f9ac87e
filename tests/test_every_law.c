/* Every membrane law of every card against closed forms in the runs of the solver itself: uniaxial, biaxial, picture
 * frame and bias, and ten turns of each (A5). */
#include "tests/affine_patch.h"

#include <stdio.h>

enum { MATERIAL_LENGTH = 3000, SCAN = 720 };
static const double pi = 3.14159265358979323846;

typedef enum Kind { BIOT, LOGARITHM, GREEN, CURVE, ENGINEERING_CURVE, MAP, MOONEY, OGDEN } Kind;

typedef struct Law {
    const char *name;
    Kind kind;
    int form;
    bool cse, liner;
    const char *card6, *card7;
} Law;

static const char curves[] = "101,102,103\n", unloading[] = "101,102,103,104,0,105,.5\n";

static const Law laws[] = {
    {"FORM 0", BIOT, 0, false, false, "", ""},
    {"FORM 0, CSE", BIOT, 0, true, false, "", ""},
    {"FORM 0, CSE, liner", BIOT, 0, true, true, "", ""},
    {"FORM 1", BIOT, 1, false, true, "", ""},
    {"FORM 1, CSE", BIOT, 1, true, false, "", ""},
    {"FORM 2", GREEN, 2, false, true, "", ""},
    {"FORM 2, CSE", GREEN, 2, true, false, "", ""},
    {"FORM 3", GREEN, 3, false, false, "", ""},
    {"FORM 3, CSE, liner", GREEN, 3, true, true, "", ""},
    {"FORM 12", GREEN, 12, false, false, "", ""},
    {"FORM 12, CSE", GREEN, 12, true, false, "", ""},
    {"FORM 13", GREEN, 13, false, true, "", ""},
    {"FORM 13, CSE", GREEN, 13, true, false, "", ""},
    {"FORM 4", CURVE, 4, false, false, curves, ""},
    {"FORM 4, CSE, liner", CURVE, 4, true, true, curves, ""},
    {"FORM 14", CURVE, 14, false, true, curves, ""},
    {"FORM 14, CSE", CURVE, 14, true, false, curves, ""},
    {"FORM 14, unloading curves", CURVE, 14, false, false, unloading, ""},
    {"FORM -14, CSE", CURVE, -14, true, false, curves, "0,0,0.\n"},
    {"FORM -14, H", CURVE, -14, false, false, curves, "0,0,.4\n"},
    {"FORM 24", ENGINEERING_CURVE, 24, false, false, curves, ""},
    {"FORM 24, CSE, liner", ENGINEERING_CURVE, 24, true, true, curves, ""},
    {"FORM 24, unloading curves", ENGINEERING_CURVE, 24, true, false, unloading, ""},
    {"FABRIC_MAP", MAP, 0, false, false, "", ""},
    {"FABRIC_MAP, CSE, TH", MAP, 0, true, false, "", "-.3"},
    {"ORTHOTROPIC_ELASTIC", GREEN, 0, false, false, "", ""},
    {"ELASTIC", LOGARITHM, 0, false, false, "", ""},
    {"MOONEY-RIVLIN_RUBBER", MOONEY, 0, false, false, "", ""},
    {"OGDEN_RUBBER", OGDEN, 0, false, false, "", ""},
};
enum { LAWS = sizeof laws / sizeof *laws };

/* Deck text of a law with fibre 1 at an angle to x [degrees]. */
static void write_material(char *text, const Law *l, double angle)
{
    int n;
    bool by_curves = l->kind == CURVE || l->kind == ENGINEERING_CURVE;
    if (l->kind == LOGARITHM) {
        n = snprintf(text, MATERIAL_LENGTH, "*MAT_ELASTIC\n1,1000.,2e8,.3\n");
    } else if (l->kind == MOONEY) {
        n = snprintf(text, MATERIAL_LENGTH, "*MAT_MOONEY-RIVLIN_RUBBER\n1,1000.,.495,1.6e5,4e4\n");
    } else if (l->kind == OGDEN) {
        n = snprintf(text, MATERIAL_LENGTH, "*MAT_OGDEN_RUBBER\n1,1000.,.495\n6.3e5,1.2e3,-1e4\n1.3,5,-2\n");
    } else if (l->kind == MAP) {
        n = snprintf(text, MATERIAL_LENGTH,
                     "*MAT_FABRIC_MAP\n1,1000.,101,102,106,,%s\n\n,%d\n2.\n,,,1.,0.,0.\n,,,,,,%g\n", l->card7, l->cse,
                     angle);
    } else if (l->kind == GREEN && l->form == 0) {
        n = snprintf(text, MATERIAL_LENGTH,
                     "*MAT_ORTHOTROPIC_ELASTIC\n1,1000.,3e8,2e8,2e8,.133333333333333333\n1.e7,1e7,1e7,2.\n"
                     ",,,1.,0.,0.\n,,,,,,%g\n",
                     angle);
    } else {
        n = snprintf(text, MATERIAL_LENGTH,
                     "*MAT_FABRIC\n1,1000.,3e8,2e8,,%s\n1.e7,,,%d,5e7,.3,%s\n2.,,,,,%d\n,,,1.,0.,0.\n0,0,0,,,,%g\n%s%s",
                     by_curves ? "" : ".133333333333333333,.2", l->cse, l->liner ? ".2" : "0", l->form, angle, l->card6,
                     l->card7);
    }
    snprintf(text + n, (size_t)(MATERIAL_LENGTH - n),
             "*DEFINE_CURVE\n101\n-.2,-2e6\n0,0\n.02,1e6\n.06,9e6\n.2,6e7\n*DEFINE_CURVE\n102\n-.2,-3e6\n0,0\n.2,4e7\n"
             "*DEFINE_CURVE\n103\n0,0\n.1,2e5\n.6,4e6\n*DEFINE_CURVE\n106\n-.6,-4e6\n-.1,-2e5\n0,0\n.1,2e5\n.6,4e6\n"
             "*DEFINE_CURVE\n104\n0,0\n.1,4e6\n.2,6e7\n*DEFINE_CURVE\n105\n0,0\n.3,3e5\n.6,4e6\n");
}

/* ---- closed forms, in material axes ---- */

static Plane turn(Plane t, double angle)
{
    double c = cos(angle), s = sin(angle);
    return (Plane){c * c * t.xx + s * s * t.yy - 2 * s * c * t.xy, s * s * t.xx + c * c * t.yy + 2 * s * c * t.xy,
                   s * c * (t.xx - t.yy) + (c * c - s * s) * t.xy};
}

/* Principal values and the angle of the first. */
static double principal(Plane t, double *first, double *second)
{
    double mean = 0.5 * (t.xx + t.yy), radius = hypot(0.5 * (t.xx - t.yy), t.xy);
    *first = mean + radius;
    *second = mean - radius;
    return 0.5 * atan2(2 * t.xy, t.xx - t.yy);
}

static Plane apply(Plane e, bool liner)
{
    if (liner) return (Plane){5e7 / 0.91 * (e.xx + 0.3 * e.yy), 5e7 / 0.91 * (e.yy + 0.3 * e.xx), 5e7 / 1.3 * e.xy};
    const double n = 1 - 0.4 / 3 * 0.2;
    return (Plane){(3e8 * e.xx + 4e7 * e.yy) / n, (4e7 * e.xx + 2e8 * e.yy) / n, 2e7 * e.xy};
}

static Plane mixed(const Law *l, Plane fabric, Plane liner)
{
    if (!l->liner) return fabric;
    return (Plane){0.8 * fabric.xx + 0.2 * liner.xx, 0.8 * fabric.yy + 0.2 * liner.yy,
                   0.8 * fabric.xy + 0.2 * liner.xy};
}

/* Only the tensile principal values. */
static Plane tensile(Plane t)
{
    double first, second, angle = principal(t, &first, &second);
    return turn((Plane){fmax(first, 0), fmax(second, 0), 0}, angle);
}

/* FORM 0 and 1: T = D : (U - 1), 1/2 (S U + U S) = T, in the principal axes of U. */
static Plane biot(const Law *l, Plane c)
{
    double c1, c2, angle = principal(c, &c1, &c2), u1 = sqrt(c1), u2 = sqrt(c2);
    Plane e = turn((Plane){u1 - 1, u2 - 1, 0}, angle), t = apply(e, false);
    t = turn(mixed(l, l->cse ? tensile(t) : t, apply(e, true)), -angle);
    return turn((Plane){t.xx / u1, t.yy / u2, 2 * t.xy / (u1 + u2)}, angle);
}

static Plane logarithm(Plane c)
{
    double c1, c2, angle = principal(c, &c1, &c2), e1 = 0.5 * log(c1), e2 = 0.5 * log(c2), q = 2e8 / 0.91;
    double j = sqrt(c1 * c2);
    return turn((Plane){j * q * (e1 + 0.3 * e2) / c1, j * q * (e2 + 0.3 * e1) / c2, 0}, angle);
}

/* Slope of the energy e^2/(2 a) of a uniaxial tension along the direction t, over e/a^2; *pull = e/a. */
static double field_slope(Plane e, double t, double *pull)
{
    const double s11 = 1 / 3e8, s22 = 1 / 2e8, s12 = -0.2 / 3e8, s66 = 1e-7;
    double c = cos(t), s = sin(t), x = c * c, y = s * s, z = s * c;
    double along = e.xx * x + e.yy * y + 2 * e.xy * z, a = s11 * x * x + s22 * y * y + 2 * s12 * x * y + s66 * z * z;
    double d_along = 2 * z * (e.yy - e.xx) + 2 * e.xy * (x - y);
    double d_a = 4 * z * (s22 * y - s11 * x) + 4 * s12 * z * (x - y) + 2 * s66 * z * (x - y);
    *pull = along / a;
    return 2 * d_along * a - along * d_a;
}

/* FORM 2 with the tension field: taut, slack or the best direction, by a scan and bisection. */
static Plane field(Plane e)
{
    Plane taut = apply(e, false);
    double first, second, best = 0, at = 0, pull;
    principal(taut, &first, &second);
    if (second >= 0) return taut;
    principal(e, &first, &second);
    if (first <= 0) return (Plane){0};
    for (int i = 0; i < SCAN; i++) {
        double t = i * pi / SCAN, c = cos(t), s = sin(t);
        field_slope(e, t, &pull);
        double along = e.xx * c * c + e.yy * s * s + 2 * e.xy * s * c;
        if (along > 0 && along * pull > best) best = along * pull, at = t;
    }
    double low = at - pi / SCAN, high = at + pi / SCAN;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *(field_slope(e, middle, &pull) > 0 ? &low : &high) = middle;
    }
    double c = cos(low), s = sin(low);
    return (Plane){pull * c * c, pull * s * s, pull * s * c};
}

static double line(int n, const double (*p)[2], double x)
{
    int i = 1;
    while (i < n - 1 && x > p[i][0]) i++;
    return p[i - 1][1] + (p[i][1] - p[i - 1][1]) * (x - p[i - 1][0]) / (p[i][0] - p[i - 1][0]);
}

static Plane by_curves(const Law *l, Plane c)
{
    static const double warp[5][2] = {{-0.2, -2e6}, {0, 0}, {0.02, 1e6}, {0.06, 9e6}, {0.2, 6e7}};
    static const double weft[3][2] = {{-0.2, -3e6}, {0, 0}, {0.2, 4e7}}, shear[3][2] = {{0, 0}, {0.1, 2e5}, {0.6, 4e6}};
    bool engineering = l->kind != CURVE;
    double l1 = engineering ? sqrt(c.xx) : 1, l2 = engineering ? sqrt(c.yy) : 1;
    double e1 = engineering ? l1 - 1 : 0.5 * (c.xx - 1), e2 = engineering ? l2 - 1 : 0.5 * (c.yy - 1);
    double angle = fabs(l->kind == MAP ? 0.5 * c.xy : c.xy);
    return (Plane){e1 < 0 && l->cse ? 0 : line(5, warp, e1) / l1, e2 < 0 && l->cse ? 0 : line(3, weft, e2) / l2,
                   copysign(line(3, shear, angle), c.xy)};
}

/* Incompressible: S_i = sum mu (l_i^alpha - l_3^alpha)/l_i^2; Mooney-Rivlin is mu = 2 A, -2 B with alpha = 2, -2. */
static Plane rubber(const Law *l, Plane c)
{
    static const double mu[2][3] = {{3.2e5, -8e4, 0}, {6.3e5, 1.2e3, -1e4}}, alpha[2][3] = {{2, -2, 1}, {1.3, 5, -2}};
    double c1, c2, angle = principal(c, &c1, &c2), s1 = 0, s2 = 0;
    for (int i = 0; i < 3; i++) {
        double m = mu[l->kind == OGDEN][i], a = 0.5 * alpha[l->kind == OGDEN][i], third = pow(c1 * c2, -a);
        s1 += m * (pow(c1, a) - third) / c1;
        s2 += m * (pow(c2, a) - third) / c2;
    }
    return turn((Plane){s1, s2, 0}, angle);
}

static Plane material_stress(const Law *l, Plane c)
{
    Plane e = {0.5 * (c.xx - 1), 0.5 * (c.yy - 1), 0.5 * c.xy};
    if (l->kind == BIOT) return biot(l, c);
    if (l->kind == LOGARITHM) return logarithm(c);
    if (l->kind == MOONEY || l->kind == OGDEN) return rubber(l, c);
    return mixed(l, l->kind == GREEN ? (l->cse ? field(e) : apply(e, false)) : by_curves(l, c), apply(e, true));
}

static Plane expected_stress(const Law *l, double degrees, const double f[4])
{
    double angle = degrees * pi / 180;
    Plane c = {f[0] * f[0] + f[2] * f[2], f[1] * f[1] + f[3] * f[3], f[0] * f[1] + f[2] * f[3]};
    return turn(material_stress(l, turn(c, -angle)), angle);
}

/* ---- runs ---- */

typedef struct LoadCase {
    const char *name;
    double angle, f[4];
} LoadCase;

static const LoadCase load_cases[] = {
    {"uniaxial", 0, {1.08, 0, 0, 0.97}},
    {"biaxial", 0, {1.05, 0, 0, 1.09}},
    {"picture frame", 0, {0.9937606691655043, 0.11153105692798543, 0.11153105692798543, 0.9937606691655043}},
    {"bias", 45, {1.12, 0, 0, 0.94}},
    {"off axis", 25, {1.09, 0.03, -0.01, 1.04}},
};
enum { LOAD_CASES = sizeof load_cases / sizeof *load_cases };

static void check(const Law *l, const LoadCase *load, const AffineKind *kind, bool spinning)
{
    char material[MATERIAL_LENGTH], name[100];
    bool thins = l->kind == MOONEY || l->kind == OGDEN;
    write_material(material, l, load->angle);
    AffinePatch patch = {.pattern = kind->pattern,
                         .one_point = kind->one_point,
                         .material = material,
                         .path = spinning ? affine_spinning : affine_straight,
                         .user = load->f,
                         .points = spinning ? 800 : 1,
                         .last_share = 1};
    VerifyRun run;
    affine_run(&patch, &run);
    double end[4];
    patch.path(load->f, 1, end);
    snprintf(name, sizeof name, "%s, %s%s", l->name, load->name, spinning ? ", ten turns" : "");
    affine_check(name, affine_stress(&run, end, thins), expected_stress(l, load->angle, load->f), 1e-9);
    verify_free(&run);
}

static void test_closed_forms(void **unused)
{
    (void)unused;
    for (int l = 0; l < LAWS; l++)
        for (int k = 0; k < LOAD_CASES; k++)
            for (int i = 0; i < AFFINE_KINDS; i++) check(&laws[l], &load_cases[k], &affine_kinds[i], false);
}

static void test_objectivity(void **unused)
{
    (void)unused;
    for (int l = 0; l < LAWS; l++)
        for (int k = 0; k < LOAD_CASES; k += 2)
            for (int i = 0; i < AFFINE_KINDS; i++) check(&laws[l], &load_cases[k], &affine_kinds[i], true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_forms),
        cmocka_unit_test(test_objectivity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
