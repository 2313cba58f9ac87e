/* Seams: welded masses move as one and tear at the force given, without losing energy or momentum; the criterion's
 * closed forms; restart; bad cards. */
#include "tests/wall_case.h"

#include <string.h>
#include <unistd.h>

#include "io/checkpoint.h"
#include "solver/seam.h"

/* Two squares of four loose masses of 1; nodes 1 and 6 at one place (apart: the second above by that much). Node 1 is
 * pulled by 10 t along x and slope t along y. */
static void begin(Scene *scene, double end_time, double apart, double slope)
{
    SceneText *deck = &scene->deck;
    wall_begin(scene, end_time);
    wall_add_square(scene, 0, 0, 0);
    wall_add_square(scene, -1, 0, apart);
    scene_write_curve(deck, 98, 2, (const double[]){0, 1e-3, 10, 1e-3});
    scene_write_curve(deck, 97, 2, (const double[]){0, 0, 10, 10});
    scene_print(deck, "*CONTROL_TIMESTEP\n0,0.9,0,0,0,98\n*LOAD_NODE_POINT\n1,1,97,10\n");
    if (slope > 0.0) scene_print(deck, "1,2,97,%g\n", slope);
}

static void run(VerifyRun *result, Scene *scene, int node)
{
    scene_end(&scene->deck, &scene->mesh);
    verify_scene(result, scene, &(VerifyOptions){.every = 1, .node = node});
}

static void momentum_is_kept(const VerifyRun *run, double x)
{
    double sum = 0.0;
    for (int n = 0; n < run->model.node_count; n++) sum += run->model.mass[n] * run->state.v[3 * n];
    verify_near("momentum", sum, x, 2e-2);
}

static void a_weld_tears_at_its_force(void **state)
{
    (void)state;
    for (int node = 0; node <= 5; node += 5) {
        Scene scene = {0};
        VerifyRun result;
        begin(&scene, 1, 0, 0);
        scene_print(&scene.deck, "*CONSTRAINED_SPOTWELD\n1,6,3,0\n");
        run(&result, &scene, node);
        assert_int_equal(result.model.seam_count, 1);
        verify_near("time of tearing", result.state.seam_torn[0], 0.6, 1.1e-3);
        verify_near("place before", verify_at(&result, 0.5, offsetof(VerifySample, x)), 10 * 0.125 / 12, 1e-3);
        /* together 10 t^2 / 4 until 0.6; then one coasts and the other gets all of the force */
        const double place = 10 * 0.216 / 12 + 0.9 * 0.4;
        verify_near("place at the end", result.x[3 * 5], place, 2e-3);
        verify_near("the other", result.x[0], place + 10 * (1 - 3 * 0.36 + 2 * 0.216) / 6, 2e-3);
        momentum_is_kept(&result, 5);
        verify_balance(&result, 1e-3);
        verify_free(&result);
    }
}

static void a_weld_without_force_holds(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun result;
    begin(&scene, 1, 0, 0);
    scene_print(&scene.deck, "*CONSTRAINED_SPOTWELD_ID\n7\n1,6\n");
    run(&result, &scene, 5);
    assert_true(result.state.seam_torn[0] < 0.0);
    verify_near("way", result.x[0] - result.x[3 * 5], 0, 1e-13);
    verify_near("place", result.x[0], 10.0 / 12, 2e-3);
    verify_balance(&result, 1e-3);
    verify_free(&result);
}

static void time_opens_a_weld(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun result;
    begin(&scene, 0.5, 0, 0);
    scene_print(&scene.deck, "*CONSTRAINED_SPOTWELD\n1,6,0,0,0,0,0.25\n");
    run(&result, &scene, 5);
    verify_near("time", result.state.seam_torn[0], 0.25, 1.1e-3);
    verify_free(&result);
}

/* Nodes apart along z: the pull along x and y is shear, sqrt(10^2 + 5^2) t / 2 of it. */
static void shear_tears_nodes_that_are_apart(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun result;
    begin(&scene, 1, 0.01, 5);
    scene_print(&scene.deck, "*CONSTRAINED_SPOTWELD\n1,6,0.001,3\n");
    run(&result, &scene, 5);
    verify_near("time", result.state.seam_torn[0], 6 / sqrt(125.0), 1.1e-3);
    assert_true(verify_message(&result.diagnostics, SEVERITY_WARNING, "join nodes that are apart, by up to 0.01"));
    verify_free(&result);
}

