/* Membrane laws on imposed deformations, against closed forms: patch test (A3), orthotropic fabric (A4), objectivity
 * under rotation (A5), compression cut-off (A6) of the reference collection. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "solver/elementary.h"

#define PI 3.14159265358979323846

static const double patch_size = 0.1, patch_thickness = 3.5e-4;

typedef struct Plane {
    double xx, yy, xy;
} Plane;

typedef struct PatchCase {
    ScenePattern pattern;
    bool one_point;
    int cells; /* per side; 2 has one interior node, which stays free */
    SceneFabric fabric;
    double f[4];  /* deformation gradient F11 F12 F21 F22 */
    double turns; /* rigid rotation after the stretch */
} PatchCase;

static const PatchCase patch_kinds[] = {{.pattern = SCENE_DIAGONAL, .cells = 2},
                                        {.pattern = SCENE_ACROSS, .cells = 2},
                                        {.pattern = SCENE_QUADS, .cells = 2},
                                        {.pattern = SCENE_QUADS, .one_point = true, .cells = 2}};
enum { PATCH_KINDS = sizeof patch_kinds / sizeof patch_kinds[0] };

static void rotate(double angle, const double x[2], double y[2])
{
    double c = elementary_cos(angle), s = elementary_sin(angle);
    y[0] = c * x[0] - s * x[1];
    y[1] = s * x[0] + c * x[1];
}

enum { CURVE_RAMP = 1, CURVE_ZERO, CURVE_FIRST = 10, TURN_POINTS = 72 };

/* Displacement curves of one node: a straight ramp to F X, then the rotation on chords of 1/72 turn. */
static void write_turning_node(SceneText *deck, int node, const double x[2], const double end[2], double turns)
{
    enum { LIMIT = 2048 };
    double pairs[2][2 * LIMIT];
    int count = 0, points = (int)ceil(turns * TURN_POINTS);
    assert_true(points + 2 <= LIMIT);
    for (int c = 0; c < 2; c++) memcpy(pairs[c], (double[4]){0, 0, 1e-3, end[c] - x[c]}, 4 * sizeof(double));
    for (count = 2; count < points + 2; count++) {
        double share = (count - 1.0) / points, y[2];
        rotate(2 * PI * turns * share, end, y);
        for (int c = 0; c < 2; c++) {
            pairs[c][2 * count] = 1e-3 + 19e-3 * share;
            pairs[c][2 * count + 1] = y[c] - x[c];
        }
    }
    for (int c = 0; c < 2; c++) {
        scene_write_curve(deck, CURVE_FIRST + 2 * node + c, count, pairs[c]);
        scene_write_motion(deck, node, c + 1, 2, CURVE_FIRST + 2 * node + c, 1);
    }
}

/* A scale factor of 0 on the card would mean 1. */
static void write_ramp_motion(SceneText *deck, int node, const double x[2], const double end[2])
{
    for (int c = 0; c < 2; c++) {
        double way = end[c] - x[c];
        scene_write_motion(deck, node, c + 1, 2, way == 0 ? CURVE_ZERO : CURVE_RAMP, way == 0 ? 1 : way);
    }
}

/* Unit cell or patch whose outer nodes follow F; the inner one, if any, is off the middle and free in the plane. */
static void make_patch(Scene *scene, const PatchCase *patch)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    int n = patch->cells;
    deck->exact = true;
    scene_add_rectangle(mesh, 1, patch->pattern, n, n, patch_size, patch_size);
    if (n == 2) {
        mesh->x[3 * 4] = 0.58 * patch_size;
        mesh->x[3 * 4 + 1] = 0.43 * patch_size;
    }
    scene_begin(deck, "patch", 0.02, 0.8);
    scene_write_part(deck, 1, 1, 1, "patch");
    scene_write_section(deck, 1, 9, patch_thickness);
    scene_write_fabric(deck, 1, &patch->fabric);
    scene_write_ramp(deck, CURVE_RAMP, 1e-3, 1);
    scene_write_ramp(deck, CURVE_ZERO, 0, 0);
    scene_write_damping(deck, 0, 1.2e4);
    scene_write_node_set(deck, 1, mesh, scene_select_all, NULL);
    scene_write_spc(deck, 1, false, false, true);
    for (int i = 0; i < mesh->node_count; i++) {
        const double *x = mesh->x + 3 * i, *f = patch->f;
        if (n == 2 && i == 4) continue;
        double end[2] = {f[0] * x[0] + f[1] * x[1], f[2] * x[0] + f[3] * x[1]};
        if (patch->turns > 0)
            write_turning_node(deck, i + 1, x, end, patch->turns);
        else
            write_ramp_motion(deck, i + 1, x, end);
    }
    scene_end(deck, mesh);
}

