/* Groups and blocks of elements: kernel constants, node tables. */
#include <math.h>
#include <string.h>

#include "elements/lane.h"
#include "elements/reference.h"
#include "solver/builder.h"
#include "solver/memory.h"

enum { LANES = BILLOW_LANES };

static bool same_group(const ShellRecord *a, const ShellRecord *b)
{
    return a->part == b->part && a->kind == b->kind && a->law == b->law && a->pressure_set == b->pressure_set &&
           a->reference == b->reference;
}

/* The class of reference of a group's elements. */
static void refer_group(Builder *b, const ShellRecord *r, ElementGroup *group)
{
    const ReferenceClass *class = &b->reference_classes.items[r->reference - 1];
    group->has_reference = true;
    group->birth = class->birth;
    group->rdt = class->rdt;
    group->rule = b->parts[r->part].reference_rule;
    b->model->has_reference = true;
    b->model->liner_waits |= group->rule.liner_waits;
}

/* Cuts the element order into groups. */
static int cut_groups(Builder *b)
{
    Model *m = b->model;
    int count = 0;
    for (int i = 0; i < b->record_count; i++)
        if (i == 0 || !same_group(&b->records[b->order[i]], &b->records[b->order[i - 1]])) count++;
    m->groups = builder_alloc(b, (size_t)count + 1, sizeof *m->groups);
    if (!m->groups) return -1;
    ElementGroup *group = m->groups - 1;
    for (int i = 0; i < b->record_count; i++) {
        const ShellRecord *r = &b->records[b->order[i]];
        if (i == 0 || !same_group(r, &b->records[b->order[i - 1]])) {
            group++;
            group->kind = r->kind;
            group->law = r->law;
            group->part = r->part;
            group->pressure_set = r->pressure_set;
            group->corner_count = r->corner_count;
            group->point_count = r->kind == ELEMENT_QUAD_FULL ? 4 : 1;
            if (r->law != LAW_SURFACE) group->material = b->parts[r->part].fabric;
            if (r->reference > 0) refer_group(b, r, group);
        }
        group->element_count++;
    }
    m->group_count = count;
    return 0;
}

/* Offsets of each group in the shared arrays. */
static void place_groups(Model *m)
{
    for (int g = 0; g < m->group_count; g++) {
        ElementGroup *group = &m->groups[g];
        group->block_count = (group->element_count + LANES - 1) / LANES;
        group->geometry_size = geometry_size(group->kind, group->law);
        m->has_accounts |= law_keeps_account(group->law, &group->material);
        group->has_history = law_has_history(group->law, &group->material);
        group->history_size = group->has_history ? history_size(group->point_count) : 0;
        group->history_size += group->point_count * law_memory_size(group->law, &group->material);
        group->first_element = m->padded_count;
        group->first_chunk = m->chunk_count;
        group->history_offset = m->history_size;
        size_t blocks = (size_t)group->block_count;
        m->padded_count += group->block_count * LANES;
        m->chunk_count += (group->block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK;
        m->history_size += blocks * (size_t)group->history_size * LANES;
    }
}

static const char *geometry_problem(GeometryStatus status)
{
    switch (status) {
    case GEOMETRY_ZERO_AREA:
        return "has no area: its nodes lie on a line or in one point; remove it or move its nodes";
    case GEOMETRY_INVERTED:
        return "is inverted: its corners do not go round a convex quadrilateral; reorder its nodes";
    case GEOMETRY_NO_FIBRE:
        return "is normal to its fibre direction (AOPT), which cannot be projected; choose another";
    case GEOMETRY_OK:
        break;
    }
    return "";
}

ElementInput record_input(const Builder *b, int record, const double *positions, Geometry which, double *x)
{
    const ShellRecord *r = &b->records[record];
    for (int a = 0; a < r->corner_count; a++)
        for (int k = 0; k < 3; k++) x[3 * a + k] = positions[3 * r->node[a] + k];
    bool refers = r->reference > 0 && which != GEOMETRY_MESH;
    ElementInput input = {.kind = r->kind,
                          .x = refers ? b->references[record].x : x,
                          .start = refers && which == GEOMETRY_REFERENCE ? x : NULL,
                          .thickness = r->thickness,
                          .mass = r->mass,
                          .axis = r->axis,
                          .law = r->law == LAW_SURFACE ? NULL : &b->parts[r->part].fabric};
    return input;
}

/* The record of a group's lane; lanes beyond the last element repeat it. */
static int lane_record(const Builder *b, const ElementGroup *group, int first, int e)
{
    return b->order[first + (e < group->element_count ? e : group->element_count - 1)];
}

/* Fills a group's constants from one geometry; lanes beyond the last element have weight and sign 0. -1 without memory,
 * 1 after an error of the deck. */
static int fill_geometry(Builder *b, const ElementGroup *group, int first, Geometry which, double **filled)
{
    size_t size = (size_t)group->block_count * (size_t)group->geometry_size * LANES;
    double *geometry = builder_alloc(b, size, sizeof *geometry);
    int status = geometry ? 0 : -1;
    *filled = geometry;
    for (int e = 0; status >= 0 && e < group->block_count * LANES; e++) {
        bool real = e < group->element_count;
        int record = lane_record(b, group, first, e);
        double x[12];
        ElementInput input = record_input(b, record, b->model->initial, which, x);
        double *out = geometry + (size_t)(e / LANES) * (size_t)group->geometry_size * LANES + e % LANES;
        GeometryStatus problem = geometry_fill(&input, real ? b->records[record].orientation : 0.0, out);
        if (problem != GEOMETRY_OK && real) {
            const ShellDefinition *shell = &b->definitions->shells.items[record];
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, shell->source, "*ELEMENT_SHELL", "element %d %s", shell->id,
                            geometry_problem(problem));
            status = 1;
        }
        if (real || group->law == LAW_SURFACE) continue;
        for (int p = 0; p < group->point_count; p++) out[(p * GEOMETRY_POINT_SIZE + GEOMETRY_WEIGHT) * LANES] = 0.0;
        for (int i = group->point_count * GEOMETRY_POINT_SIZE; i < group->geometry_size; i++) out[i * LANES] = 0.0;
    }
    return status;
}

