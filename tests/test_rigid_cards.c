/* Rigid bodies from cards: solids, joined parts, extra nodes, nodal rigid bodies, inertia given; bad cards. */
#include "tests/wall_case.h"

#include <string.h>

/* Null shells of part 1 as in wall_begin; rigid solids of part 2, density 3, and of part 3 likewise. */
static void begin(Scene *scene, double end_time)
{
    SceneText *deck = &scene->deck;
    wall_begin(scene, end_time);
    for (int part = 2; part <= 3; part++) {
        scene_write_part(deck, part, 2, part, "rigid");
        scene_write_rigid(deck, part, 3, 0, 0);
    }
    scene_print(deck, "*SECTION_SOLID\n2\n");
}

/* A bar of n cubes of side 1 along x from (x, y, z), as solids from number first on of the part. */
static void add_bar(Scene *scene, int first, int part, int n, double x, double y, double z)
{
    int node[64];
    for (int i = 0; i <= n; i++)
        for (int c = 0; c < 4; c++)
            node[4 * i + c] = 1 + scene_add_node(&scene->mesh, x + i, y + (c == 1 || c == 2), z + (c >= 2));
    scene_print(&scene->deck, "*ELEMENT_SOLID\n");
    for (int i = 0; i < n; i++) {
        const int *a = node + 4 * (ptrdiff_t)i, *b = a + 4;
        scene_print(&scene->deck, "%d,%d,%d,%d,%d,%d,%d,%d,%d,%d\n", first + i, part, a[0], b[0], b[1], a[1], a[3],
                    b[3], b[2], a[2]);
    }
}

static void near3(const char *name, const double *value, double x, double y, double z)
{
    verify_near(name, value[0], x, 1e-12);
    verify_near(name, value[1], y, 1e-12);
    verify_near(name, value[2], z, 1e-12);
}

/* Mass and centre are those of the solid; its faces are its surface: 4 n + 2 of n cubes. */
static void solids_have_mass_and_faces(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    wall_add_square(&scene, 9, 9, 9);
    add_bar(&scene, 1, 2, 3, 0, 0, 0);
    /* a wedge, and a tetrahedron in the format of two lines, of volumes 1/2 and 1/6 */
    int n[5];
    static const double x[5][3] = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0, 0, 6}, {1, 0, 6}};
    for (int i = 0; i < 5; i++) n[i] = 1 + scene_add_node(&scene.mesh, x[i][0], x[i][1], x[i][2]);
    int top = 1 + scene_add_node(&scene.mesh, 0, 1, 6);
    scene_print(&scene.deck, "*ELEMENT_SOLID\n11,3,%d,%d,%d,%d,%d,%d,%d,%d\n", n[1], n[0], n[3], n[4], n[2], n[2], top,
                top);
    scene_print(&scene.deck, "12,3\n%d,%d,%d,%d\n", n[0], n[4], n[1], n[2]);
    verify_scene_build(&run, &scene, 0);
    assert_int_equal(run.model.rigid_body_count, 2);
    const RigidBody *bar = &run.model.rigid_bodies[0], *odd = &run.model.rigid_bodies[1];
    verify_close("mass of the bar", bar->mass, 9, 1e-14);
    near3("its centre", bar->centre, 1.5, 0.5, 0.5);
    verify_close("wedge and tetrahedron", odd->mass, 3 * (0.5 + 1.0 / 6), 1e-14);
    /* 3/4 of the wedge's centroid (1/3, 1/3, 5.5), 1/4 of the tetrahedron's (1/2, 1/4, 5.25) */
    near3("their centre", odd->centre, 0.375, 0.3125, 5.4375);
    int faces[4] = {0};
    for (int e = 0; e < run.model.element_count; e++) faces[run.model.parts[run.model.element_part[e]].id]++;
    assert_int_equal(faces[1], 1);
    assert_int_equal(faces[2], 14);
    double volume = 0; /* of the bar by its outward faces */
    for (int e = 0; e < run.model.element_count; e++) {
        const int32_t *c = run.model.element_node + 4 * (ptrdiff_t)e;
        const double *p[4];
        if (run.model.parts[run.model.element_part[e]].id != 2) continue;
        for (int a = 0; a < 4; a++) p[a] = run.model.initial + 3 * (ptrdiff_t)c[a];
        for (int half = 0; half < 2; half++) {
            const double *a = p[0], *b = p[1 + half], *d = p[2 + half];
            volume += (a[0] * (b[1] * d[2] - b[2] * d[1]) + a[1] * (b[2] * d[0] - b[0] * d[2]) +
                       a[2] * (b[0] * d[1] - b[1] * d[0])) /
                      6;
        }
    }
    verify_close("volume within the faces", volume, 3, 1e-12);
    verify_free(&run);
}

