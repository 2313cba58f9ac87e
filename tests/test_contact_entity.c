/* Contact entities in motion against closed forms: impact of bodies, momentum and its moment, friction, stability. */
#include "tests/verify.h"

#include <math.h>
#include <string.h>

#include "tests/entity_case.h"

/* One corner of a free plate strikes a free sphere whose centre is not the body's: with 1/m = sum of what both give way
 * at the contact, the impulse of an elastic impact is 2 m v_n. */
static void two_bodies(void **state)
{
    (void)state;
    const double speed = 5, radius = 0.02, centre[3] = {0.01, 0.005, 0};
    Scene scene = {0};
    begin(&scene, 1.2e-3, 0);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 3, radius);
    int plate = scene_add_sheet(&scene.mesh, STRIKER, SCENE_QUADS, 1, 1, 0.04, 0.03, 0, 0, 0);
    const double turn[9] = {0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8}, shift[3] = {-0.016, 0.009, 0.0445};
    scene_transform(&scene.mesh, plate, turn, shift);
    scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(&scene.deck, STRIKER, 0, 0, -speed);
    scene_print(&scene.deck, "*SET_NODE_LIST\n1\n%d\n", plate + 2);               /* its lowest corner */
    scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 1, 1, 5e-4, 5e-4, 1, 1, 1); /* small steps */
    scene_write_entity(&scene.deck,
                       &(SceneEntity){.part = BODY, .shape = 2, .set = 1, .g = {centre[0], centre[1], 0, radius}});
    scene_end(&scene.deck, &scene.mesh);
    double corner[3];
    memcpy(corner, scene.mesh.x + 3 * (plate + 1), sizeof corner);
    /* where it strikes */
    double across[2] = {corner[0] - centre[0], corner[1] - centre[1]};
    double up = sqrt(radius * radius - across[0] * across[0] - across[1] * across[1]);
    const double point[3] = {corner[0], corner[1], up}, n[3] = {across[0] / radius, across[1] / radius, up / radius};
    assert_true(corner[2] > up && corner[2] < up + 4e-3);
    Watch w = {0};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = watch, .user = &w});

    double inverse = 0, impulse, arm[2][3];
    assert_int_equal(run.model.rigid_body_count, 2);
    for (int b = 0; b < 2; b++) {
        const RigidBody *body = &run.model.rigid_bodies[b];
        RigidState start;
        double q[3], spin[3], drop[3] = {0, 0, body->part_id == STRIKER ? corner[2] - up : 0};
        rigid_body_start(body, &start);
        vector3_subtract(point, body->centre, arm[b]);
        for (int k = 0; k < 3; k++) arm[b][k] += drop[k];
        vector3_cross(arm[b], n, q);
        rigid_body_spin_of(body, &start, q, spin);
        inverse += 1 / body->mass + vector3_dot(q, spin);
    }
    impulse = 2 * speed * n[2] / inverse;
    double scale = 0;
    for (int b = 0; b < 2; b++) {
        const RigidBody *body = &run.model.rigid_bodies[b];
        double sign = body->part_id == STRIKER ? 1 : -1, moment[3];
        vector3_cross(arm[b], n, moment);
        scale = fmax(scale, body->part_id == STRIKER ? body->mass * speed : 0);
        for (int k = 0; k < 3; k++) {
            double v = body->velocity[k] + sign * impulse * n[k] / body->mass;
            verify_near("velocity after", run.state.rigid[b].v[k], v, 0.002 * speed);
            verify_near("moment of momentum after", run.state.rigid[b].momentum[k] / impulse / radius,
                        sign * moment[k] / radius, 0.002);
        }
    }
    verify_near("change of momentum", w.linear / scale, 0, 1e-12);
    verify_near("change of its moment", w.angular / (scale * radius), 0, 1e-10);
    check_end(&run, 1e-3);
    verify_free(&run);
}

static void patch_on(int shape, const double g[7], double friction, double damping, int order)
{
    SceneEntity entity = {.shape = shape, .friction = friction, .damping = damping, .order = order};
    memcpy(entity.g, g, sizeof entity.g);
    meet_patch(&entity, 1, "");
}

static void momentum_is_kept(void **state)
{
    (void)state;
    const double sphere[7] = {0, 0, 0, 0.03}, ellipsoid[7] = {0, 0, 0, 0.02, 0.025, 0.03, 2},
                 cylinder[7] = {0, 0, 0, 0.3, 1, 0, 0.025}, plane[7] = {0, 0, 0.025, 0, 0.1, 1};
    patch_on(2, sphere, 0, 0, 0);
    patch_on(2, sphere, 0.3, 20, 0);
    patch_on(4, ellipsoid, 0.3, 0, 2);
    patch_on(3, cylinder, 0, 20, 1);
    patch_on(1, plane, 0.3, 0, 0);
    patch_on(9, sphere, 0.3, 20, 2);
}

