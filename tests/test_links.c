/* Springs, cables and trusses: frequencies, laws, energies, the stable step; beams of rigid parts; bad cards. */
#include "tests/wall_case.h"

#include <string.h>

#include "elements/link.h"

/* Null shells of part 1 with nodes of mass 1 (tests/wall_case.h); parts 5 springs, 6 cables, 7 trusses. */
static void begin(Scene *scene, double end_time, double slack, double preload)
{
    SceneText *deck = &scene->deck;
    wall_begin(scene, end_time);
    scene_write_part(deck, 5, 5, 5, "springs");
    scene_write_part(deck, 6, 6, 6, "cables");
    scene_write_part(deck, 7, 7, 7, "trusses");
    scene_print(deck, "*SECTION_DISCRETE\n5,0\n0,0\n*MAT_SPRING_ELASTIC\n5,50\n");
    scene_print(deck, "*SECTION_BEAM\n6,6\n0,0,0,.5,%.17g\n*MAT_CABLE_DISCRETE_BEAM\n6,1,200,0,%.17g\n", -slack,
                preload);
    scene_print(deck, "*SECTION_BEAM\n7,3\n.01\n*MAT_ELASTIC\n7,5,3e4,.3\n");
}

/* Holds node 1 and joins it to node 2 by a beam of the part. */
static void join(Scene *scene, int part)
{
    scene_print(&scene->deck, "*ELEMENT_BEAM\n1,%d,1,2\n*BOUNDARY_SPC_NODE\n1,0,1,1,1\n", part);
}

static void run(VerifyRun *result, Scene *scene, int every)
{
    scene_end(&scene->deck, &scene->mesh);
    verify_scene(result, scene, &(VerifyOptions){.every = every, .node = 1});
}

/* A mass of 1 on a spring of 50 S with the speed 1: sin(w t)/w, w^2 = 50 S; a stiff one sets the step, 0.9 x 2/w. */
static void spring_swings(void **state)
{
    (void)state;
    for (int stiff = 0; stiff < 2; stiff++) {
        Scene scene = {0};
        VerifyRun result;
        double scale = stiff ? 2e8 : 2, omega = sqrt(50 * scale);
        begin(&scene, stiff ? 0.05 : 0.7, 0, 0);
        wall_add_square(&scene, 0, 0, 0);
        scene_print(&scene.deck, "*ELEMENT_DISCRETE\n1,5,1,2,0,%g\n*BOUNDARY_SPC_NODE\n1,0,1,1,1\n", scale);
        scene_print(&scene.deck, "*INITIAL_VELOCITY_NODE\n2,1\n");
        run(&result, &scene, 1);
        double worst = 0, step = verify_largest(&result, 0, offsetof(VerifySample, step));
        for (size_t i = 0; i < result.count; i++) {
            double exact = 1 + sin(omega * result.samples[i].time) / omega;
            worst = fmax(worst, fabs(result.samples[i].x[0] - exact) * omega);
        }
        if (stiff)
            verify_close("step times omega over 2", 0.5 * omega * step, 0.9, 1e-12);
        else
            verify_near("way of the mass over its greatest", worst, 0, 1e-4);
        if (!stiff) verify_balance(&result, 1e-3);
        verify_free(&result);
    }
}

/* A cable pulls only: with K = 200 x 0.5/1 = 100 and a slack of 0.05 the mass flies to 1.05, swings back and leaves for
 * good; preloaded it pulls from the start. */
static void cable_pulls_only(void **state)
{
    (void)state;
    for (int preloaded = 0; preloaded < 2; preloaded++) {
        Scene scene = {0};
        VerifyRun result;
        begin(&scene, 0.7, preloaded ? 0 : 0.05, preloaded ? 5 : 0);
        wall_add_square(&scene, 0, 0, 0);
        join(&scene, 6);
        if (!preloaded) scene_print(&scene.deck, "*INITIAL_VELOCITY_NODE\n2,1\n");
        run(&result, &scene, 1);
        double omega = sqrt(100 / (preloaded ? 1 : 1.05));
        double furthest = preloaded ? 1 : 1.05 + 1 / omega, back = preloaded ? 5 / omega : 1;
        verify_close("furthest place", verify_largest(&result, 0, offsetof(VerifySample, x)), furthest, 1e-3);
        verify_close("speed back", -result.v[3], back, 2e-3);
        verify_close("energy at the start", result.samples[0].kinetic + result.samples[0].internal,
                     preloaded ? 0.125 : 0.5, 1e-3);
        verify_balance(&result, 2e-3);
        verify_free(&result);
    }
}

