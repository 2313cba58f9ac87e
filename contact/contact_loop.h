/* Contact in the time loop: candidate lists, forces, sums. Private to contact/ but for the stages at the end. */
#ifndef BILLOW_CONTACT_LOOP_H
#define BILLOW_CONTACT_LOOP_H

#include <math.h>
#include <stdatomic.h>

#include "contact/contact_candidates.h"
#include "contact/contact_grid.h"
#include "contact/contact_motion.h"
#include "contact/meet_kernels.h"
#include "contact/motion_kernels.h"
#include "contact/near_kernels.h"
#include "contact/push_kernels.h"
#include "contact/sharp_kernels.h"
#include "elements/kernels.h"
#include "solver/model.h"
#include "solver/state.h"
#include "solver/team.h"

enum {
    CONTACT_ROW = 8,    /* doubles of a row of corner sums, elements/kernels.h: force, five zeros */
    CONTACT_SLOTS = 16, /* pairs that a node or an edge can be in contact by */
};

/* The C library's fmax is a call. */
static inline double larger(double a, double b)
{
    return b > a ? b : a;
}

/* One pair that touches, or will in the coming step: what its four nodes get. */
typedef struct ContactForce {
    int32_t node[4];
    double weight[4]; /* the force on node i is weight[i] force; the weights' sum is 0 */
    double force[3];  /* [F] */
    double load;      /* share of the pair in its nodes' loads, eq. C6 */
    double firm;      /* the same if the limit of eq. C13 acts, else 0 */
    bool blocks;      /* its nodes count as covered: no edge of it is flat */
} ContactForce;

/* An edge pair that has just lost its crossing while in contact: it has slid from one edge onto the next. */
typedef struct ContactPassage {
    int32_t first, second; /* edges */
    ContactMemory memory;
} ContactPassage;

enum { CONTACT_PASSAGES = 8 };

/* Passages of one group of edges; more than fit are left to themselves. */
typedef struct ContactPassages {
    int count;
    ContactPassage ended[CONTACT_PASSAGES];
} ContactPassages;

/* Where the forces of one group of owners are: sums count of a thread's, from first on. */
typedef struct ContactPiece {
    int32_t thread;
    int32_t first;
} ContactPiece;

/* Sums over one group of owners. */
typedef struct ContactSums {
    double force[3]; /* on side A [F] */
    double power;    /* of the contact forces on the velocities at n - 1/2 [F L/T] */
    int count;       /* forces of the group */
    int lost;        /* pairs that went deeper than the limit and were let go */
    int fast;        /* pairs that met faster than one thickness in a step */
    int32_t fast_node, lost_node;
} ContactSums;

/* Pairs of groups that may meet: owners of one, others of the second. */
typedef struct ContactGroupPairs {
    int32_t *other;
    float *slack;      /* by so much they may yet come nearer before two of their items touch [L] */
    ContactKept *kept; /* what each has kept of its last look */
    size_t other_capacity, slack_capacity, kept_capacity;
} ContactGroupPairs;

/* Pairs of one kind and what becomes of them in a cycle. */
typedef struct ContactList {
    int owner_count, group_count;
    ContactMemory *memory;   /* contact_slot (CONTACT_SLOTS x owner_count) */
    unsigned char *held;     /* the first so many are an owner's; lost ones among them have side 0 (owner_count) */
    unsigned char *holds;    /* of each group: its owners may have memories (group_count) */
    int32_t *partner;        /* other item of each memory (owner_count x CONTACT_SLOTS) */
    double *depth;           /* how deep each node was behind a surface at its last look (owner_count) [L] */
    double *deepest;         /* of each group (group_count) [L] */
    double *allowed;         /* how deep each group may be until the next search (group_count) [L] */
    int32_t *start;          /* of each group in pairs (group_count + 1) */
    ContactGroupPairs pairs; /* in an order that depends on the boxes alone (start[group_count]) */
    ContactCandidates *candidates; /* of each group (group_count) */
    int32_t *next_start;           /* workspace of the search: the new list */
    ContactGroupPairs next;
    ContactPiece *pieces;      /* (group_count) */
    ContactSums *sums;         /* (group_count) */
    ContactPassages *passages; /* of edges (group_count) */
} ContactList;

/* Memory k of an owner. Those of number k of all owners lie together: most owners have one or two. */
static inline ContactMemory *contact_slot(const ContactList *list, int owner, int k)
{
    return list->memory + (ptrdiff_t)k * list->owner_count + owner;
}

