/* Rigid walls against closed forms: plastic stop, friction, a falling string of masses, walls that are driven or moved
 * by momentum, edges, shapes, nodes that start behind. */
#include "tests/wall_case.h"

static const double ORIGIN[3] = {0, 0, 0}, UP[3] = {0, 0, 1};

/* ---- stop, friction, weld ----------------------------------------------------------------------------------------
 */

/* Dropped with 3 from a height of 1: the kinetic energy is lost, the impulse is the momentum, the weight rests. */
static void stops_without_bounce(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0, 0, 1);
    wall_write_velocity(&scene.deck, 0, 0, -3);
    wall_write_gravity(&scene.deck, 10);
    wall_write_plane(&scene.deck, "", ORIGIN, UP, 0, 0);
    wall_run(&run, &scene, &record, 1);
    double hit = (sqrt(29.0) - 3) / 10; /* 1 = 3 t + 5 t^2 */
    verify_near("lowest place", record.lowest[2], 0, 1e-14);
    for (int i = 0; i < 4; i++) {
        verify_near("place at rest", run.x[3 * i + 2], 0, 1e-14);
        verify_near("velocity at rest", run.v[3 * i + 2], 0, 1e-12);
    }
    verify_close("weight on the wall", record.force[2], 40, 1e-9);
    verify_close("impulse", record.normal, 4 * (3 + 10 * hit) + 40 * (1 - hit), 2e-3);
    verify_close("energy lost", run.samples[run.count - 1].external, -18, 1e-5);
    verify_near("balance", wall_imbalance(&run), 0, 1e-5);
    verify_free(&run);
}

/* Slides with 2 under gravity 10 and FRIC 0.25: at rest after v/(mu g) = 0.8 and v^2/(2 mu g) = 0.8. */
static void friction_stops_a_slide(void **state)
{
    (void)state;
    const double steep[3] = {0.6, 0, 0.8};
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0, 0, 0);
    wall_write_velocity(&scene.deck, 1.2, 1.6, 0);
    wall_write_gravity(&scene.deck, 10);
    wall_write_plane(&scene.deck, "", ORIGIN, UP, 0.25, 0);
    wall_run(&run, &scene, &record, 1);
    verify_close("sliding distance", hypot(run.x[0], run.x[1]), 0.8, 2e-3);
    verify_close("its direction", run.x[1] / run.x[0], 4.0 / 3, 1e-9);
    verify_near("velocity", hypot(run.v[0], run.v[1]), 0, 1e-12);
    verify_near("balance", wall_imbalance(&run), 0, 1e-9);
    verify_free(&run);
    /* down a slope of 3 : 4: a = g (sin - mu cos) = 4 */
    scene = (Scene){0};
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0, 0, 0);
    for (int i = 0; i < 4; i++) scene.mesh.x[3 * i + 2] = -0.75 * scene.mesh.x[3 * i];
    wall_write_gravity(&scene.deck, 10);
    wall_write_plane(&scene.deck, "", ORIGIN, steep, 0.25, 0);
    wall_run(&run, &scene, &record, 1);
    verify_close("way down the slope", hypot(run.x[0], run.x[2]), 2, 1e-3);
    verify_near("place on the slope", 0.6 * run.x[0] + 0.8 * run.x[2], 0, 1e-13);
    verify_free(&run);
}

/* An oblique hit with normal speed 3: the sliding speed falls from 5 by FRIC 3; FRIC 1 stops it. */
static void friction_of_a_hit(void **state)
{
    (void)state;
    const double friction[3] = {0, 0.4, 1}, left[3] = {5, 3.8, 0};
    for (int i = 0; i < 3; i++) {
        Scene scene = {0};
        VerifyRun run;
        WallRecord record;
        wall_begin(&scene, 1);
        wall_add_square(&scene, 0, 0, 1);
        wall_write_velocity(&scene.deck, 5, 0, -3);
        wall_write_plane(&scene.deck, "", ORIGIN, UP, friction[i], 0);
        wall_run(&run, &scene, &record, 1);
        verify_near("sliding speed after the hit", run.v[0], left[i], 1e-12);
        verify_close("normal impulse", record.normal, 12, 1e-12);
        verify_near("sliding impulse", record.impulse[0], 4 * (left[i] - 5), 1e-11);
        verify_free(&run);
    }
}

