/* Bodies of revolution by the outline of their half section, which may be concave and need not be closed. Theory:
 * docs/theory.md, Smooth impactors. */
#ifndef BILLOW_REVOLVED_PROFILE_H
#define BILLOW_REVOLVED_PROFILE_H

#include <stdbool.h>

typedef enum ProfileFault {
    PROFILE_FINE,
    PROFILE_SHORT,    /* less than two different points */
    PROFILE_NEGATIVE, /* a radius below 0 */
    PROFILE_ON_AXIS,  /* a point on the axis that is no end */
    PROFILE_CROSSES,  /* two edges meet elsewhere than at the point between them */
    PROFILE_FLAT,     /* it has no inside */
} ProfileFault;

/* From a point of the outline to the next. The body lies on the other side than the normal. */
typedef struct ProfileEdge {
    double r, z;      /* its first point: distance from the axis, place along it [L] */
    double normal[2]; /* unit vector out of the body */
    double length;    /* [L] */
} ProfileEdge;

/* Immutable. */
typedef struct RevolvedProfile {
    int edge_count;
    ProfileEdge *edge;
    bool loop;     /* the last edge ends where the first begins: a ring */
    double end[2]; /* the last point, r and z [L] */
    double reach;  /* farthest point from the origin, r = z = 0 [L] */
} RevolvedProfile;

/* Makes the profile through points at z with the radius r (count each, in either direction). *fault says what is wrong
 * with it, *where at which point (from 0). 0, or -1 without memory; release with revolved_profile_free. */
int revolved_profile_make(int count, const double *z, const double *r, RevolvedProfile *profile, ProfileFault *fault,
                          int *where);
void revolved_profile_free(RevolvedProfile *profile);

/* True if its first (0) or last (1) point is an end off the axis, beyond which there is nothing. */
bool revolved_profile_open(const RevolvedProfile *profile, int end);

/* Signed distance of (r, z), r >= 0, negative inside, and its unit vector (r, z) away from the nearest point. INFINITY
 * where the nearest point is an open end. Equations (I11), (I12). */
double revolved_profile_distance(const RevolvedProfile *profile, double r, double z, double normal[2]);

#endif
