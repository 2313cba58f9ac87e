/* Tied nodes: the nodes of a place move as one until the fabric around it is stretched too far; momentum and energy are
 * kept; restart, threads; bad cards. */
#include "tests/wall_case.h"

#include <string.h>
#include <unistd.h>

#include "elements/tear.h"
#include "io/checkpoint.h"

enum { CELLS = 10 };

/* Two strips of fabric end to end along x; their ends at x = 0.2 lie on each other, a node set each of them and of both
 * outer ends. Small steps: the recoil of a torn strip is sudden, and the full-step kinetic energy is off by
 * m (dt a)^2/8 there. */
static void begin(Scene *scene, ScenePattern pattern, int form, double end_time)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    SceneFabric fabric = scene_isotropic(form, true, 800, 3e8, 0.0);
    deck->exact = true;
    scene_begin(deck, "tied strips", end_time, 0.2);
    scene_write_part(deck, 1, 1, 1, "strips");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_add_rectangle(mesh, 1, pattern, CELLS, 4, 0.2, 0.08);
    const int second = mesh->node_count;
    scene_add_rectangle(mesh, 1, pattern, CELLS, 4, 0.2, 0.08);
    scene_transform(mesh, second, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[3]){0.2, 0, 0});
    scene_print(deck, "*SET_NODE_LIST\n1\n");
    for (int i = 0; i < mesh->node_count; i++)
        if (fabs(mesh->x[3 * i] - 0.2) < 1e-9) scene_print(deck, "%d\n", i + 1);
    scene_print(deck, "*SET_NODE_LIST\n2\n");
    for (int i = 0; i < mesh->node_count; i++)
        if (mesh->x[3 * i] < 1e-9) scene_print(deck, "%d\n", i + 1);
    scene_print(deck, "*SET_NODE_LIST\n3\n");
    for (int i = 0; i < mesh->node_count; i++)
        if (mesh->x[3 * i] > 0.4 - 1e-9) scene_print(deck, "%d\n", i + 1);
}

/* The ends move by the curve 5, half each way. */
static void pull_ends(Scene *scene, double speed)
{
    scene_write_curve(&scene->deck, 5, 2, (const double[]){0, 0, 1, speed});
    scene_print(&scene->deck, "*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,2,5,-.5\n3,1,2,5,.5\n"
                              "*DAMPING_GLOBAL\n0,800\n");
}

