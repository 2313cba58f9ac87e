/* *SET_NODE, _PART, _SHELL, _SEGMENT to internal indices: _LIST, _GENERATE and _GENERAL. */
#ifndef BILLOW_SETS_H
#define BILLOW_SETS_H

#include <stdint.h>

#include "solver/deck_index.h"

/* Growing list of indices; zero-initialise, free with index_list_free. */
typedef struct IndexList {
    int32_t *items;
    size_t count, capacity;
} IndexList;

int index_list_add(IndexList *list, int32_t item); /* 0, or -1 without memory */
void index_list_free(IndexList *list);

/* The set's members, each once, ascending, as deck-order indices; replaces what was in out. A missing set is an error
 * at user (the card that names it) under keyword; missing members are errors at the set, reported once for each set.
 * Returns 0, or -1 after an error (out then holds what could be resolved). */
int sets_resolve_nodes(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                       Diagnostics *diagnostics);
int sets_resolve_parts(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                       Diagnostics *diagnostics);
int sets_resolve_shells(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                        Diagnostics *diagnostics);

/* The segments in deck order, four node indices each (out->count = 4 x segments; triangles repeat the third), repeated
 * ones (same nodes in any order) dropped. */
int sets_resolve_segments(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                          Diagnostics *diagnostics);

/* Nodes of the given parts (deck indices), each once, ascending. 0, or -1 without memory. */
int sets_part_nodes(const DeckIndex *index, const int32_t *parts, size_t part_count, IndexList *out);

#endif
