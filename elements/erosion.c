/* Erosion of single elements. */
#include "elements/erosion.h"

#include <math.h>

#include "elements/kernels.h"
#include "elements/lane.h"
#include "elements/law_point.h"
#include "elements/tear.h"

enum { LANES = BILLOW_LANES };

/* Cauchy stress from the second Piola-Kirchhoff stress in the principal frame of b: its principal values are those of
 * U S U / J, U the stretch; the larger first. */
static void principal_stress(const double c[3], const double s[3], double scale, double principal[2])
{
    const double j = sqrt(fmax(c[0] * c[1] - c[2] * c[2], 0.0)), by_trace = 1.0 / sqrt(c[0] + c[1] + 2.0 * j);
    const double u[3] = {(c[0] + j) * by_trace, (c[1] + j) * by_trace, c[2] * by_trace};
    const double a11 = u[0] * s[0] + u[2] * s[2], a12 = u[0] * s[2] + u[2] * s[1], a21 = u[2] * s[0] + u[1] * s[2],
                 a22 = u[2] * s[2] + u[1] * s[1];
    const double t11 = scale * (a11 * u[0] + a12 * u[2]), t22 = scale * (a21 * u[2] + a22 * u[1]),
                 t12 = scale * (a11 * u[2] + a12 * u[1]);
    const double mean = 0.5 * (t11 + t22), half = 0.5 * (t11 - t22), radius = sqrt(half * half + t12 * t12);
    principal[0] = mean + radius;
    principal[1] = mean - radius;
}

static int met_by_strain(const ErosionCriteria *e, const double c[3])
{
    double strain[2];
    tear_strains(c, strain);
    return ((e->active & EROSION_LEAST_STRAIN) && strain[1] <= e->least_strain) +
           ((e->active & EROSION_LARGEST_STRAIN) && strain[0] >= e->largest_strain) +
           ((e->active & EROSION_SHEAR_STRAIN) && 0.5 * (strain[0] - strain[1]) >= e->shear_strain) +
           ((e->active & EROSION_EFFECTIVE_STRAIN) && tear_effective_strain(strain) >= e->effective_strain);
}

/* The law's stress at a point (second Piola-Kirchhoff); stored: what it remembers of the point, NULL if nothing. */
static void find_stress(const ElementGroup *group, const double c[3], const double *stored, LawPoint *law)
{
    double memory[MEMORY_POINT_SIZE] = {0};
    const int size = stored ? law_memory_size(group->law, &group->material) : 0;
    for (int i = 0; i < size; i++) memory[i] = stored[i * LANES];
    law_point(group->law, &group->material, c, memory, 1, 0.0, 0.0, law);
}

static const double *memory_at(const double *memory, int point)
{
    return memory ? memory + (ptrdiff_t)point * MEMORY_POINT_SIZE * LANES : NULL;
}

static int met_by_stress(const ErosionCriteria *e, const ElementGroup *group, const double c[3], const double *stored)
{
    double stress[2];
    LawPoint law;
    find_stress(group, c, stored, &law);
    const double area = sqrt(fmax(c[0] * c[1] - c[2] * c[2], 0.0));
    if (!(area > 0.0)) return 0;
    /* the thickness of rubber goes with 1/area, that of all others stays */
    principal_stress(c, law.stress, group->law == LAW_RUBBER ? 1.0 : 1.0 / area, stress);
    const double a = stress[0], b = stress[1];
    return ((e->active & EROSION_LARGEST_STRESS) && a >= e->largest_stress) +
           ((e->active & EROSION_EQUIVALENT_STRESS) && sqrt(a * a - a * b + b * b) >= e->equivalent_stress);
}

