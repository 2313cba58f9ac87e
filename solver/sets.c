/* *SET_NODE, _PART and _SHELL to internal indices. */
#include "solver/sets.h"

#include <stdlib.h>
#include <string.h>

#include "solver/coordinates.h"
#include "solver/memory.h"

/* What is special about sets of nodes, parts and shells. */
typedef struct EntityKind {
    SetKind kind;
    const char *keyword, *noun, *known; /* known: options for messages */
} EntityKind;

static const EntityKind KINDS[] = {
    {SET_NODE, "*SET_NODE", "node",
     "ALL, NODE, PART, SHELL, BOX, SET_NODE, SET_PART, SET_SHELL, each also with D before it"},
    {SET_PART, "*SET_PART", "part", "ALL, PART, SET_PART, each also with D before it"},
    {SET_SHELL, "*SET_SHELL", "shell", "ALL, ELEM, PART, BOX, SET_SHELL, SET_PART, each also with D before it"},
};

/* One resolution in progress: a mark for every entity of the kind. */
typedef struct Resolution {
    const DeckIndex *index;
    const EntityKind *kind;
    const SetDefinition *set;
    bool report; /* members not yet reported */
    int depth;   /* of sets within sets */
    int status;
    Diagnostics *diagnostics;
    unsigned char *mark;
    size_t mark_count;
} Resolution;

static int out_of_memory(const char *keyword, Diagnostics *diagnostics)
{
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, keyword, "not enough memory to resolve a set");
    return -1;
}

static const IdMap *map_of(const DeckIndex *index, SetKind kind)
{
    return kind == SET_NODE ? &index->nodes : kind == SET_PART ? &index->parts : &index->shells;
}

static size_t entity_count(const DeckIndex *index, SetKind kind)
{
    const Definitions *d = index->definitions;
    return kind == SET_NODE ? d->nodes.count : kind == SET_PART ? d->parts.count : d->shells.count;
}

static const SetDefinition *find_set(const DeckIndex *index, SetKind kind, int set_id, Source user, const char *keyword,
                                     Diagnostics *diagnostics)
{
    static const char *const cards[] = {"*SET_NODE", "*SET_PART", "*SET_SHELL", "*SET_SEGMENT"};
    int32_t found = id_map_find(&index->sets[kind], set_id);
    if (found >= 0) return &index->definitions->sets.items[found];
    diagnostics_add(diagnostics, SEVERITY_ERROR, user, keyword,
                    "there is no set %d of this kind; add a %s card or correct the id", set_id, cards[kind]);
    return NULL;
}

/* True the first time a set is resolved: its bad members are then reported. */
static bool first_report(const DeckIndex *index, const SetDefinition *set)
{
    size_t place = (size_t)(set - index->definitions->sets.items);
    bool first = !index->set_reported[place];
    index->set_reported[place] = 1;
    return first;
}

static void report_missing(Resolution *r, Source source, const char *noun, int id)
{
    r->status = -1;
    if (!r->report) return;
    diagnostics_add(r->diagnostics, SEVERITY_ERROR, source, r->kind->keyword,
                    "set %d names %s %d, which does not exist; define it or take it out of the set", r->set->id, noun,
                    id);
}

/* Marks or clears the nodes of a shell, or the shell itself. */
static void mark_shell(Resolution *r, int32_t shell, unsigned char value)
{
    if (r->kind->kind == SET_SHELL) {
        r->mark[shell] = value;
        return;
    }
    const ShellDefinition *record = &r->index->definitions->shells.items[shell];
    for (int k = 0; k < 4; k++) {
        int32_t node = id_map_find(&r->index->nodes, record->node[k]);
        if (node >= 0) r->mark[node] = value;
    }
}

static void mark_node(Resolution *r, int id, unsigned char value)
{
    int32_t node = id_map_find(&r->index->nodes, id);
    if (node >= 0) r->mark[node] = value;
}

/* Nodes of a part's solids, inner ones too, beams and springs. */
static void mark_other_elements(Resolution *r, int32_t part, unsigned char value)
{
    const Definitions *d = r->index->definitions;
    int id = d->parts.items[part].id;
    for (size_t e = 0; e < d->beams.count; e++)
        for (int k = 0; d->beams.items[e].part == id && k < 2; k++) mark_node(r, d->beams.items[e].node[k], value);
    for (size_t e = 0; e < d->discretes.count; e++)
        for (int k = 0; d->discretes.items[e].part == id && k < 2; k++)
            mark_node(r, d->discretes.items[e].node[k], value);
    for (size_t s = 0; s < d->solids.count; s++) {
        if (d->solids.items[s].part != id) continue;
        for (int k = 0; k < 8; k++) mark_node(r, d->solids.items[s].node[k], value);
    }
}

