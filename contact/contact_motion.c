#include "contact/contact_motion.h"

#include <math.h>

#include "contact/contact_sides.h"
#include "solver/memory.h"

/* Adds a node that the group does not have yet; node: room for it. */
static int add_node(int32_t *node, int count, int32_t added)
{
    for (int k = 0; k < count; k++)
        if (node[k] == added) return count;
    node[count] = added;
    return count + 1;
}

/* What the items of a group have in common. */
static void describe(ContactGroups *groups, const ContactItems *items, int g)
{
    const ContactLanes *lanes = &groups->lanes[g];
    groups->body[g] = items->body[lanes->item[0]];
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) {
        int32_t i = lanes->item[k];
        groups->radius[g] = fmax(groups->radius[g], items->radius[i]);
        groups->side[g] |= items->side[i];
        if (items->body[i] != groups->body[g]) groups->body[g] = CONTACT_MIXED;
    }
}

/* Lane k of a group is item i; what is nobody's gets a number that no other lane has, of nodes or of triangles. */
static void fill_lane(ContactLanes *lanes, const ContactItems *items, int k, int32_t i)
{
    int32_t nobody = -10 - 2 * i - (items->corners == 1);
    lanes->item[k] = i;
    for (int n = 0; n < items->corners; n++) lanes->node[n][k] = items->node[(ptrdiff_t)items->corners * i + n];
    for (int n = items->corners; n < 3; n++) lanes->node[n][k] = lanes->node[0][k];
    lanes->node[3][k] = items->fourth ? items->fourth[i] : -1;
    for (int n = 0; n < 2 && items->wing; n++) lanes->node[2 + n][k] = items->wing[2 * (ptrdiff_t)i + n];
    lanes->side[k] = items->side[i];
    lanes->body[k] = items->body[i] == -1 ? nobody : items->body[i];
    lanes->shell[k] = items->shell && items->shell[i] >= 0 ? items->shell[i] : nobody;
}

/* Lanes and nodes of group g, which has count items. */
static void fill_group(ContactGroups *groups, const ContactItems *items, int g, const int32_t *item, int count)
{
    ContactLanes *lanes = &groups->lanes[g];
    int32_t sorted[CONTACT_GROUP];
    int nodes = 0;
    for (int k = 0; k < count; k++) sorted[k] = item[k];
    contact_sort(sorted, count);
    for (int k = 0; k < CONTACT_GROUP; k++) fill_lane(lanes, items, k, sorted[k < count ? k : 0]);
    for (int k = count; k < CONTACT_GROUP; k++) lanes->item[k] = -1, lanes->side[k] = 0;
    for (int k = 0; k < count; k++)
        for (int n = 0; n < items->corners; n++)
            nodes = add_node(groups->node + groups->start[g], nodes, lanes->node[n][k]);
    groups->start[g + 1] = groups->start[g] + nodes;
    describe(groups, items, g);
}

int contact_groups_create(ContactGroups *groups, const ContactItems *items, const int32_t *order)
{
    groups->count = (items->count + CONTACT_GROUP - 1) / CONTACT_GROUP;
    size_t count = (size_t)groups->count + 1;
    groups->lanes = memory_alloc(count, sizeof *groups->lanes);
    groups->start = memory_alloc(count, sizeof *groups->start);
    groups->node = memory_alloc((size_t)items->count * (size_t)items->corners + 1, sizeof *groups->node);
    groups->speeds = memory_alloc(count, sizeof *groups->speeds);
    groups->box = memory_alloc(count, sizeof *groups->box);
    groups->radius = memory_alloc(count, sizeof *groups->radius);
    groups->skin = memory_alloc(count, sizeof *groups->skin);
    groups->side = memory_alloc(count, 1);
    groups->body = memory_alloc(count, sizeof *groups->body);
    groups->watched = memory_alloc(count, 1);
    if (!groups->lanes || !groups->start || !groups->node || !groups->speeds || !groups->box || !groups->radius ||
        !groups->skin || !groups->side || !groups->body || !groups->watched)
        return -1;
    for (int g = 0; g < groups->count; g++) {
        int first = g * CONTACT_GROUP, left = items->count - first;
        fill_group(groups, items, g, order + first, left < CONTACT_GROUP ? left : CONTACT_GROUP);
    }
    return 0;
}

void contact_groups_renew(ContactGroups *groups, const ContactItems *items)
{
    for (int g = 0; g < groups->count; g++) {
        ContactLanes *lanes = &groups->lanes[g];
        groups->side[g] = 0;
        for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) fill_lane(lanes, items, k, lanes->item[k]);
        describe(groups, items, g);
    }
}

void contact_groups_place(ContactGroups *groups, const double *x, const double *skins, int first, int end)
{
    for (int g = first; g < end; g++) {
        ContactBox *box = &groups->box[g];
        contact_box_start(box, x + 3 * (ptrdiff_t)groups->node[groups->start[g]]);
        groups->skin[g] = 0.0;
        for (int32_t k = groups->start[g]; k < groups->start[g + 1]; k++) {
            int32_t node = groups->node[k];
            contact_box_add(box, x + 3 * (ptrdiff_t)node);
            if (skins[node / CONTACT_NODE_CHUNK] > groups->skin[g]) groups->skin[g] = skins[node / CONTACT_NODE_CHUNK];
        }
        groups->watched[g] = 1;
    }
}

void contact_groups_unwatch(ContactGroups *groups, int first, int end)
{
    for (int g = first; g < end; g++) groups->watched[g] = 0;
}

bool contact_groups_meet(const ContactGroups *a, int g, const ContactGroups *b, int h)
{
    if (!contact_sides_meet(a->side[g], b->side[h])) return false;
    return a->body[g] == CONTACT_MIXED || a->body[g] == -1 || a->body[g] != b->body[h];
}

void contact_groups_free(ContactGroups *groups)
{
    memory_free(groups->lanes);
    memory_free(groups->start);
    memory_free(groups->node);
    memory_free(groups->speeds);
    memory_free(groups->box);
    memory_free(groups->radius);
    memory_free(groups->skin);
    memory_free(groups->side);
    memory_free(groups->body);
    memory_free(groups->watched);
    *groups = (ContactGroups){0};
}
