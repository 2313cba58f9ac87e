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

/* Puts old ones whose pair still has them and new ones into sorted, by lane; first: of each lane there. */
static void sort_in(const ContactCandidates *all, ContactSorting *new, int32_t first[CONTACT_GROUP + 1])
{
    int32_t place[CONTACT_GROUP + 1] = {0}, count = 0, end[CONTACT_GROUP];
    for (int32_t i = 0; i < new->count; i++) place[new->candidate[i].owner]++;
    for (int l = 0; l < CONTACT_GROUP; l++) {
        int32_t added = place[l];
        first[l] = count;
        for (int32_t i = all->first[l]; i < all->first[l + 1]; i++)
            if (new->used[all->slot[i]])
                new->sorted[count++] =
                    (ContactCandidate){.owner = l, .item = all->item[i], .pair = all->slot[i], .gap = all->gap[i]};
        end[l] = count;
        count += added;
    }
    first[CONTACT_GROUP] = count;
    for (int32_t i = 0; i < new->count; i++) new->sorted[end[new->candidate[i].owner]++] = new->candidate[i];
    for (int l = 0; l < CONTACT_GROUP; l++) sort_lane(new->sorted + first[l], first[l + 1] - first[l]);
}

int contact_candidates_merge(ContactCandidates *all, ContactKept *kept, int pairs, ContactSorting *new)
{
    size_t most = (size_t)(all->first[CONTACT_GROUP] + new->count) + CONTACT_GROUP; /* whole registers are read */
    if (find_slots(all, kept, pairs, new) ||
        memory_reserve((void **)&new->sorted, &new->sorted_capacity, most, sizeof *new->sorted) ||
        memory_reserve((void **)&all->gap, &all->gap_capacity, most, sizeof *all->gap) ||
        memory_reserve((void **)&all->item, &all->item_capacity, most, sizeof *all->item) ||
        memory_reserve((void **)&all->slot, &all->slot_capacity, most, sizeof *all->slot))
        return -1;
    int32_t first[CONTACT_GROUP + 1];
    sort_in(all, new, first);
    memcpy(all->first, first, sizeof first);
    for (int32_t i = 0; i < first[CONTACT_GROUP]; i++) {
        all->gap[i] = new->sorted[i].gap;
        all->item[i] = new->sorted[i].item;
        all->slot[i] = new->sorted[i].pair;
    }
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
    *sorting = (ContactSorting){0};
}
