/* Dampers, nonlinear springs and both to the ground: motion against closed forms, energies, the stable step, cards. */
#include "tests/wall_case.h"

#include <string.h>

#include "solver/relax.h"

/* Null shells of part 1 far away; loose nodes 5 at (0, 0, 0) and 6 at (1, 0, 0), 6 with a mass of 2. Parts 5 to 8:
 * springs of K = 50, dampers of DC = 3, springs and dampers by curve 7. */
static void begin(Scene *scene, double end_time, const char *curve)
{
    SceneText *deck = &scene->deck;
    static const char *const materials[] = {"SPRING_ELASTIC\n5,50", "DAMPER_VISCOUS\n6,3",
                                            "SPRING_NONLINEAR_ELASTIC\n7,7", "DAMPER_NONLINEAR_VISCOUS\n8,7"};
    wall_begin(scene, end_time);
    for (int i = 0; i < 4; i++) {
        scene_write_part(deck, 5 + i, 5, 5 + i, "links");
        scene_print(deck, "*MAT_%s\n", materials[i]);
    }
    scene_print(deck, "*SECTION_DISCRETE\n5,0\n0,0\n*DEFINE_CURVE\n7\n%s\n*ELEMENT_MASS\n1,6,2\n", curve);
    wall_add_square(scene, 9, 9, 9);
    scene_add_node(&scene->mesh, 0, 0, 0);
    scene_add_node(&scene->mesh, 1, 0, 0);
}

static const char *const LINE = "-1,-1\n1,1";
/* The step is 1e-4 of the unit of time at most: the force by the velocity half a step before is of first order. */
static const char *const FINE = "*CONTROL_TIMESTEP\n0,0,0,0,0,99\n*DEFINE_CURVE\n99\n0,1e-4\n9,1e-4\n";
static const char *const HOLD = "*BOUNDARY_SPC_NODE\n5,0,1,1,1\n";

static void run_cards(VerifyRun *run, Scene *scene, const char *cards)
{
    scene_print(&scene->deck, "%s%s", FINE, cards);
    verify_scene_build(run, scene, 0);
    run->options.node = 5;
    if (verify_loop(run)) fail_msg("%s", run->failure.cause);
}

static double dissipated(const VerifyRun *run)
{
    return run->state.energy->damping;
}

/* m x'' + c x' + K (x - 1) = 0: x = 1 + v e^(-d t) sin(w t)/w, d = c/(2 m), w^2 = K/m - d^2. */
static void oscillations_decay(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    const double d = 3 / (2 * 2.0), omega = sqrt(50 / 2.0 - d * d);
    double worst = 0;
    begin(&scene, 3, LINE);
    scene_print(&scene.deck, "%s", HOLD);
    run_cards(&run, &scene,
              "*INITIAL_VELOCITY_NODE\n6,0.5\n"
              "*ELEMENT_DISCRETE\n1,5,5,6\n2,6,5,6\n");
    for (size_t i = 0; i < run.count; i++) {
        double t = run.samples[i].time;
        worst = fmax(worst, fabs(run.samples[i].x[0] - 1 - 0.5 * exp(-d * t) * sin(omega * t) / omega));
    }
    verify_near("way over the greatest", worst * omega / 0.5, 0, 1e-3);
    verify_close("taken by the damper", dissipated(&run),
                 0.25 - run.samples[run.count - 1].kinetic - run.samples[run.count - 1].internal, 1e-4);
    verify_balance(&run, 1e-4);
    verify_free(&run);
}