/* The stress (over the reference thickness) of every element must be the expected; returns the first element's. */
static Plane run_patch(const PatchCase *patch, const Plane *expected, double tolerance)
{
    Scene scene = {0};
    make_patch(&scene, patch);
    SceneMesh mesh = scene.mesh;
    scene.mesh = (SceneMesh){0};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.one_point = patch->one_point});
    Plane first = {0};
    for (int e = 0; e < mesh.shell_count; e++) {
        ElementResult result = verify_element(&run, e);
        double share = result.thickness / patch_thickness;
        Plane stress = {result.stress[0] * share, result.stress[1] * share, result.stress[3] * share};
        if (e == 0) first = stress;
        if (!expected) continue;
        double scale = fabs(expected->xx) + fabs(expected->yy) + fabs(expected->xy);
        double error =
            fmax(fabs(stress.xx - expected->xx), fmax(fabs(stress.yy - expected->yy), fabs(stress.xy - expected->xy)));
        if (!(error <= tolerance * scale))
            fail_msg("element %d: stress %.15g %.15g %.15g, expected %.15g %.15g %.15g, off by %.2g of the largest", e,
                     stress.xx, stress.yy, stress.xy, expected->xx, expected->yy, expected->xy, error / scale);
    }
    if (patch->cells == 2 && patch->turns == 0) {
        const double *x = mesh.x + 3 * 4, *f = patch->f;
        double force = 0;
        for (int i = 0; i < 3 * mesh.node_count; i++) force = fmax(force, fabs(run.f[i]));
        verify_near("inner node x", run.x[12], f[0] * x[0] + f[1] * x[1], 1e-12 * patch_size);
        verify_near("inner node y", run.x[13], f[2] * x[0] + f[3] * x[1], 1e-12 * patch_size);
        verify_near("residual force over largest", hypot(run.f[12], run.f[13]) / force, 0, 1e-12);
    }
    verify_free(&run);
    scene_mesh_free(&mesh);
    return first;
}

static Plane push_forward(const double f[4], Plane s)
{
    double det = f[0] * f[3] - f[1] * f[2];
    return (Plane){(f[0] * f[0] * s.xx + 2 * f[0] * f[1] * s.xy + f[1] * f[1] * s.yy) / det,
                   (f[2] * f[2] * s.xx + 2 * f[2] * f[3] * s.xy + f[3] * f[3] * s.yy) / det,
                   (f[0] * f[2] * s.xx + (f[0] * f[3] + f[1] * f[2]) * s.xy + f[1] * f[3] * s.yy) / det};
}

static Plane pull_back(const double f[4], Plane sigma)
{
    double det = f[0] * f[3] - f[1] * f[2];
    const double inverse[4] = {f[3] / det, -f[1] / det, -f[2] / det, f[0] / det};
    return push_forward(inverse, sigma); /* det(inverse) = 1 / det: the factor comes out as J */
}

static Plane green_strain(const double f[4])
{
    return (Plane){0.5 * (f[0] * f[0] + f[2] * f[2] - 1), 0.5 * (f[1] * f[1] + f[3] * f[3] - 1),
                   0.5 * (f[0] * f[1] + f[2] * f[3])};
}

static const double affine[4] = {1.05, 0.08, 0.02, 0.97};

