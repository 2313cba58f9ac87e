/* Triangles that go through each other: is a mesh free of intersections? On bare arrays, for any caller. */
#ifndef BILLOW_MESH_CROSSING_H
#define BILLOW_MESH_CROSSING_H

#include <stdint.h>

typedef struct MeshCrossings {
    int count;       /* pairs of facets that go through each other */
    int facet[2];    /* the pair with the longest way of an edge behind the other's plane; -1 none */
    double depth;    /* that way: the shorter part of the edge, cut at the plane [L] */
    double place[3]; /* where the edge meets the plane [L] */
} MeshCrossings;

/* Looks at facets (facet_count x 4, triangles repeat the third node; a quadrilateral counts as two triangles) with
 * nodes at x (nodes x 3) [L]. Pairs that share a node are passed over, so are those of which neither has its flag in
 * wanted (facet_count; NULL: all wanted). An edge counts that passes strictly from one side of a triangle to the other
 * inside it; facets that touch or lie in one plane do not go through each other. The count does not depend on the order
 * of facets. Returns 0, or -1 without memory. O(n) for facets of similar size. */
int mesh_find_crossings(int facet_count, const int32_t *facet, const double *x, const unsigned char *wanted,
                        MeshCrossings *crossings);

#endif
