/* Reference geometry in a run: constants, step, energy. */
#define BILLOW_KERNEL_LEVEL 2 /* the laws on the smallest packs; the first lane counts */
#include "elements/reference.h"
#include "elements/kernel_law.h"

#include <math.h>

#include "elements/lane.h"
#include "elements/law_point.h"

enum { LANES = BILLOW_LANES };

bool reference_changes_lanes(const ElementGroup *group)
{
    return group->has_reference && (group->rule.liner_waits || group->rule.restore != RESTORE_NEVER);
}

/* dX/d(natural) = M^-1 of a point; returns its determinant. */
static double invert(const double *m, double j[4])
{
    double det =
        1.0 / (m[GEOMETRY_M11 * LANES] * m[GEOMETRY_M22 * LANES] - m[GEOMETRY_M12 * LANES] * m[GEOMETRY_M21 * LANES]);
    j[0] = m[GEOMETRY_M22 * LANES] * det;
    j[1] = -m[GEOMETRY_M12 * LANES] * det;
    j[2] = -m[GEOMETRY_M21 * LANES] * det;
    j[3] = m[GEOMETRY_M11 * LANES] * det;
    return det;
}

/* One point between the reference with the initial tension (share 0) and without it (share 1): M^-1 goes linearly. */
static void mix_point(const double *tension, const double *without, double share, double *out)
{
    double j0[4], j1[4], j[4], before = invert(tension, j0);
    invert(without, j1);
    for (int i = 0; i < 4; i++) j[i] = j0[i] + share * (j1[i] - j0[i]);
    double det = j[0] * j[3] - j[1] * j[2];
    out[GEOMETRY_M11 * LANES] = j[3] / det;
    out[GEOMETRY_M12 * LANES] = -j[1] / det;
    out[GEOMETRY_M21 * LANES] = -j[2] / det;
    out[GEOMETRY_M22 * LANES] = j[0] / det;
    out[GEOMETRY_WEIGHT * LANES] = det / before * tension[GEOMETRY_WEIGHT * LANES];
}

/* Constants between the two, the frequencies by their bounds (eq. R6). */
static void mix_lane(const ElementGroup *group, const double *tension, const double *without, double share, double *out)
{
    double shrunk = 1.0, grown = 1.0; /* largest ratios of weights: without the tension, now, with it */
    for (int p = 0; p < group->point_count; p++) {
        ptrdiff_t at = (ptrdiff_t)p * GEOMETRY_POINT_SIZE * LANES;
        mix_point(tension + at, without + at, share, out + at);
        double now = out[at + GEOMETRY_WEIGHT * LANES];
        if (!(now > 0.0)) continue; /* beyond the last element */
        shrunk = fmax(shrunk, without[at + GEOMETRY_WEIGHT * LANES] / now);
        grown = fmax(grown, now / tension[at + GEOMETRY_WEIGHT * LANES]);
    }
    ptrdiff_t tail = (ptrdiff_t)group->point_count * GEOMETRY_POINT_SIZE * LANES;
    for (ptrdiff_t i = tail; i < (ptrdiff_t)group->geometry_size * LANES; i += LANES)
        out[i] = tension[i] + share * (without[i] - tension[i]);
    ptrdiff_t rate = tail + GEOMETRY_RATE * LANES, stress = tail + GEOMETRY_STRESS_RATE * LANES;
    out[rate] = fmax(tension[rate], without[rate] * shrunk);
    out[stress] = tension[stress] * grown;
}

void reference_constants(const ElementGroup *group, double share, bool reached, int64_t place, double *out)
{
    ptrdiff_t offset = lane_offset(group, place);
    const double *without = group->geometry + offset;
    if (share < 1.0 && group->tension_geometry) {
        mix_lane(group, group->tension_geometry + offset, without, share, out);
    } else {
        for (ptrdiff_t i = 0; i < (ptrdiff_t)group->geometry_size * LANES; i += LANES) out[i] = without[i];
    }
    if (reached || !group->rule.liner_waits) return;
    for (int p = 0; p < group->point_count; p++) out[(p * GEOMETRY_POINT_SIZE + GEOMETRY_WEIGHT) * LANES] = 0.0;
}

const double *reference_lane(const Model *model, const State *state, int number, int64_t place, double *own)
{
    const ElementGroup *group = &model->groups[number];
    ptrdiff_t offset = lane_offset(group, place);
    if (!group->has_reference) return group->geometry + offset;
    const ReferenceState *now = &state->reference[number];
    if (!now->born) return group->mesh_geometry + offset;
    if (!reference_changes_lanes(group)) return group->geometry + offset;
    bool reached = !group->rule.liner_waits || state->reached[group->first_element + place];
    reference_constants(group, now->applied, reached, place, own);
    return own;
}