/* FRIC 2 and 3: who hits faster than WVEL stays although it is pulled away; who is slower leaves. */
static void fast_hits_weld(void **state)
{
    (void)state;
    const double friction[3] = {2, 3, 3}, speed[3] = {2, 2, 4};
    for (int i = 0; i < 3; i++) {
        Scene scene = {0};
        VerifyRun run;
        WallRecord record;
        wall_begin(&scene, 1);
        wall_add_square(&scene, 0, 0, 1);
        wall_write_velocity(&scene.deck, 5, 0, -3);
        scene_write_curve(&scene.deck, 99, 2, (const double[]){0, 1, 1, 1});
        scene_write_gravity(&scene.deck, 99, -1); /* upwards */
        wall_write_plane(&scene.deck, "", ORIGIN, UP, friction[i], speed[i]);
        wall_run(&run, &scene, &record, 1);
        if (i == 2) {
            assert_true(run.x[2] > 0.1);
        } else {
            verify_near("place", run.x[2], 0, 1e-13);
            verify_close("pull", record.force[2], -4, 1e-9);
        }
        verify_near("sliding speed", run.v[0], i == 0 ? 5 : 0, 1e-12);
        verify_free(&run);
    }
}

/* ---- a falling string of masses ------------------------------------------------------------------------------------
 */

/* 100 squares, one above the other, fall on a wall: while the string lands the force is the momentum that arrives,
 * 2 lambda g y, and the weight of what lies there, lambda g y: 3 lambda g y, with y = g t^2/2. */
static void string_presses_three_times_its_weight(void **state)
{
    (void)state;
    enum { COUNT = 100 };
    const double g = 10, gap = 0.01, end = sqrt(2 * gap * COUNT / g);
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, end);
    for (int i = 0; i < COUNT; i++) wall_add_square(&scene, 0, 0, gap * (i + 0.5));
    wall_write_gravity(&scene.deck, g);
    wall_write_plane(&scene.deck, "", ORIGIN, UP, 0, 0);
    wall_run(&run, &scene, &record, 2);
    double exact = 0;
    for (int i = 0; i < COUNT; i++) {
        double speed = sqrt(2 * g * gap * (i + 0.5));
        exact += 4 * (speed + g * (end - speed / g));
    }
    verify_close("impulse, mass by mass", record.normal, exact, 1e-3);
    /* the integral of 3 lambda g y up to the end, lambda = 4/gap, y = g t^2/2 */
    verify_close("impulse of a continuous string", record.normal, 3 * (4 / gap) * g * g * end * end * end / 6, 2e-3);
    verify_close("weight at the end", record.force[2], 4 * g * COUNT, 1e-6);
    verify_free(&run);
}

/* ---- walls that move ---------------------------------------------------------------------------------------------
 */

/* A wall of mass 12 with speed 2 meets two squares of mass 4: 24/16 = 1.5 after the first; the second slows the wall,
 * which nothing holds to the first, to 12 x 1.5/16 = 1.125. */
static void momentum_moves_a_wall(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 2);
    wall_add_square(&scene, 0, 0, 0.5);
    wall_add_square(&scene, 0, 0, 1.5);
    wall_write_plane(&scene.deck, "_MOVING", ORIGIN, UP, 0, 0);
    SCENE_CARD(&scene.deck, 12, 2);
    wall_run(&run, &scene, &record, 1);
    verify_close("momentum", record.momentum[2] + record.wall_momentum, 24, 1e-13);
    for (int i = 0; i < 4; i++) {
        verify_close("speed of the first masses", run.v[3 * i + 2], 1.5, 1e-12);
        verify_close("speed of the others", run.v[12 + 3 * i + 2], 1.125, 1e-12);
    }
    verify_close("speed of the wall", record.wall_momentum / 12, 1.125, 1e-12);
    double met = 0.25 + 1 / 1.5; /* at 0.25 the first, and 1 farther on at 1.5 the second */
    verify_close("place of the first", run.x[2], 0.5 + 1.5 * 1.75, 2e-3);
    verify_close("place of the others", run.x[14], 1.5 + 1.125 * (2 - met), 2e-3);
    verify_near("balance", wall_imbalance(&run), 0, 1e-12);
    verify_free(&run);
}

