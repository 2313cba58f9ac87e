/* Tree of boxes over facets: does anything lie between two points? The answer does not depend on how the tree was
 * built, only the time does. */
#ifndef BILLOW_RAY_TREE_H
#define BILLOW_RAY_TREE_H

#include <stdbool.h>
#include <stdint.h>

/* Boxes in depth-first order: the first child of box i is i + 1, the second starts where the first's next points. */
typedef struct RayBox {
    float low[3], high[3]; /* rounded outwards: half a cache line a box */
    int32_t next;          /* box to go on with when this one is missed */
    int32_t facets;        /* leaf: its facets are order[facets / 8 ..], facets % 8 of them; inner box: 0 */
} RayBox;

typedef struct RayTree {
    int facet_count, box_count;
    const int32_t *node; /* the caller's facets (facet_count x 4), triangles repeat the third node */
    int32_t *order;      /* facets by leaf (facet_count) */
    RayBox *box;         /* (2 x facet_count) */
    int32_t *hint;       /* last facet found in front of each, plus 1; 0: none (facet_count) */
    double *middle;      /* centroids while building (facet_count x 3) */
    double built_size;   /* surface of all boxes over all facets when it was built */
    const int8_t *side;  /* (facet_count) +1: the normal by the order of the nodes points out; 0: the facet is not
                          * there; NULL: all facets block. With it only those block that the line passes inwards. The
                          * caller's */
    int from_count;
    double from[2][3]; /* with side: lines start between these points */
} RayTree;

/* Allocates for facet_count facets whose nodes must outlive the tree; 0, or -1 without memory. */
int ray_tree_create(RayTree *tree, int facet_count, const int32_t *node);
void ray_tree_free(RayTree *tree);

/* Builds the boxes at positions x (.. x 3) by halving at the median of the longest axis. O(n log n). */
void ray_tree_build(RayTree *tree, const double *x);

/* Only facets whose outer side is seen from a point between these two block, from the next fit on. */
void ray_tree_sides(RayTree *tree, const int8_t *side, const double from[3], const double to[3]);

/* Fits the boxes to moved positions; builds anew where they have grown to twice the surface. O(n). */
void ray_tree_refit(RayTree *tree, const double *x);

/* The same in two steps: the leaves part by part, which may go on at the same time, then the rest. */
void ray_tree_fit_leaves(RayTree *tree, const double *x, int part, int parts);
void ray_tree_finish(RayTree *tree, const double *x);

/* True if a facet other than skip, the line's target (-1: none), crosses the line from a to b, at a distance of more
 * than margin from b. A quad is taken as its two triangles at the diagonal 1-3. */
bool ray_tree_blocked(RayTree *tree, const double *x, const double a[3], const double b[3], int skip, double margin);

#endif
