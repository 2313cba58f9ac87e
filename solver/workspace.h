/* What the step needs beside Model and State: buffers, partial sums, the plan of the cycle. Private to solver/step*.c.
 */
#ifndef BILLOW_WORKSPACE_H
#define BILLOW_WORKSPACE_H

#include <stdbool.h>

#include "airbag/hole_cover.h"
#include "airbag/ray_tree.h"
#include "contact/contact_loop.h"
#include "elements/kernels.h"
#include "solver/model.h"
#include "solver/reference_work.h"
#include "solver/state.h"
#include "solver/step.h"
#include "solver/team.h"

enum {
    BILLOW_NODE_CHUNK = 256,      /* nodes in one fixed partial sum */
    BILLOW_FEEDING_LIMITS = 10,   /* energy limits: shells that gave more than that feed the motion (eq. L8) */
    BILLOW_LOST_CYCLES = 3,       /* in a row beyond the limit: the balance is lost */
    BILLOW_SETTLING_CYCLES = 100, /* after the gas was last stiffer than the step: likewise */
    BILLOW_SETTLING_LIMIT = 2000, /* but from this cycle on the balance is always judged */
    BILLOW_UNJUDGED_CYCLES = 20,  /* at the start, in which the energy ratio is 1 by definition */
};

/* The gas alone may have (w dt)^2 up to this before it is taken implicitly; the stable limit is 4, shared with the
 * elements. */
#define BILLOW_EXPLICIT_GAS 0.2

/* Sums over one chunk of nodes; works in force x velocity, to be multiplied by half a step (eq. L3). */
typedef struct NodeSums {
    double kinetic;                 /* m v.v / 2 at t_n */
    double kinetic_steps;           /* m v-.v+ / 2, which the balance of a central difference keeps exactly (eq. L5) */
    double bag_before, bag_after;   /* airbag pressure on v at n - 1/2 and at n + 1/2 */
    double load_before, load_after; /* segment loads, point loads and gravity likewise */
    double damping;                 /* energy taken out by mass damping in this step */
    double support_before, support_after; /* impulse of supports and prescribed motion on v at n - 1/2 and n + 1/2 */
    double stopped;                       /* m |v+ - v*|^2 / 2 of what walls do in this cycle: a scale, no term */
    double reaction;                      /* work of point loads and on rigid bodies in this step */
    double compliance;                    /* sum of |s|^2 / m, s the area vector of the node */
} NodeSums;

/* One bag's share of a chunk of nodes, for the implicit gas: s the area vector of a node in this bag's pressure. */
typedef struct GasPass {
    double compliance; /* sum of s.s / m */
    double opening;    /* sum of s.a, a the acceleration at the explicit pressure: d2V/dt2 */
} GasPass;

/* Sums over one chunk of a jet's facets. */
typedef struct JetSums {
    double force[3];      /* of the jet on the surface */
    double before, after; /* power on v at n - 1/2 and n + 1/2 */
} JetSums;

/* The rows of corner sums of one chunk of a jet's facets, and what acts on them. */
typedef struct JetRows {
    const JetWeight *weight; /* (count) */
    const int32_t *node;     /* (count) */
    int count;
    double *row;            /* the first of them (count x ROW_SIZE) */
    const double *v;        /* velocities of all nodes */
    double strength, knock; /* pressures on the rows' area vectors: of the jet over its shape, on hidden facets */
} JetRows;

/* Loops over them, one table per instruction set (solver/jet_kernels.c). */
typedef struct JetKernels {
    void (*push)(const JetRows *rows, JetSums *sums); /* forces onto the rows; fills force and before */
    double (*count)(const JetRows *rows);             /* power of the same forces */
} JetKernels;
extern const JetKernels jet_kernels_v2, jet_kernels_v3, jet_kernels_v4;

/* What the step keeps of one jet; nothing of it outlives a cycle but the tree's layout, which changes no result. */
typedef struct JetWork {
    RayTree tree;
    JetFrame frame;
    int8_t *side; /* as the jet's, 0: eroded, at the last look (facet_count); NULL where nothing erodes */
    bool view;    /* the line of sight is looked at in this cycle */
    int first_chunk;
} JetWork;

/* What is taken out of one chunk of elements in a cycle. */
typedef struct ErosionSums {
    double stored, hourglass; /* energy */
    double work;              /* of what was taken out in the cycle before, in the step after */
    int count;
} ErosionSums;

/* Everything that one cycle decides once for all threads. */
typedef struct CyclePlan {
    double time, dt_before, dt_mean, dt_next;
    bool emit, last, stop;
    double node_advance; /* step by which the node loops move positions: 0 when emitting, and when walls come after */
    bool implicit_gas; /* the gas is stiffer than the step resolves: its pressure is taken at the step's mean volume */
} CyclePlan;

/* A wall in the present cycle. */
typedef struct WallPlan {
    bool acts, fresh;   /* fresh: its first cycle, sides of nodes are not known yet */
    double origin[3];   /* at t_{n+1}; of a wall with mass as if nothing pushed it */
    double before[3];   /* origin at t_n */
    double velocity[3]; /* of the wall over the step */
} WallPlan;

