/* Jets on bags: nodal forces and reaction (B15), line of sight around a corner, KNKDN, PSID, moving foci, energy, the
 * same bits for any number of threads and after a restart. */
#include "tests/jet_case.h"

#include <stdio.h>

/* 60 x 60 quads of 6 mm where alpha z = 0.06. */
static void b15_forces_on_a_plane(void **state)
{
    (void)state;
    VerifyRun run;
    double force[3];
    run_duct(&run, force, "_JETTING_CM", "0.18,0.18,0.05,0.18,0.18,1.,0.2,1.\n0,0,0,0,0,0,0,0\n0\n", "", 60);
    assert_false(verify_message(&run.diagnostics, SEVERITY_WARNING, "lies outside the bag"));
    verify_close("B15 force on the roof [N]", force[2], OUTLET, 0.01);
    verify_near("across", hypot(force[0], force[1]), 0, 1e-9 * OUTLET);
    verify_close("abstat's reaction", run.state.gas[0].reaction, force[2], 1e-12);
    verify_free(&run);
    run_duct(&run, force, "_JETTING", "0.18,0.18,0.05,0.18,0.18,1.,0.2,0.5\n0,0,0,0,0,0,0,0\n", "", 60);
    verify_close("without CM, BETA = 0.5 [N]", force[2], 0.5 / (2 * 1.2 * 3.14159265 * 0.06 * 0.06), 0.01);
    verify_free(&run);
}

/* The wedge's force does not depend on the distance of its foci; nodes place a jet as coordinates do. */
static void wedges_and_nodes(void **state)
{
    (void)state;
    VerifyRun run;
    double force[3], nodes[3];
    run_duct(&run, force, "_JETTING_CM", "0.13,0.18,0.05,0.13,0.18,1.,0.15,1.\n0.23,0.18,0.05,0,0,0,0,0\n0\n", "", 60);
    verify_close("wedge [N]", force[2], OUTLET, 0.01);
    verify_free(&run);
    run_duct(&run, nodes, "_JETTING_CM", "9.,9.,9.,9.,9.,9.,0.15,1.\n0,0,0,0,0,90001,90002,90003\n0\n",
             "*NODE\n90001,0.13,0.18,0.05\n90002,0.13,0.18,1.\n90003,0.23,0.18,0.05\n", 60);
    verify_close("by nodes", nodes[2], force[2], 1e-12);
    verify_free(&run);
    run_duct(&run, nodes, "_JETTING_CM", "0.13,0.18,0.05,0.13,0.18,1.,0.15,1.\n0.23,0.18,0.05,7,0,0,0,0\n0\n",
             "*SET_PART_LIST\n7\n3\n", 12);
    assert_true(nodes[2] == 0 && force[2] > 0); /* PSID: the sides only */
    verify_free(&run);
    run_duct(&run, nodes, "_MULTIPLE_JETTING_CM", "0.18,0.18,0.175,0.18,0.18,1.,5,1.\n0,0,0,0,90.,0,0,0\n0\n",
             "*DEFINE_CURVE\n5\n0.,1.\n180.,1.\n", 20);
    verify_between("half a sphere of jets pushes up [N]", nodes[2], 0.3 * OUTLET, 0.8 * OUTLET);
    double cut[3];
    verify_free(&run);
    run_duct(&run, cut, "_MULTIPLE_JETTING_CM", "0.18,0.18,0.175,0.18,0.18,1.,5,1.\n0,0,0,0,20.,0,0,0\n0\n",
             "*DEFINE_CURVE\n5\n0.,1.\n180.,1.\n", 90);
    const double cosine = cos(20 / 57.29577951);
    verify_close("ANGLE narrows the jet [N]", cut[2], OUTLET * log(1 / cosine) / (1 - cosine), 0.02);
    verify_free(&run);
}

/* NREACT: a plate of its own, free to move, gets minus the force. */
static void reaction_moves_the_column(void **state)
{
    (void)state;
    VerifyRun run;
    double force[3];
    Scene scene = {0};
    add_duct(&scene.mesh, (const double[3]){0.36, 0.36, 0.35}, (const int[3]){12, 12, 4});
    int first = scene_add_node(&scene.mesh, 1, 0, 0);
    scene_add_node(&scene.mesh, 2, 0, 0);
    scene_add_node(&scene.mesh, 2, 1, 0);
    scene_add_node(&scene.mesh, 1, 1, 0);
    scene_add_shell(&scene.mesh, 4, first, first + 1, first + 2, first + 3);
    write_rigid_parts(&scene.deck, 1e-3);
    scene_write_part(&scene.deck, 4, 1, 4, "column");
    scene_write_rigid(&scene.deck, 4, 5000, 0, 7); /* 5 kg */
    char cards[200];
    snprintf(cards, sizeof cards, "0.18,0.18,0.05,0.18,0.18,1.,0.2,1.\n0,0,0,0,0,0,0,0\n%d\n", first + 1);
    write_bag(&scene.deck, "_JETTING_CM", "0", cards);
    scene_end(&scene.deck, &scene.mesh);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = first, .probe = keep_state, .user = force});
    const VerifySample *last = &run.samples[run.count - 1];
    verify_close("acceleration of the column", last->a[2], -force[2] / 5, 1e-12);
    verify_close("its speed", last->v[2], -force[2] / 5 * last->time, 0.02); /* no flow in the first step */
    verify_balance(&run, 1e-6); /* 1/2 n^-2 of n steps: the force jumps at the start */
    verify_free(&run);
}

