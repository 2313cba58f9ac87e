/* *SET_SEGMENT to quadruples of node indices. */
#include <stdlib.h>
#include <string.h>

#include "solver/coordinates.h"
#include "solver/memory.h"
#include "solver/sets.h"

static const char *const KEYWORD = "*SET_SEGMENT";

/* One segment under way: its nodes in the deck's winding and its place, or -1 once taken out. */
typedef struct Segment {
    int32_t node[4], sorted[4];
    int32_t place;
} Segment;

typedef struct SegmentList {
    Segment *items;
    size_t count, capacity;
} SegmentList;

typedef struct SegmentResolution {
    const DeckIndex *index;
    const SetDefinition *set;
    bool report;
    int status;
    SegmentList list;
    Diagnostics *diagnostics;
} SegmentResolution;

static void fail(SegmentResolution *r, Source source, const char *noun, int id)
{
    r->status = -1;
    if (!r->report) return;
    diagnostics_add(r->diagnostics, SEVERITY_ERROR, source, KEYWORD,
                    "set %d names %s %d, which does not exist; define it or take it out of the set", r->set->id, noun,
                    id);
}

static void out_of_memory(SegmentResolution *r)
{
    r->status = -1;
    diagnostics_add(r->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, KEYWORD,
                    "not enough memory to resolve a set");
}

static void sort_nodes(Segment *segment)
{
    memcpy(segment->sorted, segment->node, sizeof segment->node);
    if (segment->node[3] == segment->node[2]) segment->sorted[3] = INT32_MAX; /* whichever node a triangle repeats */
    for (int i = 1; i < 4; i++) {
        for (int j = i; j > 0 && segment->sorted[j] < segment->sorted[j - 1]; j--) {
            int32_t swap = segment->sorted[j];
            segment->sorted[j] = segment->sorted[j - 1];
            segment->sorted[j - 1] = swap;
        }
    }
}

/* Looks the four nodes up; false after a report. */
static bool read_segment(SegmentResolution *r, const int ids[4], Source source, Segment *segment)
{
    for (int k = 0; k < 4; k++) {
        int id = k == 3 && ids[3] == 0 ? ids[2] : ids[k];
        segment->node[k] = id_map_find(&r->index->nodes, id);
        if (segment->node[k] < 0) return fail(r, source, "node", id), false;
    }
    sort_nodes(segment);
    return true;
}

