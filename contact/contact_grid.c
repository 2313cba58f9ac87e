/* A dense grid of cells. Each box is in the cell of its centre; a query looks at the cells that centres of overlapping
 * boxes can lie in. Cells along z follow each other, so that one row of them is one run of bounds. */
#include "contact/contact_grid.h"

#include <math.h>
#include <stdlib.h>

#include "contact/motion_kernels.h"
#include "solver/memory.h"

/* A box with half extents beyond this many times the mean is kept out of the cells. */
#define LARGE 3.0

/* Bounds in single precision are rounded outward by this share of their distance from the origin. */
#define ROUNDING 2.5e-7f

/* What kernels read or write beyond the end of an array. */
enum { BEYOND = 16 };

static double largest_half_extent(const ContactBox *box)
{
    double half = 0.0;
    for (int k = 0; k < 3; k++) half = fmax(half, 0.5 * (box->high[k] - box->low[k]));
    return half;
}

static bool left_out(const ContactBox *box)
{
    return box->low[0] > box->high[0];
}

/* Cell along one axis of a distance from the origin; what is outside, or no number, is put into the outer cells. */
static int32_t cell_along(const ContactGrid *grid, int axis, double distance)
{
    double place = distance * grid->inverse;
    if (!(place > 0.0)) return 0;
    return place < (double)(grid->size[axis] - 1) ? (int32_t)place : grid->size[axis] - 1;
}

/* Cells as large as the mean box, and no more of them than four for each box. */
static void lay_cells(ContactGrid *grid, const ContactBox *box, int count)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, sum = 0.0;
    int boxes = 0;
    for (int b = 0; b < count; b++) {
        if (left_out(&box[b])) continue;
        for (int k = 0; k < 3; k++) {
            double centre = 0.5 * (box[b].low[k] + box[b].high[k]);
            low[k] = centre < low[k] ? centre : low[k];
            high[k] = centre > high[k] ? centre : high[k];
        }
        sum += largest_half_extent(&box[b]);
        boxes++;
    }
    double side = boxes > 0 && sum > 0.0 ? sum / boxes : 1.0, most = 4.0 * boxes + 64.0;
    for (int k = 0; k < 3; k++) grid->origin[k] = boxes > 0 && isfinite(low[k]) ? low[k] : 0.0;
    grid->reach = LARGE * side;
    for (int tries = 0;; tries++, side *= 1.3) {
        double cells = 1.0;
        grid->inverse = 1.0 / side;
        for (int k = 0; k < 3; k++) {
            double along = boxes > 0 ? floor((high[k] - low[k]) * grid->inverse) + 1.0 : 1.0;
            if (!(along >= 1.0) || tries > 200) along = 1.0; /* no number */
            grid->size[k] = along < most ? (int32_t)along : (int32_t)most;
            cells *= along;
        }
        if (cells <= most || tries > 200) return;
    }
}

/* Cell of each box; counts those of each cell in start, two places on. */
static int assign_cells(ContactGrid *grid)
{
    double widest = 0.0;
    for (int32_t b = 0; b < grid->count; b++) {
        const ContactBox *box = &grid->all[b];
        grid->cell[b] = -2;
        if (left_out(box)) continue;
        double half = largest_half_extent(box);
        if (half > grid->reach) {
            grid->cell[b] = -1;
            if (memory_reserve((void **)&grid->large, &grid->large_capacity, (size_t)grid->large_count + 1,
                               sizeof *grid->large))
                return -1;
            grid->large[grid->large_count++] = b;
            continue;
        }
        int32_t at[3];
        for (int k = 0; k < 3; k++) at[k] = cell_along(grid, k, 0.5 * (box->low[k] + box->high[k]) - grid->origin[k]);
        grid->cell[b] = (at[0] * grid->size[1] + at[1]) * grid->size[2] + at[2];
        grid->start[grid->cell[b] + 2]++;
        grid->sorted_count++;
        widest = half > widest ? half : widest;
    }
    grid->reach = widest;
    return 0;
}