/* Pulled slowly, the strips have one strain: ln(1 + t v/0.4) along, 0 across, constant volume. */
static void a_tie_breaks_at_its_strain(void **state)
{
    (void)state;
    const struct {
        ScenePattern pattern;
        int form;
    } cases[] = {{SCENE_DIAGONAL, 0}, {SCENE_QUADS, 0}, {SCENE_QUADS, 2}, {SCENE_CROSS, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Scene scene = {0};
        VerifyRun run;
        const double limit = 0.05, speed = 1.6, strain = sqrt(0.75) * limit;
        const double expected = 0.4 * (exp(strain) - 1.0) / speed;
        begin(&scene, cases[i].pattern, cases[i].form, 1.2 * expected);
        pull_ends(&scene, speed);
        scene_print(&scene.deck, "*CONSTRAINED_TIED_NODES_FAILURE\n1,%.17g\n", limit);
        scene_end(&scene.deck, &scene.mesh);
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        assert_int_equal(run.model.ties.count, 5);
        double first = 1e20, last = 0;
        for (int k = 0; k < run.model.ties.count; k++) {
            assert_int_equal(run.model.ties.ties[k].node_count, 2);
            first = fmin(first, run.state.tie_broken[k]);
            last = fmax(last, run.state.tie_broken[k]);
        }
        verify_close("first place comes apart", first, expected, 0.02);
        verify_close("last place comes apart", last, expected, 0.02);
        verify_balance(&run, 2e-3);
        verify_free(&run);
    }
}

/* EPPF = 0, or one that is not reached: the strips are one strip, to the bit of its elongation. */
static void a_tie_holds_below_its_strain(void **state)
{
    (void)state;
    const char *cards[] = {"1,0", "1,.06"};
    for (int i = 0; i < 2; i++) {
        Scene scene = {0};
        VerifyRun run;
        begin(&scene, SCENE_DIAGONAL, 2, 0.01);
        pull_ends(&scene, 1.6);
        scene_print(&scene.deck, "*CONSTRAINED_TIED_NODES_FAILURE\n%s\n", cards[i]);
        const int nodes = scene.mesh.node_count / 2;
        scene_end(&scene.deck, &scene.mesh);
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        for (int k = 0; k < run.model.ties.count; k++) assert_true(run.state.tie_broken[k] < 0.0);
        for (int y = 0; y < 5; y++) /* rows of CELLS + 1 nodes */
            for (int c = 0; c < 3; c++)
                verify_near("ends together", run.x[3 * (y * (CELLS + 1) + CELLS) + c],
                            run.x[3 * (nodes + y * (CELLS + 1)) + c], 1e-15);
        verify_balance(&run, 2e-3);
        verify_free(&run);
    }
}

/* Free strips that fly apart: nothing but ties between them, whose forces are a pair. */
static void momentum_is_kept(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, SCENE_DIAGONAL, 2, 2e-3);
    scene_print(&scene.deck, "*CONSTRAINED_TIED_NODES_FAILURE\n1,.02\n*INITIAL_VELOCITY_NODE\n");
    double sum[3] = {0}, mass = 0;
    for (int i = 0; i < scene.mesh.node_count; i++)
        scene_print(&scene.deck, "%d,%.17g,%.17g,1\n", i + 1, 100 * (scene.mesh.x[3 * i] - 0.2) + 3,
                    scene.mesh.x[3 * i + 1]);
    const int nodes = scene.mesh.node_count;
    scene_end(&scene.deck, &scene.mesh);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    int broken = 0;
    for (int k = 0; k < run.model.ties.count; k++) broken += run.state.tie_broken[k] >= 0.0;
    assert_int_equal(broken, 5);
    for (int n = 0; n < nodes; n++) mass += run.model.mass[n];
    for (int i = 0; i < 3 * nodes; i++) sum[i % 3] += run.model.mass[i / 3] * run.state.v[i];
    verify_close("x", sum[0], 3 * mass, 1e-12);
    verify_close("z", sum[2], mass, 1e-12);
    verify_balance(&run, 2e-3);
    verify_free(&run);
}

static void strains_are_logarithmic(void **state)
{
    (void)state;
    double strain[2];
    /* stretches 1.3 and 0.9, turned by 30 degrees */
    const double a = 1.3 * 1.3, b = 0.81, c = 0.75, s = 0.25, m = 0.5 * sqrt(0.75);
    tear_strains((const double[]){c * a + s * b, s * a + c * b, m * (a - b)}, strain);
    verify_close("larger", strain[0], log(1.3), 1e-14);
    verify_close("smaller", strain[1], log(0.9), 1e-13);
    /* rubber pulled along: strains e, -e/2 and, across the plane, -e/2 */
    verify_close("effective, uniaxial", tear_effective_strain((const double[]){0.2, -0.1}), 0.2, 1e-15);
    verify_close("effective, equibiaxial", tear_effective_strain((const double[]){0.1, 0.1}), 0.2, 1e-15);
    /* what is crumpled to nothing has a large, but finite strain */
    tear_strains((const double[]){0, 0, 0}, strain);
    assert_true(isfinite(strain[0]) && isfinite(strain[1]));
}

enum { CYCLES = 400 };

