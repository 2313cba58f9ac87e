/* One point of an element in its reference: from corners to the natural gradients M in material axes (docs/theory.md,
 * Elements, Reference geometry). */
#include "elements/geometry_point.h"

#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/elementary.h"
#include "solver/vector3.h"

int point_number(ElementKind kind)
{
    return kind == ELEMENT_QUAD_FULL ? 4 : 1;
}

void point_tangents(const ElementInput *input, int point, double *t1, double *t2)
{
    const double *x = input->x;
    if (input->kind == ELEMENT_TRIANGLE) {
        for (int k = 0; k < 3; k++) {
            t1[k] = x[3 + k] - x[k];
            t2[k] = x[6 + k] - x[k];
        }
        return;
    }
    const double g = input->kind == ELEMENT_QUAD_FULL ? BILLOW_GAUSS : 0.0;
    double xi = (point == 1 || point == 2) ? g : -g, eta = point >= 2 ? g : -g;
    for (int k = 0; k < 3; k++) {
        double h = 0.25 * ((x[k] - x[3 + k]) + (x[6 + k] - x[9 + k]));
        t1[k] = 0.25 * ((x[3 + k] - x[k]) + (x[6 + k] - x[9 + k])) + eta * h;
        t2[k] = 0.25 * ((x[9 + k] - x[k]) + (x[6 + k] - x[3 + k])) + xi * h;
    }
}

/* Orthonormal material axes a, b in the tangent plane. */
static GeometryStatus material_axes(const ElementInput *input, const double *t1, const double *t2, double *a, double *b)
{
    double n[3], along[3];
    vector3_cross(t1, t2, n);
    double size = sqrt(vector3_dot(n, n));
    if (!(size > 0.0)) return GEOMETRY_ZERO_AREA;
    for (int k = 0; k < 3; k++) n[k] /= size;
    if (input->axis.kind == FIBRE_EDGE) {
        for (int k = 0; k < 3; k++) along[k] = input->x[3 + k] - input->x[k];
    } else if (input->axis.kind == FIBRE_VECTOR) {
        memcpy(along, input->axis.vector, sizeof along);
    } else {
        vector3_cross(input->axis.vector, n, along);
    }
    double off = vector3_dot(along, n), whole = sqrt(vector3_dot(along, along));
    for (int k = 0; k < 3; k++) along[k] -= off * n[k];
    double length = sqrt(vector3_dot(along, along));
    if (!(length > 1e-6 * whole)) return GEOMETRY_NO_FIBRE;
    double side[3];
    for (int k = 0; k < 3; k++) along[k] /= length;
    vector3_cross(n, along, side);
    double c = elementary_cos(input->axis.angle), s = elementary_sin(input->axis.angle);
    for (int k = 0; k < 3; k++) {
        a[k] = c * along[k] + s * side[k];
        b[k] = c * side[k] - s * along[k];
    }
    return GEOMETRY_OK;
}

void point_hourglass(const double *x, double skew[2], double *aa, double *bb, double *qq)
{
    double a[3], b[3], h[3];
    for (int k = 0; k < 3; k++) {
        a[k] = 0.25 * ((x[3 + k] - x[k]) + (x[6 + k] - x[9 + k]));
        b[k] = 0.25 * ((x[9 + k] - x[k]) + (x[6 + k] - x[3 + k]));
        h[k] = 0.25 * ((x[k] - x[3 + k]) + (x[6 + k] - x[9 + k]));
    }
    double ab = vector3_dot(a, b), ha = vector3_dot(h, a), hb = vector3_dot(h, b);
    *aa = vector3_dot(a, a);
    *bb = vector3_dot(b, b);
    double det = *aa * *bb - ab * ab;
    skew[0] = (ha * *bb - hb * ab) / det;
    skew[1] = (hb * *aa - ha * ab) / det;
    for (int k = 0; k < 3; k++) h[k] -= skew[0] * a[k] + skew[1] * b[k];
    *qq = vector3_dot(h, h);
}

bool point_has_fold(const ElementInput *input)
{
    return input->kind == ELEMENT_QUAD_FULL && input->law && input->law->free_fold;
}

void point_fold_metric(int point, const double m[4], double e[3])
{
    const double more = 2.0 / 3.0, shear = point % 2 == 0 ? -4.0 / 3.0 : -2.0 / 3.0; /* -(1 + xi eta) */
    e[0] = more * (m[0] * m[0] + m[2] * m[2]) + 2.0 * shear * m[0] * m[2];
    e[1] = more * (m[1] * m[1] + m[3] * m[3]) + 2.0 * shear * m[1] * m[3];
    e[2] = more * (m[0] * m[1] + m[2] * m[3]) + shear * (m[0] * m[3] + m[1] * m[2]);
}

