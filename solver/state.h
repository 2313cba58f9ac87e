/* The State: all that changes, in one buffer: copy, hash, checkpoint and restart are one memcpy.
 * Pointers point into the buffer; they are set anew by state_bind after a copy or a read. */
#ifndef BILLOW_STATE_H
#define BILLOW_STATE_H

#include <stddef.h>
#include <stdint.h>

#include "airbag/gas.h"
#include "solver/model.h"

/* Contact, as far as it goes on from cycle to cycle; the rest is in the arrays below. */
typedef struct ContactClock {
    double half;        /* contact energy up to the half step after t_n */
    double longer;      /* the step that contact reckons with, eq. C4b */
    int64_t started;    /* 1 once the next has begun */
    int64_t unseen;     /* cycles since contact_formed */
    int64_t fast, lost; /* pairs that met faster than a thickness in a step; that went too deep and were let go */
    int64_t fast_node, lost_node; /* user's ids of the first nodes, 0 none */
    double fast_time, lost_time;
    int64_t memory_count;
} ContactClock;

/* The energy ledger [energy], docs/theory.md section "Energy". */
typedef struct Energies {
    double kinetic, internal, hourglass, damping, contact;
    double external_work, airbag_work;
    double initial; /* kinetic + internal + hourglass at the start */
    double largest; /* largest energy given so far, scale of the balance */
    double ratio, ratio_min, ratio_max;
    double airbag_half, external_half; /* works up to the half step after t_n */
    double material_damping;           /* share of damping: DAMP of the laws with a stored energy */
    int64_t lost_cycles;               /* cycles in a row with the balance beyond its limit */
    int64_t feeding_cycles;            /* cycles in a row with an internal energy far below 0 */
    int64_t judged_from;               /* cycle from which the ratio is formed and judged */
    double mass_damping;               /* the rest */
} Energies;

typedef struct Clock {
    double time;       /* t_n */
    double step;       /* dt_{n+1/2}, the step last taken */
    double step_next;  /* dt_{n+1/2}, the step to be taken from t_n */
    double step_first; /* the first step, scale of a collapsing one */
    double compliance; /* sum of |s|^2/m over the nodes under pressure, of the last cycle */
    int64_t cycle;
    double next_states, next_glstat, next_abstat, next_nodout, next_rbdout, next_rcforc, next_rwforc, next_matsum,
        next_gceout, next_restart; /* times of the next outputs */
    int64_t states_written;
} Clock;

/* What holds of a group's reference geometry; written by step_reference_advance. */
typedef struct ReferenceState {
    int64_t born;   /* 1: it acts */
    double share;   /* of the initial stretch that is left out of the strain (TSRFAC), 1 at the start */
    double applied; /* the same in the steps in which the constants follow */
} ReferenceState;

typedef struct State {
    unsigned char *buffer; /* owns everything below */
    size_t size;           /* bytes */
    Clock *clock;
    Energies *energy;
    double *x;       /* current position (node_count x 3) [L], written by the node pass */
    double *v;       /* velocity at the half step (node_count x 3) [L/T], written by the node pass */
    double *history; /* element histories, layout per group (elements/membrane.h) */
    double *account; /* accounts of elements (padded count x ACCOUNT_SIZE, by blocks of lanes); Model.has_accounts */
    double *chunk_energy;         /* work of the chunk's stress so far, where accounts watch it (chunk count) */
    unsigned char *accounts_open; /* (chunk count): solver/step_accounts.c */
    GasState *gas;                /* (airbag_count), airbag/gas.h */
    double *part_energy;          /* internal energy of each part by the stress-work ledger (part_count) */
    double *part_hourglass;
    double *group_energy;      /* energy stored in each group at the last cycle (group_count) */
    double *cap_volume;        /* under the caps of each bag at the last cycle (airbag_count) [L3] */
    double *part_area;         /* current areas of the bags' parts (bag_part_count) [L2], written by step_bags */
    double *part_blocked;      /* of it, what contact covers (bag_part_count) [L2] */
    double *contact_share;     /* share of each element's nodes that are in contact, 0 to 1 (element_count if
                                  Model.blockage, else none); written by the contact stage, zero without contact */
    RigidState *rigid;         /* (rigid_body_count), solver/rigid_body.h */
    double *link_energy;       /* stored in each link at the last cycle (link_count), written by links_act */
    double *link_peak;         /* largest strain of each strap so far (link_count), written by links_act */
    WallState *wall;           /* (wall_count), contact/rigid_wall.h */
    unsigned char *wall_side;  /* WALL_SIDE_... of each node (wall_count x moving_count), written by step_walls */
    SensorState *sensor;       /* (sensor_count), airbag/sensor.h */
    JetState *jet;             /* (jet_count), airbag/jet.h */
    double *jet_shape;         /* (jet_facet_count): > 0 the jet's pressure is strength times it, 0 out of its reach,
                                  -1 hidden; as of the last look */
    JetWeight *jet_weight;     /* (jet_row_count), written with jet_shape */
    ReferenceState *reference; /* (group_count if Model.has_reference, else none) */
    unsigned char *reached;    /* 1: the element has been taut, its liner acts (padded_count if Model.liner_waits, else
                                  none); written by the element stage */
    double *seam_torn;         /* time at which each seam tore, -1: it holds (seam_count); written by seams_act */
    ContactClock *contact;     /* (1 if the model has contact) */
    double *contact_formed;    /* positions of which the room of nodes is, eq. C12 (node_count x 3) [L] */
    double *contact_load; /* loads of each node by its contacts, eq. C6, and by those at a limit (node_count x 2) */
    ContactMemory *contact_memory; /* pairs in contact, as of the last cycle written (Model.contact_memory_size) */
    ContactMemory *entity_memory;  /* of the probes of all entities (Model.entity_probe_count) */
    int32_t *contact_memories;     /* how many of each interface (contact_count) */
    double *tie_broken;            /* likewise of each tie (ties.count); written by step_ties_act */
    unsigned char *eroded; /* 1: the element is taken out (padded_count if Model.has_erosion, else none, likewise
                              the next two); written by step_erosion_chunk, step_erosion_close */
    int64_t *eroded_count; /* how many (1) */
    double *part_eroded;   /* area of the bags' parts that has eroded, as it was then (bag_part_count) [L2] */
} State;

/* Bytes that a State of this model needs. */
size_t state_size(const Model *model);

/* Allocates and initialises the state at time 0 (positions, velocities, gas); 0, or -1 without memory. */
int state_create(const Model *model, State *state);

/* Starts the state anew, at time 0 with these positions (node_count x 3) in place of the deck's; 0, or -1 without
 * memory (the state is then freed). */
int state_start_at(const Model *model, const double *x, State *state);

/* Gives the parts the energy stored at the start, by group (group_count), where a law keeps a ledger of work, and
 * closes the sums. */
void state_start_energies(const Model *model, const double *stored, State *state);

/* Sets the pointers into state->buffer (of state->size bytes) for this model. */
void state_bind(const Model *model, State *state);

/* 64-bit FNV-1a of the buffer: equal bits, equal hash. */
uint64_t state_hash(const State *state);

void state_free(State *state);

#endif
