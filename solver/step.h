/* The central-difference loop. */
#ifndef BILLOW_STEP_H
#define BILLOW_STEP_H

#include <stdbool.h>

#include "solver/model.h"
#include "solver/state.h"

/* Full-step quantities of the cycle that is being written; valid during RunHooks.emit only. */
typedef struct StepView {
    const double *x;             /* positions at t_n (node_count x 3) */
    const double *v;             /* velocities at t_n, the mean of the half steps (node_count x 3) */
    const double *a;             /* accelerations at t_n (node_count x 3) */
    const double *f;             /* total nodal forces at t_n (node_count x 3) */
    const double *part_kinetic;  /* kinetic energy of each part at t_n (part_count) */
    const double *part_momentum; /* (part_count x 3) */
    const double *wall_force;    /* force of each wall on the nodes at t_n and its normal part (wall_count x 4) */
    const double *contact;   /* contact forces at t_n, first three of eight (node_count x 8); NULL without contact */
    const double *resultant; /* force on side A of each contact at t_n (contact_count x 3); NULL without contact */
    const double *entity; /* force and moment on each contact entity at t_n (entity_count x 6); NULL without contact */
    double element_step;  /* stable step of the elements before TSSFAC */
    int critical_element; /* deck-order index of the element with the smallest step, -1 none */
} StepView;

/* Why a run stopped by itself. */
typedef struct Failure {
    bool failed;
    char cause[256];  /* time, cycle, element or node, what happened */
    char advice[256]; /* what to try */
} Failure;

/* Callbacks of the loop, always on one thread while the others wait. */
typedef struct RunHooks {
    void *user;
    /* Every cycle, cheap: true if emit wants this cycle. last is true on the final cycle (end time reached). */
    bool (*due)(void *user, const Model *model, const State *state, bool last);
    /* Full-step results of the cycle at state->clock->time. Returns 0 to go on, 1 to stop cleanly after this cycle. */
    int (*emit)(void *user, const Model *model, const State *state, const StepView *view, bool last);
    /* After a completed cycle for which emit was called, with the state consistent at the loop's top: checkpoints. */
    void (*completed)(void *user, const Model *model, const State *state);
} RunHooks;

/* Wall seconds by stage, of thread 0; output is the time inside the hooks. */
typedef struct StageTimes {
    double elements, gas, contact, nodes, special, waiting, output, total;
    double search; /* share of contact */
} StageTimes;

/* Runs from state to the end time (or stop, or failure) on the given number of threads. Returns 0, or -1 with *failure
 * set; the last good state has then been emitted. */
int solver_run(const Model *model, State *state, int threads, const RunHooks *hooks, StageTimes *times,
               Failure *failure);

#endif
