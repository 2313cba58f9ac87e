/* What the files of the surface's closure share; nobody else includes this. */
#ifndef BILLOW_SURFACE_INTERNAL_H
#define BILLOW_SURFACE_INTERNAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "airbag/surface.h"

/* ---- surface_edges.c: the edge table -------------------------------------------------------------------------- */

/* One facet's side, from -> to as the facet is stored. */
typedef struct EdgeUse {
    int32_t from, to;
    int facet;
} EdgeUse;

/* All sides of the facets that count, sorted by their lower node, upper node, facet: equal sides are one edge. */
typedef struct EdgeTable {
    int edge_count;
    int *start;   /* uses of edge e: use[start[e]] .. use[start[e + 1] - 1] (edge_count + 1) */
    EdgeUse *use; /* (start[edge_count]) */
} EdgeTable;

/* The facet's different corners in order; returns how many, 0 if there are fewer than three or the quad is folded on
 * itself. */
int facet_corners(const int32_t node[4], int32_t corner[4]);

/* +1 if the side runs from its lower to its upper node, else -1. */
int edge_use_sign(const EdgeUse *use);

/* Number of facets on edge e. */
int edge_use_count(const EdgeTable *table, int e);

/* Builds the table over facets with active[i]; 0, or -1 without memory (the table is then empty). */
int edge_table_build(const SurfaceInput *input, const bool *active, EdgeTable *table);
void edge_table_free(EdgeTable *table);

/* ---- surface_parity.c: sets of facets with known relative winding ---------------------------------------------- */

/* A forest over facets: flip is the winding relative to the parent's, +1 the same, -1 the other. */
typedef struct Parity {
    int *parent;
    signed char *flip;
} Parity;

int parity_create(int count, Parity *parity); /* all alone; 0, or -1 without memory */
void parity_free(Parity *parity);
int parity_find(Parity *parity, int item, int *flip); /* the set's lowest item; flip: winding relative to it */

/* States that the windings of a and b agree (relation +1) or differ (-1); false if that contradicts what is known. */
bool parity_join(Parity *parity, int a, int b, int relation);

enum { BRANCH_LIMIT = 64 }; /* more facets on one edge are no mesh: the cost of an edge grows with their square */

/* ---- the closure at work --------------------------------------------------------------------------------------- */

/* One side of a free-edge loop, walked from -> next side's from. */
typedef struct LoopSide {
    int32_t from;
    int facet;
    int along; /* +1 if walked as the facet is stored, -1 against */
} LoopSide;

typedef struct Loop {
    size_t start; /* index of its first side */
    int count;
    bool seam;
} Loop;

typedef struct LoopList {
    Loop *loops;
    size_t count, capacity;
    LoopSide *sides;
    size_t side_count, side_capacity;
} LoopList;

typedef struct SurfaceWork {
    const SurfaceInput *input;
    Diagnostics *diagnostics;
    bool *active; /* the facet counts (facet_count): not degenerate, not inner */
    bool *inner;  /* its sign will be 0 (facet_count) */
    EdgeTable table;
    Parity parity;
    LoopList loops;
    int32_t *loop_node;               /* scratch for the nodes of any loop, once the loops are known */
    signed char *sense;               /* scratch by facet, zero between uses (facet_count) */
    double *volume;                   /* of the shells, at their lowest facets, in the end (facet_count) */
    int layers, flaps, walls, sheets; /* facets left out by cause */
    int flat;                         /* shells without volume */
    double origin[3];                 /* middle of the bag's box */
    double size;                      /* its diagonal */
} SurfaceWork;

/* Builds table and parity of the active facets and joins all facets that share an edge of two. Returns 0; -1 with an
 * error reported if a surface is one-sided or memory is short. */
int surface_spread(SurfaceWork *work);

/* Marks second layers, flaps and tethers inner and rebuilds (surface_layers.c). Same returns. */
int surface_drop_layers(SurfaceWork *work);
int surface_drop_flaps(SurfaceWork *work);

/* Facets on edges of three and more: finds inner walls, joins the rest (surface_branches.c). Same returns. */
int surface_resolve_branches(SurfaceWork *work);

