/* Halves a surface again and again across its longer way: items by their levels from an end. */
#include "contact/contact_patches.h"

#include <stddef.h>

#include "solver/memory.h"

/* Links as lists: what is at from f is to[start[f] .. start[f + 1]). */
typedef struct Lists {
    int32_t *start, *to;
} Lists;

typedef struct Patches {
    Lists places, items; /* of an item; at a place */
    int32_t *part;       /* number of the part that an item is in */
    int32_t *seen;       /* of the last walk that came by */
    int32_t walks, parts;
} Patches;

static int make_lists(Lists *lists, int count, int links, const int32_t *from, const int32_t *to)
{
    lists->start = memory_alloc((size_t)count + 3, sizeof *lists->start);
    lists->to = memory_alloc((size_t)links + 1, sizeof *lists->to);
    if (!lists->start || !lists->to) return -1;
    for (int k = 0; k < links; k++) lists->start[from[k] + 2]++;
    for (int k = 0; k < count; k++) lists->start[k + 2] += lists->start[k + 1];
    for (int k = 0; k < links; k++) lists->to[lists->start[from[k] + 1]++] = to[k];
    return 0;
}

/* Puts the items of a part into the order of their levels from the first on; those that it does not reach begin anew.
 * order: workspace. */
static void walk(Patches *p, int32_t *item, int count, int32_t first, int32_t *order)
{
    int done = 0, next = 0, part = p->part[first];
    p->walks++;
    for (int begin = -1; done < count; begin++) {
        int32_t from = begin < 0 ? first : item[begin];
        if (p->seen[from] == p->walks) continue;
        p->seen[from] = p->walks;
        order[done++] = from;
        for (; next < done; next++)
            for (int32_t k = p->places.start[order[next]]; k < p->places.start[order[next] + 1]; k++)
                for (int32_t i = p->items.start[p->places.to[k]]; i < p->items.start[p->places.to[k] + 1]; i++) {
                    int32_t other = p->items.to[i];
                    if (p->part[other] != part || p->seen[other] == p->walks) continue;
                    p->seen[other] = p->walks;
                    order[done++] = other;
                }
    }
    for (int k = 0; k < count; k++) item[k] = order[k];
}

static void halve(Patches *p, int32_t *item, int count, int size, int32_t *order)
{
    while (count > size) {
        int half = (count / 2 + size - 1) / size * size;
        walk(p, item, count, item[0], order);
        walk(p, item, count, item[count - 1], order);
        p->parts++;
        for (int k = half; k < count; k++) p->part[item[k]] = p->parts;
        halve(p, item, half, size, order);
        item += half;
        count -= half;
    }
}

int contact_patches(int item_count, int place_count, int link_count, const int32_t *item, const int32_t *place,
                    int size, int32_t *order)
{
    Patches p = {0};
    int32_t *work = memory_alloc((size_t)item_count + 1, sizeof *work);
    p.part = memory_alloc((size_t)item_count + 1, sizeof *p.part);
    p.seen = memory_alloc((size_t)item_count + 1, sizeof *p.seen);
    int status = work && p.part && p.seen && !make_lists(&p.places, item_count, link_count, item, place) &&
                         !make_lists(&p.items, place_count, link_count, place, item)
                     ? 0
                     : -1;
    for (int k = 0; k < item_count; k++) order[k] = k;
    if (!status) halve(&p, order, item_count, size, work);
    void *blocks[] = {p.places.start, p.places.to, p.items.start, p.items.to, p.part, p.seen, work};
    for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++) memory_free(blocks[k]);
    return status;
}
