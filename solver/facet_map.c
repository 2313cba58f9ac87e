/* Finds the shell that a segment covers, by its set of nodes. */
#include "solver/facet_map.h"

#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"

typedef struct FacetKey {
    int32_t sorted[4], node[4], index;
} FacetKey;

static void set_key(FacetKey *key, const int32_t node[4])
{
    memcpy(key->node, node, sizeof key->node);
    memcpy(key->sorted, node, sizeof key->sorted);
    for (int i = 1; i < 4; i++) {
        for (int j = i; j > 0 && key->sorted[j] < key->sorted[j - 1]; j--) {
            int32_t swap = key->sorted[j];
            key->sorted[j] = key->sorted[j - 1];
            key->sorted[j - 1] = swap;
        }
    }
}

static int compare_sorted(const FacetKey *a, const FacetKey *b)
{
    for (int i = 0; i < 4; i++)
        if (a->sorted[i] != b->sorted[i]) return a->sorted[i] < b->sorted[i] ? -1 : 1;
    return 0;
}

static int compare_keys(const void *left, const void *right)
{
    const FacetKey *a = left, *b = right;
    int order = compare_sorted(a, b);
    return order ? order : (a->index > b->index) - (a->index < b->index);
}

int facet_map_build(FacetMap *map, const int32_t *node, size_t count, size_t stride)
{
    map->count = count;
    map->keys = memory_alloc(count + 1, sizeof *map->keys);
    if (!map->keys) return -1;
    for (size_t i = 0; i < count; i++) {
        set_key(&map->keys[i], (const int32_t *)(const void *)((const char *)node + i * stride));
        map->keys[i].index = (int32_t)i;
    }
    qsort(map->keys, count, sizeof *map->keys, compare_keys);
    return 0;
}

/* +1 if b's nodes follow each other as a's do. */
static int winding(const int32_t a[4], const int32_t b[4])
{
    int corners = a[3] == a[2] ? 3 : 4;
    for (int i = 0; i < corners; i++) {
        if (b[i] != a[0]) continue;
        if (b[(i + 1) % corners] == a[1]) return 1;
    }
    return -1;
}

int32_t facet_map_find(const FacetMap *map, const int32_t node[4], int *sign)
{
    FacetKey wanted;
    set_key(&wanted, node);
    size_t low = 0, high = map->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (compare_sorted(&map->keys[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == map->count || compare_sorted(&map->keys[low], &wanted)) return -1;
    *sign = winding(map->keys[low].node, wanted.node);
    return map->keys[low].index;
}

void facet_map_free(FacetMap *map)
{
    memory_free(map->keys);
    *map = (FacetMap){0};
}
