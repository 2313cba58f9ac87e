/* Motion of rigid bodies: central differences of the centre, Lie midpoint rule of the rotation.
 * Equations (M14) to (M21) of docs/theory.md. */
#include "solver/rigid_body.h"

#include <stddef.h>
#include <string.h>

#include "solver/elementary.h"
#include "solver/rate_rows.h"
#include "solver/vector3.h"

enum { MIDPOINT_ITERATIONS = 60 };

/* Quaternion of the rotation by |w| dt about w. */
static void rotation_quaternion(const double w[3], double dt, double q[4])
{
    double half = 0.5 * dt * vector3_norm(w);
    double sinc = half < 1e-4 ? 1 - half * half / 6 : elementary_sin(half) / half;
    q[0] = elementary_cos(half);
    for (int i = 0; i < 3; i++) q[1 + i] = 0.5 * dt * sinc * w[i];
}

/* Columns of out: the body's principal axes now, in global components, for the rotation q since time 0. */
static void current_axes(const RigidBody *body, const double q[4], double out[9])
{
    double turn[9];
    quaternion_matrix(q, turn);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) out[3 * i + j] = vector3_dot(turn + 3 * i, body->axes + 3 * j);
    }
}

/* w = B I^-1 B^T L; directions without inertia do not turn. */
static void spin_of_momentum(const RigidBody *body, const double axes[9], const double momentum[3], double spin[3])
{
    double local[3];
    matrix3_apply_transposed(axes, momentum, local);
    for (int i = 0; i < 3; i++) local[i] = body->inertia[i] > 0 ? local[i] / body->inertia[i] : 0;
    matrix3_apply(axes, local, spin);
}

void rigid_body_spin_of(const RigidBody *body, const RigidState *state, const double momentum[3], double spin[3])
{
    double axes[9];
    current_axes(body, state->rotation, axes);
    spin_of_momentum(body, axes, momentum, spin);
}

/* L = B I B^T w. */
static void momentum_of_spin(const RigidBody *body, const double axes[9], const double spin[3], double momentum[3])
{
    double local[3];
    matrix3_apply_transposed(axes, spin, local);
    for (int i = 0; i < 3; i++) local[i] *= body->inertia[i];
    matrix3_apply(axes, local, momentum);
}

/* Spin that meets the rows and has, in the directions left free, the momentum given (M18). */
static void constrained_spin(const RigidBody *body, const RateRows *rows, const double axes[9],
                             const double momentum[3], double spin[3])
{
    double others[9], carried[3] = {0, 0, 0}, image[3];
    int count = 3 - rows->count;
    rate_rows_complement(rows, others);
    rate_rows_apply(rows, carried);
    momentum_of_spin(body, axes, carried, image);
    double matrix[2][2], right[2], free_rate[2] = {0, 0};
    for (int i = 0; i < count; i++) {
        double product[3];
        momentum_of_spin(body, axes, others + 3 * i, product);
        for (int j = 0; j < count; j++) matrix[i][j] = vector3_dot(product, others + 3 * j);
        right[i] = vector3_dot(others + 3 * i, momentum) - vector3_dot(others + 3 * i, image);
    }
    double least = 1e-12 * (body->inertia[0] + body->inertia[1] + body->inertia[2]);
    if (count == 2) {
        double first = matrix[0][0], factor = first > least ? matrix[1][0] / first : 0;
        double second = matrix[1][1] - factor * matrix[0][1];
        free_rate[1] = second > least ? (right[1] - factor * right[0]) / second : 0;
        free_rate[0] = first > least ? (right[0] - matrix[0][1] * free_rate[1]) / first : 0;
    } else if (count == 1) {
        free_rate[0] = matrix[0][0] > least ? right[0] / matrix[0][0] : 0;
    }
    for (int i = 0; i < 3; i++) {
        spin[i] = carried[i];
        for (int j = 0; j < count; j++) spin[i] += free_rate[j] * others[3 * j + i];
    }
}