/* Two masses of 2 and 1: momentum stays, the relative speed decays as e^(-c (1/2 + 1) t); S doubles c. */
static void dampers_keep_momentum(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 0.3, LINE);
    run_cards(&run, &scene,
              "*INITIAL_VELOCITY_NODE\n6,0.6,0.3\n*ELEMENT_MASS\n2,5,1\n"
              "*ELEMENT_DISCRETE\n2,6,5,6,0,2\n");
    verify_close("momentum x", 2 * run.v[3 * 5] + run.v[3 * 4], 1.2, 1e-12);
    verify_close("momentum y", 2 * run.v[3 * 5 + 1] + run.v[3 * 4 + 1], 0.6, 1e-12);
    verify_balance(&run, 1e-4);
    verify_free(&run);
    scene = (Scene){0};
    begin(&scene, 0.3, LINE);
    run_cards(&run, &scene,
              "*INITIAL_VELOCITY_NODE\n6,0.6\n*ELEMENT_MASS\n2,5,1\n"
              "*ELEMENT_DISCRETE\n2,6,5,6,0,2\n");
    verify_close("relative speed", run.v[3 * 5] - run.v[3 * 4], 0.6 * exp(-6 * 1.5 * 0.3), 2e-3);
    verify_close("taken", dissipated(&run), 0.5 * (2 / 3.0) * 0.36 * (1 - exp(-2 * 6 * 1.5 * 0.3)), 1e-3);
    verify_free(&run);
}

/* dt^2 w^2 + 4 dt c/m = 4 at the limit, of which the step is 0.9; the run keeps its balance. */
static void dampers_limit_the_step(void **state)
{
    (void)state;
    for (int spring = 0; spring < 2; spring++) {
        Scene scene = {0};
        VerifyRun run;
        begin(&scene, 0.2, LINE);
        scene_print(&scene.deck, "%s*ELEMENT_DISCRETE\n1,6,5,6,0,1e4\n", HOLD);
        if (spring) scene_print(&scene.deck, "2,5,5,6,0,4e6\n");
        run_cards(&run, &scene, "*INITIAL_VELOCITY_NODE\n6,1\n");
        const double limit = run.samples[0].element_step, square = spring ? 50 * 4e6 / 2 : 0;
        verify_close("limit", limit * limit * square + 4 * limit * 3e4 / 2, 4, 1e-12);
        verify_close("step", run.samples[10].step, 0.9 * limit, 1e-12);
        verify_near("speed at the end", run.v[3 * 5], 0, 1e-9);
        verify_near("balance", wall_imbalance(&run), 0, 1e-3);
        verify_close("taken", dissipated(&run), 1 - run.samples[run.count - 1].internal, 2e-2);
        verify_free(&run);
    }
}

/* A spring to the ground pulls back to where its node started, from all sides alike: an ellipse; a damper to the ground
 * slows its node along the line from there, so that a straight flight decays as e^(-c t/m). */
static void ground_holds(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    const double omega = sqrt(50 / 2.0);
    double worst = 0;
    begin(&scene, 2, LINE);
    run_cards(&run, &scene,
              "*INITIAL_VELOCITY_NODE\n6,0.5,0.2\n*ELEMENT_DISCRETE\n1,5,6\n"
              "*DEFINE_CURVE\n9\n0,0\n0.1,0\n0.1001,1\n9,1\n*LOAD_NODE_POINT\n6,3,9,2\n");
    for (size_t i = 0; i < run.count; i++) {
        double t = run.samples[i].time;
        worst = fmax(worst, fabs(run.samples[i].x[0] - 1 - 0.5 * sin(omega * t) / omega));
        worst = fmax(worst, fabs(run.samples[i].x[1] - 0.2 * sin(omega * t) / omega));
    }
    verify_near("way", worst, 0, 1e-4);
    verify_close("lift by the load", verify_largest(&run, 0, offsetof(VerifySample, x) + 16), 2 * 2 / 50.0, 1e-3);
    verify_balance(&run, 1e-3);
    verify_free(&run);
    scene = (Scene){0};
    begin(&scene, 1, LINE);
    run_cards(&run, &scene, "*INITIAL_VELOCITY_NODE\n6,0.3,0.4\n*ELEMENT_DISCRETE\n1,6,6\n");
    verify_close("speed", hypot(run.v[15], run.v[16]), 0.5 * exp(-1.5), 1e-3);
    verify_close("way", hypot(run.x[15] - 1, run.x[16]), 0.5 / 1.5 * (1 - exp(-1.5)), 1e-3);
    verify_balance(&run, 1e-4);
    verify_free(&run);
}

