/* An impactor that meets a gas-filled bag through contact: piston on a gas column (C1 of the reference collection). The
 * bag's lid is fabric, loose from the plate that falls on it; together they weigh what the reference's piston does. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "tests/contact_scene.h"

#define PRESSURE offsetof(VerifySample, pressure)
#define MASS offsetof(VerifySample, mass)
#define PLATE_Z (offsetof(VerifySample, x) + 2 * sizeof(double))
#define PLATE_SPEED (offsetof(VerifySample, v) + 2 * sizeof(double))

enum { BOTTOM = 1, LID, WALL, PLATE };

/* The reference has no fabric between piston and gas: the contact's thickness, which the gas presses flat, is small. */
static const double side = 0.2, height = 0.3, thickness = 4e-4, apart = 2e-5, density = 800, mass = 5, speed = 4,
                    hair = 1e-7; /* an entity starts so far from the lid */

static bool select_rim(const void *user, const double x[3])
{
    (void)user;
    const double small = 1e-9;
    return fabs(x[2] - height) < small && (x[0] < small || x[0] > side - small || x[1] < small || x[1] > side - small);
}

/* How the impactor meets the lid: by its face, or as a *CONTACT_ENTITY. */
typedef enum Meeting { BY_FACES, BY_FINITE_PLANE, BY_CYLINDER, BY_BOX } Meeting;

/* What of the impactor meets the lid. An entity's penalty is stiff, since the gas presses the lid into it all the time.
 */
static void write_meeting(SceneText *deck, Meeting meeting, double wide)
{
    SceneEntity entity = {.part = PLATE, .set = LID, .set_type = 1, .scale = 10, .damping = 20};
    const double middle[3] = {0.5 * side, 0.5 * side, height + hair}, y[3] = {0, 1, 0}, x[3] = {1, 0, 0};
    if (meeting == BY_FACES) {
        scene_write_contact(deck, &(SceneContact){.keyword = "AUTOMATIC_SURFACE_TO_SURFACE",
                                                  .a = LID,
                                                  .b = PLATE,
                                                  .a_type = 3,
                                                  .b_type = 3,
                                                  .sst = apart,
                                                  .mst = apart,
                                                  .vdc = 20});
        return;
    }
    memcpy(entity.centre, middle, sizeof middle);
    if (meeting == BY_FINITE_PLANE) { /* it looks down */
        memcpy(entity.a, y, sizeof y);
        memcpy(entity.b, x, sizeof x);
        entity.g[0] = entity.g[1] = wide;
    }
    if (meeting == BY_CYLINDER) {
        scene_print(deck, "*DEFINE_CURVE\n3,0,1,1,0,0,1\n0,0\n0,%g\n0.05,%g\n0.05,0\n", wide, wide);
        entity.g[0] = 3;
    }
    entity.shape = meeting == BY_FINITE_PLANE ? 10 : meeting == BY_CYLINDER ? 11 : 9;
    scene_write_entity(deck, &entity);
}

/* Box with a rigid bottom, massless walls and a lid of fabric that cannot move sideways, under a rigid plate or box
 * that overlaps it on all sides. */
static int make_impact(Scene *scene, Meeting meeting, double vent_area, double end)
{
    enum { CELLS = 16 };
    const double overlap = 0.02, wide = side + 2 * overlap;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_box(mesh, BOTTOM, 9, WALL, side, side, height);
    scene_drop_part(mesh, 9);
    int lid = scene_add_sheet(mesh, LID, SCENE_QUADS, CELLS, CELLS, side, side, 0, 0, height);
    scene_weld(mesh, 0, 1e-6);
    lid = 4;
    int plate = mesh->node_count;
    double plate_area = wide * wide;
    if (meeting == BY_BOX) {
        const double thick = 0.04;
        scene_add_box(mesh, PLATE, PLATE, PLATE, wide, wide, thick);
        scene_transform(mesh, plate, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1},
                        (const double[]){-overlap, -overlap, height + hair});
        plate_area = 2 * wide * wide + 4 * wide * thick;
    } else {
        scene_add_sheet(mesh, PLATE, SCENE_QUADS, 1, 1, wide, wide, -overlap, -overlap,
                        height + (meeting == BY_FACES ? apart : hair));
    }
    scene_begin(deck, "plate falls on a bag", end, 0.9);
    scene_write_part(deck, BOTTOM, 1, 1, "bottom");
    scene_write_part(deck, LID, 1, 2, "lid");
    scene_write_part(deck, WALL, 2, 3, "walls");
    scene_write_part(deck, PLATE, 1, 4, "plate");
    scene_write_section(deck, 1, 9, thickness);
    scene_write_section(deck, 2, 9, 1e-6);
    scene_write_rigid(deck, 1, 7800, 7, 7);
    SceneFabric fabric = scene_isotropic(2, false, density, 2e8, 0.3);
    scene_write_fabric(deck, 2, &fabric);
    scene_write_null(deck, 3, 1e-6);
    const double lid_mass = density * thickness * side * side;
    scene_write_rigid(deck, 4, (mass - lid_mass) / (plate_area * thickness), 4, 7);
    scene_write_part_set(deck, 1, 3, (const int[]){BOTTOM, LID, WALL});
    scene_write_node_set(deck, 2, mesh, select_rim, NULL);
    scene_write_spc(deck, 2, true, true, false);
    scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1, 0});
    scene_write_curve(deck, 2, 2, (const double[]){0, 1, 1, 1});
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.vent_coefficient = vent_area > 0 ? 1 : 0;
    air.vent_area = vent_area;
    scene_write_simple_airbag(deck, 1, &air);
    scene_write_gravity(deck, 2, 9.81);
    scene_write_speed(deck, lid, plate, 0, 0, -speed);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, PLATE, 0, 0, -speed);
    write_meeting(deck, meeting, wide);
    scene_end(deck, mesh);
    return plate;
}

