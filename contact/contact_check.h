/* What is wrong with surfaces in contact where they are: intersections, penetrations. For billow check and tests. */
#ifndef BILLOW_CONTACT_CHECK_H
#define BILLOW_CONTACT_CHECK_H

#include "solver/model.h"

/* Findings about one interface at given positions. */
typedef struct ContactFindings {
    int near_count;    /* nodes nearer than the thickness to a surface that they may meet */
    int touch_count;   /* of these, nodes that lie on it (nearer than 1e-6 of the thickness) */
    double nearest;    /* least distance of a near node over the thickness of the pair */
    int nearest_node;  /* internal; -1 none */
    double place[3];   /* where */
    int cross_count;   /* edges that go through a triangle */
    int cross_edge[2]; /* nodes of the first; -1 none */
    double cross_place[3];
} ContactFindings;

/* Called for every near node; may be NULL. The node should be moved by shift to be clear. */
typedef void ContactNear(void *user, const ContactInterface *contact, int node, double distance, double thickness,
                         const double shift[3]);

/* Looks at interface c at x (node_count x 3). 0, or -1 without memory. */
int contact_inspect(const Model *model, const ContactInterface *c, const double *x, ContactFindings *findings,
                    ContactNear *near, void *user);

#endif