static void build_strips(VerifyRun *run, int threads, int64_t stop)
{
    Scene scene = {0};
    begin(&scene, SCENE_CROSS, 0, 1);
    scene_print(&scene.deck, "*CONSTRAINED_TIED_NODES_FAILURE\n1,.01\n*INITIAL_VELOCITY_NODE\n");
    for (int i = 0; i < scene.mesh.node_count; i++)
        scene_print(&scene.deck, "%d,%.17g,0,%.17g\n", i + 1,
                    10 * (scene.mesh.x[3 * i] - 0.2) * (1 + 20 * scene.mesh.x[3 * i + 1]),
                    20 * scene.mesh.x[3 * i + 1]);
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(
        verify_build(run, scene.deck.text, scene.deck.length, &(VerifyOptions){.threads = threads, .stop = stop}), 0);
    scene_free(&scene);
}

static int count_broken(const VerifyRun *run)
{
    int broken = 0;
    for (int i = 0; i < run->model.ties.count; i++) broken += run->state.tie_broken[i] >= 0.0;
    return broken;
}

static void a_restart_and_any_threads_give_the_same_bits(void **state)
{
    (void)state;
    static const char path[] = "test_tie.billow";
    VerifyRun straight;
    build_strips(&straight, 1, CYCLES);
    assert_int_equal(verify_loop(&straight), 0);
    const uint64_t hash = state_hash(&straight.state);
    const int broken = count_broken(&straight);
    print_message("    %d of %d broken\n", broken, straight.model.ties.count);
    verify_free(&straight);
    for (int threads = 1; threads <= 4; threads++) {
        VerifyRun first, second;
        build_strips(&first, threads, 3 * CYCLES / 4);
        assert_int_equal(verify_loop(&first), 0);
        assert_in_range(count_broken(&first), 1, broken - 1);
        assert_int_equal(checkpoint_write(path, &first.model, &first.state, &first.diagnostics), 0);
        build_strips(&second, 5 - threads, CYCLES);
        assert_int_equal(checkpoint_read(path, &second.model, &second.state, &second.diagnostics), 0);
        assert_int_equal(verify_loop(&second), 0);
        assert_true(state_hash(&second.state) == hash);
        verify_free(&first);
        verify_free(&second);
    }
    unlink(path);
}

static void expect_error(Scene *scene, const char *text)
{
    VerifyRun run;
    scene_end(&scene->deck, &scene->mesh);
    assert_int_equal(verify_build(&run, scene->deck.text, scene->deck.length, &(VerifyOptions){0}), -1);
    scene_free(scene);
    if (!verify_message(&run.diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_WARNING, stderr);
        fail_msg("no error with '%s'", text);
    }
    verify_free(&run);
}

static void bad_cards_are_refused(void **state)
{
    (void)state;
    const char *cases[][2] = {
        {"*CONSTRAINED_TIED_NODES_FAILURE\n9,.1\n", "9"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n1,.1\n1,.1\n", "in another set of tied nodes"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n1,-.1\n", "EPPF is -0.1; give the effective strain"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n1,.1,1\n", "ETYPE"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n2,.1\n", "no two nodes of node set 2 lie at one place"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n1,.1\n*BOUNDARY_SPC_NODE\n11,0,1,1,1\n", "node 11 is also held"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n1,.1\n*CONSTRAINED_SPOTWELD\n11,56\n", "is in a spotweld already"},
        {"*CONSTRAINED_TIED_NODES_FAILURE\n1,.1\n*INITIAL_VELOCITY_NODE\n11,1\n", "start with different velocities"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Scene scene = {0};
        begin(&scene, SCENE_DIAGONAL, 2, 1);
        scene_print(&scene.deck, "%s", cases[i][0]);
        expect_error(&scene, cases[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tie_breaks_at_its_strain),
        cmocka_unit_test(a_tie_holds_below_its_strain),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(strains_are_logarithmic),
        cmocka_unit_test(a_restart_and_any_threads_give_the_same_bits),
        cmocka_unit_test(bad_cards_are_refused),
    };
    return cmocka_run_group_tests_name("tied nodes", tests, NULL, NULL);
}
