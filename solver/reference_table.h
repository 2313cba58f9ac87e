/* Reference coordinates as *AIRBAG_REFERENCE_GEOMETRY gives them: after SX, SY, SZ, the last record of a node counting.
 */
#ifndef BILLOW_REFERENCE_TABLE_H
#define BILLOW_REFERENCE_TABLE_H

#include <stdbool.h>

#include "solver/definitions.h"
#include "solver/id_map.h"

typedef struct ReferenceTable {
    const Definitions *definitions;
    IdMap nodes;     /* of *NODE */
    int32_t *record; /* of each deck node the record in Definitions.reference_nodes, -1 none (nodes.count) */
    int32_t *block;  /* of each record its block in Definitions.reference_blocks (reference_nodes.count) */
    double *x;       /* of each record its coordinates after scaling (reference_nodes.count x 3) [L] */
} ReferenceTable;

/* 0, or -1 without memory. Records of nodes that the deck does not define stay in no node's record. */
int reference_table_build(const Definitions *definitions, ReferenceTable *table);

/* The place of a deck node in the reference: its record's, or that under *NODE. */
void reference_table_node(const ReferenceTable *table, int32_t node, double x[3]);

/* X = O + (SX, SY, SZ) (X - O) of a block of shells, O the place of its origin (eq. R1). Without one (the node is not
 * defined, which the build reports) nothing is scaled. */
void reference_table_scale(const ReferenceTable *table, const ReferenceBlockDefinition *block, double x[3]);

/* The node about which a block scales: NIDO, or the first of the block; a deck node, or -1 if it is not defined. */
int32_t reference_table_origin(const ReferenceTable *table, const ReferenceBlockDefinition *block, int *id);

void reference_table_free(ReferenceTable *table);

#endif
