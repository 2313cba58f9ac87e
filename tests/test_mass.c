/* *ELEMENT_MASS on nodes and over parts: motion against closed forms, sums, bodies, gravity by part, and its cards. */
#include "tests/wall_case.h"

#include <string.h>

/* Null shells of part 1 with nodes of mass 1 (tests/wall_case.h) far away; parts 5 springs of K = 50, 6 a curve of 1.
 * The loose nodes 5 and 6 are at (0, 0, 0) and (1, 0, 0). */
static void begin(Scene *scene, double end_time)
{
    SceneText *deck = &scene->deck;
    wall_begin(scene, end_time);
    scene_write_part(deck, 5, 5, 5, "springs");
    scene_print(deck, "*SECTION_DISCRETE\n5,0\n0,0\n*MAT_SPRING_ELASTIC\n5,50\n*DEFINE_CURVE\n6\n0,1\n10,1\n");
    wall_add_square(scene, 9, 9, 9);
    scene_add_node(&scene->mesh, 0, 0, 0);
    scene_add_node(&scene->mesh, 1, 0, 0);
}

static void run_cards(VerifyRun *run, Scene *scene, const char *cards)
{
    scene_print(&scene->deck, "%s", cards);
    verify_scene_build(run, scene, 0);
    run->options.node = 5;
    if (verify_loop(run)) fail_msg("%s", run->failure.cause);
}

static double mass_of(const VerifyRun *run, int deck_node)
{
    return run->model.mass[run->model.deck_node[deck_node]];
}

/* A node without any element but a spring: x = 1 + sin(w t)/w, w^2 = K/m. */
static void masses_swing_on_springs(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    const double omega = sqrt(50 / 2.5);
    double worst = 0;
    begin(&scene, 1.5);
    run_cards(&run, &scene,
              "*CONTROL_TIMESTEP\n0.0005\n*ELEMENT_DISCRETE\n1,5,5,6\n*BOUNDARY_SPC_NODE\n5,0,1,1,1\n"
              "*ELEMENT_MASS\n7,6,2.5\n*INITIAL_VELOCITY_NODE\n6,1\n");
    for (size_t i = 0; i < run.count; i++)
        worst = fmax(worst, fabs(run.samples[i].x[0] - 1 - sin(omega * run.samples[i].time) / omega) * omega);
    verify_near("way of the mass", worst, 0, 1e-4);
    verify_near("way of the mass at its start", run.samples[0].kinetic, 1.25, 1e-12);
    verify_balance(&run, 1e-3);
    verify_free(&run);
}

/* A node without any element falls: under gravity, under damping, onto a wall, which takes its momentum. */
static void loose_masses_fall(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    run_cards(&run, &scene, "*CONTROL_TIMESTEP\n0.001\n*LOAD_BODY_Z\n6,10\n*ELEMENT_MASS\n7,6,2.5\n");
    verify_close("height", run.x[3 * 5 + 2], -5, 1e-2);
    verify_close("speed", run.v[3 * 5 + 2], -10, 1e-9);
    verify_close("energy", run.samples[run.count - 1].kinetic, 0.5 * (2.5 + 4) * 100, 1e-9);
    verify_near("balance", wall_imbalance(&run), 0, 1e-9);
    verify_near("the other node", run.x[3 * 4 + 2], 0, 0);
    verify_free(&run);
    scene = (Scene){0};
    begin(&scene, 1);
    run_cards(&run, &scene, "*DAMPING_GLOBAL\n0,2\n*ELEMENT_MASS\n7,6,2.5\n*INITIAL_VELOCITY_NODE\n6,3\n");
    verify_close("damped speed", run.v[3 * 5], 3 * exp(-2), 1e-4);
    verify_near("balance", wall_imbalance(&run), 0, 1e-3);
    verify_free(&run);
    scene = (Scene){0};
    WallRecord record = {0};
    begin(&scene, 1);
    wall_write_plane(&scene.deck, "", (const double[]){0, 0, -0.5}, (const double[]){0, 0, 1}, 0, 0);
    scene_print(&scene.deck, "*ELEMENT_MASS\n7,6,2.5\n*INITIAL_VELOCITY_NODE\n6,0,0,-2\n");
    wall_run(&run, &scene, &record, 1);
    verify_close("impulse of the wall", record.normal, 5, 1e-9);
    verify_near("place on the wall", run.x[3 * 5 + 2], -0.5, 1e-12);
    verify_free(&run);
}

