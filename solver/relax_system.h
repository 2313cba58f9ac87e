/* The static equilibrium as a system of equations: unknowns, forces, stiffness, CHOLMOD's factor (docs/theory.md,
 * Static equilibrium). Private to solver/relax*.c. */
#ifndef BILLOW_RELAX_SYSTEM_H
#define BILLOW_RELAX_SYSTEM_H

#include <cholmod.h>

#include "elements/static_law.h"
#include "solver/model.h"

enum { RELAX_MASTERS = 4 }; /* of a hanging node whose ends hang themselves */

/* A node's part in the unknowns: x = sum of weight x(master) + constant; a node that is free is its own master. */
typedef struct RelaxNode {
    int32_t master[RELAX_MASTERS];
    double weight[RELAX_MASTERS];
    int master_count;
    int first, count; /* its own unknowns, along the rows of basis; count 0: held, hanging or of no element */
    double basis[9];
} RelaxNode;

typedef struct RelaxSystem {
    const Model *model;
    StaticLaw *laws;  /* (group_count) */
    double *pressure; /* net pressure of each pressure set [F/L2] */
    double *bag;      /* pressure of each bag, for caps that push their rims (airbag_count) */
    double *gravity;  /* of each body class (class_count x 3) [L/T2] */
    double time;      /* at which curves are read */
    RelaxNode *nodes; /* (node_count) */
    int unknown_count;
    int32_t *unknown_node; /* node of each unknown */
    double *scale;         /* stiffness of each unknown in the reference, the unit of the shift (unknown_count) */
    int *block_start;      /* CSC of node pairs (column, row >= column) with unknowns (node_count + 1) */
    int32_t *block_node;   /* row of each pair */
    int *block_row;        /* entries before it in the node's first column */
    double *force;         /* of all nodes, folded to the masters (node_count x 3) */
    double *loads;         /* likewise without the stress: what the residual is measured against */
    cholmod_common common;
    cholmod_sparse *matrix; /* lower triangle of the stiffness, no shift */
    cholmod_sparse *shifted;
    cholmod_factor *factor; /* analysed once */
    cholmod_dense *right;
    bool started; /* common is */
} RelaxSystem;

/* Unknowns, pattern, loads at the time, symbolic analysis. 0, or -1 without memory. */
int relax_system_create(const Model *model, double time, RelaxSystem *system);
void relax_system_free(RelaxSystem *system);

/* Residual force of each unknown at x (node_count x 3), and the stiffness into system->matrix if it is wanted. The size
 * of the loads (largest of the forces other than the stress, as a root of the sum of squares over the unknowns) goes to
 * *load. energy: stored energy of each part (part_count), or NULL. */
void relax_system_assemble(RelaxSystem *system, const double *x, bool stiffness, double *residual, double *load);

/* Solves (K + shift D) step = residual. 0; 1: not positive definite; -1: out of memory. */
int relax_system_solve(RelaxSystem *system, double shift, const double *residual, double *step);

/* The same with the factor of the last solution. 0, or -1 out of memory. */
int relax_system_backsolve(RelaxSystem *system, const double *residual, double *step);

/* x = from + factor times the step of the unknowns; hanging nodes follow. */
void relax_system_move(const RelaxSystem *system, const double *from, double factor, const double *step, double *x);

#endif
