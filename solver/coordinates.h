/* Local coordinate systems, vectors and boxes of the *DEFINE keywords, resolved at the initial geometry. */
#ifndef BILLOW_COORDINATES_H
#define BILLOW_COORDINATES_H

#include <stdbool.h>

#include "solver/deck_index.h"

typedef struct CoordinateSystem {
    double origin[3];
    double axes[9]; /* rows: local x, y, z in global components, orthonormal */
    bool moves;     /* with the model: FLAG = 1 of _NODES, NID of _VECTOR */
} CoordinateSystem;

/* System cid for the use by keyword at user; cid 0 is the global one. Node positions are those of the NODE cards.
 * Returns 0, or -1 after an error (unknown id or node, points on a line). */
int coordinates_resolve_system(const DeckIndex *index, int cid, Source user, const char *keyword,
                               CoordinateSystem *system, Diagnostics *diagnostics);

/* Unit vector of *DEFINE_VECTOR vid in global components. */
int coordinates_resolve_vector(const DeckIndex *index, int vid, Source user, const char *keyword, double vector[3],
                               Diagnostics *diagnostics);

/* The box, or NULL after an error. */
const BoxDefinition *coordinates_resolve_box(const DeckIndex *index, int box_id, Source user, const char *keyword,
                                             Diagnostics *diagnostics);

/* Inside or on the faces. */
bool coordinates_in_box(const BoxDefinition *box, const double x[3]);

#endif
