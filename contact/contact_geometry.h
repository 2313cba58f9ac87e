/* Closest point of a triangle; where lines cross. Shared by the loop and the checks. */
#ifndef BILLOW_CONTACT_GEOMETRY_H
#define BILLOW_CONTACT_GEOMETRY_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "solver/vector3.h"

/* A foot nearer to an edge than this share of the triangle lies on it: rounding must not put it into two triangles. */
#define ON_EDGE 1e-9

/* Edges at a smaller angle (sine squared) are as good as parallel: their nodes do the work. */
#define PARALLEL 1e-3

/* Closest point of one triangle to a node. */
typedef struct ClosestPoint {
    int32_t corner[3];
    double weight[3]; /* of the corners at the closest point */
    double normal[3]; /* unit normal by winding */
    double toward[3]; /* from the closest point to the node */
    double height;    /* signed distance from the triangle's plane */
    double distance;  /* from the closest point */
    int feature;      /* bits: corners that hold the closest point; 7: inside */
} ClosestPoint;

/* A point at weights (1 - u - v, u, v): squared distance from r, all relative to corner 0. */
static inline double square_distance(const double a[3], const double b[3], const double r[3], double u, double v)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double d = r[k] - u * a[k] - v * b[k];
        sum += d * d;
    }
    return sum;
}

/* A place on an edge, ends included; rounding must not put a corner onto an edge. */
static inline double on_edge(double s)
{
    return s < ON_EDGE ? 0.0 : s > 1.0 - ON_EDGE ? 1.0 : s;
}

/* Metric of a triangle and the node's components: a = x1 - x0, b = x2 - x0, r = x - x0. */
typedef struct TriangleMetric {
    double aa, ab, bb, ar, br;
} TriangleMetric;

/* The closest point of a triangle whose plane's foot lies outside: on one of the edges that it is beyond. */
static inline void closest_outside(ClosestPoint *f, const TriangleMetric *m, const double a[3], const double b[3],
                                   const double r[3])
{
    double best = INFINITY, beyond[3] = {f->weight[0], f->weight[1], f->weight[2]};
    for (int k = 0; k < 3; k++) {
        if (beyond[k] > ON_EDGE) continue;
        double u, v, s;
        if (k == 0) { /* corner 1 to corner 2 */
            s = on_edge((m->br - m->ar + m->aa - m->ab) / (m->aa - 2.0 * m->ab + m->bb));
            u = 1.0 - s;
            v = s;
        } else if (k == 1) { /* corner 0 to corner 2 */
            s = on_edge(m->br / m->bb);
            u = 0.0;
            v = s;
        } else { /* corner 0 to corner 1 */
            s = on_edge(m->ar / m->aa);
            u = s;
            v = 0.0;
        }
        double square = square_distance(a, b, r, u, v);
        if (!(square < best)) continue;
        best = square;
        f->weight[0] = k == 0 ? 0.0 : 1.0 - s;
        f->weight[1] = u;
        f->weight[2] = v;
        int from = k == 0 ? 1 : 0, to = k == 2 ? 1 : 2;
        f->feature = (s < 1.0 ? 1 << from : 0) | (s > 0.0 ? 1 << to : 0);
    }
}

/* Geometry of a node at x and a triangle. False if it is farther than reach; *bound is then less than its distance. */
static inline bool closest_point(ClosestPoint *f, const double *x, const double *positions, double reach, double *bound)
{
    const double *corner[3];
    double a[3], b[3], r[3], n[3];
    for (int k = 0; k < 3; k++) corner[k] = positions + 3 * (ptrdiff_t)f->corner[k];
    for (int k = 0; k < 3; k++) {
        a[k] = corner[1][k] - corner[0][k];
        b[k] = corner[2][k] - corner[0][k];
        r[k] = x[k] - corner[0][k];
    }
    vector3_cross(a, b, n);
    double square = vector3_dot(n, n), height = vector3_dot(n, r);
    *bound = reach;
    if (!(square > 0.0)) return false; /* a triangle without area is left to its neighbours */
    double length = 1.0 / sqrt(square), inverse = length * length;
    f->height = height * length;
    *bound = fabs(f->height);
    if (*bound > reach) return false;
    TriangleMetric m = {vector3_dot(a, a), vector3_dot(a, b), vector3_dot(b, b), vector3_dot(a, r), vector3_dot(b, r)};
    f->weight[1] = (m.bb * m.ar - m.ab * m.br) * inverse;
    f->weight[2] = (m.aa * m.br - m.ab * m.ar) * inverse;
    f->weight[0] = 1.0 - f->weight[1] - f->weight[2];
    /* the foot's distance beyond an edge: weight x altitude */
    double cc = m.aa - 2.0 * m.ab + m.bb, over = 0.0, edge[3] = {cc, m.bb, m.aa};
    for (int k = 0; k < 3; k++) {
        double w = f->weight[k] < 0.0 ? f->weight[k] * f->weight[k] * square / edge[k] : 0.0;
        over = w > over ? w : over;
    }
    *bound = sqrt(f->height * f->height + over);
    if (*bound > reach) return false;
    f->feature = 7;
    if (!(f->weight[0] > ON_EDGE && f->weight[1] > ON_EDGE && f->weight[2] > ON_EDGE)) closest_outside(f, &m, a, b, r);
    double distance = 0.0;
    for (int k = 0; k < 3; k++) {
        f->normal[k] = n[k] * length;
        f->toward[k] = r[k] - f->weight[1] * a[k] - f->weight[2] * b[k];
        distance += f->toward[k] * f->toward[k];
    }
    f->distance = f->feature == 7 ? fabs(f->height) : sqrt(distance);
    *bound = f->distance;
    return f->distance <= reach;
}

#endif