/* Displacement and velocity curves move walls exactly; nodes in front ride on them. */
static void curves_drive_walls(void **state)
{
    (void)state;
    for (int opt = 0; opt < 2; opt++) {
        Scene scene = {0};
        VerifyRun run;
        WallRecord record;
        wall_begin(&scene, 1);
        wall_add_square(&scene, 0, 0, 0.25);
        scene_write_curve(&scene.deck, 1, 2, opt ? (const double[]){0, 0, 2, 4} : (const double[]){0, 2, 1, 2});
        wall_write_gravity(&scene.deck, 10);
        scene_print(&scene.deck, "*RIGIDWALL_GEOMETRIC_FLAT_MOTION_ID\n         7the ram\n");
        SCENE_CARD(&scene.deck, 0, 0, 0, 0, 0);
        SCENE_CARD(&scene.deck, 0, 0, -1, 0, 0, 5, 0);
        SCENE_CARD(&scene.deck, 0, 0, 0, 0, 0);
        SCENE_CARD(&scene.deck, 1, opt, 0, 0, 3);
        wall_run(&run, &scene, &record, 1);
        assert_int_equal(run.model.walls[0].id, 7);
        for (int i = 0; i < 4; i++) {
            verify_near("place", run.x[3 * i + 2], 1, 1e-12);
            verify_close("velocity", run.v[3 * i + 2], 2, 1e-9);
        }
        verify_near("balance", wall_imbalance(&run), 0, 1e-5);
        verify_free(&run);
    }
}

/* ---- who is caught -----------------------------------------------------------------------------------------------
 */

/* A finite wall of 2 x 2 catches the square above it; the one beside it falls past, even where it then is under it. */
static void finite_walls_end_at_their_edges(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0.5, 0.5, 1);
    wall_add_square(&scene, -2.1, 0.5, 0.1);
    wall_write_velocity(&scene.deck, 3, 0, -3);
    wall_write_plane(&scene.deck, "_FINITE", ORIGIN, UP, 1, 0);
    SCENE_CARD(&scene.deck, 1, 0, 0, 3, 2);
    wall_run(&run, &scene, &record, 1);
    for (int i = 0; i < 4; i++) {
        verify_near("caught", run.x[3 * i + 2], 0, 1e-12);
        verify_near("passed", run.x[12 + 3 * i + 2], -2.9, 1e-12);
    }
    verify_close("impulse", record.normal, 12, 1e-12);
    verify_free(&run);
}

/* Nodes behind the wall may only move towards its front, and are caught by it after. */
static void nodes_behind_move_to_the_front_only(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0, 0, -0.5);
    scene_write_curve(&scene.deck, 1, 3, (const double[]){0, 1, 0.4, 0, 1, -2});
    scene_write_gravity(&scene.deck, 1, 10); /* down, then up */
    wall_write_velocity(&scene.deck, 1, 0, 0);
    wall_write_plane(&scene.deck, "", ORIGIN, UP, 0, 0);
    wall_run(&run, &scene, &record, 1);
    assert_int_equal(run.model.walls[0].behind_count, 4);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "all 4 of the 4 nodes"));
    verify_near("held until the pull turns", record.lowest[2], -0.5, 1e-12);
    /* a = 10/0.3 (t - 0.4), thus z = 10/0.3 (t - 0.4)^3/6 - 0.5 */
    verify_close("then free", run.x[2] + 0.5, 10 / 0.3 * 0.6 * 0.6 * 0.6 / 6, 5e-3);
    verify_free(&run);
}

/* A wall acts between BIRTH and DEATH only; nodes that are behind it at birth count as such. */
static void walls_are_born_and_die(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0, 0, 0.25);
    wall_add_square(&scene, 0, 0, 1.5);
    wall_write_velocity(&scene.deck, 0, 0, -1);
    scene_print(&scene.deck, "*RIGIDWALL_PLANAR\n");
    SCENE_CARD(&scene.deck, 0, 0, 0, 0, 0.5, 0.75, 0);
    SCENE_CARD(&scene.deck, 0, 0, 0, 0, 0, 1, 0, 0);
    wall_run(&run, &scene, &record, 1);
    verify_near("behind at birth: stopped there", run.x[2], -0.25, 2e-3);
    verify_near("not met in the wall's life", run.x[14], 0.5, 1e-12);
    verify_free(&run);
}

/* A sphere stops what falls on its top and lets slide off what falls beside it. */
static void sphere_and_prism_catch(void **state)
{
    (void)state;
    for (int prism = 0; prism < 2; prism++) {
        Scene scene = {0};
        VerifyRun run;
        WallRecord record;
        wall_begin(&scene, 1);
        wall_add_square(&scene, prism ? 0.5 : 0, prism ? 0.5 : 0, 3);
        wall_write_velocity(&scene.deck, 0, 0, -2);
        scene_print(&scene.deck, prism ? "*RIGIDWALL_GEOMETRIC_PRISM\n" : "*RIGIDWALL_GEOMETRIC_SPHERE\n");
        SCENE_CARD(&scene.deck, 0, 0, 0, 0, 0);
        SCENE_CARD(&scene.deck, 0, 0, prism ? 2 : 0, 0, 0, 5, 1);
        if (prism)
            SCENE_CARD(&scene.deck, 1, 0, 2, 2, 2, 1);
        else
            SCENE_CARD(&scene.deck, 2, 0);
        wall_run(&run, &scene, &record, 1);
        verify_close("top", run.x[2], 2, 1e-12);
        for (int i = 0; i < 4; i++) {
            const double *x = run.x + 3 * (ptrdiff_t)i;
            double distance = prism ? x[2] : sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
            verify_between("outside the wall", distance, 2 - 1e-12, 2 + 1e-5);
            verify_near("stopped", run.v[3 * i + 2], 0, 1e-9);
        }
        verify_free(&run);
    }
}

