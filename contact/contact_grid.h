/* Broad phase: a hash of cells for boxes, and the boxes that overlap a given one. */
#ifndef BILLOW_CONTACT_GRID_H
#define BILLOW_CONTACT_GRID_H

#include <stddef.h>
#include <stdint.h>

typedef struct ContactBox {
    double low[3], high[3];
} ContactBox;

typedef struct ContactGrid {
    double cell; /* side of a cell [L] */
    uint32_t mask;
    int32_t *start; /* of each bucket in entry (mask + 2) */
    int32_t *entry; /* boxes by bucket, ascending */
    int32_t *large; /* boxes over too many cells: met by every query */
    int large_count;
    const ContactBox *box;
    int count;
    size_t start_capacity, entry_capacity, large_capacity;
    int32_t *found; /* answer of the last query, ascending */
    size_t found_capacity;
} ContactGrid;

/* Sorts count boxes into cells; a box with low > high is left out. boxes must live as long as queries are made. 0, or
 * -1 without memory. */
int contact_grid_fill(ContactGrid *grid, const ContactBox *box, int count, double cell);

/* Boxes that overlap the given one, ascending, in grid->found; returns how many, -1 without memory. */
int contact_grid_query(ContactGrid *grid, const ContactBox *box);

void contact_grid_free(ContactGrid *grid);

#endif
