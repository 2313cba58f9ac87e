/* What becomes of a reference geometry in a run: initial tension left out and back (TSRFAC), liners that wait (LNRC),
 * births, and that nothing of it depends on threads, a restart, the place of the reference or the kind of its table. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/memory.h"

static const double E = 1e8, NU = 0.3, THICKNESS = 1e-3;

/* A square of side 1 of n x n quads or 2 n x n triangles, all its nodes held, and a reference that is scaled. */
static void make_patch_of(Scene *scene, ScenePattern pattern, const char *material, double scale, double end)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_rectangle(&scene->mesh, 1, pattern, 3, 3, 1, 1);
    scene_begin(deck, "patch", end, 0.9);
    scene_write_part(deck, 1, 1, 1, "cloth");
    scene_write_section(deck, 1, 9, THICKNESS);
    scene_print(deck, "%s", material);
    scene_write_curve(deck, 7, 3, (const double[]){0, 0, 0.002, 1, 1, 1});
    scene_write_curve(deck, 11, 2, (const double[]){0, 0, 1, 1e8});
    scene_write_curve(deck, 8, 3, (const double[]){0, 0, 1e-4, 0.2, 1, 0.2});
    scene_write_node_set(deck, 1, &scene->mesh, scene_select_all, NULL);
    scene_write_spc(deck, 1, true, true, true);
    scene_print(deck, "*AIRBAG_REFERENCE_GEOMETRY\n");
    for (int i = 0; i < scene->mesh.node_count; i++)
        scene_print(deck, "%d,%.17g,%.17g\n", i + 1, scale * scene->mesh.x[3 * i], scale * scene->mesh.x[3 * i + 1]);
    scene_end(deck, &scene->mesh);
}

static void make_patch(Scene *scene, ScenePattern pattern, int form, const char *tsrfac, double scale, double end)
{
    char material[200];
    snprintf(material, sizeof material, "*MAT_FABRIC\n1,800,%g,%g,,%g,%g\n,,,1\n0,,,,,%d,,%s\n", E, E, NU, NU, form,
             tsrfac);
    make_patch_of(scene, pattern, material, scale, end);
}

/* A reference smaller than the mesh gives no tension; TSRFAC brings it back, its energy as external work. */
static void initial_tension_is_left_out_and_comes_back(void **state)
{
    (void)state;
    static const char *const factors[] = {"0", "7", "-8", ".05"};
    const double scale = 0.8, l = 1 / scale;
    for (int form = 0; form <= 2; form += 2) {
        double stress = form == 2 ? E / (1 - NU) * 0.5 * (l * l - 1) : E / (1 - NU) * (l - 1) / l;
        double energy =
            (form == 2 ? stress * 0.5 * (l * l - 1) : E / (1 - NU) * (l - 1) * (l - 1)) * scale * scale * THICKNESS;
        for (int pattern = SCENE_QUADS; pattern <= SCENE_DIAGONAL; pattern++) {
            for (size_t i = 0; i < 4; i++) {
                Scene scene = {0};
                VerifyRun run;
                make_patch(&scene, (ScenePattern)pattern, form, factors[i], scale, 0.2);
                verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
                ElementResult result = verify_element(&run, 4);
                const VerifySample *last = &run.samples[run.count - 1];
                verify_near("first energy", run.samples[0].internal, 0, 1e-12);
                verify_near("stress / E", result.stress[0] / E, i == 0 ? 0 : stress / E, 1e-9);
                verify_near("stress yy / E", result.stress[1] / E, i == 0 ? 0 : stress / E, 1e-9);
                verify_near("energy", last->internal, i == 0 ? 0 : energy, 1e-6 * energy);
                verify_near("external work", last->external, i == 0 ? 0 : energy, 1e-6 * energy);
                verify_free(&run);
            }
        }
    }
}

/* ISREFG = 1 of FORM 12 and of MAT_FABRIC_MAP keeps the initial tension from the start, as energy that is there at
 * first; SRFAC of the map brings it back over its curve, as external work. */
