/* Covers over holes that open in a bag's surface during the run: volume under them (docs/theory.md, X10). */
#ifndef BILLOW_HOLE_COVER_H
#define BILLOW_HOLE_COVER_H

#include <stdbool.h>
#include <stdint.h>

/* Facets that can be lost, and the patches of those that are. Facets that share an edge make one patch; its cover is
 * the fan of its rim about the mean of the rim's nodes, so that nodes within the patch have no say. */
typedef struct HoleCover {
    int facet_count;
    int32_t *node;      /* (facet_count x 4), wound outwards; triangles repeat the third */
    int32_t *neighbour; /* facet beyond each side (facet_count x 4), -1 if none or more than one */
    int64_t *element;   /* the caller's number of each facet (facet_count), ascending */
    /* of the lost facets, made by hole_cover_update: */
    int patch_count;
    int32_t *first_side; /* of each patch in side (facet_count + 1) */
    int32_t *side;       /* rim sides, start and end node (4 facet_count x 2) */
    int32_t *stack;      /* workspace (facet_count) */
    unsigned char *seen; /* workspace (facet_count) */
} HoleCover;

/* A cover without lost facets over facets node (facet_count x 4, copied). 0, or -1 without memory. */
int hole_cover_create(HoleCover *cover, int facet_count, const int32_t *node, const int64_t *element);
void hole_cover_free(HoleCover *cover);

/* Finds the patches of lost facets: lost[element] != 0. No memory is taken. */
void hole_cover_update(HoleCover *cover, const unsigned char *lost);

/* Volume under all covers about origin [L3]. */
double hole_cover_volume(const HoleCover *cover, const double *x, const double origin[3]);

#endif