int contact_grid_fill(ContactGrid *grid, const ContactBox *box, int count)
{
    if (!grid->overlap) grid->overlap = motion_kernels_v2.overlap;
    grid->all = box;
    grid->count = count;
    grid->large_count = grid->sorted_count = 0;
    lay_cells(grid, box, count);
    size_t cells = (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2], boxes = (size_t)count + 1;
    if (memory_reserve((void **)&grid->start, &grid->start_capacity, cells + 3, sizeof *grid->start) ||
        memory_reserve((void **)&grid->box, &grid->box_capacity, boxes + BEYOND, sizeof *grid->box) ||
        memory_reserve((void **)&grid->cell, &grid->cell_capacity, boxes, sizeof *grid->cell) ||
        memory_reserve((void **)&grid->bounds, &grid->bounds_capacity, 6 * boxes + BEYOND, sizeof *grid->bounds))
        return -1;
    for (size_t i = 0; i < cells + 3; i++) grid->start[i] = 0;
    if (assign_cells(grid)) return -1;
    for (size_t i = 0; i < cells; i++) grid->start[i + 2] += grid->start[i + 1];
    for (int32_t b = 0; b < count; b++) {
        if (grid->cell[b] < 0) continue;
        int32_t place = grid->start[grid->cell[b] + 1]++;
        grid->box[place] = b;
        for (int k = 0; k < 3; k++) {
            float low = (float)(box[b].low[k] - grid->origin[k]), high = (float)(box[b].high[k] - grid->origin[k]);
            grid->bounds[k * grid->sorted_count + place] = low - ROUNDING * fabsf(low);
            grid->bounds[(3 + k) * grid->sorted_count + place] = high + ROUNDING * fabsf(high);
        }
    }
    return 0;
}

static int overlap(const ContactBox *a, const ContactBox *b)
{
    return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] && b->low[1] <= a->high[1] &&
           a->low[2] <= b->high[2] && b->low[2] <= a->high[2];
}

int contact_grid_query(const ContactGrid *grid, const ContactBox *box, ContactFound *found)
{
    int32_t low[3], high[3];
    float q[6];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        double from = box->low[k] - grid->origin[k], to = box->high[k] - grid->origin[k];
        low[k] = cell_along(grid, k, from - grid->reach);
        high[k] = cell_along(grid, k, to + grid->reach);
        q[k] = (float)from - ROUNDING * fabsf((float)from);
        q[3 + k] = (float)to + ROUNDING * fabsf((float)to);
    }
    for (int32_t i = low[0]; i <= high[0]; i++)
        for (int32_t j = low[1]; j <= high[1]; j++) {
            ptrdiff_t row = ((ptrdiff_t)i * grid->size[1] + j) * grid->size[2];
            int32_t first = grid->start[row + low[2]], end = grid->start[row + high[2] + 1];
            if (first == end) continue;
            if (memory_reserve((void **)&found->item, &found->capacity, (size_t)(count + end - first) + BEYOND,
                               sizeof *found->item))
                return -1;
            count += grid->overlap(grid->bounds, grid->sorted_count, grid->box, q, first, end, found->item + count);
        }
    if (memory_reserve((void **)&found->item, &found->capacity, (size_t)(count + grid->large_count) + 1,
                       sizeof *found->item))
        return -1;
    for (int32_t l = 0; l < grid->large_count; l++)
        if (overlap(box, &grid->all[grid->large[l]])) found->item[count++] = grid->large[l];
    return count;
}

static int compare_int32(const void *a, const void *b)
{
    int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

void contact_sort(int32_t *item, int count)
{
    if (count > 64) {
        qsort(item, (size_t)count, sizeof *item, compare_int32);
        return;
    }
    for (int n = 1; n < count; n++) {
        int32_t moved = item[n];
        int m = n;
        for (; m > 0 && item[m - 1] > moved; m--) item[m] = item[m - 1];
        item[m] = moved;
    }
}

void contact_grid_free(ContactGrid *grid)
{
    if (!grid) return;
    memory_free(grid->start);
    memory_free(grid->box);
    memory_free(grid->cell);
    memory_free(grid->bounds);
    memory_free(grid->large);
    *grid = (ContactGrid){0};
}
