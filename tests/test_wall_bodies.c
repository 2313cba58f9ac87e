/* Rigid bodies that meet rigid walls (RWPNAL > 0) against closed forms: bounce, rest, friction, tumbling, and what
 * passes. */
#include "tests/wall_case.h"

#include "solver/vector3.h"

static const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 1};

/* Null shells of part 1 far above; a cube of side 1 and mass 3 of part 2 at (0, 0, z); steps of 1e-4. */
static void begin(Scene *scene, double end_time, double z, double rwpnal)
{
    SceneText *deck = &scene->deck;
    int node[8];
    wall_begin(scene, end_time);
    wall_add_square(scene, 0, 0, 90);
    scene_write_part(deck, 2, 2, 2, "cube");
    scene_print(deck, "*MAT_RIGID\n2,3\n\n\n*SECTION_SOLID\n2\n*CONTROL_CONTACT\n0,%g\n", rwpnal);
    for (int c = 0; c < 8; c++) node[c] = 1 + scene_add_node(&scene->mesh, (c + 1) / 2 % 2, c / 2 % 2, z + c / 4);
    scene_print(deck, "*ELEMENT_SOLID\n2,2,%d,%d,%d,%d,%d,%d,%d,%d\n*CONTROL_TIMESTEP\n0.0001\n", node[0], node[1],
                node[2], node[3], node[4], node[5], node[6], node[7]);
}

static const RigidOutput *body(const VerifyRun *run)
{
    return &run->state.rigid[0].output;
}

/* Flat on four corners: the speed comes back, the wall's impulse is twice the momentum, the depth that of (W12). */
static void it_bounces(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    begin(&scene, 0.5, 0.5, 1);
    scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n2,0,0,-2\n");
    wall_write_plane(&scene.deck, "", origin, up, 0, 0);
    wall_run(&run, &scene, &record, 1);
    verify_close("speed after", body(&run)->v[2], 2, 2e-3);
    verify_close("impulse", record.impulse[2], 12, 2e-3);
    verify_near("spin", vector3_norm(body(&run)->spin), 0, 1e-9);
    verify_near("balance", wall_imbalance(&run), 0, 1e-3);
    assert_true(record.lowest[2] < 0 && record.lowest[2] > -0.02);
    verify_free(&run);
}

/* It lies on the floor and slides: v^2/(2 mu g) until it rests, and the floor carries its weight. */
static void it_slides_and_stops(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    begin(&scene, 0.8, 0, 1);
    scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n2,1,0,0\n");
    wall_write_gravity(&scene.deck, 10);
    wall_write_plane(&scene.deck, "", origin, up, 0.2, 0);
    wall_run(&run, &scene, &record, 1);
    verify_close("way", body(&run)->x[0] - 0.5, 1 / (2 * 0.2 * 10), 0.01);
    verify_near("speed at the end", body(&run)->v[0], 0, 1e-3);
    verify_close("impulse", record.impulse[2], 3 * 10 * 0.8, 0.01);
    verify_near("height", body(&run)->x[2], 0.5, 1e-3);
    verify_free(&run);
}

/* A node without mass that hangs on the body by *CONSTRAINED_EXTRA_NODES is all that meets the wall: a leg. One
 * node takes the whole penalty, (w dt)^2 = 0.14. */
static void it_bounces_on_a_leg(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    WallRecord record;
    begin(&scene, 0.5, 0.7, 1);
    int leg = 1 + scene_add_node(&scene.mesh, 0.5, 0.5, 0.5);
    scene_print(&scene.deck, "*CONSTRAINED_EXTRA_NODES_NODE\n2,%d\n*SET_NODE_LIST\n5\n%d\n", leg, leg);
    scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n2,0,0,-2\n*RIGIDWALL_PLANAR\n5\n0,0,0,0,0,1\n");
    wall_run(&run, &scene, &record, 1);
    verify_close("speed after", body(&run)->v[2], 2, 5e-3);
    verify_near("spin", vector3_norm(body(&run)->spin), 0, 1e-9);
    assert_true(record.lowest[2] < 0 && record.lowest[2] > -0.02);
    verify_free(&run);
}

/* What passes, what is told, what is refused; a wall with a mass, a wall behind which it starts, RWPNAL = 0. */
static void what_passes(void **state)
{
    (void)state;
    static const struct {
        const char *options, *card;
        double rwpnal, z;
        bool note, warning;
    } cases[] = {
        {"", "", 0, 0.5, true, false}, {"_MOVING", "1e6,0\n", 1, 0.5, true, true}, {"", "", 1, -1.5, false, false}};
    for (int i = 0; i < 3; i++) {
        Scene scene = {0};
        VerifyRun run;
        WallRecord record;
        begin(&scene, 0.5, cases[i].z, cases[i].rwpnal);
        scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n2,0,0,-2\n");
        wall_write_plane(&scene.deck, cases[i].options, origin, up, 0, 0);
        scene_print(&scene.deck, "%s", cases[i].card);
        wall_run(&run, &scene, &record, 1);
        verify_close("speed after", body(&run)->v[2], -2, 1e-12);
        assert_int_equal(verify_message(&run.diagnostics, SEVERITY_NOTE, "8 nodes of moving rigid parts pass"),
                         cases[i].note);
        assert_int_equal(verify_message(&run.diagnostics, SEVERITY_WARNING, "walls without mass only"),
                         cases[i].warning);
        verify_free(&run);
    }
}

/* From a corner, with inertia of a card, on all kinds of walls: the energy stays. */
static void it_tumbles(void **state)
{
    (void)state;
    static const char *const walls[] = {"*RIGIDWALL_PLANAR_FINITE\n0\n-1,-1,0,-1,-1,1\n3,-1,0,9,9\n",
                                        "*RIGIDWALL_GEOMETRIC_SPHERE\n0\n.4,.5,-.6,0,0,1\n.5\n",
                                        "*RIGIDWALL_GEOMETRIC_CYLINDER\n0\n.4,-5,-.6,.4,5,-.6\n.5\n",
                                        "*RIGIDWALL_GEOMETRIC_PRISM\n0\n-1,-1,0,-1,-1,1\n3,-1,0,9,9,1\n"};
    for (int i = 0; i < 4; i++) {
        Scene scene = {0};
        VerifyRun run;
        WallRecord record;
        begin(&scene, 0.8, 0.6, 1);
        scene_print(&scene.deck, "%s*INITIAL_VELOCITY_RIGID_BODY\n2,0,0,-2,1,2,3\n", walls[i]);
        wall_run(&run, &scene, &record, 1);
        double energy = rigid_body_kinetic(&run.model.rigid_bodies[0], &run.state.rigid[0]);
        double start = 0.5 * (3 * 4 + 1.5 * 14); /* moments 3/2 */
        verify_close("kinetic energy", energy, start, 5e-3);
        assert_true(record.normal > 1);
        verify_near("balance", wall_imbalance(&run), 0, 5e-3);
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_bounces), cmocka_unit_test(it_bounces_on_a_leg),
                                       cmocka_unit_test(it_slides_and_stops), cmocka_unit_test(what_passes),
                                       cmocka_unit_test(it_tumbles)};
    return cmocka_run_group_tests_name("rigid bodies at rigid walls", tests, NULL, NULL);
}
