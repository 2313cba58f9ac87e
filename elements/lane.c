/* One element at a time, in scalar form. */
#include "elements/lane.h"

#include <string.h>

#include "elements/kernels.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int lane_group(const Model *model, int64_t slot)
{
    int low = 0, high = model->group_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (model->groups[middle].first_element <= slot)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

void lane_corners(const ElementGroup *group, const double *x, int64_t place, double corner[4][3])
{
    const int32_t *node =
        group->node + place / BILLOW_LANES * group->corner_count * BILLOW_LANES + place % BILLOW_LANES;
    for (int a = 0; a < group->corner_count; a++)
        memcpy(corner[a], x + 3 * (ptrdiff_t)node[a * BILLOW_LANES], sizeof corner[a]);
}

static const double *hourglass_constants(const ElementGroup *group, const double *geometry)
{
    return geometry + (group->point_count * GEOMETRY_POINT_SIZE + GEOMETRY_TAIL_SIZE) * BILLOW_LANES;
}

/* A quad's vector q (eq. E15). */
static void hourglass_vector(const double *skew, double corner[4][3], double q[3])
{
    for (int k = 0; k < 3; k++) {
        double x0 = corner[0][k], x1 = corner[1][k], x2 = corner[2][k], x3 = corner[3][k];
        q[k] = 0.25 * (((x0 - x1) + (x2 - x3)) - skew[GEOMETRY_SKEW1 * BILLOW_LANES] * ((x1 - x0) + (x2 - x3)) -
                       skew[GEOMETRY_SKEW2 * BILLOW_LANES] * ((x3 - x0) + (x2 - x1)));
    }
}

/* q.q; 0 where the law makes no use of it. */
static double hourglass_square(const ElementGroup *group, const double *geometry, double corner[4][3])
{
    if (group->kind == ELEMENT_TRIANGLE || (group->kind == ELEMENT_QUAD_FULL && group->law != LAW_BIOT)) return 0.0;
    double q[3];
    hourglass_vector(hourglass_constants(group, geometry), corner, q);
    return dot(q, q);
}

/* r1, r2 of the in-plane hourglass modes, which are quadratic in the positions (eq. E18). */
static void hourglass_modes(const double *constant, double corner[4][3], double r[2])
{
    double q[3];
    hourglass_vector(constant, corner, q);
    r[0] = r[1] = 0.0;
    for (int k = 0; k < 3; k++) {
        double x0 = corner[0][k], x1 = corner[1][k], x2 = corner[2][k], x3 = corner[3][k];
        r[0] += 0.25 * q[k] * ((x1 - x0) + (x2 - x3));
        r[1] += 0.25 * q[k] * ((x3 - x0) + (x2 - x1));
    }
}

double lane_hourglass_work(const ElementGroup *group, const double *geometry, double corner[3][4][3])
{
    if (group->kind != ELEMENT_QUAD_ONE) return 0.0;
    const double *constant = hourglass_constants(group, geometry);
    double r[3][2];
    for (int i = 0; i < 3; i++) hourglass_modes(constant, corner[i], r[i]);
    return 0.5 * (constant[GEOMETRY_HOURGLASS1 * BILLOW_LANES] * r[0][0] * (r[2][0] - r[1][0]) +
                  constant[GEOMETRY_HOURGLASS2 * BILLOW_LANES] * r[0][1] * (r[2][1] - r[1][1]));
}

/* Natural gradients of the position at a point, and what the fold adds to their metric per unit of q.q. */
static void natural_gradients(const ElementGroup *group, double corner[4][3], int p, double *g1, double *g2,
                              double fold[3])
{
    fold[0] = fold[1] = fold[2] = 0.0;
    if (group->kind == ELEMENT_TRIANGLE) {
        for (int k = 0; k < 3; k++) {
            g1[k] = corner[1][k] - corner[0][k];
            g2[k] = corner[2][k] - corner[0][k];
        }
        return;
    }
    const bool one = group->kind == ELEMENT_QUAD_ONE;
    const double gauss = one ? 0.0 : BILLOW_GAUSS;
    double xi = (p == 1 || p == 2) ? gauss : -gauss, eta = p >= 2 ? gauss : -gauss;
    for (int k = 0; k < 3; k++) {
        double h = 0.25 * ((corner[0][k] - corner[1][k]) + (corner[2][k] - corner[3][k]));
        g1[k] = 0.25 * ((corner[1][k] - corner[0][k]) + (corner[2][k] - corner[3][k])) + eta * h;
        g2[k] = 0.25 * ((corner[3][k] - corner[0][k]) + (corner[2][k] - corner[1][k])) + xi * h;
    }
    fold[0] = fold[1] = one ? 1.0 / 3.0 : 2.0 / 3.0; /* (E17), else (E4a) */
    fold[2] = one ? 0.0 : -(1.0 + xi * eta);
}

void lane_points(const ElementGroup *group, const double *geometry, double corner[4][3], LanePoint *point)
{
    double square = hourglass_square(group, geometry, corner);
    for (int p = 0; p < group->point_count; p++) {
        const double *constant = geometry + p * GEOMETRY_POINT_SIZE * BILLOW_LANES;
        double m11 = constant[GEOMETRY_M11 * BILLOW_LANES], m12 = constant[GEOMETRY_M12 * BILLOW_LANES],
               m21 = constant[GEOMETRY_M21 * BILLOW_LANES], m22 = constant[GEOMETRY_M22 * BILLOW_LANES];
        double g1[3], g2[3], e[3];
        natural_gradients(group, corner, p, g1, g2, e);
        LanePoint *out = &point[p];
        for (int k = 0; k < 3; k++) {
            out->f1[k] = m11 * g1[k] + m21 * g2[k];
            out->f2[k] = m12 * g1[k] + m22 * g2[k];
            e[k] *= square;
        }
        out->c[0] = dot(out->f1, out->f1) + m11 * (m11 * e[0] + m21 * e[2]) + m21 * (m11 * e[2] + m21 * e[1]);
        out->c[1] = dot(out->f2, out->f2) + m12 * (m12 * e[0] + m22 * e[2]) + m22 * (m12 * e[2] + m22 * e[1]);
        out->c[2] = dot(out->f1, out->f2) + m11 * (m12 * e[0] + m22 * e[2]) + m21 * (m12 * e[2] + m22 * e[1]);
        out->weight = constant[GEOMETRY_WEIGHT * BILLOW_LANES];
    }
}
