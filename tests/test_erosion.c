/* *MAT_ADD_EROSION: each criterion at its closed form, the energy of what is taken out, restart and threads, results,
 * bad cards. Holes of bags are in test_erosion_bag.c. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <hdf5.h>

#include "io/checkpoint.h"
#include "tests/program.h"

typedef struct Square {
    ScenePattern pattern;
    int form;
    bool cse;
    double vx, vy;   /* speed of the sides x = 1, y = 1 along their normals */
    double shear;    /* speed of the side y = 1 along x */
    const char *law; /* material cards in place of the fabric, or NULL */
} Square;

/* A unit square of two triangles or one quadrilateral, all of whose nodes are driven; E = 1e6, no Poisson's ratio. */
static void make_square(Scene *scene, const Square *square, double end_time, const char *erosion)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    const SceneFabric fabric = scene_isotropic(square->form, square->cse, 1000, 1e6, 0);
    deck->exact = true;
    scene_begin(deck, "square", end_time, 0.002);
    scene_write_part(deck, 1, 1, 1, "square");
    scene_write_section(deck, 1, 9, 1e-3);
    if (square->law)
        scene_print(deck, "%s", square->law);
    else
        scene_write_fabric(deck, 1, &fabric);
    scene_print(deck, "*MAT_ADD_EROSION\n%s\n", erosion);
    scene_add_rectangle(mesh, 1, square->pattern, 1, 1, 1, 1);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_curve(deck, 2, 2, (const double[]){0, 0, 1, 0});
    scene_print(deck, "*BOUNDARY_PRESCRIBED_MOTION_NODE\n");
    for (int i = 0; i < 4; i++) {
        const double x = mesh->x[3 * i], y = mesh->x[3 * i + 1];
        const double speed[3] = {square->vx * x + square->shear * y, square->vy * y, 0};
        for (int k = 0; k < 3; k++) /* a factor of 0 would count as 1 */
            scene_print(deck, "%d,%d,0,%d,%.17g\n", i + 1, k + 1, speed[k] != 0 ? 1 : 2, speed[k]);
    }
    scene_end(deck, mesh);
}

typedef struct Watch {
    double time;    /* at which the first element was found eroded, -1 never */
    double highest; /* stress after it */
    int64_t count;
} Watch;

static void watch(void *user, const Model *model, const State *state, const StepView *view)
{
    Watch *w = user;
    w->count = *state->eroded_count;
    if (w->count == 0) return;
    if (w->time < 0.0) w->time = state->clock->time;
    for (int e = 0; e < model->element_count; e++) {
        ElementResult result;
        membrane_result(model, state, view->x, e, &result);
        for (int k = 0; state->eroded[model->element_slot[e]] && k < 6; k++)
            w->highest = fmax(w->highest, fabs(result.stress[k]));
    }
}

/* Runs the square and returns when it erodes. */
static double eroded_at(const Square *square, double end_time, const char *erosion)
{
    Scene scene = {0};
    VerifyRun run;
    Watch seen = {.time = -1};
    make_square(&scene, square, end_time, erosion);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = watch, .user = &seen});
    if (seen.time >= 0.0) {
        assert_int_equal(seen.count, run.model.element_count);
        verify_near("stress of eroded elements", seen.highest, 0, 0);
        verify_near("force on the node", run.f[3 * (run.model.node_count - 1)], 0, 1e-12);
    }
    verify_balance(&run, 1e-3);
    verify_free(&run);
    return seen.time;
}

static const Square pulled = {.pattern = SCENE_QUADS, .cse = true, .vx = 1};
static const Square both_ways = {.pattern = SCENE_DIAGONAL, .cse = true, .vx = 1, .vy = 0.5};
static const Square squeezed = {.pattern = SCENE_DIAGONAL, .form = 2, .vx = 0, .vy = -1};
static const Square sheared = {.pattern = SCENE_QUADS, .form = 2, .shear = 1};
static const Square rubber = {
    .pattern = SCENE_DIAGONAL, .vx = 1, .law = "*MAT_MOONEY-RIVLIN_RUBBER\n1,1000,.499,1e5\n"};

