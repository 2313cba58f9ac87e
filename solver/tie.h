/* Ties: nodes at one place that move as one until the fabric around them is stretched too far,
 * *CONSTRAINED_TIED_NODES_FAILURE. docs/theory.md, section "Seams and tears". */
#ifndef BILLOW_TIE_H
#define BILLOW_TIE_H

#include <stdint.h>

typedef struct Tie {
    int first_node, node_count;   /* of TieTable.node */
    int first_watch, watch_count; /* of TieTable.watch */
    double limit;                 /* EPPF */
} Tie;

/* All ties of the model, and the elements around them, whose strains are watched. */
typedef struct TieTable {
    int count;
    Tie *ties;
    int32_t *node;       /* nodes of the ties, one after the other */
    int32_t *watch;      /* indices of slot for each tie's elements */
    int slot_count;      /* watched elements */
    int64_t *slot;       /* their padded indices, ascending (slot_count) */
    int32_t *chunk_slot; /* first watched element of each chunk (chunk_count + 1) */
} TieTable;

#endif
