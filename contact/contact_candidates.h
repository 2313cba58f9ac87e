/* Pairs of items of a group of owners that are near, kept from one close look at two groups to the next: as long as
 * these have not come nearer by what the look went beyond need (docs/theory.md, Search). */
#ifndef BILLOW_CONTACT_CANDIDATES_H
#define BILLOW_CONTACT_CANDIDATES_H

#include "contact/near_kernels.h"

/* Slots of pairs of groups in the list of their group of owners. */
enum { CONTACT_NO_SLOT = -1, CONTACT_NEW_SLOT = -2 };

/* What a pair of groups has kept of its last look. */
typedef struct ContactKept {
    int32_t slot;        /* of its candidates; CONTACT_NO_SLOT: there are none */
    uint16_t own, other; /* lanes that were nearly sharp: of edges only those pairs are there of which one is */
    float slack;         /* of the pair then [L] */
    float within;        /* all with a gap of no more than this are there; -FLT_MAX: nothing is known [L] */
} ContactKept;

/* A candidate that a look has found. */
typedef struct ContactCandidate {
    int32_t owner, item; /* lane, number */
    int32_t pair;        /* which of the group's pairs; in the end its slot */
    float gap;           /* from below, then, less the thickness of the groups [L] */
} ContactCandidate;

/* Candidates of one group of owners, by lane and then by item, both ascending. */
typedef struct ContactCandidates {
    float *gap; /* [L] */
    int32_t *item, *slot;
    int32_t first[CONTACT_GROUP + 1]; /* of each lane */
    int32_t slots;                    /* all are less */
    size_t gap_capacity, item_capacity, slot_capacity;
} ContactCandidates;

/* Room for what changes candidates; of one thread. */
typedef struct ContactSorting {
    ContactCandidate *candidate; /* new ones, as found */
    ContactCandidate *sorted;    /* those by lane and item */
    ContactCandidates merged;    /* with the old ones */
    unsigned char *used;         /* by slot: a pair has it */
    int32_t count;
    size_t candidate_capacity, sorted_capacity, used_capacity;
} ContactSorting;

/* By how much the pair may have come nearer since its look; slack: what it has left. */
static inline float contact_kept_way(const ContactKept *kept, float slack)
{
    return (kept->slack - slack) * (1.0f + 1e-6f);
}

/* Adds what a look has found of pair number k of the group; thickness: of the two groups. 0, or -1 without memory. */
int contact_candidates_find(ContactSorting *new, ContactKept *kept, int k, const ContactLook *look, double thickness);

/* Takes the new candidates into the group's, which has pairs; those of pairs looked at anew and of pairs that are no
 * more go. 0, or -1 without memory. */
int contact_candidates_merge(ContactCandidates *all, ContactKept *kept, int pairs, ContactSorting *new);

void contact_candidates_free(ContactCandidates *all);
void contact_sorting_free(ContactSorting *sorting);

#endif
