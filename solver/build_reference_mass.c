/* What follows from the reference geometries: classes of shells, areas, and the mass that counts (eq. R2). */
#include "solver/builder.h"
#include "solver/memory.h"

enum { LISTED = 200 }; /* messages: the first ones tell what is wrong */

/* Shells of a part whose reference is born after the start: their mass by the mesh, which counts, and as cut. */
typedef struct LateMass {
    double mesh, cut;
    Source source; /* of the first one */
    const char *keyword;
} LateMass;

/* The number of the pair of birth and RDT, from 1. */
static int reference_class(Builder *b, double birth, bool rdt)
{
    for (size_t i = 0; i < b->reference_classes.count; i++)
        if (b->reference_classes.items[i].birth == birth && b->reference_classes.items[i].rdt == rdt) return (int)i + 1;
    if (memory_reserve((void **)&b->reference_classes.items, &b->reference_classes.capacity,
                       b->reference_classes.count + 1, sizeof *b->reference_classes.items))
        return -1;
    b->reference_classes.items[b->reference_classes.count++] = (ReferenceClass){birth, rdt};
    return (int)b->reference_classes.count;
}

/* Mass and area by the reference; the mass counts if the reference acts from the start (eq. R2). */
static int finish_shell(Builder *b, int i, LateMass *late, int *listed)
{
    ShellRecord *record = &b->records[i];
    const ShellReference *reference = &b->references[i];
    const PartRecord *part = &b->parts[record->part];
    Part *sums = &b->model->parts[record->part];
    if (!reference->given) return 0;
    ElementInput input = {.kind = record->kind, .x = reference->x, .axis = record->axis, .law = &part->fabric};
    GeometryStatus problem = geometry_check(&input);
    if (problem != GEOMETRY_OK) {
        if (++*listed > LISTED) return -1;
        diagnostics_add(
            b->diagnostics, SEVERITY_ERROR, reference->source, reference->keyword, "element %d %s",
            b->definitions->shells.items[i].id,
            problem == GEOMETRY_ZERO_AREA
                ? "has no area in the reference geometry: its nodes lie on a line or in one point there; correct "
                  "their coordinates, or take the element out of both geometries"
            : problem == GEOMETRY_INVERTED
                ? "is inverted in the reference geometry: its corners do not go round a convex quadrilateral; "
                  "correct the coordinates or the order of its nodes"
                : "is normal to its fibre direction (AOPT) in the reference geometry; choose another direction");
        return -1;
    }
    record->reference = reference_class(b, reference->birth, reference->rdt);
    if (record->reference < 0) return -1;
    double area = geometry_area(record->corner_count, reference->x);
    double mass = area * (part->density * record->thickness + part->area_density);
    sums->reference_count++;
    sums->reference_area += area;
    sums->reference_mass += mass;
    sums->referred_area += record->area;
    sums->referred_mass += record->mass;
    if (reference->birth > 0.0) {
        late += record->part;
        if (!late->keyword) *late = (LateMass){.source = reference->source, .keyword = reference->keyword};
        late->mesh += record->mass;
        late->cut += mass;
        return 0;
    }
    sums->mass += mass - record->mass;
    record->mass = mass;
    return 0;
}

/* Cloth that is born later keeps the mesh's mass: of a strongly shrunken one a small share of its own. */
static void warn_of_light_cloth(const Builder *b, const LateMass *late)
{
    for (int p = 0; p < b->model->part_count; p++, late++) {
        if (!(late->mesh < 0.5 * late->cut)) continue;
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, late->source, late->keyword,
                        "part %d weighs %.4g for the whole run, by the mesh, because its reference is born after the "
                        "start; as cut it weighs %.4g: so light a cloth flutters and takes short steps; without BIRTH "
                        "and RGBRTH it has the weight as cut",
                        b->model->parts[p].id, late->mesh, late->cut);
    }
}

int build_reference_mass(Builder *b)
{
    LateMass *late = memory_alloc((size_t)b->model->part_count + 1, sizeof *late);
    if (!late) return -1;
    int status = 0, listed = 0;
    for (int i = 0; i < b->shell_count; i++)
        if (finish_shell(b, i, late, &listed)) status = -1;
    warn_of_light_cloth(b, late);
    memory_free(late);
    return status;
}
