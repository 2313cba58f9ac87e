/* How far nodes may go until groups that are no pair may have come near: each chunk of nodes has a skin by its own
 * speed (docs/theory.md, Search). */
#ifndef BILLOW_CONTACT_SKIN_H
#define BILLOW_CONTACT_SKIN_H

#include "contact/contact_loop.h"

/* At a search, thread 0: where the nodes are and how fast, and the skins that follow from it. */
void contact_skin_choose(ContactLoop *loop);

/* May groups that are no pair come nearer than contact looks in the coming step? After each step, thread 0. */
bool contact_skin_used_up(ContactLoop *loop);

#endif
