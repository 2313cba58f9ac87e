/* How far nodes have gone, by groups of nodes, triangles or edges: pairs sleep until theirs may have met. */
#ifndef BILLOW_CONTACT_MOTION_H
#define BILLOW_CONTACT_MOTION_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/model.h"

enum {
    CONTACT_GROUP = 64,      /* nodes, triangles or edges of one group */
    CONTACT_NODE_CHUNK = 64, /* nodes of one fixed partial sum */
};

/* Box around displacements since the last search; zero is in it. Two nodes came nearer by no more than its diagonal. */
typedef struct ContactDrift {
    double low[3], high[3];
} ContactDrift;

static inline void contact_drift_add(ContactDrift *drift, int axis, double low, double high)
{
    drift->low[axis] = low < drift->low[axis] ? low : drift->low[axis];
    drift->high[axis] = high > drift->high[axis] ? high : drift->high[axis];
}

static inline bool contact_drift_exceeds(const ContactDrift *drift, double skin)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) square += (drift->high[k] - drift->low[k]) * (drift->high[k] - drift->low[k]);
    return square > skin * skin;
}

/* Sums over one chunk of nodes after the step. */
typedef struct ContactMotion {
    double power;   /* of the contact forces on the velocities at n + 1/2 */
    double fastest; /* largest v.v */
    ContactDrift drift;
} ContactMotion;

/* Item k is in group k / CONTACT_GROUP. */
typedef struct ContactGroups {
    int count;
    int32_t *start; /* of each group in chunk (count + 1) */
    int32_t *chunk; /* chunks that hold its moving nodes */
    double *way;    /* no node of the group has gone farther since the loop began (count) [L] */
    double *speed;  /* largest now (count) [L/T] */
} ContactGroups;

/* Groups of items with so many nodes each (item_count x corners). 0, or -1 without memory. */
int contact_groups_create(ContactGroups *groups, const Model *model, int item_count, int corners, const int32_t *node);

/* Takes the speeds of all chunks, at which the nodes go for a time. */
void contact_groups_move(ContactGroups *groups, const ContactMotion *motions, double time);

void contact_groups_free(ContactGroups *groups);

#endif
