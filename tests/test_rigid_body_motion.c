/* Rigid bodies: constraints, prescribed motion, damping, the piston of case C1. */
#include "tests/rigid_case.h"

/* Angular acceleration from rest along the curve: the half step's spin is its integral. */
static void prescribed_angular_acceleration(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 0};
    asymmetric(&s, shift);
    double x[2] = {0, 1}, y[2] = {0, 4}, area[2] = {0, 2};
    const Curve curve = {.count = 2, .x = x, .y = y, .area = area};
    PrescribedMotion motion = {.node = -1,
                               .rigid_body = 0,
                               .vad = 1,
                               .rotation = true,
                               .direction = {0, 1, 0},
                               .curve = 0,
                               .scale = 3,
                               .death = 1e28};
    const Constraints constraints = {.motion_count = 1, .motions = &motion};
    s.body.fix_rotation[0] = s.body.fix_rotation[2] = true;
    rigid_body_start(&s.body, &s.state);
    RigidPrescription p;
    for (int n = 0; n < 100; n++) {
        rigid_body_prescribe(&constraints, 0, &s.body, &s.state, &curve, s.time, 0.5 * (s.last_step + 5e-3), 5e-3, &p);
        scene_step(&s, 5e-3, NULL, &p, NULL);
        double half = s.time - 2.5e-3;
        assert_near(s.state.spin[1], 3 * 2 * half * half, 1e-12);
    }
    scene_end(&s);
}

/* An off-centre force on a lid that may only move along z. */
static void constrained_lid_moves_along_z_only(void **unused)
{
    (void)unused;
    Scene s;
    double x[4][3] = {{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.2, 0}, {0, 0.2, 0}}, mass[4] = {1, 1, 1, 2};
    scene_begin(&s, 4, x, mass);
    s.body.fix_translation[0] = s.body.fix_translation[1] = true;
    s.body.fix_rotation[0] = s.body.fix_rotation[1] = s.body.fix_rotation[2] = true;
    s.body.velocity[0] = 3; /* a constrained component starts at rest */
    rigid_body_start(&s.body, &s.state);
    assert_true(s.state.v[0] == 0);
    s.f[0] = 100, s.f[1] = -50, s.f[2] = 10;
    RigidWork work = {0};
    for (int n = 0; n < 100; n++) scene_step(&s, 1e-3, NULL, NULL, &work);
    for (int k = 0; k < 4; k++) {
        assert_true(s.x[3 * k] == x[k][0] && s.x[3 * k + 1] == x[k][1]);
        assert_near(s.x[3 * k + 2], 0.5 * 2 * 0.01, 1e-14);
    }
    assert_true(work.reaction == 0);
    assert_near(work.forces, rigid_body_kinetic(&s.body, &s.state), 1e-14);
    scene_end(&s);
}

/* Free to turn about one oblique axis: alpha = n.M / n.J n. */
static void hinge_turns_about_its_axis(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 0};
    asymmetric(&s, shift);
    /* constraint axes: rows e1, e2 fixed, e3 = (1, 1, 1)/sqrt(3) free */
    const double a = 1 / sqrt(2), b = 1 / sqrt(6), c = 1 / sqrt(3);
    const double axes[9] = {a, -a, 0, b, b, -2 * b, c, c, c};
    memcpy(s.body.constraint_axes, axes, sizeof axes);
    s.body.fix_rotation[0] = s.body.fix_rotation[1] = true;
    for (int i = 0; i < 3; i++) s.body.fix_translation[i] = true;
    rigid_body_start(&s.body, &s.state);
    double tensor_nn = 0, moment[3], arm[3];
    for (int i = 0; i < 3; i++) {
        double part = vector3_dot(s.body.axes + 3 * i, axes + 6);
        tensor_nn += s.body.inertia[i] * part * part;
    }
    s.f[3] = 1, s.f[4] = 2, s.f[5] = -1;
    vector3_subtract(s.x + 3, s.state.x, arm);
    vector3_cross(arm, s.f + 3, moment);
    double expected = vector3_dot(moment, axes + 6) / tensor_nn;
    scene_step(&s, 1e-5, NULL, NULL, NULL);
    assert_near(vector3_dot(s.state.alpha, axes + 6), expected, 1e-6 * fabs(expected));
    double fixed_to_axis = vector3_dot(s.x, axes + 6);
    for (int n = 0; n < 1000; n++) scene_step(&s, 1e-3, NULL, NULL, NULL);
    assert_near(vector3_dot(s.x, axes + 6), fixed_to_axis, 1e-12);
    assert_near(vector3_dot(s.state.spin, axes), 0, 1e-12);
    assert_true(fabs(vector3_dot(s.state.spin, axes + 6)) > 0.1);
    scene_end(&s);
}

