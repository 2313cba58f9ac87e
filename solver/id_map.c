/* User ids to internal indices: a sorted array with binary search. */
#include "solver/id_map.h"

#include <stdlib.h>

#include "solver/memory.h"

typedef struct IdPair {
    int id;
    int32_t index;
} IdPair;

static int compare_pairs(const void *a, const void *b)
{
    const IdPair *p = a, *q = b;
    if (p->id != q->id) return p->id < q->id ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

int id_map_build(IdMap *map, const int *first, size_t count, size_t stride, int32_t *duplicate)
{
    *map = (IdMap){0};
    if (duplicate) *duplicate = -1;
    if (count == 0) return 0;
    IdPair *pairs = memory_alloc(count, sizeof *pairs);
    map->id = memory_alloc(count, sizeof *map->id);
    map->index = memory_alloc(count, sizeof *map->index);
    if (!pairs || !map->id || !map->index) {
        memory_free(pairs);
        id_map_free(map);
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        pairs[i].id = *(const int *)(const void *)((const char *)first + i * stride);
        pairs[i].index = (int32_t)i;
    }
    qsort(pairs, count, sizeof *pairs, compare_pairs);
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && pairs[i].id == pairs[i - 1].id) {
            if (duplicate && (*duplicate < 0 || pairs[i].index < *duplicate)) *duplicate = pairs[i].index;
            continue;
        }
        map->id[map->count] = pairs[i].id;
        map->index[map->count++] = pairs[i].index;
    }
    memory_free(pairs);
    return 0;
}

size_t id_map_lower(const IdMap *map, int id)
{
    if (map->count == 0 || id <= map->id[0]) return 0;
    /* Consecutive ids stand at their distance from the first. */
    size_t guess = (size_t)((long long)id - map->id[0]);
    if (guess < map->count && map->id[guess] == id) return guess;
    size_t low = 0, high = map->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (map->id[middle] < id) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

int32_t id_map_find(const IdMap *map, int id)
{
    size_t place = id_map_lower(map, id);
    return place < map->count && map->id[place] == id ? map->index[place] : -1;
}

void id_map_free(IdMap *map)
{
    memory_free(map->id);
    memory_free(map->index);
    *map = (IdMap){0};
}
