/* Small elements integrated implicitly: the step of the large ones is stable, what it resolves stays as it was. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "solver/element_steps.h"
#include "solver/memory.h"
#include "tests/verify.h"

enum { LENGTH_CELLS = 14, WIDTH_CELLS = 10, SMALL_COLUMN = 6 };
#define SMALL_WIDTH 0.003
#define EQUAL_WIDTH (1.0 / LENGTH_CELLS)

/* Column SMALL_COLUMN of a unit sheet gets a width of its own, the others share the rest. */
static void squeeze(SceneMesh *mesh, double width)
{
    const double wide = (1.0 - width) / (LENGTH_CELLS - 1);
    for (int i = 0; i < mesh->node_count; i++) {
        const int column = (int)lround(mesh->x[3 * i] * LENGTH_CELLS);
        mesh->x[3 * i] = column <= SMALL_COLUMN ? wide * column : wide * (column - 1) + width;
    }
}

/* The small column's nodes, of both its sides. */
static bool select_small(const void *user, const double x[3])
{
    (void)user;
    return fabs(x[0] - 6.0 / 13.0) < 0.01;
}

/* A free sheet of one law; held: the small column has supports. */
static void build_sheet(VerifyRun *run, const char *material, ScenePattern pattern, double width, bool held, double end,
                        const VerifyOptions *options)
{
    Scene scene = {0};
    scene.deck.exact = true;
    scene_add_rectangle(&scene.mesh, 1, pattern, LENGTH_CELLS, WIDTH_CELLS, 1, 1);
    squeeze(&scene.mesh, width);
    scene_begin(&scene.deck, "sheet", end, 0.9);
    scene_write_part(&scene.deck, 1, 1, 1, "cloth");
    scene_write_section(&scene.deck, 1, 9, 3e-4);
    scene_print(&scene.deck, "%s", material);
    if (held) {
        int set = scene_write_node_set(&scene.deck, 1, &scene.mesh, select_small, NULL);
        (void)set;
        scene_write_spc(&scene.deck, 1, false, false, true);
    }
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(verify_build(run, scene.deck.text, scene.deck.length, options), 0);
    scene_free(&scene);
}

#define GREEN "*MAT_FABRIC\n1,800,3e8,2e8,,.2,.3\n2e7,,,0\n0,,,,,2\n"
#define BIOT "*MAT_FABRIC\n1,800,3e8,2e8,,.2,.3\n2e7,,,1,,,,.05\n0,,,,,0\n"
#define PRESSED "*MAT_FABRIC\n1,800,3e8,2e8,,.2,.3\n2e7,,,0,,,,.05\n0,,,,,0\n"
#define LINED "*MAT_FABRIC\n1,800,3e8,2e8,,.2,.3\n2e7,,,1,2e7,.3,.1,.2\n0,,,,,0\n"
#define ELASTIC "*MAT_ELASTIC\n1,800,3e8,.3\n"

/* A smooth field of velocities in the plane. */
static void start_waves(VerifyRun *run, double size)
{
    const Model *m = &run->model;
    for (int n = 0; n < m->node_count; n++) {
        const double *x = m->initial + 3 * n;
        run->state.v[3 * n] = size * cos(M_PI * x[0]);
        run->state.v[3 * n + 1] = 0.6 * size * sin(M_PI * x[0]) * cos(M_PI * x[1]);
    }
}

/* Velocities at random, the same on both sides of the small column: it follows, the others have all their modes. */
static void start_noise(VerifyRun *run, double size)
{
    const Model *m = &run->model;
    const int columns = LENGTH_CELLS + 1;
    uint64_t seed = 7;
    for (int i = 0; i < m->node_count; i++)
        for (int k = 0; k < 3; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            double *v = run->state.v + 3 * m->deck_node[i];
            v[k] = i % columns == SMALL_COLUMN + 1 ? run->state.v[3 * m->deck_node[i - 1] + k]
                                                   : size * ((double)(seed >> 11) * 0x1p-52 - 1.0);
        }
}

static double momentum(const VerifyRun *run, int axis, double *scale)
{
    double sum = 0.0;
    *scale = 0.0;
    for (int n = 0; n < run->model.node_count; n++) {
        sum += run->model.mass[n] * run->state.v[3 * n + axis];
        *scale += run->model.mass[n] * fabs(run->state.v[3 * n + axis]);
    }
    return sum;
}

/* The velocities were not the deck's: what the run was given is their energy. */
static void run_loop(VerifyRun *run)
{
    double sum = 0.0;
    for (int i = 0; i < 3 * run->model.node_count; i++)
        sum += 0.5 * run->model.mass[i / 3] * run->state.v[i] * run->state.v[i];
    sum += 0.5 * implicit_elements_inertia(&run->model.implicit, run->model.mass, run->state.v, run->state.v).uu;
    if (run->state.clock->cycle == 0) run->state.energy->initial = run->state.energy->largest = sum;
    if (verify_loop(run)) fail_msg("%s", run->failure.cause);
}

/* Waves of the sheet, one and a quarter periods of them (central differences are off by (w dt)^2/24 of 8 rad at the
 * larger step, 0.013 of the height), are as with the step of the smallest elements, in a fraction
 * of the cycles. */
