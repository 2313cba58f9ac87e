/* Pairs of groups as data; the search (contact_find_pairs.c) fills them. */
#ifndef BILLOW_CONTACT_PAIRS_H
#define BILLOW_CONTACT_PAIRS_H

#include <float.h>

#include "contact/contact_loop.h"

/* First of count that a thread has. */
int contact_first_of(int count, int thread, int threads);

/* Room for what a group of owners has found: others of all groups at most. These return 0, or -1 without memory. */
int contact_part_reserve(ContactPart *part, size_t more, int groups);

/* Adds one to what a thread has found. */
void contact_part_add(ContactPart *part, int32_t other, double slack);

/* Pairs of a group just found, from the part's first on: those that were there before keep what slack they had. */
void contact_pairs_remember(const ContactList *list, int group, ContactPart *part, size_t first);

void contact_pairs_free(ContactGroupPairs *pairs);

/* A slack as it is kept, rounded down. */
static inline float contact_slack(double slack)
{
    double most = 0.5 * (double)FLT_MAX;
    if (!(slack > -most)) return -FLT_MAX;
    return (float)(slack < most ? slack - 1e-7 * fabs(slack) : most);
}

/* Puts what the threads found behind each other. */
int contact_pairs_join(ContactLoop *loop, ContactList *list, int threads);

/* Without memory: nothing meets until the run ends in this cycle. */
void contact_pairs_forget(ContactList *list);

#endif
