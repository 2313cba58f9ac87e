/* Reference geometry of one element: natural gradients M = d(natural)/dX in material axes, point weights, hourglass
 * constants (docs/theory.md, Elements). */
#include "elements/geometry.h"

#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/elementary.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static int point_count(ElementKind kind)
{
    return kind == ELEMENT_QUAD_FULL ? 4 : 1;
}

int geometry_size(ElementKind kind, LawKind law)
{
    if (law == LAW_SURFACE) return 1;
    return point_count(kind) * GEOMETRY_POINT_SIZE + GEOMETRY_TAIL_SIZE +
           (kind == ELEMENT_QUAD_ONE                       ? GEOMETRY_HOURGLASS_SIZE
            : kind == ELEMENT_QUAD_FULL && law == LAW_BIOT ? GEOMETRY_SKEW_SIZE
                                                           : 0);
}

/* Tangents dX/d(natural) at a point; for triangles the two edges. */
static void tangents(const ElementInput *input, int point, double *t1, double *t2)
{
    const double *x = input->x;
    if (input->kind == ELEMENT_TRIANGLE) {
        for (int k = 0; k < 3; k++) {
            t1[k] = x[3 + k] - x[k];
            t2[k] = x[6 + k] - x[k];
        }
        return;
    }
    const double g = input->kind == ELEMENT_QUAD_FULL ? 0.57735026918962576 : 0.0;
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
    cross(t1, t2, n);
    double size = sqrt(dot(n, n));
    if (!(size > 0.0)) return GEOMETRY_ZERO_AREA;
    for (int k = 0; k < 3; k++) n[k] /= size;
    if (input->axis.kind == FIBRE_EDGE) {
        for (int k = 0; k < 3; k++) along[k] = input->x[3 + k] - input->x[k];
    } else if (input->axis.kind == FIBRE_VECTOR) {
        memcpy(along, input->axis.vector, sizeof along);
    } else {
        cross(input->axis.vector, n, along);
    }
    double off = dot(along, n), whole = sqrt(dot(along, along));
    for (int k = 0; k < 3; k++) along[k] -= off * n[k];
    double length = sqrt(dot(along, along));
    if (!(length > 1e-6 * whole)) return GEOMETRY_NO_FIBRE;
    double side[3];
    for (int k = 0; k < 3; k++) along[k] /= length;
    cross(n, along, side);
    double c = elementary_cos(input->axis.angle), s = elementary_sin(input->axis.angle);
    for (int k = 0; k < 3; k++) {
        a[k] = c * along[k] + s * side[k];
        b[k] = c * side[k] - s * along[k];
    }
    return GEOMETRY_OK;
}

/* Reference hourglass vector of a quad in natural directions (skew), the squared lengths of its mean tangents and of
 * what is left of the vector, q (eq. E15, E16). */
static void hourglass_geometry(const double *x, double skew[2], double *aa, double *bb, double *qq)
{
    double a[3], b[3], h[3];
    for (int k = 0; k < 3; k++) {
        a[k] = 0.25 * ((x[3 + k] - x[k]) + (x[6 + k] - x[9 + k]));
        b[k] = 0.25 * ((x[9 + k] - x[k]) + (x[6 + k] - x[3 + k]));
        h[k] = 0.25 * ((x[k] - x[3 + k]) + (x[6 + k] - x[9 + k]));
    }
    double ab = dot(a, b), ha = dot(h, a), hb = dot(h, b);
    *aa = dot(a, a);
    *bb = dot(b, b);
    double det = *aa * *bb - ab * ab;
    skew[0] = (ha * *bb - hb * ab) / det;
    skew[1] = (hb * *aa - ha * ab) / det;
    for (int k = 0; k < 3; k++) h[k] -= skew[0] * a[k] + skew[1] * b[k];
    *qq = dot(h, h);
}

/* Has the metric a term of its own in q.q (eq. E4a)? */
static bool has_fold(const ElementInput *input)
{
    return input->kind == ELEMENT_QUAD_FULL && input->law && input->law->free_fold;
}