/* Of a quad that is warped in its reference: M becomes M C^-1/2, so that C is the unit tensor there. */
static GeometryStatus free_of_warp(const ElementInput *input, int point, double m[4])
{
    double skew[2], aa, bb, qq, e[3];
    point_hourglass(input->x, skew, &aa, &bb, &qq);
    point_fold_metric(point, m, e);
    double c11 = 1.0 + qq * e[0], c22 = 1.0 + qq * e[1], c12 = qq * e[2], det = c11 * c22 - c12 * c12;
    if (!(det > 0.0) || !(c11 > 0.0)) return GEOMETRY_INVERTED;
    double j = sqrt(det), inverse = 1.0 / (j * sqrt(c11 + c22 + 2.0 * j));
    double u11 = (c22 + j) * inverse, u22 = (c11 + j) * inverse, u12 = -c12 * inverse;
    for (int i = 0; i < 4; i += 2) {
        double m1 = m[i] * u11 + m[i + 1] * u12, m2 = m[i] * u12 + m[i + 1] * u22;
        m[i] = m1;
        m[i + 1] = m2;
    }
    return GEOMETRY_OK;
}

/* The metric that an element at x has in the reference of m, in material axes (11, 22, 12) (eq. E4, E4a, E17). */
static void start_metric(const ElementInput *input, int point, const double m[4], double c[3])
{
    ElementInput at = *input;
    double t1[3], t2[3], f1[3], f2[3];
    at.x = input->start;
    point_tangents(&at, point, t1, t2);
    for (int k = 0; k < 3; k++) {
        f1[k] = m[0] * t1[k] + m[2] * t2[k];
        f2[k] = m[1] * t1[k] + m[3] * t2[k];
    }
    c[0] = vector3_dot(f1, f1);
    c[1] = vector3_dot(f2, f2);
    c[2] = vector3_dot(f1, f2);
    if (input->kind != ELEMENT_QUAD_ONE && !point_has_fold(input)) return;
    double skew[2], aa, bb, qq, e[3], q[3];
    point_hourglass(input->x, skew, &aa, &bb, &qq);
    for (int k = 0; k < 3; k++) {
        const double *x = input->start + k;
        q[k] = 0.25 * (((x[0] - x[3]) + (x[6] - x[9])) - skew[0] * ((x[3] - x[0]) + (x[6] - x[9])) -
                       skew[1] * ((x[9] - x[0]) + (x[6] - x[3])));
    }
    if (input->kind == ELEMENT_QUAD_ONE) {
        e[0] = (m[0] * m[0] + m[2] * m[2]) / 3.0;
        e[1] = (m[1] * m[1] + m[3] * m[3]) / 3.0;
        e[2] = (m[0] * m[1] + m[2] * m[3]) / 3.0;
    } else {
        point_fold_metric(point, m, e);
    }
    for (int i = 0; i < 3; i++) c[i] += vector3_dot(q, q) * e[i];
}

/* Adds to the reference what the start is stretched beyond it: M becomes M U+^-1, the area grows by det U+ (eq. R3,
 * R4).
 */
static void take_out_stretch(const ElementInput *input, int point, double m[4], double *area)
{
    double c[3];
    start_metric(input, point, m, c);
    double mean = 0.5 * (c[0] + c[1]), half = 0.5 * (c[0] - c[1]), radius = sqrt(half * half + c[2] * c[2]);
    double major = mean + radius > 1.0 ? sqrt(mean + radius) : 1.0;
    double minor = mean - radius > 1.0 ? sqrt(mean - radius) : 1.0;
    if (!(major > 1.0)) return;
    double cosine = radius > 0.0 ? half / radius : 1.0, sine = radius > 0.0 ? c[2] / radius : 0.0;
    double centre = 0.5 * (1.0 / major + 1.0 / minor), spread = 0.5 * (1.0 / major - 1.0 / minor);
    double u11 = centre + spread * cosine, u22 = centre - spread * cosine, u12 = spread * sine;
    for (int i = 0; i < 4; i += 2) {
        double m1 = m[i] * u11 + m[i + 1] * u12, m2 = m[i] * u12 + m[i + 1] * u22;
        m[i] = m1;
        m[i + 1] = m2;
    }
    *area *= major * minor;
}

GeometryStatus point_gradients(const ElementInput *input, int point, double m[4], double *area)
{
    double t1[3], t2[3], a[3], b[3];
    point_tangents(input, point, t1, t2);
    GeometryStatus status = material_axes(input, t1, t2, a, b);
    if (status != GEOMETRY_OK) return status;
    double j11 = vector3_dot(t1, a), j12 = vector3_dot(t2, a), j21 = vector3_dot(t1, b),
           j22 = vector3_dot(t2, b); /* dX_A/d(natural) */
    double det = j11 * j22 - j12 * j21;
    if (!(det > 0.0)) return GEOMETRY_ZERO_AREA;
    m[0] = j22 / det;
    m[1] = -j12 / det;
    m[2] = -j21 / det;
    m[3] = j11 / det;
    double natural = input->kind == ELEMENT_TRIANGLE ? 0.5 : input->kind == ELEMENT_QUAD_FULL ? 1.0 : 4.0;
    *area = natural * det;
    if (point_has_fold(input)) status = free_of_warp(input, point, m);
    if (status == GEOMETRY_OK && input->start) take_out_stretch(input, point, m, area);
    return status;
}
