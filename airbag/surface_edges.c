/* The edge table of a surface: all facet sides, sorted so that equal sides lie together. */
#include "airbag/surface_internal.h"

#include <string.h>

#include "solver/memory.h"

int facet_corners(const int32_t node[4], int32_t corner[4])
{
    int count = 0;
    for (int i = 0; i < 4; i++)
        if (count == 0 || corner[count - 1] != node[i]) corner[count++] = node[i];
    while (count > 1 && corner[count - 1] == corner[0]) count--;
    bool folded = count == 4 && (corner[0] == corner[2] || corner[1] == corner[3]);
    return count < 3 || folded ? 0 : count;
}

int edge_use_sign(const EdgeUse *use)
{
    return use->from < use->to ? 1 : -1;
}

int edge_use_count(const EdgeTable *table, int e)
{
    return table->start[e + 1] - table->start[e];
}

static int32_t lower(const EdgeUse *use)
{
    return use->from < use->to ? use->from : use->to;
}

static int32_t upper(const EdgeUse *use)
{
    return use->from < use->to ? use->to : use->from;
}

/* Stable counting sort of count uses by key, whose values lie in [low, low + range). start has range + 1 places. */
static void sort_uses(const EdgeUse *from, EdgeUse *to, int count, int32_t (*key)(const EdgeUse *), int32_t low,
                      size_t range, int *start)
{
    memset(start, 0, (range + 1) * sizeof *start);
    for (int i = 0; i < count; i++) start[key(&from[i]) - low + 1]++;
    for (size_t k = 0; k < range; k++) start[k + 1] += start[k];
    for (int i = 0; i < count; i++) to[start[key(&from[i]) - low]++] = from[i];
}

/* Lists the sides of all active facets in facet order; returns their number and the range of their nodes. */
static int list_uses(const SurfaceInput *input, const bool *active, EdgeUse *use, int32_t *low, int32_t *high)
{
    int count = 0;
    *low = INT32_MAX;
    *high = 0;
    for (int f = 0; f < input->facet_count; f++) {
        int32_t corner[4];
        int corners = active[f] ? facet_corners(input->node + 4 * (size_t)f, corner) : 0;
        for (int i = 0; i < corners; i++) {
            use[count++] = (EdgeUse){corner[i], corner[(i + 1) % corners], f};
            if (corner[i] < *low) *low = corner[i];
            if (corner[i] > *high) *high = corner[i];
        }
    }
    if (count == 0) *low = 0;
    return count;
}

int edge_table_build(const SurfaceInput *input, const bool *active, EdgeTable *table)
{
    size_t most = 4 * (size_t)input->facet_count + 1;
    EdgeUse *listed = memory_alloc(most, sizeof *listed), *sorted = memory_alloc(most, sizeof *sorted);
    int32_t low = 0, high = 0;
    int count = listed ? list_uses(input, active, listed, &low, &high) : 0;
    size_t range = (size_t)(high - low) + 1;
    int *bucket = memory_alloc(range + 1, sizeof *bucket), *start = memory_alloc((size_t)count + 1, sizeof *start);
    memset(table, 0, sizeof *table);
    int failed = !listed || !sorted || !bucket || !start;
    if (!failed) {
        sort_uses(listed, sorted, count, upper, low, range, bucket);
        sort_uses(sorted, listed, count, lower, low, range, bucket);
        for (int i = 0; i < count; i++) {
            bool same =
                i > 0 && lower(&listed[i]) == lower(&listed[i - 1]) && upper(&listed[i]) == upper(&listed[i - 1]);
            if (!same) start[table->edge_count++] = i;
        }
        start[table->edge_count] = count;
        table->start = start;
        table->use = listed;
    } else {
        memory_free(listed);
        memory_free(start);
    }
    memory_free(sorted);
    memory_free(bucket);
    return failed ? -1 : 0;
}

void edge_table_free(EdgeTable *table)
{
    memory_free(table->start);
    memory_free(table->use);
    memset(table, 0, sizeof *table);
}