static void expect(const char *cards, int errors, const char *const *texts, int count)
{
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    scene_print(&scene.deck, "%s", cards);
    verify_scene_build(&run, &scene, errors);
    for (int i = 0; i < count; i++)
        if (!verify_message(&run.diagnostics, SEVERITY_ERROR, texts[i])) {
            diagnostics_print(&run.diagnostics, SEVERITY_WARNING, stderr);
            fail_msg("no error with '%s'", texts[i]);
        }
    verify_free(&run);
}

/* The vector's load is that of its components on the axes, all masses feel it; in a local system its x is z. */
static void vectors_accelerate_all(void **state)
{
    (void)state;
    static const char *const loads[] = {"*LOAD_BODY_VECTOR\n6,10\n0,.6,-.8\n",
                                        "*LOAD_BODY_Y\n6,6\n*LOAD_BODY_Z\n6,-8\n",
                                        "*DEFINE_COORDINATE_VECTOR\n4,0,0,1,1,0,0\n*LOAD_BODY_VECTOR\n"
                                        "6,10,,,,,4\n-.8,0,.6\n"};
    for (int i = 0; i < 3; i++) {
        Scene scene = {0};
        VerifyRun run;
        begin(&scene, 1);
        scene_print(&scene.deck, "%s", loads[i]);
        run_cards(&run, &scene, "*ELEMENT_MASS\n7,6,2.5\n");
        for (int node = 0; node < 6; node += 5) {
            verify_near("speed x", run.v[3 * node], 0, 1e-12);
            verify_close("speed y", run.v[3 * node + 1], -6, 1e-9);
            verify_close("speed z", run.v[3 * node + 2], 8, 1e-9);
        }
        verify_free(&run);
    }
    static const char *const long_vector[] = {"V = (0, 3, 4) has the length 5"};
    expect("*LOAD_BODY_VECTOR\n6,10\n0,3,4\n", 1, long_vector, 1);
}

typedef struct Sums {
    double mass, momentum[3], part_momentum[3], kinetic;
} Sums;

static void add_up(void *user, const Model *m, const State *state, const StepView *view)
{
    Sums *sums = user;
    (void)state;
    *sums = (Sums){.kinetic = view->part_kinetic[0]};
    for (int n = 0; n < m->node_count; n++) {
        sums->mass += m->mass[n];
        for (int k = 0; k < 3; k++) sums->momentum[k] += m->mass[n] * view->v[3 * n + k];
    }
    memcpy(sums->part_momentum, view->part_momentum, sizeof sums->part_momentum);
}

/* A heavy node thrown across a free sheet takes it along: momentum stays, and so does the energy. With PID the part has
 * it in its sums, and any number of threads gives the same bits. */
