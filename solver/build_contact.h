/* The surfaces of a contact as the deck names them; private to solver/build_contact*.c. */
#ifndef BILLOW_BUILD_CONTACT_H
#define BILLOW_BUILD_CONTACT_H

#include "solver/builder.h"
#include "solver/sets.h"

/* Facets of both sides, each once, and nodes that belong to no facet (node sets). Deck-order node numbers. */
typedef struct ContactFacet {
    int32_t node[4]; /* a triangle repeats the third */
    int32_t shell;   /* -1: a bare segment */
    int side;        /* bits */
    double radius;   /* half its contact thickness [L] */
} ContactFacet;

typedef struct ContactSurfaces {
    LIST(ContactFacet) facets;
    unsigned char *node_side; /* bits of the nodes that meet triangles (node count of the deck) */
    double *node_radius;      /* (node count of the deck) [L] */
} ContactSurfaces;

void contact_surfaces_free(ContactSurfaces *surfaces);

#endif
