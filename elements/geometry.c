/* Constants of one element in its reference: natural gradients and weights of its points, hourglass constants,
 * stiffness and largest frequency (docs/theory.md, Elements). */
#include "elements/geometry.h"

#include <math.h>
#include <string.h>

#include "elements/geometry_point.h"
#include "elements/kernels.h"
#include "solver/vector3.h"

int geometry_size(ElementKind kind, LawKind law)
{
    if (law == LAW_SURFACE) return 1;
    return point_number(kind) * GEOMETRY_POINT_SIZE + GEOMETRY_TAIL_SIZE +
           (kind == ELEMENT_QUAD_ONE                       ? GEOMETRY_HOURGLASS_SIZE
            : kind == ELEMENT_QUAD_FULL && law == LAW_BIOT ? GEOMETRY_SKEW_SIZE
                                                           : 0);
}

/* Normals of a quad's four corners must all lie on the side of its mean normal. */
static bool quad_is_convex(const double *x)
{
    double d1[3], d2[3], n[3];
    for (int k = 0; k < 3; k++) {
        d1[k] = x[6 + k] - x[k];
        d2[k] = x[9 + k] - x[3 + k];
    }
    vector3_cross(d1, d2, n);
    for (int i = 0; i < 4; i++) {
        double u[3], w[3], m[3];
        for (int k = 0; k < 3; k++) {
            u[k] = x[3 * ((i + 1) % 4) + k] - x[3 * i + k];
            w[k] = x[3 * ((i + 3) % 4) + k] - x[3 * i + k];
        }
        vector3_cross(u, w, m);
        if (!(vector3_dot(m, n) > 0.0)) return false;
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
    const double p = kind == ELEMENT_QUAD_FULL ? BILLOW_GAUSS : 0.0;
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
    for (int p = 0; p < point_number(input.kind); p++) {
        double t1[3], t2[3], n[3];
        point_tangents(&input, p, t1, t2);
        vector3_cross(t1, t2, n);
        area += (corner_count == 3 ? 0.5 : 1.0) * sqrt(vector3_dot(n, n));
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
    point_hourglass(input->x, skew, &aa, &bb, &qq);
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
    for (int p = 0; p < point_number(input->kind); p++) {
        double m[4], area, g[4][2];
        if (point_gradients(input, p, m, &area) != GEOMETRY_OK) return 0.0;
        shape_gradients(input->kind, p, m, g);
        add_point_stiffness(corners, g, &input->law->whole, area * input->thickness, k);
        if (input->kind == ELEMENT_QUAD_ONE) add_hourglass_stiffness(input, area * input->thickness, m, k);
    }
    return geometry_largest_eigenvalue(2 * corners, k) * corners / input->mass;
}

/* Geometric stiffness of a point under a unit of all-round tension, k (corners x corners): sum g g over the material
 * axes, and the fold's share along q. */
static void point_spread(const ElementInput *input, int point, const double m[4], double *k)
{
    int corners = input->kind == ELEMENT_TRIANGLE ? 3 : 4;
    double g[4][2], q[4] = {0}, fold = 0.0;
    shape_gradients(input->kind, point, m, g);
    if (point_has_fold(input)) {
        const double xi_a[4] = {-1, 1, 1, -1}, eta_a[4] = {-1, -1, 1, 1};
        double skew[2], aa, bb, qq, e[3];
        point_hourglass(input->x, skew, &aa, &bb, &qq);
        point_fold_metric(point, m, e);
        fold = e[0] + e[1] > 0.0 ? e[0] + e[1] : 0.0;
        for (int a = 0; a < 4; a++) q[a] = 0.25 * (xi_a[a] * eta_a[a] - skew[0] * xi_a[a] - skew[1] * eta_a[a]);
    }
    for (int a = 0; a < corners; a++)
        for (int b = 0; b < corners; b++)
            k[corners * a + b] = g[a][0] * g[b][0] + g[a][1] * g[b][1] + fold * q[a] * q[b];
}

/* Its largest eigenvalue, G of eq. E21 and E22. */
static double stress_spread(const ElementInput *input, int point, const double m[4])
{
    double k[16];
    point_spread(input, point, m, k);
    return geometry_largest_eigenvalue(input->kind == ELEMENT_TRIANGLE ? 3 : 4, k);
}

/* Largest eigenvalue of the moduli as a map of symmetric tensors: the shear strain counts twice in their square. */
static double largest_modulus(const PlaneModuli *d)
{
    double mean = 0.5 * (d->d11 + d->d22), half = 0.5 * (d->d11 - d->d22);
    double normal = mean + sqrt(half * half + d->d12 * d->d12);
    return fmax(normal, 2.0 * d->d33);
}

int geometry_gradient_stiffness(const ElementInput *input, double *k)
{
    int corners = input->kind == ELEMENT_TRIANGLE ? 3 : 4;
    double modulus = largest_modulus(&input->law->whole);
    for (int i = 0; i < corners * corners; i++) k[i] = 0.0;
    for (int p = 0; p < point_number(input->kind); p++) {
        double m[4], area, spread[16];
        if (point_gradients(input, p, m, &area) != GEOMETRY_OK) return -1;
        point_spread(input, p, m, spread);
        for (int i = 0; i < corners * corners; i++) k[i] += modulus * area * input->thickness * spread[i];
    }
    return 0;
}

GeometryStatus geometry_check(const ElementInput *input)
{
    double m[4], area;
    GeometryStatus status = GEOMETRY_OK;
    if (input->kind != ELEMENT_TRIANGLE && !quad_is_convex(input->x))
        status = geometry_area(4, input->x) > 0.0 ? GEOMETRY_INVERTED : GEOMETRY_ZERO_AREA;
    for (int p = 0; status == GEOMETRY_OK && p < point_number(input->kind); p++)
        status = point_gradients(input, p, m, &area);
    return status;
}

GeometryStatus geometry_fill(const ElementInput *input, double sign, double *lane)
{
    if (!input->law) {
        lane[0] = sign;
        return GEOMETRY_OK;
    }
    int corners = input->kind == ELEMENT_TRIANGLE ? 3 : 4, points = point_number(input->kind);
    if (corners == 4 && !quad_is_convex(input->x)) return GEOMETRY_INVERTED;
    double spread = 0.0, volume = 0.0, m[4] = {0};
    for (int p = 0; p < points; p++) {
        double area;
        GeometryStatus status = point_gradients(input, p, m, &area);
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
    tail[GEOMETRY_PERIOD * BILLOW_LANES] = rate > 0.0 ? 1.0 / sqrt(rate) : 0.0;
    if (input->kind == ELEMENT_QUAD_ONE || point_has_fold(input)) {
        double *constant = tail + GEOMETRY_TAIL_SIZE * BILLOW_LANES;
        double skew[2], aa, bb, qq, c[2];
        point_hourglass(input->x, skew, &aa, &bb, &qq);
        stretched_lengths(input, m, &aa, &bb); /* m: of the only point where the moduli count */
        hourglass_moduli(input->law, volume, aa, bb, c);
        for (int i = 0; i < 2; i++) {
            constant[(GEOMETRY_SKEW1 + i) * BILLOW_LANES] = skew[i];
            if (input->kind == ELEMENT_QUAD_ONE) constant[(GEOMETRY_HOURGLASS1 + i) * BILLOW_LANES] = c[i];
        }
    }
    return GEOMETRY_OK;
}
