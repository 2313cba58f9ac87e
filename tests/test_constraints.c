/* Supports, prescribed motion and hanging nodes in the step. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "solver/rate_rows.h"
#include "solver/vector3.h"
#include "tests/motion_deck.h"

static const double IDENTITY[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* y = 3 t up to t = 1, then back to 1 at t = 2. */
static double roof_x[3] = {0, 1, 2}, roof_y[3] = {0, 3, 1}, roof_area[3] = {0, 1.5, 3.5};
static const Curve ROOF = {.count = 3, .x = roof_x, .y = roof_y, .area = roof_area};

static void rows_meet_oblique_conditions(void **unused)
{
    (void)unused;
    RateRows rows = {0};
    const double first[3] = {2, 0, 0}, second[3] = {1, 1, 0}, same[3] = {3, -1, 0};
    assert_true(rate_rows_add(&rows, first, 4));
    assert_true(rate_rows_add(&rows, second, 5));
    assert_false(rate_rows_add(&rows, same, 1));
    double v[3] = {9, 9, 9}, others[9];
    rate_rows_apply(&rows, v);
    assert_near(v[0], 2, 1e-15);
    assert_near(v[0] + v[1], 5, 1e-15);
    assert_near(v[2], 9, 0);
    rate_rows_complement(&rows, others);
    assert_near(fabs(others[2]), 1, 1e-15);
    RateRows line = {0};
    const double diagonal[3] = {1, 1, 1};
    rate_rows_add(&line, diagonal, 0);
    rate_rows_complement(&line, others);
    for (int k = 0; k < 2; k++) {
        assert_near(others[3 * k] + others[3 * k + 1] + others[3 * k + 2], 0, 1e-15);
        assert_near(vector3_dot(others + 3 * k, others + 3 * k), 1, 1e-15);
    }
    assert_near(vector3_dot(others, others + 3), 0, 1e-15);
}

static void supports_hold_in_their_frame_and_time(void **unused)
{
    (void)unused;
    const double half = sqrt(0.5);
    Support supports[3] = {{.node = 0, .fixed = {true, false, true}, .birth = 0, .death = 1e20},
                           {.node = 1,
                            .fixed = {true, false, false},
                            .local = true,
                            .birth = 0,
                            .death = 1e20,
                            .axes = {half, half, 0, -half, half, 0, 0, 0, 1}},
                           {.node = 2, .fixed = {true, true, true}, .birth = 1, .death = 2}};
    memcpy(supports[0].axes, IDENTITY, sizeof IDENTITY);
    memcpy(supports[2].axes, IDENTITY, sizeof IDENTITY);
    const Constraints c = {.support_count = 3, .supports = supports};
    const double x[9] = {0}, mass[3] = {1, 1, 1}, before[9] = {0};
    double v[9] = {1.1, 2, 3, 4, 2, 7, 1, 1, 1}, work = 0;
    constraints_apply(&c, NULL, 0.5, 0.1, 0.1, x, x, mass, before, v, &work);
    assert_true(v[0] == 0 && v[1] == 2 && v[2] == 0);
    assert_near(v[3], 1, 1e-15);
    assert_near(v[4], -1, 1e-15);
    assert_near(v[5], 7, 0);
    assert_true(v[6] == 1 && v[7] == 1 && v[8] == 1);
    constraints_apply(&c, NULL, 1.0, 0.1, 0.1, x, x, mass, before, v, &work);
    assert_true(v[6] == 0 && v[7] == 0 && v[8] == 0);
    v[6] = 5;
    constraints_apply(&c, NULL, 2.0, 0.1, 0.1, x, x, mass, before, v, NULL);
    assert_true(v[6] == 5);
    double start[9] = {1, 2, 3, 4, 2, 7, 1, 1, 1};
    constraints_start(&c, start);
    assert_true(start[0] == 0 && start[1] == 2 && start[2] == 0 && start[6] == 1);
    assert_near(start[3], 1, 1e-15);
}

/* A free node driven for 2 s with unequal steps; returns the largest gap between position and target at the step ends.
 */
