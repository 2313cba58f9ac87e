/* Leakage that real contact blocks: a bag whose bottom half lies on a plate (docs/theory.md, Leakage). */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>

#include "tests/contact_scene.h"

static const double side = 0.08, height = 0.05, thickness = 4e-4;
enum { CELLS = 8, COVERED = 4 }; /* of the bottom in each direction; wholly over the plate, a column more by half */

/* A closed box: bottom of fabric (part 1) in CELLS x CELLS quads, lid and walls without stress (part 3). */
static void add_bag(SceneMesh *mesh)
{
    static const double up[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, along_x[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0},
                        along_y[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    const double *turn[6] = {up, up, along_x, along_x, along_y, along_y};
    const double shift[6][3] = {{0, 0, 0}, {0, 0, height}, {0, 0, 0}, {0, side, 0}, {0, 0, 0}, {side, 0, 0}};
    for (int i = 0; i < 6; i++) {
        int first = mesh->node_count;
        scene_add_rectangle(mesh, i == 0 ? 1 : 3, SCENE_QUADS, CELLS, i < 2 ? CELLS : 2, side, i < 2 ? side : height);
        scene_transform(mesh, first, turn[i], shift[i]);
    }
    scene_weld(mesh, 0, 1e-9);
}

/* The bag with 5 kPa over the plate; contact: text of the keyword that keeps them apart. */
static void bag_run(VerifyRun *run, int opt, const char *contact, bool walls_block)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_begin(deck, "bag on a plate", 1e-5, 0.9);
    scene_write_part(deck, 1, 1, 1, "bottom");
    scene_write_part(deck, 2, 1, 2, "plate");
    scene_write_part(deck, 3, 1, 3, "lid and walls");
    scene_write_section(deck, 1, 9, thickness);
    SceneFabric fabric = scene_isotropic(0, false, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, 7800, 7, 7);
    scene_write_null(deck, 3, 8000);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 3});
    scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1, 0});
    scene_print(deck,
                "*MAT_ADD_AIRBAG_POROSITY_LEAKAGE\n1,0.002,1\n"
                "*AIRBAG_WANG_NEFSKE\n1,1\n718,1005,300,0,1\n0\n1e5,1.16,1,0,5e3,0,%d\n\n",
                opt);
    add_bag(&scene.mesh);
    double end = side * (COVERED + 0.5) / CELLS;
    scene_add_sheet(&scene.mesh, 2, SCENE_QUADS, 3, 3, end + 0.02, side + 0.04, -0.02, -0.02, -0.9 * thickness);
    scene_print(deck, "%s", contact);
    scene_end(deck, &scene.mesh);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1, .walls_block = walls_block});
}

static double blocked_share(const VerifyRun *run)
{
    const Airbag *bag = &run->model.airbags[0];
    for (int i = 0; i < bag->part_count; i++)
        if (run->model.parts[bag->part[i]].id == 1)
            return run->state.part_blocked[bag->first_part + i] / run->state.part_area[bag->first_part + i];
    fail_msg("the bottom is no part of the bag");
    return 0;
}

#define CONTACT(kind) "*CONTACT_" kind "\n1,2,3,3\n\n\n"

/* A quarter of a quad for each node in contact: 4 columns and a half of 8. */
static void plate_blocks(void **state)
{
    (void)state;
    const double share = (COVERED + 0.5) / CELLS;
    VerifyRun free, run;
    bag_run(&free, 1, CONTACT("AUTOMATIC_NODES_TO_SURFACE"), false);
    verify_near("OPT 1 sees no contact", blocked_share(&free), 0, 0);
    double whole = free.state.gas[0].mass_flow_out_porosity;
    assert_true(whole > 0.0);
    bag_run(&run, 2, CONTACT("AUTOMATIC_NODES_TO_SURFACE"), false);
    verify_close("blocked share of the bottom", blocked_share(&run), share, 1e-4);
    verify_close("leakage left", run.state.gas[0].mass_flow_out_porosity / whole, 1 - share, 1e-3);
    verify_free(&run);
    verify_free(&free);
}

/* In contact both ways the corners of facets that the plate's own nodes touch are in contact, too: some of the next
 * column. */
static void both_ways(void **state)
{
    (void)state;
    VerifyRun run;
    bag_run(&run, 2, CONTACT("AUTOMATIC_SURFACE_TO_SURFACE"), false);
    verify_between("blocked share of the bottom", blocked_share(&run), (COVERED + 0.6) / CELLS,
                   (COVERED + 1.0) / CELLS);
    verify_free(&run);
}

/* A rigid wall in the plate's place blocks nothing, as LS-DYNA documents. */
static void wall_does_not(void **state)
{
    (void)state;
    VerifyRun run;
    bag_run(&run, 2, "*RIGIDWALL_PLANAR\n0\n0,0,0,0,0,1\n", false);
    verify_near("blocked share of the bottom", blocked_share(&run), 0, 0);
    assert_true(run.state.gas[0].mass_flow_out_porosity > 0.0);
    verify_free(&run);
}

/* With --walls-block it does: half a finite wall covers half of the bottom, and the other half leaks. */
static void wall_does_by_option(void **state)
{
    (void)state;
    VerifyRun free, run, both;
    const char *wall = "*RIGIDWALL_PLANAR_FINITE\n0\n-0.01,-0.01,0,-0.01,-0.01,1\n1,-0.01,0,0.055,0.2\n";
    char text[400];
    bag_run(&free, 2, wall, false);
    bag_run(&run, 2, wall, true);
    verify_close("blocked share of the bottom", blocked_share(&run), (COVERED + 0.5) / CELLS, 1e-4);
    verify_close("leakage left", run.state.gas[0].mass_flow_out_porosity / free.state.gas[0].mass_flow_out_porosity,
                 1 - (COVERED + 0.5) / CELLS, 1e-3);
    snprintf(text, sizeof text, "%s" CONTACT("AUTOMATIC_NODES_TO_SURFACE"), wall);
    bag_run(&both, 2, text, true); /* what both cover counts once */
    verify_close("wall and plate", blocked_share(&both), (COVERED + 0.5) / CELLS, 1e-4);
    verify_free(&free);
    verify_free(&run);
    verify_free(&both);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(plate_blocks), cmocka_unit_test(both_ways),
                                       cmocka_unit_test(wall_does_not), cmocka_unit_test(wall_does_by_option)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