/* Smallest squared stretch over an element's points. */
static double least_square(const ElementGroup *group, const LanePoint *point)
{
    double least = INFINITY;
    for (int p = 0; p < group->point_count; p++) {
        const double *c = point[p].c;
        double half = 0.5 * (c[0] - c[1]), mean = 0.5 * (c[0] + c[1]);
        double minor = (c[0] * c[1] - c[2] * c[2]) / (mean + sqrt(half * half + c[2] * c[2]));
        least = minor < least ? minor : least;
    }
    return least > BILLOW_LEAST_SQUARED_STRETCH ? least : BILLOW_LEAST_SQUARED_STRETCH;
}

double reference_least_square(const ElementGroup *group, const double *geometry, const double *x, int64_t place)
{
    double corner[4][3];
    LanePoint point[4];
    lane_corners(group, x, place, corner);
    lane_points(group, geometry, corner, point);
    return least_square(group, point);
}

/* Squared frequency of a point of FORM 0 and 1 with the tension field: the shear stiffness of what is wrinkled goes
 * with its share of the principal stresses (eq. R8). */
static double field_rate(const ElementGroup *group, const double *tail, const double *c)
{
    const FabricLaw *law = &group->material;
    double reference = tail[GEOMETRY_RATE * LANES];
    PackTensor metric = {pack_of(c[0]), pack_of(c[1]), pack_of(c[2])};
    BiotState f = biot_state(metric);
    PackTensor e = {f.stretch.a11 - 1.0, f.stretch.a22 - 1.0, f.stretch.a12}, t = apply_moduli(&law->fabric, e);
    double mean = 0.5 * (t.a11[0] + t.a22[0]), half = 0.5 * (t.a11[0] - t.a22[0]);
    double radius = sqrt(half * half + t.a12[0] * t.a12[0]), major = mean + radius;
    if (!(major > 0.0)) return fmax(reference, law->slack_share * f.wide[0] * reference);
    double share = mean - radius < 0.0 ? major / (2.0 * radius) : 1.0;
    share = fmax(share, law->slack_share);
    PackTensor s = pull_back_biot(biot_stress(law, true, law->has_liner, f.stretch, &(Pack){0}), &f);
    return fmax(1.0, share * f.wide[0]) * reference + major_bound(s)[0] * tail[GEOMETRY_STRESS_RATE * LANES];
}

/* By the rule of the step, of one element. */
static double lane_rate_of(const ElementGroup *group, const double *lane, const double *x, int64_t place)
{
    const double *tail = lane + (ptrdiff_t)group->point_count * GEOMETRY_POINT_SIZE * LANES;
    double corner[4][3], reference = tail[GEOMETRY_RATE * LANES], rate = reference;
    LanePoint point[4];
    if (!(reference > 0.0) || (group->rdt && !reference_replaces_rate(group))) return reference;
    lane_corners(group, x, place, corner);
    lane_points(group, lane, corner, point);
    if (!group->rdt) {
        double least = fmax(least_square(group, point), group->start_square[place]);
        return least < 1.0 ? reference / least : reference;
    }
    for (int p = 0; p < group->point_count; p++) rate = fmax(rate, field_rate(group, tail, point[p].c));
    return rate;
}

bool reference_replaces_rate(const ElementGroup *group)
{
    return group->rdt && group->law == LAW_BIOT && group->material.no_compression;
}

double reference_rate(const ElementGroup *group, const double *geometry, int first, int end, const double *x,
                      double *lane_rate)
{
    double largest = 0.0;
    for (int64_t place = (int64_t)first * LANES; place < (int64_t)end * LANES; place++) {
        double rate = lane_rate_of(group, geometry + lane_offset(group, place), x, place);
        largest = rate > largest ? rate : largest;
        if (!lane_rate) continue;
        double *kept = lane_rate + (place - (int64_t)first * LANES);
        if (rate > *kept || reference_replaces_rate(group)) *kept = rate;
    }
    return largest;
}

bool reference_is_taut(const ElementGroup *group, const double *geometry, const double *x, int64_t place)
{
    ElementGroup fabric = *group;
    double corner[4][3];
    LanePoint point[4];
    fabric.material.has_liner = false;
    fabric.material.no_compression = true;
    lane_corners(group, x, place, corner);
    lane_points(group, geometry, corner, point);
    for (int p = 0; p < group->point_count; p++) {
        LawPoint law;
        law_point(fabric.law, &fabric.material, point[p].c, NULL, 1, 0.0, 0.0, &law);
        if (law.stress[0] + law.stress[1] > 1e-9 * (group->material.fabric.d11 + group->material.fabric.d22))
            return true;
    }
    return false;
}