static double drive(int vad, double birth, const double direction[3], bool only, double (*target)(double), double *out)
{
    PrescribedMotion motion = {.node = 0,
                               .rigid_body = -1,
                               .vad = vad,
                               .curve = 0,
                               .scale = 2,
                               .birth = birth,
                               .death = 1e28,
                               .only_direction = only};
    memcpy(motion.direction, direction, sizeof motion.direction);
    const Constraints c = {.motion_count = 1, .node_motion_count = 1, .motions = &motion};
    const double initial[3] = {5, 6, 7}, mass[1] = {3};
    double x[3] = {5, 6, 7}, v[3] = {0}, time = 0, last = 0, gap = 0, work = 0;
    for (int n = 0; n < 200; n++) {
        double dt = n % 3 == 0 ? 0.02 : 0.005, before[3];
        memcpy(before, v, sizeof before);
        v[2] += 0.5 * (last + dt) * 1; /* a force of its own across the motion */
        constraints_apply(&c, &ROOF, time, 0.5 * (last + dt), dt, x, initial, mass, before, v, &work);
        double kinetic = 0;
        for (int i = 0; i < 3; i++) {
            x[i] += dt * v[i];
            kinetic += 1.5 * v[i] * v[i];
        }
        time += dt, last = dt;
        double along = 0;
        for (int i = 0; i < 3; i++) along += direction[i] * (x[i] - initial[i]);
        gap = fmax(gap, fabs(along - target(time)));
        if (direction[2] == 0 && !only) assert_near(work, kinetic - 1.5 * v[2] * v[2], 1e-9);
        if (only) assert_near(v[2], 0, 1e-15);
    }
    memcpy(out, x, sizeof x);
    return gap;
}

static double roof_value(double t)
{
    return 2 * (t < 1 ? 3 * t : t < 2 ? 3 - 2 * (t - 1) : 1);
}

static double roof_late(double t) /* born at 0.5 (rather: at the first step end after it) */
{
    return t < 0.5 ? 0 : roof_value(t - 0.5);
}

static double roof_integral(double t)
{
    return 2 * (t < 1 ? 1.5 * t * t : t < 2 ? 1.5 + 3 * (t - 1) - (t - 1) * (t - 1) : 3.5 + (t - 2));
}

static double roof_twice(double t) /* the curve integrated twice from rest */
{
    if (t < 1) return t * t * t;
    double s = t - 1;
    return 1 + 3 * s + 2 * (1.5 * s * s - s * s * s / 3);
}

static void prescribed_motion_is_exact_at_time_points(void **unused)
{
    (void)unused;
    const double axis_x[3] = {1, 0, 0}, oblique[3] = {0.6, 0.8, 0};
    double x[3];
    assert_true(drive(2, 0, axis_x, false, roof_value, x) < 5e-15);
    assert_near(x[1], 6, 0);
    assert_true(drive(2, 0, oblique, false, roof_value, x) < 1e-14);
    assert_true(x[2] > 7.5); /* free across */
    assert_true(drive(2, 0, oblique, true, roof_value, x) < 1e-14);
    assert_near(x[2], 7, 1e-12);
    assert_true(drive(0, 0, axis_x, false, roof_integral, x) < 1e-12);
    /* acceleration: second order, the half step's velocity is exact */
    double gap = drive(1, 0, axis_x, false, roof_twice, x);
    assert_true(gap < 1e-3 && gap > 1e-9);
    /* a late birth counts from the birth: the first driven step begins at most one step after it */
    assert_true(drive(2, 0.5, axis_x, false, roof_late, x) < 2 * 3 * 0.02);
}

/* A node that drifts at 1 until its motion is born at 0.25 and is let go at 0.5. */
static void motion_counts_from_its_birth_to_its_death(void **unused)
{
    (void)unused;
    PrescribedMotion motion = {.node = 0,
                               .rigid_body = -1,
                               .vad = 2,
                               .direction = {1, 0, 0},
                               .curve = 0,
                               .scale = 1,
                               .birth = 0.25,
                               .death = 0.5};
    const Constraints c = {.motion_count = 1, .node_motion_count = 1, .motions = &motion};
    const double initial[3] = {0}, mass[1] = {1}, dt = 0.0625;
    double x[3] = {0}, v[3] = {1, 0, 0}, time = 0;
    for (int n = 0; n < 12; n++, time += dt) {
        double before[3];
        memcpy(before, v, sizeof before);
        if (time >= 0.5) v[0] = 7;
        constraints_apply(&c, &ROOF, time, dt, dt, x, initial, mass, before, v, NULL);
        x[0] += dt * v[0];
        double t = time + dt, expected = t <= 0.25 ? t : t <= 0.5 ? 0.25 + 3 * (t - 0.25) : 1 + 7 * (t - 0.5);
        assert_near(x[0], expected, 1e-14);
    }
}

