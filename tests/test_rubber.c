/* Rubber membranes: closed forms on imposed deformations, rotation, cards; a balloon through its limit point (A2). */
#include "tests/affine_patch.h"

#include <stdio.h>

#include "solver/elementary.h"

static const char mooney[] = "*MAT_MOONEY-RIVLIN_RUBBER\n1,1000.,.499,1.6e5,4e4\n";
static const char ogden[] = "*MAT_OGDEN_RUBBER\n1,1000.,.499\n6.3e5,1.2e3,-1e4\n1.3,5.,-2.\n";

/* Cauchy stress of incompressible rubber in plane stress along the principal stretches: s_i = l_i dw/dl_i, with
 * l_3 = 1/(l_1 l_2) and no stress across. */
static double ogden_stress(double l, double l3)
{
    const double mu[] = {6.3e5, 1.2e3, -1e4}, alpha[] = {1.3, 5, -2};
    double s = 0;
    for (int i = 0; i < 3; i++) s += mu[i] * (pow(l, alpha[i]) - pow(l3, alpha[i]));
    return s;
}

static double mooney_stress(double l, double l3)
{
    return 2 * 1.6e5 * (l * l - l3 * l3) - 2 * 4e4 * (1 / (l * l) - 1 / (l3 * l3));
}

static void test_closed_forms(void **unused)
{
    (void)unused;
    const double stretches[][2] = {{1.5, 1},      {2, 0.70710678118654752}, {1.6, 1.6}, {3, 1.2}, {0.8, 1.1},
                                   {1.2, 1.19999}};
    for (int i = 0; i < 6 * 2 * AFFINE_KINDS; i++) {
        const double *l = stretches[i % 6], l3 = 1 / (l[0] * l[1]), angle = 0.4, c = cos(angle), s = sin(angle);
        bool first = i / 6 % 2 == 0;
        const AffineKind *kind = &affine_kinds[i / 12];
        /* U = sum l n n */
        const double f[4] = {l[0] * c * c + l[1] * s * s, (l[0] - l[1]) * c * s, (l[0] - l[1]) * c * s,
                             l[0] * s * s + l[1] * c * c};
        AffinePatch patch = {.pattern = kind->pattern,
                             .one_point = kind->one_point,
                             .material = first ? mooney : ogden,
                             .path = affine_straight,
                             .user = f,
                             .points = 1,
                             .step_scale = 0.05};
        VerifyRun run;
        affine_run(&patch, &run);
        double s1 = first ? mooney_stress(l[0], l3) : ogden_stress(l[0], l3);
        double s2 = first ? mooney_stress(l[1], l3) : ogden_stress(l[1], l3);
        Plane pk = {s1 / (l[0] * l[0]) * c * c + s2 / (l[1] * l[1]) * s * s,
                    s1 / (l[0] * l[0]) * s * s + s2 / (l[1] * l[1]) * c * c,
                    (s1 / (l[0] * l[0]) - s2 / (l[1] * l[1])) * c * s};
        affine_check(first ? "Mooney-Rivlin" : "Ogden", affine_stress(&run, f, true), pk, 1e-9);
        ElementResult r = verify_element(&run, 0);
        verify_close("thickness", r.thickness, affine_thickness * l3, 1e-10);
        verify_free(&run);
    }
}

static void test_rotation(void **unused)
{
    (void)unused;
    const double f[4] = {1.5, 0.1, -0.05, 1.2};
    for (int i = 0; i < 2 * AFFINE_KINDS; i++) {
        AffinePatch patch = {.pattern = affine_kinds[i / 2].pattern,
                             .one_point = affine_kinds[i / 2].one_point,
                             .material = i % 2 ? ogden : mooney,
                             .path = affine_straight,
                             .user = f,
                             .points = 1,
                             .step_scale = 0.05};
        VerifyRun still, turned;
        double end[4];
        affine_run(&patch, &still);
        patch.path = affine_spinning;
        patch.points = 800;
        affine_run(&patch, &turned);
        affine_spinning(f, 1, end);
        affine_check("rotation", affine_stress(&turned, end, true), affine_stress(&still, f, true), 1e-10);
        verify_free(&still);
        verify_free(&turned);
    }
}

/* ---- A2: neo-Hookean sphere, mu = 0.4 MPa, t0 = 1 mm, R0 = 0.1 m ---- */

