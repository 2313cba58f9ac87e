/* Shells that erode leave contact: what flies passes where they were, new rims hold it, nodes without shells are met by
 * nothing; torn seams; threads, restart. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "contact/mesh_crossing.h"
#include "tests/contact_scene.h"

static const double thickness = 3e-4, cell = 0.02, speed = 10;

/* Parts 1 and 3 stay, part 2 erodes at a time; all of one fabric. */
static void begin(Scene *scene, double end, double erodes_at)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "erosion in contact", end, 0.5);
    for (int p = 1; p <= 3; p++) scene_write_part(deck, p, 1, p == 2 ? 2 : 1, "sheet");
    scene_write_section(deck, 1, 9, thickness);
    SceneFabric fabric = scene_isotropic(0, false, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_fabric(deck, 2, &fabric);
    scene_print(deck, "*MAT_ADD_EROSION\n2\n0,0,0,0,0,0,0,%.17g\n", erodes_at);
}

static bool in_strip(const void *user, const double x[3])
{
    (void)user;
    return x[0] > 4 * cell && x[0] < 8 * cell && x[2] < 1e-6;
}

/* A small sheet flies at a larger one, whose middle erodes. Returns the small one's first node. */
static int fly_through(VerifyRun *run, ScenePattern pattern, double erodes_at, const char *contact, const char *more,
                       const VerifyOptions *options)
{
    Scene scene = {0};
    SceneMesh *mesh = &scene.mesh;
    begin(&scene, 1e-3, erodes_at);
    scene_add_sheet(mesh, 1, pattern, 12, 6, 12 * cell, 6 * cell, 0, 0, 0);
    assert_true(scene_retag(mesh, 1, 2, in_strip, NULL) > 20);
    int first = scene_add_sheet(mesh, 3, pattern, 3, 5, 2 * cell, 3 * cell, 5 * cell, 1.4 * cell, 0.003);
    scene_write_speed(&scene.deck, first, mesh->node_count, 0, 0, -speed);
    scene_print(&scene.deck, "%s%s", contact, more);
    scene_end(&scene.deck, mesh);
    verify_scene(run, &scene, options);
    return first;
}

#define SINGLE "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n0,0,0,0,10\n\n"
#define BOTH_WAYS "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n3,1,3,6\n\n\n*SET_PART_LIST\n1\n3\n"
#define NODES "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,4,2\n\n\n*SET_NODE_GENERAL\n1\nPART,3\n*SET_PART_LIST\n2\n1,2\n"

static double momentum(const VerifyRun *run, int first, int axis)
{
    double sum = 0;
    for (int i = first; i < run->model.node_count; i++)
        sum += run->model.mass[run->model.deck_node[i]] * run->v[3 * i + axis];
    return sum;
}

static double mass_from(const VerifyRun *run, int first)
{
    double sum = 0;
    for (int i = first; i < run->model.node_count; i++) sum += run->model.mass[run->model.deck_node[i]];
    return sum;
}

/* The strip is gone before anything touches it: nothing is felt. */
static void what_is_gone_is_not_met(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_QUADS, SCENE_DIAGONAL};
    const char *contacts[] = {SINGLE, BOTH_WAYS, NODES};
    for (int i = 0; i < 6; i++) {
        VerifyRun run;
        int first = fly_through(&run, patterns[i % 2], 1e-4, contacts[i / 2], "", &(VerifyOptions){.every = 1});
        double slower = 0, moved = 0;
        for (int n = first; n < run.model.node_count; n++) slower = fmax(slower, fabs(run.v[3 * n + 2] + speed));
        for (int n = 0; n < 3 * first; n++) moved = fmax(moved, fabs(run.v[n]));
        verify_near("height", run.x[3 * first + 2], 0.003 - 1e-3 * speed, 1e-15);
        verify_near("speed lost", slower, 0, 1e-12);
        verify_near("speed of the rest", moved, 0, 1e-9);
        verify_near("contact energy", run.state.energy->contact, 0, 0);
        verify_free(&run);
    }
}

/* It goes while it is pushed: the small sheet keeps the speed that it has then, momentum and energy balance. */
static void what_goes_lets_go(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_QUADS, SCENE_DIAGONAL};
    for (int i = 0; i < 4; i++) {
        VerifyRun run, held;
        const char *contact = i < 2 ? SINGLE : BOTH_WAYS;
        int first = fly_through(&run, patterns[i % 2], 2.8e-4, contact, "", &(VerifyOptions){.every = 1});
        fly_through(&held, patterns[i % 2], 1, contact, "", &(VerifyOptions){.every = 1});
        double mass = mass_from(&run, first), mean = momentum(&run, first, 2) / mass;
        verify_between("speed left", -mean / speed, 0.05, 0.95);
        verify_between("without erosion", -momentum(&held, first, 2) / mass / speed, -2, 0.7);
        verify_near("momentum", (momentum(&run, 0, 2) + speed * mass) / (speed * mass), 0, 1e-12);
        verify_between("through", run.x[3 * first + 2], -1, 0);
        verify_between("energy of contact at the end", run.state.energy->contact / run.energy, 1e-4, 0.9);
        verify_balance(&run, 5e-3);
        verify_free(&held);
        verify_free(&run);
    }
}