/* Two bars joined, with the square hung on: one body, its centre falls like a stone, its spin stays. */
static void joined_parts_move_as_one(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    wall_add_square(&scene, -2, 0, 0); /* mass 4, centre (-1.5, 0.5, 0) */
    add_bar(&scene, 1, 2, 2, 0, 0, 0); /* mass 6, centre (1, 0.5, 0.5) */
    add_bar(&scene, 5, 3, 1, 4, 0, 0); /* mass 3, centre (4.5, 0.5, 0.5) */
    scene_print(&scene.deck,
                "*CONSTRAINED_RIGID_BODIES\n2,3\n*CONSTRAINED_EXTRA_NODES_SET\n3,7\n*SET_NODE_LIST\n7\n1,2,3,4\n"
                "*INITIAL_VELOCITY_RIGID_BODY\n2,1,0,0,0,0,2\n");
    wall_write_gravity(&scene.deck, 10);
    verify_scene_build(&run, &scene, 0);
    assert_int_equal(run.model.rigid_body_count, 1);
    const RigidBody *body = &run.model.rigid_bodies[0];
    assert_int_equal(body->part_id, 2);
    verify_close("mass", body->mass, 13, 1e-14);
    double cx = (4 * -1.5 + 6 * 1 + 3 * 4.5) / 13, cz = 9 * 0.5 / 13;
    near3("centre", body->centre, cx, 0.5, cz);
    assert_int_equal(verify_loop(&run), 0);
    verify_near("x of the centre", run.state.rigid[0].output.x[0], cx + 1, 1e-9);
    verify_close("fall of the centre", cz - run.state.rigid[0].output.x[2], 5, 1e-3);
    double span[3]; /* rigid: node 1 and the last one keep their distance */
    for (int k = 0; k < 3; k++) span[k] = run.x[k] - run.x[3 * (run.model.node_count - 1) + k];
    verify_close("distance", sqrt(span[0] * span[0] + span[1] * span[1] + span[2] * span[2]), sqrt(49 + 1), 1e-12);
    verify_near("balance", wall_imbalance(&run), 0, 1e-4);
    verify_free(&run);
}

/* A node set as a body: four masses of a square spin about their centre. */
static void node_sets_become_bodies(void **state)
{
    (void)state;
    for (int held = 0; held < 2; held++) {
        Scene scene = {0};
        VerifyRun run;
        begin(&scene, 0.5);
        wall_add_square(&scene, 0, 0, 0);
        scene_print(&scene.deck, "*CONSTRAINED_NODAL_RIGID_BODY%s\n9,0,7\n%s*SET_NODE_LIST\n7\n1,2,3,4\n",
                    held ? "_SPC" : "", held ? "1,7,4\n" : "");
        scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n9,3,0,0,0,0,2\n");
        verify_scene_build(&run, &scene, 0);
        const RigidBody *body = &run.model.rigid_bodies[0];
        assert_true(body->nodal && body->part_id == 9);
        verify_close("mass", body->mass, 4, 1e-14);
        assert_int_equal(verify_loop(&run), 0);
        double turn = 1, cx = 0.5 + (held ? 0 : 1.5); /* spin 2 over 0.5 */
        near3("corner", run.x, cx - 0.5 * (cos(turn) - sin(turn)), 0.5 - 0.5 * (cos(turn) + sin(turn)), 0);
        verify_near("balance", wall_imbalance(&run), 0, 1e-12);
        verify_free(&run);
    }
}