static void test_resolved_waves_stay(void **state)
{
    (void)state;
    const double speed = 0.3, height = speed / (M_PI * sqrt(3e8 / 800.0));
    const char *materials[] = {GREEN, PRESSED, ELASTIC}; /* no slack, so that the waves are smooth */
    for (int k = 0; k < 3; k++) {
        VerifyRun runs[2];
        for (int i = 0; i < 2; i++) {
            build_sheet(&runs[i], materials[k], SCENE_QUADS, SMALL_WIDTH, false, 0.004,
                        &(VerifyOptions){.every = 1, .all_explicit = i == 0});
            start_waves(&runs[i], speed);
            run_loop(&runs[i]);
        }
        assert_int_equal(runs[0].model.implicit.element_count, 0);
        assert_int_equal(runs[1].model.implicit.element_count, WIDTH_CELLS);
        double off = 0.0, count = runs[0].model.node_count;
        for (int i = 0; i < 3 * runs[0].model.node_count; i++) off += pow(runs[1].x[i] - runs[0].x[i], 2);
        verify_between("difference of the positions, to the waves' height", sqrt(off / count) / height, 0.0, 0.015);
        verify_between("explicit cycles to implicit", (double)runs[0].cycles / (double)runs[1].cycles, 2.5, 8.0);
        verify_free(&runs[0]);
        verify_free(&runs[1]);
    }
    assert_int_equal(memory_in_use(), 0);
}

/* Energy ratio's largest value of a sheet with noise, and how far its momentum has gone. */
static double run_noise(const char *material, ScenePattern pattern, double width, double drift[3])
{
    VerifyRun run;
    build_sheet(&run, material, pattern, width, false, 0.2, &(VerifyOptions){.every = 1, .energy_limit = 10.0});
    assert_true((run.model.implicit.element_count > 0) == (width < EQUAL_WIDTH));
    start_noise(&run, 1.0);
    double before[3], scale;
    for (int a = 0; a < 3; a++) before[a] = momentum(&run, a, &scale);
    run_loop(&run);
    for (int a = 0; a < 3; a++) drift[a] = (momentum(&run, a, &scale) - before[a]) / scale;
    verify_between("smallest energy ratio", run.state.energy->ratio_min, 0.98, 1.0);
    double largest = run.state.energy->ratio_max;
    verify_free(&run);
    return largest;
}

/* With all modes excited, folds and slack, nothing grows over 2,000 cycles: the balance is that of the same sheet with
 * equal columns, whose modes at the limit of the step (eq. L5) make its energy ratio 1.1. */
static void test_stable_with_noise(void **state)
{
    (void)state;
    const char *materials[] = {GREEN, BIOT, LINED, ELASTIC};
    for (int k = 0; k < 4; k++)
        for (int pattern = SCENE_QUADS; pattern <= SCENE_DIAGONAL; pattern++) {
            double drift[3], equal = run_noise(materials[k], (ScenePattern)pattern, EQUAL_WIDTH, drift),
                             small = run_noise(materials[k], (ScenePattern)pattern, SMALL_WIDTH, drift);
            verify_between("excess of the energy ratio, to that of equal columns", small - 1.0, 0.0,
                           1.5 * (equal - 1.0) + 1e-3);
            for (int a = 0; a < 3; a++) verify_near("momentum", drift[a], 0.0, 1e-12);
        }
}

static void test_same_bits(void **state)
{
    (void)state;
    uint64_t hash[3];
    for (int i = 0; i < 3; i++) {
        VerifyRun run;
        build_sheet(&run, BIOT, SCENE_QUADS, SMALL_WIDTH, false, 0.02,
                    &(VerifyOptions){.threads = i == 1 ? 2 : 1, .stop = i == 2 ? 150 : 300});
        assert_true(run.model.implicit.element_count > 0);
        start_waves(&run, 3.0);
        run_loop(&run);
        run.options.stop = 300;
        if (i == 2) run_loop(&run);
        hash[i] = state_hash(&run.state);
        verify_free(&run);
    }
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
}

/* Nodes with conditions keep their elements explicit, and so does the option. */
static void test_conditions_stay_explicit(void **state)
{
    (void)state;
    VerifyRun run;
    build_sheet(&run, GREEN, SCENE_QUADS, SMALL_WIDTH, true, 0.02, &(VerifyOptions){0});
    assert_int_equal(run.model.implicit.element_count, 0);
    verify_free(&run);
    build_sheet(&run, GREEN, SCENE_QUADS, SMALL_WIDTH, false, 0.02, &(VerifyOptions){0});
    double implicit = element_steps_mesh(&run.model);
    verify_free(&run);
    build_sheet(&run, GREEN, SCENE_QUADS, SMALL_WIDTH, false, 0.02, &(VerifyOptions){.all_explicit = true});
    assert_int_equal(run.model.implicit.element_count, 0);
    verify_between("step to that of all explicit", implicit / element_steps_mesh(&run.model), 2.5, 20.0);
    verify_free(&run);
    assert_int_equal(memory_in_use(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_resolved_waves_stay),
        cmocka_unit_test(test_stable_with_noise),
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_conditions_stay_explicit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
