/* Mass, centre and principal inertia of a rigid body from its nodes. Equations (M12) and (M13) of docs/theory.md. */
#include <stddef.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/rigid_body.h"
#include "solver/vector3.h"

/* Principal moments below this share of the largest count as zero: all mass on a line (or in a point). */
static const double VANISHING = 1e-10;

/* One Jacobi rotation of the symmetric matrix a in the plane (p, q), gathered in the rows of axes. */
static void jacobi_rotate(double a[9], double axes[9], int p, int q)
{
    double off = a[3 * p + q];
    if (off == 0) return;
    double theta = (a[4 * q] - a[4 * p]) / (2 * off);
    double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; k++) {
        double x = a[3 * k + p], y = a[3 * k + q];
        a[3 * k + p] = c * x - s * y;
        a[3 * k + q] = s * x + c * y;
    }
    for (int k = 0; k < 3; k++) {
        double x = a[3 * p + k], y = a[3 * q + k];
        a[3 * p + k] = c * x - s * y;
        a[3 * q + k] = s * x + c * y;
    }
    a[3 * p + q] = a[3 * q + p] = 0;
    for (int k = 0; k < 3; k++) {
        double x = axes[3 * p + k], y = axes[3 * q + k];
        axes[3 * p + k] = c * x - s * y;
        axes[3 * q + k] = s * x + c * y;
    }
}

/* Eigenvalues and eigenvectors (rows of axes) of the symmetric matrix a, which is destroyed. A product of rotations, so
 * the axes are right-handed. */
static void principal_axes(double a[9], double axes[9], double moments[3])
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(axes, identity, sizeof identity);
    double scale = fabs(a[0]) + fabs(a[4]) + fabs(a[8]);
    for (int sweep = 0; sweep < 30; sweep++) {
        if (fabs(a[1]) + fabs(a[2]) + fabs(a[5]) <= 1e-18 * scale) break;
        jacobi_rotate(a, axes, 0, 1);
        jacobi_rotate(a, axes, 0, 2);
        jacobi_rotate(a, axes, 1, 2);
    }
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        moments[i] = a[4 * i];
        if (moments[i] > largest) largest = moments[i];
    }
    for (int i = 0; i < 3; i++) {
        if (moments[i] <= VANISHING * largest) moments[i] = 0;
    }
}

static void sum_mass(RigidBody *body, const double *x, const double *mass)
{
    body->mass = 0;
    double moment[3] = {0, 0, 0};
    /* About the first node, so that a body far from the origin keeps its digits. */
    const double *base = x + 3 * (size_t)body->node[0];
    for (int k = 0; k < body->node_count; k++) {
        double m = mass[body->node[k]], r[3];
        vector3_subtract(x + 3 * (size_t)body->node[k], base, r);
        body->mass += m;
        for (int i = 0; i < 3; i++) moment[i] += m * r[i];
    }
    for (int i = 0; i < 3; i++) body->centre[i] = base[i] + (body->mass > 0 ? moment[i] / body->mass : 0);
}

static void place_nodes(RigidBody *body, const double *x)
{
    for (int k = 0; k < body->node_count; k++) {
        double r[3];
        vector3_subtract(x + 3 * (size_t)body->node[k], body->centre, r);
        matrix3_apply(body->axes, r, body->offset + 3 * (size_t)k);
    }
}

int rigid_body_build(RigidBody *body, const double *x, const double *mass)
{
    if (body->node_count <= 0) return 1;
    memory_free(body->offset);
    body->offset = memory_alloc(3 * (size_t)body->node_count, sizeof *body->offset);
    if (!body->offset) return -1;
    sum_mass(body, x, mass);
    if (!(body->mass > 0)) return 1;
    double tensor[9] = {0};
    for (int k = 0; k < body->node_count; k++) {
        double m = mass[body->node[k]], r[3];
        vector3_subtract(x + 3 * (size_t)body->node[k], body->centre, r);
        double square = vector3_dot(r, r);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) tensor[3 * i + j] += m * ((i == j ? square : 0) - r[i] * r[j]);
        }
    }
    principal_axes(tensor, body->axes, body->inertia);
    place_nodes(body, x);
    return 0;
}

int rigid_body_give_inertia(RigidBody *body, const double *x, double mass, const double centre[3],
                            const double tensor[9])
{
    double copy[9];
    memcpy(copy, tensor, sizeof copy);
    body->given = true;
    body->mass = mass;
    memcpy(body->centre, centre, sizeof body->centre);
    principal_axes(copy, body->axes, body->inertia);
    place_nodes(body, x);
    const double *moment = body->inertia;
    double sum = moment[0] + moment[1] + moment[2];
    for (int i = 0; i < 3; i++)
        if (copy[4 * i] < 0 || 2 * moment[i] > sum * (1 + 1e-9)) return 1;
    return 0;
}
