/* Contact against closed forms: momentum, restitution, friction. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "tests/contact_scene.h"

static const double thickness = 3e-4, density = 800;

/* Fabric part 1, rigid fixed part 2 (and 3 as 1). */
static void begin(Scene *scene, double end)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "contact", end, 0.9);
    scene_write_part(deck, 1, 1, 1, "fabric");
    scene_write_part(deck, 2, 1, 2, "plate");
    scene_write_part(deck, 3, 1, 1, "other fabric");
    scene_write_section(deck, 1, 9, thickness);
    SceneFabric fabric = scene_isotropic(0, false, density, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, 7800, 7, 7);
}

static void report(const VerifyRun *run)
{
    print_message("    %ld cycles, energy off by %.2g of the largest\n", (long)run->cycles,
                  run->energy > 0 ? run->imbalance / run->energy : 0);
}

/* The balance once the contact is over; within it the two kinetic energies of the ledger differ. */
static void check_end(const VerifyRun *run, double tolerance)
{
    const VerifySample *last = &run->samples[run->count - 1];
    verify_near("energy balance at the end", (last->held - last->given) / run->energy, 0, tolerance);
}

/* A loose sheet flies onto a fixed plate and off again: elastic contact gives its speed back. */
static void bounce_from(double height, ScenePattern pattern, const SceneContact *card, double expected,
                        double tolerance)
{
    Scene scene = {0};
    begin(&scene, height / 5 + 8e-4);
    int sheet = scene_add_sheet(&scene.mesh, 1, pattern, 8, 8, 0.08, 0.08, 0, 0, height);
    int plate = scene_add_sheet(&scene.mesh, 2, SCENE_QUADS, 3, 3, 0.12, 0.12, -0.02, -0.02, 0);
    scene_write_speed(&scene.deck, sheet, plate, 0, 0, -5);
    scene_write_contact(&scene.deck, card);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    report(&run);

    double v = mean_speed(&run, sheet, plate, 2);
    verify_near("speed after over speed before", v / 5, expected, tolerance);
    check_end(&run, 1e-3);
    verify_free(&run);
}

static void bounce_with(ScenePattern pattern, const SceneContact *card, double expected, double tolerance)
{
    bounce_from(1e-3, pattern, card, expected, tolerance);
}

#define NODES_ON_PLATE .keyword = "AUTOMATIC_NODES_TO_SURFACE", .a = 1, .b = 2, .a_type = 3, .b_type = 3

static void bounce(ScenePattern pattern, double vdc, double expected, double tolerance)
{
    bounce_with(pattern, &(SceneContact){NODES_ON_PLATE, .vdc = vdc}, expected, tolerance);
}

/* A bounce in whose middle the step falls to a thousandth for some cycles: a stiffness that followed it, or an impulse
 * that made good in this step what the gap lacks, would throw the sheet off. */
static void step_that_falls(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        Scene scene = {0};
        double from = 1.35e-4 + 6e-6 * i, to = from + 1e-5;
        begin(&scene, 1e-3);
        scene_print(&scene.deck, "*CONTROL_TIMESTEP\n0,0.9,0,0,0,1\n");
        scene_write_curve(&scene.deck, 1, 6,
                          (const double[]){0, 1, from, 1, from + 1e-9, 6e-9, to, 6e-9, to + 1e-9, 1, 1, 1});
        int sheet = scene_add_sheet(&scene.mesh, 1, SCENE_DIAGONAL, 8, 8, 0.08, 0.08, 0, 0, 1e-3);
        int plate = scene_add_sheet(&scene.mesh, 2, SCENE_QUADS, 3, 3, 0.12, 0.12, -0.02, -0.02, 0);
        scene_write_speed(&scene.deck, sheet, plate, 0, 0, -5);
        scene_write_contact(&scene.deck, &(SceneContact){NODES_ON_PLATE});
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .energy_limit = 1e9});
        verify_near("speed after over speed before", mean_speed(&run, sheet, plate, 2) / 5, 1, 0.03);
        verify_free(&run);
    }
}

/* From several elements away: at the start the two are no pair of anything yet. */
static void from_afar(void **state)
{
    (void)state;
    bounce_from(0.05, SCENE_QUADS, &(SceneContact){NODES_ON_PLATE}, 1, 0.01);
    bounce_from(0.05, SCENE_DIAGONAL, &(SceneContact){NODES_ON_PLATE}, 1, 0.01);
}