/* ---- surface_seams.c, surface_loops.c, surface_cycles.c: free edges --------------------------------------------- */

typedef struct FreeEdge {
    int32_t node[2]; /* from, to as the facet is stored */
    int end[2];      /* the same as indices of FreeGraph.node */
    int facet;
    bool taken;
} FreeEdge;

typedef struct FreeGraph {
    int edge_count, node_count;
    FreeEdge *edge;
    int32_t *node; /* ascending (node_count) */
    int *start;    /* edges at node n: incident[start[n]] .. incident[start[n + 1] - 1] (node_count + 1) */
    int *incident;
    int *degree; /* edges at node n not yet taken (node_count) */
} FreeGraph;

int free_graph_build(const EdgeTable *table, FreeGraph *graph); /* 0, or -1 without memory */
void free_graph_free(FreeGraph *graph);

/* A step over edge e leaving its end side: 0 along the stored winding, 1 against. */
typedef struct Step {
    int edge, side;
} Step;

/* Appends a loop of count steps, takes its edges and joins its facets. Returns 0, -1 without memory, 1 if the windings
 * contradict each other (nothing is then taken). */
int loop_accept(SurfaceWork *work, FreeGraph *graph, const Step *steps, int count, bool seam);

/* Slivers between an edge and the chain of hanging nodes on it become seams. Returns 0, or -1 with an error reported.
 */
int surface_find_seams(SurfaceWork *work, FreeGraph *graph);

/* A chain of free edges between branching nodes; from end[0] to end[1] by its steps. */
typedef struct Arc {
    int end[2];
    int first, count; /* its steps */
    double length;    /* [L] */
} Arc;

typedef struct ArcGraph {
    int arc_count;
    Arc *arc;
    Step *steps;
    int *start, *incident; /* arcs at node n of the free graph, as in FreeGraph */
} ArcGraph;

/* The free edges left become loops: those without branching nodes as they are, the others by surface_find_cycles, which
 * takes the shortest cycle of arcs first. Same returns. */
int surface_find_loops(SurfaceWork *work, FreeGraph *graph);
int surface_find_cycles(SurfaceWork *work, FreeGraph *graph, ArcGraph *arcs);

/* ---- surface_caps.c: the caps' geometry -------------------------------------------------------------------------- */

/* Volume under the fan of count nodes about origin. */
double fan_volume(const int32_t *node, int count, const double *x, const double origin[3]);

/* Fills the initial geometry of a cap whose nodes are set. */
void cap_measure(SurfaceCap *cap, const double *x);

/* A loop is narrow, and so a seam, if its fan's area is next to nothing against its length. */
bool loop_is_narrow(const int32_t *node, int count, const double *x);

/* Nodes of a loop as it is walked (loop->count), in work->loop_node: until the next call. */
const int32_t *loop_nodes(const SurfaceWork *work, const Loop *loop);

/* Winding of the facets at the loop relative to their set's lowest facet *root, such that the cap walks as the loop:
 * the cap's share of the set's volume is this times the fan's volume. */
int loop_flip(SurfaceWork *work, const Loop *loop, int *root);

/* Adds the volume of each set of facets with its caps (about work->origin, in the winding of its lowest facet) to
 * volume (facet_count), at the lowest facet. */
void surface_sum_volumes(SurfaceWork *work, double *volume);

/* Whether a shell has no volume to speak of, so that its sign says nothing. */
bool shell_is_flat(double volume, double area);

/* ---- surface_report.c: messages -----------------------------------------------------------------------------------
 */

void report_memory(const SurfaceWork *work);
void report_empty(const SurfaceWork *work);
void report_one_sided(const SurfaceWork *work, int32_t a, int32_t b, int facet, int other);
void report_branch(const SurfaceWork *work, const EdgeUse *uses, int count);
void report_stray(const SurfaceWork *work, const FreeEdge *edge);
void report_open(const SurfaceWork *work, const Loop *loop, int facets, Severity severity);
void report_large_caps(const SurfaceWork *work, int facet, double share);

/* The notes and warnings on a surface that was closed. */
void report_closure(SurfaceWork *work, const int *sign, const SurfaceClosure *closure);

#endif