static void initial_tension_stays(void **state)
{
    (void)state;
    static const char *const cards[] = {
        "*MAT_FABRIC\n1,800,1e8,1e8,,.3,.3\n,,,1\n0,,,,,12\n0\n,,,,,,,1\n",
        "*MAT_FABRIC_MAP\n1,800,11,11,11\n\n1,1\n0\n\n\n",
        "*MAT_FABRIC_MAP\n1,800,11,11,11\n\n,1,7\n0\n\n\n",
    };
    const double scale = 0.8, l = 1 / scale;
    for (int i = 0; i < 3; i++) {
        const double stress = i == 0 ? E / (1 - NU) * 0.5 * (l * l - 1) : E * (l - 1) / l; /* second Piola-Kirchhoff */
        const double energy = (i == 0 ? stress * 0.5 * (l * l - 1) : E * (l - 1) * (l - 1)) * scale * scale * THICKNESS;
        for (int pattern = SCENE_QUADS; pattern <= SCENE_DIAGONAL; pattern++) {
            Scene scene = {0};
            VerifyRun run;
            make_patch_of(&scene, (ScenePattern)pattern, cards[i], scale, 0.01);
            verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
            ElementResult result = verify_element(&run, 4);
            const VerifySample *last = &run.samples[run.count - 1];
            verify_near("stress / E", result.stress[0] / E, stress / E, 1e-9);
            verify_near("first energy", run.samples[0].internal, i < 2 ? energy : 0, 1e-6 * energy);
            verify_near("energy", last->internal, energy, 1e-6 * energy);
            verify_near("external work", last->external, i < 2 ? 0 : energy, 1e-6 * energy);
            verify_free(&run);
        }
    }
}

/* One square, 0.9 of its reference, is stretched along x to 1.1; the liner's compression across it. */
static ElementResult stretch_liner(int form, int lnrc, bool full, double stop, double *imbalance)
{
    Scene scene = {0};
    VerifyRun run;
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_add_rectangle(&scene.mesh, 1, full ? SCENE_QUADS : SCENE_DIAGONAL, 1, 1, 0.9, 0.9);
    scene_begin(deck, "liner", 0.1, 0.9);
    scene_write_part(deck, 1, 1, 1, "cloth");
    scene_write_section(deck, 1, 9, THICKNESS);
    scene_print(deck, "*MAT_FABRIC\n1,800,%g,%g,,%g,%g\n,,,1,%g,%g,.2\n0,,,,%d,%d\n", E, E, NU, NU, E, NU, lnrc, form);
    scene_write_curve(deck, 7, 2, (const double[]){0, 0, 0.1, 0.2});
    scene_write_node_set(deck, 1, &scene.mesh, scene_select_all, NULL);
    scene_write_spc(deck, 1, false, true, true);
    ScenePlane left = {0, 0, 1e-6};
    scene_write_node_set(deck, 2, &scene.mesh, scene_select_plane, &left);
    scene_write_spc(deck, 2, true, false, false);
    for (int i = 0; i < 4; i++)
        if (scene.mesh.x[3 * i] > 0.1) scene_write_motion(deck, i + 1, 1, 2, 7, 1);
    scene_print(deck, "*AIRBAG_REFERENCE_GEOMETRY_RDT\n");
    for (int i = 0; i < 4; i++)
        scene_print(deck, "%d,%.17g,%.17g\n", i + 1, scene.mesh.x[3 * i] / 0.9, scene.mesh.x[3 * i + 1] / 0.9);
    scene_end(deck, &scene.mesh);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .stop_time = stop});
    ElementResult result = verify_element(&run, 0);
    *imbalance = run.imbalance / run.energy;
    verify_free(&run);
    return result;
}