static void the_criterion_adds_powers(void **state)
{
    (void)state;
    const double x[3] = {0, 0, 0}, y[3] = {0, 0, 2};
    const Seam seam = {.normal = 10, .shear = 5, .normal_exponent = 2, .shear_exponent = 1, .end = 1e20};
    /* (6/10)^2 + 3.2/5 = 1 */
    assert_true(seam_tears(&seam, (const double[]){3.2001, 0, 6}, x, y));
    assert_false(seam_tears(&seam, (const double[]){3.1999, 0, 6}, x, y));
    /* pushing does not tear, and shear alone must reach its limit */
    assert_false(seam_tears(&seam, (const double[]){0, 4.999, -100}, x, y));
    assert_true(seam_tears(&seam, (const double[]){0, 5.001, -100}, x, y));
    /* at one place there is no normal */
    assert_true(seam_tears(&seam, (const double[]){6, 0, -8.001}, x, x));
    assert_false(seam_tears(&seam, (const double[]){6, 0, -7.999}, x, x));
    const Seam sheared = {.shear = 5, .normal_exponent = 2, .shear_exponent = 2, .end = 1e20};
    assert_true(seam_tears(&sheared, (const double[]){5.001, 0, 0}, x, x));
    assert_false(seam_tears(&sheared, (const double[]){4.999, 0, 0}, x, x));
}

static void bad_welds_are_told_together(void **state)
{
    (void)state;
    static const char *const texts[] = {"N2 names node 99", "N1 and N2 are both node 3", "is in another spotweld",
                                        "SN is -1; give the force", "N is -2, but must be above 0"};
    Scene scene = {0};
    VerifyRun result;
    SceneText *deck = &scene.deck;
    begin(&scene, 1, 0, 0);
    scene_print(deck, "*CONSTRAINED_SPOTWELD\n1,99\n3,3\n1,6\n1,7\n2,8,-1\n2,8,0,0,-2\n");
    scene_end(deck, &scene.mesh);
    assert_int_equal(verify_build(&result, deck->text, deck->length, &(VerifyOptions){0}), -1);
    scene_free(&scene);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (!verify_message(&result.diagnostics, SEVERITY_ERROR, texts[i])) {
            diagnostics_print(&result.diagnostics, SEVERITY_WARNING, stderr);
            fail_msg("no error with '%s'", texts[i]);
        }
    verify_free(&result);
}

static void held_nodes_are_refused(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun result;
    SceneText *deck = &scene.deck;
    begin(&scene, 1, 0, 0);
    scene_print(deck, "*CONSTRAINED_SPOTWELD\n1,6\n*BOUNDARY_SPC_NODE\n6,0,1,1,1\n*INITIAL_VELOCITY_NODE\n1,1\n");
    scene_end(deck, &scene.mesh);
    assert_int_equal(verify_build(&result, deck->text, deck->length, &(VerifyOptions){0}), -1);
    scene_free(&scene);
    assert_true(verify_message(&result.diagnostics, SEVERITY_ERROR, "node 6 is also held"));
    assert_true(verify_message(&result.diagnostics, SEVERITY_ERROR, "start with different velocities"));
    verify_free(&result);
}

enum { SHEET_CELLS = 12, SHEET_CYCLES = 240 };

/* Two sheets of fabric under pressure, held at their outer edges and joined along x = 0.3 by welds that tear one after
 * the other from one end. */