/* A spring of 100 up to 0.1, then 400; of 50 in push: the mass of 2 turns where the area under the curve is its energy.
 */
static void springs_follow_their_curve(void **state)
{
    (void)state;
    for (int push = 0; push < 2; push++) {
        Scene scene = {0};
        VerifyRun run;
        begin(&scene, 0.6, "-2,-100\n0,0\n0.1,10\n1.1,410");
        scene_print(&scene.deck, "%s*INITIAL_VELOCITY_NODE\n6,%d\n", HOLD, push ? -1 : 2);
        run_cards(&run, &scene, "*ELEMENT_DISCRETE\n1,7,5,6,0,2\n");
        const double pull = (sqrt(20 * 20 + 2 * 800 * (4 - 1)) - 20) / 800; /* 1 + 20 y + 400 y^2 = 4, beyond 0.1 */
        if (push)
            verify_close("turn", verify_smallest(&run, 0, offsetof(VerifySample, x)), 1 - sqrt(2 / 100.0), 1e-4);
        else
            verify_close("turn", verify_largest(&run, 0, offsetof(VerifySample, x)), 1.1 + pull, 1e-4);
        verify_balance(&run, 1e-3);
        verify_free(&run);
    }
}

/* Beyond a rate of 0.01 the damper's force is 0.5, times S = 4: v = 1 - t until it nearly stands. */
static void dampers_follow_their_curve(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1.2, "-10,-0.500000001\n-0.01,-.5\n0.01,.5\n10,0.500000001");
    scene_print(&scene.deck, "%s", HOLD);
    run_cards(&run, &scene, "*INITIAL_VELOCITY_NODE\n6,1\n*ELEMENT_DISCRETE\n1,8,5,6,0,4\n");
    verify_close("speed", verify_at(&run, 0.5, offsetof(VerifySample, v)), 0.5, 1e-3);
    verify_near("speed at the end", run.v[3 * 5], 0, 1e-6);
    verify_close("taken", dissipated(&run), 1, 1e-4);
    verify_balance(&run, 1e-3);
    verify_free(&run);
}

/* A damper on the corner of a body turns and slows it; what it takes is the body's loss. */
static void dampers_slow_bodies(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    SceneText *deck = &scene.deck;
    int node[8];
    begin(&scene, 1, LINE);
    scene_write_part(deck, 2, 2, 2, "cube");
    for (int c = 0; c < 8; c++) node[c] = 1 + scene_add_node(&scene.mesh, 3 + ((c + 1) / 2 % 2), c / 2 % 2, c / 4);
    scene_print(deck, "*MAT_RIGID\n2,3\n1,0,0\n\n*SECTION_SOLID\n2\n*ELEMENT_SOLID\n2,2,%d,%d,%d,%d,%d,%d,%d,%d\n",
                node[0], node[1], node[2], node[3], node[4], node[5], node[6], node[7]);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n2,1,0,0\n%s*ELEMENT_DISCRETE\n1,6,5,%d\n", HOLD, node[0]);
    run_cards(&run, &scene, "");
    assert_true(fabs(run.state.rigid[0].output.spin[2]) > 0.1);
    verify_close("taken", dissipated(&run), 1.5 - run.samples[run.count - 1].kinetic, 1e-4);
    verify_balance(&run, 1e-4);
    verify_free(&run);
}