static void liners_wait_until_taut(void **state)
{
    (void)state;
    for (int form = 0; form <= 2; form += 2) {
        for (int full = 0; full <= 1; full++) {
            double off;
            ElementResult at_once = stretch_liner(form, 0, full, 0.025, &off);
            assert_true(at_once.stress[1] < -0.01 * E * 0.2);
            verify_near("balance", off, 0, 0.02);
            ElementResult waiting = stretch_liner(form, 1, full, 0.025, &off);
            for (int i = 0; i < 6; i++) assert_true(waiting.stress[i] == 0);
            ElementResult taut = stretch_liner(form, 1, full, 0.09, &off),
                          free_ = stretch_liner(form, 0, full, 0.09, &off);
            assert_true(taut.stress[1] < -0.01 * E * 0.2 && taut.stress[0] > 0.01 * E);
            for (int i = 0; i < 6; i++) verify_near("stress / E", taut.stress[i] / E, free_.stress[i] / E, 1e-9);
            stretch_liner(form, 1, full, 0.09, &off);
            verify_near("balance", off, 0, 0.02);
        }
    }
}

static bool select_square_edge(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9 * a;
    return x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small;
}

typedef struct Setup {
    int form;
    const char *option;
    double birth, scale;
    const char *material;   /* LNRC, FORM, FVOPT, TSRFAC */
    const double *rotation; /* of the reference (3 x 3), NULL none */
    bool panels;            /* the reference by shells of their own nodes */
    double end;
    const char *leak; /* FLC, FAC of card 3 with OPT = 1, then cards 4 and 5; NULL: no leakage */
} Setup;

/* A pillow that is shrunken in the mesh, filled with gas; liner, damping. */
static void make_pillow(Scene *scene, const Setup *setup)
{
    const double side = 0.6;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_rectangle(mesh, 1, SCENE_QUADS, 8, 8, side, side);
    int upper = mesh->node_count;
    scene_sew_copy(mesh, 2, select_square_edge, &side);
    int nodes = mesh->node_count;
    for (int i = 0; i < nodes; i++) {
        double *x = mesh->x + 3 * i, u = 2 * x[0] / side - 1, v = 2 * x[1] / side - 1;
        x[2] = (i < upper ? 0.05 : -0.05) * (1 - u * u) * (1 - v * v);
    }
    scene_begin(deck, "pillow", setup->end, 0.8); /* the balance is of second order in the step */
    scene_write_part(deck, 1, 1, 1, "upper");
    scene_write_part(deck, 2, 1, 1, "lower");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_print(deck, "*MAT_FABRIC\n1,800,4e8,3e8,,.2,.15\n1e8,,,1,4e8,.3,.1,.1\n0,%s,,%s\n%s",
                setup->leak ? "1e-3,1" : ",", setup->material, setup->leak ? setup->leak : "");
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    scene_write_curve(deck, 1, 3, (const double[]){0, 0.5, 0.02, 1.5, 1, 1.5});
    scene_write_curve(deck, 7, 3, (const double[]){0, 0, 0.002, 1, 1, 1});
    scene_write_damping(deck, 0, 50);
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 500;
    if (setup->leak)
        scene_print(deck, "*AIRBAG_WANG_NEFSKE\n1,1\n718,1005,300,0,1\n0\n1e5,1.16,1,0,2e4,0,1\n\n");
    else
        scene_write_simple_airbag(deck, 1, &air);
    if (!setup->panels)
        scene_print(deck, "*AIRBAG_REFERENCE_GEOMETRY%s\n", setup->option);
    else
        scene_print(deck, "*NODE\n");
    if (strstr(setup->option, "BIRTH")) SCENE_CARD(deck, setup->birth);
    for (int i = 0; i < nodes; i++) {
        const double *x = mesh->x + 3 * i, *r = setup->rotation;
        double y[3] = {x[0], x[1], x[2]};
        for (int k = 0; r && k < 3; k++) y[k] = r[3 * k] * x[0] + r[3 * k + 1] * x[1] + r[3 * k + 2] * x[2];
        scene_print(deck, "%d,%.17g,%.17g,%.17g\n", i + 1 + (setup->panels ? 10000 : 0), y[0], y[1], y[2]);
    }
    if (setup->panels) scene_print(deck, "*AIRBAG_SHELL_REFERENCE_GEOMETRY%s\n", setup->option);
    for (int e = 0; setup->panels && e < mesh->shell_count; e++)
        scene_print(deck, "%d,1,%d,%d,%d,%d\n", e + 1, mesh->shell[e][0] + 10001, mesh->shell[e][1] + 10001,
                    mesh->shell[e][2] + 10001, mesh->shell[e][3] + 10001);
    for (int i = 0; i < nodes;
         i++) { /* shrunken, and pulled along x in the middle, so that some elements start stretched */
        double *x = mesh->x + 3 * i;
        for (int k = 0; k < 3; k++) x[k] = 0.3 + setup->scale * (x[k] - 0.3);
        x[0] += 0.02 * sin(20 * x[0]);
    }
    scene_end(deck, mesh);
}