/* Mass, centre, tensor in turned axes and motion of a card. */
static void inertia_is_given_by_a_card(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    SceneText *deck = &scene.deck;
    wall_begin(&scene, 1);
    scene_write_rigid(deck, 2, 3, 0, 0);
    scene_print(
        deck,
        "*SECTION_SOLID\n2\n*PART_INERTIA\nbox\n2,2,2\n.5,.5,.25,20,1\n3,0,0,4,0,5\n1,2,3,0,0,.5\n0,1,0,-1,0,0\n");
    wall_add_square(&scene, 9, 9, 9);
    add_bar(&scene, 1, 2, 1, 0, 0, 0);
    wall_write_gravity(deck, 10);
    verify_scene_build(&run, &scene, 0);
    const RigidBody *body = &run.model.rigid_bodies[0];
    verify_close("mass", body->mass, 20, 1e-15);
    near3("centre", body->centre, 0.5, 0.5, 0.25);
    /* local x is y: Iyy = 3, Ixx = 4 */
    for (int i = 0; i < 3; i++) {
        const double *axis = body->axes + 3 * (ptrdiff_t)i;
        double moment = fabs(axis[0]) > 0.9 ? 4 : fabs(axis[1]) > 0.9 ? 3 : 5;
        verify_close("principal moment", body->inertia[i], moment, 1e-14);
    }
    verify_close("kinetic energy at the start", run.state.energy->kinetic, 0.5 * (20 * 14 + 5 * 0.25), 1e-12);
    assert_int_equal(verify_loop(&run), 0);
    near3("velocity at the end", run.state.rigid[0].output.v, 1, 2, -7);
    near3("spin", run.state.rigid[0].output.spin, 0, 0, 0.5);
    verify_near("balance", wall_imbalance(&run), 0, 1e-4);
    verify_free(&run);
}

static void expect(const VerifyRun *run, const char *text)
{
    if (!verify_message(&run->diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run->diagnostics, SEVERITY_NOTE, stderr);
        fail_msg("no error with '%s'", text);
    }
}

static void bad_bodies_are_told_together(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    SceneText *deck = &scene.deck;
    begin(&scene, 1);
    wall_add_square(&scene, -2, 0, 0);
    add_bar(&scene, 1, 2, 2, 0, 0, 0);
    add_bar(&scene, 5, 3, 1, 4, 0, 0);
    scene_print(deck,
                "*CONSTRAINED_RIGID_BODIES\n2,1\n8,3\n*CONSTRAINED_EXTRA_NODES_NODE\n3,5\n1,6\n2,99\n"
                "*CONSTRAINED_NODAL_RIGID_BODY\n9,0,77\n*CONSTRAINED_NODAL_RIGID_BODY\n2,0,7\n*SET_NODE_LIST\n7\n1\n");
    verify_scene_build(&run, &scene, 7);
    expect(&run, "PIDC = 1 is no rigid part");
    expect(&run, "PIDL = 8: there is no part");
    expect(&run, "rigid bodies 2 and 3 share node 5");
    expect(&run, "PID = 1 is no rigid part");
    expect(&run, "NID = 99: there is no node");
    expect(&run, "77");
    expect(&run, "PID = 2 is the number of a *PART as well");
    verify_free(&run);
    scene = (Scene){0};
    begin(&scene, 1);
    wall_add_square(&scene, -2, 0, 0);
    scene_print(deck, "*ELEMENT_SOLID\n1,1,1,2,3,4,1,2,3,4\n2,5,1,2,3,4\n3,2,1,2,3,4,1,2,3,99\n4,2,1,2,3,4,4,4,4,4\n");
    verify_scene_build(&run, &scene, 4);
    expect(&run, "solid 1 is of part 1, which is not rigid");
    expect(&run, "PID = 5");
    expect(&run, "N8 = 99");
    expect(&run, "solid 4 has the volume");
    verify_free(&run);
}

/* Inertia that fits neither a body nor the fabric on its nodes is warned of with the card's line. */
static void doubtful_inertia_is_told(void **state)
{
    (void)state;
    static const struct {
        const char *numbers, *warning; /* TM, then the moments */
    } cases[] = {{"4\n2,0,0,2,0,2", NULL},
                 {"3\n2,0,0,2,0,2", "TM = 3 of rigid body 9 is less than the 4"},
                 {"4\n1,0,0,1,0,1", "the moment of inertia 1 of rigid body 9 about"},
                 {"4\n0,0,0,0,0,0", "does not turn about axes without inertia"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Scene scene = {0};
        VerifyRun run;
        begin(&scene, 0.5);
        wall_add_square(&scene, 0, 0, 0); /* masses of 1 at its corners: moments 1, 1 and 2 */
        scene_print(&scene.deck,
                    "*SET_NODE_LIST\n7\n1,2,3,4\n*CONSTRAINED_NODAL_RIGID_BODY_INERTIA\n9,0,7\n.5,.5,0,%s\n0\n",
                    cases[i].numbers);
        verify_scene_build(&run, &scene, 0);
        if (cases[i].warning) assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, cases[i].warning));
        assert_int_equal(run.diagnostics.warnings, cases[i].warning != NULL);
        verify_free(&run);
    }
}

