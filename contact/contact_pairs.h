/* Candidate lists as data; the search (contact_find_pairs.c) fills them. */
#ifndef BILLOW_CONTACT_PAIRS_H
#define BILLOW_CONTACT_PAIRS_H

#include "contact/contact_loop.h"

/* First of count owners that a thread has. */
int contact_first_of(int count, int thread, int threads);

/* A new list in the room of the one before the last. These return 0, or -1 without memory. */
int contact_pairs_begin(ContactList *list);
int contact_part_add(ContactPart *part, int32_t other);

/* Puts what the threads found behind each other, then moves memories to the new places of their pairs. */
int contact_pairs_join(ContactLoop *loop, ContactList *list, int threads);
int contact_pairs_end(ContactList *list);

/* Without memory: nothing meets until the run ends in this cycle. */
void contact_pairs_forget(ContactList *list);

#endif