static void add_segment(SegmentResolution *r, const int ids[4], Source source)
{
    SegmentList *list = &r->list;
    if (memory_reserve((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items)) {
        out_of_memory(r);
        return;
    }
    if (read_segment(r, ids, source, &list->items[list->count])) {
        list->items[list->count].place = (int32_t)list->count;
        list->count++;
    }
}

/* Takes out every segment on the same nodes. */
static void remove_segment(SegmentResolution *r, const int ids[4], Source source)
{
    Segment wanted;
    if (!read_segment(r, ids, source, &wanted)) return;
    for (size_t s = 0; s < r->list.count; s++) {
        if (memcmp(r->list.items[s].sorted, wanted.sorted, sizeof wanted.sorted) == 0) r->list.items[s].place = -1;
    }
}

static void add_shell(SegmentResolution *r, int32_t shell, bool remove)
{
    const ShellDefinition *record = &r->index->definitions->shells.items[shell];
    if (remove) {
        remove_segment(r, record->node, record->source);
    } else {
        add_segment(r, record->node, record->source);
    }
}

static void add_part(SegmentResolution *r, int32_t part, bool remove)
{
    for (int32_t k = r->index->part_shell_start[part]; k < r->index->part_shell_start[part + 1]; k++)
        add_shell(r, r->index->part_shell[k], remove);
}

static bool in_box(const DeckIndex *index, const BoxDefinition *box, const Segment *segment)
{
    for (int k = 0; k < 4; k++) {
        if (!coordinates_in_box(box, index->definitions->nodes.items[segment->node[k]].x)) return false;
    }
    return true;
}

/* Shells with all nodes in the box, or the segments so far that are in it. */
static void apply_box(SegmentResolution *r, const BoxDefinition *box, bool remove)
{
    if (remove) {
        for (size_t s = 0; s < r->list.count; s++) {
            if (in_box(r->index, box, &r->list.items[s])) r->list.items[s].place = -1;
        }
        return;
    }
    for (size_t e = 0; e < r->index->definitions->shells.count; e++) {
        const ShellDefinition *record = &r->index->definitions->shells.items[e];
        Segment segment;
        if (read_segment(r, record->node, record->source, &segment) && in_box(r->index, box, &segment))
            add_segment(r, record->node, record->source);
    }
}

static void apply_shell_set(SegmentResolution *r, const SetClause *clause, int id, bool remove, bool parts)
{
    IndexList inner = {0};
    int status = parts ? sets_resolve_parts(r->index, id, clause->source, KEYWORD, &inner, r->diagnostics)
                       : sets_resolve_shells(r->index, id, clause->source, KEYWORD, &inner, r->diagnostics);
    if (status) r->status = -1;
    for (size_t k = 0; k < inner.count; k++) {
        if (parts) {
            add_part(r, inner.items[k], remove);
        } else {
            add_shell(r, inner.items[k], remove);
        }
    }
    index_list_free(&inner);
}

/* One number of a clause; false if the option is unknown. */
static bool apply_entry(SegmentResolution *r, const SetClause *clause, const char *option, int id, bool remove)
{
    const DeckIndex *index = r->index;
    int32_t found;
    if (strcmp(option, "PART") == 0) {
        if ((found = id_map_find(&index->parts, id)) < 0) return fail(r, clause->source, "part", id), true;
        add_part(r, found, remove);
    } else if (strcmp(option, "SHELL") == 0 || strcmp(option, "ELEM") == 0) {
        if ((found = id_map_find(&index->shells, id)) < 0) return fail(r, clause->source, "shell", id), true;
        add_shell(r, found, remove);
    } else if (strcmp(option, "BOX") == 0 || strcmp(option, "BOX_SHELL") == 0) {
        if ((found = id_map_find(&index->boxes, id)) < 0) return fail(r, clause->source, "box", id), true;
        apply_box(r, &index->definitions->boxes.items[found], remove);
    } else if (strcmp(option, "SET_SHELL") == 0) {
        apply_shell_set(r, clause, id, remove, false);
    } else if (strcmp(option, "SET_PART") == 0) {
        apply_shell_set(r, clause, id, remove, true);
    } else {
        return false;
    }
    return true;
}

static void apply_clause(SegmentResolution *r, const SetClause *clause)
{
    if (strcmp(clause->option, "ALL") == 0) {
        for (size_t e = 0; e < r->index->definitions->shells.count; e++) add_shell(r, (int32_t)e, false);
        return;
    }
    bool remove = clause->option[0] == 'D';
    const char *option = clause->option + remove;
    if (strcmp(option, "SEG") == 0) {
        int ids[4];
        for (int k = 0; k < 4; k++) ids[k] = (int)clause->e[k];
        if (remove) {
            remove_segment(r, ids, clause->source);
        } else {
            add_segment(r, ids, clause->source);
        }
        return;
    }
    for (int k = 0; k < 7; k++) {
        int id = (int)clause->e[k];
        if (id == 0 || apply_entry(r, clause, option, id, remove)) continue;
        r->status = -1;
        if (r->report)
            diagnostics_add(r->diagnostics, SEVERITY_ERROR, clause->source, KEYWORD,
                            "set %d: option %s is not known here; known are ALL, SEG, PART, SHELL, BOX, SET_SHELL, "
                            "SET_PART, each also with D before it",
                            r->set->id, clause->option);
        return;
    }
}

static int compare_segments(const void *a, const void *b)
{
    const Segment *p = a, *q = b;
    for (int k = 0; k < 4; k++) {
        if (p->sorted[k] != q->sorted[k]) return p->sorted[k] < q->sorted[k] ? -1 : 1;
    }
    return (p->place > q->place) - (p->place < q->place);
}

static int compare_places(const void *a, const void *b)
{
    const Segment *p = a, *q = b;
    return (p->place > q->place) - (p->place < q->place);
}

/* Removes what was taken out and later copies of the same nodes; the rest comes in deck order. */
static void keep_unique(SegmentList *list)
{
    size_t kept = 0;
    for (size_t s = 0; s < list->count; s++) {
        if (list->items[s].place >= 0) list->items[kept++] = list->items[s];
    }
    list->count = kept;
    if (kept < 2) return;
    qsort(list->items, list->count, sizeof *list->items, compare_segments);
    kept = 1;
    for (size_t s = 1; s < list->count; s++) {
        if (memcmp(list->items[s].sorted, list->items[kept - 1].sorted, sizeof list->items->sorted) != 0)
            list->items[kept++] = list->items[s];
    }
    list->count = kept;
    qsort(list->items, list->count, sizeof *list->items, compare_places);
}

int sets_resolve_segments(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                          Diagnostics *diagnostics)
{
    out->count = 0;
    int32_t found = id_map_find(&index->sets[SET_SEGMENT], set_id);
    if (found < 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, user, keyword,
                        "there is no segment set %d; add a *SET_SEGMENT card or correct the id", set_id);
        return -1;
    }
    SegmentResolution r = {index,      &index->definitions->sets.items[found], !index->set_reported[found], 0, {0},
                           diagnostics};
    index->set_reported[found] = 1;
    for (size_t s = 0; s < r.set->segments.count; s++)
        add_segment(&r, r.set->segments.items[s].node, r.set->segments.items[s].source);
    for (size_t c = 0; c < r.set->clauses.count; c++) apply_clause(&r, &r.set->clauses.items[c]);
    keep_unique(&r.list);
    for (size_t s = 0; s < r.list.count; s++) {
        for (int k = 0; k < 4; k++) {
            if (index_list_add(out, r.list.items[s].node[k])) {
                out_of_memory(&r);
                s = r.list.count - 1;
                break;
            }
        }
    }
    memory_free(r.list.items);
    return r.status;
}
