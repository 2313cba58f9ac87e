/* Strains that fabric tears by. */
#include "elements/tear.h"

#include <math.h>

#include "elements/lane.h"
#include "solver/elementary.h"

/* Squared stretches are kept above this: a crumpled element has no logarithm. */
static const double least_square = 1e-12;

void tear_strains(const double c[3], double strain[2])
{
    const double mean = 0.5 * (c[0] + c[1]), half = 0.5 * (c[0] - c[1]);
    const double major = fmax(mean + sqrt(half * half + c[2] * c[2]), least_square);
    const double minor = fmax((c[0] * c[1] - c[2] * c[2]) / major, least_square);
    strain[0] = 0.5 * elementary_log(major);
    strain[1] = 0.5 * elementary_log(minor);
}

double tear_effective_strain(const double strain[2])
{
    const double a = strain[0], b = strain[1];
    return sqrt(4.0 / 3.0 * (a * a + a * b + b * b));
}

double tear_mean_strain(const ElementGroup *group, const double *geometry, const double *x, int64_t place,
                        double *volume)
{
    double corner[4][3], strain[2], sum = 0.0;
    LanePoint point[4];
    *volume = 0.0;
    lane_corners(group, x, place, corner);
    lane_points(group, geometry, corner, point);
    for (int p = 0; p < group->point_count; p++) {
        tear_strains(point[p].c, strain);
        sum += point[p].weight * tear_effective_strain(strain);
        *volume += point[p].weight;
    }
    return *volume > 0.0 ? sum / *volume : 0.0;
}
