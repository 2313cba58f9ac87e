/* Contact entities in the time loop: part of contact/contact_loop.h, whose rows take the forces on the nodes. */
#ifndef BILLOW_ENTITY_LOOP_H
#define BILLOW_ENTITY_LOOP_H

#include "contact/contact_loop.h"

enum { ENTITY_CHUNK = 256 }; /* probes of one fixed partial sum */

/* A probe that touches in this cycle. */
typedef struct EntityHit {
    int32_t probe;
    double gap;       /* [L] */
    double normal[3]; /* direction of the force on it */
    double turn[3];   /* r x n, r from the body's centre to the probe [L] */
    double speed[3];  /* against the body there, at n - 1/2 [L/T] */
    double force[3];  /* on it [F] */
} EntityHit;

/* Sums over one chunk of probes. */
typedef struct EntitySums {
    int count;                  /* hits of the chunk */
    double mobility;            /* its share of beta (eq. I6) */
    double force[3], moment[3]; /* on the body, about its centre */
    double power;               /* on the velocities at n - 1/2 */
} EntitySums;

/* One entity in the loop. */
typedef struct EntityRun {
    const ContactEntity *entity;
    int chunk_count;
    EntityHit *hits;     /* those of chunk c from c ENTITY_CHUNK on (probe_count) */
    EntitySums *sums;    /* (chunk_count) */
    unsigned char *held; /* 1: the probe remembers a contact (probe_count) */
} EntityRun;

typedef struct EntityLoop {
    EntityRun *runs;   /* (entity_count) */
    double *resultant; /* on each entity at t_n: force, and moment about the body's centre or, of a fixed part,
                        * about the entity's origin (entity_count x 6) */
} EntityLoop;

/* NULL without memory. What probes remember is in the State. */
EntityLoop *entities_create(const Model *model, const State *state);
void entities_free(EntityLoop *entities, const Model *model);

/* The stages, called by those of contact. */
/* all: which probes touch at t_n */
void entities_look(ContactLoop *loop, double time, double before, double next, int thread, int threads);
void entities_push(ContactLoop *loop, int thread, int threads);      /* all: their forces */
void entities_gather(ContactLoop *loop, int32_t first, int32_t end); /* all: onto the nodes [first, end) */
void entities_sum(ContactLoop *loop);                                /* thread 0: power, resultants */

/* Adds what the entities of a body push it with, the moment about its centre. Thread 0, after entities_push. */
void entities_add_wrench(const ContactLoop *loop, int body, double force[3], double moment[3]);

#endif