/* What a unit of q.q adds to the metric of a quad's point, as M^T E M in material axes (11, 22, 12) (eq. E4a). */
static void fold_metric(int point, const double m[4], double e[3])
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
    hourglass_geometry(input->x, skew, &aa, &bb, &qq);
    fold_metric(point, m, e);
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
    tangents(&at, point, t1, t2);
    for (int k = 0; k < 3; k++) {
        f1[k] = m[0] * t1[k] + m[2] * t2[k];
        f2[k] = m[1] * t1[k] + m[3] * t2[k];
    }
    c[0] = dot(f1, f1);
    c[1] = dot(f2, f2);
    c[2] = dot(f1, f2);
    if (input->kind != ELEMENT_QUAD_ONE && !has_fold(input)) return;
    double skew[2], aa, bb, qq, e[3], q[3];
    hourglass_geometry(input->x, skew, &aa, &bb, &qq);
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
        fold_metric(point, m, e);
    }
    for (int i = 0; i < 3; i++) c[i] += dot(q, q) * e[i];
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

/* One point's M and its area factor: |dX/d(natural)| times the natural weight. */
static GeometryStatus point_geometry(const ElementInput *input, int point, double m[4], double *area)
{
    double t1[3], t2[3], a[3], b[3];
    tangents(input, point, t1, t2);
    GeometryStatus status = material_axes(input, t1, t2, a, b);
    if (status != GEOMETRY_OK) return status;
    double j11 = dot(t1, a), j12 = dot(t2, a), j21 = dot(t1, b), j22 = dot(t2, b); /* dX_A/d(natural) */
    double det = j11 * j22 - j12 * j21;
    if (!(det > 0.0)) return GEOMETRY_ZERO_AREA;
    m[0] = j22 / det;
    m[1] = -j12 / det;
    m[2] = -j21 / det;
    m[3] = j11 / det;
    double natural = input->kind == ELEMENT_TRIANGLE ? 0.5 : input->kind == ELEMENT_QUAD_FULL ? 1.0 : 4.0;
    *area = natural * det;
    if (has_fold(input)) status = free_of_warp(input, point, m);
    if (status == GEOMETRY_OK && input->start) take_out_stretch(input, point, m, area);
    return status;
}

/* Normals of a quad's four corners must all lie on the side of its mean normal. */
static bool quad_is_convex(const double *x)
{
    double d1[3], d2[3], n[3];
    for (int k = 0; k < 3; k++) {
        d1[k] = x[6 + k] - x[k];
        d2[k] = x[9 + k] - x[3 + k];
    }
    cross(d1, d2, n);
    for (int i = 0; i < 4; i++) {
        double u[3], w[3], m[3];
        for (int k = 0; k < 3; k++) {
            u[k] = x[3 * ((i + 1) % 4) + k] - x[3 * i + k];
            w[k] = x[3 * ((i + 3) % 4) + k] - x[3 * i + k];
        }
        cross(u, w, m);
        if (!(dot(m, n) > 0.0)) return false;
    }
    return true;
}

/* Gradients of the shape functions at a point in material axes, from M. */
static void shape_gradients(ElementKind kind, int point, const double m[4], double g[4][2])
{
    if (kind == ELEMENT_TRIANGLE) {
        for (int k = 0; k < 2; k++) {
            g[1][k] = m[k];
            g[2][k] = m[2 + k];
            g[0][k] = -(m[k] + m[2 + k]);
        }
        return;
    }
    const double p = kind == ELEMENT_QUAD_FULL ? 0.57735026918962576 : 0.0;
    const double xi_a[4] = {-1, 1, 1, -1}, eta_a[4] = {-1, -1, 1, 1};
    double xi = (point == 1 || point == 2) ? p : -p, eta = point >= 2 ? p : -p;
    for (int a = 0; a < 4; a++) {
        double d1 = 0.25 * xi_a[a] * (1.0 + eta_a[a] * eta), d2 = 0.25 * eta_a[a] * (1.0 + xi_a[a] * xi);
        g[a][0] = d1 * m[0] + d2 * m[2];
        g[a][1] = d1 * m[1] + d2 * m[3];
    }
}

