/* Look-up tables of one deck's ids, with a check that no id is used twice. */
#include "solver/deck_index.h"

#include <string.h>

#include "solver/memory.h"

/* One list of Definitions: its map, records and names for messages. */
typedef struct IndexTask {
    IdMap *map;
    const int *first_id;
    const Source *first_source;
    size_t count, stride;
    const char *keyword, *noun;
} IndexTask;

static const Source *source_of(const IndexTask *task, int32_t index)
{
    return (const Source *)(const void *)((const char *)task->first_source + (size_t)index * task->stride);
}

static void report_duplicate(const IndexTask *task, int32_t repeated, Diagnostics *diagnostics)
{
    int id = *(const int *)(const void *)((const char *)task->first_id + (size_t)repeated * task->stride);
    const Source *before = source_of(task, id_map_find(task->map, id));
    const Source *here = source_of(task, repeated);
    bool named = before->file >= 0 && (size_t)before->file < diagnostics->file_count && before->file != here->file;
    diagnostics_add(diagnostics, SEVERITY_ERROR, *here, task->keyword,
                    "%s %d is defined a second time (first in line %d%s%s); give it another id or remove one of them",
                    task->noun, id, before->line, named ? " of " : "", named ? diagnostics->files[before->file] : "");
}

/* Builds one map; each list reports its first repeated id. */
static int run_task(const IndexTask *task, Diagnostics *diagnostics)
{
    int32_t repeated = -1;
    if (id_map_build(task->map, task->first_id, task->count, task->stride, &repeated)) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, task->keyword,
                        "not enough memory for the table of ids");
        return -1;
    }
    if (repeated < 0) return 0;
    report_duplicate(task, repeated, diagnostics);
    return -1;
}

#define INDEX_TASK(MAP, LIST, KEYWORD, NOUN)                                                                           \
    {                                                                                                                  \
        &index->MAP, d->LIST.count ? &d->LIST.items->id : NULL, d->LIST.count ? &d->LIST.items->source : NULL,         \
            d->LIST.count, sizeof *d->LIST.items, KEYWORD, NOUN                                                        \
    }

static int index_lists(DeckIndex *index, Diagnostics *diagnostics)
{
    const Definitions *d = index->definitions;
    const IndexTask tasks[] = {
        INDEX_TASK(nodes, nodes, "*NODE", "node"),
        INDEX_TASK(shells, shells, "*ELEMENT_SHELL", "shell"),
        INDEX_TASK(solids, solids, "*ELEMENT_SOLID", "solid"),
        INDEX_TASK(parts, parts, "*PART", "part"),
        INDEX_TASK(materials, materials, "*MAT", "material"),
        INDEX_TASK(curves, curves, "*DEFINE_CURVE", "curve"),
        INDEX_TASK(functions, functions, "*DEFINE_FUNCTION", "function"),
        INDEX_TASK(coordinates, coordinates, "*DEFINE_COORDINATE", "coordinate system"),
        INDEX_TASK(vectors, vectors, "*DEFINE_VECTOR", "vector"),
        INDEX_TASK(boxes, boxes, "*DEFINE_BOX", "box"),
    };
    int status = 0;
    for (size_t t = 0; t < sizeof tasks / sizeof *tasks; t++) {
        IndexTask task = tasks[t];
        if (task.map == &index->shells) task.count -= d->face_count; /* faces of solids have no numbers of their own */
        if (task.count > 0 && run_task(&task, diagnostics)) status = -1;
    }
    return status;
}

/* Sets of one kind: ids are gathered first, since the kinds share one list. */
static int index_sets(DeckIndex *index, SetKind kind, Diagnostics *diagnostics)
{
    static const char *const keywords[] = {"*SET_NODE", "*SET_PART", "*SET_SHELL", "*SET_SEGMENT"};
    static const char *const nouns[] = {"node set", "part set", "shell set", "segment set"};
    const Definitions *d = index->definitions;
    typedef struct SetPlace {
        int id;
        int32_t set;
        Source source;
    } SetPlace;
    if (d->sets.count == 0) return 0;
    SetPlace *places = memory_alloc(d->sets.count, sizeof *places);
    if (!places) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, keywords[kind],
                        "not enough memory for the table of ids");
        return -1;
    }
    size_t count = 0;
    for (size_t s = 0; s < d->sets.count; s++) {
        if (d->sets.items[s].kind != kind) continue;
        places[count++] = (SetPlace){d->sets.items[s].id, (int32_t)s, d->sets.items[s].source};
    }
    IndexTask task = {&index->sets[kind], &places->id,    &places->source, count,
                      sizeof *places,     keywords[kind], nouns[kind]};
    int status = count > 0 ? run_task(&task, diagnostics) : 0;
    for (size_t k = 0; k < index->sets[kind].count; k++) {
        index->sets[kind].index[k] = places[index->sets[kind].index[k]].set;
    }
    memory_free(places);
    return status;
}