static void build_pillow(VerifyRun *run, const Setup *setup, const VerifyOptions *options)
{
    Scene scene = {0};
    make_pillow(&scene, setup);
    assert_true(scene_ok(&scene));
    int status = verify_build(run, scene.deck.text, scene.deck.length, options);
    if (status) diagnostics_print(&run->diagnostics, SEVERITY_WARNING, stderr);
    assert_int_equal(status, 0);
    scene_free(&scene);
}

/* Tension that comes back at once, within some cycles or slowly does work on the bag, and so do liners that wake: it is
 * in the ledger, and the balance closes though the step becomes much shorter in one cycle. */
static void tension_back_keeps_the_balance(void **state)
{
    (void)state;
    static const char *const materials[] = {"0,2,,.9", "0,2,,.05", "0,2,,7", "1,2,,.9", "0,0,,.9", "0,0,,.05"};
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        for (int birth = 0; birth < 2; birth++)
            for (int one = 0; one < 2; one++) {
                Setup setup = {0, birth ? "_BIRTH" : "_RDT", 0.004, 0.98, materials[i], NULL, false, 0.05, NULL};
                VerifyRun run;
                build_pillow(&run, &setup, &(VerifyOptions){.one_point = one});
                if (verify_loop(&run)) fail_msg("%s: %s", materials[i], run.failure.cause);
                const VerifySample *last = &run.samples[run.count - 1];
                assert_true(last->external > 200);
                verify_near("balance at the end", (last->held - last->given) / run.energy, 0, 0.03);
                verify_free(&run);
            }
}

static uint64_t run_pillow(const Setup *setup, int threads, int64_t first_stop)
{
    VerifyRun run;
    build_pillow(&run, setup, &(VerifyOptions){.threads = threads, .stop = first_stop > 0 ? first_stop : 300});
    if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
    if (first_stop > 0) { /* a new time loop from the state alone */
        run.options.stop = 300;
        if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
    }
    assert_int_equal(run.cycles, 300);
    uint64_t hash = state_hash(&run.state);
    verify_free(&run);
    return hash;
}

/* Births, returns and waking liners in one run: the same bits for any number of threads and after a restart. */
static void same_bits_over_threads_and_restarts(void **state)
{
    (void)state;
    static const Setup setups[] = {{0, "_BIRTH_RDT", 0.001, 0.6, "1,0,,7", NULL, false, 0.1, NULL},
                                   {2, "_BIRTH", 0.001, 0.6, "1,2,,.02", NULL, false, 0.1, NULL},
                                   {2, "_RDT", 0, 0.6, "1,2,,7", NULL, false, 0.1, NULL}};
    for (size_t i = 0; i < sizeof setups / sizeof *setups; i++) {
        uint64_t hash = run_pillow(&setups[i], 1, 0);
        assert_true(run_pillow(&setups[i], 2, 0) == hash);
        assert_true(run_pillow(&setups[i], 4, 0) == hash);
        for (int64_t stop = 7; stop < 300; stop += 73) assert_true(run_pillow(&setups[i], 2, stop) == hash);
    }
    assert_int_equal(memory_in_use(), 0);
}

