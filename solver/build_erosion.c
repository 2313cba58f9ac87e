/* *MAT_ADD_EROSION: criteria of the groups, and the facets of the bags that can go. */
#include <math.h>
#include <string.h>

#include "solver/builder.h"

#define KEYWORD "*MAT_ADD_EROSION"

#define REFUSE(b, card, ...) diagnostics_add((b)->diagnostics, SEVERITY_ERROR, (card)->source, KEYWORD, __VA_ARGS__)

static void set_criterion(ErosionCriteria *e, unsigned bit, double value, bool given, double *limit)
{
    *limit = value;
    if (given) e->active |= bit;
}

static ErosionCriteria criteria_of(const ErosionDefinition *d)
{
    ErosionCriteria e = {.needed = d->ncs > 1.0 ? (int)d->ncs : 1,
                         .end = d->failtm != 0.0 ? fabs(d->failtm) : INFINITY};
    set_criterion(&e, EROSION_LEAST_STRAIN, d->mneps, d->mneps != d->excl && d->mneps != 0.0, &e.least_strain);
    set_criterion(&e, EROSION_EFFECTIVE_STRAIN, d->effeps, d->effeps != d->excl && d->effeps != 0.0,
                  &e.effective_strain);
    set_criterion(&e, EROSION_LARGEST_STRAIN, d->mxeps, d->mxeps != d->excl, &e.largest_strain);
    set_criterion(&e, EROSION_SHEAR_STRAIN, d->epssh, d->epssh != d->excl, &e.shear_strain);
    set_criterion(&e, EROSION_LARGEST_STRESS, d->sigp1, d->sigp1 != d->excl, &e.largest_stress);
    set_criterion(&e, EROSION_EQUIVALENT_STRESS, d->sigvm, d->sigvm != d->excl, &e.equivalent_stress);
    return e;
}

/* Index of the card's material, -1 after an error. */
static int find_material(Builder *b, const ErosionDefinition *card, size_t number)
{
    const Definitions *d = b->definitions;
    const int material = id_map_find(&b->index.materials, card->mid);
    if (material < 0) {
        REFUSE(b, card, "MID names material %d, which is not defined", card->mid);
        return -1;
    }
    for (size_t i = 0; i < number; i++)
        if (d->erosions.items[i].mid == card->mid) {
            REFUSE(b, card, "material %d has criteria already, in line %d; put all in one card", card->mid,
                   d->erosions.items[i].source.line);
            return -1;
        }
    switch (d->materials.items[material].kind) {
    case MATERIAL_FABRIC:
    case MATERIAL_ELASTIC:
    case MATERIAL_ORTHOTROPIC:
    case MATERIAL_RUBBER:
        return material;
    default:
        REFUSE(b, card, "material %d is none of fabric, elastic or rubber membranes, and only these erode", card->mid);
        return -1;
    }
}

/* The facets of a bag that can go, wound outwards. */
static int list_erodible(Builder *b, int airbag)
{
    Model *m = b->model;
    Airbag *bag = &m->airbags[airbag];
    bag->erodible_node = builder_alloc(b, 4 * (size_t)b->shell_count + 1, sizeof *bag->erodible_node);
    bag->erodible_slot = builder_alloc(b, (size_t)b->shell_count + 1, sizeof *bag->erodible_slot);
    if (!bag->erodible_node || !bag->erodible_slot) return -1;
    for (int i = 0; i < b->shell_count; i++) {
        const ShellRecord *r = &b->records[i];
        if (r->law == LAW_SURFACE || !b->parts[r->part].erosion) continue;
        for (int s = 0; s < r->source_count; s++) {
            if (r->source[s] != airbag) continue;
            const int n = r->corner_count;
            int32_t *node = bag->erodible_node + 4 * (ptrdiff_t)bag->erodible_count;
            for (int a = 0; a < n; a++) node[a] = r->node[r->sign[s] > 0 ? a : n - 1 - a];
            if (n == 3) node[3] = node[2];
            bag->erodible_slot[bag->erodible_count++] = m->element_slot[i];
        }
    }
    return 0;
}

static int build_bags(Builder *b, const ErosionDefinition *card)
{
    Model *m = b->model;
    for (int i = 0; i < m->airbag_count; i++) {
        Airbag *bag = &m->airbags[i];
        if (list_erodible(b, i)) return -1;
        if (bag->erodible_count == 0) continue;
        if (bag->gas.kind == GAS_FLUID_AND_GAS) {
            REFUSE(b, card, "airbag %d of *AIRBAG_FLUID_AND_GAS cannot have walls that erode", bag->id);
            return -1;
        }
        if (!bag->gas.vents_eroded)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, bag->source, "*AIRBAG",
                            "airbag %d has walls that may erode, but nothing flows out of the holes: that takes "
                            "*AIRBAG_HYBRID with VNTOPT 2 or 10",
                            bag->id);
    }
    return 0;
}

int build_erosion_parts(Builder *b)
{
    const Definitions *d = b->definitions;
    if (d->erosions.count == 0) return 0;
    const int errors = b->diagnostics->errors;
    ErosionCriteria *criteria = builder_alloc(b, d->erosions.count, sizeof *criteria);
    if (!criteria) return -1;
    for (size_t i = 0; i < d->erosions.count; i++) {
        const int material = find_material(b, &d->erosions.items[i], i);
        if (material < 0) continue;
        criteria[i] = criteria_of(&d->erosions.items[i]);
        if (criteria[i].active == 0 && !isfinite(criteria[i].end)) continue;
        for (int p = 0; p < b->model->part_count; p++)
            if (b->parts[p].material == material) b->parts[p].erosion = &criteria[i];
    }
    if (b->model->relax.kind != RELAX_NONE)
        REFUSE(b, &d->erosions.items[0],
               "the phase before the run (--relax, *CONTROL_DYNAMIC_RELAXATION) does not know erosion; leave out one "
               "of the two");
    return b->diagnostics->errors > errors ? -1 : 0;
}

int build_erosion(Builder *b)
{
    Model *m = b->model;
    for (int g = 0; g < m->group_count; g++) {
        ElementGroup *group = &m->groups[g];
        if (group->law != LAW_SURFACE) group->erosion = b->parts[group->part].erosion;
        m->has_erosion |= group->erosion != NULL;
    }
    return m->has_erosion ? build_bags(b, &b->definitions->erosions.items[0]) : 0;
}
