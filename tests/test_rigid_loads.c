/* *LOAD_RIGID_BODY: forces and moments on rigid bodies against closed forms, and its cards. */
#include "tests/wall_case.h"

#include <string.h>

/* Null shells of part 1 far away; a cube of side 1 and mass 3 of part 2 at the origin, its neighbour of part 3 at x =
 * 1; curve 7 is 1. */
static void begin(Scene *scene, double end_time, int fixed)
{
    SceneText *deck = &scene->deck;
    wall_begin(scene, end_time);
    wall_add_square(scene, 9, 9, 9);
    for (int part = 2; part <= 3; part++) {
        int node[8];
        scene_write_part(deck, part, 2, part, "cube");
        scene_print(deck, "*MAT_RIGID\n%d,3\n1,%d,%d\n\n", part, fixed, fixed);
        for (int c = 0; c < 8; c++)
            node[c] = 1 + scene_add_node(&scene->mesh, part - 2 + ((c + 1) / 2 % 2), c / 2 % 2, c / 4);
        scene_print(deck, "*ELEMENT_SOLID\n%d,%d,%d,%d,%d,%d,%d,%d,%d,%d\n", part, part, node[0], node[1], node[2],
                    node[3], node[4], node[5], node[6], node[7]);
    }
    scene_print(deck, "*SECTION_SOLID\n2\n*DEFINE_CURVE\n7\n0,1\n10,1\n*CONTROL_TIMESTEP\n0.001\n");
}

/* Runs a deck with these cards; the state of the first body at the end. */
static RigidOutput run_cards(VerifyRun *run, const char *cards, double end_time)
{
    Scene scene = {0};
    begin(&scene, end_time, 0);
    scene_print(&scene.deck, "%s", cards);
    verify_scene_build(run, &scene, 0);
    assert_int_equal(verify_loop(run), 0);
    verify_near("balance", wall_imbalance(run), 0, 1e-3);
    return run->state.rigid[0].output;
}

static void near3(const char *name, const double *value, double x, double y, double z, double tolerance)
{
    verify_near(name, value[0], x, tolerance);
    verify_near(name, value[1], y, tolerance);
    verify_near(name, value[2], z, tolerance);
}

/* F t / M and F t^2 / (2 M); of a body of two parts the mass of both counts, whichever the card names. */
static void forces_push_the_centre(void **state)
{
    (void)state;
    VerifyRun run;
    RigidOutput end = run_cards(&run, "*LOAD_RIGID_BODY\n2,1,7,6\n2,3,7,-3\n", 2);
    near3("velocity", end.v, 4, 0, -2, 1e-12);
    near3("centre", end.x, 0.5 + 4, 0.5, 0.5 - 2, 1e-11);
    near3("spin", end.spin, 0, 0, 0, 0);
    verify_free(&run);
    end = run_cards(&run, "*CONSTRAINED_RIGID_BODIES\n2,3\n*LOAD_RIGID_BODY\n3,2,7,6\n", 2);
    near3("velocity of both", end.v, 0, 2, 0, 1e-12);
    near3("spin of both", end.spin, 0, 0, 0, 0);
    verify_free(&run);
}

/* T t / I about the centre: eight masses of 3/8 at (1/2, 1/2) from the axis make I = 3/2. Axes of CID: local x is z. */
static void moments_spin_it(void **state)
{
    (void)state;
    static const char *const cards[] = {
        "*LOAD_RIGID_BODY\n2,7,7,3\n",
        "*DEFINE_COORDINATE_VECTOR\n4,0,0,1,1,0,0\n*LOAD_RIGID_BODY\n2,5,7,3,4\n",
    };
    for (int i = 0; i < 2; i++) {
        VerifyRun run;
        RigidOutput end = run_cards(&run, cards[i], 0.5);
        near3("spin", end.spin, 0, 0, 1, 1e-12);
        near3("velocity", end.v, 0, 0, 0, 0);
        verify_free(&run);
    }
}

/* A force normal to a face of a body that spins with w: v = F/(M w) (sin w t, 1 - cos w t). */
static void followers_turn_with_the_body(void **state)
{
    (void)state;
    VerifyRun run;
    /* the face x = 0 of the cube, nodes 5, 8 and 9: (0,1,0) x (0,0,1) is x */
    RigidOutput end =
        run_cards(&run, "*INITIAL_VELOCITY_RIGID_BODY\n2,0,0,0,0,0,2\n*LOAD_RIGID_BODY\n2,4,7,6,0,5,8,9\n", 1.5);
    near3("velocity", end.v, 6 / (3 * 2.0) * sin(3), 6 / (3 * 2.0) * (1 - cos(3)), 0, 1e-5);
    near3("spin", end.spin, 0, 0, 2, 1e-12);
    verify_free(&run);
}

static void bad_cards_are_told_together(void **state)
{
    (void)state;
    static const char *const expected[] = {"DOF = 9", "PID = 1 is no rigid part", "PID = 77: there is no part",
                                           "M2 = 0", "LCID = 66"};
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1, 0);
    scene_print(&scene.deck, "*LOAD_RIGID_BODY\n2,9,7\n1,1,7\n77,1,7\n2,4,7,1,0,5,0,9\n2,1,66\n");
    verify_scene_build(&run, &scene, 5);
    for (int i = 0; i < 5; i++)
        if (!verify_message(&run.diagnostics, SEVERITY_ERROR, expected[i])) fail_msg("no error '%s'", expected[i]);
    verify_free(&run);
    scene = (Scene){0};
    begin(&scene, 1, 7);
    scene_print(&scene.deck, "*LOAD_RIGID_BODY\n2,1,7\n");
    verify_scene_build(&run, &scene, 0);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "the load has no effect"));
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_push_the_centre),
        cmocka_unit_test(moments_spin_it),
        cmocka_unit_test(followers_turn_with_the_body),
        cmocka_unit_test(bad_cards_are_told_together),
    };
    return cmocka_run_group_tests_name("loads of rigid bodies", tests, NULL, NULL);
}