static void masses_throw_membranes(void **state)
{
    (void)state;
    uint64_t hash = 0;
    for (int threads = 1; threads <= 4; threads++) {
        Scene scene = {0};
        VerifyRun run;
        Sums sums = {0};
        SceneText *deck = &scene.deck;
        scene_begin(deck, "sheet", 0.01, 0);
        scene_write_part(deck, 1, 1, 1, "sheet");
        scene_write_section(deck, 1, 9, 0.001);
        scene_write_elastic(deck, 1, 1000, 1e7, 0.3);
        scene_add_rectangle(&scene.mesh, 1, SCENE_QUADS, 8, 8, 1, 1);
        scene_print(deck, "*INITIAL_VELOCITY_NODE\n41,10,0,20\n*ELEMENT_MASS\n1,41,0.5,1\n");
        scene_end(deck, &scene.mesh);
        verify_scene(&run, &scene,
                     &(VerifyOptions){.every = 1, .threads = threads, .probe = add_up, .user = &sums, .node = 40});
        const double thrown = 0.5 + 1.0 / 64; /* with the sheet's own share */
        verify_close("mass", sums.mass, 1.5, 1e-12);
        verify_close("momentum x", sums.momentum[0], 10 * thrown, 1e-9);
        verify_close("momentum z", sums.momentum[2], 20 * thrown, 1e-9);
        verify_close("momentum of the part", sums.part_momentum[2], 20 * thrown, 1e-9);
        verify_close("energy of the part", sums.kinetic, run.samples[run.count - 1].kinetic, 1e-9);
        verify_close("energy at the start", run.samples[0].kinetic, 0.5 * thrown * 500, 1e-12);
        assert_true(run.v[3 * 40 + 2] < 19.9); /* the sheet has taken of it */
        verify_balance(&run, 1e-3);
        if (threads == 1) hash = state_hash(&run.state);
        assert_int_equal(state_hash(&run.state), hash);
        verify_free(&run);
    }
}

/* A cube of side 1 and mass 3 at the origin with a mass of 3 at a corner, which its card counts for the body, or with
 * *PART_INERTIA does not. */
static void masses_count_for_bodies(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) { /* a part, with a card of its inertia, a nodal rigid body, spread over it */
        Scene scene = {0};
        VerifyRun run;
        SceneText *deck = &scene.deck;
        begin(&scene, 1);
        int node[8];
        for (int c = 0; c < 8; c++) node[c] = 1 + scene_add_node(&scene.mesh, ((c + 1) / 2 % 2), c / 2 % 2, 5 + c / 4);
        if (kind == 2) {
            scene_print(deck, "*SET_NODE_LIST\n3\n%d,%d\n*CONSTRAINED_NODAL_RIGID_BODY\n30,,3\n", node[0], node[1]);
            scene_print(deck, "*ELEMENT_MASS\n1,%d,1\n2,%d,3\n", node[0], node[1]);
        } else {
            scene_print(deck, "*MAT_RIGID\n2,3\n1,0,0\n\n*SECTION_SOLID\n2\n");
            scene_print(deck, kind != 1 ? "*PART\ncube\n2,2,2\n" : "*PART_INERTIA\ncube\n2,2,2\n");
            if (kind == 1) scene_print(deck, ".5,.5,5.5,3\n1,0,0,1,0,1\n0,0,0\n");
            scene_print(deck, "*ELEMENT_SOLID\n2,2,%d,%d,%d,%d,%d,%d,%d,%d\n", node[0], node[1], node[2], node[3],
                        node[4], node[5], node[6], node[7]);
            if (kind == 3) scene_print(deck, "*ELEMENT_MASS_PART\n2,3\n");
            if (kind < 3) scene_print(deck, "*ELEMENT_MASS\n1,%d,3\n", node[0]);
        }
        scene_print(deck, "*CONTROL_TIMESTEP\n0.001\n*LOAD_BODY_Z\n6,10\n*LOAD_RIGID_BODY\n%d,1,6,12\n",
                    kind == 2 ? 30 : 2);
        verify_scene_build(&run, &scene, 0);
        assert_int_equal(verify_loop(&run), 0);
        const RigidBody *body = &run.model.rigid_bodies[0];
        static const double masses[] = {6, 3, 4, 6}, centres[] = {0.25, 0.5, 0.75, 0.5};
        const double mass = masses[kind];
        verify_close("mass of the body", body->mass, mass, 1e-12);
        verify_close("centre", body->centre[0], centres[kind], 1e-12);
        verify_close("speed by the force", run.state.rigid[0].output.v[0], 12 / mass, 1e-9);
        verify_close("speed by gravity", run.state.rigid[0].output.v[2], -10, 1e-9);
        verify_near("balance", wall_imbalance(&run), 0, 1e-3);
        if (kind < 2) verify_close("mass of the part", run.model.parts[2].point_mass + 3, mass, 1e-12);
        assert_int_equal(run.model.point_mass_count, kind == 2 ? 2 : kind == 0);
        assert_int_equal(verify_message(&run.diagnostics, SEVERITY_WARNING, "has no effect: rigid body 2"), kind == 1);
        verify_free(&run);
    }
}

