/* Every FORM of MAT_FABRIC that goes by Green strain or by curves, on imposed deformations against closed forms:
 * uniaxial, biaxial, picture frame and bias (A4), rotation (A5), and cycles of load and unload. */
#include "tests/affine_patch.h"

#include <stdio.h>

enum { MATERIAL_LENGTH = 4000 };

/* Fibre 1 at an angle to x [degrees]; curves 101 to 105. */
static void write_material(char *text, int form, bool cse, double angle, const char *card6, const char *card7)
{
    snprintf(text, MATERIAL_LENGTH,
             "*MAT_FABRIC\n1,1000.,3e8,2e8,,%s\n1.e7,,,%d,5e7,.3,.2,\n2.,,,,,%d\n,,,1.,0.,0.\n0,0,0,,,,%g\n%s%s"
             "*DEFINE_CURVE\n101\n%20g%20g\n%20g%20g\n%20g%20g\n%20g%20g\n"
             "*DEFINE_CURVE\n102\n%20g%20g\n%20g%20g\n%20g%20g\n"
             "*DEFINE_CURVE\n103\n%20g%20g\n%20g%20g\n%20g%20g\n"
             "*DEFINE_CURVE\n104\n%20g%20g\n%20g%20g\n%20g%20g\n"
             "*DEFINE_CURVE\n105\n%20g%20g\n%20g%20g\n%20g%20g\n",
             form == 2 || form == 3 || form == 12 || form == 13 ? ".133333333333333333,.2" : "", cse, form, angle,
             card6, card7, 0., 0., 0.02, 1e6, 0.06, 9e6, 0.2, 6e7, -0.2, -3e6, 0., 0., 0.2, 4e7, 0., 0., 0.1, 2e5, 0.6,
             4e6, 0., 0., 0.1, 4e6, 0.2, 6e7, 0., 0., 0.3, 3e5, 0.6, 4e6);
}

static double piecewise(int n, const double (*p)[2], double x)
{
    int i = 1;
    while (i < n - 1 && x > p[i][0]) i++;
    return p[i - 1][1] + (p[i][1] - p[i - 1][1]) * (x - p[i - 1][0]) / (p[i][0] - p[i - 1][0]);
}

static const double warp[4][2] = {{0, 0}, {0.02, 1e6}, {0.06, 9e6}, {0.2, 6e7}};
static const double weft[3][2] = {{-0.2, -3e6}, {0, 0}, {0.2, 4e7}};
static const double shear[3][2] = {{0, 0}, {0.1, 2e5}, {0.6, 4e6}};
static const double back[3][2] = {{0, 0}, {0.1, 4e6}, {0.2, 6e7}};

static Plane liner(Plane e)
{
    const double q = 5e7 / 0.91;
    return (Plane){q * (e.xx + 0.3 * e.yy), q * (e.yy + 0.3 * e.xx), q * 0.7 * e.xy};
}

/* Second Piola-Kirchhoff stress in material axes: 0.8 of the fabric and 0.2 of the liner. */
static Plane material_stress(int form, bool cse, Plane e)
{
    Plane s, l = liner(e);
    if (form == 2 || form == 3 || form == 12 || form == 13) {
        const double n = 1 - 0.4 / 3 * 0.2, q12 = 0.2 * 2e8 / n;
        s = (Plane){3e8 / n * e.xx + q12 * e.yy, q12 * e.xx + 2e8 / n * e.yy, 2e7 * e.xy};
    } else if (form == 24) {
        double l1 = sqrt(1 + 2 * e.xx), l2 = sqrt(1 + 2 * e.yy);
        s.xx = (l1 < 1 ? (cse ? 0 : 5e7 * (l1 - 1)) : piecewise(4, warp, l1 - 1)) / l1;
        s.yy = (l2 < 1 && cse ? 0 : piecewise(3, weft, l2 - 1)) / l2;
        s.xy = copysign(piecewise(3, shear, fabs(2 * e.xy)), e.xy);
    } else {
        s.xx = e.xx < 0 ? (cse ? 0 : 5e7 * e.xx) : piecewise(4, warp, e.xx);
        s.yy = e.yy < 0 && cse ? 0 : piecewise(3, weft, e.yy);
        s.xy = copysign(piecewise(3, shear, fabs(2 * e.xy)), e.xy);
    }
    return (Plane){0.8 * s.xx + 0.2 * l.xx, 0.8 * s.yy + 0.2 * l.yy, 0.8 * s.xy + 0.2 * l.xy};
}