static void criteria_have_their_closed_forms(void **state)
{
    (void)state;
    verify_close("MXEPS", eroded_at(&pulled, 0.3, "1\n0,0,0,.2"), exp(0.2) - 1, 2e-3);
    verify_close("EFFEPS", eroded_at(&pulled, 0.3, "1,0,0,0,.2\n0"), exp(sqrt(0.75) * 0.2) - 1, 2e-3);
    verify_close("MNEPS", eroded_at(&squeezed, 0.3, "1,0,0,-.2\n0"), 1 - exp(-0.2), 2e-3);
    /* pure shear g = 2 sinh e, with the strains e and -e */
    verify_close("EPSSH", eroded_at(&sheared, 0.5, "1\n0,0,0,0,.2"), 2 * sinh(0.2), 2e-3);
    /* FORM 0 without Poisson's ratio: Cauchy stress E (l1 - 1)/l2 */
    verify_close("SIGP1", eroded_at(&pulled, 0.3, "1\n0,2e5"), 0.2, 2e-3);
    const double t = eroded_at(&both_ways, 0.3, "1\n0,1.5e5");
    verify_close("SIGP1, both ways", 1e6 * t / (1 + 0.5 * t), 1.5e5, 3e-3);
    const double m = eroded_at(&both_ways, 0.3, "1\n0,0,1.5e5"), a = 1e6 * m / (1 + 0.5 * m), b = 0.5e6 * m / (1 + m);
    verify_close("SIGVM", sqrt(a * a - a * b + b * b), 1.5e5, 3e-3);
    /* the sides are held, so that l2 = 1, l3 = 1/l1: S1 l1^2 = 2 A (l1^2 - 1/l1^2) */
    const double l = 1 + eroded_at(&rubber, 0.6, "1\n0,1e5");
    verify_close("SIGP1, rubber", 2e5 * (l * l - 1 / (l * l)), 1e5, 3e-3);
    verify_close("FAILTM", eroded_at(&pulled, 0.1, "1\n0,0,0,0,0,0,0,.05"), 0.05, 2e-3);
    verify_close("FAILTM < 0", eroded_at(&pulled, 0.1, "1\n0,0,0,0,0,0,0,-.05"), 0.05, 2e-3);
}

static void conditions_add_up(void **state)
{
    (void)state;
    const double one = exp(0.1) - 1, other = 0.2;
    verify_close("NCS = 1: the first", eroded_at(&pulled, 0.3, "1\n0,2e5,0,.1"), one, 2e-3);
    verify_close("NCS = 2: both", eroded_at(&pulled, 0.3, "1,0,0,0,0,0,1,2\n0,2e5,0,.1"), other, 2e-3);
    verify_close("EXCL: MXEPS alone", eroded_at(&pulled, 0.3, "1,99,99,0,99,99,1,1\n99,99,99,.2,99,99,99"),
                 exp(0.2) - 1, 2e-3);
    verify_near("not reached", eroded_at(&pulled, 0.1, "1\n0,0,0,.2"), -1, 0);
    verify_close("thread of a quadrilateral that fails at one point",
                 eroded_at(&(Square){.pattern = SCENE_DIAGONAL, .form = 2, .vx = 1}, 0.3, "1\n0,0,0,.2"), exp(0.2) - 1,
                 2e-3);
}

/* A sheet thrown against held edges tears in the middle: the energy of what goes stays in the ledger, for every kind of
 * law and element. */
static void make_sheet(Scene *scene, ScenePattern pattern, const char *law, double limit)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_begin(deck, "torn sheet", 1, 0.1);
    scene_write_part(deck, 1, 1, 1, "sheet");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_print(deck, "%s", law);
    scene_write_curve(deck, 11, 3, (const double[]){0, 0, 0.05, 5e6, 0.2, 6e7});
    scene_write_curve(deck, 13, 2, (const double[]){0, 0, 0.2, 4e7});
    scene_print(deck, "*MAT_ADD_EROSION_TITLE\nfabric\n1\n0,0,0,%.17g\n", limit);
    scene_add_rectangle(mesh, 1, pattern, 12, 9, 0.4, 0.3);
    scene_print(deck, "*INITIAL_VELOCITY_NODE\n");
    for (int i = 0; i < mesh->node_count; i++) {
        const double x = mesh->x[3 * i] - 0.2, y = mesh->x[3 * i + 1] - 0.15;
        scene_print(deck, "%d,%.17g,%.17g,%.17g\n", i + 1, 120 * x * (1 + 3 * y), 20 * y,
                    20 * exp(-200 * (x * x + y * y)));
    }
    scene_end(deck, mesh);
}