static void add_rows(const RigidBody *body, const RigidPrescription *prescription, bool rotation, RateRows *rows)
{
    for (int k = 0; prescription && k < prescription->count; k++) {
        if (prescription->item[k].rotation == rotation)
            rate_rows_add(rows, prescription->item[k].direction, prescription->item[k].rate);
    }
    const bool *fixed = rotation ? body->fix_rotation : body->fix_translation;
    for (int i = 0; i < 3; i++) {
        if (fixed[i]) rate_rows_add(rows, body->constraint_axes + 3 * i, 0);
    }
}

/* Half-step value after a step of the linear law y' = rate - d y, damping taken at the middle (M15). */
static double damped(double before, double rate, double d, double dt)
{
    return ((1 - 0.5 * d * dt) * before + dt * rate) / (1 + 0.5 * d * dt);
}

void rigid_body_start(const RigidBody *body, RigidState *state)
{
    memset(state, 0, sizeof *state);
    memcpy(state->x, body->centre, sizeof state->x);
    state->rotation[0] = 1;
    RateRows rows = {0};
    memcpy(state->v, body->velocity, sizeof state->v);
    add_rows(body, NULL, false, &rows);
    rate_rows_apply(&rows, state->v);
    double axes[9], momentum[3];
    rows.count = 0;
    add_rows(body, NULL, true, &rows);
    current_axes(body, state->rotation, axes);
    momentum_of_spin(body, axes, body->spin, momentum);
    if (rows.count > 0) {
        memcpy(state->spin, body->spin, sizeof state->spin);
        rate_rows_apply(&rows, state->spin);
    } else {
        spin_of_momentum(body, axes, momentum, state->spin);
    }
    momentum_of_spin(body, axes, state->spin, state->momentum);
    state->kinetic = rigid_body_kinetic(body, state);
    memcpy(state->output.x, state->x, sizeof state->x);
    memcpy(state->output.v, state->v, sizeof state->v);
    memcpy(state->output.rotation, state->rotation, sizeof state->rotation);
    memcpy(state->output.spin, state->spin, sizeof state->spin);
}

double rigid_body_kinetic(const RigidBody *body, const RigidState *state)
{
    return 0.5 * (body->mass * vector3_dot(state->v, state->v) + vector3_dot(state->spin, state->momentum));
}

void rigid_body_prescribe(const Constraints *constraints, int index, const RigidBody *body, const RigidState *state,
                          const Curve *curves, double time, double dt_mean, double dt_next,
                          RigidPrescription *prescription)
{
    prescription->count = 0;
    for (int m = constraints->node_motion_count; m < constraints->motion_count; m++) {
        const PrescribedMotion *motion = &constraints->motions[m];
        if (motion->rigid_body != index || prescription->count == BILLOW_RIGID_RATES) continue;
        double moved[3], rate;
        vector3_subtract(state->x, body->centre, moved);
        double before = vector3_dot(motion->direction, motion->rotation ? state->spin : state->v);
        if (!constraints_motion_rate(motion, curves, time, dt_mean, dt_next, before,
                                     vector3_dot(motion->direction, moved), &rate))
            continue;
        int k = prescription->count++;
        prescription->item[k].rotation = motion->rotation;
        prescription->item[k].rate = rate;
        memcpy(prescription->item[k].direction, motion->direction, sizeof motion->direction);
    }
}

/* Resultants about the centre of the nodal forces and of what acts beside them. */
static void gather(const RigidBody *body, RigidState *state, const RigidField *field, const double *x, const double *f)
{
    double force[3], moment[3];
    memcpy(force, field->force, sizeof force);
    memcpy(moment, field->moment, sizeof moment);
    for (int k = 0; k < body->node_count; k++) {
        const double *node_force = f + 3 * (size_t)body->node[k];
        double arm[3], part[3];
        vector3_subtract(x + 3 * (size_t)body->node[k], state->x, arm);
        vector3_cross(arm, node_force, part);
        for (int i = 0; i < 3; i++) {
            force[i] += node_force[i];
            moment[i] += part[i];
        }
    }
    memcpy(state->force, force, sizeof force);
    memcpy(state->moment, moment, sizeof moment);
}