double geometry_area(int corner_count, const double *x)
{
    ElementInput input = {.kind = corner_count == 3 ? ELEMENT_TRIANGLE : ELEMENT_QUAD_FULL, .x = x};
    double area = 0.0;
    for (int p = 0; p < point_count(input.kind); p++) {
        double t1[3], t2[3], n[3];
        tangents(&input, p, t1, t2);
        cross(t1, t2, n);
        area += (corner_count == 3 ? 0.5 : 1.0) * sqrt(dot(n, n));
    }
    return area;
}

/* Stiffness of normal and shear strains of one point added to k (2 n x 2 n): weight B^T D B. */
static void add_point_stiffness(int corners, double (*g)[2], const PlaneModuli *d, double weight, double *k)
{
    int n = 2 * corners;
    for (int a = 0; a < corners; a++) {
        for (int b = 0; b < corners; b++) {
            double ax = g[a][0], ay = g[a][1], bx = g[b][0], by = g[b][1];
            k[(2 * a) * n + 2 * b] += weight * (ax * d->d11 * bx + ay * d->d33 * by);
            k[(2 * a) * n + 2 * b + 1] += weight * (ax * d->d12 * by + ay * d->d33 * bx);
            k[(2 * a + 1) * n + 2 * b] += weight * (ay * d->d12 * bx + ax * d->d33 * by);
            k[(2 * a + 1) * n + 2 * b + 1] += weight * (ay * d->d22 * by + ax * d->d33 * bx);
        }
    }
}

/* In-plane hourglass energy 1/2 (c1 (q.a)^2 + c2 (q.b)^2), c = QH d weight / (3 |a|^4) (eq. E18). */
static void hourglass_moduli(const FabricLaw *law, double weight, double aa, double bb, double c[2])
{
    c[0] = law->hourglass * law->whole.d11 * weight / (3.0 * aa * aa);
    c[1] = law->hourglass * law->whole.d22 * weight / (3.0 * bb * bb);
}

/* Squared lengths of the mean tangents where the reference is not that of the corners: of M^-1. */
static void stretched_lengths(const ElementInput *input, const double m[4], double *aa, double *bb)
{
    if (!input->start) return;
    double det = m[0] * m[3] - m[1] * m[2];
    *aa = (m[3] * m[3] + m[2] * m[2]) / (det * det);
    *bb = (m[1] * m[1] + m[0] * m[0]) / (det * det);
}

/* Adds the hourglass stiffness: r1 = q.a, with dq = dh - skew1 da - skew2 db. */
static void add_hourglass_stiffness(const ElementInput *input, double weight, const double m[4], double *k)
{
    double skew[2], aa, bb, qq, c[2];
    hourglass_geometry(input->x, skew, &aa, &bb, &qq);
    stretched_lengths(input, m, &aa, &bb);
    hourglass_moduli(input->law, weight, aa, bb, c);
    const double xi_a[4] = {-1, 1, 1, -1}, eta_a[4] = {-1, -1, 1, 1};
    double det = m[0] * m[3] - m[1] * m[2];
    double a[2] = {m[3] / det, -m[2] / det}, b[2] = {-m[1] / det, m[0] / det}; /* mean tangents in material axes */
    double r1[8], r2[8];
    for (int i = 0; i < 4; i++) {
        double dq = 0.25 * (xi_a[i] * eta_a[i] - skew[0] * xi_a[i] - skew[1] * eta_a[i]);
        for (int j = 0; j < 2; j++) {
            r1[2 * i + j] = dq * a[j];
            r2[2 * i + j] = dq * b[j];
        }
    }
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++) k[8 * i + j] += c[0] * r1[i] * r1[j] + c[1] * r2[i] * r2[j];
}

double geometry_rate(const ElementInput *input)
{
    int corners = input->kind == ELEMENT_TRIANGLE ? 3 : 4;
    double k[64] = {0};
    for (int p = 0; p < point_count(input->kind); p++) {
        double m[4], area, g[4][2];
        if (point_geometry(input, p, m, &area) != GEOMETRY_OK) return 0.0;
        shape_gradients(input->kind, p, m, g);
        add_point_stiffness(corners, g, &input->law->whole, area * input->thickness, k);
        if (input->kind == ELEMENT_QUAD_ONE) add_hourglass_stiffness(input, area * input->thickness, m, k);
    }
    return geometry_largest_eigenvalue(2 * corners, k) * corners / input->mass;
}

