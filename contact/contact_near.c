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

/* Looks closely at one pair of groups, of which two points may come nearer by step. Returns their slack. */
static double look_at(ContactLoop *loop, ContactRun *run, bool edges, int group, int other, double step, int thread)
{
    const ContactList *list = edges ? &run->edges : &run->faces;
    const ContactGroups *own = edges ? &run->lines : &run->nodes, *all = edges ? &run->lines : &run->triangles;
    ContactPart *part = &loop->parts[thread];
    ContactLook *look = &part->look;
    double thickness = own->radius[group] + all->radius[other];
    look->x = loop->state->x;
    look->depth = list->depth;
    look->deepest = list->deepest[group];
    look->owners = &own->lanes[group];
    look->others = &all->lanes[other];
    look->reach = thickness + step;
    (edges ? loop->kernels->edges : loop->kernels->faces)(look);
    if (look->count > 0) keep_found(part);
    return look->nearest - thickness;
}

void contact_find_near(ContactLoop *loop, ContactRun *run, bool edges, int group, int thread)
{
    ContactList *list = edges ? &run->edges : &run->faces;
    ContactWatch watch = {.own = edges ? &run->lines : &run->nodes,
                          .others = edges ? &run->lines : &run->triangles,
                          .group = group,
                          .before = (float)loop->step.before,
                          .longer = (float)loop->step.longer,
                          .deepest = (float)list->deepest[group]};
    loop->parts[thread].near_count = 0;
    for (int32_t first = list->start[group], end = list->start[group + 1]; first < end; first += CONTACT_GROUP) {
        int count = end - first < CONTACT_GROUP ? end - first : CONTACT_GROUP;
        const int32_t *other = list->pairs.other + first;
        float *slack = list->pairs.slack + first;
        _Alignas(64) float speed[CONTACT_GROUP];
        unsigned awake = loop->motion_kernels->wake(&watch, other, slack, count, speed);
        for (; awake; awake &= awake - 1) {
            int k = __builtin_ctz(awake);
            if (watch.own->idle[group] && watch.others->idle[other[k]]) continue; /* until an edge is sharp */
            double step = (double)speed[k] * loop->step.longer;
            slack[k] = contact_slack(look_at(loop, run, edges, group, other[k], step, thread));
        }
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

int contact_sort_near(ContactPart *part, ContactList *list, int group, const ContactLanes *lanes,
                      int start[CONTACT_GROUP + 1])
{
    start[CONTACT_GROUP] = 0;
    if (list->holds[group]) list->holds[group] = remembers(list, lanes);
    if (part->near_count == 0 && !list->holds[group]) return 0;
    list->holds[group] = 1; /* what is near may come to be held */
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
