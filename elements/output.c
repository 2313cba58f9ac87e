/* Stress, strain and thickness of one element for the writers, at its centre and with the laws of the kernels. */
#include <math.h>
#include <string.h>

#include "elements/lane.h"
#include "elements/law_point.h"
#include "elements/membrane.h"
#include "elements/reference.h"

/* Squared areas are kept above this (elements/kernel_law.h). */
static const double least_square = 1e-12;

/* Symmetric tensor sum of t11 u u + t22 w w + t12 (u w + w u) in order xx yy zz xy yz zx. */
static void to_global(const double t[3], const double u[3], const double w[3], double scale, double out[6])
{
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int i = 0; i < 6; i++) {
        int a = row[i], b = column[i];
        out[i] += scale * (t[0] * u[a] * u[b] + t[1] * w[a] * w[b] + t[2] * (u[a] * w[b] + u[b] * w[a]));
    }
}

/* One point's share of the element's means. stored: the law's, NULL: never loaded before. thickness: of the reference.
 */
static void add_point(const ElementGroup *group, const LanePoint *point, const double *stored, double share,
                      double thickness, ElementResult *result)
{
    const double *c = point->c;
    double j = sqrt(fmax(c[0] * c[1] - c[2] * c[2], least_square)), memory[MEMORY_POINT_SIZE] = {0};
    int size = stored ? law_memory_size(group->law, &group->material) : 0;
    for (int i = 0; i < size; i++) memory[i] = stored[i * BILLOW_LANES];
    LawPoint law;
    law_point(group->law, &group->material, c, memory, 1, 0.0, 0.0, &law);
    bool thins = group->law == LAW_RUBBER; /* J = 1 with the thickness; others keep theirs */
    result->thickness += share * (thins ? thickness / j : thickness);
    if (point->weight > 0.0) /* Cauchy stress */
        to_global(law.stress, point->f1, point->f2, thins ? share : share / j, result->stress);
    /* strain in the rotated material axes: R = F U^-1 */
    double inverse = 1.0 / (j * sqrt(c[0] + c[1] + 2.0 * j));
    double u11 = (c[1] + j) * inverse, u22 = (c[0] + j) * inverse, u12 = -c[2] * inverse, r1[3], r2[3];
    for (int k = 0; k < 3; k++) {
        r1[k] = point->f1[k] * u11 + point->f2[k] * u12;
        r2[k] = point->f1[k] * u12 + point->f2[k] * u22;
    }
    to_global(law.strain, r1, r2, share, result->strain);
}

void membrane_result(const Model *model, const State *state, const double *x, int element, ElementResult *result)
{
    int64_t slot = model->element_slot[element];
    int number = lane_group(model, slot);
    const ElementGroup *group = &model->groups[number];
    double thickness = model->element_thickness[element];
    memset(result, 0, sizeof *result);
    if (group->law == LAW_SURFACE) {
        result->thickness = thickness;
        return;
    }
    int64_t place = slot - group->first_element;
    if (group->erosion && state->eroded[slot]) { /* no stress, no strain */
        result->thickness = thickness;
        return;
    }
    double own[REFERENCE_LANE_SIZE], corner[4][3];
    const double *geometry = reference_lane(model, state, number, place, own), *memory = NULL;
    if (state->history && law_memory_size(group->law, &group->material) > 0)
        memory = state->history + group->history_offset +
                 (place / BILLOW_LANES * group->history_size + history_size(group->point_count)) * BILLOW_LANES +
                 place % BILLOW_LANES;
    LanePoint point[4];
    lane_corners(group, x, place, corner);
    lane_points(group, geometry, corner, point);
    for (int p = 0; p < group->point_count; p++)
        add_point(group, &point[p], memory ? memory + (ptrdiff_t)p * MEMORY_POINT_SIZE * BILLOW_LANES : NULL,
                  1.0 / group->point_count, thickness, result);
}