/* A sheet that starts nearer than its thickness parts with its own speed: no push, no energy. */
static void parting(void **state)
{
    (void)state;
    Scene scene = {0};
    begin(&scene, 1e-3);
    int sheet = scene_add_sheet(&scene.mesh, 1, SCENE_QUADS, 8, 8, 0.08, 0.08, 0, 0, 1e-4);
    int plate = scene_add_sheet(&scene.mesh, 2, SCENE_QUADS, 3, 3, 0.12, 0.12, -0.02, -0.02, 0);
    scene_write_speed(&scene.deck, sheet, plate, 0, 0, 2);
    scene_write_contact(&scene.deck, &(SceneContact){NODES_ON_PLATE});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    verify_near("speed after over speed before", mean_speed(&run, sheet, plate, 2) / 2, 1, 1e-10);
    verify_free(&run);
}

/* The sheet comes within its thickness of the plate at 0.14 ms and is 4 mm behind it at the end if nothing stops it. */
static void birth_and_death(void **state)
{
    (void)state;
    bounce_with(SCENE_QUADS, &(SceneContact){NODES_ON_PLATE, .birth = 5e-5}, 1, 0.01);
    bounce_with(SCENE_QUADS, &(SceneContact){NODES_ON_PLATE, .birth = 4e-4}, -1, 1e-12);
    bounce_with(SCENE_QUADS, &(SceneContact){NODES_ON_PLATE, .death = 1e-4}, -1, 1e-12);
    bounce_with(SCENE_QUADS, &(SceneContact){NODES_ON_PLATE, .death = 8e-4}, 1, 0.01);
}

static void sheet_on_plate(void **state)
{
    (void)state;
    bounce(SCENE_QUADS, 0, 1, 0.01);
    bounce(SCENE_DIAGONAL, 0, 1, 0.01);
}

/* Largest change of total momentum over the run, over the momentum that one sheet brings. */
typedef struct Momentum {
    double start[3], change, scale;
    bool begun;
} Momentum;

static void watch_momentum(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)state;
    Momentum *p = user;
    double sum[3] = {0};
    for (int n = 0; n < model->node_count; n++)
        for (int k = 0; k < 3; k++) sum[k] += model->mass[n] * view->v[3 * n + k];
    for (int k = 0; k < 3; k++) {
        if (!p->begun) p->start[k] = sum[k];
        p->change = fmax(p->change, fabs(sum[k] - p->start[k]));
    }
    p->begun = true;
}

/* Two loose sheets of different meshes meet: momentum to rounding, and equal masses exchange their speeds. */
static void collide(double apart, const char *keyword, bool self, ScenePattern one, ScenePattern other, double fs)
{
    Scene scene = {0};
    begin(&scene, 0.8e-3 + (apart - 1e-3) / 5);
    int lower = scene_add_sheet(&scene.mesh, 1, one, 7, 6, 0.08, 0.08, 0, 0, 0);
    int upper = scene_add_sheet(&scene.mesh, 3, other, 6, 8, 0.08, 0.08, 0, 0, apart);
    scene_write_speed(&scene.deck, upper, scene.mesh.node_count, 0.5, 0, -5);
    scene_write_contact(&scene.deck, &(SceneContact){.keyword = keyword,
                                                     .a = self ? 0 : 1,
                                                     .b = self ? 0 : 3,
                                                     .a_type = self ? 5 : 3,
                                                     .b_type = self ? 0 : 3,
                                                     .fs = fs,
                                                     .fd = fs});
    scene_end(&scene.deck, &scene.mesh);
    Momentum momentum = {.scale = density * thickness * 0.08 * 0.08 * 5};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = watch_momentum, .user = &momentum});
    report(&run);
    verify_near("change of momentum", momentum.change / momentum.scale, 0, 1e-10);
    verify_between("speed of the sheet hit", -mean_speed(&run, lower, upper, 2) / 5, 0.8, 1.01);
    check_end(&run, 2e-3);
    verify_free(&run);
}

static void momentum_is_kept(void **state)
{
    (void)state;
    collide(1e-3, "AUTOMATIC_SINGLE_SURFACE", true, SCENE_QUADS, SCENE_DIAGONAL, 0);
    collide(1e-3, "AUTOMATIC_SURFACE_TO_SURFACE", false, SCENE_ACROSS, SCENE_DIAGONAL, 0.3);
    collide(1e-3, "AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", false, SCENE_CROSS, SCENE_QUADS, 0.3);
}