bool erosion_reached(const ErosionCriteria *e, const ElementGroup *group, const double *geometry, const double *memory,
                     const double *x, int64_t place)
{
    const bool by_stress = (e->active & (EROSION_LARGEST_STRESS | EROSION_EQUIVALENT_STRESS)) != 0;
    double corner[4][3];
    LanePoint point[4];
    lane_corners(group, x, place, corner);
    lane_points(group, geometry, corner, point);
    for (int p = 0; p < group->point_count; p++) {
        int met = met_by_strain(e, point[p].c);
        if (by_stress) met += met_by_stress(e, group, point[p].c, memory_at(memory, p));
        if (met >= e->needed) return true;
    }
    return false;
}

/* In-plane hourglass energy of the one-point quad (eq. E18). */
static double hourglass_energy(const ElementGroup *group, const double *geometry, double corner[4][3])
{
    const double *skew = geometry + (ptrdiff_t)(group->point_count * GEOMETRY_POINT_SIZE + GEOMETRY_TAIL_SIZE) * LANES;
    double along[2] = {0};
    for (int k = 0; k < 3; k++) {
        const double a = 0.25 * ((corner[1][k] - corner[0][k]) + (corner[2][k] - corner[3][k]));
        const double b = 0.25 * ((corner[3][k] - corner[0][k]) + (corner[2][k] - corner[1][k]));
        const double h = 0.25 * ((corner[0][k] - corner[1][k]) + (corner[2][k] - corner[3][k]));
        const double q = h - skew[GEOMETRY_SKEW1 * LANES] * a - skew[GEOMETRY_SKEW2 * LANES] * b;
        along[0] += q * a;
        along[1] += q * b;
    }
    return 0.5 * (skew[GEOMETRY_HOURGLASS1 * LANES] * along[0] * along[0] +
                  skew[GEOMETRY_HOURGLASS2 * LANES] * along[1] * along[1]);
}

void erosion_energy(const ElementGroup *group, const double *geometry, const double *x, int64_t place, double *stored,
                    double *hourglass)
{
    double corner[4][3];
    LanePoint point[4];
    lane_corners(group, x, place, corner);
    *stored = 0.0;
    *hourglass = group->kind == ELEMENT_QUAD_ONE ? hourglass_energy(group, geometry, corner) : 0.0;
    if (!law_stores_energy(group->law, &group->material)) return;
    lane_points(group, geometry, corner, point);
    for (int p = 0; p < group->point_count; p++) {
        LawPoint law;
        law_point(group->law, &group->material, point[p].c, NULL, 1, 0.0, 0.0, &law);
        *stored += point[p].weight * law.energy;
    }
}

double erosion_last_work(const ElementGroup *group, const double *geometry, const double *memory, const double *x,
                         const double *v, double step, int64_t place)
{
    double corner[4][3], before[4][3], work = 0.0;
    LanePoint now[4], then[4];
    lane_corners(group, x, place, corner);
    lane_corners(group, v, place, before);
    for (int a = 0; a < group->corner_count; a++)
        for (int k = 0; k < 3; k++) before[a][k] = corner[a][k] - step * before[a][k];
    lane_points(group, geometry, corner, now);
    lane_points(group, geometry, before, then);
    for (int p = 0; p < group->point_count; p++) {
        LawPoint law;
        double change[3];
        find_stress(group, then[p].c, memory_at(memory, p), &law);
        for (int k = 0; k < 3; k++) change[k] = 0.5 * (now[p].c[k] - then[p].c[k]); /* of Green's strain */
        work += 0.5 * now[p].weight *
                (law.stress[0] * change[0] + law.stress[1] * change[1] + 2.0 * law.stress[2] * change[2]);
    }
    return work;
}

void erosion_take_out(const ElementGroup *group, double *geometry)
{
    const int tail = group->point_count * GEOMETRY_POINT_SIZE;
    for (int p = 0; p < group->point_count; p++) geometry[(p * GEOMETRY_POINT_SIZE + GEOMETRY_WEIGHT) * LANES] = 0.0;
    for (int i = tail; i < group->geometry_size; i++) geometry[i * LANES] = 0.0;
}