static const struct Law {
    const char *name, *text;
    bool one_point;
} laws[] = {
    {"FORM 0", "*MAT_FABRIC\n1,800,3e8,3e8,0,.2,.2\n1e8,0,0,1,0,0,0,.05\n0,0,0,0,0,0\n0\n0\n", false},
    {"FORM 2", "*MAT_FABRIC\n1,800,3e8,3e8,0,.2,.2\n1e8,0,0,1\n0,0,0,0,0,2\n0\n0\n", false},
    {"FORM 2, damped", "*MAT_FABRIC\n1,800,3e8,3e8,0,.2,.2\n1e8,0,0,1,0,0,0,.05\n0,0,0,0,0,2\n0\n0\n", false},
    {"FORM 14", "*MAT_FABRIC\n1,800,3e8,3e8\n1e8,0,0,1\n0,0,0,0,0,14\n0\n0\n11,11,13\n", false},
    {"MAT_ELASTIC", "*MAT_ELASTIC\n1,800,3e8,.2\n", false},
    {"rubber", "*MAT_MOONEY-RIVLIN_RUBBER\n1,1000,.499,3e7,2e7\n", false},
    {"FORM 2, one point", "*MAT_FABRIC\n1,800,3e8,3e8,0,.2,.2\n1e8,0,0,1\n0,0,0,0,0,2\n0\n0\n", true},
};

static void energy_is_kept(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++)
        for (int quads = 0; quads < 2; quads++) {
            if (laws[i].one_point && !quads) continue;
            Scene scene = {0};
            VerifyRun run;
            make_sheet(&scene, quads ? SCENE_QUADS : SCENE_DIAGONAL, laws[i].text, 0.03);
            verify_scene(&run, &scene,
                         &(VerifyOptions){.every = 1, .stop_time = 1.5e-3, .one_point = laws[i].one_point});
            print_message("  %s, %s: %ld of %d eroded\n", laws[i].name, quads ? "quadrilaterals" : "triangles",
                          (long)*run.state.eroded_count, run.model.element_count);
            assert_in_range(*run.state.eroded_count, 2, run.model.element_count - 1);
            verify_balance(&run, 5e-4);
            verify_free(&run);
        }
}

enum { CYCLES = 260 };

static void build_sheet(VerifyRun *run, int threads, int64_t stop)
{
    Scene scene = {0};
    make_sheet(&scene, SCENE_CROSS, laws[2].text, 0.03);
    assert_int_equal(
        verify_build(run, scene.deck.text, scene.deck.length, &(VerifyOptions){.threads = threads, .stop = stop}), 0);
    scene_free(&scene);
}

static void a_restart_and_any_threads_give_the_same_bits(void **state)
{
    (void)state;
    static const char path[] = "test_erosion.billow";
    VerifyRun straight;
    build_sheet(&straight, 1, CYCLES);
    assert_int_equal(verify_loop(&straight), 0);
    const uint64_t hash = state_hash(&straight.state);
    const int64_t count = *straight.state.eroded_count;
    verify_free(&straight);
    for (int threads = 1; threads <= 4; threads++) {
        VerifyRun first, second;
        build_sheet(&first, threads, CYCLES / 2);
        assert_int_equal(verify_loop(&first), 0);
        if (threads == 1) print_message("    %ld, then %ld\n", (long)*first.state.eroded_count, (long)count);
        assert_in_range(*first.state.eroded_count, 1, count - 1);
        assert_int_equal(checkpoint_write(path, &first.model, &first.state, &first.diagnostics), 0);
        build_sheet(&second, 5 - threads, CYCLES);
        assert_int_equal(checkpoint_read(path, &second.model, &second.state, &second.diagnostics), 0);
        assert_int_equal(verify_loop(&second), 0);
        assert_true(state_hash(&second.state) == hash);
        verify_free(&first);
        verify_free(&second);
    }
    unlink(path);
}