/* Impulse of one wall on one chunk of nodes in this cycle. */
typedef struct WallSums {
    double impulse[3]; /* [force x time] */
    double normal;     /* sum of the normal parts */
} WallSums;

/* What a change of the reference brings to the energies of a chunk at t_n (eq. R10, R10a). */
typedef struct ReferenceJump {
    double energy;  /* stored in the elements */
    double outside; /* of the hourglass control, and half the work of the stress that the change takes away */
    double pull;    /* half the work that the new stress would have done in the last step */
} ReferenceJump;

typedef struct Workspace {
    const Model *model;
    State *state;
    const RunHooks *hooks;
    const KernelTable *kernels;
    StageTimes *times;
    Failure *failure;
    double *rows;                         /* corner sums (row_count x ROW_SIZE) */
    ChunkSums *chunks;                    /* (chunk_count) */
    NodeSums *node_sums;                  /* one for each chunk of free nodes, the last for the special ones */
    int node_chunk_count;                 /* chunks of free nodes */
    double *bag_pressure, *load_pressure; /* of each pressure set */
    double *set_volume, *set_area;
    double *group_area;                                     /* of each group, of this cycle [L2] */
    double *part_area, *part_blocked;                       /* of each part, and what contact covers of it [L2] */
    double *source_pressure;                                /* airbags, then segment loads */
    double *class_gravity, *class_damping, *class_velocity; /* (class_count x 3) */
    double *stagnation;                                     /* SPSF x ambient density by pressure set */
    double *fluid_volume;                                   /* of FLUID_AND_GAS at t_n (airbag_count) */
    double *bag_volume, *bag_area;                          /* (airbag_count) */
    double *force;  /* special nodes: pressure and stress forces (node_count x 3); all nodes when emitting */
    double *newton; /* velocities of the special nodes before supports act (moving - free count, x 3) */
    double *drag;   /* mass damping force of the special nodes (moving - free count, x 3) */
    unsigned char *special_kind; /* of the special nodes: 1 hanging, 2 rigid, 0 others (moving - free count) */
    double *before; /* velocities of the special nodes at n - 1/2 (node_count x 3); shares acceleration's memory unless
                     * walls with mass keep those of free nodes too */
    double *acceleration, *velocity; /* full-step view, (node_count x 3); NULL until the first emit */
    double *part_kinetic, *part_momentum;
    HoleCover *covers;                  /* over the holes of each bag (airbag_count); NULL without erosion */
    ErosionSums *erosion_sums;          /* (chunk_count), likewise */
    double *tie_strain, *tie_volume;    /* of the elements that ties watch, of this cycle (ties.slot_count) */
    double *segment_middle;             /* cost of the segments before, and half its own; -1: idle (segment_count) */
    double segment_cost;                /* of all */
    double *lane_rate;                  /* squared frequency of each lane of the critical chunk */
    double *kept_history;               /* of one chunk */
    int critical_chunk, critical_group; /* with the largest frequency of this cycle */
    double *implicit;            /* of the nodes of implicit elements: accelerations and forces (their count x 7) */
    double *implicit_before;     /* their velocities at n - 1/2 (node_count x 3) */
    GasPass *gas_pass;           /* partial sums of the implicit gas (node chunks + 1) x (airbag_count) */
    WallPlan *walls;             /* (wall_count) */
    WallSums *wall_sums;         /* (node chunks + 1) x (wall_count) */
    unsigned char *wall_pending; /* 1: a wall with mass decides on this node (moving_count) */
    double *wall_force;          /* force of each wall on the nodes and its normal part (wall_count x 4) */
    double *wall_body_force;     /* of walls on rigid bodies' nodes, by special node (moving - free count, x 3) */
    double *wall_body_sum;       /* the sum of each wall and of its normal parts (wall_count x 4) */
    bool general;                /* body classes or stagnation pressure: the general node loop */
    bool closed;                 /* energies of the last cycle are in the ledger */
    double element_step;         /* stable step of the elements before TSSFAC */
    ContactLoop *contact;        /* NULL if the scene has none */
    CyclePlan plan;
    JetWork *jets;     /* (jet_count), NULL without jets */
    JetSums *jet_sums; /* (jet_chunk_count) */
    const JetKernels *jet_kernels;
    int jet_chunk_count;
    double *jet_area;              /* area of the facets of each row while looking (jet_row_count) */
    ReferenceWork reference;       /* groups with the constants that hold now */
    ReferenceJump *reference_jump; /* (chunk_count) written by step_reference_chunk */
    double reference_pull;         /* sum of their pull [energy] */
    bool reference_changed;        /* some reference does in this cycle */
    const Curve *curves;           /* the model's, or live_curves if the model has functions */
    Curve *live_curves;            /* the model's with the functions' values */
    double *function_value;        /* (airbag_count x function_count) */
} Workspace;

/* Loops over nodes [first, end) of the lean range, one table per instruction set. */
typedef void NodeLoop(Workspace *w, int first, int end, NodeSums *sums);
typedef struct NodeKernels {
    NodeLoop *lean;    /* pressure and stress only */
    NodeLoop *general; /* with body classes and stagnation pressure */
} NodeKernels;
extern const NodeKernels node_kernels_v2, node_kernels_v3, node_kernels_v4;

