/* Rigid bodies: inertia and free motion. */
#include "tests/rigid_case.h"

static void body_space_rate(const double inertia[3], const double w[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = (inertia[j] - inertia[k]) / inertia[i] * w[j] * w[k];
    }
}

static void inertia_of_known_masses(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {5, -7, 11};
    asymmetric(&s, shift);
    assert_near(s.body.mass, 7, 1e-14);
    for (int i = 0; i < 3; i++) assert_near(s.body.centre[i], shift[i], 1e-13);
    /* about the local x: 2 (2 0.04) + 2 (0.5 0.01) = 0.17; y: 0.18 + 0.01 = 0.19; z: 0.18 + 0.16 = 0.34 */
    double sorted[3];
    memcpy(sorted, s.body.inertia, sizeof sorted);
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            if (sorted[j] > sorted[j + 1]) {
                double swap = sorted[j];
                sorted[j] = sorted[j + 1], sorted[j + 1] = swap;
            }
        }
    }
    const double expected[3] = {0.17, 0.19, 0.34};
    for (int i = 0; i < 3; i++) assert_near(sorted[i], expected[i], 1e-14);
    double third[3];
    vector3_cross(s.body.axes, s.body.axes + 3, third);
    for (int i = 0; i < 3; i++) assert_near(third[i], s.body.axes[6 + i], 1e-14);
    for (int k = 0; k < 6; k++) {
        double back[3];
        matrix3_apply_transposed(s.body.axes, s.body.offset + 3 * k, back);
        for (int i = 0; i < 3; i++) assert_near(back[i] + s.body.centre[i], s.x[3 * k + i], 1e-14);
    }
    scene_end(&s);
}

static void masses_on_a_line_do_not_turn_about_it(void **unused)
{
    (void)unused;
    Scene s;
    double x[3][3] = {{0, 0, 0}, {0.1, 0.7, 0.3}, {0.2, 1.4, 0.6}}, mass[3] = {1, 1.7, 0.3};
    scene_begin(&s, 3, x, mass);
    int zeros = 0;
    for (int i = 0; i < 3; i++) zeros += s.body.inertia[i] == 0;
    assert_int_equal(zeros, 1);
    s.body.spin[0] = 1, s.body.spin[2] = 2;
    rigid_body_start(&s.body, &s.state);
    for (int n = 0; n < 1000; n++) scene_step(&s, 1e-3, NULL, NULL, NULL);
    for (int i = 0; i < 9; i++) assert_true(isfinite(s.x[i]));
    double along[3];
    vector3_subtract(s.x + 6, s.x, along);
    assert_near(vector3_norm(along), 2 * sqrt(0.59), 1e-12);
    assert_true(rigid_body_kinetic(&s.body, &s.state) > 0);
    scene_end(&s);
}

static void constant_force_fall_is_exact(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 2};
    asymmetric(&s, shift);
    rigid_body_start(&s.body, &s.state);
    const RigidField field = {.gravity = {0, 0, -9.81}};
    RigidWork work = {0};
    for (int n = 0; n < 1000; n++) scene_step(&s, 1e-3, &field, NULL, &work);
    assert_near(s.state.x[2], 2 - 0.5 * 9.81, 1e-11);
    assert_near(s.state.v[2], -9.81 * 0.9995, 1e-11);
    assert_near(s.state.spin[0], 0, 0);
    assert_near(work.gravity, rigid_body_kinetic(&s.body, &s.state), 1e-10);
    scene_end(&s);
}

