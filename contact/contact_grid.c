/* A uniform spatial hash. Every box is entered into all cells it overlaps, so that a point needs one cell only; a pair
 * is reported by the one cell that holds the low corner of its overlap. */
#include "contact/contact_grid.h"

#include <math.h>
#include <stdlib.h>

#include "solver/memory.h"

enum { MOST_CELLS = 256 };

/* Cells that a box overlaps. */
typedef struct CellRange {
    int64_t low[3], high[3];
    int64_t count;
} CellRange;

static CellRange cells_of(const ContactGrid *grid, const ContactBox *box)
{
    CellRange range = {.count = 1};
    for (int k = 0; k < 3; k++) {
        range.low[k] = (int64_t)floor(box->low[k] / grid->cell);
        range.high[k] = (int64_t)floor(box->high[k] / grid->cell);
        int64_t span = range.high[k] - range.low[k] + 1;
        range.count = span > MOST_CELLS || range.count > MOST_CELLS ? MOST_CELLS + 1 : range.count * span;
    }
    return range;
}

static uint32_t bucket_of(const ContactGrid *grid, int64_t i, int64_t j, int64_t k)
{
    uint64_t h =
        (uint64_t)i * 0x9e3779b97f4a7c15u + (uint64_t)j * 0xc2b2ae3d27d4eb4fu + (uint64_t)k * 0x165667b19e3779f9u;
    return (uint32_t)(h >> 32) & grid->mask;
}

/* Adds each cell of the range to the counts (entry NULL), or enters the box there. */
static void enter(ContactGrid *grid, const CellRange *range, int32_t box, int32_t *start, int32_t *entry)
{
    for (int64_t i = range->low[0]; i <= range->high[0]; i++)
        for (int64_t j = range->low[1]; j <= range->high[1]; j++)
            for (int64_t k = range->low[2]; k <= range->high[2]; k++) {
                int32_t place = start[bucket_of(grid, i, j, k)]++;
                if (entry) entry[place] = box;
            }
}

static int reserve_buckets(ContactGrid *grid, int count)
{
    uint32_t size = 64;
    while (size < 4u * (uint32_t)count) size *= 2;
    grid->mask = size - 1;
    if (memory_reserve((void **)&grid->start, &grid->start_capacity, (size_t)size + 3, sizeof *grid->start)) return -1;
    for (uint32_t i = 0; i < size + 3; i++) grid->start[i] = 0;
    return 0;
}

int contact_grid_fill(ContactGrid *grid, const ContactBox *box, int count, double cell)
{
    grid->box = box;
    grid->count = count;
    grid->cell = cell;
    grid->large_count = 0;
    if (reserve_buckets(grid, count)) return -1;
    for (int b = 0; b < count; b++) {
        if (box[b].low[0] > box[b].high[0]) continue;
        CellRange range = cells_of(grid, &box[b]);
        if (range.count <= MOST_CELLS) {
            enter(grid, &range, b, grid->start + 2, NULL);
            continue;
        }
        if (memory_reserve((void **)&grid->large, &grid->large_capacity, (size_t)grid->large_count + 1,
                           sizeof *grid->large))
            return -1;
        grid->large[grid->large_count++] = b;
    }
    for (uint32_t i = 0; i <= grid->mask; i++) grid->start[i + 2] += grid->start[i + 1];
    if (memory_reserve((void **)&grid->entry, &grid->entry_capacity, (size_t)grid->start[grid->mask + 2] + 1,
                       sizeof *grid->entry))
        return -1;
    for (int b = 0; b < count; b++) {
        if (box[b].low[0] > box[b].high[0]) continue;
        CellRange range = cells_of(grid, &box[b]);
        if (range.count <= MOST_CELLS) enter(grid, &range, b, grid->start + 1, grid->entry);
    }
    return 0;
}

static int overlap(const ContactBox *a, const ContactBox *b)
{
    return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] && b->low[1] <= a->high[1] &&
           a->low[2] <= b->high[2] && b->low[2] <= a->high[2];
}

/* Does the low corner of the overlap of a and b lie in cell (i, j, k)? */
static int is_home(const ContactGrid *grid, const ContactBox *a, const ContactBox *b, const int64_t cell[3])
{
    for (int k = 0; k < 3; k++) {
        double low = a->low[k] > b->low[k] ? a->low[k] : b->low[k];
        if ((int64_t)floor(low / grid->cell) != cell[k]) return 0;
    }
    return 1;
}

/* Boxes of one cell. Those that enter a bucket through several cells follow each other there. */
static int query_cell(ContactGrid *grid, const ContactBox *box, const int64_t cell[3], int found)
{
    uint32_t bucket = bucket_of(grid, cell[0], cell[1], cell[2]);
    int32_t first = grid->start[bucket], end = grid->start[bucket + 1], last = -1;
    if (memory_reserve((void **)&grid->found, &grid->found_capacity, (size_t)(found + end - first) + 1,
                       sizeof *grid->found))
        return -1;
    for (int32_t e = first; e < end; e++) {
        int32_t b = grid->entry[e];
        if (b == last || !overlap(box, &grid->box[b]) || !is_home(grid, box, &grid->box[b], cell)) continue;
        grid->found[found++] = last = b;
    }
    return found;
}

static int query_all(ContactGrid *grid, const ContactBox *box)
{
    int found = 0;
    for (int b = 0; b < grid->count; b++) {
        const ContactBox *other = &grid->box[b];
        if (other->low[0] > other->high[0] || !overlap(box, other)) continue;
        if (memory_reserve((void **)&grid->found, &grid->found_capacity, (size_t)found + 1, sizeof *grid->found))
            return -1;
        grid->found[found++] = b;
    }
    return found;
}

static int compare_int32(const void *a, const void *b)
{
    int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

int contact_grid_query(ContactGrid *grid, const ContactBox *box)
{
    CellRange range = cells_of(grid, box);
    int found = 0;
    if (range.count > MOST_CELLS) return query_all(grid, box);
    for (int64_t i = range.low[0]; i <= range.high[0]; i++)
        for (int64_t j = range.low[1]; j <= range.high[1]; j++)
            for (int64_t k = range.low[2]; k <= range.high[2]; k++) {
                found = query_cell(grid, box, (int64_t[]){i, j, k}, found);
                if (found < 0) return -1;
            }
    if (memory_reserve((void **)&grid->found, &grid->found_capacity, (size_t)(found + grid->large_count) + 1,
                       sizeof *grid->found))
        return -1;
    for (int l = 0; l < grid->large_count; l++)
        if (overlap(box, &grid->box[grid->large[l]])) grid->found[found++] = grid->large[l];
    for (int n = 1; n < found && found <= 64; n++)
        for (int m = n; m > 0 && grid->found[m] < grid->found[m - 1]; m--) {
            int32_t swap = grid->found[m];
            grid->found[m] = grid->found[m - 1];
            grid->found[m - 1] = swap;
        }
    if (found > 64) qsort(grid->found, (size_t)found, sizeof *grid->found, compare_int32);
    return found;
}

void contact_grid_free(ContactGrid *grid)
{
    if (!grid) return;
    memory_free(grid->start);
    memory_free(grid->entry);
    memory_free(grid->large);
    memory_free(grid->found);
    *grid = (ContactGrid){0};
}
