/* One element at a time, in scalar form: for the writers, and for what the kernels do not do. */
#ifndef BILLOW_LANE_H
#define BILLOW_LANE_H

#include "solver/model.h"

/* A point's kinematics. */
typedef struct LanePoint {
    double f1[3], f2[3]; /* columns of F: images of the material axes; without the fold's share */
    double c[3];         /* right Cauchy-Green tensor (11, 22, 12), with it (eq. E4, E4a, E17) */
    double weight;       /* reference area x thickness [L3] */
} LanePoint;

/* The group of a padded element index. */
int lane_group(const Model *model, int64_t slot);

/* Current corners of the group's element at a place (from 0, padded by blocks); triangles have three. */
void lane_corners(const ElementGroup *group, const double *x, int64_t place, double corner[4][3]);

/* Points of the element at these corners; geometry: the lane's constants, stride BILLOW_LANES. point (point_count). */
void lane_points(const ElementGroup *group, const double *geometry, double corner[4][3], LanePoint *point);

/* Work of the in-plane hourglass control of a one-point quad (eq. E18) at corner[0] on the way from there; 0 of others.
 * corner[2] as far ahead as corner[1] is behind. */
double lane_hourglass_work(const ElementGroup *group, const double *geometry, double corner[3][4][3]);

/* Place of the lane's first constant. */
static inline ptrdiff_t lane_offset(const ElementGroup *group, int64_t place)
{
    return place / BILLOW_LANES * group->geometry_size * BILLOW_LANES + place % BILLOW_LANES;
}

#endif