static SceneFabric orthotropic(int form, double angle)
{
    return (SceneFabric){.form = form,
                         .density = 1000,
                         .ea = 3e8,
                         .eb = 2e8,
                         .gab = 1e7,
                         .prba = 0.4 / 3,
                         .prab = 0.2,
                         .aopt = 2,
                         .vector = {elementary_cos(angle), elementary_sin(angle), 0}};
}

/* S = D : E for fibres at an angle to x. */
static Plane fabric_stress(double angle, Plane e)
{
    const double q11 = 3e8 / (1 - 0.08 / 3), q22 = 2e8 / (1 - 0.08 / 3), q12 = 0.2 * q22, g = 1e7;
    double c = elementary_cos(angle), s = elementary_sin(angle);
    Plane m = {c * c * e.xx + s * s * e.yy + 2 * s * c * e.xy, s * s * e.xx + c * c * e.yy - 2 * s * c * e.xy,
               s * c * (e.yy - e.xx) + (c * c - s * s) * e.xy};
    Plane t = {q11 * m.xx + q12 * m.yy, q12 * m.xx + q22 * m.yy, 2 * g * m.xy};
    return (Plane){c * c * t.xx + s * s * t.yy - 2 * s * c * t.xy, s * s * t.xx + c * c * t.yy + 2 * s * c * t.xy,
                   s * c * (t.xx - t.yy) + (c * c - s * s) * t.xy};
}

/* Symmetric stretch with a given Green strain: F = U = sqrt(I + 2 E). */
static void stretch_of(Plane e, double f[4])
{
    double c11 = 1 + 2 * e.xx, c22 = 1 + 2 * e.yy, c12 = 2 * e.xy, root = sqrt(c11 * c22 - c12 * c12);
    double scale = 1 / sqrt(c11 + c22 + 2 * root);
    memcpy(f, (double[4]){(c11 + root) * scale, c12 * scale, c12 * scale, (c22 + root) * scale}, 4 * sizeof(double));
}

/* FORM 0, isotropic: in the principal axes of U the second Piola-Kirchhoff stress is S_i = T_i / l_i, T = D : (U - 1).
 */
static Plane isotropic_biot(const double f[4], double e, double nu)
{
    Plane g = green_strain(f);
    double mean = 0.5 * (g.xx + g.yy), half = 0.5 * (g.xx - g.yy), radius = hypot(half, g.xy);
    double l1 = sqrt(1 + 2 * (mean + radius)), l2 = sqrt(1 + 2 * (mean - radius)), q = e / (1 - nu * nu);
    double s1 = q * ((l1 - 1) + nu * (l2 - 1)) / l1, s2 = q * ((l2 - 1) + nu * (l1 - 1)) / l2;
    double centre = 0.5 * (s1 + s2), spread = 0.5 * (s1 - s2) / radius;
    return (Plane){centre + spread * half, centre - spread * half, spread * g.xy};
}

/* FORM 0, orthotropic with fibre 1 along x: 1/2 (S U + U S) must be D : (U - 1). */
static void check_biot_pair(const double f[4], Plane cauchy)
{
    Plane s = pull_back(f, cauchy);
    double u[4];
    stretch_of(green_strain(f), u);
    Plane t = fabric_stress(0, (Plane){u[0] - 1, u[3] - 1, u[1]});
    verify_close("A3, FORM 0, Biot stress 11 [Pa]", s.xx * u[0] + s.xy * u[1], t.xx, 1e-12);
    verify_close("A3, FORM 0, Biot stress 22 [Pa]", s.yy * u[3] + s.xy * u[1], t.yy, 1e-12);
    verify_close("A3, FORM 0, Biot stress 12 [Pa]", 0.5 * (s.xy * (u[0] + u[3]) + (s.xx + s.yy) * u[1]), t.xy, 1e-12);
}