/* What the owner's pair remembers; NULL if nothing. */
static inline ContactMemory *contact_recall(const ContactList *list, int owner, int32_t other)
{
    const int32_t *partner = list->partner + (ptrdiff_t)owner * CONTACT_SLOTS;
    for (int k = 0; k < list->held[owner]; k++)
        if (partner[k] == other && contact_slot(list, owner, k)->side) return contact_slot(list, owner, k);
    return NULL;
}

/* The same before the owner's look, when all that is held has a side; the memory is asked for instead of looked at. */
static inline ContactMemory *contact_ask(const ContactList *list, int owner, int32_t other)
{
    const int32_t *partner = list->partner + (ptrdiff_t)owner * CONTACT_SLOTS;
    for (int k = 0; k < list->held[owner]; k++) {
        if (partner[k] != other) continue;
        ContactMemory *m = contact_slot(list, owner, k);
        __builtin_prefetch(m);
        return m;
    }
    return NULL;
}

/* Memories of a group's owners are asked for before they are needed: they lie far apart. GCC takes a function that only
 * asks for memory as one that does nothing, unless it is dissolved first. */
__attribute__((always_inline)) static inline void contact_fetch(const ContactList *list, const ContactLanes *lanes)
{
    for (int i = 0; i < CONTACT_GROUP && lanes->item[i] >= 0; i++)
        for (int k = 0; k < list->held[lanes->item[i]]; k++) {
            __builtin_prefetch(list->partner + (ptrdiff_t)lanes->item[i] * CONTACT_SLOTS);
            __builtin_prefetch(contact_slot(list, lanes->item[i], k));
        }
}

/* Gives a pair a memory; one too many is let go. */
static inline void contact_keep(ContactList *list, int owner, int32_t other, const ContactMemory *memory)
{
    for (int k = 0; k < CONTACT_SLOTS; k++) {
        ContactMemory *m = contact_slot(list, owner, k);
        if (k < list->held[owner] && m->side) continue;
        *m = *memory;
        m->pair[1] = other;
        list->partner[(ptrdiff_t)owner * CONTACT_SLOTS + k] = other;
        if (k >= list->held[owner]) list->held[owner] = (unsigned char)(k + 1);
        if (-memory->gap > list->depth[owner]) list->depth[owner] = -memory->gap;
        return;
    }
}

/* Closes the gaps that an owner's lost memories have left. */
static inline void contact_count_held(ContactList *list, int owner)
{
    int count = 0;
    for (int k = 0; k < list->held[owner]; k++) {
        ContactMemory *m = contact_slot(list, owner, k);
        if (!m->side) continue;
        if (count < k) *contact_slot(list, owner, count) = *m, *m = (ContactMemory){0};
        list->partner[(ptrdiff_t)owner * CONTACT_SLOTS + count] = contact_slot(list, owner, count)->pair[1];
        count++;
    }
    list->held[owner] = (unsigned char)count;
}

/* Penetration at which a pair is given up. */
static inline double contact_deepest(const ContactInterface *c)
{
    return 10.0 * c->thickest > 0.5 * c->longest_side ? 10.0 * c->thickest : 0.5 * c->longest_side;
}

/* One triangle, in half a line of the cache (contact/contact_records.c). */
typedef struct ContactTriangle {
    int32_t corner[3];
    int32_t neighbour[3]; /* as ContactInterface.neighbour */
    int32_t radius;       /* its place in ContactRun.radius */
    unsigned char rims;   /* bits: corners on the surface's rim */
    bool moves;           /* one of them */
} ContactTriangle;

/* One edge. */
typedef struct ContactEdge {
    int32_t node[2];
    int32_t radius; /* as above */
    bool moves;
} ContactEdge;

/* One interface in the loop. */
typedef struct ContactRun {
    const ContactInterface *contact; /* the model's, or living */
    ContactInterface living;         /* what erosion has left of it, if erodes (contact/contact_erosion.c) */
    bool erodes;
    ContactList faces, edges;
    ContactGroups nodes, triangles, lines; /* owners of faces, triangles, and edges */
    int32_t *line_body, *line_shell;       /* of the first triangle at each edge (edge_count) */
    int32_t *line_wing;                    /* far corners of the triangles at each edge (edge_count x 2) */
    int32_t
        *line_place; /* group x CONTACT_GROUP + lane of each edge; that of the lower group owns a pair (edge_count) */
    ContactTriangle *triangle; /* (triangle_count) */
    ContactEdge *edge;         /* (edge_count) */
    int32_t *ring;  /* in each triangle of the interface's fan the two corners after the node (triangle_count x 6) */
    double *radius; /* of triangles and edges [L] */
    _Atomic uint64_t *sharp; /* ContactSharp of each group of edges as last asked for, with its cycle (groups) */
    bool alive, asleep;      /* asleep: it is not alive and has forgotten */
    double thinness;         /* factor on the radii, of LCIDAB */
    double *force;           /* on side A at t_n, in resultant [F] */
} ContactRun;