static void make_sheets(Scene *scene)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    const SceneFabric fabric = scene_isotropic(0, true, 800, 3e8, 0.3);
    deck->exact = true;
    scene_begin(deck, "torn sheets", 1, 0.9);
    scene_write_part(deck, 1, 1, 1, "sheets");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_add_rectangle(mesh, 1, SCENE_DIAGONAL, SHEET_CELLS, SHEET_CELLS, 0.3, 0.3);
    const int second = mesh->node_count;
    scene_add_rectangle(mesh, 1, SCENE_QUADS, SHEET_CELLS, SHEET_CELLS, 0.3, 0.3);
    scene_transform(mesh, second, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[3]){0.3, 0, 0});
    scene_print(deck, "*CONSTRAINED_SPOTWELD\n");
    for (int i = 0; i < second; i++)
        for (int j = second; j < mesh->node_count; j++)
            if (fabs(mesh->x[3 * i] - 0.3) < 1e-9 && fabs(mesh->x[3 * j] - 0.3) < 1e-9 &&
                fabs(mesh->x[3 * i + 1] - mesh->x[3 * j + 1]) < 1e-9)
                scene_print(deck, "%d,%d,%.17g\n", i + 1, j + 1, 10 + 400 * mesh->x[3 * i + 1]);
    scene_print(deck, "*BOUNDARY_SPC_NODE\n");
    for (int i = 0; i < mesh->node_count; i++)
        if (fabs(mesh->x[3 * i] - 0.3) > 0.299) scene_print(deck, "%d,0,1,1,1\n", i + 1);
    scene_write_curve(deck, 1, 3, (const double[]){0, 0, 0.005, 2e4, 1, 2e4});
    scene_write_pressure(deck, 1, mesh, 0, 1, -1);
    scene_end(deck, mesh);
}

static void build_sheets(VerifyRun *run, int threads, int64_t stop)
{
    Scene scene = {0};
    make_sheets(&scene);
    assert_int_equal(
        verify_build(run, scene.deck.text, scene.deck.length, &(VerifyOptions){.threads = threads, .stop = stop}), 0);
    scene_free(&scene);
}

static int count_torn(const VerifyRun *run)
{
    int torn = 0;
    for (int i = 0; i < run->model.seam_count; i++) torn += run->state.seam_torn[i] >= 0.0;
    return torn;
}

/* Stopped in the middle of a tear and restarted from the file on another number of threads: the same bits. */
static void a_tear_is_the_same_after_a_restart_and_on_any_threads(void **state)
{
    (void)state;
    static const char path[] = "test_seam.billow";
    VerifyRun straight;
    build_sheets(&straight, 1, SHEET_CYCLES);
    assert_int_equal(verify_loop(&straight), 0);
    assert_int_equal(straight.model.seam_count, SHEET_CELLS + 1);
    const uint64_t hash = state_hash(&straight.state);
    const int torn = count_torn(&straight);
    double middle = 0.0;
    for (int i = 0; i < straight.model.seam_count; i++) middle = fmax(middle, straight.state.seam_torn[i]);
    print_message("    %d of %d torn, the last at %g\n", torn, straight.model.seam_count, middle);
    assert_int_equal(torn, SHEET_CELLS + 1);
    verify_free(&straight);
    for (int threads = 1; threads <= 4; threads++) {
        VerifyRun first, second;
        build_sheets(&first, threads, SHEET_CYCLES / 2);
        assert_int_equal(verify_loop(&first), 0);
        assert_in_range(count_torn(&first), 1, torn - 1);
        assert_int_equal(checkpoint_write(path, &first.model, &first.state, &first.diagnostics), 0);
        build_sheets(&second, 5 - threads, SHEET_CYCLES);
        assert_int_equal(checkpoint_read(path, &second.model, &second.state, &second.diagnostics), 0);
        assert_int_equal(verify_loop(&second), 0);
        assert_true(state_hash(&second.state) == hash);
        verify_free(&first);
        verify_free(&second);
    }
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_weld_tears_at_its_force),
        cmocka_unit_test(a_weld_without_force_holds),
        cmocka_unit_test(time_opens_a_weld),
        cmocka_unit_test(shear_tears_nodes_that_are_apart),
        cmocka_unit_test(the_criterion_adds_powers),
        cmocka_unit_test(bad_welds_are_told_together),
        cmocka_unit_test(held_nodes_are_refused),
        cmocka_unit_test(a_tear_is_the_same_after_a_restart_and_on_any_threads),
    };
    return cmocka_run_group_tests_name("seams", tests, NULL, NULL);
}
