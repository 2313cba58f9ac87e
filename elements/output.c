/* Stress, strain and thickness of one element for the writers, at its centre and with the laws of the kernels. */
#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "elements/law_point.h"
#include "elements/membrane.h"

/* Squared areas are kept above this (elements/kernel_law.h). */
static const double least_square = 1e-12;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Symmetric tensor sum of t11 u u + t22 w w + t12 (u w + w u) in order xx yy zz xy yz zx. */
static void to_global(const double t[3], const double u[3], const double w[3], double scale, double out[6])
{
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int i = 0; i < 6; i++) {
        int a = row[i], b = column[i];
        out[i] += scale * (t[0] * u[a] * u[b] + t[1] * w[a] * w[b] + t[2] * (u[a] * w[b] + u[b] * w[a]));
    }
}

/* A point: its constants and memory, natural gradients of the position, what the free fold adds to the metric (11, 22,
 * 12), share of the element, reference thickness. */
typedef struct OutputPoint {
    const double *constants, *memory;
    double g1[3], g2[3], fold[3], share, thickness;
} OutputPoint;

/* Columns of F are the images of the material axes. */
static void add_point(const ElementGroup *group, const OutputPoint *point, ElementResult *result)
{
    const double *constants = point->constants, *g1 = point->g1, *g2 = point->g2, *fold = point->fold;
    double m11 = constants[GEOMETRY_M11 * BILLOW_LANES], m12 = constants[GEOMETRY_M12 * BILLOW_LANES],
           m21 = constants[GEOMETRY_M21 * BILLOW_LANES], m22 = constants[GEOMETRY_M22 * BILLOW_LANES];
    double f1[3], f2[3];
    for (int k = 0; k < 3; k++) {
        f1[k] = m11 * g1[k] + m21 * g2[k];
        f2[k] = m12 * g1[k] + m22 * g2[k];
    }
    double c11 = dot(f1, f1) + m11 * (m11 * fold[0] + m21 * fold[2]) + m21 * (m11 * fold[2] + m21 * fold[1]);
    double c22 = dot(f2, f2) + m12 * (m12 * fold[0] + m22 * fold[2]) + m22 * (m12 * fold[2] + m22 * fold[1]);
    double c12 = dot(f1, f2) + m11 * (m12 * fold[0] + m22 * fold[2]) + m21 * (m12 * fold[2] + m22 * fold[1]);
    double j = sqrt(fmax(c11 * c22 - c12 * c12, least_square));
    double memory[MEMORY_POINT_SIZE] = {0};
    int size = point->memory ? law_memory_size(group->law, &group->material) : 0;
    for (int i = 0; i < size; i++) memory[i] = point->memory[i * BILLOW_LANES];
    LawPoint law;
    law_point(group->law, &group->material, (double[3]){c11, c22, c12}, memory, 1, 0.0, 0.0, &law);
    bool thins = group->law == LAW_RUBBER; /* J = 1 with the thickness; others keep theirs */
    result->thickness += point->share * (thins ? point->thickness / j : point->thickness);
    to_global(law.stress, f1, f2, thins ? point->share : point->share / j, result->stress); /* Cauchy stress */
    /* strain in the rotated material axes: R = F U^-1 */
    double inverse = 1.0 / (j * sqrt(c11 + c22 + 2.0 * j));
    double u11 = (c22 + j) * inverse, u22 = (c11 + j) * inverse, u12 = -c12 * inverse, r1[3], r2[3];
    for (int k = 0; k < 3; k++) {
        r1[k] = f1[k] * u11 + f2[k] * u12;
        r2[k] = f1[k] * u12 + f2[k] * u22;
    }
    to_global(law.strain, r1, r2, point->share, result->strain);
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

void membrane_result(const Model *model, const double *x, const double *history, int element, ElementResult *result)
{
    int64_t slot = model->element_slot[element];
    const ElementGroup *group = group_of(model, slot);
    memset(result, 0, sizeof *result);
    if (group->law == LAW_SURFACE) {
        result->thickness = model->element_thickness[element];
        return;
    }
    int64_t place = slot - group->first_element, block = place / BILLOW_LANES, lane = place % BILLOW_LANES;
    const double *geometry = group->geometry + block * group->geometry_size * BILLOW_LANES + lane;
    const double *memory = NULL;
    if (history && law_memory_size(group->law, &group->material) > 0)
        memory = history + group->history_offset +
                 (block * group->history_size + history_size(group->point_count)) * BILLOW_LANES + lane;
    const int32_t *node = model->element_node + 4 * (ptrdiff_t)element;
    double corner[4][3], h[3];
    OutputPoint point = {.constants = geometry, .memory = memory, .thickness = model->element_thickness[element]};
    for (int a = 0; a < 4; a++) memcpy(corner[a], x + 3 * (ptrdiff_t)node[a], sizeof corner[a]);
    point.share = 1.0 / group->point_count;
    if (group->kind == ELEMENT_TRIANGLE) {
        for (int k = 0; k < 3; k++) {
            point.g1[k] = corner[1][k] - corner[0][k];
            point.g2[k] = corner[2][k] - corner[0][k];
        }
        add_point(group, &point, result);
        return;
    }
    bool one = group->kind == ELEMENT_QUAD_ONE; /* (E17), else (E4a) */
    double square = hourglass_square(group, geometry, corner), more = square * (one ? 1.0 / 3.0 : 2.0 / 3.0);
    const double gauss = one ? 0.0 : 0.57735026918962576;
    for (int p = 0; p < group->point_count; p++) {
        double xi = (p == 1 || p == 2) ? gauss : -gauss, eta = p >= 2 ? gauss : -gauss;
        for (int k = 0; k < 3; k++) {
            h[k] = 0.25 * ((corner[0][k] - corner[1][k]) + (corner[2][k] - corner[3][k]));
            point.g1[k] = 0.25 * ((corner[1][k] - corner[0][k]) + (corner[2][k] - corner[3][k])) + eta * h[k];
            point.g2[k] = 0.25 * ((corner[3][k] - corner[0][k]) + (corner[2][k] - corner[1][k])) + xi * h[k];
        }
        point.constants = geometry + p * GEOMETRY_POINT_SIZE * BILLOW_LANES;
        if (memory) point.memory = memory + (ptrdiff_t)p * MEMORY_POINT_SIZE * BILLOW_LANES;
        const double fold[3] = {more, more, one ? 0.0 : -(1.0 + xi * eta) * square};
        memcpy(point.fold, fold, sizeof fold);
        add_point(group, &point, result);
    }
}