/* x against the largest one: it ends at 0. */
static void check_impact(const VerifyRun *run, double start, const double (*table)[4], size_t count, double stroke)
{
    for (size_t i = 0; i < count; i++) {
        double t = table[i][0];
        verify_near("C1 x [m]", start - verify_at(run, t, PLATE_Z), table[i][1], 1e-3 * stroke);
        verify_near("C1 v [m/s]", -verify_at(run, t, PLATE_SPEED), table[i][2], 4e-3);
        verify_close("C1 p [Pa]", verify_at(run, t, PRESSURE), table[i][3], 1e-3);
    }
}

static void close_impact(Meeting meeting)
{
    const double start = height + (meeting == BY_FACES ? apart : hair);
    const double table[][4] = {{0.01, 0.03779036322, 3.275545208, 122342.7563},
                               {0.02, 0.06003615393, 0.9536570334, 138510.3508},
                               {0.03, 0.05495026912, -1.916029407, 134502.528},
                               {0.04, 0.02540015789, -3.725539718, 114684.8293}};
    Scene scene = {0};
    int plate = make_impact(&scene, meeting, 0, 0.0465);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = plate});
    print_message("    %ld cycles\n", (long)run.cycles);
    check_impact(&run, start, table, sizeof table / sizeof table[0], 0.0616);
    verify_close("C1 largest x [m]", start - verify_smallest(&run, 0, PLATE_Z), 0.061589618997, 1e-3);
    verify_close("C1 largest p [Pa]", verify_largest(&run, 0, PRESSURE), 139775.5283, 1e-3);
    verify_close("C4 speed of return [m/s]", verify_at(&run, 0.046478601, PLATE_SPEED), 4, 1e-3);
    verify_balance(&run, 1e-3);
    verify_free(&run);
}

/* After 0.05 s the bag sucks, which a lid that lies loose under the plate does not feel. */
static void vent_impact(Meeting meeting)
{
    const double start = height + (meeting == BY_FACES ? apart : hair);
    const double table[][4] = {{0.01, 0.0384249797, 3.49863878, 115352.36},
                               {0.02, 0.0670837744, 2.1436434, 121980.905},
                               {0.03, 0.080945608, 0.683719106, 117947.037},
                               {0.04, 0.082901845, -0.157364859, 107982.707}};
    const double gas[] = {0.0138206562, 0.0128075053, 0.0117593889, 0.0109422928};
    Scene scene = {0};
    int plate = make_impact(&scene, meeting, 5e-4, 0.042);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = plate});
    print_message("    %ld cycles\n", (long)run.cycles);
    check_impact(&run, start, table, 4, 0.0831);
    for (size_t i = 0; i < 4; i++) verify_close("C1 m [kg]", verify_at(&run, table[i][0], MASS), gas[i], 1e-3);
    verify_close("C1 largest p [Pa]", verify_largest(&run, 0, PRESSURE), 122058.5805, 1e-3);
    verify_free(&run);
}

static void closed_bag(void **state)
{
    (void)state;
    close_impact(BY_FACES);
}

static void vented_bag(void **state)
{
    (void)state;
    vent_impact(BY_FACES);
}

/* The same with the shapes of *CONTACT_ENTITY: a finite plane, a finite cylinder, a box as a convex mesh. */
static void entities(void **state)
{
    (void)state;
    for (int meeting = BY_FINITE_PLANE; meeting <= BY_BOX; meeting++) {
        close_impact((Meeting)meeting);
        vent_impact((Meeting)meeting);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(closed_bag), cmocka_unit_test(vented_bag),
                                       cmocka_unit_test(entities)};
    return cmocka_run_group_tests_name("impactor on a bag", tests, NULL, NULL);
}