/* *LOAD_GRAVITY_PART acts on the part's mass: (m_1 g + m_2 0)/(m_1 + m_2) where a mass of no part is at its node. */
static void gravity_of_parts_pulls_their_masses(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    run_cards(&run, &scene,
              "*CONTROL_TIMESTEP\n0.001\n*LOAD_GRAVITY_PART\n1,3,6,10\n"
              "*ELEMENT_MASS\n1,5,2\n2,6,2,1\n3,1,3\n4,2,3,1\n");
    verify_near("mass of no part", run.v[3 * 4 + 2], 0, 0);
    verify_close("mass of the part", run.v[3 * 5 + 2], -10, 1e-9);
    verify_close("node of the part with a mass of none", run.v[2], -10 * 1 / 4.0, 1e-9);
    verify_close("node of the part with a mass of it", run.v[3 + 2], -10, 1e-9);
    verify_free(&run);
}

/* The nodes of a set share the mass; parts by area, or by mass. */
static void masses_are_shared(void **state)
{
    (void)state;
    for (int by_mass = 0; by_mass < 2; by_mass++) {
        Scene scene = {0};
        VerifyRun run;
        SceneText *deck = &scene.deck;
        begin(&scene, 1e-3);
        scene_write_part(deck, 2, 1, 2, "heavy");
        scene_write_null(deck, 2, 12);
        int first = scene_add_node(&scene.mesh, 0, 5, 0);
        scene_add_node(&scene.mesh, 2, 5, 0);
        scene_add_node(&scene.mesh, 2, 6, 0);
        scene_add_node(&scene.mesh, 0, 6, 0);
        scene_add_shell(&scene.mesh, 2, first, first + 1, first + 2, first + 3);
        scene_print(deck, "*SET_NODE_LIST\n4\n5,6,1\n*ELEMENT_MASS_NODE_SET\n1,4,6\n*SET_PART_LIST\n8\n1,2\n");
        scene_print(deck, "*ELEMENT_MASS_PART_SET\n8,21,0,0,%d\n*ELEMENT_MASS_PART\n2,0,100\n", by_mass);
        verify_scene_build(&run, &scene, 0);
        const Model *m = &run.model;
        const double light = by_mass ? 3 : 7; /* of 21: 4 to 24 of mass, 1 to 2 of area */
        verify_close("loose node", mass_of(&run, 4), 2, 1e-12);
        verify_close("node of the light part and the set", mass_of(&run, 0), 1 + light / 4 + 2, 1e-12);
        verify_close("node of the light part", mass_of(&run, 1), 1 + light / 4, 1e-12);
        verify_close("node of the heavy part", mass_of(&run, first), 25, 1e-12);
        verify_close("light part", m->parts[0].mass, 4 + light, 1e-12);
        verify_close("heavy part", m->parts[2].mass, 100, 1e-12);
        verify_free(&run);
    }
}

/* Twice the mass by ADDMASS: nodes and elements have it, and the step is longer by the root of 2. */
static void added_mass_lengthens_the_step(void **state)
{
    (void)state;
    double step[2];
    for (int added = 0; added < 2; added++) {
        Scene scene = {0};
        VerifyRun run;
        SceneText *deck = &scene.deck;
        scene_begin(deck, "sheet", 1e-3, 0);
        scene_write_part(deck, 1, 1, 1, "sheet");
        scene_write_section(deck, 1, 9, 0.001);
        scene_write_elastic(deck, 1, 1000, 1e7, 0.3);
        scene_add_rectangle(&scene.mesh, 1, SCENE_QUADS, 4, 4, 1, 1);
        if (added) scene_print(deck, "*ELEMENT_MASS_PART\n1,1\n");
        scene_end(deck, &scene.mesh);
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        verify_close("middle node", mass_of(&run, 12), (1 + added) / 16.0, 1e-12);
        step[added] = run.samples[0].element_step;
        verify_free(&run);
    }
    verify_close("steps", step[1] / step[0], sqrt(2), 1e-9);
}

