#include "contact/contact_motion.h"

#include <math.h>

#include "solver/memory.h"

/* Adds a chunk that the group does not have yet; places: room for it. */
static int add_chunk(int32_t *chunk, int count, int32_t added)
{
    for (int k = 0; k < count; k++)
        if (chunk[k] == added) return count;
    chunk[count] = added;
    return count + 1;
}

int contact_groups_create(ContactGroups *groups, const Model *model, int item_count, int corners, const int32_t *node)
{
    groups->count = (item_count + CONTACT_GROUP - 1) / CONTACT_GROUP;
    size_t count = (size_t)groups->count + 1;
    groups->start = memory_alloc(count, sizeof *groups->start);
    groups->chunk = memory_alloc((size_t)item_count * (size_t)corners + 1, sizeof *groups->chunk);
    groups->way = memory_alloc(count, sizeof *groups->way);
    groups->speed = memory_alloc(count, sizeof *groups->speed);
    if (!groups->start || !groups->chunk || !groups->way || !groups->speed) return -1;
    for (int g = 0; g < groups->count; g++) {
        int first = g * CONTACT_GROUP, end = first + CONTACT_GROUP < item_count ? first + CONTACT_GROUP : item_count;
        int chunks = 0;
        int32_t *chunk = groups->chunk + groups->start[g];
        for (int k = first * corners; k < end * corners; k++)
            if (node[k] < model->moving_count) chunks = add_chunk(chunk, chunks, node[k] / CONTACT_NODE_CHUNK);
        groups->start[g + 1] = groups->start[g] + chunks;
    }
    return 0;
}

void contact_groups_move(ContactGroups *groups, const ContactMotion *motions, double time)
{
    for (int g = 0; g < groups->count; g++) {
        double fastest = 0.0;
        for (int32_t k = groups->start[g]; k < groups->start[g + 1]; k++) {
            double square = motions[groups->chunk[k]].fastest;
            fastest = square > fastest ? square : fastest;
        }
        groups->speed[g] = sqrt(fastest);
        groups->way[g] += groups->speed[g] * time;
    }
}

void contact_groups_free(ContactGroups *groups)
{
    memory_free(groups->start);
    memory_free(groups->chunk);
    memory_free(groups->way);
    memory_free(groups->speed);
    *groups = (ContactGroups){0};
}