/* Displacement of the centre and angle about an axis are met at every step; the reaction's work is the energy. */
static void prescribed_motion_is_met(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {1, 0, 0};
    asymmetric(&s, shift);
    double time_points[2] = {0, 1}, ramp[2] = {0, 0.5}, area[2] = {0, 0.25};
    double turn_y[2] = {0, 2}, turn_area[2] = {0, 1};
    Curve curves[2] = {{.count = 2, .x = time_points, .y = ramp, .area = area},
                       {.count = 2, .x = time_points, .y = turn_y, .area = turn_area}};
    PrescribedMotion motions[3] = {
        {.node = -1, .rigid_body = 0, .vad = 2, .direction = {0, 1, 0}, .curve = 0, .scale = 1, .death = 1e28},
        {.node = -1,
         .rigid_body = 0,
         .vad = 2,
         .rotation = true,
         .direction = {0, 0, 1},
         .curve = 1,
         .scale = 1,
         .death = 1e28},
        {.node = -1, .rigid_body = 1, .vad = 2, .direction = {1, 0, 0}, .curve = 0, .scale = 1, .death = 1e28}};
    Constraints constraints = {.motion_count = 3, .motions = motions};
    s.body.fix_rotation[0] = s.body.fix_rotation[1] = true;
    double start[3];
    memcpy(start, s.x, sizeof start);
    rigid_body_start(&s.body, &s.state);
    RigidWork work = {0};
    RigidPrescription p;
    for (int n = 0; n < 820; n++) {
        double dt = n % 2 ? 1.5e-3 : 1e-3;
        rigid_body_prescribe(&constraints, 0, &s.body, &s.state, curves, s.time, 0.5 * (s.last_step + dt), dt, &p);
        assert_int_equal(p.count, 2);
        scene_step(&s, dt, NULL, &p, &work);
        assert_near(s.state.x[1], 0.5 * fmin(s.time, 1), 1e-14);
        double angle = 2 * fmin(s.time, 1), rx = start[0] - 1, ry = start[1];
        assert_near(s.x[0], 1 + cos(angle) * rx - sin(angle) * ry, 1e-12);
        assert_near(s.x[1], s.state.x[1] + sin(angle) * rx + cos(angle) * ry, 1e-12);
        if (n == 600) assert_near(work.reaction, rigid_body_kinetic(&s.body, &s.state), 1e-3 * work.reaction);
    }
    /* the curves end at 1 s: the body stands, and the reaction has taken its energy back */
    assert_near(rigid_body_kinetic(&s.body, &s.state), 0, 1e-20);
    assert_near(work.reaction, 0, 1e-3);
    scene_end(&s);
}

static void damping_takes_energy_as_booked(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 0};
    asymmetric(&s, shift);
    const RigidField field = {.damping = {2, 2, 2, 3, 3, 3}};
    s.body.velocity[1] = 4;
    for (int i = 0; i < 3; i++) s.body.spin[i] = 5 * s.body.axes[3 + i];
    rigid_body_start(&s.body, &s.state);
    double before = s.state.kinetic;
    RigidWork work = {0};
    for (int n = 0; n < 1000; n++) scene_step(&s, 1e-3, &field, NULL, &work);
    assert_near(s.state.v[1], 4 * exp(-2 * 0.9995), 1e-5);
    assert_near(vector3_norm(s.state.spin), 5 * exp(-3 * 0.9995), 1e-5);
    assert_near(before - rigid_body_kinetic(&s.body, &s.state), work.damping, 1e-9 * before);
    scene_end(&s);
}

/* C1(a): a lid of 5 kg on a closed column of air; the gas is an adiabat here. */
static void piston_of_case_c1(void **unused)
{
    (void)unused;
    Scene s;
    double x[4][3] = {{0, 0, 0.3}, {0.2, 0, 0.3}, {0.2, 0.2, 0.3}, {0, 0.2, 0.3}};
    const double mass[4] = {1.25, 1.25, 1.25, 1.25};
    scene_begin(&s, 4, x, mass);
    s.body.fix_translation[0] = s.body.fix_translation[1] = true;
    s.body.fix_rotation[0] = s.body.fix_rotation[1] = s.body.fix_rotation[2] = true;
    s.body.velocity[2] = -4;
    rigid_body_start(&s.body, &s.state);
    const RigidField field = {.gravity = {0, 0, -9.81}};
    double deepest = 0, dt = 1e-5, p0 = 101325, returned = 0;
    for (int n = 0; n < 5000; n++) {
        double p = p0 * pow(0.3 / s.x[2], 1.4);
        for (int k = 0; k < 4; k++) s.f[3 * k + 2] = 0.01 * (p - p0);
        scene_step(&s, dt, &field, NULL, NULL);
        deepest = fmax(deepest, 0.3 - s.x[2]);
        if (n + 1 == 1000) assert_near(0.3 - s.x[2], 0.03779036322, 1e-7);
        if (n + 1 == 4000) assert_near(0.3 - s.x[2], 0.02540015789, 1e-7);
        if (returned == 0 && n > 100 && s.x[2] >= 0.3) returned = s.time;
    }
    assert_near(deepest, 0.061589618997, 1e-8);
    assert_near(returned, 0.046478601, 2 * dt);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prescribed_angular_acceleration), cmocka_unit_test(constrained_lid_moves_along_z_only),
        cmocka_unit_test(hinge_turns_about_its_axis),      cmocka_unit_test(prescribed_motion_is_met),
        cmocka_unit_test(damping_takes_energy_as_booked),  cmocka_unit_test(piston_of_case_c1),
    };
    return cmocka_run_group_tests_name("rigid body, motion", tests, NULL, NULL);
}
