/* Stress, strain and thickness of one element for the writers, at its centre and with the laws of the kernels. */
#include <math.h>
#include <string.h>

#define BILLOW_KERNEL_LEVEL 2 /* the laws on the smallest packs; the first lane counts */
#include "elements/kernel_law.h"
#include "elements/kernels.h"
#include "elements/membrane.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Symmetric tensor sum of t11 u u + t22 w w + t12 (u w + w u) in order xx yy zz xy yz zx; first lane. */
static void to_global(PackTensor t, const double u[3], const double w[3], double scale, double out[6])
{
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int i = 0; i < 6; i++) {
        int a = row[i], b = column[i];
        out[i] += scale * (t.a11[0] * u[a] * u[b] + t.a22[0] * w[a] * w[b] + t.a12[0] * (u[a] * w[b] + u[b] * w[a]));
    }
}

/* One point: natural gradients g1, g2, M and what the free fold adds to the metric (11, 22, 12). Columns of F are the
 * images of the material axes. */
static void add_point(const ElementGroup *group, const double *point, const double *g1, const double *g2,
                      const double fold[3], double share, ElementResult *result)
{
    double m11 = point[GEOMETRY_M11 * BILLOW_LANES], m12 = point[GEOMETRY_M12 * BILLOW_LANES],
           m21 = point[GEOMETRY_M21 * BILLOW_LANES], m22 = point[GEOMETRY_M22 * BILLOW_LANES];
    double f1[3], f2[3];
    for (int k = 0; k < 3; k++) {
        f1[k] = m11 * g1[k] + m21 * g2[k];
        f2[k] = m12 * g1[k] + m22 * g2[k];
    }
    const FabricLaw *law = &group->material;
    double c11 = dot(f1, f1) + m11 * (m11 * fold[0] + m21 * fold[2]) + m21 * (m11 * fold[2] + m21 * fold[1]);
    double c22 = dot(f2, f2) + m12 * (m12 * fold[0] + m22 * fold[2]) + m22 * (m12 * fold[2] + m22 * fold[1]);
    double c12 = dot(f1, f2) + m11 * (m12 * fold[0] + m22 * fold[2]) + m21 * (m12 * fold[2] + m22 * fold[1]);
    double j = sqrt(fmax(c11 * c22 - c12 * c12, BILLOW_LEAST_SQUARED_STRETCH));
    PackTensor c = {pack_of(c11), pack_of(c22), pack_of(c12)}, e, s;
    if (group->law == LAW_GREEN) {
        Compliance b = make_compliance(&law->fabric);
        e = green_strain(c);
        s = green_stress(law, &b, law->no_compression, law->has_liner, e).stress;
    } else if (group->law == LAW_BIOT) {
        BiotState f = biot_state(c);
        Pack major;
        s = pull_back_biot(biot_stress(law, law->no_compression, law->has_liner, f.stretch, &major), &f);
        e = (PackTensor){f.stretch.a11 - 1.0, f.stretch.a22 - 1.0, f.stretch.a12};
    } else {
        LogarithmicState f = logarithmic_state(c);
        e = f.strain;
        s = pull_back(apply_moduli(&law->whole, e), c, f.jacobian, f.pull);
    }
    to_global(s, f1, f2, share / j, result->stress); /* Cauchy stress on the current area, thickness kept */
    /* strain in the rotated material axes: R = F U^-1 */
    double inverse = 1.0 / (j * sqrt(c11 + c22 + 2.0 * j));
    double u11 = (c22 + j) * inverse, u22 = (c11 + j) * inverse, u12 = -c12 * inverse, r1[3], r2[3];
    for (int k = 0; k < 3; k++) {
        r1[k] = f1[k] * u11 + f2[k] * u12;
        r2[k] = f1[k] * u12 + f2[k] * u22;
    }
    to_global(e, r1, r2, share, result->strain);
}

static const ElementGroup *group_of(const Model *model, int64_t slot)
{
    int low = 0, high = model->group_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (model->groups[middle].first_element <= slot)
            low = middle;
        else
            high = middle - 1;
    }
    return &model->groups[low];
}

/* q.q of a quad's corners (eq. E15); 0 where its law makes no use of it. */
static double hourglass_square(const ElementGroup *group, const double *geometry, double corner[4][3])
{
    if (group->kind == ELEMENT_QUAD_FULL && group->law != LAW_BIOT) return 0.0;
    const double *skew = geometry + (group->point_count * GEOMETRY_POINT_SIZE + GEOMETRY_TAIL_SIZE) * BILLOW_LANES;
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        double x0 = corner[0][k], x1 = corner[1][k], x2 = corner[2][k], x3 = corner[3][k];
        double q = 0.25 * (((x0 - x1) + (x2 - x3)) - skew[GEOMETRY_SKEW1 * BILLOW_LANES] * ((x1 - x0) + (x2 - x3)) -
                           skew[GEOMETRY_SKEW2 * BILLOW_LANES] * ((x3 - x0) + (x2 - x1)));
        square += q * q;
    }
    return square;
}

void membrane_result(const Model *model, const double *x, int element, ElementResult *result)
{
    int64_t slot = model->element_slot[element];
    const ElementGroup *group = group_of(model, slot);
    memset(result, 0, sizeof *result);
    result->thickness = model->element_thickness[element];
    if (group->law == LAW_SURFACE) return;
    int64_t place = slot - group->first_element;
    const double *geometry =
        group->geometry + place / BILLOW_LANES * group->geometry_size * BILLOW_LANES + place % BILLOW_LANES;
    const int32_t *node = model->element_node + 4 * (ptrdiff_t)element;
    double corner[4][3], g1[3], g2[3], h[3];
    for (int a = 0; a < 4; a++) memcpy(corner[a], x + 3 * (ptrdiff_t)node[a], sizeof corner[a]);
    if (group->kind == ELEMENT_TRIANGLE) {
        for (int k = 0; k < 3; k++) {
            g1[k] = corner[1][k] - corner[0][k];
            g2[k] = corner[2][k] - corner[0][k];
        }
        add_point(group, geometry, g1, g2, (const double[3]){0}, 1.0, result);
        return;
    }
    double square = hourglass_square(group, geometry, corner);
    const double gauss = group->kind == ELEMENT_QUAD_FULL ? 0.57735026918962576 : 0.0;
    for (int p = 0; p < group->point_count; p++) {
        double xi = (p == 1 || p == 2) ? gauss : -gauss, eta = p >= 2 ? gauss : -gauss;
        for (int k = 0; k < 3; k++) {
            h[k] = 0.25 * ((corner[0][k] - corner[1][k]) + (corner[2][k] - corner[3][k]));
            g1[k] = 0.25 * ((corner[1][k] - corner[0][k]) + (corner[2][k] - corner[3][k])) + eta * h[k];
            g2[k] = 0.25 * ((corner[3][k] - corner[0][k]) + (corner[2][k] - corner[1][k])) + xi * h[k];
        }
        bool one = group->kind == ELEMENT_QUAD_ONE; /* (E17), else (E4a) */
        double more = square * (one ? 1.0 / 3.0 : 2.0 / 3.0);
        const double fold[3] = {more, more, one ? 0.0 : -(1.0 + xi * eta) * square};
        add_point(group, geometry + p * GEOMETRY_POINT_SIZE * BILLOW_LANES, g1, g2, fold, 1.0 / group->point_count,
                  result);
    }
}