/* A node held in x by a support meets a wall of 45 degrees: it slides along z as far as the wall lets it, x stays. */
static void supports_go_before_walls(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    wall_begin(&scene, 1.25);
    wall_add_square(&scene, 0, 0, 1);
    wall_write_velocity(&scene.deck, 0, 0, -2);
    scene_write_node_set(&scene.deck, 1, &scene.mesh, scene_select_all, NULL);
    scene_write_spc(&scene.deck, 1, true, false, false);
    wall_write_plane(&scene.deck, "", ORIGIN, (const double[3]){1, 0, 1}, 0, 0);
    wall_run(&run, &scene, &record, 1);
    verify_near("x is held", run.x[0], 0, 1e-15);
    verify_near("on the wall", run.x[2], 0, 1e-12);
    verify_near("on the wall", run.x[3 + 2], -1, 1e-12);
    verify_near("at rest", run.v[2], 0, 1e-12);
    verify_near("balance", wall_imbalance(&run), 0, 1e-12);
    verify_free(&run);
}

/* A sheet thrown on a slope with friction, and on a wall with mass beside it. */
static void make_sheet(Scene *scene)
{
    SceneText *deck = &scene->deck;
    SceneFabric fabric = scene_isotropic(0, true, 800, 3e8, 0.3);
    scene_begin(deck, "a sheet on two walls", 0.02, 0);
    scene_write_part(deck, 1, 1, 1, "sheet");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_fabric(deck, 1, &fabric);
    wall_write_velocity(deck, 3, 0, -20);
    wall_write_plane(deck, "", (const double[3]){0, 0, -0.02}, (const double[3]){0.3, 0, 1}, 0.3, 0);
    wall_write_plane(deck, "_MOVING", (const double[3]){0.8, 0, 0}, (const double[3]){-1, 0, 0.2}, 0.2, 0);
    SCENE_CARD(deck, 0.02, 1);
    scene_add_rectangle(&scene->mesh, 1, SCENE_DIAGONAL, 24, 24, 0.6, 0.6);
    scene_end(deck, &scene->mesh);
}

/* The state has the same bits on any number of threads, whether or not cycles are recorded, and after a stop. */
static void same_bits_however_it_runs(void **state)
{
    (void)state;
    uint64_t first = 0;
    for (int i = 0; i < 5; i++) {
        Scene scene = {0};
        VerifyRun run;
        make_sheet(&scene);
        verify_scene(&run, &scene,
                     &(VerifyOptions){.threads = i < 3 ? i + 1 : 1, .every = i == 3, .stop = i == 4 ? 150 : 0});
        if (i == 4) {
            assert_int_equal(run.cycles, 150);
            run.options.stop = 0;
            assert_int_equal(verify_loop(&run), 0);
        }
        uint64_t hash = state_hash(&run.state);
        if (i == 0) first = hash;
        if (i == 3) verify_near("balance", wall_imbalance(&run), 0, 5e-3);
        verify_free(&run);
        assert_true(hash == first);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stops_without_bounce),
        cmocka_unit_test(friction_stops_a_slide),
        cmocka_unit_test(friction_of_a_hit),
        cmocka_unit_test(fast_hits_weld),
        cmocka_unit_test(string_presses_three_times_its_weight),
        cmocka_unit_test(momentum_moves_a_wall),
        cmocka_unit_test(curves_drive_walls),
        cmocka_unit_test(finite_walls_end_at_their_edges),
        cmocka_unit_test(nodes_behind_move_to_the_front_only),
        cmocka_unit_test(walls_are_born_and_die),
        cmocka_unit_test(sphere_and_prism_catch),
        cmocka_unit_test(supports_go_before_walls),
        cmocka_unit_test(same_bits_however_it_runs),
    };
    return cmocka_run_group_tests_name("rigid walls", tests, NULL, NULL);
}