static void patch_test(void **state)
{
    (void)state;
    Plane s = fabric_stress(0, green_strain(affine)), cauchy = push_forward(affine, s);
    verify_close("A3 reference S11", s.xx, 14775000, 1e-9);
    verify_close("A3 reference Cauchy 11", cauchy.xx, 16168777.2, 1e-8);
    verify_close("A3 reference Cauchy 22", cauchy.yy, -3008103.85, 1e-8);
    verify_close("A3 reference Cauchy 12", cauchy.xy, 1090548.14, 1e-8);
    for (int k = 0; k < PATCH_KINDS; k++) {
        print_message("  A3, kind %d\n", k);
        PatchCase patch = patch_kinds[k];
        memcpy(patch.f, affine, sizeof affine);
        patch.fabric = orthotropic(2, 0);
        run_patch(&patch, &cauchy, 1e-12);
        patch.fabric = scene_isotropic(2, false, 1000, 2e8, 0.3);
        run_patch(&patch, &(Plane){11674876.2, -1912369.63, 7993451.33}, 1e-8);
        patch.fabric.elastic = true;
        run_patch(&patch, &(Plane){8716152.37, -3927928.42, 7438582.13}, 1e-8);
        patch.fabric = scene_isotropic(0, false, 1000, 2e8, 0.3);
        Plane biot = push_forward(affine, isotropic_biot(affine, 2e8, 0.3));
        run_patch(&patch, &biot, 1e-12);
        patch.fabric = orthotropic(0, 0);
        check_biot_pair(affine, run_patch(&patch, NULL, 0));
    }
}

static void orthotropic_fabric(void **state)
{
    (void)state;
    const double table[7][4] = {{0, 3e8, 0.2, 0},
                                {15, 1.100012e8, 0.6943824, -2.197208},
                                {30, 4.833837e7, 0.8509567, -0.9802745},
                                {45, 3.738318e7, 0.8691589, -0.03115265},
                                {60, 4.64666e7, 0.8180058, 0.8752474},
                                {75, 9.492901e7, 0.5992394, 1.817043},
                                {90, 2e8, 0.1333333, 0}};
    for (int i = 0; i < 7 * PATCH_KINDS; i++) {
        const double *row = table[i % 7], strain = 0.01;
        PatchCase patch = patch_kinds[i / 7];
        double angle = row[0] * PI / 180;
        Plane e = {strain, -row[2] * strain, 0.5 * row[3] * strain};
        patch.cells = 1;
        patch.fabric = orthotropic(2, angle);
        stretch_of(e, patch.f);
        Plane exact = push_forward(patch.f, fabric_stress(angle, e));
        Plane s = pull_back(patch.f, run_patch(&patch, &exact, 1e-8));
        verify_close("A4 modulus off axis [Pa]", s.xx / strain, row[1], 1e-6);
        verify_near("A4 transverse stress", fmax(fabs(s.yy), fabs(s.xy)) / s.xx, 0, 2e-6);
    }
}

static void biaxial_and_shear(void **state)
{
    (void)state;
    for (int k = 0; k < PATCH_KINDS; k++) {
        PatchCase patch = patch_kinds[k];
        patch.cells = 1;
        patch.fabric = orthotropic(2, 0);
        stretch_of((Plane){0.01, 0.01, 0}, patch.f);
        Plane s = pull_back(patch.f, run_patch(&patch, NULL, 0));
        verify_close("A4 biaxial, fibre 1 [Pa]", s.xx, 3493151, 2e-7);
        verify_close("A4 biaxial, fibre 2 [Pa]", s.yy, 2465753, 2e-7);
        const double table[4][2] = {{5, 871557.4}, {10, 1736482}, {20, 3420201}, {30, 5000000}};
        for (int i = 0; i < 4; i++) {
            double gamma = table[i][0] * PI / 180, sine = elementary_sin(gamma);
            memcpy(patch.f, (double[4]){1, sine, 0, elementary_cos(gamma)}, sizeof patch.f);
            Plane t = pull_back(patch.f, run_patch(&patch, NULL, 0));
            verify_close("A4 trellis shear [Pa]", t.xy, 1e7 * sine, 1e-8);
            verify_close("A4 trellis shear, table [Pa]", t.xy, table[i][1], 2e-7);
        }
    }
}