static const double radius = 0.1, limit_pressure = 4957.8516;

static void make_balloon(Scene *scene, double end)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_sphere(&scene->mesh, 1, SCENE_DIAGONAL, 8, radius);
    scene_begin(deck, "balloon", end, 0.9);
    scene_write_part(deck, 1, 1, 1, "rubber");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_print(deck, "*MAT_MOONEY-RIVLIN_RUBBER\n1,1000.,.4999,2e5,0.\n");
    scene_write_part_set(deck, 1, 1, (const int[]){1});
}

/* The facets' own sphere: uniform stretching has p = h A/(3 V) dw/dl / l^2 with the area A and volume V of the facets.
 */
static void test_balloon(void **unused)
{
    (void)unused;
    const double table[][2] = {{1.05, 1933.6},  {1.1, 3167.5}, {1.2, 4434}, {1.3, 4878.9},
                               {1.383, 4957.9}, {1.5, 4865.1}, {2, 3937.5}, {3, 2663}};
    Scene scene = {0};
    make_balloon(&scene, 1.2);
    SceneText *deck = &scene.deck;
    double volume = verify_volume(&scene.mesh, scene.mesh.x), area = verify_area(&scene.mesh, scene.mesh.x);
    double facets = area / (3 * volume) * radius; /* 1 for a smooth sphere */
    scene_write_damping(deck, 0, 10);
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 293.15 / air.gamma; /* enters with the enthalpy of air at rest */
    double mass = 101325 / (scene_gas_constant(&air) * 293.15) * volume;
    scene_write_curve(deck, 1, 4, (const double[]){0, 0, 0.3, 12 * mass, 0.9, 60 * mass, 2, 60 * mass});
    scene_write_simple_airbag(deck, 1, &air);
    scene_end(deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 2});
    for (int i = 0; i < 8; i++) {
        double l = table[i][0];
        size_t k = 1;
        while (k + 1 < run.count && cbrt(run.samples[k].volume / volume) < l) k++;
        assert_true(k + 1 < run.count);
        const VerifySample *a = &run.samples[k - 1], *b = &run.samples[k];
        double la = cbrt(a->volume / volume), lb = cbrt(b->volume / volume), share = (l - la) / (lb - la);
        double p = a->applied + share * (b->applied - a->applied);
        verify_close("A2 pressure over stretch [Pa]", p / facets, table[i][1], 2e-3);
    }
    double largest = verify_largest(&run, 0, offsetof(VerifySample, applied)) / facets;
    verify_close("A2 limit pressure [Pa]", largest, limit_pressure, 2e-3);
    verify_balance(&run, 1e-2);
    verify_free(&run);
}

/* Under a pressure given as such: below the limit it comes to rest, above it runs away. */
static void test_balloon_by_pressure(void **unused)
{
    (void)unused;
    for (int i = 0; i < 2; i++) {
        Scene scene = {0};
        make_balloon(&scene, 0.5);
        double volume = verify_volume(&scene.mesh, scene.mesh.x);
        double facets = verify_area(&scene.mesh, scene.mesh.x) / (3 * volume) * radius;
        scene_write_damping(&scene.deck, 0, 60);
        scene_write_ramp(&scene.deck, 1, 0.1, 1);
        scene_write_pressure(&scene.deck, 1, &scene.mesh, 0, 1, (i ? 1.01 : 0.97) * limit_pressure * facets);
        scene_end(&scene.deck, &scene.mesh);
        SceneMesh mesh = scene.mesh;
        scene.mesh = (SceneMesh){0};
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.stop_time = i ? 0.13 : 0});
        double l = cbrt(verify_volume(&mesh, run.x) / volume);
        if (i)
            verify_between("A2 stretch above the limit", l, 1.6, 1e3);
        else
            verify_close("A2 stretch below the limit", l, 1.273455, 0.002);
        verify_free(&run);
        scene_mesh_free(&mesh);
    }
}

/* ---- cards ---- */

static const char square[] =
    "*KEYWORD\n*CONTROL_TERMINATION\n1e-4\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n"
    "*ELEMENT_SHELL\n1,1,1,2,3,3\n2,1,1,3,4,4\n*PART\nsquare\n1,1,1\n*SECTION_SHELL\n1,%d\n.001\n";

