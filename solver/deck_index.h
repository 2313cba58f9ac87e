/* Look-up tables of one deck's ids: nodes, shells, parts, sets, curves, coordinate systems, vectors, boxes. */
#ifndef BILLOW_DECK_INDEX_H
#define BILLOW_DECK_INDEX_H

#include "solver/definitions.h"
#include "solver/id_map.h"

/* Indices are positions in the lists of Definitions (deck order). Curve indices are those of Definitions.curves. */
typedef struct DeckIndex {
    const Definitions *definitions;
    IdMap nodes, shells, solids, parts, materials, curves, functions, coordinates, vectors, boxes;
    IdMap sets[4];             /* by SetKind; index into Definitions.sets */
    int32_t *part_shell_start; /* CSR by part (part count + 1): shells of each part, deck order */
    int32_t *part_shell;
    unsigned char *set_reported; /* sets whose bad members have been reported (set count); written by sets_resolve_* */
} DeckIndex;

/* Builds all tables. An id used twice is an error naming both places; a shell of an unknown part belongs to none (the
 * caller of shells reports it). The definitions must outlive the index. 0, or -1 if an error was reported. */
int deck_index_build(DeckIndex *index, const Definitions *definitions, Diagnostics *diagnostics);

/* Index of a curve for use by keyword at source, or -1 after an error saying what names it (field, e.g. "LCID"). */
int deck_index_curve(const DeckIndex *index, int curve_id, const char *field, Source source, const char *keyword,
                     Diagnostics *diagnostics);

/* The same for fields that also take *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION: function number k has the index
 * (count of curves) + k. */
int deck_index_curve_or_function(const DeckIndex *index, int curve_id, const char *field, Source source,
                                 const char *keyword, Diagnostics *diagnostics);

void deck_index_free(DeckIndex *index);

#endif
