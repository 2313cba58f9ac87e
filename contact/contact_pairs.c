/* Pairs of groups: what threads found behind each other. */
#include "contact/contact_pairs.h"

#include <string.h>

#include "solver/memory.h"

int contact_part_add(ContactPart *part, int32_t other, double slack)
{
    if (memory_reserve((void **)&part->pair, &part->pair_capacity, part->pair_count + 1, sizeof *part->pair)) return -1;
    part->pair[part->pair_count++] = (ContactGroupPair){.slack = slack, .other = other};
    return 0;
}

int contact_first_of(int count, int thread, int threads)
{
    return (int)((int64_t)count * thread / threads);
}

/* A pair that was there before may know better how far apart its groups are. */
void contact_pairs_remember(const ContactList *list, int group, ContactGroupPair *pair, size_t count)
{
    int32_t old = list->start[group], end = list->start[group + 1];
    for (size_t k = 0; k < count; k++) {
        while (old < end && list->pair[old].other < pair[k].other) old++;
        if (old < end && list->pair[old].other == pair[k].other)
            pair[k].slack = fmax(pair[k].slack, list->pair[old].slack);
    }
}

int contact_pairs_join(ContactLoop *loop, ContactList *list, int threads)
{
    size_t count = 0, capacity = list->pair_capacity;
    for (int k = 0; k < threads; k++) {
        const ContactPart *part = &loop->parts[k];
        if (part->failed || memory_reserve((void **)&list->next, &list->next_capacity, count + part->pair_count + 1,
                                           sizeof *list->next))
            return -1;
        for (int g = contact_first_of(list->group_count, k, threads);
             g < contact_first_of(list->group_count, k + 1, threads); g++)
            list->next_start[g] += (int32_t)count;
        if (part->pair_count > 0) memcpy(list->next + count, part->pair, part->pair_count * sizeof *part->pair);
        count += part->pair_count;
    }
    list->next_start[list->group_count] = (int32_t)count;
    ContactGroupPair *pair = list->pair;
    int32_t *start = list->start;
    list->pair = list->next, list->next = pair;
    list->start = list->next_start, list->next_start = start;
    list->pair_capacity = list->next_capacity, list->next_capacity = capacity;
    return 0;
}

void contact_pairs_forget(ContactList *list)
{
    memset(list->start, 0, ((size_t)list->group_count + 1) * sizeof *list->start);
}

void contact_awake(ContactList *list)
{
    for (int32_t k = 0; k < list->start[list->group_count]; k++) list->pair[k].slack = -INFINITY;
}
