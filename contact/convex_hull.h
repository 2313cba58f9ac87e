/* Closed convex surfaces of facets: is a mesh one, and how far is a point from it? Theory: docs/theory.md, Smooth
 * impactors. */
#ifndef BILLOW_CONVEX_HULL_H
#define BILLOW_CONVEX_HULL_H

#include <stdint.h>

typedef enum HullKind {
    HULL_CONVEX,
    HULL_OPEN,    /* some edge does not have two triangles */
    HULL_CONCAVE, /* a corner lies beyond a face by more than a thousandth of the size */
    HULL_FLAT,    /* it encloses nothing */
} HullKind;

/* Immutable. A quadrilateral counts as two triangles; triangles in one plane share it. Places are relative to origin.
 */
typedef struct ConvexHull {
    double origin[3]; /* middle of the corners' box [L] */
    double radius;    /* farthest corner from the origin [L] */
    double dent;      /* the farthest that a corner lies beyond a plane [L] */
    int corner_count, plane_count, triangle_count;
    double *corner;    /* (corner_count x 3) [L] */
    double *plane;     /* outward unit normal and distance from the origin (plane_count x 4) */
    int32_t *triangle; /* corners (triangle_count x 3) */
    int32_t *side;     /* plane of each triangle (triangle_count) */
} ConvexHull;

/* Makes the hull of facets (facet_count x 4 nodes, triangles repeat the third) at x (nodes x 3). *kind says what it is;
 * hull is complete for HULL_CONVEX and HULL_CONCAVE only. 0, or -1 without memory; release with convex_hull_free. */
int convex_hull_make(int facet_count, const int32_t *facet, const double *x, ConvexHull *hull, HullKind *kind);
void convex_hull_free(ConvexHull *hull);

/* Signed distance of r (from the origin), negative inside; normal: unit vector away from the nearest point. */
double convex_hull_distance(const ConvexHull *hull, const double r[3], double normal[3]);

/* How deep two convex hulls lie in each other by libccd's portal refinement: the length of one way out, not always the
 * shortest, and a place between them; 0 if they are apart. */
double convex_hull_overlap(const ConvexHull *a, const ConvexHull *b, double place[3]);

#endif
