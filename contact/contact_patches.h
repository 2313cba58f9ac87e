/* Parts items of a surface into compact groups of one size. */
#ifndef BILLOW_CONTACT_PATCHES_H
#define BILLOW_CONTACT_PATCHES_H

#include <stdint.h>

/* Items 0 to item_count - 1 and places 0 to place_count - 1: link k says that item[k] is at place[k]; items at one
 * place are neighbours. Fills order (item_count): the first group's size items, the next's, and so on; the last may
 * have fewer. 0, or -1 without memory. */
int contact_patches(int item_count, int place_count, int link_count, const int32_t *item, const int32_t *place,
                    int size, int32_t *order);

#endif