/* Work on a spring and mass driven at its end by u(t) = roof: second order in dt. */
static double spring_work_error(double dt)
{
    PrescribedMotion motion = {
        .node = 0, .rigid_body = -1, .vad = 2, .direction = {1, 0, 0}, .curve = 0, .scale = 1, .death = 1e28};
    const Constraints c = {.motion_count = 1, .node_motion_count = 1, .motions = &motion};
    const double initial[3] = {0}, mass[1] = {2};
    double x[3] = {0}, v[3] = {0}, time = 0, last = 0, work = 0;
    /* the bent ramp: u = 0.75 t^2 on fine points, so that the motion is smooth */
    static double px[1001], py[1001], pa[1001];
    for (int i = 0; i <= 1000; i++) {
        px[i] = i * 1e-3;
        py[i] = 0.75 * px[i] * px[i];
        pa[i] = i ? pa[i - 1] + 0.5 * (py[i] + py[i - 1]) * 1e-3 : 0;
    }
    const Curve curve = {.count = 1001, .x = px, .y = py, .area = pa};
    int steps = (int)lround(1 / dt);
    for (int n = 0; n < steps; n++) {
        double before[3], dt_mean = 0.5 * (last + dt);
        memcpy(before, v, sizeof before);
        v[0] += -50 * x[0] / mass[0] * dt_mean;
        constraints_apply(&c, &curve, time, dt_mean, dt, x, initial, mass, before, v, &work);
        x[0] += dt * v[0];
        time += dt, last = dt;
    }
    /* up to the half step before t = 1: kinetic energy there and the spring's energy, its forces at t_n on mean
     * velocities */
    double t = 1 - 0.5 * dt, u = 0.75 * t * t, speed = 1.5 * t;
    return fabs(work - (0.5 * 2 * speed * speed + 0.5 * 50 * u * u));
}

static void reaction_work_is_second_order(void **unused)
{
    (void)unused;
    double coarse = spring_work_error(1.0 / 100), fine = spring_work_error(1.0 / 200);
    assert_true(fine < 1e-3);
    assert_true(coarse / fine > 3.5 && coarse / fine < 4.5);
}

static void motion_goes_before_support(void **unused)
{
    (void)unused;
    PrescribedMotion motion = {
        .node = 0, .rigid_body = -1, .vad = 0, .direction = {0, 0, 1}, .curve = 0, .scale = 1, .death = 1e28};
    Support support = {.node = 0, .fixed = {true, true, true}, .death = 1e20};
    memcpy(support.axes, IDENTITY, sizeof IDENTITY);
    const Constraints c = {
        .support_count = 1, .supports = &support, .motion_count = 1, .node_motion_count = 1, .motions = &motion};
    const double zero[3] = {0}, mass[1] = {1};
    double v[3] = {7, 8, 9};
    constraints_apply(&c, &ROOF, 0.2, 0.1, 0.1, zero, zero, mass, zero, v, NULL);
    assert_true(v[0] == 0 && v[1] == 0);
    assert_near(v[2], 0.75, 1e-15);
}

/* Node 2 hangs between 0 and 1, node 3 between 2 and 1. */
static void hanging_chain_folds_and_follows(void **unused)
{
    (void)unused;
    HangingNode hanging[2] = {{2, {0, 1}}, {3, {2, 1}}};
    const Constraints c = {.hanging_count = 2, .hanging = hanging};
    double f[12] = {0}, mass[4] = {1, 1, 4, 8}, v[12] = {0};
    for (int i = 0; i < 12; i++) f[i] = i + 1, v[i] = 0.1 * i * i;
    double raw[12], power = 0;
    memcpy(raw, f, sizeof f);
    constraints_place_hanging(&c, v);
    for (int i = 0; i < 3; i++) {
        assert_near(v[6 + i], 0.5 * (v[i] + v[3 + i]), 1e-15);
        assert_near(v[9 + i], 0.5 * (v[6 + i] + v[3 + i]), 1e-15);
    }
    for (int i = 0; i < 12; i++) power += raw[i] * v[i];
    constraints_fold_forces(&c, f);
    double folded = 0;
    for (int i = 0; i < 6; i++) folded += f[i] * v[i];
    for (int i = 6; i < 12; i++) assert_true(f[i] == 0);
    assert_near(folded, power, 1e-13 * fabs(power));
    constraints_fold_mass(&c, mass);
    assert_true(mass[0] == 1 + 4 && mass[1] == 1 + 4 + 4 && mass[2] == 0 && mass[3] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_meet_oblique_conditions),
        cmocka_unit_test(supports_hold_in_their_frame_and_time),
        cmocka_unit_test(prescribed_motion_is_exact_at_time_points),
        cmocka_unit_test(motion_counts_from_its_birth_to_its_death),
        cmocka_unit_test(reaction_work_is_second_order),
        cmocka_unit_test(motion_goes_before_support),
        cmocka_unit_test(hanging_chain_folds_and_follows),
    };
    return cmocka_run_group_tests_name("constraints", tests, NULL, NULL);
}
