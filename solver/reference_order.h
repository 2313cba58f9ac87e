/* In which order a table of panels gives the corners of its shells: by the nodes that neighbours have in common. */
#ifndef BILLOW_REFERENCE_ORDER_H
#define BILLOW_REFERENCE_ORDER_H

#include <stdbool.h>
#include <stdint.h>

/* One shell of a table: its corners in the mesh and in the panels, in the same places. */
typedef struct PanelShell {
    int shell, corner_count; /* shell -1: not matched */
    const int32_t *node;     /* of the mesh */
    int32_t corner[4];       /* of the panels */
} PanelShell;

typedef struct ReferenceOrder {
    int node_count;
    int32_t *stand; /* for which node of the mesh a panel's node stands, by majority (node_count) */
    int32_t *votes; /* (node_count) */
    int32_t *uses;  /* shells at a panel's node (node_count) */
} ReferenceOrder;

typedef enum CornerOrder {
    CORNERS_FIT,
    CORNERS_TURNED,   /* all begin with another corner */
    CORNERS_REVERSED, /* all go round the other way */
} CornerOrder;

/* 0, or -1 without memory. */
int reference_order_create(int node_count, ReferenceOrder *order);
void reference_order_free(ReferenceOrder *order);

/* Lets the shells vote, and tells whether another order of all of them fits much better than the given one. */
CornerOrder reference_order_vote(ReferenceOrder *order, const PanelShell *shells, int count);

/* Whether another order of this shell's corners fits its neighbours better than the given one, after the vote. */
bool reference_order_differs(const ReferenceOrder *order, const PanelShell *shell);

#endif