static void mark_part(Resolution *r, int32_t part, unsigned char value)
{
    if (r->kind->kind == SET_PART) {
        r->mark[part] = value;
        return;
    }
    for (int32_t k = r->index->part_shell_start[part]; k < r->index->part_shell_start[part + 1]; k++)
        mark_shell(r, r->index->part_shell[k], value);
    if (r->kind->kind == SET_NODE) mark_other_elements(r, part, value);
}

static void mark_box(Resolution *r, const BoxDefinition *box, unsigned char value)
{
    const Definitions *d = r->index->definitions;
    for (size_t i = 0; i < r->mark_count; i++) {
        bool inside = true;
        if (r->kind->kind == SET_NODE) {
            inside = coordinates_in_box(box, d->nodes.items[i].x);
        } else { /* a shell is inside if all its nodes are */
            for (int k = 0; k < 4 && inside; k++) {
                int32_t node = id_map_find(&r->index->nodes, d->shells.items[i].node[k]);
                inside = node >= 0 && coordinates_in_box(box, d->nodes.items[node].x);
            }
        }
        if (inside) r->mark[i] = value;
    }
}

static int resolve_marks(const DeckIndex *index, SetKind kind, const SetDefinition *set, int depth, unsigned char *mark,
                         Diagnostics *diagnostics);

/* Members of another set, of the kind named, marked here. */
static void mark_set(Resolution *r, SetKind inner, const SetClause *clause, int set_id, unsigned char value)
{
    static const char *const nouns[] = {"node set", "part set", "shell set"};
    int32_t found = id_map_find(&r->index->sets[inner], set_id);
    if (found < 0) {
        report_missing(r, clause->source, nouns[inner], set_id);
        return;
    }
    const SetDefinition *set = &r->index->definitions->sets.items[found];
    size_t count = entity_count(r->index, inner);
    unsigned char *mark = memory_alloc(count + 1, 1);
    if (!mark) {
        r->status = out_of_memory(r->kind->keyword, r->diagnostics);
        return;
    }
    if (resolve_marks(r->index, inner, set, r->depth + 1, mark, r->diagnostics)) r->status = -1;
    for (size_t i = 0; i < count; i++) {
        if (!mark[i]) continue;
        if (inner == r->kind->kind) {
            r->mark[i] = value;
        } else if (inner == SET_PART) {
            mark_part(r, (int32_t)i, value);
        } else {
            mark_shell(r, (int32_t)i, value);
        }
    }
    memory_free(mark);
}

static void mark_range(Resolution *r, const SetClause *clause)
{
    const IdMap *map = map_of(r->index, r->kind->kind);
    int first = (int)clause->e[0], last = (int)clause->e[1], increment = (int)clause->e[2];
    if (increment < 1) increment = 1;
    for (size_t k = id_map_lower(map, first); k < map->count && map->id[k] <= last; k++) {
        if ((map->id[k] - first) % increment == 0) r->mark[map->index[k]] = 1;
    }
}

/* Entities named by an option after its D, or false if the option is unknown for this kind. */
static bool mark_entry(Resolution *r, const SetClause *clause, const char *option, int id, unsigned char value)
{
    const DeckIndex *index = r->index;
    SetKind kind = r->kind->kind;
    int32_t found;
    if (strcmp(option, "NODE") == 0 && kind == SET_NODE) {
        if ((found = id_map_find(&index->nodes, id)) < 0) return report_missing(r, clause->source, "node", id), true;
        r->mark[found] = value;
    } else if (strcmp(option, "PART") == 0) {
        if ((found = id_map_find(&index->parts, id)) < 0) return report_missing(r, clause->source, "part", id), true;
        mark_part(r, found, value);
    } else if (kind != SET_PART && (strcmp(option, "SHELL") == 0 || strcmp(option, "ELEM") == 0)) {
        if ((found = id_map_find(&index->shells, id)) < 0) return report_missing(r, clause->source, "shell", id), true;
        mark_shell(r, found, value);
    } else if (kind != SET_PART && (strcmp(option, "BOX") == 0 || strcmp(option, "BOX_SHELL") == 0)) {
        if ((found = id_map_find(&index->boxes, id)) < 0) return report_missing(r, clause->source, "box", id), true;
        mark_box(r, &index->definitions->boxes.items[found], value);
    } else if (strcmp(option, "SET_PART") == 0) {
        mark_set(r, SET_PART, clause, id, value);
    } else if (strcmp(option, "SET_SHELL") == 0 && kind != SET_PART) {
        mark_set(r, SET_SHELL, clause, id, value);
    } else if (strcmp(option, "SET_NODE") == 0 && kind == SET_NODE) {
        mark_set(r, SET_NODE, clause, id, value);
    } else {
        return false;
    }
    return true;
}

static void report_option(Resolution *r, const SetClause *clause)
{
    r->status = -1;
    if (!r->report) return;
    diagnostics_add(r->diagnostics, SEVERITY_ERROR, clause->source, r->kind->keyword,
                    "set %d: option %s is not known here; known are %s", r->set->id, clause->option, r->kind->known);
}