/* The field eroded of results.vtkhdf and results.xdmf, and the lines of log.txt. */
static void results_show_it(void **state)
{
    (void)state;
    Program program = {0};
    Scene scene = {0};
    static char text[1 << 20];
    char path[256];
    float eroded[2 * 512], stress[2 * 512 * 6];
    program_open(&program);
    make_sheet(&scene, SCENE_DIAGONAL, laws[1].text, 0.03);
    const int cells = scene.mesh.shell_count;
    scene.deck.length -= strlen("*END\n");
    scene.deck.text[scene.deck.length] = 0;
    scene_print(&scene.deck, "*DATABASE_BINARY_D3PLOT\n1.5e-3\n*END\n");
    program_write(&program, "torn.k", scene.deck.text, scene.deck.length);
    scene_free(&scene);
    assert_int_equal(program_run(&program, "run torn.k --end-time 1.5e-3"), 0);
    assert_true(program_read(&program, "torn.results/log.txt", text, sizeof text));
    assert_non_null(strstr(text, "eroded so far"));
    assert_true(program_read(&program, "torn.results/results.xdmf", text, sizeof text));
    assert_non_null(strstr(text, "/VTKHDF/CellData/eroded"));
    snprintf(path, sizeof path, "%s/torn.results/results.vtkhdf", program.folder);
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    hid_t flag = H5Dopen2(file, "VTKHDF/CellData/eroded", H5P_DEFAULT), set;
    assert_true(flag >= 0);
    assert_true(H5Dread(flag, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, eroded) >= 0);
    set = H5Dopen2(file, "VTKHDF/CellData/stress", H5P_DEFAULT);
    assert_true(H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, stress) >= 0);
    int count = 0;
    for (int e = 0; e < cells; e++) {
        assert_true(eroded[e] == 0.0f);
        assert_true(eroded[cells + e] == 0.0f || eroded[cells + e] == 1.0f);
        if (eroded[cells + e] == 0.0f) continue;
        count++;
        for (int k = 0; k < 6; k++) assert_true(stress[6 * (cells + e) + k] == 0.0f);
    }
    assert_in_range(count, 2, cells - 1);
    H5Dclose(flag);
    H5Dclose(set);
    H5Fclose(file);
    program_close(&program);
}

static void bad_cards_are_refused(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"1,0,5e4\n0", "MXPRES is 50000, but billow has no such criterion for membranes"},
        {"1,0,0,0,0,.1\n0", "VOLEPS is 0.1"},
        {"1\n-5e4", "MNPRES is -50000"},
        {"1\n0,0,0,0,0,1e5,1e3", "SIGTH is 100000"},
        {"1,0,0,.1\n0", "MNEPS is 0.1, but must be below 0"},
        {"1,0,0,0,-.1\n0", "EFFEPS is -0.1, but must be above 0"},
        {"1\n0,0,0,-7", "MXEPS is -7, but must be above 0; curves"},
        {"1,99\n99,0,99,.2,99,99,99", "SIGP1 is 0 and differs from EXCL = 99"},
        {"1,0,0,0,.1,0,3\n0", "NUMFIP is 3, but a membrane has one layer"},
        {"1,0,0,0,.1,0,1,2\n0", "NCS is 2, but there are 1 criteria"},
        {"1,0,0,0,.1\n0\n1", "IDAM"},
        {"1,0,0,0,.1\n0\n0\n0,0,.3", "EPSTHIN"},
        {"7,0,0,0,.1\n0", "MID names material 7, which is not defined"},
        {"1,0,0,0,.1\n0\n*MAT_ADD_EROSION\n1,0,0,0,.2\n0", "material 1 has criteria already"},
        {"1,0,0,0,.1\n0\n*CONTROL_DYNAMIC_RELAXATION\n100,1e-3,.99,0,0,0,0,1", "does not know erosion"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Scene scene = {0};
        VerifyRun run;
        make_square(&scene, &pulled, 1, cases[i][0]);
        assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), -1);
        scene_free(&scene);
        if (!verify_message(&run.diagnostics, SEVERITY_ERROR, cases[i][1])) {
            diagnostics_print(&run.diagnostics, SEVERITY_WARNING, stderr);
            fail_msg("no error with '%s'", cases[i][1]);
        }
        verify_free(&run);
    }
    Scene scene = {0};
    VerifyRun run;
    make_square(&scene, &(Square){.law = "*MAT_NULL\n1,1000\n"}, 1, "1,0,0,0,.1\n0");
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), -1);
    scene_free(&scene);
    assert_true(verify_message(&run.diagnostics, SEVERITY_ERROR, "material 1 is none of fabric"));
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(criteria_have_their_closed_forms),
        cmocka_unit_test(conditions_add_up),
        cmocka_unit_test(energy_is_kept),
        cmocka_unit_test(a_restart_and_any_threads_give_the_same_bits),
        cmocka_unit_test(results_show_it),
        cmocka_unit_test(bad_cards_are_refused),
    };
    return cmocka_run_group_tests_name("erosion", tests, NULL, NULL);
}