/* Coefficients of a cycle. */
typedef struct ContactStep {
    double time, before, next; /* t_n, dt_{n-1/2}, dt_{n+1/2} */
    double longer;             /* what contact reckons with, eq. C4b: not less than any of the two */
} ContactStep;

/* Groups that a thread takes at a time: neighbouring ones are busy alike, and what a thread asks for they share. */
enum { CONTACT_TURN = 4 };

/* Pairs of a group in one cycle, a block of CONTACT_GROUP of them. */
typedef struct ContactWoken {
    _Alignas(64) float speed[CONTACT_GROUP]; /* how fast each may close [L/T] */
    unsigned awake;                          /* bits of those that may touch in this step */
} ContactWoken;

/* A pair of a group that is awake, and the gap within which its candidates may touch [L]. */
typedef struct ContactAwake {
    int pair;
    float gap;
} ContactAwake;

/* What one thread finds and does: group pairs of its share in a search, forces of its groups in a cycle. */
typedef struct ContactPart {
    ContactGroupPairs pairs;
    size_t pair_count;
    int32_t *place; /* workspace: of each group in the old list + 1, else 0 */
    size_t place_capacity;
    ContactFound found;
    ContactForce *force;
    size_t force_count, force_capacity;
    ContactSorting sorting;
    ContactWoken *woken[CONTACT_TURN]; /* of the groups of one turn */
    size_t woken_capacity[CONTACT_TURN];
    ContactAwake *near; /* of one group of owners: pairs that are awake */
    float *limit;       /* of its slots: gaps within which candidates may touch [L] */
    size_t near_capacity, limit_capacity;
    int32_t *other; /* what each owner of a group may touch in this step and what it remembers */
    size_t other_capacity;
    ContactLook look;
    MeetFaces *faces; /* pairs of one group of owners in lanes */
    MeetEdges *edges;
    PushPairs *push; /* its pairs that are near (push_count) */
    int push_count;
    size_t faces_capacity, edges_capacity, push_capacity;
    ContactPull *pull;   /* what its pairs have asked for (node_count) */
    int64_t *pull_cycle; /* in which each block of them was formed */
    bool deep;           /* a group is deeper than allowed: a search is due */
    bool failed;         /* no memory */
} ContactPart;

/* Nodes at the last search, and how far each chunk of them may go until the next (contact/contact_skin.h). */
typedef struct ContactSkin {
    double *from;       /* positions (node_count x 3) [L] */
    double *of;         /* of each chunk of nodes: from where the mean velocity takes it (chunks of node_count) [L] */
    double velocity[3]; /* mean of the nodes that move [L/T] */
    double since;       /* time of the positions from then on [T] */
} ContactSkin;

