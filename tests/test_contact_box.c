/* A rigid box in *CONTACT_AUTOMATIC_SURFACE_TO_SURFACE meets fabric by its faces, its edges and its
 * corners, and nothing goes through: no edge of one through a face of the other at any time. On coarse sheets the
 * quadrilaterals warp by several thicknesses: where their diagonals are no edges, edges go through in 8 of the 48
 * drops. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "contact/contact_check.h"
#include "tests/contact_scene.h"

enum { FABRIC = 1, BOX };

typedef struct Watch {
    int looks, crossings, near; /* near: most of the nodes that were within the thickness at once */
    double deepest;             /* least distance of them over the thickness */
} Watch;

static void watch(void *user, const Model *model, const State *state, const StepView *view)
{
    Watch *w = user;
    (void)view;
    if (state->clock->cycle % 2 != 0) return;
    ContactFindings findings;
    assert_int_equal(contact_inspect(model, &model->contacts[0], state->x, &findings, NULL, NULL), 0);
    w->looks++;
    w->crossings += findings.cross_count;
    w->near = findings.near_count > w->near ? findings.near_count : w->near;
    if (findings.near_count > 0) w->deepest = fmin(w->deepest, findings.nearest);
}

static bool select_rim(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9;
    return fabs(x[2]) < small && (x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small);
}

/* cells: of the sheet along a side; turn: of the box; off: from the sheet's middle, so that a corner or edge meets the
 * inside of an element. */
static void fall(const char *name, int cells, const double turn[9], const double off[2])
{
    const double side = 0.3, size = 0.08, speed = 3;
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    SceneMesh *mesh = &scene.mesh;
    deck->exact = true;
    scene_add_sheet(mesh, FABRIC, SCENE_QUADS, cells, cells, side, side, 0, 0, 0);
    int box = mesh->node_count;
    scene_add_box(mesh, BOX, BOX, BOX, size, size, size);
    const double same[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, centre[3] = {-0.5 * size, -0.5 * size, -0.5 * size};
    scene_transform(mesh, box, same, centre);
    scene_transform(mesh, box, turn, (const double[]){0, 0, 0});
    double lowest = 0;
    for (int i = box; i < mesh->node_count; i++) lowest = fmin(lowest, mesh->x[3 * i + 2]);
    scene_transform(mesh, box, same, (const double[]){0.5 * side + off[0], 0.5 * side + off[1], 2e-3 - lowest});
    scene_begin(deck, name, 0.06, 0.9);
    scene_write_part(deck, FABRIC, 1, 1, "sheet");
    scene_write_part(deck, BOX, 2, 2, "box");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_section(deck, 2, 9, 1e-3);
    SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, 1000, 0, 0);
    scene_write_node_set(deck, 1, mesh, select_rim, &side);
    scene_write_spc(deck, 1, true, true, true);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, BOX, 0, 0, -speed);
    scene_write_contact(deck, &(SceneContact){.keyword = "AUTOMATIC_SURFACE_TO_SURFACE",
                                              .a = FABRIC,
                                              .b = BOX,
                                              .a_type = 3,
                                              .b_type = 3,
                                              .fs = 0.2,
                                              .fd = 0.2});
    scene_end(deck, mesh);
    Watch w = {.deepest = 1};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = watch, .user = &w});
    double back = run.state.rigid[0].v[2];
    print_message(
        "  %s, %d x %d elements: %ld cycles, %d looks, up to %d nodes near, least distance %.2f thicknesses\n", name,
        cells, cells, (long)run.cycles, w.looks, w.near, w.deepest);
    verify_near("edges through faces", w.crossings, 0, 0);
    assert_int_equal(run.diagnostics.warnings, 0);
    verify_between("speed of return over speed", back / speed, 0.3, 1.01);
    verify_between("energy balance", (run.samples[run.count - 1].held - run.samples[run.count - 1].given) / run.energy,
                   -5e-3, 5e-3);
    verify_free(&run);
}

static void faces_edges_corners(void **state)
{
    (void)state;
    const double c = sqrt(0.5), s = sqrt(1.0 / 3), t = sqrt(2.0 / 3), inside[2] = {0.004, 0.003};
    /* the box's axes are turned so that a face, an edge or a corner (the space diagonal) points down; askew: its edges
     * meet those of the elements and their diagonals at all angles */
    const double flat[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, edge[9] = {1, 0, 0, 0, c, -c, 0, c, c},
                 tip[9] = {t, -0.5 * t, -0.5 * t, 0, c, -c, s, s, s},
                 askew[9] = {2.0 / 3, -1.0 / 3, 2.0 / 3, 2.0 / 3, 2.0 / 3, -1.0 / 3, -1.0 / 3, 2.0 / 3, 2.0 / 3};
    for (int cells = 5; cells <= 24; cells += cells < 15 ? 1 : 9) {
        fall("by a face", cells, flat, inside);
        fall("by an edge", cells, edge, inside);
        fall("by a corner", cells, tip, inside);
        fall("askew", cells, askew, inside);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(faces_edges_corners)};
    return cmocka_run_group_tests_name("a box on fabric", tests, NULL, NULL);
}