/* An L-shaped duct: the outer corner hides the far leg. Facets see the focus where the plane section says so. */
static void corner_hides_the_far_leg(void **state)
{
    (void)state;
    static const double corner[6][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}; /* z over x */
    Scene scene = {0};
    const int n = 10;
    for (int i = 0; i < 6; i++) { /* sides, along y */
        const double *p = corner[i], *q = corner[(i + 1) % 6];
        Wall wall = {{p[0], 0, p[1]}, {0, 1, 0}, {q[0] - p[0], 0, q[1] - p[1]}};
        scene_add_grid(&scene.mesh,
                       i < 3   ? 1
                       : i < 5 ? 2
                               : 3,
                       SCENE_QUADS, n, i < 3 && i != 2 ? 2 * n : n, map_wall, &wall);
    }
    const Wall ends[6] = {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                          {{1, 0, 1}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                          {{1, 1, 0}, {0, 0, 1}, {1, 0, 0}}, {{1, 1, 1}, {0, 0, 1}, {1, 0, 0}}};
    for (int i = 0; i < 6; i++) scene_add_grid(&scene.mesh, 3, SCENE_QUADS, n, n, map_wall, &ends[i]);
    scene_weld(&scene.mesh, 0, 1e-7);
    write_rigid_parts(&scene.deck, 1e-3);
    write_bag(&scene.deck, "_JETTING_CM", "9", "0.05,0.5,0.5,3.,0.5,0.5,1.5,1.\n0,0,0,0,0,0,0,0\n0\n");
    scene_write_curve(&scene.deck, 9, 2, (const double[]){0, 0.25, 1, 0.25});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    double force[3];
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = keep_state, .user = force});
    const Jet *jet = &run.model.jets[0];
    int hidden = 0, wrong = 0;
    for (int f = 0; f < jet->facet_count; f++) {
        double middle[3] = {0};
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 3; k++) middle[k] += 0.25 * run.state.x[3 * jet->node[4 * f + c] + k];
        /* from (0.05, 0.5) in the plane y: past the corner (1, 1) the line rises by 0.5/0.95 a unit */
        bool leg = middle[2] > 1 + 1e-9 && middle[0] > 1 - 1e-9;
        bool sees = !leg || middle[2] < 0.5 + (middle[0] - 0.05) * (0.5 / 0.95);
        if (middle[0] < 1e-9 || (middle[2] > 1 && middle[0] < 1 + 1e-9)) sees = middle[0] < 1e-9;
        hidden += !sees;
        wrong += (run.state.jet_shape[f] >= 0) != sees;
    }
    assert_in_range(hidden, 100, 800);
    assert_int_equal(wrong, 0);
    verify_free(&run);
}

/* KNKDN scales the bag's pressure on hidden facets: here all of them, the focus being outside. */
static void knock_down(void **state)
{
    (void)state;
    Scene scene = {0};
    verify_begin_box(&scene, (const double[3]){0.2, 0.3, 1}, 1, 4, 2e-3);
    write_bag(&scene.deck, "_JETTING", "9", "0.1,0.15,-5.,0.1,0.15,0.,0.1,1.\n0,0,0,0,0,0,0,0\n");
    scene_write_curve(&scene.deck, 9, 2, (const double[]){0, 0.25, 1, 0.25});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    assert_true(scene_ok(&scene));
    int status = verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){.every = 1, .node = 4});
    if (status) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(status, 0);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "lies outside the bag"));
    assert_int_equal(verify_loop(&run), 0);
    const VerifySample *last = &run.samples[run.count - 1];
    verify_close("acceleration of the lid", last->a[2], 0.25 * 0.06 * (last->pressure - 101325), 1e-9);
    verify_free(&run);
    scene_free(&scene);
}

