/* Contact in the time loop: candidate lists, forces, sums. Private to contact/ but for the stages at the end. */
#ifndef BILLOW_CONTACT_LOOP_H
#define BILLOW_CONTACT_LOOP_H

#include <math.h>

#include "contact/contact_grid.h"
#include "contact/contact_motion.h"
#include "elements/kernels.h"
#include "solver/model.h"
#include "solver/state.h"
#include "solver/team.h"

enum {
    CONTACT_ROW = 8,    /* doubles of a row of corner sums, elements/kernels.h: force, load, four zeros */
    CONTACT_SLOTS = 8,  /* pairs that a node or an edge can be in contact by */
    CONTACT_CHUNK = 64, /* nodes or edges of one fixed piece of work */
};

/* One pair that touches, or will in the coming step: what its four nodes get. */
typedef struct ContactForce {
    int32_t node[4];
    double weight[4]; /* the force on node i is weight[i] force; the weights' sum is 0 */
    double force[3];  /* [F] */
    double load;      /* share of the pair in its nodes' loads, eq. C6 */
} ContactForce;

/* An edge pair that has just lost its crossing while in contact: it has slid from one edge onto the next. */
typedef struct ContactPassage {
    int32_t first, second; /* edges */
    ContactMemory memory;
} ContactPassage;

enum { CONTACT_PASSAGES = 8 };

/* Passages of one chunk of edges; more than fit are left to themselves. */
typedef struct ContactPassages {
    int count;
    ContactPassage ended[CONTACT_PASSAGES];
} ContactPassages;

/* Sums over one chunk. */
typedef struct ContactSums {
    double force[3]; /* on side A [F] */
    double power;    /* of the contact forces on the velocities at n - 1/2 [F L/T] */
    int count;       /* entries of the chunk in forces */
    int lost;        /* pairs that went deeper than the limit and were let go */
    int fast;        /* pairs that met faster than one thickness in a step */
    int32_t fast_node, lost_node;
} ContactSums;

/* Candidate pairs: for each node its triangles, for each edge its edges, ascending. */
typedef struct ContactPairs {
    int32_t *start;      /* (owner_count + 1) */
    int32_t *other;      /* (count) */
    double *wake;        /* ways of both groups together from which on the pair may touch (count) [L] */
    unsigned char *slot; /* of the owner's memories, from 1; 0 none (count) */
    size_t count, start_capacity, other_capacity, wake_capacity, slot_capacity;
} ContactPairs;

/* Candidates of one kind and what becomes of them in a cycle. */
typedef struct ContactList {
    int owner_count, chunk_count;
    ContactMemory *memory;      /* of each owner (owner_count x CONTACT_SLOTS); free ones have side 0 */
    double *depth;              /* how deep each node was behind a surface at its last look (owner_count) [L] */
    ContactPairs pairs, before; /* before: those of the search before, whose room the next one takes */
    ContactForce *forces;       /* of chunk c from start[c CONTACT_CHUNK] on (count) */
    size_t force_capacity;
    ContactSums *sums;         /* (chunk_count) */
    double *idle;              /* ContactLoop.motion from which on a pair of the chunk may touch (chunk_count) [L] */
    ContactPassages *passages; /* of edges (chunk_count) */
} ContactList;

/* What the owner's pair remembers; NULL if nothing. */
static inline ContactMemory *contact_recall(const ContactList *list, int owner, int32_t pair)
{
    int slot = list->pairs.slot[pair];
    return slot ? &list->memory[(ptrdiff_t)owner * CONTACT_SLOTS + slot - 1] : NULL;
}

static inline void contact_forget(ContactList *list, int owner, int32_t pair)
{
    ContactMemory *m = contact_recall(list, owner, pair);
    if (m) *m = (ContactMemory){0};
    list->pairs.slot[pair] = 0;
}

/* Gives a pair a memory; one too many is let go. */
static inline void contact_keep(ContactList *list, int owner, int32_t pair, const ContactMemory *memory)
{
    ContactMemory *of_owner = list->memory + (ptrdiff_t)owner * CONTACT_SLOTS;
    for (int k = 0; k < CONTACT_SLOTS; k++) {
        if (of_owner[k].side) continue;
        of_owner[k] = *memory;
        if (-memory->gap > list->depth[owner]) list->depth[owner] = -memory->gap;
        list->pairs.slot[pair] = (unsigned char)(k + 1);
        return;
    }
}

/* Lets the owners [first, end) of a chunk without a pair that is awake rest until one of theirs may be; ways of the
 * groups of owners and others. */
static inline double contact_rest(const ContactList *list, int first, int end, double motion, const double *own_way,
                                  const double *other_way)
{
    const ContactPairs *pairs = &list->pairs;
    double least = INFINITY;
    for (int i = first; i < end; i++)
        for (int32_t p = pairs->start[i]; p < pairs->start[i + 1]; p++) {
            double left = pairs->wake[p] - own_way[i / CONTACT_GROUP] - other_way[pairs->other[p] / CONTACT_GROUP];
            least = left < least ? left : least;
        }
    return motion + least;
}

