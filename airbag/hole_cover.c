/* Covers over holes that open during the run. */
#include "airbag/hole_cover.h"

#include <stdlib.h>
#include <string.h>

#include "airbag/volume.h"
#include "solver/memory.h"

/* One side of a facet, its nodes in ascending order. */
typedef struct Side {
    int32_t low, high, facet, number;
} Side;

static int compare_sides(const void *one, const void *other)
{
    const Side *a = one, *b = other;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    if (a->facet != b->facet) return a->facet < b->facet ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static int32_t side_end(const int32_t node[4], int side)
{
    return node[(side + 1) % 4];
}

/* Sides that exactly two facets share make neighbours. */
static int find_neighbours(HoleCover *cover)
{
    Side *sides = memory_alloc(4 * (size_t)cover->facet_count + 1, sizeof *sides);
    if (!sides) return -1;
    int count = 0;
    for (int f = 0; f < cover->facet_count; f++)
        for (int s = 0; s < 4; s++) {
            const int32_t a = cover->node[4 * f + s], b = side_end(cover->node + 4 * (ptrdiff_t)f, s);
            cover->neighbour[4 * f + s] = -1;
            if (a != b) sides[count++] = (Side){a < b ? a : b, a < b ? b : a, f, s};
        }
    qsort(sides, (size_t)count, sizeof *sides, compare_sides);
    for (int i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && sides[next].low == sides[i].low && sides[next].high == sides[i].high;)
            next++;
        if (next - i != 2) continue;
        cover->neighbour[4 * sides[i].facet + sides[i].number] = sides[i + 1].facet;
        cover->neighbour[4 * sides[i + 1].facet + sides[i + 1].number] = sides[i].facet;
    }
    memory_free(sides);
    return 0;
}

int hole_cover_create(HoleCover *cover, int facet_count, const int32_t *node, const int64_t *element)
{
    const size_t count = (size_t)facet_count;
    *cover = (HoleCover){.facet_count = facet_count,
                         .node = memory_alloc(4 * count + 1, sizeof *cover->node),
                         .neighbour = memory_alloc(4 * count + 1, sizeof *cover->neighbour),
                         .element = memory_alloc(count + 1, sizeof *cover->element),
                         .first_side = memory_alloc(count + 1, sizeof *cover->first_side),
                         .side = memory_alloc(8 * count + 1, sizeof *cover->side),
                         .stack = memory_alloc(count + 1, sizeof *cover->stack),
                         .seen = memory_alloc(count + 1, 1)};
    if (cover->node && cover->neighbour && cover->element && cover->first_side && cover->side && cover->stack &&
        cover->seen) {
        memcpy(cover->node, node, 4 * count * sizeof *node);
        memcpy(cover->element, element, count * sizeof *element);
        if (find_neighbours(cover) == 0) return 0;
    }
    hole_cover_free(cover);
    return -1;
}

void hole_cover_free(HoleCover *cover)
{
    memory_free(cover->node);
    memory_free(cover->neighbour);
    memory_free(cover->element);
    memory_free(cover->first_side);
    memory_free(cover->side);
    memory_free(cover->stack);
    memory_free(cover->seen);
    *cover = (HoleCover){0};
}

/* All facets of the patch of one, and their sides towards what is not lost. */
static void fill_patch(HoleCover *cover, const unsigned char *lost, int32_t first, int32_t *sides)
{
    int depth = 0;
    cover->stack[depth++] = first;
    cover->seen[first] = 1;
    while (depth > 0) {
        const int32_t f = cover->stack[--depth];
        for (int s = 0; s < 4; s++) {
            const int32_t next = cover->neighbour[4 * (ptrdiff_t)f + s], *node = cover->node + 4 * (ptrdiff_t)f;
            if (node[s] == side_end(node, s)) continue;
            if (next < 0 || !lost[cover->element[next]]) {
                cover->side[2 * (ptrdiff_t)*sides] = node[s];
                cover->side[2 * (ptrdiff_t)*sides + 1] = side_end(node, s);
                ++*sides;
            } else if (!cover->seen[next]) {
                cover->seen[next] = 1;
                cover->stack[depth++] = next;
            }
        }
    }
}

void hole_cover_update(HoleCover *cover, const unsigned char *lost)
{
    int32_t sides = 0;
    cover->patch_count = 0;
    memset(cover->seen, 0, (size_t)cover->facet_count);
    for (int32_t f = 0; f < cover->facet_count; f++) {
        if (cover->seen[f] || !lost[cover->element[f]]) continue;
        cover->first_side[cover->patch_count++] = sides;
        fill_patch(cover, lost, f, &sides);
    }
    cover->first_side[cover->patch_count] = sides;
}

double hole_cover_volume(const HoleCover *cover, const double *x, const double origin[3])
{
    double volume = 0.0;
    for (int p = 0; p < cover->patch_count; p++) {
        const int32_t first = cover->first_side[p], end = cover->first_side[p + 1];
        double centre[3] = {0};
        for (int32_t i = first; i < end; i++)
            for (int k = 0; k < 3; k++) centre[k] += x[3 * (ptrdiff_t)cover->side[2 * (ptrdiff_t)i] + k];
        for (int k = 0; k < 3 && end > first; k++) centre[k] /= end - first;
        for (int32_t i = first; i < end; i++)
            volume += volume_triangle(centre, x + 3 * (ptrdiff_t)cover->side[2 * (ptrdiff_t)i],
                                      x + 3 * (ptrdiff_t)cover->side[2 * (ptrdiff_t)i + 1], origin);
    }
    return volume;
}