/* How far each element is shrunk in the mesh. */
static int fill_start(Builder *b, ElementGroup *group)
{
    double *square = builder_alloc(b, (size_t)group->block_count * LANES, sizeof *square);
    if (!square) return -1;
    for (int64_t e = 0; e < group->element_count; e++)
        square[e] = reference_least_square(group, group->geometry + lane_offset(group, e), b->model->initial, e);
    group->start_square = square;
    return 0;
}

/* Fills one group's node table and constants: of the reference, and what else a run needs. */
static int fill_group(Builder *b, ElementGroup *group, int first)
{
    Model *m = b->model;
    size_t corners = (size_t)group->corner_count;
    int32_t *node = builder_alloc(b, (size_t)group->block_count * corners * LANES, sizeof *node);
    if (!node) return -1;
    for (int e = 0; e < group->block_count * LANES; e++) {
        int record = lane_record(b, group, first, e);
        for (size_t a = 0; a < corners; a++)
            node[((size_t)(e / LANES) * corners + a) * LANES + (size_t)(e % LANES)] = b->records[record].node[a];
        if (e < group->element_count && record < b->shell_count) m->element_slot[record] = group->first_element + e;
    }
    group->node = node;
    const Geometry acts = group->rule.keeps_tension ? GEOMETRY_TENSION : GEOMETRY_REFERENCE;
    double **constants = b->constants + (ptrdiff_t)GEOMETRY_COUNT * (group - m->groups);
    int status = fill_geometry(b, group, first, acts, &constants[acts]);
    group->geometry = constants[acts];
    if (status >= 0 && group->has_reference && group->birth > 0.0) {
        int mesh = fill_geometry(b, group, first, GEOMETRY_MESH, &constants[GEOMETRY_MESH]);
        status = mesh < 0 ? mesh : status | mesh;
        group->mesh_geometry = constants[GEOMETRY_MESH];
    }
    if (!status && group->has_reference) status = fill_start(b, group);
    if (status >= 0 && group->has_reference && group->rule.restore != RESTORE_NEVER) {
        int tension = fill_geometry(b, group, first, GEOMETRY_TENSION, &constants[GEOMETRY_TENSION]);
        status = tension < 0 ? tension : status | tension;
        group->tension_geometry = constants[GEOMETRY_TENSION];
    }
    return status;
}

