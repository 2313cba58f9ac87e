/* Shells that have eroded leave contact: the loop has own copies of what that changes of an interface. */
#ifndef BILLOW_CONTACT_EROSION_H
#define BILLOW_CONTACT_EROSION_H

#include "contact/contact_loop.h"

/* Gives the run a surface of its own, in place of the model's; -1 without memory. */
int contact_living_create(ContactRun *run, const ContactInterface *contact, int nodes);
void contact_living_free(ContactRun *run);

/* Thread 0: all surfaces anew, of the shells that State.eroded leaves; pairs of others are forgotten, all groups are
 * awake. A search must follow. */
void contact_erode(ContactLoop *loop);

#endif