/* Angular momentum to 1e-12 over 1e5 steps of tumbling, energy without drift, distances rigid. */
static void free_tumbling_keeps_momentum_and_energy(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {1, 2, 3};
    asymmetric(&s, shift);
    const double spin[3] = {3, 40, 5};
    memcpy(s.body.spin, spin, sizeof spin);
    s.body.velocity[0] = 1;
    rigid_body_start(&s.body, &s.state);
    double momentum[3], energy0 = s.state.kinetic, early = 0, late = 0;
    memcpy(momentum, s.state.momentum, sizeof momentum);
    enum { STEPS = 100000 };
    for (int n = 0; n < STEPS; n++) {
        scene_step(&s, 1e-4, NULL, NULL, NULL);
        double off = fabs(s.state.kinetic / energy0 - 1);
        if (n < STEPS / 10 && off > early) early = off;
        if (n >= STEPS - STEPS / 10 && off > late) late = off;
    }
    double size = vector3_norm(momentum);
    for (int i = 0; i < 3; i++) assert_true(fabs(s.state.momentum[i] - momentum[i]) <= 1e-12 * size);
    /* the angular momentum of the nodes themselves, from the positions before and after one more step */
    double nodal[3] = {0, 0, 0};
    scene_step(&s, 1e-4, NULL, NULL, NULL);
    for (int k = 0; k < 6; k++) {
        double arm[3], part[3], centre[3];
        for (int i = 0; i < 3; i++) {
            centre[i] = s.state.x[i] - 0.5e-4 * s.state.v[i];
            arm[i] = s.x[3 * k + i] - 0.5e-4 * s.v[3 * k + i] - centre[i];
        }
        vector3_cross(arm, s.v + 3 * k, part);
        for (int i = 0; i < 3; i++) nodal[i] += s.mass[k] * part[i];
    }
    for (int i = 0; i < 3; i++) assert_true(fabs(nodal[i] - momentum[i]) <= 1e-5 * size);
    assert_true(late < 1.5 * early + 1e-12);
    assert_true(early < 1e-4);
    assert_near(s.state.x[0], 1 + 1e-4 * (STEPS + 1), 1e-9);
    for (int a = 0; a < 6; a++) {
        double was[3], is[3];
        vector3_subtract(s.body.offset, s.body.offset + 3 * a, was);
        vector3_subtract(s.x, s.x + 3 * a, is);
        assert_near(vector3_norm(is), vector3_norm(was), 1e-12);
    }
    scene_end(&s);
}

/* Attitude after 0.5 s against Euler's equations integrated by Runge and Kutta's method with tiny steps. */
static double tumbling_error(double dt)
{
    Scene s;
    const double shift[3] = {0, 0, 0}, spin[3] = {3, 40, 5};
    asymmetric(&s, shift);
    memcpy(s.body.spin, spin, sizeof spin);
    rigid_body_start(&s.body, &s.state);
    int steps = (int)lround(0.5 / dt);
    for (int n = 0; n < steps; n++) scene_step(&s, dt, NULL, NULL, NULL);
    double q[4] = {1, 0, 0, 0}, w[3], axes[9], h = 1e-5;
    matrix3_apply(s.body.axes, spin, w);
    for (int n = 0; n < 50000; n++) {
        double k[4][3], sum[3], half[3];
        for (int stage = 0; stage < 4; stage++) {
            for (int i = 0; i < 3; i++) {
                double c = stage == 0 ? 0 : stage == 3 ? 1 : 0.5;
                half[i] = w[i] + (stage > 0 ? c * h * k[stage - 1][i] : 0);
            }
            body_space_rate(s.body.inertia, half, k[stage]);
        }
        for (int i = 0; i < 3; i++) sum[i] = (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]) / 6;
        /* spin in the middle of the step turns the attitude; global components by the middle attitude */
        double middle[3], global[3], turn[9], turned[4], dq[4], norm;
        for (int i = 0; i < 3; i++) middle[i] = w[i] + 0.5 * h * k[1][i];
        quaternion_matrix(q, turn);
        matrix3_apply_transposed(s.body.axes, middle, half);
        matrix3_apply(turn, half, global);
        norm = vector3_norm(global);
        dq[0] = cos(0.5 * h * norm);
        for (int i = 0; i < 3; i++) dq[1 + i] = sin(0.5 * h * norm) * global[i] / norm;
        quaternion_multiply(dq, q, turned);
        memcpy(q, turned, sizeof q);
        for (int i = 0; i < 3; i++) w[i] += h * sum[i];
    }
    quaternion_matrix(q, axes);
    double error = 0;
    for (int k = 0; k < 6; k++) {
        double start[3], expected[3];
        matrix3_apply_transposed(s.body.axes, s.body.offset + 3 * k, start);
        matrix3_apply(axes, start, expected);
        for (int i = 0; i < 3; i++) error = fmax(error, fabs(expected[i] - s.x[3 * k + i]));
    }
    scene_end(&s);
    return error;
}

static void tumbling_is_second_order(void **unused)
{
    (void)unused;
    double coarse = tumbling_error(2e-3), fine = tumbling_error(1e-3);
    assert_true(fine < 0.02);
    assert_true(coarse / fine > 3.5 && coarse / fine < 4.5);
}