/* Loose sheets that are no pair of anything at the start, and nothing fixed that would ask for a search. */
static void loose_from_afar(void **state)
{
    (void)state;
    collide(0.05, "AUTOMATIC_SINGLE_SURFACE", true, SCENE_QUADS, SCENE_DIAGONAL, 0);
}

/* A blade that spins about its middle comes down onto a fixed one, edge on edge, and turns through parallel in one step
 * while the two push: the force keeps its direction. Pairs that end near parallel are new after it, as near as they are
 * then, so that some give back less than they took. */
static void blades(void **state)
{
    (void)state;
    const double length = 0.01, spin = 8000, speed = 5, pi = 3.14159265358979;
    for (int i = 0; i < 12; i++) {
        Scene scene = {0};
        SceneMesh *mesh = &scene.mesh;
        double angle = -pi * (0.1 + 0.02 * i), c = cos(angle), s = sin(angle);
        begin(&scene, 4e-4);
        scene_add_rectangle(mesh, 1, SCENE_QUADS, 1, 1, length, length);
        const double stand[9] = {c, 0, 0, s, 0, 0, 0, 1, 0}; /* x, y to along the edge, z */
        scene_transform(mesh, 0, stand, (const double[3]){-0.5 * c * length, -0.5 * s * length, 8e-4});
        int blade = mesh->node_count;
        scene_add_rectangle(mesh, 2, SCENE_QUADS, 1, 1, 3 * length, length);
        scene_transform(mesh, blade, (const double[9]){1, 0, 0, 0, 0, 0, 0, 1, 0},
                        (const double[3]){-1.5 * length, 0, -length});
        for (int n = 0; n < blade; n++)
            scene_write_speed(&scene.deck, n, n + 1, -spin * mesh->x[3 * n + 1], spin * mesh->x[3 * n], -speed);
        scene_write_contact(&scene.deck, &(SceneContact){.keyword = "AUTOMATIC_SINGLE_SURFACE", .a_type = 5});
        scene_end(&scene.deck, mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        verify_between("speed after over speed before", mean_speed(&run, 0, blade, 2) / speed, 0.1, 1.05);
        verify_free(&run);
    }
}

/* A sheet slides on a plate under a body force: it slows down by mu g, and stays where mu g exceeds the pull. */
static void slide(double fs, double fd, double dc, double speed, double pull, double expected, double tolerance)
{
    const double g = 1000;
    Scene scene = {0};
    begin(&scene, 4e-3);
    int sheet = scene_add_sheet(&scene.mesh, 1, SCENE_QUADS, 4, 4, 0.04, 0.04, 0.0013, 0.0007, thickness);
    int plate = scene_add_sheet(&scene.mesh, 2, SCENE_QUADS, 3, 3, 0.12, 0.12, -0.03, -0.03, 0);
    scene_write_speed(&scene.deck, sheet, plate, speed, 0, 0);
    scene_print(&scene.deck, "*LOAD_BODY_Z\n1,%g\n*LOAD_BODY_X\n1,%g\n", g, -pull);
    scene_write_curve(&scene.deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_contact(&scene.deck, &(SceneContact){.keyword = "AUTOMATIC_SURFACE_TO_SURFACE",
                                                     .a = 1,
                                                     .b = 2,
                                                     .a_type = 3,
                                                     .b_type = 3,
                                                     .fs = fs,
                                                     .fd = fd,
                                                     .dc = dc,
                                                     .vdc = 20});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    report(&run);
    verify_near("speed at the end", mean_speed(&run, sheet, plate, 0), expected, tolerance);
    if (expected > 0) check_end(&run, 2e-3);
    verify_free(&run);
}

static void friction(void **state)
{
    (void)state;
    slide(0.3, 0.3, 0, 3, 0, 3 - 0.3 * 1000 * 4e-3, 0.01);
    slide(0.3, 0.3, 0, 0, 500, (500 - 300) * 4e-3, 0.01);
    slide(0.3, 0.3, 0, 0, 250, 0, 0.002);
    slide(0.5, 0.2, 1e3, 3, 0, 3 - 0.2 * 1000 * 4e-3, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheet_on_plate),   cmocka_unit_test(parting),         cmocka_unit_test(birth_and_death),
        cmocka_unit_test(momentum_is_kept), cmocka_unit_test(friction),        cmocka_unit_test(step_that_falls),
        cmocka_unit_test(from_afar),        cmocka_unit_test(loose_from_afar), cmocka_unit_test(blades)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