static Plane turn(Plane t, double c, double s)
{
    return (Plane){c * c * t.xx + s * s * t.yy - 2 * s * c * t.xy, s * s * t.xx + c * c * t.yy + 2 * s * c * t.xy,
                   s * c * (t.xx - t.yy) + (c * c - s * s) * t.xy};
}

static Plane expected_stress(int form, bool cse, double angle, const double f[4])
{
    double c = cos(angle * 3.14159265358979323846 / 180), s = sin(angle * 3.14159265358979323846 / 180);
    Plane e = {0.5 * (f[0] * f[0] + f[2] * f[2] - 1), 0.5 * (f[1] * f[1] + f[3] * f[3] - 1),
               0.5 * (f[0] * f[1] + f[2] * f[3])};
    return turn(material_stress(form, cse, turn(e, c, -s)), c, s);
}

static const int forms[] = {2, 3, 12, 13, 4, 14, -14, 24};
enum { FORMS = 8 };

static void write_form(char *text, int form, bool cse, double angle)
{
    bool curves = form == 4 || form == 14 || form == -14 || form == 24;
    write_material(text, form, cse, angle, curves ? "101,102,103\n" : "", form == -14 ? "0,0,0.,0.\n" : "");
}

typedef struct FormTest {
    const char *name;
    double angle; /* of fibre 1 [degrees] */
    double f[4];
    bool cse;
} FormTest;

static const FormTest form_tests[] = {
    {"uniaxial", 0, {1.08, 0, 0, 1}, false},
    {"uniaxial, weft squeezed", 0, {1.08, 0, 0, 0.93}, false},
    {"uniaxial, weft slack", 0, {1.08, 0, 0, 1}, true},
    {"biaxial", 0, {1.05, 0, 0, 1.09}, true},
    {"picture frame", 0, {0.9937606691655043, 0.11153105692798543, 0.11153105692798543, 0.9937606691655043}, false},
    {"picture frame, other sense",
     0,
     {0.9937606691655043, -0.11153105692798543, -0.11153105692798543, 0.9937606691655043},
     false},
    {"bias", 45, {1.12, 0, 0, 0.94}, false},
    {"off axis", 25, {1.09, 0.03, -0.01, 1.04}, true},
};
enum { FORM_TESTS = sizeof form_tests / sizeof *form_tests };

static void test_closed_forms(void **unused)
{
    (void)unused;
    char material[MATERIAL_LENGTH], name[100];
    for (int i = 0; i < FORMS * FORM_TESTS * AFFINE_KINDS; i++) {
        const FormTest *t = &form_tests[i % FORM_TESTS];
        const AffineKind *kind = &affine_kinds[i / FORM_TESTS % AFFINE_KINDS];
        int form = forms[i / FORM_TESTS / AFFINE_KINDS];
        if (t->cse && i / FORM_TESTS / AFFINE_KINDS < 4) continue; /* the tension field has tests of its own */
        write_form(material, form, t->cse, t->angle);
        AffinePatch patch = {kind->pattern, kind->one_point, material, affine_straight, t->f, 1, .last_share = 1};
        VerifyRun run;
        affine_run(&patch, &run);
        snprintf(name, sizeof name, "FORM %d, %s", form, t->name);
        affine_check(name, affine_stress(&run, t->f, false), expected_stress(form, t->cse, t->angle, t->f), 1e-10);
        verify_free(&run);
    }
}