static void mark_clause(Resolution *r, const SetClause *clause)
{
    if (strcmp(clause->option, "RANGE") == 0) {
        mark_range(r, clause);
        return;
    }
    if (strcmp(clause->option, "ALL") == 0) {
        memset(r->mark, 1, r->mark_count);
        return;
    }
    bool remove = clause->option[0] == 'D';
    for (int k = 0; k < 7; k++) {
        int id = (int)clause->e[k];
        if (id == 0) continue;
        if (!mark_entry(r, clause, clause->option + remove, id, !remove)) {
            report_option(r, clause);
            return;
        }
    }
}

/* Marks the members of one set. */
static int resolve_marks(const DeckIndex *index, SetKind kind, const SetDefinition *set, int depth, unsigned char *mark,
                         Diagnostics *diagnostics)
{
    if (depth > 16) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, set->source, KINDS[kind].keyword,
                        "set %d contains itself through other sets", set->id);
        return -1;
    }
    Resolution r = {index, &KINDS[kind], set,  first_report(index, set), depth,
                    0,     diagnostics,  mark, entity_count(index, kind)};
    const IdMap *map = map_of(index, kind);
    for (size_t m = 0; m < set->members.count; m++) {
        int32_t found = id_map_find(map, set->members.items[m]);
        if (found < 0) {
            report_missing(&r, set->source, KINDS[kind].noun, set->members.items[m]);
        } else {
            mark[found] = 1;
        }
    }
    for (size_t c = 0; c < set->clauses.count; c++) mark_clause(&r, &set->clauses.items[c]);
    return r.status;
}

static int compare_indices(const void *a, const void *b)
{
    int32_t p = *(const int32_t *)a, q = *(const int32_t *)b;
    return (p > q) - (p < q);
}

/* A plain list needs no marks: its members are sorted. */
static int resolve_list(const DeckIndex *index, SetKind kind, const SetDefinition *set, IndexList *out,
                        Diagnostics *diagnostics)
{
    Resolution r = {index, &KINDS[kind], set, first_report(index, set), 0, 0, diagnostics, NULL, 0};
    const IdMap *map = map_of(index, kind);
    for (size_t m = 0; m < set->members.count; m++) {
        int32_t found = id_map_find(map, set->members.items[m]);
        if (found < 0) {
            report_missing(&r, set->source, KINDS[kind].noun, set->members.items[m]);
        } else if (index_list_add(out, found)) {
            return out_of_memory(KINDS[kind].keyword, diagnostics);
        }
    }
    if (out->count > 1) qsort(out->items, out->count, sizeof *out->items, compare_indices);
    size_t kept = 0;
    for (size_t i = 0; i < out->count; i++) {
        if (kept == 0 || out->items[i] != out->items[kept - 1]) out->items[kept++] = out->items[i];
    }
    out->count = kept;
    return r.status;
}

static int collect_marks(const unsigned char *mark, size_t count, IndexList *out)
{
    out->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (mark[i] && index_list_add(out, (int32_t)i)) return -1;
    }
    return 0;
}

static int resolve_entities(const DeckIndex *index, SetKind kind, int set_id, Source user, const char *keyword,
                            IndexList *out, Diagnostics *diagnostics)
{
    out->count = 0;
    const SetDefinition *set = find_set(index, kind, set_id, user, keyword, diagnostics);
    if (!set) return -1;
    if (set->clauses.count == 0) return resolve_list(index, kind, set, out, diagnostics);
    size_t count = entity_count(index, kind);
    unsigned char *mark = memory_alloc(count + 1, 1);
    if (!mark) return out_of_memory(keyword, diagnostics);
    int status = resolve_marks(index, kind, set, 0, mark, diagnostics);
    if (collect_marks(mark, count, out)) status = out_of_memory(keyword, diagnostics);
    memory_free(mark);
    return status;
}

int sets_resolve_nodes(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                       Diagnostics *diagnostics)
{
    return resolve_entities(index, SET_NODE, set_id, user, keyword, out, diagnostics);
}

int sets_resolve_parts(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                       Diagnostics *diagnostics)
{
    return resolve_entities(index, SET_PART, set_id, user, keyword, out, diagnostics);
}

int sets_resolve_shells(const DeckIndex *index, int set_id, Source user, const char *keyword, IndexList *out,
                        Diagnostics *diagnostics)
{
    return resolve_entities(index, SET_SHELL, set_id, user, keyword, out, diagnostics);
}

int sets_part_nodes(const DeckIndex *index, const int32_t *parts, size_t part_count, IndexList *out)
{
    size_t count = entity_count(index, SET_NODE);
    out->count = 0;
    unsigned char *mark = memory_alloc(count + 1, 1);
    if (!mark) return -1;
    Resolution r = {index, &KINDS[SET_NODE], NULL, false, 0, 0, NULL, mark, count};
    for (size_t p = 0; p < part_count; p++) mark_part(&r, parts[p], 1);
    int status = collect_marks(mark, count, out);
    memory_free(mark);
    return status;
}
