/* Distance of a point from the smooth shapes of contact entities. Equations (I1) to (I4), (I10) of docs/theory.md. */
#include <math.h>

#include "contact/contact_entity.h"
#include "solver/vector3.h"

enum { NEWTON_STEPS = 200 }; /* five or six, but near the middle planes */

static EntityGap sphere_gap(double radius, const double r[3])
{
    EntityGap gap = {.normal = {r[0], r[1], r[2]}};
    double norm = vector3_normalize(gap.normal);
    if (!(norm > 0.0)) gap.normal[2] = 1.0;
    gap.distance = norm - radius;
    return gap;
}

static EntityGap cylinder_gap(double radius, const double r[3])
{
    EntityGap gap = {.normal = {r[0], r[1], 0.0}};
    double norm = vector3_normalize(gap.normal);
    if (!(norm > 0.0)) gap.normal[0] = 1.0;
    gap.distance = norm - radius;
    return gap;
}

/* Climbs from s to the root of (I3) by Newton's method: the function is convex and decreasing, and s lies below its
 * root. Without the term of one axis (-1: with all) the root is lower. */
static double climb(const double half[3], const double above[3], const double y[3], int without, double s)
{
    for (int step = 0; step < NEWTON_STEPS; step++) {
        double value = -1.0, slope = 0.0;
        for (int k = 0; k < 3; k++) {
            double below = s + above[k];
            if (y[k] == 0.0 || k == without) continue;
            double ratio = half[k] * y[k] / below;
            value += ratio * ratio;
            slope += 2.0 * ratio * ratio / below;
        }
        if (!(value > 0.0)) break;
        double next = s + value / slope;
        if (!(next > s)) break;
        s = next;
    }
    return s;
}

/* s = t + e2 of (I3), e2 the least square of the half axes. 0: the point lies in the middle plane of the shortest axis,
 * and no root is there. */
static double ellipsoid_root(const double half[3], const double above[3], const double y[3], int least)
{
    double s = 0.0;
    for (int k = 0; k < 3; k++)
        if (k != least && half[k] * y[k] > above[k]) s = fmax(s, half[k] * y[k] - above[k]);
    bool pole = false; /* another axis as short: its term has no value at 0 */
    for (int k = 0; k < 3; k++) pole = pole || (k != least && above[k] == 0.0 && y[k] > 0.0);
    if (!pole || s > 0.0) s = climb(half, above, y, least, s);
    return climb(half, above, y, -1, fmax(s, half[least] * y[least]));
}

static EntityGap ellipsoid_gap(const double half[3], const double r[3])
{
    double square[3], above[3], y[3], x[3], rest = 1.0;
    int least = 0;
    for (int k = 0; k < 3; k++) {
        square[k] = half[k] * half[k];
        y[k] = fabs(r[k]);
        if (square[k] < square[least]) least = k;
    }
    for (int k = 0; k < 3; k++) above[k] = square[k] - square[least];
    double s = ellipsoid_root(half, above, y, least);
    for (int k = 0; k < 3; k++) {
        x[k] = y[k] == 0.0 ? 0.0 : square[k] * y[k] / (s + above[k]);
        rest -= x[k] * x[k] / square[k];
    }
    if (y[least] == 0.0 && s == 0.0) x[least] = half[least] * sqrt(fmax(rest, 0.0));
    EntityGap gap;
    for (int k = 0; k < 3; k++) gap.normal[k] = (r[k] < 0.0 ? -1.0 : 1.0) * x[k] / square[k];
    gap.distance = (s - square[least]) * vector3_normalize(gap.normal);
    return gap;
}

static EntityGap torus_gap(const double size[3], const double r[3])
{
    double rho = sqrt(r[0] * r[0] + r[1] * r[1]), across = rho - size[0], norm = sqrt(across * across + r[2] * r[2]);
    double e[2] = {rho > 0.0 ? r[0] / rho : 1.0, rho > 0.0 ? r[1] / rho : 0.0};
    if (!(norm > 0.0)) return (EntityGap){.distance = -size[1], .normal = {e[0], e[1], 0.0}};
    return (EntityGap){.distance = norm - size[1], .normal = {across / norm * e[0], across / norm * e[1], r[2] / norm}};
}

static EntityGap profile_gap(const RevolvedProfile *profile, const double r[3])
{
    double rho = sqrt(r[0] * r[0] + r[1] * r[1]), n[2];
    double distance = revolved_profile_distance(profile, rho, r[2], n);
    double e[2] = {rho > 0.0 ? r[0] / rho : 1.0, rho > 0.0 ? r[1] / rho : 0.0};
    return (EntityGap){.distance = distance, .normal = {n[0] * e[0], n[0] * e[1], n[1]}};
}

EntityGap entity_gap(const ContactEntity *entity, const double r[3])
{
    EntityGap gap = {.distance = r[2], .normal = {0.0, 0.0, 1.0}};
    if (entity->shape == ENTITY_SPHERE) gap = sphere_gap(entity->size[0], r);
    if (entity->shape == ENTITY_CYLINDER) gap = cylinder_gap(entity->size[0], r);
    if (entity->shape == ENTITY_ELLIPSOID) gap = ellipsoid_gap(entity->size, r);
    if (entity->shape == ENTITY_HULL) gap.distance = convex_hull_distance(&entity->hull, r, gap.normal);
    if (entity->shape == ENTITY_TORUS) gap = torus_gap(entity->size, r);
    if (entity->shape == ENTITY_PROFILE) gap = profile_gap(&entity->profile, r);
    if (entity->shape == ENTITY_RECTANGLE && (fabs(r[0]) > entity->size[0] || fabs(r[1]) > entity->size[1]))
        gap.distance = INFINITY;
    if (!entity->inside || isinf(gap.distance)) return gap;
    gap.distance = -gap.distance;
    for (int k = 0; k < 3; k++) gap.normal[k] = -gap.normal[k];
    return gap;
}
