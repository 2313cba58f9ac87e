/* Which pairs of a group of owners may touch in this step: groups that have come near enough are looked at closely. */
#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "solver/memory.h"

/* Keeps what a look has found. */
static void keep_found(ContactPart *part)
{
    const ContactLook *look = &part->look;
    if (memory_reserve((void **)&part->near, &part->near_capacity, part->near_count + (size_t)look->count + 1,
                       sizeof *part->near)) {
        part->failed = true;
        return;
    }
    for (int k = 0; k < look->count; k++) part->near[part->near_count++] = look->found[k];
}

void contact_find_near(ContactLoop *loop, ContactRun *run, bool edges, int group, int thread)
{
    ContactList *list = edges ? &run->edges : &run->faces;
    const ContactGroups *own = edges ? &run->lines : &run->nodes, *all = edges ? &run->lines : &run->triangles;
    ContactPart *part = &loop->parts[thread];
    const ContactVelocities *velocity = &own->velocity[group];
    double before = loop->step.before, longer = loop->step.longer, deepest = list->deepest[group];
    part->near_count = 0;
    for (int32_t k = list->start[group]; k < list->start[group + 1]; k++) {
        ContactGroupPair *pair = &list->pair[k];
        double speed = contact_closing(velocity, &all->velocity[pair->other]), step = speed * longer;
        pair->slack -= speed * before;
        if (pair->slack > step + deepest) continue;
        double thickness = own->radius[group] + all->radius[pair->other];
        part->look.x = loop->state->x;
        part->look.depth = list->depth;
        part->look.deepest = deepest;
        part->look.owners = &own->lanes[group];
        part->look.others = &all->lanes[pair->other];
        part->look.reach = thickness + step;
        (edges ? loop->kernels->edges : loop->kernels->faces)(&part->look);
        pair->slack = part->look.nearest - thickness;
        if (part->look.count > 0) keep_found(part);
    }
}

/* Adds the others that an owner remembers, in their places, and leaves out doubles. Returns how many there are now. */
static int merge_memories(const ContactList *list, int owner, int32_t *other, int count)
{
    const int32_t *partner = list->partner + (ptrdiff_t)owner * CONTACT_SLOTS;
    for (int k = 0; k < list->held[owner]; k++) {
        int place = count;
        while (place > 0 && other[place - 1] > partner[k]) place--;
        if (place > 0 && other[place - 1] == partner[k]) continue;
        for (int i = count; i > place; i--) other[i] = other[i - 1];
        other[place] = partner[k];
        count++;
    }
    return count;
}

static bool remembers(const ContactList *list, const ContactLanes *lanes)
{
    for (int i = 0; i < CONTACT_GROUP && lanes->item[i] >= 0; i++)
        if (list->held[lanes->item[i]]) return true;
    return false;
}

int contact_sort_near(ContactPart *part, const ContactList *list, const ContactLanes *lanes,
                      int start[CONTACT_GROUP + 1])
{
    start[CONTACT_GROUP] = 0;
    if (part->near_count == 0 && !remembers(list, lanes)) return 0;
    int of_owner[CONTACT_GROUP] = {0}, place[CONTACT_GROUP], sum = 0, kept = 0;
    if (memory_reserve((void **)&part->other, &part->other_capacity,
                       part->near_count + (size_t)CONTACT_GROUP * CONTACT_SLOTS, sizeof *part->other))
        return -1;
    for (size_t k = 0; k < part->near_count; k++) of_owner[part->near[k].owner]++;
    for (int i = 0; i < CONTACT_GROUP; i++) {
        start[i] = place[i] = sum;
        sum += of_owner[i] + (lanes->item[i] >= 0 && list->held[lanes->item[i]] ? CONTACT_SLOTS : 0);
    }
    for (size_t k = 0; k < part->near_count; k++) part->other[place[part->near[k].owner]++] = part->near[k].other;
    for (int i = 0; i < CONTACT_GROUP; i++) { /* close the gaps */
        int found = of_owner[i], from = start[i];
        contact_sort(part->other + from, found);
        if (lanes->item[i] >= 0 && list->held[lanes->item[i]])
            found = merge_memories(list, lanes->item[i], part->other + from, found);
        start[i] = kept;
        for (int k = 0; k < found; k++) part->other[kept++] = part->other[from + k];
    }
    start[CONTACT_GROUP] = kept;
    return 0;
}

ContactForce *contact_force_room(ContactPart *part, size_t more)
{
    if (memory_reserve((void **)&part->force, &part->force_capacity, part->force_count + more, sizeof *part->force)) {
        part->failed = true;
        return NULL;
    }
    return part->force + part->force_count;
}
