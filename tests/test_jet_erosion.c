/* Shells that have eroded neither hide others from a jet nor take its pressure. */
#include "tests/jet_case.h"

/* A box of fabric stands in the jet between its focus and the roof of the duct; the side of the box that faces the jet
 * erodes. The jet passes outwards through its other sides, as anything inside the bag. */
enum { FLOOR = 1, ROOF, SIDES, FACING, REST };

static const double torn_at = 5e-4;

typedef struct Forces {
    double before, after; /* on the roof along the jet [N] */
} Forces;

static void watch(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)model;
    (void)view;
    Forces *forces = user;
    if (state->clock->time < 0.9 * torn_at)
        forces->before = state->jet[0].force[2];
    else
        forces->after = state->jet[0].force[2];
}

static void add_box(SceneMesh *mesh)
{
    int first = mesh->node_count;
    scene_add_box(mesh, FACING, REST, REST, 0.1, 0.1, 0.05);
    scene_transform(mesh, first, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[3]){0.13, 0.13, 0.15});
}

static bool select_box(const void *user, const double x[3])
{
    (void)user;
    return x[0] > 0.12 && x[0] < 0.24 && x[1] > 0.12 && x[1] < 0.24 && x[2] > 0.14 && x[2] < 0.21;
}

static Forces run_duct_with_box(bool box, bool erodes)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    add_duct(&scene.mesh, (const double[3]){0.36, 0.36, 0.35}, (const int[3]){12, 12, 8});
    if (box) add_box(&scene.mesh);
    scene_begin(deck, "jet", 1.5e-3, 0.9);
    scene_write_section(deck, 1, 9, 1e-3);
    for (int p = FLOOR; p <= SIDES; p++) {
        scene_write_part(deck, p, 1, p, "wall");
        scene_write_rigid(deck, p, 1000, 7, 7);
    }
    SceneFabric fabric = scene_isotropic(2, false, 800, 3e8, 0.3);
    for (int p = FACING; p <= REST && box; p++) {
        scene_write_part(deck, p, 1, p, "box");
        scene_write_fabric(deck, p, &fabric);
    }
    if (erodes) scene_print(deck, "*MAT_ADD_EROSION\n%d\n0,0,0,0,0,0,0,%.17g\n", FACING, torn_at);
    if (box) {
        scene_write_node_set(deck, 3, &scene.mesh, select_box, NULL);
        scene_write_spc(deck, 3, true, true, true);
    }
    scene_write_part_set(deck, 1, box ? 5 : 3, (const int[]){FLOOR, ROOF, SIDES, FACING, REST});
    scene_write_part_set(deck, 7, 1, (const int[]){ROOF});
    scene_print(deck, "*CONTROL_TIMESTEP\n0,0.9,0,0,0,9\n*DEFINE_CURVE\n9\n0,5e-6\n1,5e-6\n");
    write_bag(deck, "_JETTING_CM", "0", "0.18,0.18,0.05,0.18,0.18,1.,0.2,1.\n0,0,0,7,0,0,0,0\n0\n");
    scene_end(deck, &scene.mesh);
    Forces forces = {0};
    VerifyRun run; /* nothing moves: energies are rounding */
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .energy_limit = 1e6, .probe = watch, .user = &forces});
    print_message("    %ld cycles; force on the roof %g N, later %g N\n", (long)run.cycles, forces.before,
                  forces.after);
    verify_free(&run);
    return forces;
}

static void a_hole_lets_the_jet_through(void **state)
{
    (void)state;
    Forces open = run_duct_with_box(false, false), hidden = run_duct_with_box(true, false),
           torn = run_duct_with_box(true, true);
    verify_between("roof behind the box over free roof", hidden.after / open.after, 0, 0.7);
    verify_near("before the box erodes", torn.before, hidden.before, 1e-9);
    verify_close("after", torn.after, open.after, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_hole_lets_the_jet_through)};
    return cmocka_run_group_tests_name("jets and erosion", tests, NULL, NULL);
}