double reference_energy(const ElementGroup *group, const double *geometry, const double *x, int64_t place)
{
    static const double at[4] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
                        share[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
    double corner[4][3], energy = 0.0;
    LanePoint point[4];
    lane_corners(group, x, place, corner);
    lane_points(group, geometry, corner, point);
    for (int p = 0; p < group->point_count; p++) {
        const double *c = point[p].c;
        double trace = fmax(c[0] + c[1], BILLOW_LEAST_SQUARED_STRETCH);
        double j = sqrt(fmax(c[0] * c[1] - c[2] * c[2], BILLOW_LEAST_SQUARED_ASPECT * (trace * trace)));
        double by_sum = 1.0 / sqrt(trace + 2.0 * j);
        double d11 = (c[0] + j) * by_sum - 1.0, d22 = (c[1] + j) * by_sum - 1.0, d12 = c[2] * by_sum; /* U - 1 */
        for (int i = 0; i < 4; i++) {
            double u11 = 1.0 + at[i] * d11, u22 = 1.0 + at[i] * d22, u12 = at[i] * d12;
            const double way[3] = {u11 * u11 + u12 * u12, u22 * u22 + u12 * u12, u12 * (u11 + u22)};
            /* half of dC = (dU U + U dU) */
            double e11 = d11 * u11 + d12 * u12, e22 = d22 * u22 + d12 * u12,
                   e12 = 0.5 * (d11 * u12 + d12 * u22 + u11 * d12 + u12 * d22);
            LawPoint law;
            law_point(group->law, &group->material, way, NULL, 1, 0.0, 0.0, &law);
            energy +=
                share[i] * point[p].weight * (law.stress[0] * e11 + law.stress[1] * e22 + 2.0 * law.stress[2] * e12);
        }
    }
    return energy;
}

/* Stress of a point in the metric c, with that of DAMP if before, the metric a step earlier, is given (eq. E13). */
static void point_stress(const ElementGroup *group, const double *tail, const double *c, const double *before,
                         const double *memory, double dt, double stress[3])
{
    const FabricLaw *law = &group->material;
    double kept[MEMORY_POINT_SIZE] = {0};
    LawPoint point;
    for (int i = 0; memory && i < law_memory_size(group->law, law); i++) kept[i] = memory[(ptrdiff_t)i * LANES];
    law_point(group->law, law, c, kept, 1, 0.0, 0.0, &point);
    for (int i = 0; i < 3; i++) stress[i] = point.stress[i];
    if (!before || !(law->damping > 0.0)) return;
    double factor = law->damping * tail[GEOMETRY_PERIOD * LANES] / dt, d11 = factor * (c[0] - before[0]),
           d22 = factor * (c[1] - before[1]);
    stress[0] += law->whole.d11 * d11 + law->whole.d12 * d22;
    stress[1] += law->whole.d12 * d11 + law->whole.d22 * d22;
    stress[2] += 2.0 * law->whole.d33 * factor * (c[2] - before[2]);
}

double reference_work(const ElementGroup *group, const double *geometry, const double *x, const double *v, double dt,
                      const double *memory, bool damped, int64_t place)
{
    const double *tail = geometry + (ptrdiff_t)group->point_count * GEOMETRY_POINT_SIZE * LANES;
    double corner[3][4][3], velocity[4][3];
    LanePoint now[4], back[4], ahead[4];
    lane_corners(group, x, place, corner[0]);
    lane_corners(group, v, place, velocity);
    for (int a = 0; a < group->corner_count; a++) {
        for (int k = 0; k < 3; k++) {
            corner[1][a][k] = corner[0][a][k] - dt * velocity[a][k];
            corner[2][a][k] = corner[0][a][k] + dt * velocity[a][k];
        }
    }
    lane_points(group, geometry, corner[0], now);
    lane_points(group, geometry, corner[1], back);
    lane_points(group, geometry, corner[2], ahead);
    double work = lane_hourglass_work(group, geometry, corner);
    for (int p = 0; p < group->point_count; p++) {
        double s[3], change[3]; /* the metric is quadratic in the positions: the part of first order */
        for (int i = 0; i < 3; i++) change[i] = 0.5 * (ahead[p].c[i] - back[p].c[i]);
        point_stress(group, tail, now[p].c, damped ? back[p].c : NULL,
                     memory ? memory + (ptrdiff_t)p * MEMORY_POINT_SIZE * LANES : NULL, dt, s);
        work += 0.5 * now[p].weight * (s[0] * change[0] + s[1] * change[1] + 2.0 * s[2] * change[2]);
    }
    return work;
}