/* at_start: before it nothing moved, so that forces are counted with the velocity after it (eq. L4a). */
static void step_translation(const RigidBody *body, RigidState *state, const RigidField *field, const RateRows *rows,
                             double dt_mean, bool at_start, RigidWork *work)
{
    double mean[3];
    for (int i = 0; i < 3; i++) {
        double rate = state->force[i] / body->mass + field->gravity[i];
        mean[i] = damped(state->v[i], rate, field->damping[i], dt_mean);
    }
    double before[3], unconstrained[3];
    memcpy(before, state->v, sizeof before);
    memcpy(unconstrained, mean, sizeof mean);
    memcpy(state->v, mean, sizeof mean);
    rate_rows_apply(rows, state->v);
    for (int i = 0; i < 3; i++) {
        double v_mean = 0.5 * (before[i] + state->v[i]);
        state->a[i] = (state->v[i] - before[i]) / dt_mean;
        double drag = 0.5 * body->mass * field->damping[i] * (before[i] + unconstrained[i]) * dt_mean;
        work->forces += state->force[i] * v_mean * dt_mean;
        work->gravity += body->mass * field->gravity[i] * v_mean * dt_mean;
        work->damping += drag * v_mean;
        double impulse = body->mass * (state->v[i] - unconstrained[i]);
        work->reaction += impulse * v_mean;
        if (at_start && impulse != 0.0) work->reaction -= state->force[i] * dt_mean * 0.5 * (state->v[i] - before[i]);
    }
}

/* Solves the midpoint rule (M16), (M17): on return state->spin and ->momentum hold the new half step, half_axes the
 * principal axes in the middle of the step. */
static void solve_midpoint(const RigidBody *body, RigidState *state, const RateRows *rows, const double momentum[3],
                           double dt_next, double half_axes[9])
{
    double spin[3];
    memcpy(spin, state->spin, sizeof spin);
    for (int iteration = 0; iteration < MIDPOINT_ITERATIONS; iteration++) {
        double turn[4], middle[4], next[3], change = 0, size = 0;
        rotation_quaternion(spin, 0.5 * dt_next, turn);
        quaternion_multiply(turn, state->rotation, middle);
        current_axes(body, middle, half_axes);
        if (rows->count > 0) {
            constrained_spin(body, rows, half_axes, momentum, next);
        } else {
            spin_of_momentum(body, half_axes, momentum, next);
        }
        for (int i = 0; i < 3; i++) {
            double moved = fabs(next[i] - spin[i]);
            if (moved > change) change = moved;
            if (fabs(next[i]) > size) size = fabs(next[i]);
        }
        memcpy(spin, next, sizeof spin);
        if (change <= 1e-15 * size) break;
    }
    memcpy(state->spin, spin, sizeof spin);
    bool keeps = rows->count == 0 && body->inertia[0] > 0 && body->inertia[1] > 0 && body->inertia[2] > 0;
    if (keeps) {
        memcpy(state->momentum, momentum, sizeof state->momentum);
    } else {
        momentum_of_spin(body, half_axes, spin, state->momentum);
    }
}

/* Motion and kinetic energy at t_n, the half steps weighted by their distance from it (M20). */
static void keep_full_step(const RigidBody *body, RigidState *state, const double v_before[3],
                           const double momentum_before[3], double dt_mean, double dt_next)
{
    RigidOutput *out = &state->output;
    double share = 0.5 * (2 * dt_mean - dt_next) / dt_mean, axes[9], momentum[3];
    memcpy(out->x, state->x, sizeof out->x);
    memcpy(out->rotation, state->rotation, sizeof out->rotation);
    for (int i = 0; i < 3; i++) {
        out->v[i] = v_before[i] + share * (state->v[i] - v_before[i]);
        momentum[i] = momentum_before[i] + share * (state->momentum[i] - momentum_before[i]);
    }
    current_axes(body, state->rotation, axes);
    spin_of_momentum(body, axes, momentum, out->spin);
    state->kinetic = 0.5 * (body->mass * vector3_dot(out->v, out->v) + vector3_dot(momentum, out->spin));
}

