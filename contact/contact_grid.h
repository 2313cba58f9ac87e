/* Broad phase: boxes sorted into a grid by their centres, and the boxes that overlap a given one. */
#ifndef BILLOW_CONTACT_GRID_H
#define BILLOW_CONTACT_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ContactBox {
    double low[3], high[3];
} ContactBox;

/* Numbers of boxes, as many as fit; grows. Zero-initialise; free item with memory_free. */
typedef struct ContactFound {
    int32_t *item;
    size_t capacity;
} ContactFound;

/* Which of the boxes [first, end) by cell overlap the box from query's low x y z to its high x y z: puts their numbers,
 * of all, into found, which has room for 16 more; returns how many. bounds: low x y z, high x y z, each count numbers,
 * all readable 16 beyond end (contact/motion_kernels.c). */
typedef int ContactOverlap(const float *bounds, ptrdiff_t count, const int32_t *all, const float query[6],
                           int32_t first, int32_t end, int32_t *found);

typedef struct ContactGrid {
    ContactOverlap *overlap; /* NULL: that of any processor */
    double origin[3];        /* low corner of all centres [L] */
    double inverse;          /* 1 over the side of a cell */
    double reach;            /* largest half extent of the boxes in cells [L] */
    int32_t size[3];         /* cells in x, y, z */
    int32_t *start;          /* first place of each cell (cells + 1) */
    int32_t *box;            /* boxes by cell (sorted_count) */
    int32_t *cell;           /* workspace: cell of each box, -1 large, -2 left out (count) */
    float *bounds;           /* of the boxes by cell, from the origin, rounded outward: low x y z, high x y z, each
                                (sorted_count) */
    int32_t *large;          /* boxes much larger than the mean: met by every query */
    const ContactBox *all;
    int32_t count, sorted_count, large_count;
    size_t start_capacity, box_capacity, cell_capacity, bounds_capacity, large_capacity;
} ContactGrid;

/* Sorts count boxes into cells; a box with low > high is left out. Boxes must live as long as queries are made. 0, or
 * -1 without memory. */
int contact_grid_fill(ContactGrid *grid, const ContactBox *box, int count);

/* Boxes that overlap the given one (and perhaps some that miss it by rounding), in an order that depends on the boxes
 * alone, in found; returns how many, -1 without memory. Any number of threads may ask, each with a found of its own. */
int contact_grid_query(const ContactGrid *grid, const ContactBox *box, ContactFound *found);

/* Sorts numbers ascending. */
void contact_sort(int32_t *item, int count);

void contact_grid_free(ContactGrid *grid);

#endif