/* Largest eigenvalue of the geometric stiffness of a point under a unit of all-round tension (G of eq. E21, E22): of
 * sum g g over the material axes, and of the fold's share along q. */
static double stress_spread(const ElementInput *input, int point, const double m[4])
{
    int corners = input->kind == ELEMENT_TRIANGLE ? 3 : 4;
    double g[4][2], k[16], q[4] = {0}, fold = 0.0;
    shape_gradients(input->kind, point, m, g);
    if (has_fold(input)) {
        const double xi_a[4] = {-1, 1, 1, -1}, eta_a[4] = {-1, -1, 1, 1};
        double skew[2], aa, bb, qq, e[3];
        hourglass_geometry(input->x, skew, &aa, &bb, &qq);
        fold_metric(point, m, e);
        fold = e[0] + e[1] > 0.0 ? e[0] + e[1] : 0.0;
        for (int a = 0; a < 4; a++) q[a] = 0.25 * (xi_a[a] * eta_a[a] - skew[0] * xi_a[a] - skew[1] * eta_a[a]);
    }
    for (int a = 0; a < corners; a++)
        for (int b = 0; b < corners; b++)
            k[corners * a + b] = g[a][0] * g[b][0] + g[a][1] * g[b][1] + fold * q[a] * q[b];
    return geometry_largest_eigenvalue(corners, k);
}

GeometryStatus geometry_check(const ElementInput *input)
{
    double m[4], area;
    GeometryStatus status = GEOMETRY_OK;
    if (input->kind != ELEMENT_TRIANGLE && !quad_is_convex(input->x))
        status = geometry_area(4, input->x) > 0.0 ? GEOMETRY_INVERTED : GEOMETRY_ZERO_AREA;
    for (int p = 0; status == GEOMETRY_OK && p < point_count(input->kind); p++)
        status = point_geometry(input, p, m, &area);
    return status;
}

GeometryStatus geometry_fill(const ElementInput *input, double sign, double *lane)
{
    if (!input->law) {
        lane[0] = sign;
        return GEOMETRY_OK;
    }
    int corners = input->kind == ELEMENT_TRIANGLE ? 3 : 4, points = point_count(input->kind);
    if (corners == 4 && !quad_is_convex(input->x)) return GEOMETRY_INVERTED;
    double spread = 0.0, volume = 0.0, m[4] = {0};
    for (int p = 0; p < points; p++) {
        double area;
        GeometryStatus status = point_geometry(input, p, m, &area);
        if (status != GEOMETRY_OK) return status;
        double *point = lane + p * GEOMETRY_POINT_SIZE * BILLOW_LANES;
        for (int i = 0; i < 4; i++) point[(GEOMETRY_M11 + i) * BILLOW_LANES] = m[i];
        point[GEOMETRY_WEIGHT * BILLOW_LANES] = area * input->thickness;
        volume += area * input->thickness;
        double major = stress_spread(input, p, m);
        spread = major > spread ? major : spread;
    }
    double *tail = lane + points * GEOMETRY_POINT_SIZE * BILLOW_LANES;
    double rate = geometry_rate(input);
    tail[GEOMETRY_RATE * BILLOW_LANES] = rate;
    tail[GEOMETRY_STRESS_RATE * BILLOW_LANES] = spread * volume * corners / input->mass;
    tail[GEOMETRY_SIGN * BILLOW_LANES] = sign;
    if (input->kind == ELEMENT_QUAD_ONE || has_fold(input)) {
        double *constant = tail + GEOMETRY_TAIL_SIZE * BILLOW_LANES;
        double skew[2], aa, bb, qq, c[2];
        hourglass_geometry(input->x, skew, &aa, &bb, &qq);
        stretched_lengths(input, m, &aa, &bb); /* m: of the only point where the moduli count */
        hourglass_moduli(input->law, volume, aa, bb, c);
        for (int i = 0; i < 2; i++) {
            constant[(GEOMETRY_SKEW1 + i) * BILLOW_LANES] = skew[i];
            if (input->kind == ELEMENT_QUAD_ONE) constant[(GEOMETRY_HOURGLASS1 + i) * BILLOW_LANES] = c[i];
        }
    }
    return GEOMETRY_OK;
}