/* The shells as the writers see them, in deck order. */
static int fill_elements(Builder *b)
{
    Model *m = b->model;
    size_t n = (size_t)b->shell_count;
    m->element_count = b->shell_count;
    m->element_id = builder_alloc(b, n, sizeof *m->element_id);
    m->element_part = builder_alloc(b, n, sizeof *m->element_part);
    m->element_node = builder_alloc(b, 4 * n, sizeof *m->element_node);
    m->element_slot = builder_alloc(b, n, sizeof *m->element_slot);
    m->element_thickness = builder_alloc(b, n, sizeof *m->element_thickness);
    m->element_mass = builder_alloc(b, n, sizeof *m->element_mass);
    if (!m->element_id || !m->element_part || !m->element_node || !m->element_slot || !m->element_thickness ||
        !m->element_mass)
        return -1;
    for (size_t i = 0; i < n; i++) {
        const ShellRecord *r = &b->records[i];
        m->element_id[i] = b->definitions->shells.items[i].id;
        m->element_part[i] = r->part;
        for (size_t a = 0; a < 4; a++)
            m->element_node[4 * i + a] = r->corner_count == 3 && a == 3 ? r->node[2] : r->node[a];
        m->element_thickness[i] = r->thickness;
        m->element_mass[i] = r->mass;
        m->deformable_count += r->law != LAW_SURFACE;
    }
    return 0;
}

int build_groups(Builder *b)
{
    Model *m = b->model;
    if (fill_elements(b) || cut_groups(b)) return -1;
    place_groups(m);
    b->constants = builder_alloc(b, (size_t)GEOMETRY_COUNT * (size_t)m->group_count, sizeof *b->constants);
    if (!b->constants) return -1;
    int first = 0, status = 0;
    for (int g = 0; g < m->group_count; g++) {
        int filled = fill_group(b, &m->groups[g], first);
        if (filled < 0) return -1;
        status |= filled;
        first += m->groups[g].element_count;
    }
    return status || build_implicit(b) || build_rows(b) ? -1 : 0;
}

/* The largest squared frequency of an element: before and after the birth of its reference geometry, with its initial
 * tension where that comes back or stays. */
static double scaling_rate(const Builder *b, int record)
{
    const ShellRecord *r = &b->records[record];
    const ReferenceRule *rule = &b->parts[r->part].reference_rule;
    const bool tension = rule->keeps_tension || rule->restore != RESTORE_NEVER;
    double largest = 0.0, x[12];
    if (!(r->mass > 0.0)) return 0.0;
    for (Geometry which = GEOMETRY_MESH; which <= (tension ? GEOMETRY_TENSION : GEOMETRY_REFERENCE); which++) {
        if (which == GEOMETRY_MESH && r->reference > 0 && b->references[record].birth <= 0.0) continue;
        ElementInput input = record_input(b, record, b->x, which, x);
        double rate = geometry_rate(&input);
        largest = rate > largest ? rate : largest;
        if (r->reference == 0) break;
    }
    return largest;
}

/* DT2MS: mass is added to elements whose step is below the target (negative), or every element gets it (positive). */
int build_mass_scaling(Builder *b)
{
    double wish = b->definitions->control.timestep.dt2ms, target = fabs(wish), before = 0.0, after = 0.0;
    if (!b->definitions->control.timestep.given || wish == 0.0) return 0;
    int count = 0;
    for (int i = 0; i < b->record_count; i++) {
        ShellRecord *r = &b->records[i];
        if (r->law == LAW_SURFACE) continue;
        double rate = scaling_rate(b, i), step = rate > 0.0 ? 2.0 / sqrt(rate) : 0.0;
        if (!(step > 0.0) || (wish < 0.0 && step >= target)) continue;
        double factor = (target / step) * (target / step), added = (factor - 1.0) * r->mass;
        before += r->mass;
        after += r->mass + added;
        r->mass += added;
        b->model->parts[r->part].mass += added;
        b->model->added_mass += added;
        count++;
    }
    if (count)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, b->definitions->control.timestep.source, "*CONTROL_TIMESTEP",
                        "DT2MS = %g scales the mass of %d elements from %.6g to %.6g (%+.3g %%)", wish, count, before,
                        after, 100.0 * (after - before) / before);
    return 0;
}