/* Static equilibrium: weights of 20 on a spring of 50 to the ground and of 5 on one by a curve of 100 (below 0.1). */
static void weights_hang_at_rest(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    RelaxReport report;
    begin(&scene, 1, "-2,-100\n0,0\n0.1,10\n1.1,410");
    scene_add_node(&scene.mesh, 0, 4, 0);
    scene_add_node(&scene.mesh, 0, 4, -1);
    wall_write_gravity(&scene.deck, 10);
    scene_print(&scene.deck, "*CONTROL_DYNAMIC_RELAXATION\n100,1e-6,,,,,,5\n*BOUNDARY_SPC_NODE\n1,0,1,1,1\n2,0,1,1,1\n"
                             "3,0,1,1,1\n4,0,1,1,1\n7,0,1,1,1\n*ELEMENT_MASS\n2,8,0.5\n"
                             "*ELEMENT_DISCRETE\n1,5,6\n2,7,7,8\n3,6,6\n");
    verify_scene_build(&run, &scene, 0);
    assert_int_equal(relax_run(&run.model, &run.model, 1, NULL, &run.state, &report, &run.failure), 0);
    verify_close("on the ground's", run.state.x[3 * run.model.deck_node[5] + 2], -20 / 50.0, 1e-6);
    verify_close("on the curve's", run.state.x[3 * run.model.deck_node[7] + 2], -1 - 5 / 100.0, 1e-6);
    verify_free(&run);
}

static void expect(const char *curve, const char *cards, Severity severity, const char *text)
{
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1, curve);
    scene_print(&scene.deck, "%s%s", HOLD, cards);
    verify_scene_build(&run, &scene, severity == SEVERITY_ERROR);
    if (!verify_message(&run.diagnostics, severity, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_WARNING, stderr);
        fail_msg("nothing with '%s'", text);
    }
    verify_free(&run);
}

static void bad_cards_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *curve, *cards, *text;
    } cases[] = {
        {"0,0\n1,1", "*ELEMENT_DISCRETE\n1,7,5,6\n", "LCD = 7: the curve needs points at negative abscissae"},
        {"-1,-1\n0,0\n1,1\n2,0", "*ELEMENT_DISCRETE\n1,8,5,6\n", "LCDR = 7: the stress falls at this point"},
        {"-1,-1\n0,1\n1,2", "*ELEMENT_DISCRETE\n1,7,5,6\n", "LCD = 7: the curve does not go through the origin"},
        {LINE, "*ELEMENT_DISCRETE\n1,5,6,0,0,1,0,0.5\n", "OFFSET = 0.5 with N2 = 0"},
        {LINE, "*ELEMENT_DISCRETE\n1,6,5,6,0,-1\n", "DC S = -3 must be positive"},
        {LINE, "*ELEMENT_DISCRETE\n1,7,5,6,0,-1\n", "S = -1 must be positive"},
        {LINE, "*ELEMENT_DISCRETE\n1,6,99\n", "names node N1 = 99"},
        {LINE, "*MAT_S04\n9,7,7\n", "LCR"},
        {LINE, "*MAT_S04\n9\n", "LCD must name the curve"},
        {LINE, "*MAT_S05\n9\n", "LCDR must name the curve"},
        {LINE, "*MAT_S04\n9,66\n*PART\np\n9,5,9\n*ELEMENT_DISCRETE\n1,9,5,6\n", "LCD = 66: the deck has no"},
        {LINE, "*NODE\n77,2,2,2\n*ELEMENT_DISCRETE\n1,6,6,77\n", "node 77 of element 1 of part 6 has no mass"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect(cases[i].curve, cases[i].cards, SEVERITY_ERROR, cases[i].text);
    expect(LINE, "*ELEMENT_DISCRETE\n1,6,5,6,0,1,0,0.5\n", SEVERITY_WARNING, "OFFSET = 0.5 has no effect on a damper");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(oscillations_decay),         cmocka_unit_test(dampers_keep_momentum),
        cmocka_unit_test(dampers_limit_the_step),     cmocka_unit_test(ground_holds),
        cmocka_unit_test(springs_follow_their_curve), cmocka_unit_test(dampers_follow_their_curve),
        cmocka_unit_test(dampers_slow_bodies),        cmocka_unit_test(weights_hang_at_rest),
        cmocka_unit_test(bad_cards_are_told),
    };
    return cmocka_run_group_tests_name("dampers and springs", tests, NULL, NULL);
}
