/* Distinct body classes, found by their content. */
#ifndef BILLOW_CLASS_TABLE_H
#define BILLOW_CLASS_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "solver/loads.h"

typedef struct ClassTable {
    BodyClass *items; /* items[0] is the empty class once begun */
    size_t count, capacity;
    int32_t *slots; /* open addressing: class + 1, 0 free (slot_count) */
    size_t slot_count;
} ClassTable;

/* The empty class: all zero but airbag = -1. */
void body_class_clear(BodyClass *body_class);

/* Adds terms; equal terms merge. False if the class is full. */
bool body_class_add_gravity(BodyClass *body_class, int axis, int curve, double scale);
bool body_class_add_damping(BodyClass *body_class, int curve, double scale, const double factor[6]);

/* Adds share times the terms of other (its airbag is not taken). False if the class is full. */
bool body_class_add(BodyClass *body_class, const BodyClass *other, double share);

/* Index of the class with this content, added if new; -1 without memory. */
int32_t class_table_find(ClassTable *table, const BodyClass *body_class);

/* Frees the slots; the items stay with the caller. */
void class_table_close(ClassTable *table);

#endif
