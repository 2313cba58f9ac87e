/* Pairs of items that are near, kept sorted from look to look. */
#include "contact/contact_candidates.h"

#include <math.h>
#include <string.h>

#include "solver/memory.h"

int contact_candidates_find(ContactSorting *new, ContactKept *kept, int k, const ContactLook *look, double thickness)
{
    if (memory_reserve((void **)&new->candidate, &new->candidate_capacity, (size_t)(new->count + look->count) + 1,
                       sizeof *new->candidate))
        return -1;
    for (int i = 0; i < look->count; i++) {
        const ContactNearby *found = &look->found[i];
        double apart = sqrt((double)found->square) - look->margin - thickness;
        new->candidate[new->count++] = (ContactCandidate){.owner = found->owner,
                                                          .item = look->others->item[found->other],
                                                          .pair = k,
                                                          .gap = (float)(apart - 1e-7 * fabs(apart))};
    }
    kept->slot = look->count > 0 ? CONTACT_NEW_SLOT : CONTACT_NO_SLOT;
    kept->within = (float)((look->reach - thickness) * (1.0 - 1e-6));
    return 0;
}

/* Gives each new candidate the slot of its pair. */
static int find_slots(ContactCandidates *all, ContactKept *kept, int pairs, ContactSorting *new)
{
    int32_t most = all->slots > pairs ? all->slots : pairs, next = 0;
    if (memory_reserve((void **)&new->used, &new->used_capacity, (size_t)most + 1, 1)) return -1;
    memset(new->used, 0, (size_t)most + 1);
    for (int k = 0; k < pairs; k++)
        if (kept[k].slot >= 0) new->used[kept[k].slot] = 1;
    all->slots = 0;
    for (int k = 0; k < pairs; k++) {
        if (kept[k].slot == CONTACT_NEW_SLOT) {
            while (new->used[next]) next++;
            kept[k].slot = next++;
        }
        if (kept[k].slot >= all->slots) all->slots = kept[k].slot + 1;
    }
    for (int32_t i = 0; i < new->count; i++) new->candidate[i].pair = kept[new->candidate[i].pair].slot;
    return 0;
}

/* Those of one lane by item: they come in runs that are sorted. */
static void sort_lane(ContactCandidate *candidate, int32_t count)
{
    for (int32_t n = 1; n < count; n++) {
        ContactCandidate moved = candidate[n];
        int32_t m = n;
        for (; m > 0 && candidate[m - 1].item > moved.item; m--) candidate[m] = candidate[m - 1];
        candidate[m] = moved;
    }
}

/* The new ones by lane and, in each, by item; start: of each lane. */
static void sort_new(ContactSorting *new, int32_t start[CONTACT_GROUP + 1])
{
    int32_t place[CONTACT_GROUP] = {0}, count = 0;
    for (int32_t i = 0; i < new->count; i++) place[new->candidate[i].owner]++;
    for (int l = 0; l < CONTACT_GROUP; l++) {
        int32_t of_lane = place[l];
        start[l] = place[l] = count;
        count += of_lane;
    }
    start[CONTACT_GROUP] = count;
    for (int32_t i = 0; i < new->count; i++) new->sorted[place[new->candidate[i].owner]++] = new->candidate[i];
    for (int l = 0; l < CONTACT_GROUP; l++) sort_lane(new->sorted + start[l], start[l + 1] - start[l]);
}

static int32_t put(ContactCandidates *to, int32_t count, float gap, int32_t item, int32_t slot)
{
    to->gap[count] = gap;
    to->item[count] = item;
    to->slot[count] = slot;
    return count + 1;
}

/* Old ones of a lane whose pair still has them, and new ones [n, end), into to from place count on. Returns where they
 * end. */
static int32_t merge_lane(const ContactCandidates *all, int l, const ContactSorting *new, int32_t n, int32_t end,
                          ContactCandidates *to, int32_t count)
{
    for (int32_t i = all->first[l]; i < all->first[l + 1]; i++) {
        if (n < end && new->used[all->slot[i]])
            for (; n < end && new->sorted[n].item < all->item[i]; n++)
                count = put(to, count, new->sorted[n].gap, new->sorted[n].item, new->sorted[n].pair);
        put(to, count, all->gap[i], all->item[i], all->slot[i]); /* overwritten if it goes */
        count += new->used[all->slot[i]];
    }
    for (; n < end; n++) count = put(to, count, new->sorted[n].gap, new->sorted[n].item, new->sorted[n].pair);
    return count;
}

/* Room for most candidates. */
static int reserve(ContactCandidates *all, size_t most)
{
    return memory_reserve((void **)&all->gap, &all->gap_capacity, most, sizeof *all->gap) ||
                   memory_reserve((void **)&all->item, &all->item_capacity, most, sizeof *all->item) ||
                   memory_reserve((void **)&all->slot, &all->slot_capacity, most, sizeof *all->slot)
               ? -1
               : 0;
}

int contact_candidates_merge(ContactCandidates *all, ContactKept *kept, int pairs, ContactSorting *new)
{
    size_t most = (size_t)(all->first[CONTACT_GROUP] + new->count) + CONTACT_GROUP; /* whole registers are read */
    ContactCandidates *to = &new->merged;
    int32_t start[CONTACT_GROUP + 1], count = 0;
    if (find_slots(all, kept, pairs, new) ||
        memory_reserve((void **)&new->sorted, &new->sorted_capacity, (size_t) new->count + 1, sizeof *new->sorted) ||
        reserve(all, most) || reserve(to, most))
        return -1;
    sort_new(new, start);
    for (int l = 0; l < CONTACT_GROUP; l++) {
        to->first[l] = count;
        count = merge_lane(all, l, new, start[l], start[l + 1], to, count);
    }
    to->first[CONTACT_GROUP] = count;
    memcpy(all->first, to->first, sizeof all->first);
    memcpy(all->gap, to->gap, (size_t)count * sizeof *all->gap);
    memcpy(all->item, to->item, (size_t)count * sizeof *all->item);
    memcpy(all->slot, to->slot, (size_t)count * sizeof *all->slot);
    new->count = 0;
    return 0;
}

void contact_candidates_free(ContactCandidates *all)
{
    memory_free(all->gap);
    memory_free(all->item);
    memory_free(all->slot);
    *all = (ContactCandidates){0};
}

void contact_sorting_free(ContactSorting *sorting)
{
    memory_free(sorting->candidate);
    memory_free(sorting->sorted);
    memory_free(sorting->used);
    contact_candidates_free(&sorting->merged);
    *sorting = (ContactSorting){0};
}
