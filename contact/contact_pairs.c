/* Candidate lists: what threads found behind each other, memories of pairs kept from one list to the next. */
#include "contact/contact_pairs.h"

#include <string.h>

#include "solver/memory.h"

/* Begins a new list in the room of the one before the last. */
int contact_pairs_begin(ContactList *list)
{
    ContactPairs last = list->pairs;
    list->pairs = list->before;
    list->before = last;
    list->pairs.count = 0;
    return memory_reserve((void **)&list->pairs.start, &list->pairs.start_capacity, (size_t)list->owner_count + 1,
                          sizeof *list->pairs.start);
}

int contact_part_add(ContactPart *part, int32_t other)
{
    if (memory_reserve((void **)&part->other, &part->other_capacity, part->count + 1, sizeof *part->other)) return -1;
    part->other[part->count++] = other;
    return 0;
}

/* First owner of a thread. */
int contact_first_of(int count, int thread, int threads)
{
    return (int)((int64_t)count * thread / threads);
}

/* Puts what the threads found behind each other. */
int contact_pairs_join(ContactLoop *loop, ContactList *list, int threads)
{
    ContactPairs *pairs = &list->pairs;
    for (int k = 0; k < threads; k++) {
        const ContactPart *part = &loop->parts[k];
        if (part->failed || memory_reserve((void **)&pairs->other, &pairs->other_capacity, pairs->count + part->count,
                                           sizeof *pairs->other))
            return -1;
        for (int i = contact_first_of(list->owner_count, k, threads);
             i < contact_first_of(list->owner_count, k + 1, threads); i++)
            pairs->start[i] += (int32_t)pairs->count;
        if (part->count > 0) memcpy(pairs->other + pairs->count, part->other, part->count * sizeof *part->other);
        pairs->count += part->count;
    }
    return 0;
}

/* Memories move to the new places of their pairs; both lists ascend. */
int contact_pairs_end(ContactList *list)
{
    ContactPairs *pairs = &list->pairs;
    const ContactPairs *before = &list->before;
    pairs->start[list->owner_count] = (int32_t)pairs->count;
    size_t room = pairs->count + 1;
    if (memory_reserve((void **)&pairs->wake, &pairs->wake_capacity, room, sizeof *pairs->wake) ||
        memory_reserve((void **)&pairs->slot, &pairs->slot_capacity, room, sizeof *pairs->slot) ||
        memory_reserve((void **)&list->forces, &list->force_capacity, room, sizeof *list->forces))
        return -1;
    memset(pairs->wake, 0, pairs->count * sizeof *pairs->wake);
    memset(pairs->slot, 0, pairs->count * sizeof *pairs->slot);
    memset(list->idle, 0, (size_t)list->chunk_count * sizeof *list->idle);
    for (int i = 0; before->start && i < list->owner_count; i++) {
        int32_t n = pairs->start[i], end = pairs->start[i + 1];
        for (int32_t o = before->start[i]; o < before->start[i + 1]; o++) {
            if (before->slot[o] == 0) continue;
            while (n < end && pairs->other[n] < before->other[o]) n++;
            if (n < end && pairs->other[n] == before->other[o])
                pairs->slot[n] = before->slot[o];
            else /* no candidate any more */
                list->memory[(ptrdiff_t)i * CONTACT_SLOTS + before->slot[o] - 1] = (ContactMemory){0};
        }
    }
    return 0;
}

/* Without memory: nothing meets until the run ends in this cycle. */
void contact_pairs_forget(ContactList *list)
{
    list->pairs.count = 0;
    memory_free(list->pairs.start);
    list->pairs.start = NULL;
    list->pairs.start_capacity = 0;
}