/* Shares of the element pass. The place of a segment in Model.segment_order; -1: no thread, nothing needs its elements.
 */
int step_share_allocate(Workspace *w);
int step_segment_owner(const Workspace *w, int place, int threads);
int step_group_of_chunk(const Model *model, int chunk);

/* Phases of the cycle. */
int step_bags(Workspace *w);                                           /* thread 0: gas of all bags to t_n; -1 failed */
double step_fluid_volume(const Workspace *w, int bag, double level);   /* of FLUID_AND_GAS below a level, times VSCA */
void step_fluid_begin(Workspace *w, int bag);                          /* the volume of the level that it begins with */
void step_fluid_settle(Workspace *w, int bag);                         /* the level of its volume */
double step_hydrostatic(const Workspace *w, int set, const double *x); /* its pressure at a place, on a pressure set */
double step_bags_scale(Workspace *w);                                  /* a step that resolves the gas by itself */
void step_elements(Workspace *w, int thread, int threads);             /* all threads */
void step_gas(Workspace *w);                                           /* thread 0: sums, gas, pressures, next step */
void step_gas_pass(Workspace *w, int thread, int threads);             /* all threads: sums of the implicit gas */
void step_gas_implicit(Workspace *w);                                  /* thread 0: pressures at the mean volume */
void step_implicit_energy(const Workspace *w, NodeSums *sums); /* thread 0: of what their nodes have in excess */
/* What elements, contact and explicit pressure do to a node. */
void step_node_force(const Workspace *w, int node, double f[3]);
void step_implicit(Workspace *w);                                   /* thread 0: nodes of implicit elements */
void step_nodes(Workspace *w, int thread, int threads);             /* all threads: free nodes */
void step_special(Workspace *w);                                    /* thread 0: special nodes */
void step_walls_begin(Workspace *w);                                /* thread 0: where the walls are */
void step_walls_special(Workspace *w, NodeSums *sums);              /* thread 0: special nodes; walls with mass */
void step_wall_bodies_push(Workspace *w);                           /* thread 0: forces of walls on rigid bodies */
void step_wall_bodies_count(Workspace *w, NodeSums *sums);          /* thread 0: their work and impulse */
void step_walls_block(Workspace *w, int thread, int threads);       /* all: covers of elements, walls included */
void step_walls_forces(Workspace *w);                               /* thread 0: sums for the writers */
void step_tick(Workspace *w);                                       /* thread 0: the clock moves on */
void step_emit(Workspace *w);                                       /* thread 0: full-step view to the hooks */
void step_advance_positions(Workspace *w, int thread, int threads); /* all threads, after an emitting cycle */
void step_close_energies(Workspace *w);                             /* thread 0: ledger at t_n */
/* All threads: free nodes [first, end) of one chunk, after their node loop; before: their velocities at n - 1/2. */
void step_walls_chunk(Workspace *w, int chunk, int first, int end, const double *before, NodeSums *sums);
int step_functions_allocate(Workspace *w); /* -1 without memory */
void step_functions_release(Workspace *w);
int step_functions_evaluate(Workspace *w, int airbag); /* thread 0: values for this bag and cycle, then selected */
void step_functions_select(Workspace *w, int airbag);  /* w->curves give this bag's values */
void step_sensors(Workspace *w);                       /* thread 0: if the model has any */
int step_jets_allocate(Workspace *w);                  /* -1 without memory */
void step_jets_release(Workspace *w);
void step_jets_prepare(Workspace *w);                  /* thread 0: frames at t_n */
void step_jets_look(Workspace *w, int jet, int chunk); /* line of sight and weights of one chunk of a jet's facets */
void step_jets_push(Workspace *w, int thread, Team *team);  /* all threads: pressure onto the corners */
void step_jets_count(Workspace *w, int thread, Team *team); /* all threads: power after the step */
void step_jets_sum(Workspace *w);                           /* thread 0: the jets' forces */
void step_jets_react(Workspace *w, NodeSums *t);            /* thread 0: reactions onto w->force */
void step_jets_count_reaction(Workspace *w, NodeSums *t);   /* thread 0: power after the step */
/* Does the reference of a group change at t_n? Then its old stress leaves the rows alone. */
bool step_reference_changes(const Workspace *w, int number);
/* All threads: one chunk of a group with a reference geometry. Before the kernel, where the reference stays: elements
 * that are taut for the first time act from now on (LNRC). After it: step, birth, return of tension. */
void step_reference_wake(Workspace *w, int number, int chunk, const KernelInput *input);
void step_reference_chunk(Workspace *w, int number, int chunk, const KernelInput *input, ChunkSums *sums);
double step_reference_advance(
    Workspace *w); /* thread 0: the states move on; energy that this cycle's changes brought */
/* Thread 0: where a change shortens the step, its stress acts for no longer than that before t_n (eq. R10b). */
void step_reference_shorten(Workspace *w);
void step_fail(Workspace *w, const char *advice, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