static void expect_error(int elform, const char *material, const char *text)
{
    char deck[2000];
    int length = snprintf(deck, sizeof deck, square, elform);
    length += snprintf(deck + length, sizeof deck - (size_t)length, "%s*END\n", material);
    VerifyRun run;
    verify_build(&run, deck, (size_t)length, &(VerifyOptions){0});
    if (!verify_message(&run.diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_WARNING, stderr);
        fail_msg("no error '%s'", text);
    }
    verify_free(&run);
}

static void test_cards(void **unused)
{
    (void)unused;
    expect_error(9, "*MAT_027\n1,1000.,.45,1e5,0.\n", "PR must lie between");
    expect_error(9, "*MAT_027\n1,1000.,.49,0.,0.\n", "A and B are zero");
    expect_error(9, "*MAT_027\n1,1000.,.49,1e5,-1e4\n", "A and B must not be negative");
    expect_error(9, "*MAT_077_O\n1,1000.,.49\n1e5,1e3\n2.,-2.\n", "MU2 = 1000 and ALPHA2 = -2");
    expect_error(9, "*MAT_077_O\n1,1000.,.49\n0\n0\n", "MU and ALPHA are all zero");
    expect_error(9, "*MAT_077_O\n1,1000.,.49,2\n1e5\n2.\n", "N (value 4) = 2");
    expect_error(2, "*MAT_077_O\n1,1000.,.49\n1e5\n2.\n", "shell with bending");
    expect_error(2, "*MAT_002\n1,1000.,1e8,1e8,0,.2\n1e7\n0\n0\n", "shell with bending");
    expect_error(9, "*MAT_002\n1,1000.,-1e8,1e8,0,.2\n1e7\n0\n0\n", "EA = -1e+08");
    expect_error(9, "*MAT_002\n1,1000.,1e8,1e8,0,.2\n1e7,0,0,1.\n0\n0\n", "AOPT = 1");
    expect_error(9, "*MAT_FABRIC_MAP\n1,1000.,7,8,9,,2.\n0\n0\n0\n0\n0\n", "TH = 2");
    expect_error(9, "*MAT_FABRIC_MAP\n1,1000.,7,7,0\n0\n0\n0\n0\n0\n*DEFINE_CURVE\n7\n0.,0.\n.1,1e7\n", "SXY = 0");
}

/* *MAT_ORTHOTROPIC_ELASTIC is FORM 2; *MAT_FABRIC_MAP of curves FORM 24 with its own shear strain. */
static void test_orthotropic(void **unused)
{
    (void)unused;
    const double f[4] = {1.05, 0.08, 0.02, 0.97};
    for (int i = 0; i < AFFINE_KINDS; i++) {
        AffinePatch patch = {.pattern = affine_kinds[i].pattern,
                             .one_point = affine_kinds[i].one_point,
                             .material = "*MAT_ORTHOTROPIC_ELASTIC\n1,1000.,3e8,2e8,0,.13333333333333333\n"
                                         "1e7,0,0,2.\n0,0,0,1.\n0\n",
                             .path = affine_straight,
                             .user = f,
                             .points = 1,
                             .step_scale = 0.05};
        VerifyRun run;
        affine_run(&patch, &run); /* reference A3 */
        affine_check("A3", affine_stress(&run, f, false), (Plane){14775000, -3300000, 1034000}, 1e-8);
        verify_free(&run);
        patch.material = "*MAT_FABRIC_MAP\n1,1000.,101,102,103\n0\n0,1.\n2.\n0,0,0,1.\n0\n"
                         "*DEFINE_CURVE\n101\n0.,0.\n.02,1e6\n.2,6e7\n*DEFINE_CURVE\n102\n0.,0.\n.2,4e7\n"
                         "*DEFINE_CURVE\n103\n0.,0.\n.02,2e5\n.3,4e6\n";
        affine_run(&patch, &run);
        double l1 = hypot(1.05, 0.02), e12 = 0.5 * (1.05 * 0.08 + 0.02 * 0.97);
        Plane s = {(1e6 + 59e6 * (l1 - 1.02) / 0.18) / l1, 0, 2e5 + 3.8e6 * (e12 - 0.02) / 0.28};
        affine_check("map", affine_stress(&run, f, false), s, 1e-9);
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_forms),        cmocka_unit_test(test_rotation), cmocka_unit_test(test_balloon),
        cmocka_unit_test(test_balloon_by_pressure), cmocka_unit_test(test_cards),    cmocka_unit_test(test_orthotropic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