/* Nodes whose shells are all gone are met as long as ENMASS = 2 asks for it. */
static void nodes_without_shells(void **state)
{
    (void)state;
    for (int stays = 0; stays < 2; stays++) {
        VerifyRun run;
        int first = fly_through(&run, SCENE_QUADS, 1e-4, BOTH_WAYS,
                                stays ? "*CONTROL_CONTACT\n0,0,0,0,0,0,0,2\n" : "*CONTROL_CONTACT\n0\n",
                                &(VerifyOptions){.every = 1});
        double felt = 0;
        for (int n = 0; n < first; n++) felt = fmax(felt, fabs(run.v[3 * n + 2]));
        verify_between("speed of nodes without shells", felt / speed, stays ? 0.1 : 0, stays ? 3 : 0);
        verify_near("momentum", momentum(&run, 0, 2) / (speed * mass_from(&run, first)), -1, 1e-12);
        verify_free(&run);
    }
}

static bool beside_ribbon(const void *user, const double x[3])
{
    (void)user;
    return fabs(x[0] - 2.5 * cell) > 0.5 * cell && x[2] < 1e-6;
}

/* All but a ribbon along y erodes; a blade's long lower edge falls across it. Flat inside a sheet, the sides of the
 * ribbon meet no edge; as rims they hold the blade. */
static void new_rims_meet_edges(void **state)
{
    (void)state;
    const double stand[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0}; /* x, y to x, z */
    for (int erodes = 0; erodes < 2; erodes++) {
        Scene scene = {0};
        SceneMesh *mesh = &scene.mesh;
        VerifyRun run;
        begin(&scene, 2e-3, erodes ? 1e-4 : 1);
        scene_add_sheet(mesh, 1, SCENE_QUADS, 5, 6, 5 * cell, 6 * cell, 0, 0, 0);
        assert_int_equal(scene_retag(mesh, 1, 2, beside_ribbon, NULL), 24);
        int first = mesh->node_count;
        scene_add_rectangle(mesh, 3, SCENE_QUADS, 1, 1, 4 * cell, cell);
        scene_transform(mesh, first, stand, (const double[3]){0.6 * cell, 3.3 * cell, 0.002});
        scene_write_speed(&scene.deck, first, mesh->node_count, 0, 0, -speed);
        scene_print(&scene.deck, SINGLE);
        scene_end(&scene.deck, mesh);
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        print_message("    blade at %g\n", run.x[3 * first + 2]);
        double loose = 0;
        for (int n = 0; n < first; n++)
            if (fabs(run.model.initial[3 * run.model.deck_node[n]] - 2.5 * cell) > 0.6 * cell)
                loose = fmax(loose, fabs(run.v[3 * n + 2]));
        if (erodes) verify_near("speed of nodes without shells", loose, 0, 0);
        if (erodes)
            verify_between("impulse on the blade", momentum(&run, first, 2) / mass_from(&run, first) / speed + 1, 0.2,
                           2);
        const VerifySample *last = &run.samples[run.count - 1];
        verify_near("energy balance at the end", (last->held - last->given) / run.energy, 0, 5e-3);
        verify_free(&run);
    }
}

/* Two panels on each other, sewn together at one end; the upper one falls on the lower one with the seam torn: they
 * hold each other apart. seam: 0 ties at one place that tear as the panels are stretched, 1 welds at a distance that
 * end. */