/* A cushion blown up by its jet, with a reaction on the node react. */
static void write_cushion(Scene *scene, double end, const char *react)
{
    const double radius = 0.2;
    scene_add_disc(&scene->mesh, 1, SCENE_DIAGONAL, 10, radius);
    scene_sew_copy(&scene->mesh, 2, scene_select_radius, &radius);
    for (int n = 0; n < scene->mesh.node_count; n++) { /* a little open */
        double *x = scene->mesh.x + 3 * n, r2 = x[0] * x[0] + x[1] * x[1];
        bool lower = false;
        for (int e = 0; e < scene->mesh.shell_count && !lower; e++)
            for (int c = 0; c < 4; c++) lower |= scene->mesh.part[e] == 2 && scene->mesh.shell[e][c] == n;
        x[2] = (lower ? -1 : 1) * 0.1 * fmax(0, 1 - r2 / (radius * radius));
    }
    SceneText *deck = &scene->deck;
    scene_begin(deck, "jet on a cushion", end, 0.9);
    SceneFabric fabric = scene_isotropic(0, true, 800, 2e8, 0.3);
    fabric.damp = 0.05;
    scene_write_part(deck, 1, 1, 1, "top");
    scene_write_part(deck, 2, 1, 1, "bottom");
    scene_write_section(deck, 1, 9, 3.5e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    char cards[120];
    snprintf(cards, sizeof cards, "0.,0.,-0.05,0.,0.,1.,0.3,1.\n0,0,0,0,0,0,0,0\n%s\n", react);
    write_bag(deck, "_JETTING_CM", "0", cards);
    scene_end(deck, &scene->mesh);
}

static uint64_t hash_of_cushion(int threads, int64_t stop, bool restart)
{
    Scene scene = {0};
    write_cushion(&scene, 4e-3, "0");
    VerifyRun run;
    assert_true(scene_ok(&scene));
    int status = verify_build(&run, scene.deck.text, scene.deck.length,
                              &(VerifyOptions){.threads = threads, .stop = restart ? stop / 2 : stop});
    if (status) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(status, 0);
    assert_int_equal(verify_loop(&run), 0);
    if (restart) { /* only the State goes on */
        run.options.stop = stop;
        assert_int_equal(verify_loop(&run), 0);
    }
    assert_true(run.state.jet[0].force[2] > 100);
    uint64_t hash = state_hash(&run.state);
    verify_free(&run);
    scene_free(&scene);
    return hash;
}

static void same_bits(void **state)
{
    (void)state;
    uint64_t one = hash_of_cushion(1, 301, false);
    assert_true(hash_of_cushion(2, 301, false) == one);
    assert_true(hash_of_cushion(3, 301, false) == one);
    assert_true(hash_of_cushion(2, 301, true) == hash_of_cushion(1, 301, true));
}

/* The jet's work is in the ledger. */
static void energy_balances(void **state)
{
    (void)state;
    Scene scene = {0};
    write_cushion(&scene, 4e-3, "5");
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    print_message("    %ld cycles, energy %g J, largest imbalance %g\n", (long)run.cycles, run.energy, run.imbalance);
    verify_balance(&run, 0.01);
    verify_free(&run);
}

static void assert_refused(const char *options, const char *cards, const char *text)
{
    Scene scene = {0};
    add_duct(&scene.mesh, (const double[3]){1, 1, 1}, (const int[3]){2, 2, 2});
    write_rigid_parts(&scene.deck, 1e-3);
    write_bag(&scene.deck, options, "0", cards);
    scene_print(&scene.deck, "*SET_PART_LIST\n7\n4\n*PART\nother\n4,1,1\n");
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
    if (!verify_message(&run.diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
        fail_msg("no message with '%s'", text);
    }
    verify_free(&run);
    scene_free(&scene);
}

static void mistakes_are_explained(void **state)
{
    (void)state;
    assert_refused("_JETTING", "0.5,0.5,0.5,0.5,0.5,0.5,0.2,1.\n0,0,0,0,0,0,0,0\n", "no direction");
    assert_refused("_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,0.,1.\n0,0,0,0,0,0,0,0\n", "CA is 0");
    assert_refused("_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,-8.,1.\n0,0,0,0,0,0,0,0\n", "CA = 8");
    assert_refused("_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,.2,-8.\n0,0,0,0,0,0,0,0\n", "BETA = 8");
    assert_refused("_JETTING", "0,0,0,0,0,0,.2,1.\n0,0,0,0,0,77777,2,0\n", "NODE1 = 77777");
    assert_refused("_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,.2,1.\n0,0,0,7,0,0,0,0\n", "no part of PSID");
    assert_refused("_JETTING_CM", "0.5,0.5,0.5,0.5,0.5,1.,.2,1.\n0,0,0,0,0,0,0,0\n77777\n", "NREACT = 77777");
    assert_refused("_MULTIPLE_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,0,1.\n0,0,0,0,0,0,0,0\n", "LCJRV is 0");
    assert_refused("_MULTIPLE_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,8,1.\n0,0,0,0,0,0,0,0\n", "LCJRV = 8");
    assert_refused("_JETTING_MULTIPLE_JETTING", "0.5,0.5,0.5,0.5,0.5,1.,1,1.\n0,0,0,0,0,0,0,0\n", "exclude each other");
    assert_refused("_CM", "", "CM belongs to JETTING");
    assert_refused("_JETTING", "", "card 9a is missing");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(b15_forces_on_a_plane),
        cmocka_unit_test(wedges_and_nodes),
        cmocka_unit_test(reaction_moves_the_column),
        cmocka_unit_test(corner_hides_the_far_leg),
        cmocka_unit_test(knock_down),
        cmocka_unit_test(same_bits),
        cmocka_unit_test(energy_balances),
        cmocka_unit_test(mistakes_are_explained),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