/* A loose mass bounces off a rigid plate: contact feels its mass and gives the speed back. */
static void masses_meet_surfaces(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    SceneText *deck = &scene.deck;
    begin(&scene, 0.2);
    scene_write_part(deck, 3, 1, 3, "plate");
    scene_write_rigid(deck, 3, 1, 7, 7);
    int first = scene_add_node(&scene.mesh, 0, -1, -2);
    scene_add_node(&scene.mesh, 2, -1, -2);
    scene_add_node(&scene.mesh, 2, 1, -2);
    scene_add_node(&scene.mesh, 0, 1, -2);
    scene_add_shell(&scene.mesh, 3, first, first + 1, first + 2, first + 3);
    run_cards(&run, &scene,
              "*SET_NODE_LIST\n4\n6\n*CONTROL_TIMESTEP\n0.0005\n*ELEMENT_MASS\n1,6,2.5\n"
              "*INITIAL_VELOCITY_NODE\n6,0,0,-10\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n4,3,4,3\n\n\n");
    assert_true(verify_smallest(&run, 0, offsetof(VerifySample, x) + 2 * sizeof(double)) > -2);
    verify_close("speed back", run.v[3 * 5 + 2], 10, 2e-2);
    verify_balance(&run, 2e-2);
    verify_free(&run);
}

static void bad_masses_are_told(void **state)
{
    (void)state;
    static const char *const read[] = {"MASS = -2 of mass element 2 is negative",
                                       "NID is 0",
                                       "ADDMASS = -1 must not be negative",
                                       "FINMASS = -1",
                                       "ADDMASS = 1 and FINMASS = 2 are both given",
                                       "neither ADDMASS nor FINMASS",
                                       "LCID",
                                       "MWD = 3 is none of 0"};
    static const char *const build[] = {"99",       "no set 98",
                                        "PID = 97", "part 5 has no shells and no solids of a density",
                                        "PID = 96", "FINMASS = 4 of part 1 is not more than the mass 4"};
    expect("*ELEMENT_MASS\n2,5,-2\n3,0,1\n*ELEMENT_MASS_PART\n1,-1\n1,0,-1\n1,1,2\n1\n1,1,0,6\n"
           "*SET_PART_LIST\n8\n1\n*ELEMENT_MASS_PART_SET\n8,1,0,0,3\n",
           8, read, 8);
    expect("*ELEMENT_MASS\n1,99,1\n2,5,1,97\n*ELEMENT_MASS_NODE_SET\n3,98,1\n"
           "*ELEMENT_MASS_PART\n5,1\n96,1\n1,0,4\n",
           6, build, 6);
}

static void no_mass_is_told(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin(&scene, 1);
    scene_print(&scene.deck, "*ELEMENT_MASS\n1,5\n");
    verify_scene_build(&run, &scene, 0);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "mass element 1 has no effect: its MASS is 0"));
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masses_swing_on_springs), cmocka_unit_test(loose_masses_fall),
        cmocka_unit_test(vectors_accelerate_all),  cmocka_unit_test(masses_throw_membranes),
        cmocka_unit_test(masses_count_for_bodies), cmocka_unit_test(gravity_of_parts_pulls_their_masses),
        cmocka_unit_test(masses_are_shared),       cmocka_unit_test(added_mass_lengthens_the_step),
        cmocka_unit_test(masses_meet_surfaces),    cmocka_unit_test(bad_masses_are_told),
        cmocka_unit_test(no_mass_is_told),
    };
    return cmocka_run_group_tests_name("masses", tests, NULL, NULL);
}
