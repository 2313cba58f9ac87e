/* Contact of fabrics: what the Model holds of it (built once, solver/build_contact*.c) and the stages of the loop.
 * Theory: docs/theory.md, Contact. */
#ifndef BILLOW_CONTACT_H
#define BILLOW_CONTACT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "solver/billow.h"
#include "solver/definitions.h"

enum { CONTACT_SIDE_A = 1, CONTACT_SIDE_B = 2 }; /* bits; a single surface is both */
enum {
    CONTACT_BOUNDARY = -1, /* no triangle beyond the edge */
    CONTACT_BRANCH = -2,   /* more than one */
};

/* One *CONTACT: nodes that meet triangles, edges that meet edges. A node of side A meets triangles of side B and the
 * other way round. Internal node numbers. */
typedef struct ContactInterface {
    int id; /* the user's, or counted from 1 in deck order */
    char title[BILLOW_TITLE_LENGTH];
    Source source;
    ContactKind kind;
    double static_friction, dynamic_friction, decay; /* FSF FS, FSF FD, DC [T/L] */
    double damping;                                  /* share of critical, VDC/100 */
    double stiffness[2]; /* share of the stability limit 4 m/dt^2 for nodes of side A and of side B */
    double birth, death; /* [T] */
    int thickness_curve; /* LCIDAB: index into Model.curves, thickness over time; -1 none */
    int ignore;          /* IGNORE, 2: initial penetrations are listed */

    int node_count;
    int32_t *node;            /* ascending (node_count) */
    unsigned char *node_side; /* bits (node_count) */
    int32_t *node_body;       /* rigid body, -1 deformable, -2 fixed (node_count) */
    double *node_radius;      /* half its contact thickness (node_count) [L] */

    int triangle_count;
    int32_t *triangle;        /* corners, wound alike where the surface allows (triangle_count x 3) */
    int32_t *neighbour;       /* triangle beyond the edge opposite to each corner, or CONTACT_BOUNDARY, _BRANCH (x 3) */
    int32_t *triangle_shell;  /* element, -1 for a bare segment (triangle_count) */
    int32_t *triangle_fourth; /* corner of its quadrilateral that it lacks, else -1 (triangle_count) */
    unsigned char *triangle_side; /* bits (triangle_count) */
    int32_t *triangle_body;       /* as node_body (triangle_count) */
    double *triangle_radius;      /* (triangle_count) [L] */
    int32_t *fan_start;           /* CSR: triangles at node n of the model are fan[fan_start[n] .. fan_start[n + 1]) */
    int32_t *fan;                 /* (triangle_count x 3) */
    unsigned char *corner_rim;    /* by triangle corner: it lies on the surface's rim (triangle_count x 3) */

    int edge_count;
    int32_t *edge;            /* two nodes each (edge_count x 2); none in one-way contacts */
    int32_t *edge_triangle;   /* the triangles at it; -1: a free edge (edge_count x 2) */
    int32_t *edge_start;      /* CSR: edges at node n of the model are edge_list[edge_start[n] .. edge_start[n + 1]) */
    int32_t *edge_list;       /* (edge_count x 2) */
    unsigned char *edge_side; /* bits (edge_count) */
    double *edge_radius;      /* (edge_count) [L] */

    double longest_side; /* mean longest side of the triangles at the start [L]; cells of the search */
    double thickest;     /* largest sum of radii of a pair [L] */
    size_t first_memory; /* its place in State.contact_memory */
    int memory_capacity; /* entries there */
} ContactInterface;

/* What a pair in contact remembers from cycle to cycle, in one line of the cache: what is only compared, or small
 * beside what it is added to, in single precision. */
typedef struct ContactMemory {
    double distance;  /* at which the pair begins to push: the thickness, less what it was short of at the start [L] */
    double stiffness; /* k [F/L] */
    float gap;        /* at the last cycle [L] */
    float limit;      /* force of eq. C13 at the last cycle [F] */
    float direction[3]; /* of the force on the first edge; unused for nodes */
    float friction[3];  /* tangential force on the node, or on the first edge [F] */
    int32_t side;       /* +1, -1: on which side of the oriented surface the node is; 0: not in contact */
    int32_t pair[2];    /* node and triangle, or edge and edge, of the interface; edges from node_count on */
    int32_t padding;
} ContactMemory;

_Static_assert(sizeof(ContactMemory) == 64, "a line of the cache");

#endif
