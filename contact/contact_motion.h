/* Where nodes, triangles and edges are and how fast, by groups of them: pairs of groups sleep until they may have met.
 */
#ifndef BILLOW_CONTACT_MOTION_H
#define BILLOW_CONTACT_MOTION_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "contact/contact_grid.h"
#include "solver/model.h"

enum {
    CONTACT_GROUP = 16,      /* nodes, triangles or edges of one group: lanes of contact/near_kernels.c */
    CONTACT_NODE_CHUNK = 64, /* nodes of one fixed partial sum */
    CONTACT_MIXED = -3,      /* body of a group with items of several */
};

/* Least gap that a step may leave, as a share of the distance at which the pair begins to push (eq. C13). */
#define CONTACT_FLOOR 0.3

/* How far beyond its thickness a pair counts that closes by way in a step: it comes within the thickness in the coming
 * step, or below the floor in the next one (eq. C6a). */
static inline double contact_ahead(double way, double thickness)
{
    double next = 2.0 * way - (1.0 - CONTACT_FLOOR) * thickness;
    return next > way ? next : way;
}

/* Box around ways since the last search; zero is in it. */
typedef struct ContactDrift {
    double low[3], high[3];
} ContactDrift;

static inline void contact_drift_add(ContactDrift *drift, int axis, double low, double high)
{
    drift->low[axis] = low < drift->low[axis] ? low : drift->low[axis];
    drift->high[axis] = high > drift->high[axis] ? high : drift->high[axis];
}

/* Where nodes would be and how fast if they had not drifted. */
typedef struct DriftOrigin {
    const double *from; /* positions at the last search (count x 3) [L] */
    double way[3];      /* way of all of them since [L] */
    double velocity[3]; /* of all of them [L/T] */
} DriftOrigin;

/* Sums over one chunk of nodes after the step. */
typedef struct ContactMotion {
    double power;   /* of the contact forces on the velocities at n + 1/2 */
    double fastest; /* largest square of a speed against the origin's */
    ContactDrift drift;
} ContactMotion;

/* Items of one kind as the interface has them; arrays by item. */
typedef struct ContactItems {
    int count, corners;
    const int32_t *node; /* (count x corners) */
    const unsigned char *side;
    const int32_t *body;
    const double *radius;
    const int32_t *shell;  /* element; NULL: none */
    const int32_t *fourth; /* fourth node, -1 none; NULL: none */
    const int32_t *wing;   /* of edges (count x 2): far corners of the triangles at it, or its own node; NULL: none */
} ContactItems;

/* The items of one group lane by lane, as kernels read them; lanes without an item have side 0. */
typedef struct ContactLanes {
    int32_t item[CONTACT_GROUP];    /* ascending, -1 none */
    int32_t node[4][CONTACT_GROUP]; /* its nodes, then: of a triangle the one of its quadrilateral that it lacks, or -1;
                                     * of an edge its wings */
    int32_t side[CONTACT_GROUP];
    int32_t body[CONTACT_GROUP];  /* rigid body; another number for each deformable item */
    int32_t shell[CONTACT_GROUP]; /* element; another number for each item without */
} ContactLanes;

/* Largest velocities of a group's nodes against and along the axes, rounded up; the fourths are 0 [L/T]. */
typedef struct ContactSpeeds {
    _Alignas(32) float down[4];
    float up[4];
} ContactSpeeds;

typedef struct ContactGroups {
    int count;
    ContactLanes *lanes;    /* (count) */
    int32_t *start;         /* of each group in node (count + 1) */
    int32_t *node;          /* nodes of each group, each once */
    ContactSpeeds *speeds;  /* now (count) */
    ContactBox *box;        /* around its nodes at the last search (count) [L] */
    double *radius;         /* largest of its items (count) [L] */
    double *skin;           /* largest of its nodes since the last search (count) [L] */
    unsigned char *side;    /* of all its items (count) */
    int32_t *body;          /* of all its items, or CONTACT_MIXED (count) */
    unsigned char *watched; /* it is in a pair: its velocity is kept (count) */
} ContactGroups;

/* Groups of items in an order by contact_patches. 0, or -1 without memory. */
int contact_groups_create(ContactGroups *groups, const ContactItems *items, const int32_t *order);

/* What the items are is new, but not which there are nor their nodes. */
void contact_groups_renew(ContactGroups *groups, const ContactItems *items);

/* At a search: boxes and skins of the groups [first, end) at positions x, skins by chunk of nodes; all are watched,
 * until contact_groups_unwatch. */
void contact_groups_place(ContactGroups *groups, const double *x, const double *skins, int first, int end);

/* None of [first, end) is watched. */
void contact_groups_unwatch(ContactGroups *groups, int first, int end);

/* Can an item of group g meet one of group h? */
bool contact_groups_meet(const ContactGroups *a, int g, const ContactGroups *b, int h);

/* Keeps the box low to high around the velocities of group g. */
static inline void contact_velocity_keep(ContactGroups *groups, int g, const double *low, const double *high)
{
    for (int k = 0; k < 3; k++) {
        groups->speeds[g].down[k] = (float)(1e-6 * fabs(low[k]) - low[k]);
        groups->speeds[g].up[k] = (float)(high[k] + 1e-6 * fabs(high[k]));
    }
}

void contact_groups_free(ContactGroups *groups);

#endif