static void torn_panels(VerifyRun *run, ScenePattern pattern, int seam, const char *contact)
{
    Scene scene = {0};
    SceneMesh *mesh = &scene.mesh;
    begin(&scene, 3e-3, 1);
    scene_add_sheet(mesh, 1, pattern, 6, 4, 6 * cell, 4 * cell, 0, 0, 0);
    const int second = scene_add_sheet(mesh, 3, pattern, 6, 4, 6 * cell, 4 * cell, 0, 0, 0);
    for (int i = second; i < mesh->node_count; i++) mesh->x[3 * i + 2] = seam ? 0.001 : 0.05 * mesh->x[3 * i];
    scene_print(&scene.deck, "*INITIAL_VELOCITY_NODE\n");
    for (int i = 0; i < mesh->node_count; i++)
        SCENE_CARD(&scene.deck, i + 1, seam ? 0 : 300 * mesh->x[3 * i], 0,
                   i < second || mesh->x[3 * i] < 1e-9 ? 0 : -speed);
    if (seam) {
        scene_print(&scene.deck, "*CONSTRAINED_SPOTWELD\n");
        for (int i = 0; i < second; i++)
            if (mesh->x[3 * i] < 1e-9) SCENE_CARD(&scene.deck, i + 1, second + i + 1, 1e20, 1e20, 2, 2, 2e-4);
    } else {
        scene_print(&scene.deck, "*CONSTRAINED_TIED_NODES_FAILURE\n1,.005\n*SET_NODE_LIST\n1\n");
        for (int i = 0; i < mesh->node_count; i++)
            if (mesh->x[3 * i] < 1e-9) scene_print(&scene.deck, "%d\n", i + 1);
    }
    scene_print(&scene.deck, "%s", contact);
    scene_end(&scene.deck, mesh);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1});
}

/* Pairs of shells that go through each other, without those of two shells at the seam where its nodes lay at one place:
 * these have no side before they part. */
static int crossings_of_panels(const VerifyRun *run, bool at_one_place)
{
    unsigned char wanted[256];
    MeshCrossings crossings;
    assert_true(run->model.element_count <= 256);
    for (int i = 0; i < run->model.element_count; i++) {
        wanted[i] = 1;
        for (int k = 0; k < 4 && at_one_place; k++)
            if (run->model.initial[3 * run->model.element_node[4 * i + k]] < 0.5 * cell) wanted[i] = 0;
    }
    assert_int_equal(
        mesh_find_crossings(run->model.element_count, run->model.element_node, run->internal_x, wanted, &crossings), 0);
    return crossings.count;
}

static void torn_panels_hold_each_other(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_QUADS, SCENE_DIAGONAL};
    for (int i = 0; i < 4; i++) {
        VerifyRun run, through;
        const int seam = i / 2;
        torn_panels(&run, patterns[i % 2], seam, SINGLE);
        torn_panels(&through, patterns[i % 2], seam, "");
        const int second = run.model.node_count / 2;
        double least = INFINITY, met = INFINITY;
        for (int n = 0; n < second; n++) { /* rims may pass each other */
            if (run.model.initial[3 * run.model.deck_node[n]] < 1.5 * cell) continue;
            least = fmin(least, run.x[3 * (second + n) + 2] - run.x[3 * n + 2]);
            met = fmin(met, through.x[3 * (second + n) + 2] - through.x[3 * n + 2]);
        }
        for (int k = 0; k < run.model.ties.count; k++)
            verify_between("a place comes apart", run.state.tie_broken[k], 1e-6, 2e-3);
        for (int k = 0; k < run.model.seam_count; k++)
            verify_between("a weld ends", run.state.seam_torn[k], 2e-4, 2.2e-4);
        assert_int_equal(run.model.ties.count + run.model.seam_count, 5);
        verify_between("least gap without contact", met, -1, -0.005);
        verify_between("least gap", least, thickness, 1);
        verify_between("crossings", crossings_of_panels(&run, !seam), 0, 0);
        verify_near("momentum", momentum(&run, 0, 2) - momentum(&through, 0, 2), 0, 1e-9 * speed * mass_from(&run, 0));
        const VerifySample *last = &run.samples[run.count - 1];
        verify_near("energy balance at the end", (last->held - last->given) / run.energy, 0, 5e-3);
        verify_free(&through);
        verify_free(&run);
    }
}

static uint64_t run_in_pieces(int pieces, int threads)
{
    enum { CYCLES = 90 };
    VerifyRun run;
    VerifyOptions options = {.threads = threads, .stop = CYCLES / pieces};
    fly_through(&run, SCENE_QUADS, 2.8e-4, SINGLE, "", &options);
    for (int i = 2; i <= pieces; i++) {
        run.options.stop = CYCLES * i / pieces;
        if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
    }
    assert_int_equal(*run.state.eroded_count, 24);
    uint64_t hash = state_hash(&run.state);
    verify_free(&run);
    return hash;
}

static void same_bits(void **state)
{
    (void)state;
    uint64_t whole = run_in_pieces(1, 1);
    assert_true(run_in_pieces(1, 2) == whole);
    assert_true(run_in_pieces(1, 3) == whole);
    assert_true(run_in_pieces(3, 2) == whole);
    assert_true(run_in_pieces(30, 1) == whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_gone_is_not_met),     cmocka_unit_test(what_goes_lets_go),
        cmocka_unit_test(nodes_without_shells),        cmocka_unit_test(new_rims_meet_edges),
        cmocka_unit_test(torn_panels_hold_each_other), cmocka_unit_test(same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
