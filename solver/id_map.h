/* User ids to internal indices: a sorted array with binary search. */
#ifndef BILLOW_ID_MAP_H
#define BILLOW_ID_MAP_H

#include <stddef.h>
#include <stdint.h>

typedef struct IdMap {
    size_t count;
    int *id;        /* ascending (count), owned */
    int32_t *index; /* index of id[k] in the records (count), owned */
} IdMap;

/* Builds the map from records of stride bytes whose int id stands at first, the index being the record's number.
 * Where an id occurs twice the first record counts, and *duplicate (may be NULL) receives the index of
 * the first later record that repeats an id, else -1. 0, or -1 without memory (the map is then empty). O(n log n). */
int id_map_build(IdMap *map, const int *first, size_t count, size_t stride, int32_t *duplicate);

/* Index of id, or -1. O(1) where ids are consecutive, else O(log n). */
int32_t id_map_find(const IdMap *map, int id);

/* Position in map->id of the first id >= the given one (map->count if none): for ranges of ids. */
size_t id_map_lower(const IdMap *map, int id);

void id_map_free(IdMap *map);

#endif
