/* Finds the shell that a segment covers, by its set of nodes. */
#ifndef BILLOW_FACET_MAP_H
#define BILLOW_FACET_MAP_H

#include <stddef.h>
#include <stdint.h>

/* Sorted node quadruples of facets. */
typedef struct FacetMap {
    size_t count;
    struct FacetKey *keys; /* (count), owned */
} FacetMap;

/* node: (count x 4) with a stride of bytes between facets; triangles repeat the third node. 0, or -1 without memory. */
int facet_map_build(FacetMap *map, const int32_t *node, size_t count, size_t stride);

/* Index of a facet with exactly these nodes, or -1; *sign is +1 if it winds the same way, -1 if the other way. */
int32_t facet_map_find(const FacetMap *map, const int32_t node[4], int *sign);

void facet_map_free(FacetMap *map);

#endif
