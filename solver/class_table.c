/* Distinct body classes, found by a hash of their content. */
#include "solver/class_table.h"

#include <string.h>

#include "solver/memory.h"

void body_class_clear(BodyClass *body_class)
{
    memset(body_class, 0, sizeof *body_class);
    body_class->airbag = -1;
}

bool body_class_add_gravity(BodyClass *body_class, int axis, int curve, double scale)
{
    if (scale == 0) return true;
    for (int k = 0; k < body_class->gravity_count; k++) {
        if (body_class->gravity[k].axis != axis || body_class->gravity[k].curve != curve) continue;
        body_class->gravity[k].scale += scale;
        return true;
    }
    if (body_class->gravity_count == BILLOW_GRAVITIES) return false;
    int k = body_class->gravity_count++;
    body_class->gravity[k].axis = axis;
    body_class->gravity[k].curve = curve;
    body_class->gravity[k].scale = scale;
    return true;
}

bool body_class_add_damping(BodyClass *body_class, int curve, double scale, const double factor[6])
{
    if (scale == 0) return true;
    for (int k = 0; k < body_class->damping_count; k++) {
        if (body_class->damping[k].curve != curve ||
            memcmp(body_class->damping[k].factor, factor, 6 * sizeof *factor) != 0)
            continue;
        body_class->damping[k].scale += scale;
        return true;
    }
    if (body_class->damping_count == BILLOW_DAMPINGS) return false;
    int k = body_class->damping_count++;
    body_class->damping[k].curve = curve;
    body_class->damping[k].scale = scale;
    memcpy(body_class->damping[k].factor, factor, 6 * sizeof *factor);
    return true;
}

bool body_class_add(BodyClass *body_class, const BodyClass *other, double share)
{
    bool fits = true;
    for (int k = 0; k < other->gravity_count; k++) {
        fits = body_class_add_gravity(body_class, other->gravity[k].axis, other->gravity[k].curve,
                                      share * other->gravity[k].scale) &&
               fits;
    }
    for (int k = 0; k < other->damping_count; k++) {
        fits = body_class_add_damping(body_class, other->damping[k].curve, share * other->damping[k].scale,
                                      other->damping[k].factor) &&
               fits;
    }
    return fits;
}

/* 64-bit FNV-1a over the bytes: classes are built from zeroed memory, so padding agrees. */
static size_t hash_class(const BodyClass *body_class)
{
    uint64_t hash = 14695981039346656037u;
    const unsigned char *bytes = (const unsigned char *)body_class;
    for (size_t i = 0; i < sizeof *body_class; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
    return (size_t)hash;
}

static void insert(ClassTable *table, int32_t item)
{
    size_t slot = hash_class(&table->items[item]) % table->slot_count;
    while (table->slots[slot] > 0) slot = (slot + 1) % table->slot_count;
    table->slots[slot] = item + 1;
}

static int grow(ClassTable *table)
{
    if (2 * (table->count + 1) <= table->slot_count) return 0;
    size_t wanted = table->slot_count > 0 ? 2 * table->slot_count : 64;
    int32_t *slots = memory_alloc(wanted, sizeof *slots);
    if (!slots) return -1;
    memory_free(table->slots);
    table->slots = slots;
    table->slot_count = wanted;
    for (size_t i = 0; i < table->count; i++) insert(table, (int32_t)i);
    return 0;
}

int32_t class_table_find(ClassTable *table, const BodyClass *body_class)
{
    if (grow(table)) return -1;
    size_t slot = hash_class(body_class) % table->slot_count;
    for (; table->slots[slot] > 0; slot = (slot + 1) % table->slot_count) {
        int32_t item = table->slots[slot] - 1;
        if (memcmp(&table->items[item], body_class, sizeof *body_class) == 0) return item;
    }
    if (memory_reserve((void **)&table->items, &table->capacity, table->count + 1, sizeof *table->items)) return -1;
    memcpy(&table->items[table->count], body_class, sizeof *body_class);
    table->slots[slot] = (int32_t)table->count + 1;
    return (int32_t)table->count++;
}

void class_table_close(ClassTable *table)
{
    memory_free(table->slots);
    table->slots = NULL;
    table->slot_count = 0;
}