/* A5: ten turns at a strain leave the stress in material axes what it was. */
static void test_rotation(void **unused)
{
    (void)unused;
    const double f[4] = {1.09, 0.03, -0.01, 1.04};
    char material[MATERIAL_LENGTH];
    for (int i = 0; i < FORMS * AFFINE_KINDS; i++) {
        const AffineKind *kind = &affine_kinds[i % AFFINE_KINDS];
        int form = forms[i / AFFINE_KINDS];
        write_form(material, form, false, 25);
        AffinePatch patch = {kind->pattern, kind->one_point, material, affine_spinning, f, 800, .last_share = 1};
        VerifyRun run;
        affine_run(&patch, &run);
        double end[4];
        affine_spinning(f, 1, end);
        affine_check("rotation", affine_stress(&run, end, false), expected_stress(form, false, 25, f), 1e-10);
        verify_free(&run);
    }
}

/* Warp from 0 to 0.2, back to 0.1, to 0.2, to 0: Green strain, or the engineering strain of FORM 24. */
static void cycle_path(const void *user, double share, double f[4])
{
    static const double way[8][2] = {{0, 0},     {0.35, 0.2}, {0.45, 0.2}, {0.6, 0.1},
                                     {0.7, 0.1}, {0.8, 0.2},  {0.85, 0.2}, {1, 0}}; /* it stays where it turns */
    double e = piecewise(8, way, share);
    const int *form = user;
    const double one[4] = {*form == 24 ? 1 + e : sqrt(1 + 2 * e), 0, 0, 1};
    memcpy(f, one, sizeof one);
}

static double area(int n, const double (*p)[2])
{
    double sum = 0;
    for (int i = 1; i < n; i++) sum += 0.5 * (p[i][0] - p[i - 1][0]) * (p[i][1] + p[i - 1][1]);
    return sum;
}

/* The given unloading curve is met on the way back, the inner loop closes, and the work of the whole cycle is the area
 * between the curves. */
static void test_unloading(void **unused)
{
    (void)unused;
    char material[MATERIAL_LENGTH];
    const double volume = affine_size * affine_size * affine_thickness;
    for (int i = 0; i < 4 * AFFINE_KINDS; i++) {
        const AffineKind *kind = &affine_kinds[i % AFFINE_KINDS];
        int form = forms[4 + i / AFFINE_KINDS];
        write_material(material, form, true, 0, "101,102,103,104,0,105\n", form == -14 ? "0,0,0.,0.\n" : "");
        char *share = strstr(material, ",.2,\n"); /* no liner */
        memcpy(share, ",0.,\n", 5);
        AffinePatch patch = {kind->pattern, kind->one_point, material, cycle_path, &form, 500, .step_scale = 0.1};
        const double stops[] = {0.4, 0.65, 0.75, 0.925, 1}, strains[] = {0.2, 0.1, 0.15, 0.1, 0};
        for (int s = 0; s < 5; s++) {
            patch.last_share = stops[s];
            VerifyRun run;
            affine_run(&patch, &run);
            double f[4], expected = piecewise(3, back, strains[s]);
            cycle_path(&form, stops[s], f);
            Plane stress = affine_stress(&run, f, false);
            verify_near("unloading curve", stress.xx * (form == 24 ? f[0] : 1), expected, 1e-8 * 6e7);
            if (s == 4) {
                double work = volume * (area(4, warp) - area(3, back));
                verify_close("work of the cycle", run.state.part_energy[0], work, 1e-4);
            }
            verify_free(&run);
        }
    }
}

/* The hysteresis H of FORM -14 in a whole cycle. */
static void test_hysteresis(void **unused)
{
    (void)unused;
    char material[MATERIAL_LENGTH];
    const double volume = affine_size * affine_size * affine_thickness;
    int form = -14;
    for (int i = 0; i < AFFINE_KINDS; i++) {
        write_material(material, form, true, 0, "101,102,103\n", "0,0,.35,0.\n");
        memcpy(strstr(material, ",.2,\n"), ",0.,\n", 5);
        AffinePatch patch = {affine_kinds[i].pattern, affine_kinds[i].one_point, material, cycle_path, &form, 500,
                             .step_scale = 0.1};
        VerifyRun run;
        affine_run(&patch, &run);
        verify_close("energy of a cycle", run.state.part_energy[0], 0.35 * volume * area(4, warp), 1e-4);
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_forms),
        cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_unloading),
        cmocka_unit_test(test_hysteresis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
