/* billow fold: a flat bag and a list of folds become a folded mesh with its flat reference. docs/theory.md, section
 * "Folding". Everything but the command works on arrays and knows no deck. */
#ifndef BILLOW_FOLD_H
#define BILLOW_FOLD_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/definitions.h"

typedef enum FoldKind { FOLD_THIN, FOLD_ZIG_ZAG, FOLD_ROLL, FOLD_TUCK } FoldKind;

enum { FOLD_LARGEST_COUNT = 40, FOLD_TEXT = 400 };

/* One fold as the file has it; lengths [L] in the deck's unit. */
typedef struct Fold {
    FoldKind kind;
    double point[2];     /* on the line */
    double direction[2]; /* unit vector across the line, to the side that moves */
    int sense;           /* +1 up, -1 down */
    double angle;        /* of thin folds [rad], up to pi */
    double pitch;        /* of zig-zags: distance of the lines */
    int count;           /* of zig-zags and rolls: lines */
    Source source;
} Fold;

typedef struct FoldPlan {
    double gap;    /* between layers */
    double ramp;   /* from a seam to the place where the panels are a gap apart; 0: a tenth of the bag's size */
    double spread; /* over which layers slip beside a crease; 0: likewise */
    double limit;  /* largest change of an edge's length that is accepted, as a share */
    LIST(int) upper;
    LIST(int) lower; /* ids of the panels' parts */
    LIST(Fold) folds;
} FoldPlan;

/* Reads a fold file into plan; what is wrong goes to diagnostics with file and line. 0, or -1. */
int fold_read(const char *path, FoldPlan *plan, Diagnostics *diagnostics);
void fold_plan_free(FoldPlan *plan);

/* The bag being folded. Owns all arrays. */
typedef struct FoldBag {
    int node_count, facet_count, edge_count;
    double *flat;         /* (node_count x 3) [L]; nodes are moved within the panel onto the lines of folds */
    double *x;            /* folded (node_count x 3) [L] */
    double *start;        /* x before the statement being carried out, in which its lines are (node_count x 3) [L] */
    int32_t *facet;       /* (facet_count x 4), triangles repeat the third */
    int32_t *edge;        /* (edge_count x 2), each side once, first < second */
    int32_t *first_facet; /* CSR: facets of each node (node_count + 1) */
    int32_t *node_facet;
    signed char *panel;   /* +1 upper, -1 lower, 0 seam (node_count) */
    uint64_t *line;       /* bit i: on the line of crease i, the last bit: on a seam (node_count) */
    double *across;       /* distance from the line in start (node_count) [L] */
    unsigned char *rigid; /* (facet_count) */
    double size;          /* largest extent of the flat bag [L] */
    int crease_count, tuck_count;
    bool upright; /* a fold of less than 180 degrees was made: no more can follow */
} FoldBag;

#define FOLD_SEAM_LINE (UINT64_C(1) << 63)

/* Completes a bag whose node_count, facet_count, flat, facet, panel and rigid are set: edges, facets of nodes, seams,
 * and x with the panels plan->gap apart. 0, or -1 without memory. */
int fold_bag_open(FoldBag *bag, const FoldPlan *plan);
void fold_bag_free(FoldBag *bag);

/* Makes one fold of the list; sets bag->x. 0, or -1 with the reason and what to do in problem. */
int fold_make(FoldBag *bag, const FoldPlan *plan, const Fold *fold, char problem[FOLD_TEXT]);

/* Moves nodes onto the line across == 0, such that no edge crosses it; sets across to 0 there and marks the nodes with
 * the bit. 0, or -1 with the reason in problem. */
int fold_snap(FoldBag *bag, uint64_t bit, char problem[FOLD_TEXT]);

/* How far the folded bag is from an isometry. */
typedef struct FoldMeasure {
    double stretch, shrink;          /* largest changes of an edge's length, as shares >= 0 */
    int stretched_edge, shrunk_edge; /* -1 none */
    double area, flat_area;          /* [L2] */
    double area_change;              /* of the worst facet, a share with its sign */
} FoldMeasure;
void fold_measure(const FoldBag *bag, FoldMeasure *measure);

/* billow fold DECK FOLDS: reads both, folds, reports, writes the deck output. Returns the exit code. */
int fold_deck(const char *deck, const char *folds, const char *output);

/* Writes the deck with the folded nodes (node_id in the bag's order) and the flat ones as reference. 0, or -1 with the
 * reason in problem. */
int fold_write_deck(const char *deck, const char *output, const Definitions *definitions, const FoldBag *bag,
                    const int *node_id, char problem[FOLD_TEXT]);

/* True if the line of a deck is a keyword of that name, options not counted. */
bool fold_is_keyword(const char *line, const char *name);

#endif