static void spin_is_exact(double rate)
{
    Scene s;
    const double shift[3] = {0, 0, 0};
    asymmetric(&s, shift);
    double start[3], expected[3], along = 0;
    for (int i = 0; i < 3; i++) s.body.spin[i] = rate * s.body.axes[i]; /* the first axis */
    memcpy(start, s.x + 6, sizeof start);
    rigid_body_start(&s.body, &s.state);
    for (int n = 0; n < 100000; n++) scene_step(&s, 1e-4, NULL, NULL, NULL);
    double angle = 10 * rate, side[3];
    const double *axis = s.body.axes;
    along = vector3_dot(axis, start);
    vector3_cross(axis, start, side);
    for (int i = 0; i < 3; i++) {
        expected[i] = cos(angle) * (start[i] - along * axis[i]) + sin(angle) * side[i] + along * axis[i];
        assert_near(s.x[6 + i], expected[i], 1e-11);
    }
    for (int i = 0; i < 3; i++) assert_near(s.state.spin[i], rate * axis[i], 1e-11 * rate);
    scene_end(&s);
}

static void spin_about_a_principal_axis_is_exact(void **unused)
{
    (void)unused;
    spin_is_exact(100);
    spin_is_exact(0.5);
}

/* Backwards in time the midpoint rule retraces its steps. */
static void tumbling_is_reversible(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 0}, spin[3] = {3, 40, 5};
    asymmetric(&s, shift);
    memcpy(s.body.spin, spin, sizeof spin);
    rigid_body_start(&s.body, &s.state);
    double start[18];
    memcpy(start, s.x, sizeof start);
    for (int n = 0; n < 500; n++) scene_step(&s, 2e-3, NULL, NULL, NULL);
    for (int i = 0; i < 3; i++) {
        s.state.momentum[i] = -s.state.momentum[i];
        s.state.spin[i] = -s.state.spin[i];
    }
    for (int n = 0; n < 500; n++) scene_step(&s, 2e-3, NULL, NULL, NULL);
    for (int i = 0; i < 18; i++) assert_near(s.x[i], start[i], 1e-11);
    scene_end(&s);
}

/* A spin driven about z leaves the angular momentum about x and y alone. */
static void driven_spin_reacts_about_its_axis_only(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 0}, spin[3] = {3, 4, 5};
    asymmetric(&s, shift);
    memcpy(s.body.spin, spin, sizeof spin);
    rigid_body_start(&s.body, &s.state);
    const RigidPrescription p = {.count = 1, .item = {{true, {0, 0, 1}, 8}}};
    double momentum[3];
    memcpy(momentum, s.state.momentum, sizeof momentum);
    for (int n = 0; n < 1000; n++) {
        scene_step(&s, 1e-3, NULL, &p, NULL);
        assert_near(s.state.spin[2], 8, 1e-13);
    }
    assert_near(s.state.momentum[0], momentum[0], 1e-12);
    assert_near(s.state.momentum[1], momentum[1], 1e-12);
    scene_end(&s);
}

/* Output is taken at the full step, for unequal steps too. */
static void output_is_at_the_full_step(void **unused)
{
    (void)unused;
    Scene s;
    const double shift[3] = {0, 0, 0};
    asymmetric(&s, shift);
    for (int i = 0; i < 3; i++) s.body.spin[i] = 2 * s.body.axes[i];
    rigid_body_start(&s.body, &s.state);
    const RigidField field = {.gravity = {0, 0, -10}};
    for (int n = 0; n < 50; n++) {
        double at = s.time;
        scene_step(&s, n % 2 ? 3e-3 : 1e-3, &field, NULL, NULL);
        assert_near(s.state.output.v[2], -10 * at, 1e-12);
        assert_near(s.state.output.x[2], s.state.x[2] - s.last_step * s.state.v[2], 1e-13);
        double spin_energy = 0.5 * vector3_dot(s.state.momentum, s.state.spin);
        assert_near(s.state.kinetic, 0.5 * 7 * 100 * at * at + spin_energy, 1e-11);
        for (int i = 0; i < 3; i++) assert_near(s.state.output.spin[i], s.state.spin[i], 1e-13);
    }
    assert_near(s.state.output.rotation[0], cos(0.5 * 2 * (s.time - s.last_step)), 1e-13);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inertia_of_known_masses),      cmocka_unit_test(masses_on_a_line_do_not_turn_about_it),
        cmocka_unit_test(constant_force_fall_is_exact), cmocka_unit_test(free_tumbling_keeps_momentum_and_energy),
        cmocka_unit_test(tumbling_is_second_order),     cmocka_unit_test(spin_about_a_principal_axis_is_exact),
        cmocka_unit_test(tumbling_is_reversible),       cmocka_unit_test(driven_spin_reacts_about_its_axis_only),
        cmocka_unit_test(output_is_at_the_full_step),
    };
    return cmocka_run_group_tests_name("rigid body", tests, NULL, NULL);
}