/* Shells of each part in compressed rows. */
static int index_part_shells(DeckIndex *index, Diagnostics *diagnostics)
{
    const Definitions *d = index->definitions;
    index->part_shell_start = memory_alloc(d->parts.count + 1, sizeof *index->part_shell_start);
    index->part_shell = memory_alloc(d->shells.count + 1, sizeof *index->part_shell);
    index->set_reported = memory_alloc(d->sets.count + 1, sizeof *index->set_reported);
    int32_t *part_of = memory_alloc(d->shells.count + 1, sizeof *part_of);
    if (!index->part_shell_start || !index->part_shell || !index->set_reported || !part_of) {
        memory_free(part_of);
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, "*PART",
                        "not enough memory for the table of shells");
        return -1;
    }
    for (size_t e = 0; e < d->shells.count; e++) {
        part_of[e] = id_map_find(&index->parts, d->shells.items[e].part);
        if (part_of[e] >= 0) index->part_shell_start[part_of[e] + 1]++;
    }
    for (size_t p = 0; p < d->parts.count; p++) index->part_shell_start[p + 1] += index->part_shell_start[p];
    for (size_t e = 0; e < d->shells.count; e++) {
        if (part_of[e] >= 0) index->part_shell[index->part_shell_start[part_of[e]]++] = (int32_t)e;
    }
    for (size_t p = d->parts.count; p > 0; p--) index->part_shell_start[p] = index->part_shell_start[p - 1];
    index->part_shell_start[0] = 0;
    memory_free(part_of);
    return 0;
}

int deck_index_build(DeckIndex *index, const Definitions *definitions, Diagnostics *diagnostics)
{
    memset(index, 0, sizeof *index);
    index->definitions = definitions;
    int status = index_lists(index, diagnostics);
    for (int kind = SET_NODE; kind <= SET_SEGMENT; kind++) {
        if (index_sets(index, (SetKind)kind, diagnostics)) status = -1;
    }
    if (index_part_shells(index, diagnostics)) status = -1;
    return status;
}

int deck_index_curve(const DeckIndex *index, int curve_id, const char *field, Source source, const char *keyword,
                     Diagnostics *diagnostics)
{
    int32_t found = curve_id > 0 ? id_map_find(&index->curves, curve_id) : -1;
    if (found >= 0) return (int)found;
    if (curve_id > 0 && id_map_find(&index->functions, curve_id) >= 0) {
        diagnostics_add(
            diagnostics, SEVERITY_ERROR, source, keyword,
            "%s = %d is a function; this field takes only a *DEFINE_CURVE (docs/functions.md says which take "
            "functions)",
            field, curve_id);
    } else if (curve_id == 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                        "%s is 0 or blank; give the id of a *DEFINE_CURVE", field);
    } else {
        diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                        "%s = %d: there is no curve of this id; add a *DEFINE_CURVE or correct the id", field,
                        curve_id);
    }
    return -1;
}

int deck_index_curve_or_function(const DeckIndex *index, int curve_id, const char *field, Source source,
                                 const char *keyword, Diagnostics *diagnostics)
{
    int32_t function = curve_id > 0 ? id_map_find(&index->functions, curve_id) : -1;
    if (function < 0) return deck_index_curve(index, curve_id, field, source, keyword, diagnostics);
    if (id_map_find(&index->curves, curve_id) < 0) return 2 * (int)index->definitions->curves.count + (int)function;
    diagnostics_add(diagnostics, SEVERITY_ERROR, source, keyword,
                    "%s = %d is a curve and a function; give one of them another id", field, curve_id);
    return -1;
}

void deck_index_free(DeckIndex *index)
{
    IdMap *maps[] = {&index->nodes,     &index->shells, &index->parts,       &index->materials, &index->solids,
                     &index->functions, &index->curves, &index->coordinates, &index->vectors,   &index->boxes};
    for (size_t m = 0; m < sizeof maps / sizeof *maps; m++) id_map_free(maps[m]);
    for (int kind = 0; kind < 4; kind++) id_map_free(&index->sets[kind]);
    memory_free(index->part_shell_start);
    memory_free(index->part_shell);
    memory_free(index->set_reported);
    memset(index, 0, sizeof *index);
}
