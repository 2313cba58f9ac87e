/* One triangle under a law: its constants, the exact largest frequency of its tangent stiffness. */
#ifndef BILLOW_TESTS_LAW_TRIANGLE_H
#define BILLOW_TESTS_LAW_TRIANGLE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "elements/geometry.h"
#include "elements/kernels.h"
#include "tests/law_cases.h"

static uint64_t random_state = 1;
static inline double random_between(double low, double high)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * ((double)(random_state >> 11) * 0x1p-53);
}

/* C of principal stretches at an angle. */
static inline void metric(double l1, double l2, double angle, double c[3])
{
    double co = cos(angle), si = sin(angle), a = l1 * l1, b = l2 * l2;
    c[0] = a * co * co + b * si * si;
    c[1] = a * si * si + b * co * co;
    c[2] = (a - b) * co * si;
}

static inline LawPoint at(const LawCase *l, const double c[3], double *history)
{
    LawPoint p;
    law_point(l->kind, &l->law, c, history, 1, 0, 0, &p);
    return p;
}

/* A triangle of a shape with its constants. */
typedef struct Triangle {
    double x[9], m[4], weight, rate, stress_rate, mass;
    double lane[32 * BILLOW_LANES]; /* as in a block of one */
} Triangle;

static inline void make_triangle(const LawCase *l, Triangle *t)
{
    double *lane = t->lane;
    memset(lane, 0, sizeof t->lane);
    const double x[9] = {0, 0, 0, random_between(0.5, 1.5), 0, 0, random_between(-0.5, 1.5), random_between(0.2, 1.5),
                         0};
    memcpy(t->x, x, sizeof x);
    t->mass = 0.4;
    ElementInput input = {.kind = ELEMENT_TRIANGLE, .x = x, .thickness = 1e-3, .mass = t->mass, .law = &l->law};
    input.axis.angle = random_between(0, 6);
    assert_int_equal(geometry_fill(&input, 1, lane), GEOMETRY_OK);
    for (int i = 0; i < 4; i++) t->m[i] = lane[(GEOMETRY_M11 + i) * BILLOW_LANES];
    t->weight = lane[GEOMETRY_WEIGHT * BILLOW_LANES];
    t->rate = lane[(GEOMETRY_POINT_SIZE + GEOMETRY_RATE) * BILLOW_LANES];
    t->stress_rate = lane[(GEOMETRY_POINT_SIZE + GEOMETRY_STRESS_RATE) * BILLOW_LANES];
}

/* C, and F (3 x 2) in material axes, of corners y. */
static inline void deform(const Triangle *t, const double *y, double f[3][2], double c[3])
{
    for (int k = 0; k < 3; k++) {
        double e1 = y[3 + k] - y[k], e2 = y[6 + k] - y[k];
        f[k][0] = t->m[0] * e1 + t->m[2] * e2;
        f[k][1] = t->m[1] * e1 + t->m[3] * e2;
    }
    c[0] = c[1] = c[2] = 0;
    for (int k = 0; k < 3; k++) {
        c[0] += f[k][0] * f[k][0];
        c[1] += f[k][1] * f[k][1];
        c[2] += f[k][0] * f[k][1];
    }
}

/* Gradient of the energy by the corners. history is not changed. */
static inline void gradient(const LawCase *l, const Triangle *t, const double *y, const double *history, double *out)
{
    double f[3][2], c[3], memory[MEMORY_POINT_SIZE];
    memcpy(memory, history, sizeof memory);
    deform(t, y, f, c);
    LawPoint p = at(l, c, memory);
    for (int k = 0; k < 3; k++) {
        double p1 = f[k][0] * p.stress[0] + f[k][1] * p.stress[2], p2 = f[k][0] * p.stress[2] + f[k][1] * p.stress[1];
        double n1 = t->weight * (p1 * t->m[0] + p2 * t->m[1]), n2 = t->weight * (p1 * t->m[2] + p2 * t->m[3]);
        out[k] = -(n1 + n2);
        out[3 + k] = n1;
        out[6 + k] = n2;
    }
}

/* Largest eigenvalue of the tangent stiffness by differences, over the mass of a corner. */
static inline double true_rate(const LawCase *l, const Triangle *t, const double *y, const double *history)
{
    double k[81], up[9], down[9], moved[9];
    const double h = 1e-7;
    for (int i = 0; i < 9; i++) {
        memcpy(moved, y, sizeof moved);
        moved[i] = y[i] + h;
        gradient(l, t, moved, history, up);
        moved[i] = y[i] - h;
        gradient(l, t, moved, history, down);
        for (int j = 0; j < 9; j++) k[9 * j + i] = (up[j] - down[j]) / (2 * h);
    }
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < i; j++) k[9 * i + j] = k[9 * j + i] = 0.5 * (k[9 * i + j] + k[9 * j + i]);
    return geometry_largest_eigenvalue(9, k) * 3 / t->mass;
}

typedef struct Waypoint {
    double log1, log2, angle;
} Waypoint;

static inline void corners_at(const Triangle *t, Waypoint p, double *y)
{
    double l1 = exp(p.log1), l2 = exp(p.log2), c = cos(p.angle), s = sin(p.angle);
    for (int a = 0; a < 3; a++) {
        double u = t->x[3 * a], v = t->x[3 * a + 1], along = l1 * (c * u + s * v), across = l2 * (c * v - s * u);
        y[3 * a] = c * along - s * across; /* U, then a rotation about x by a fixed angle */
        y[3 * a + 1] = 0.8 * (s * along + c * across);
        y[3 * a + 2] = 0.6 * (s * along + c * across);
    }
}

#endif
