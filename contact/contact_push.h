/* Pairs of one group that are near: gathered in lanes, pushed together, taken back one by one. Private to contact/. */
#ifndef BILLOW_CONTACT_PUSH_H
#define BILLOW_CONTACT_PUSH_H

#include "contact/contact_loop.h"

/* A pair that is near: geometry of this cycle. */
typedef struct ContactTouch {
    int32_t node[4];
    double weight[4];
    double gap;          /* distance on the side where it is taken to be; negative behind [L] */
    double thickness;    /* distance at which it should stay [L] */
    double direction[3]; /* unit vector of the force on the first weight */
    double speed[3];     /* sum of weight v: velocity of the first against the second [L/T] */
    double stiffness;    /* share of the stability limit */
    int side;            /* for a new pair */
} ContactTouch;

/* Room for the accelerations of all nodes. 0, or -1 without memory. */
int contact_pulls_create(ContactPart *part, int nodes);

/* Empties the thread's lanes and makes room for count pairs. 0, or -1 without memory (the part has failed). */
int contact_push_begin(ContactPart *part, int count);

/* Adds a pair of an owner; m: what it remembers, NULL of a new one. */
void contact_push_add(const ContactLoop *loop, ContactPart *part, const ContactTouch *t, ContactMemory *m, int owner,
                      int32_t other);

/* Pushes all that have been added. */
void contact_push_all(const ContactLoop *loop, const ContactLaw *law, ContactPart *part);

/* Keeps or clears what the pair in lane l remembers; its force, if it counts, goes into out and the sums. Returns
 * whether it does. */
bool contact_push_take(ContactList *list, const PushPairs *block, int l, ContactSums *sums, ContactForce *out);

#endif