/* Who decides with what a body of *PART_INERTIA starts: its card, unless IRIGID or a card of its own says otherwise. */
static void inertia_cards_decide_the_start(void **state)
{
    (void)state;
    static const struct {
        const char *cards;
        double v, spin;
        int warnings;
    } cases[] = {
        {"*INITIAL_VELOCITY\n0\n5,0,0\n", 1, 0.5, 1},
        {"*INITIAL_VELOCITY\n0,0,0,-1\n5,0,0,0,0,2\n", 5, 2, 0},
        {"*INITIAL_VELOCITY\n0,0,0,7\n5,0,0,0,0,2\n*SET_PART_LIST\n7\n2\n", 5, 2, 0},
        {"*INITIAL_VELOCITY\n0,0,0,7\n5,0,0\n*SET_PART_LIST\n7\n1\n", 1, 0.5, 1},
        {"*INITIAL_VELOCITY\n0,0,3,-1\n5,0,0\n*DEFINE_BOX\n3,7,8,0,1,0,1\n", 1, 0.5, 0},
        {"*INITIAL_VELOCITY\n0,0,3,-2\n5,0,0,0,0,2\n*DEFINE_BOX\n3,7,8,0,1,0,1\n", 5, 2, 0},
        {"*INITIAL_VELOCITY_GENERATION\n2,2,0,5\n\n", 1, 0.5, 1},
        {"*INITIAL_VELOCITY_GENERATION\n2,2,0,5\n0,0,0,0,0,0,0,1\n", 5, 0, 0},
        {"*INITIAL_VELOCITY_RIGID_BODY\n2,6,0,0,0,0,3\n", 6, 3, 0},
        {"", 1, 0.5, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Scene scene = {0};
        VerifyRun run;
        wall_begin(&scene, 1);
        scene_write_rigid(&scene.deck, 2, 3, 0, 0);
        scene_print(&scene.deck,
                    "*SECTION_SOLID\n2\n*PART_INERTIA\nbox\n2,2,2\n.5,.5,.25,20\n3,0,0,4,0,5\n1,0,0,0,0,.5\n%s",
                    cases[i].cards);
        wall_add_square(&scene, 9, 9, 9);
        add_bar(&scene, 1, 2, 1, 0, 0, 0);
        verify_scene_build(&run, &scene, 0);
        near3("velocity", run.state.rigid[0].v, cases[i].v, 0, 0);
        near3("spin", run.state.rigid[0].spin, 0, 0, cases[i].spin);
        assert_int_equal(verify_message(&run.diagnostics, SEVERITY_WARNING, "of its INERTIA card"), cases[i].warnings);
        verify_free(&run);
    }
}

/* A nodal rigid body is no part: the message says what it is. */
static void nodal_bodies_are_not_joined(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    wall_add_square(&scene, -2, 0, 0);
    add_bar(&scene, 1, 2, 1, 0, 0, 0);
    scene_print(&scene.deck, "*SET_NODE_LIST\n7\n1,2\n*CONSTRAINED_NODAL_RIGID_BODY\n9,0,7\n"
                             "*CONSTRAINED_RIGID_BODIES\n2,9\n");
    verify_scene_build(&run, &scene, 1);
    expect(&run, "PIDC = 9 is a nodal rigid body");
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_have_mass_and_faces),   cmocka_unit_test(joined_parts_move_as_one),
        cmocka_unit_test(node_sets_become_bodies),      cmocka_unit_test(inertia_is_given_by_a_card),
        cmocka_unit_test(bad_bodies_are_told_together), cmocka_unit_test(doubtful_inertia_is_told),
        cmocka_unit_test(nodal_bodies_are_not_joined),  cmocka_unit_test(inertia_cards_decide_the_start),
    };
    return cmocka_run_group_tests_name("cards of rigid bodies", tests, NULL, NULL);
}
