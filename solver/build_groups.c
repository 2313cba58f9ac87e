/* Groups and blocks of elements: kernel constants, node tables. */
#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/builder.h"
#include "solver/memory.h"

enum { LANES = BILLOW_LANES };

static bool same_group(const ShellRecord *a, const ShellRecord *b)
{
    return a->part == b->part && a->kind == b->kind && a->law == b->law && a->pressure_set == b->pressure_set;
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

/* Kernel input of one record; x receives the corners. */
static ElementInput record_input(const Builder *b, const ShellRecord *r, const double *positions, double *x)
{
    for (int a = 0; a < r->corner_count; a++)
        for (int k = 0; k < 3; k++) x[3 * a + k] = positions[3 * r->node[a] + k];
    ElementInput input = {.kind = r->kind,
                          .x = x,
                          .thickness = r->thickness,
                          .mass = r->mass,
                          .axis = r->axis,
                          .law = r->law == LAW_SURFACE ? NULL : &b->parts[r->part].fabric};
    return input;
}

/* Fills one group's node table and constants; lanes beyond the last element repeat it with weight and sign 0. */
static int fill_group(Builder *b, ElementGroup *group, int first)
{
    Model *m = b->model;
    size_t blocks = (size_t)group->block_count;
    int32_t *node = builder_alloc(b, blocks * (size_t)group->corner_count * LANES, sizeof *node);
    double *geometry = builder_alloc(b, blocks * (size_t)group->geometry_size * LANES, sizeof *geometry);
    int status = node && geometry ? 0 : -1;
    for (int e = 0; !status && e < group->block_count * LANES; e++) {
        bool real = e < group->element_count;
        int record = b->order[first + (real ? e : group->element_count - 1)];
        const ShellRecord *r = &b->records[record];
        size_t block = (size_t)e / LANES, lane = (size_t)e % LANES;
        for (int a = 0; a < group->corner_count; a++)
            node[(block * (size_t)group->corner_count + (size_t)a) * LANES + lane] = r->node[a];
        if (real && record < b->shell_count) m->element_slot[record] = group->first_element + e;
        double x[12];
        ElementInput input = record_input(b, r, m->reference, x);
        double *out = geometry + block * (size_t)group->geometry_size * LANES + lane;
        GeometryStatus problem = geometry_fill(&input, real ? r->orientation : 0.0, out);
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
    group->node = node;
    group->geometry = geometry;
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
    int first = 0, status = 0;
    for (int g = 0; g < m->group_count; g++) {
        int filled = fill_group(b, &m->groups[g], first);
        if (filled < 0) return -1;
        status |= filled;
        first += m->groups[g].element_count;
    }
    return status || build_rows(b) ? -1 : 0;
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
        double x[12];
        ElementInput input = record_input(b, r, b->x, x);
        double rate = r->mass > 0.0 ? geometry_rate(&input) : 0.0, step = rate > 0.0 ? 2.0 / sqrt(rate) : 0.0;
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