/* A sheet slides on the plane of a fixed part: mu g slows it down, and holds it where the pull is less. */
static void slide(double friction, double speed, double pull, double expected)
{
    const double g = 1000;
    Scene scene = {0};
    begin(&scene, 4e-3, 7);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 1, 0.01);
    int sheet = scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 4, 4, 0.04, 0.04, 0, 0, 0.05);
    scene_write_speed(&scene.deck, sheet, scene.mesh.node_count, speed, 0, 0);
    scene_print(&scene.deck, "*LOAD_BODY_Z\n1,%g\n*LOAD_BODY_X\n1,%g\n", g, -pull);
    scene_write_curve(&scene.deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_entity(&scene.deck, &(SceneEntity){.part = BODY,
                                                   .shape = 1,
                                                   .set = FABRIC,
                                                   .set_type = 1,
                                                   .damping = 20,
                                                   .friction = friction,
                                                   .g = {0, 0, 0.05, 0, 0, 1}});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    verify_near("speed at the end", mean_speed(&run, sheet, run.model.node_count, 0), expected, 0.01);
    if (expected > 0) check_end(&run, 2e-3);
    verify_free(&run);
}

static void friction(void **state)
{
    (void)state;
    slide(0.3, 3, 0, 3 - 0.3 * 1000 * 4e-3);
    slide(0.3, 0, 500, (500 - 300) * 4e-3);
    slide(0.3, 0, 250, 0);
}

/* A loose sheet that falls on a plane gives its speed back. With damping z it leaves where the force of a damped
 * oscillator is zero, at w t = pi - atan(2 z sqrt(1 - z^2)/(1 - 2 z^2)), w the damped frequency, with the share
 * exp(-z w t/sqrt(1 - z^2)) of its speed; a soft penalty resolves that. */
static void bounce(double scale, double damping, double tolerance)
{
    const double z = 0.01 * damping, root = sqrt(1 - z * z);
    Scene scene = {0};
    begin(&scene, 5e-3, 7);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 1, 0.01);
    int sheet = scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 8, 8, 0.08, 0.08, 0, 0, 0.051);
    scene_write_speed(&scene.deck, sheet, scene.mesh.node_count, 0, 0, -5);
    scene_write_entity(&scene.deck, &(SceneEntity){.part = BODY,
                                                   .shape = 1,
                                                   .set = FABRIC,
                                                   .set_type = 1,
                                                   .scale = scale,
                                                   .damping = damping,
                                                   .g = {0, 0, 0.05, 0, 0, 1}});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double expected = exp(-z / root * (M_PI - atan2(2 * z * root, 1 - 2 * z * z)));
    verify_near("speed after over speed before", mean_speed(&run, sheet, run.model.node_count, 2) / 5, expected,
                tolerance);
    check_end(&run, 1e-3);
    verify_free(&run);
}

static void restitution(void **state)
{
    (void)state;
    bounce(1, 0, 0.005);
    bounce(0.001, 0, 1e-6);
    bounce(0.001, 20, 0.01);
    bounce(0.001, 50, 0.01);
}

/* A body lighter than what meets it: the penalty of many nodes together stays stable, and energy is kept. */
static void light_body(void **state)
{
    (void)state;
    Scene scene = {0};
    begin(&scene, 4e-3, 0);
    scene_print(&scene.deck, "*PART\nlight\n4,1,4\n*MAT_RIGID\n4,5\n\n\n");
    scene_add_sphere(&scene.mesh, 4, SCENE_QUADS, 3, 0.02);
    int patch = scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 16, 16, 0.08, 0.08, -0.04, -0.04, 0.021);
    scene_write_speed(&scene.deck, patch, scene.mesh.node_count, 0, 0, -10);
    scene_write_entity(
        &scene.deck,
        &(SceneEntity){
            .part = 4, .shape = 4, .set = FABRIC, .set_type = 1, .scale = 10, .g = {0, 0, 0, 0.04, 0.04, 0.02, 2}});
    scene_end(&scene.deck, &scene.mesh);
    Watch w = {0};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = watch, .user = &w});
    double ratio = run.model.rigid_bodies[0].mass / (density * thickness * 0.08 * 0.08);
    verify_between("mass of the body over that of the patch", ratio, 0, 0.05);
    verify_between("speed of the body over that of the patch", -run.state.rigid[0].v[2] / 10, 0.9, 2.1);
    check_end(&run, 5e-3);
    verify_free(&run);
}

/* Nodes inside at the start get no speed from it, and leave with their own. */
static void initial_penetration(void **state)
{
    (void)state;
    const double speed = 2;
    Scene scene = {0};
    begin(&scene, 2e-3, 7);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 1, 0.01);
    int sheet = scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 8, 8, 0.08, 0.08, -0.04, -0.04, 0.029);
    scene_write_speed(&scene.deck, sheet, scene.mesh.node_count, 0, 0, speed);
    scene_write_entity(&scene.deck,
                       &(SceneEntity){.part = BODY, .shape = 2, .set = FABRIC, .set_type = 1, .g = {0, 0, 0, 0.03}});
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double most = 0;
    for (int i = sheet; i < run.model.node_count; i++)
        for (int k = 0; k < 3; k++) most = fmax(most, fabs(run.v[3 * i + k] - (k == 2 ? speed : 0)));
    verify_near("largest change of speed", most / speed, 0, 1e-10);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_bodies), cmocka_unit_test(momentum_is_kept),
                                       cmocka_unit_test(friction),   cmocka_unit_test(restitution),
                                       cmocka_unit_test(light_body), cmocka_unit_test(initial_penetration)};
    return cmocka_run_group_tests_name("contact entities", tests, NULL, NULL);
}