/* The truss's force is E A ln(L/L0); its energy the integral of it. */
static void truss_follows_the_logarithm(void **state)
{
    (void)state;
    const Link truss = {.logarithmic = true, .stiffness = 300, .length = 2, .inverse = {0.5, 1}};
    double energy, sum = 0, unused;
    verify_close("force", link_tension(&truss, 3, 0, &energy), 300 * log(1.5), 1e-15);
    for (int i = 0; i < 1000; i++) sum += 0.001 * link_tension(&truss, 2.0005 + 0.001 * i, 0, &unused);
    verify_close("energy", energy, sum, 1e-6);
    verify_close("rate", link_rate(&truss, 3, 300 * log(1.5)), 300 / 3.0 * 1.5, 1e-15);
    Scene scene = {0};
    VerifyRun result;
    begin(&scene, 0.5, 0, 0);
    wall_add_square(&scene, 0, 0, 0);
    join(&scene, 7);
    scene_print(&scene.deck, "*INITIAL_VELOCITY_NODE\n2,1\n");
    run(&result, &scene, 1);
    double mass = 1 + 0.5 * 5 * 0.01; /* half the truss's own */
    verify_close("mass of the node", result.model.mass[result.model.deck_node[1]], mass, 1e-14);
    verify_close("furthest place", verify_largest(&result, 0, offsetof(VerifySample, x)), 1 + sqrt(mass / 300), 2e-2);
    verify_balance(&result, 1e-2);
    verify_free(&result);
}

/* A rigid bar of beams between two cables is one body with the beams' mass: tube of 0.2 and 0.1. */
static void beams_of_rigid_parts_are_bodies(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun result;
    SceneText *deck = &scene.deck;
    begin(&scene, 1, 0, 0);
    scene_write_part(deck, 8, 8, 8, "bar");
    scene_write_rigid(deck, 8, 100, 0, 0);
    scene_print(deck, "*SECTION_BEAM\n8,1,1,2,1\n.2,,.1\n");
    wall_add_square(&scene, 0, 0, 0);
    int a = 1 + scene_add_node(&scene.mesh, 5, 0, 0), b = 1 + scene_add_node(&scene.mesh, 6, 0, 0),
        c = 1 + scene_add_node(&scene.mesh, 8, 0, 0);
    scene_print(deck, "*ELEMENT_BEAM\n1,8,%d,%d,1\n2,8,%d,%d,1\n3,6,%d,2\n", a, b, b, c, a);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n8,1,0,0\n");
    run(&result, &scene, 1);
    const RigidBody *bar = &result.model.rigid_bodies[0];
    const double pi = 3.14159265358979323846;
    assert_int_equal(result.model.rigid_body_count, 1);
    assert_int_equal(result.model.link_count, 1);
    verify_close("mass", bar->mass, 100 * 3 * pi * (0.04 - 0.01) / 4, 1e-13);
    verify_close("centre", bar->centre[0], 6.5, 1e-13);
    verify_close("momentum", bar->mass * result.state.rigid[0].v[0] + result.v[3], bar->mass, 1e-9);
    verify_balance(&result, 1e-3);
    verify_free(&result);
}

static void bad_links_are_told_together(void **state)
{
    (void)state;
    static const char *const texts[] = {"names node N2 = 99", "joins node 3 to itself", "PID = 77",
                                        "not of its kind",    "springs (section 5)",    "CA = 0"};
    Scene scene = {0};
    VerifyRun result;
    SceneText *deck = &scene.deck;
    begin(&scene, 1, 0, 0);
    wall_add_square(&scene, 0, 0, 0);
    scene_write_part(deck, 9, 5, 1, "springs of null");
    scene_write_part(deck, 10, 10, 6, "cables without area");
    scene_print(deck, "*SECTION_BEAM\n10,6\n0\n*ELEMENT_BEAM\n1,6,1,99\n2,6,3,3\n3,77,1,2\n4,5,1,2\n5,10,1,2\n");
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spring_swings),
        cmocka_unit_test(cable_pulls_only),
        cmocka_unit_test(truss_follows_the_logarithm),
        cmocka_unit_test(beams_of_rigid_parts_are_bodies),
        cmocka_unit_test(bad_links_are_told_together),
    };
    return cmocka_run_group_tests_name("springs, cables and trusses", tests, NULL, NULL);
}
