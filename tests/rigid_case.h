/* A rigid body with its nodes, run by itself, for the tests of rigid bodies. */
#ifndef BILLOW_TESTS_RIGID_CASE_H
#define BILLOW_TESTS_RIGID_CASE_H

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

static inline void assert_near(double value, double expected, double tolerance)
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

static inline void scene_begin(Scene *s, int count, double (*x)[3], const double *mass)
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

static inline void scene_end(Scene *s)
{
    memory_free(s->body.offset);
}

static inline void scene_step(Scene *s, double dt, const RigidField *field, const RigidPrescription *prescription,
                              RigidWork *work)
{
    rigid_body_step(&s->body, &s->state, s->x, s->f, field, prescription, 0.5 * (s->last_step + dt), dt, s->v, work);
    for (int i = 0; i < 3 * s->body.node_count; i++) s->x[i] += dt * s->v[i];
    s->time += dt;
    s->last_step = dt;
}

/* Six masses on the axes: principal moments 2 (m2 b^2 + m3 c^2) and so on, all different, turned into a general frame.
 */
static inline void asymmetric(Scene *s, const double shift[3])
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

#endif