static void rigid_rotation(void **state)
{
    (void)state;
    const double turns = 10 + 30.0 / 360;
    double c = elementary_cos(2 * PI * turns), s = elementary_sin(2 * PI * turns);
    for (int k = 0; k < 2 * PATCH_KINDS; k++) {
        PatchCase patch = patch_kinds[k % PATCH_KINDS];
        patch.cells = 1;
        patch.fabric = orthotropic(k < PATCH_KINDS ? 2 : 0, 0.3);
        memcpy(patch.f, affine, sizeof affine);
        Plane still = run_patch(&patch, NULL, 0);
        patch.turns = turns;
        Plane turned = {c * c * still.xx + s * s * still.yy - 2 * s * c * still.xy,
                        s * s * still.xx + c * c * still.yy + 2 * s * c * still.xy,
                        s * c * (still.xx - still.yy) + (c * c - s * s) * still.xy};
        run_patch(&patch, &turned, 1e-12);
    }
}

/* FORM 2 follows the reference, a tension field of relaxed energy. FORM 0 follows LS-DYNA, which clips the negative
 * principal values of the stress D : (U - 1), so that a lateral squeeze lowers the tension. */
static void uniaxial_cut_off(void **state)
{
    (void)state;
    for (int k = 0; k < 2 * PATCH_KINDS; k++) {
        bool green = k < PATCH_KINDS;
        PatchCase patch = patch_kinds[k % PATCH_KINDS];
        patch.fabric = scene_isotropic(green ? 2 : 0, true, 1000, 2e8, 0.3);
        patch.cells = 1;
        const double stretch = 1.02, squeeze = green ? 0.9 : 0.99;
        memcpy(patch.f, (double[4]){stretch, 0, 0, squeeze}, sizeof patch.f);
        Plane taut = push_forward(patch.f, (Plane){2e8 * 0.5 * (stretch * stretch - 1), 0, 0});
        if (!green) taut.xx = 2e8 / (1 - 0.09) * ((stretch - 1) + 0.3 * (squeeze - 1)) / squeeze;
        run_patch(&patch, &taut, 1e-10);
        memcpy(patch.f, (double[4]){0.99, 0, 0, 0.98}, sizeof patch.f);
        Plane slack = run_patch(&patch, NULL, 0);
        verify_near("A6 slack stress [Pa]", fabs(slack.xx) + fabs(slack.yy) + fabs(slack.xy), 0, 1e-6);
    }
}

static void wagner_shear(void **state)
{
    (void)state;
    const double table[4][3] = {
        {0.001, 50075.05, 50050.02}, {0.01, 507550.2, 505018.7}, {0.02, 1030402, 1020150}, {0.1, 5801561, 5518731}};
    for (int i = 0; i < 4 * PATCH_KINDS; i++) {
        const double *row = table[i % 4], gamma = row[0], e = 2e8;
        double mean = gamma * gamma / 4, radius = sqrt(mean * mean + gamma * gamma / 4), e1 = mean + radius;
        double n1 = gamma / 2, n2 = e1, length = hypot(n1, n2);
        Plane s = {e * e1 * n1 * n1 / (length * length), e * e1 * n2 * n2 / (length * length),
                   e * e1 * n1 * n2 / (length * length)};
        PatchCase patch = patch_kinds[i / 4];
        patch.cells = 1;
        patch.fabric = scene_isotropic(2, true, 1000, e, 0.3);
        memcpy(patch.f, (double[4]){1, gamma, 0, 1}, sizeof patch.f);
        Plane exact = push_forward(patch.f, s), sigma = run_patch(&patch, &exact, 1e-10);
        verify_close("A6 Wagner P12 [Pa]", sigma.xy, row[1], 5e-7); /* P = J sigma F^-T: its second column */
        verify_close("A6 Wagner P22 [Pa]", sigma.yy, row[2], 5e-7);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patch_test),     cmocka_unit_test(orthotropic_fabric), cmocka_unit_test(biaxial_and_shear),
        cmocka_unit_test(rigid_rotation), cmocka_unit_test(uniaxial_cut_off),   cmocka_unit_test(wagner_shear),
    };
    return cmocka_run_group_tests_name("membrane patches", tests, NULL, NULL);
}