typedef struct ContactLoop {
    const Model *model;
    State *state;
    ContactRun *runs;              /* (contact_count) */
    double *resultant;             /* force on side A of each at t_n (contact_count x 3) [F] */
    const double *rows, *pressure; /* of all corner sums; of the pressure sets */
    double *corner;                /* rows with contact forces x, y, z of each node (node_count x CONTACT_ROW) */
    ContactMotion *motions;        /* (motion_count) */
    int motion_count;
    unsigned char *written; /* chunks of nodes whose rows of corner are not zero */
    double fastest;         /* no node is faster now */
    ContactSkin skin;
    double power, power_after;
    bool search_due, pending;
    int64_t eroded_seen; /* shells that had eroded when the surfaces were last made; only if Model.has_erosion */
    unsigned char *mark; /* workspace of contact_erode (node_count); NULL without erosion */
    int64_t cycle;       /* counts contact_prepare */
    ContactStep step;
    ContactGrid grid;
    ContactBox *box;    /* workspace of the search */
    ContactPart *parts; /* by thread (BILLOW_MAX_THREADS) */
    const NearKernels *kernels;
    const MotionKernels *motion_kernels;
    const SharpKernels *sharp_kernels;
    const MeetKernels *meet_kernels;
    const PushKernels *push_kernels;
    size_t box_capacity;
    ContactNode *node;           /* what a pair needs to know of each node (node_count) */
    unsigned char *covered;      /* nodes in contact, for leakage (node_count) */
    double *around;              /* workspace: mass of the elements at each node (node_count) */
    unsigned char *pulled;       /* of the special nodes: contact_list_pulled (moving - free count) */
    struct EntityLoop *entities; /* contact/entity_loop.h; NULL without */
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
/* all: search where it is due; team: whose threads these are */
void contact_prepare(ContactLoop *loop, double time, double before, double next, int thread, Team *team);
void contact_forces(ContactLoop *loop, int thread, int threads);                 /* all: narrow phase and forces */
void contact_gather(ContactLoop *loop, int thread, int threads);                 /* all: forces to nodes */
void contact_follow(ContactLoop *loop, int thread, int threads, double pending); /* all, after the node pass; pending:
                                                                                  * step still to be added to x */
void contact_sum(ContactLoop *loop);   /* thread 0: partial sums of the two before */
void contact_store(ContactLoop *loop); /* thread 0: memory and loads into the State */

/* Inside. */
/* What elements and gas leave of the limit 4 of (w dt)^2 in the elements' plane (eq. C12). */
double contact_room_left(const Model *m);

/* All threads: new pairs of groups. */
void contact_search(ContactLoop *loop, int thread, Team *team);

/* Lanes of a group of edges that are sharp, and those that are nearly so. */
typedef struct ContactSharp {
    uint16_t now, nearly;
} ContactSharp;

/* Those of this cycle, found when first asked for. Any thread, but while positions change. */
ContactSharp contact_sharp(const ContactLoop *loop, const ContactRun *run, int group);
bool contact_is_sharp(const ContactLoop *loop, const ContactRun *run, int edge);

/* Room for what the run keeps of triangles and edges; 0, or -1 without memory. */
int contact_records_create(ContactRun *run);
/* Takes it from the interface. */
void contact_records_fill(ContactRun *run, const Model *model);
void contact_records_free(ContactRun *run);

/* The room follows the surface's shape some cycles late. All threads of the team. */
void contact_renew_room(ContactLoop *loop, int thread, Team *team);

/* Forms a node's acceleration by elements and gas, as far as its supports leave it (contact/contact_pull.c). */
void contact_form_pull(const ContactLoop *loop, int32_t node, double a[3]);

/* Fills the room of a thread's share of the nodes at State.contact_formed. */
void contact_fill_room(ContactLoop *loop, int thread, int threads);

/* Nodes, triangles and edges of the run's surface as items of groups. */
void contact_items(ContactRun *run, ContactItems items[3]);

/* 1 for nodes with supports that follow no body, edge or partner (moving - free count); NULL without memory. */
unsigned char *contact_list_pulled(const Model *model);

struct ContactLaw;
void contact_meet_faces(ContactLoop *loop, ContactRun *run, const struct ContactLaw *law, int group, int thread,
                        int turn);
void contact_meet_edges(ContactLoop *loop, ContactRun *run, const struct ContactLaw *law, int group, int thread,
                        int turn);

/* Which pairs of a group of owners are awake in this cycle. Groups of one turn first, each with a number of its own:
 * what is known of those awake is on its way then. */
void contact_wake(ContactLoop *loop, ContactRun *run, bool edges, int group, int thread, int turn);

/* What a group of owners may touch in this step, and what it remembers, ascending (contact/contact_near.c): those of
 * lane k of the group are other[start[k]] to other[start[k + 1]] of the thread's part, which has failed without memory.
 */
void contact_find_near(ContactLoop *loop, ContactRun *run, bool edges, int group, int thread, int turn,
                       int start[CONTACT_GROUP + 1]);

/* Room for more forces of a thread; NULL without memory. */
ContactForce *contact_force_room(ContactPart *part, size_t more);

/* All pairs of groups are awake: how far they have gone is not known. */
void contact_awake(ContactList *list);

/* Edge pairs that have ended leave their memory to the pair beside them that the crossing has slid onto. Thread 0. */
void contact_pass_on(ContactLoop *loop, ContactRun *run);

/* New pairs of groups of all contacts at the skin's positions, by all threads of the team. Without memory out_of_memory
 * is set and the lists are empty. */
void contact_find_pairs(ContactLoop *loop, int thread, Team *team);

#endif
