/* Rigid bodies: inertia, free motion, constraints, prescribed motion, the piston of case C1. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "solver/memory.h"
#include "solver/rigid_body.h"
#include "solver/vector3.h"

enum { MOST = 8 };

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) print_message("%.17g, expected %.17g\n", value, expected);
    assert_true(fabs(value - expected) <= tolerance);
}

/* A body with its nodes' arrays, run by itself. */
typedef struct Scene {
    RigidBody body;
    RigidState state;
    int32_t node[MOST];
    double x[3 * MOST], v[3 * MOST], f[3 * MOST], mass[MOST];
    double time, last_step;
} Scene;

static void scene_begin(Scene *s, int count, double (*x)[3], const double *mass)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memset(s, 0, sizeof *s);
    memcpy(s->x, x, (size_t)count * sizeof *x);
    memcpy(s->mass, mass, (size_t)count * sizeof *mass);
    for (int i = 0; i < count; i++) s->node[i] = i;
    s->body.node = s->node;
    s->body.node_count = count;
    memcpy(s->body.constraint_axes, identity, sizeof identity);
    assert_int_equal(rigid_body_build(&s->body, s->x, s->mass), 0);
}

static void scene_end(Scene *s)
{
    memory_free(s->body.offset);
}

static void scene_step(Scene *s, double dt, const RigidField *field, const RigidPrescription *prescription,
                       RigidWork *work)
{
    rigid_body_step(&s->body, &s->state, s->x, s->f, field, prescription, 0.5 * (s->last_step + dt), dt, s->v, work);
    for (int i = 0; i < 3 * s->body.node_count; i++) s->x[i] += dt * s->v[i];
    s->time += dt;
    s->last_step = dt;
}

/* Six masses on the axes: principal moments 2 (m2 b^2 + m3 c^2) and so on, all different, turned into a general frame.
 */
static void asymmetric(Scene *s, const double shift[3])
{
    static const double q[4] = {0.8, 0.4, 0.2, 0.4};
    double turn[9], x[6][3], mass[6] = {1, 1, 2, 2, 0.5, 0.5};
    static const double local[6][3] = {{0.3, 0, 0}, {-0.3, 0, 0}, {0, 0.2, 0}, {0, -0.2, 0}, {0, 0, 0.1}, {0, 0, -0.1}};
    quaternion_matrix(q, turn);
    for (int k = 0; k < 6; k++) {
        matrix3_apply(turn, local[k], x[k]);
        for (int i = 0; i < 3; i++) x[k][i] += shift[i];
    }
    scene_begin(s, 6, x, mass);
}

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
        cmocka_unit_test(inertia_of_known_masses),
        cmocka_unit_test(masses_on_a_line_do_not_turn_about_it),
        cmocka_unit_test(constant_force_fall_is_exact),
        cmocka_unit_test(free_tumbling_keeps_momentum_and_energy),
        cmocka_unit_test(tumbling_is_second_order),
        cmocka_unit_test(spin_about_a_principal_axis_is_exact),
        cmocka_unit_test(tumbling_is_reversible),
        cmocka_unit_test(driven_spin_reacts_about_its_axis_only),
        cmocka_unit_test(output_is_at_the_full_step),
        cmocka_unit_test(prescribed_angular_acceleration),
        cmocka_unit_test(constrained_lid_moves_along_z_only),
        cmocka_unit_test(hinge_turns_about_its_axis),
        cmocka_unit_test(prescribed_motion_is_met),
        cmocka_unit_test(damping_takes_energy_as_booked),
        cmocka_unit_test(piston_of_case_c1),
    };
    return cmocka_run_group_tests_name("rigid body", tests, NULL, NULL);
}
