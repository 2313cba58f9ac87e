/* Distance of a point from the shapes of rigid walls. Equations (W1) to (W4) of docs/theory.md. */
#include "contact/rigid_wall.h"

#include <math.h>

#include "solver/vector3.h"

static bool within(double coordinate, double length)
{
    return length <= 0 || (coordinate >= 0 && coordinate <= length);
}

static WallGap plane_gap(const RigidWall *wall, const double r[3])
{
    const double *l = wall->axes, *m = wall->axes + 3, *n = wall->axes + 6;
    WallGap gap = {.distance = vector3_dot(n, r), .normal = {n[0], n[1], n[2]}};
    gap.over = within(vector3_dot(l, r), wall->length[0]) && within(vector3_dot(m, r), wall->length[1]);
    return gap;
}

static WallGap sphere_gap(const RigidWall *wall, const double r[3])
{
    WallGap gap = {.normal = {r[0], r[1], r[2]}, .over = true};
    double norm = vector3_normalize(gap.normal);
    if (!(norm > 0))
        for (int i = 0; i < 3; i++) gap.normal[i] = wall->axes[6 + i];
    gap.distance = norm - wall->radius;
    return gap;
}

/* Takes the face of which the point is farther out. */
static void consider_face(WallGap *gap, double distance, const double normal[3], double sign)
{
    if (distance <= gap->distance) return;
    gap->distance = distance;
    for (int i = 0; i < 3; i++) gap->normal[i] = sign * normal[i];
}

static WallGap cylinder_gap(const RigidWall *wall, const double r[3])
{
    const double *n = wall->axes + 6;
    double along = vector3_dot(n, r);
    WallGap gap = {.over = true};
    for (int i = 0; i < 3; i++) gap.normal[i] = r[i] - along * n[i];
    double radius = vector3_normalize(gap.normal);
    if (!(radius > 0))
        for (int i = 0; i < 3; i++) gap.normal[i] = wall->axes[i];
    gap.distance = radius - wall->radius;
    if (wall->length[2] > 0) {
        consider_face(&gap, along - wall->length[2], n, 1);
        consider_face(&gap, -along, n, -1);
    }
    return gap;
}

static WallGap prism_gap(const RigidWall *wall, const double r[3])
{
    WallGap gap = {.distance = vector3_dot(wall->axes + 6, r), .over = true};
    for (int i = 0; i < 3; i++) gap.normal[i] = wall->axes[6 + i];
    if (wall->length[2] > 0) consider_face(&gap, -gap.distance - wall->length[2], wall->axes + 6, -1);
    for (int side = 0; side < 2; side++) {
        const double *axis = wall->axes + 3 * side;
        double along = vector3_dot(axis, r);
        if (!(wall->length[side] > 0)) continue;
        consider_face(&gap, along - wall->length[side], axis, 1);
        consider_face(&gap, -along, axis, -1);
    }
    return gap;
}

WallGap rigid_wall_gap(const RigidWall *wall, const double r[3])
{
    switch (wall->shape) {
    case WALL_SPHERE:
        return sphere_gap(wall, r);
    case WALL_CYLINDER:
        return cylinder_gap(wall, r);
    case WALL_PRISM:
        return prism_gap(wall, r);
    case WALL_PLANE:
        break;
    }
    return plane_gap(wall, r);
}
