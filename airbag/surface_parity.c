/* Sets of facets whose windings are known relative to each other: union-find with parity. */
#include "airbag/surface_internal.h"

#include <string.h>

#include "solver/memory.h"

int parity_create(int count, Parity *parity)
{
    parity->parent = memory_alloc((size_t)count + 1, sizeof *parity->parent);
    parity->flip = memory_alloc((size_t)count + 1, sizeof *parity->flip);
    if (!parity->parent || !parity->flip) {
        parity_free(parity);
        return -1;
    }
    for (int i = 0; i < count; i++) {
        parity->parent[i] = i;
        parity->flip[i] = 1;
    }
    return 0;
}

void parity_free(Parity *parity)
{
    memory_free(parity->parent);
    memory_free(parity->flip);
    memset(parity, 0, sizeof *parity);
}

int parity_find(Parity *parity, int item, int *flip)
{
    int root = item, total = 1;
    while (parity->parent[root] != root) {
        total *= parity->flip[root];
        root = parity->parent[root];
    }
    /* hang the whole path below the root, so that later finds are short */
    int rest = total;
    while (item != root) {
        int next = parity->parent[item], step = parity->flip[item];
        parity->parent[item] = root;
        parity->flip[item] = (signed char)rest;
        rest *= step;
        item = next;
    }
    *flip = total;
    return root;
}

bool parity_join(Parity *parity, int a, int b, int relation)
{
    int flip_a, flip_b;
    int root_a = parity_find(parity, a, &flip_a), root_b = parity_find(parity, b, &flip_b);
    int flip = flip_a * flip_b * relation;
    if (root_a == root_b) return flip > 0;
    int low = root_a < root_b ? root_a : root_b, high = root_a < root_b ? root_b : root_a;
    parity->parent[high] = low;
    parity->flip[high] = (signed char)flip;
    return true;
}
