/* Ids used twice: found by sorting, reported with both lines, the later records taken out. */
#include <stdlib.h>
#include <string.h>

#include "io/keyword_table.h"
#include "solver/memory.h"

/* One list of records whose first members are an id; sources at a fixed offset. */
typedef struct RecordList {
    char *items;
    size_t *count;
    size_t size, id_offset, source_offset;
    const char *keyword, *noun;
    int set_kind; /* -1, or only the sets of this kind */
} RecordList;

typedef struct Entry {
    int id;
    size_t place;
} Entry;

static int compare_entries(const void *a, const void *b)
{
    const Entry *p = a, *q = b;
    if (p->id != q->id) return p->id < q->id ? -1 : 1;
    return p->place < q->place ? -1 : p->place > q->place;
}

static int id_at(const RecordList *list, size_t place)
{
    int id;
    memcpy(&id, list->items + place * list->size + list->id_offset, sizeof id);
    return id;
}

static Source source_at(const RecordList *list, size_t place)
{
    Source source;
    memcpy(&source, list->items + place * list->size + list->source_offset, sizeof source);
    return source;
}

static bool takes_part(const RecordList *list, size_t place)
{
    if (id_at(list, place) == 0) return false; /* bags without _ID */
    if (list->set_kind < 0) return true;
    return (int)((const SetDefinition *)(const void *)(list->items + place * list->size))->kind == list->set_kind;
}

/* True if the ids rise from record to record, as in most decks: then none is used twice. */
static bool ascending(const RecordList *list)
{
    if (list->set_kind >= 0) return false;
    for (size_t i = 1; i < *list->count; i++)
        if (id_at(list, i) <= id_at(list, i - 1)) return false;
    return *list->count == 0 || id_at(list, 0) > 0;
}

static void report(const RecordList *list, size_t first, size_t second, Diagnostics *diagnostics)
{
    const Source a = source_at(list, first), b = source_at(list, second);
    const bool elsewhere = a.file != b.file && a.file >= 0 && (size_t)a.file < diagnostics->file_count;
    diagnostics_add(diagnostics, SEVERITY_ERROR, b, list->keyword,
                    "%s %d is defined a second time (first in line %d%s%s); give it another id or remove one of them",
                    list->noun, id_at(list, second), a.line, elsewhere ? " of " : "",
                    elsewhere ? diagnostics->files[a.file] : "");
}

static void free_members(const RecordList *list, size_t place)
{
    char *record = list->items + place * list->size;
    if (list->set_kind >= 0) {
        SetDefinition *set = (SetDefinition *)(void *)record;
        memory_free(set->members.items);
        memory_free(set->clauses.items);
        memory_free(set->segments.items);
    } else if (strcmp(list->noun, "curve") == 0) {
        CurveDefinition *curve = (CurveDefinition *)(void *)record;
        memory_free(curve->x.items);
        memory_free(curve->y.items);
        memory_free(curve->lines.items);
    } else if (strcmp(list->noun, "function") == 0) {
        memory_free(((FunctionDefinition *)(void *)record)->program.code);
    }
}

/* Takes the marked records out, keeping the order. */
static void remove_marked(const RecordList *list, const unsigned char *marked)
{
    size_t kept = 0;
    for (size_t i = 0; i < *list->count; i++) {
        if (marked[i]) {
            free_members(list, i);
            continue;
        }
        if (kept != i) memcpy(list->items + kept * list->size, list->items + i * list->size, list->size);
        kept++;
    }
    *list->count = kept;
}

static void check_list(const RecordList *list, Diagnostics *diagnostics)
{
    const size_t count = *list->count;
    if (ascending(list)) return;
    Entry *entries = memory_alloc(count + 1, sizeof *entries);
    unsigned char *marked = memory_alloc(count + 1, 1);
    size_t used = 0, repeated = 0;
    for (size_t i = 0; entries && marked && i < count; i++)
        if (takes_part(list, i)) entries[used++] = (Entry){id_at(list, i), i};
    if (used > 1) qsort(entries, used, sizeof *entries, compare_entries);
    for (size_t i = 1, first = 0; i < used; i++) {
        if (entries[i].id != entries[first].id) {
            first = i;
            continue;
        }
        report(list, entries[first].place, entries[i].place, diagnostics);
        marked[entries[i].place] = 1;
        repeated++;
    }
    if (repeated) remove_marked(list, marked);
    if (!entries || !marked)
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "out of memory while checking ids");
    memory_free(entries);
    memory_free(marked);
}

#define RECORDS(list, type, name, word, kind)                                                                          \
    {                                                                                                                  \
        (char *)d->list.items, &d->list.count, sizeof(type), offsetof(type, id), offsetof(type, source), name, word,   \
            kind                                                                                                       \
    }

void keyword_check_duplicates(Definitions *definitions, Diagnostics *diagnostics)
{
    Definitions *d = definitions;
    const RecordList lists[] = {
        RECORDS(nodes, NodeDefinition, "*NODE", "node", -1),
        RECORDS(shells, ShellDefinition, "*ELEMENT_SHELL", "shell", -1),
        RECORDS(solids, SolidDefinition, "*ELEMENT_SOLID", "solid", -1),
        RECORDS(solid_sections, SectionSolidDefinition, "*SECTION_SOLID", "section", -1),
        RECORDS(beams, BeamDefinition, "*ELEMENT_BEAM", "beam", -1),
        RECORDS(beam_sections, SectionBeamDefinition, "*SECTION_BEAM", "section", -1),
        RECORDS(discretes, DiscreteDefinition, "*ELEMENT_DISCRETE", "discrete element", -1),
        RECORDS(discrete_sections, SectionDiscreteDefinition, "*SECTION_DISCRETE", "section", -1),
        RECORDS(nodal_bodies, NodalRigidBodyDefinition, "*CONSTRAINED_NODAL_RIGID_BODY", "nodal rigid body", -1),
        RECORDS(parts, PartDefinition, "*PART", "part", -1),
        RECORDS(sections, SectionShellDefinition, "*SECTION_SHELL", "section", -1),
        RECORDS(materials, MaterialDefinition, "*MAT", "material", -1),
        RECORDS(hourglasses, HourglassDefinition, "*HOURGLASS", "hourglass control", -1),
        RECORDS(sets, SetDefinition, "*SET_NODE", "node set", SET_NODE),
        RECORDS(sets, SetDefinition, "*SET_PART", "part set", SET_PART),
        RECORDS(sets, SetDefinition, "*SET_SHELL", "shell set", SET_SHELL),
        RECORDS(sets, SetDefinition, "*SET_SEGMENT", "segment set", SET_SEGMENT),
        RECORDS(curves, CurveDefinition, "*DEFINE_CURVE", "curve", -1),
        RECORDS(functions, FunctionDefinition, "*DEFINE_FUNCTION", "function", -1),
        RECORDS(coordinates, CoordinateDefinition, "*DEFINE_COORDINATE", "coordinate system", -1),
        RECORDS(vectors, VectorDefinition, "*DEFINE_VECTOR", "vector", -1),
        RECORDS(boxes, BoxDefinition, "*DEFINE_BOX", "box", -1),
        RECORDS(airbags, AirbagDefinition, "*AIRBAG", "airbag", -1),
        RECORDS(walls, RigidWallDefinition, "*RIGIDWALL", "rigid wall", -1),
        RECORDS(contacts, ContactDefinition, "*CONTACT", "contact", -1),
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) check_list(&lists[i], diagnostics);
}
