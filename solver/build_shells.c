/* Shells of the deck -> records with nodes, kind, thickness, area and mass; lumped nodal masses. */
#include <math.h>
#include <stdio.h>

#include "solver/builder.h"
#include "solver/coordinates.h"
#include "solver/memory.h"

static const double degree = 0.017453292519943295;

/* A node that shells name and the deck does not define; reported once, at the first shell. */
typedef struct MissingNode {
    int node, corner, uses;
    const ShellDefinition *shell;
} MissingNode;

typedef LIST(MissingNode) MissingNodes;

static void note_missing(MissingNodes *missing, const ShellDefinition *shell, int corner)
{
    for (size_t i = 0; i < missing->count; i++) {
        if (missing->items[i].node != shell->node[corner]) continue;
        missing->items[i].uses++;
        return;
    }
    if (missing->count == 200) return; /* the first ones tell what is wrong */
    if (memory_reserve((void **)&missing->items, &missing->capacity, missing->count + 1, sizeof *missing->items))
        return;
    missing->items[missing->count++] = (MissingNode){shell->node[corner], corner, 1, shell};
}

static void report_missing(Builder *b, MissingNodes *missing)
{
    for (size_t i = 0; i < missing->count; i++) {
        const MissingNode *m = &missing->items[i];
        char others[64] = "";
        if (m->uses > 1)
            snprintf(others, sizeof others, " (and %d more element%s)", m->uses - 1, m->uses == 2 ? "" : "s");
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, m->shell->source, "*ELEMENT_SHELL",
                        "element %d%s names node N%d = %d, which the deck does not define; add it under *NODE or "
                        "correct the element",
                        m->shell->id, others, m->corner + 1, m->node);
    }
    memory_free(missing->items);
}

static int shell_nodes(Builder *b, const ShellDefinition *shell, ShellRecord *record, MissingNodes *missing)
{
    int status = 0;
    record->corner_count = shell->node[3] == shell->node[2] ? 3 : 4;
    for (int a = 0; a < 4; a++) {
        record->node[a] = id_map_find(&b->index.nodes, shell->node[a]);
        if (record->node[a] >= 0 || (a == 3 && record->corner_count == 3)) continue;
        if (!shell->is_face) note_missing(missing, shell, a); /* solids have messages of their own */
        status = -1;
    }
    return status;
}

/* The mean of the corner thicknesses, from the element's own card or the section. */
static double shell_thickness(const ShellDefinition *shell, const SectionShellDefinition *section, int corners)
{
    double sum = 0.0;
    for (int a = 0; a < corners; a++) {
        double t = shell->thickness[a] > 0.0 ? shell->thickness[a] : section->t[a];
        sum += t > 0.0 ? t : section->t[0];
    }
    return sum / corners;
}

static double corner_area(const Builder *b, const ShellRecord *record)
{
    double corner[12];
    for (int a = 0; a < record->corner_count; a++)
        for (int k = 0; k < 3; k++) corner[3 * a + k] = b->x[3 * record->node[a] + k];
    return geometry_area(record->corner_count, corner);
}

/* A face of a solid: a surface without mass. */
static int face_record(Builder *b, ShellRecord *record)
{
    record->law = LAW_SURFACE;
    record->kind = record->corner_count == 3 ? ELEMENT_TRIANGLE : ELEMENT_QUAD_FULL;
    record->area = corner_area(b, record);
    record->pressure_set = -1;
    record->orientation = 1;
    return 0;
}

static int shell_record(Builder *b, const ShellDefinition *shell, ShellRecord *record, MissingNodes *missing)
{
    record->part = id_map_find(&b->index.parts, shell->part);
    if (record->part < 0) {
        if (!shell->is_face)
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, shell->source, "*ELEMENT_SHELL",
                            "element %d belongs to part PID = %d, which the deck does not define", shell->id,
                            shell->part);
        return -1;
    }
    if (shell_nodes(b, shell, record, missing)) return -1;
    const PartRecord *part = &b->parts[record->part];
    if (shell->is_face) return face_record(b, record);
    if (part->kind != SECTION_SHELL && part->kind != SECTION_NONE)
        diagnostics_add(
            b->diagnostics, SEVERITY_ERROR, shell->source, "*ELEMENT_SHELL",
            "element %d belongs to part %d, whose section is none for shells; give the part a *SECTION_SHELL",
            shell->id, shell->part);
    if (part->kind != SECTION_SHELL || part->material < 0) return -1;
    record->law = part->law;
    record->kind = record->corner_count == 3 ? ELEMENT_TRIANGLE : part->quad;
    record->axis = part->axis;
    record->axis.angle = shell->has_beta ? shell->beta * degree : part->angle;
    if (shell->mcid) {
        CoordinateSystem system;
        if (coordinates_resolve_system(&b->index, shell->mcid, shell->source, "*ELEMENT_SHELL_MCID", &system,
                                       b->diagnostics))
            return -1;
        record->axis.kind = FIBRE_VECTOR;
        for (int k = 0; k < 3; k++) record->axis.vector[k] = system.axes[k];
    }
    const SectionShellDefinition *section = &b->definitions->sections.items[part->section];
    record->thickness = shell_thickness(shell, section, record->corner_count);
    if (!(record->thickness > 0.0) && record->law != LAW_SURFACE) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, section->source, "*SECTION_SHELL",
                        "thickness T1 of section %d is %g; element %d of part %d needs a positive one", section->id,
                        section->t[0], shell->id, shell->part);
        return -1;
    }
    record->area = corner_area(b, record);
    record->mass = record->area * (part->density * record->thickness + part->area_density);
    record->pressure_set = -1;
    record->orientation = 1;
    return 0;
}

/* Zero areas and inverted quads are found when kernel constants are made; here only what mass and surfaces need. */
int build_shells(Builder *b)
{
    const Definitions *d = b->definitions;
    MissingNodes missing = {0};
    int status = 0;
    b->shell_count = (int)d->shells.count;
    b->node_count = (int)d->nodes.count;
    if (d->nodes.count == 0 || d->shells.count == 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, (Source){0, 0}, NULL,
                        "the deck defines %zu nodes and %zu shells; a run needs both (*NODE, *ELEMENT_SHELL)",
                        d->nodes.count, d->shells.count);
        return -1;
    }
    b->x = memory_alloc(d->nodes.count * 3, sizeof *b->x);
    b->mass = memory_alloc(d->nodes.count, sizeof *b->mass);
    if (!b->x || !b->mass ||
        memory_reserve((void **)&b->records, &b->record_capacity, d->shells.count, sizeof *b->records)) {
        diagnostics_add(b->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory for the model");
        return -1;
    }
    for (size_t i = 0; i < d->nodes.count; i++)
        for (int k = 0; k < 3; k++) b->x[3 * i + (size_t)k] = d->nodes.items[i].x[k];
    for (size_t i = 0; i < d->shells.count; i++) {
        b->records[i] = (ShellRecord){0};
        if (shell_record(b, &d->shells.items[i], &b->records[i], &missing)) status = -1;
    }
    report_missing(b, &missing);
    if (status) return -1;
    b->record_count = b->shell_count;
    for (int i = 0; i < b->shell_count; i++) {
        const ShellRecord *record = &b->records[i];
        Part *part = &b->model->parts[record->part];
        part->mass += record->mass;
        part->area += record->area;
        part->element_count++;
    }
    return 0;
}
