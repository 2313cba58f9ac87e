/* Volume and area of facets: the reference formulas that the element kernels repeat in blocks. */
#include "airbag/volume.h"

#include <math.h>
#include <stddef.h>

static void subtract(const double a[3], const double b[3], double d[3])
{
    for (int i = 0; i < 3; i++) d[i] = a[i] - b[i];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Area vector of the triangle a b c. */
static void triangle_area(const double a[3], const double b[3], const double c[3], double area[3])
{
    double u[3], v[3];
    subtract(b, a, u);
    subtract(c, a, v);
    cross(u, v, area);
    for (int i = 0; i < 3; i++) area[i] *= 0.5;
}

double volume_triangle(const double a[3], const double b[3], const double c[3], const double origin[3])
{
    double u[3], v[3], w[3], n[3];
    subtract(a, origin, u);
    subtract(b, origin, v);
    subtract(c, origin, w);
    cross(v, w, n);
    return dot(u, n) / 6.0;
}

double volume_quad(const double a[3], const double b[3], const double c[3], const double d[3], const double origin[3])
{
    double one = volume_triangle(a, b, c, origin) + volume_triangle(a, c, d, origin);
    double other = volume_triangle(a, b, d, origin) + volume_triangle(b, c, d, origin);
    return 0.5 * (one + other);
}

void volume_triangle_gradient(const double a[3], const double b[3], const double c[3], const double origin[3],
                              double gradient[3][3])
{
    double r[3][3];
    subtract(a, origin, r[0]);
    subtract(b, origin, r[1]);
    subtract(c, origin, r[2]);
    for (int i = 0; i < 3; i++) {
        cross(r[(i + 1) % 3], r[(i + 2) % 3], gradient[i]);
        for (int k = 0; k < 3; k++) gradient[i][k] /= 6.0;
    }
}

void volume_quad_gradient(const double a[3], const double b[3], const double c[3], const double d[3],
                          const double origin[3], double gradient[4][3])
{
    static const int split[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};
    const double *corner[4] = {a, b, c, d};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) gradient[i][k] = 0.0;
    for (int t = 0; t < 4; t++) {
        double part[3][3];
        volume_triangle_gradient(corner[split[t][0]], corner[split[t][1]], corner[split[t][2]], origin, part);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) gradient[split[t][i]][k] += 0.5 * part[i][k];
    }
}

void volume_triangle_shares(const double a[3], const double b[3], const double c[3], double share[3][3])
{
    double area[3];
    triangle_area(a, b, c, area);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) share[i][k] = area[k] / 3.0;
}

void volume_quad_shares(const double a[3], const double b[3], const double c[3], const double d[3], double share[4][3])
{
    const double *corner[4] = {a, b, c, d};
    double diagonal[2][3], whole[3];
    subtract(c, a, diagonal[0]);
    subtract(d, b, diagonal[1]);
    cross(diagonal[0], diagonal[1], whole);
    for (int i = 0; i < 4; i++) {
        double own[3];
        triangle_area(corner[(i + 3) % 4], corner[i], corner[(i + 1) % 4], own);
        for (int k = 0; k < 3; k++) share[i][k] = (0.5 * whole[k] + own[k]) / 6.0;
    }
}

double volume_facet(const int32_t node[4], const double *x, const double origin[3])
{
    const double *a = x + 3 * (size_t)node[0], *b = x + 3 * (size_t)node[1];
    const double *c = x + 3 * (size_t)node[2], *d = x + 3 * (size_t)node[3];
    return node[2] == node[3] ? volume_triangle(a, b, c, origin) : volume_quad(a, b, c, d, origin);
}

double volume_facet_area(const int32_t node[4], const double *x)
{
    double u[3], v[3], n[3];
    subtract(x + 3 * (size_t)node[2], x + 3 * (size_t)node[0], u);
    subtract(x + 3 * (size_t)node[3], x + 3 * (size_t)node[1], v);
    cross(u, v, n);
    return 0.5 * sqrt(dot(n, n));
}

double volume_surface(int facet_count, const int32_t *node, const int *sign, const double *x, const double origin[3])
{
    double volume = 0.0;
    for (int i = 0; i < facet_count; i++) {
        if (sign && sign[i] == 0) continue;
        double v = volume_facet(node + 4 * (size_t)i, x, origin);
        volume += sign && sign[i] < 0 ? -v : v;
    }
    return volume;
}
