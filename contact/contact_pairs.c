/* Pairs of groups: what threads found behind each other. */
#include "contact/contact_pairs.h"

#include <float.h>
#include <string.h>

#include "solver/memory.h"

/* Nothing is known of a pair. */
#define NOTHING_KEPT ((ContactKept){.slot = CONTACT_NO_SLOT, .within = -FLT_MAX})

/* Room for count pairs. */
static int reserve(ContactGroupPairs *pairs, size_t count)
{
    return memory_reserve((void **)&pairs->other, &pairs->other_capacity, count, sizeof *pairs->other) ||
                   memory_reserve((void **)&pairs->slack, &pairs->slack_capacity, count, sizeof *pairs->slack) ||
                   memory_reserve((void **)&pairs->kept, &pairs->kept_capacity, count, sizeof *pairs->kept)
               ? -1
               : 0;
}

void contact_pairs_free(ContactGroupPairs *pairs)
{
    memory_free(pairs->other);
    memory_free(pairs->slack);
    memory_free(pairs->kept);
}

int contact_part_reserve(ContactPart *part, size_t more, int groups)
{
    size_t had = part->place_capacity;
    if (memory_reserve((void **)&part->place, &part->place_capacity, (size_t)groups + 1, sizeof *part->place))
        return -1;
    if (part->place_capacity > had) memset(part->place + had, 0, (part->place_capacity - had) * sizeof *part->place);
    return reserve(&part->pairs, part->pair_count + more + 1);
}

void contact_part_add(ContactPart *part, int32_t other, double slack)
{
    part->pairs.other[part->pair_count] = other;
    part->pairs.kept[part->pair_count] = NOTHING_KEPT;
    part->pairs.slack[part->pair_count++] = contact_slack(slack);
}

int contact_first_of(int count, int thread, int threads)
{
    return (int)((int64_t)count * thread / threads);
}

/* A pair that was there before may know better how far apart its groups are, and has its candidates. */
void contact_pairs_remember(const ContactList *list, int group, ContactPart *part, size_t first)
{
    int32_t from = list->start[group], end = list->start[group + 1];
    const ContactGroupPairs *before = &list->pairs;
    for (int32_t old = from; old < end; old++) part->place[before->other[old]] = old + 1;
    for (size_t k = first; k < part->pair_count; k++) {
        int32_t old = part->place[part->pairs.other[k]] - 1;
        if (old < 0) continue;
        part->pairs.kept[k] = before->kept[old];
        if (before->kept[old].within > -FLT_MAX || before->slack[old] > part->pairs.slack[k])
            part->pairs.slack[k] = before->slack[old];
    }
    for (int32_t old = from; old < end; old++) part->place[before->other[old]] = 0;
}

int contact_pairs_join(ContactLoop *loop, ContactList *list, int threads)
{
    size_t count = 0;
    for (int k = 0; k < threads; k++) {
        const ContactPart *part = &loop->parts[k];
        if (part->failed || reserve(&list->next, count + part->pair_count + 1)) return -1;
        for (int g = contact_first_of(list->group_count, k, threads);
             g < contact_first_of(list->group_count, k + 1, threads); g++)
            list->next_start[g] += (int32_t)count;
        if (part->pair_count > 0) {
            memcpy(list->next.other + count, part->pairs.other, part->pair_count * sizeof *part->pairs.other);
            memcpy(list->next.slack + count, part->pairs.slack, part->pair_count * sizeof *part->pairs.slack);
            memcpy(list->next.kept + count, part->pairs.kept, part->pair_count * sizeof *part->pairs.kept);
        }
        count += part->pair_count;
    }
    list->next_start[list->group_count] = (int32_t)count;
    ContactGroupPairs pairs = list->pairs;
    int32_t *start = list->start;
    list->pairs = list->next, list->next = pairs;
    list->start = list->next_start, list->next_start = start;
    return 0;
}

void contact_pairs_forget(ContactList *list)
{
    memset(list->start, 0, ((size_t)list->group_count + 1) * sizeof *list->start);
}

void contact_awake(ContactList *list)
{
    for (int32_t k = 0; k < list->start[list->group_count]; k++) {
        list->pairs.slack[k] = -FLT_MAX;
        list->pairs.kept[k] = NOTHING_KEPT;
    }
}