static void collect(const Setup *setup, double *x, int *count)
{
    VerifyRun run;
    build_pillow(&run, setup, &(VerifyOptions){.stop = 200});
    if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
    *count = run.model.node_count / (setup->panels ? 2 : 1); /* the panels' nodes come first in the deck */
    memcpy(x, run.x + (setup->panels ? 3 * *count : 0), 3 * (size_t)*count * sizeof *x);
    verify_free(&run);
}

/* The reference may lie anywhere and come as nodes or as shells of their own nodes. */
static void the_reference_may_lie_anywhere(void **state)
{
    (void)state;
    const double c = cos(0.7), s = sin(0.7);
    const double turn[9] = {c, -s * c, s * s, s, c * c, -c * s, 0, s, c};
    static double x[3][3 * 400];
    int count = 0;
    for (int form = 0; form <= 2; form += 2) {
        const char *material = form == 0 ? "1,0" : "1,2";
        collect(&(Setup){form, "_RDT", 0, 0.6, material, NULL, false, 0.1, NULL}, x[0], &count);
        collect(&(Setup){form, "_RDT", 0, 0.6, material, turn, false, 0.1, NULL}, x[1], &count);
        collect(&(Setup){form, "_RDT", 0, 0.6, material, NULL, true, 0.1, NULL}, x[2], &count);
        double turned = 0, panels = 0;
        for (int i = 0; i < 3 * count; i++) {
            turned = fmax(turned, fabs(x[1][i] - x[0][i]));
            panels = fmax(panels, fabs(x[2][i] - x[0][i]));
        }
        verify_near("turned reference", turned, 0, 1e-9);
        verify_near("reference by panels", panels, 0, 1e-9);
    }
}

/* A0REF: the area that leakage refers to is that of the reference, or of the mesh. */
static void leakage_refers_to_the_area_asked_for(void **state)
{
    (void)state;
    for (int reference = 0; reference <= 1; reference++) {
        VerifyRun run;
        build_pillow(&run,
                     &(Setup){2, "_RDT", 0, 0.6, "0,2", NULL, reference == 1, 0.1,
                              reference ? ",,1,,,,1,0\n,,,\n" : ",,0,,,,1,0\n,,,\n"},
                     &(VerifyOptions){0});
        const GasModel *gas = &run.model.airbags[0].gas;
        assert_int_equal(gas->leak_count, 2);
        for (int i = 0; i < 2; i++) {
            const Part *part = &run.model.parts[run.model.airbags[0].part[gas->leaks[i].place]];
            verify_close("area", gas->leaks[i].initial_area, reference ? part->reference_area : part->referred_area,
                         1e-12);
            assert_true(part->reference_area > 1.5 * part->referred_area);
        }
        verify_free(&run);
    }
}

/* The example: a disc and an ellipse of one perimeter; coarser, it has nearly the volume of the fine one. */
static void panels_become_a_body(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    scene_sewn_bag(&scene, 6);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 10});
    const VerifySample *last = &run.samples[run.count - 1];
    verify_close("area of the disc", run.model.parts[0].reference_area, 0.2827, 0.02);
    verify_close("area of the ellipse", run.model.parts[1].reference_area, 0.2378, 0.02);
    verify_close("volume", last->volume, 0.0288, 0.03);
    verify_balance(&run, 0.01);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tension_back_keeps_the_balance),
        cmocka_unit_test(initial_tension_is_left_out_and_comes_back),
        cmocka_unit_test(initial_tension_stays),
        cmocka_unit_test(liners_wait_until_taut),
        cmocka_unit_test(same_bits_over_threads_and_restarts),
        cmocka_unit_test(the_reference_may_lie_anywhere),
        cmocka_unit_test(leakage_refers_to_the_area_asked_for),
        cmocka_unit_test(panels_become_a_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