static void step_rotation(const RigidBody *body, RigidState *state, const RigidField *field, const RateRows *rows,
                          double dt_mean, double dt_next, RigidWork *work)
{
    const bool at_start = !(2 * dt_mean - dt_next > 0);
    double before[3], spin_before[3], unconstrained[3], half_axes[9];
    memcpy(before, state->momentum, sizeof before);
    memcpy(spin_before, state->spin, sizeof spin_before);
    for (int i = 0; i < 3; i++) {
        unconstrained[i] = damped(before[i], state->moment[i], field->damping[3 + i], dt_mean);
    }
    solve_midpoint(body, state, rows, unconstrained, dt_next, half_axes);
    for (int i = 0; i < 3; i++) {
        double spin_mean = 0.5 * (spin_before[i] + state->spin[i]);
        state->alpha[i] = (state->spin[i] - spin_before[i]) / dt_mean;
        work->forces += state->moment[i] * spin_mean * dt_mean;
        work->damping += 0.5 * field->damping[3 + i] * (before[i] + unconstrained[i]) * dt_mean * spin_mean;
        double impulse = state->momentum[i] - unconstrained[i];
        work->reaction += impulse * spin_mean;
        if (at_start && rows->count > 0)
            work->reaction -= state->moment[i] * dt_mean * 0.5 * (state->spin[i] - spin_before[i]);
    }
}

/* Moves centre and rotation over dt_next and gives the nodes the chord's velocity (M21). The chord is formed from the
 * rotation of this step alone, so that a small step loses no digits; what rounding has left x off the rigid place by is
 * taken back when it exceeds the noise of the last digits. */
static void move_nodes(const RigidBody *body, RigidState *state, const double *x, double dt_next, double *v)
{
    double turn[4], next[4], axes[9];
    double old_centre[3];
    memcpy(old_centre, state->x, sizeof old_centre);
    rotation_quaternion(state->spin, dt_next, turn);
    current_axes(body, state->rotation, axes);
    quaternion_multiply(turn, state->rotation, next);
    double norm = sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2] + next[3] * next[3]);
    for (int i = 0; i < 4; i++) state->rotation[i] = next[i] / norm;
    for (int i = 0; i < 3; i++) state->x[i] += dt_next * state->v[i];
    for (int k = 0; k < body->node_count; k++) {
        double arm[3], across[3], twice[3];
        size_t n = 3 * (size_t)body->node[k];
        matrix3_apply(axes, body->offset + 3 * (size_t)k, arm);
        /* R r - r = 2 q_w (q x r) + 2 q x (q x r) */
        vector3_cross(turn + 1, arm, across);
        vector3_cross(turn + 1, across, twice);
        double size = fabs(arm[0]) + fabs(arm[1]) + fabs(arm[2]);
        for (int i = 0; i < 3; i++) {
            double off = (old_centre[i] + arm[i]) - x[n + (size_t)i];
            if (fabs(off) <= 1e-14 * (fabs(old_centre[i]) + size)) off = 0;
            v[n + (size_t)i] = state->v[i] + (2 * (turn[0] * across[i] + twice[i]) + off) / dt_next;
        }
    }
}

void rigid_body_step(const RigidBody *body, RigidState *state, const double *x, const double *f,
                     const RigidField *field, const RigidPrescription *prescription, double dt_mean, double dt_next,
                     double *v, RigidWork *work)
{
    static const RigidField nothing = {0};
    if (!field) field = &nothing;
    RigidWork done = {0};
    RateRows translation = {0}, rotation = {0};
    double v_before[3], momentum_before[3];
    add_rows(body, prescription, false, &translation);
    add_rows(body, prescription, true, &rotation);
    memcpy(v_before, state->v, sizeof v_before);
    memcpy(momentum_before, state->momentum, sizeof momentum_before);
    gather(body, state, field, x, f);
    step_translation(body, state, field, &translation, dt_mean, !(2 * dt_mean - dt_next > 0), &done);
    step_rotation(body, state, field, &rotation, dt_mean, dt_next, &done);
    keep_full_step(body, state, v_before, momentum_before, dt_mean, dt_next);
    move_nodes(body, state, x, dt_next, v);
    if (work) {
        work->reaction += done.reaction;
        work->gravity += done.gravity;
        work->damping += done.damping;
        work->forces += done.forces;
    }
}