/* One interface in the loop. */
typedef struct ContactRun {
    const ContactInterface *contact;
    ContactList faces, edges;
    ContactGroups nodes, triangles, lines; /* motion of the owners of faces, of triangles, and of edges */
    double *plane;       /* unit normal and offset of each triangle in candidate lists, at x_n (triangle_count x 4) */
    unsigned char *used; /* triangles in candidate lists (triangle_count) */
    unsigned char *calm; /* workspace of the search: triangles with three neighbours nearly in their plane */
    bool alive, asleep;  /* asleep: it is not alive and has forgotten */
    double thinness;     /* factor on the radii, of LCIDAB */
    double *force;       /* on side A at t_n, in resultant [F] */
} ContactRun;

/* Coefficients of a cycle. */
typedef struct ContactStep {
    double time, before, next; /* t_n, dt_{n-1/2}, dt_{n+1/2} */
    double longer;             /* the longer of the two steps */
} ContactStep;

/* What one thread finds: candidates of its share of the owners, and its workspace. */
typedef struct ContactPart {
    int32_t *other;
    double *height; /* of a node over the triangles found */
    size_t count, other_capacity, height_capacity;
    ContactFound found;
    bool failed; /* no memory */
} ContactPart;

typedef struct ContactLoop {
    const Model *model;
    State *state;
    ContactRun *runs;              /* (contact_count) */
    double *resultant;             /* force on side A of each at t_n (contact_count x 3) [F] */
    const double *rows, *pressure; /* of all corner sums; of the pressure sets */
    double *corner;         /* rows with contact forces x, y, z and load of each node (node_count x CONTACT_ROW) */
    ContactMotion *motions; /* (motion_count) */
    int motion_count;
    unsigned char *written; /* chunks of nodes whose rows of corner are not zero */
    double fastest;         /* largest speed now */
    double motion; /* twice the sum of the largest speed times the step: no two nodes came nearer by more [L] */
    double power, power_after;
    bool search_due, pending;
    ContactStep step;
    ContactGrid grid;
    ContactBox *box;    /* workspace of the search */
    ContactPart *parts; /* by thread (BILLOW_MAX_THREADS) */
    size_t box_capacity;
    double *room; /* at the last search: (w dt)^2 that contact may add at a node in direction d is 1/(d . room d); xx yy
                   * zz xy yz zx (node_count x 6) */
    double *around; /* workspace: mass of the elements at each node (node_count) */
    bool restored;  /* the first search of a restart: at the place and with the edges of the last one */
    int64_t searches;
    double search_seconds;
    bool out_of_memory;
} ContactLoop;

/* Makes the loop's part of contact; rows: all rows of corner sums; pressure: of the bags on each pressure set. NULL
 * without memory. Takes memory and loads from the State, so that a restart goes on as if it had not been interrupted.
 */
ContactLoop *contact_create(const Model *model, State *state, double *rows, const double *pressure);
void contact_free(ContactLoop *loop);

/* The stages. */
void contact_planes(ContactLoop *loop, int thread, int threads); /* all, at x_n: planes of the triangles */
/* all: search where it is due; team: whose threads these are */
void contact_prepare(ContactLoop *loop, double time, double before, double next, int thread, Team *team);
void contact_forces(ContactLoop *loop, int thread, int threads);                 /* all: narrow phase and forces */
void contact_gather(ContactLoop *loop, int thread, int threads);                 /* all: forces to nodes */
void contact_follow(ContactLoop *loop, int thread, int threads, double pending); /* all, after the node pass; pending:
                                                                                  * step still to be added to x */
void contact_sum(ContactLoop *loop);   /* thread 0: partial sums of the two before */
void contact_store(ContactLoop *loop); /* thread 0: memory and loads into the State */

/* Inside. */
/* All threads: new candidate lists at State.contact_searched. */
void contact_search(ContactLoop *loop, int thread, Team *team);

/* The groups of one contact have moved for a time at the speeds of loop->motions. */
void contact_move_groups(const ContactLoop *loop, ContactRun *run, double time);

/* Planes of triangles [first, end) at positions x; all: of unused ones too. */
void contact_fill_planes(ContactRun *run, const double *x, int first, int end, bool all);

/* Fills room; elements, rest: (w dt)^2 that elements may have, and that they leave in their plane. */
void contact_fill_room(ContactLoop *loop, const double *x, double elements, double rest);

struct ContactLaw;
void contact_meet_faces(ContactLoop *loop, ContactRun *run, const struct ContactLaw *law, int chunk);
void contact_meet_edges(ContactLoop *loop, ContactRun *run, const struct ContactLaw *law, int chunk);

/* Edge pairs that have ended leave their memory to the pair beside them that the crossing has slid onto. Thread 0. */
void contact_pass_on(ContactLoop *loop, ContactRun *run);

/* New candidate lists of all contacts at State.contact_searched, by all threads of the team; team NULL: by this thread
 * alone. Memories of pairs stay with them. Without memory out_of_memory is set and the lists are empty. */
void contact_find_pairs(ContactLoop *loop, int thread, Team *team);

#endif
