/* OPT, FVOPT and A23 < 0: leaking parts and vents that are parts; their initial areas. */
#include <math.h>
#include <string.h>

#include "solver/build_airbags.h"

/* Place of a part in the bag's list, appended if it is not on the surface. */
static int place_of(Airbag *bag, int part)
{
    for (int k = 0; k < bag->part_count; k++)
        if (bag->part[k] == part) return k;
    bag->part[bag->part_count] = part;
    return bag->part_count++;
}

static int add_hole(Builder *b, const AirbagDefinition *d, Airbag *bag, int part)
{
    (void)b;
    int k = place_of(bag, part);
    bag->gas.holes[bag->gas.hole_count++] = (GasHole){
        .place = k, .increase = d->vntopt == 1 || d->vntopt == 10, .blocked = d->opt > 0.0 && (int)d->opt % 2 == 0};
    return 0;
}

/* A23 < 0: a part, or with LCA23 = -1 a set of parts. */
static int build_holes(Builder *b, const AirbagDefinition *d, Airbag *bag)
{
    int id = (int)-d->a23, status = 0;
    bag->gas.holes = builder_alloc(b, (size_t)b->model->part_count + 1, sizeof *bag->gas.holes);
    if (!bag->gas.holes) return -1;
    if (d->lca23 != -1) {
        int part = id_map_find(&b->index.parts, id);
        if (part >= 0) return add_hole(b, d, bag, part);
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->card4, "*AIRBAG", "A23 = %g: there is no part %d", d->a23,
                        id);
        return -1;
    }
    IndexList set = {0};
    status = sets_resolve_parts(&b->index, id, d->card4, "*AIRBAG", &set, b->diagnostics);
    for (size_t i = 0; !status && i < set.count; i++) status = add_hole(b, d, bag, set.items[i]);
    index_list_free(&set);
    return status;
}

/* FLC and the others of a part's material: those of *MAT_ADD_AIRBAG_POROSITY_LEAKAGE, else of the fabric. */
static bool find_porosity(const Builder *b, int part, PorosityDefinition *found, bool *of_reference)
{
    const Definitions *d = b->definitions;
    if (part < 0 || b->parts[part].material < 0) return false;
    const MaterialDefinition *material = &d->materials.items[b->parts[part].material];
    *of_reference = material->kind == MATERIAL_FABRIC && material->fabric.a0ref != 0.0;
    for (size_t i = 0; i < d->porosities.count; i++) {
        if (d->porosities.items[i].mid != material->id) continue;
        *found = d->porosities.items[i];
        return true;
    }
    if (material->kind != MATERIAL_FABRIC) return false;
    const FabricCard *f = &material->fabric;
    *found = (PorosityDefinition){material->id, f->flc, f->fac, f->ela, f->fvopt, f->x0, f->x1, material->source};
    return true;
}

/* Whether an earlier part of the bag has the same material, so that a warning would be said twice. */
static bool said_before(const Builder *b, const Airbag *bag, int k)
{
    for (int i = 0; i < k; i++)
        if (b->parts[bag->part[i]].material == b->parts[bag->part[k]].material) return true;
    return false;
}

static int fill_leak(Builder *b, const PorosityDefinition *p, GasLeak *leak)
{
    int status = 0;
    leak->coefficient_curve = leak->factor_curve = leak->open_curve = -1;
    if (p->ela < 0.0)
        leak->open_curve = airbag_curve(b, (int)p->ela, "ELA", p->source, &status);
    else
        leak->open = p->ela;
    const bool bare = p->x1 == 0.0 && p->flc == 0.0 && p->fac == 0.0;
    leak->form = p->x0 == 1.0                   ? LEAK_STRETCH
                 : p->x0 == 0.0 && p->x1 == 0.0 ? LEAK_FACTORS
                 : p->x0 == -1.0 && bare        ? LEAK_SEAL
                                                : LEAK_POLYNOMIAL;
    if (leak->form == LEAK_POLYNOMIAL) {
        const double x[4] = {p->x0, p->x1, p->flc, p->fac};
        memcpy(leak->x, x, sizeof x);
        return status;
    }
    if (p->flc < 0.0)
        leak->coefficient_curve = airbag_curve(b, (int)p->flc, "FLC", p->source, &status);
    else
        leak->coefficient = p->flc;
    if (p->fac < 0.0)
        leak->factor_curve = airbag_curve(b, (int)p->fac, "FAC", p->source, &status);
    else
        leak->factor = p->fac;
    return status;
}

static bool leaks(const GasLeak *leak)
{
    if (leak->form == LEAK_POLYNOMIAL || leak->form == LEAK_SEAL) return true;
    return (leak->coefficient > 0.0 || leak->coefficient_curve >= 0) && (leak->factor > 0.0 || leak->factor_curve >= 0);
}

/* OPT > 0: each material's FVOPT decides, else OPT. The commonest silent mistake of decks is porosity without area. */
static int build_leaks(Builder *b, const AirbagDefinition *d, Airbag *bag)
{
    GasModel *gas = &bag->gas;
    int surface = bag->surface_parts, status = 0;
    gas->leaks = builder_alloc(b, (size_t)surface + 1, sizeof *gas->leaks);
    if (!gas->leaks) return -1;
    for (int k = 0; k < surface; k++) {
        PorosityDefinition p;
        GasLeak leak = {.place = k};
        if (!find_porosity(b, bag->part[k], &p, &leak.of_reference)) continue;
        if (fill_leak(b, &p, &leak)) status = -1;
        leak.option = p.fvopt > 0.0 ? (int)p.fvopt : (int)d->opt;
        if (leaks(&leak))
            gas->leaks[gas->leak_count++] = leak;
        else if ((p.flc != 0.0 || p.fvopt > 0.0) && !said_before(b, bag, k))
            diagnostics_add(
                b->diagnostics, SEVERITY_WARNING, p.source, "*MAT_FABRIC",
                "material %d does not leak: FLC and FAC must both differ from 0 (1 where the pressure has no "
                "say), but FLC = %g and FAC = %g",
                p.mid, p.flc, p.fac);
    }
    if (!status && gas->leak_count == 0)
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, d->card5, "*AIRBAG",
            "airbag %d: OPT = %g asks for leakage through the fabric, but no material of the bag has both FLC "
            "and FAC: the leakage has no area%s",
            bag->id, d->opt, d->cp23 != 0.0 || d->lccp23 != 0 ? ", and OPT switches CP23 and AP23 off" : "");
    return status;
}

/* What OPT = 0 leaves without effect, and coefficients without an area. */
static void warn_unused(Builder *b, const AirbagDefinition *d, const Airbag *bag)
{
    for (int k = 0; k < bag->surface_parts; k++) {
        PorosityDefinition p;
        bool reference;
        if (said_before(b, bag, k) || !find_porosity(b, bag->part[k], &p, &reference) ||
            (p.flc == 0.0 && p.fvopt == 0.0 && p.x0 == 0.0))
            continue;
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, p.source, "*MAT_FABRIC",
            "material %d has FLC = %g and FVOPT = %g for leakage, but airbag %d has OPT = 0: it does not leak; set "
            "OPT to 1 to 8",
            p.mid, p.flc, p.fvopt, bag->id);
    }
    const bool coefficient = d->cp23 != 0.0 || d->lccp23 != 0, area = d->ap23 != 0.0 || d->lcap23 != 0;
    if (coefficient != area)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, d->card4, "*AIRBAG",
                        "airbag %d: leakage needs a coefficient (CP23, LCCP23) and an area (AP23, LCAP23); it has only "
                        "the %s, so that nothing leaks",
                        bag->id, coefficient ? "coefficient" : "area");
}

int airbag_leakage(Builder *b, const AirbagDefinition *d, Airbag *bag)
{
    int status = 0;
    bag->surface_parts = bag->gas.surface_parts = bag->part_count;
    if (d->model != AIRBAG_WANG_NEFSKE && d->model != AIRBAG_HYBRID) return 0;
    if (d->opt > 0.0)
        status = build_leaks(b, d, bag);
    else
        warn_unused(b, d, bag);
    if (d->a23 < 0.0 && build_holes(b, d, bag)) status = -1;
    bag->gas.vents_eroded = d->model == AIRBAG_HYBRID && (d->vntopt == 2 || d->vntopt == 10);
    for (int i = 0; i < bag->gas.leak_count; i++)
        if (bag->gas.leaks[i].option % 2 == 0) b->model->blockage = true;
    for (int i = 0; i < bag->gas.hole_count; i++)
        if (bag->gas.holes[i].blocked) b->model->blockage = true;
    return status;
}

/* Area of the bag's part at a place, at the start or in the reference geometry as far as it has one. */
static double area_at(const Builder *b, int airbag, const Airbag *bag, int place, bool of_reference)
{
    double sum = 0.0, corner[12];
    for (int i = 0; i < b->record_count; i++) {
        const ShellRecord *r = &b->records[i];
        if (r->part != bag->part[place]) continue;
        bool on = place >= bag->surface_parts;
        for (int s = 0; !on && s < r->source_count; s++) on = r->source[s] == airbag;
        if (!on) continue;
        if (of_reference && r->reference > 0) {
            sum += geometry_area(r->corner_count, b->references[i].x);
            continue;
        }
        for (int a = 0; a < r->corner_count; a++)
            memcpy(corner + 3 * a, b->model->initial + 3 * (ptrdiff_t)r->node[a], 3 * sizeof *corner);
        sum += geometry_area(r->corner_count, corner);
    }
    return sum;
}

/* Which place of each bag's list each group counts for. */
static int place_groups(Builder *b)
{
    Model *m = b->model;
    size_t bags = (size_t)m->airbag_count;
    m->group_place = builder_alloc(b, (size_t)m->group_count * bags + 1, sizeof *m->group_place);
    if (!m->group_place) return -1;
    for (int g = 0; g < m->group_count; g++) {
        for (int i = 0; i < m->airbag_count; i++) {
            const Airbag *bag = &m->airbags[i];
            int place = bag->part_count - 1, set = m->groups[g].pressure_set;
            while (place >= 0 && bag->part[place] != m->groups[g].part) place--;
            bool on = place >= bag->surface_parts;
            for (int k = 0; set >= 0 && k < m->pressure_sets[set].count; k++)
                on |= m->pressure_sets[set].source[k] == i;
            m->group_place[(size_t)g * bags + (size_t)i] = on ? place : -1;
        }
    }
    return 0;
}

/* The surface of a bag of FLUID_AND_GAS, whose volume below a level is measured. */
static int list_facets(Builder *b, int airbag)
{
    Airbag *bag = &b->model->airbags[airbag];
    bag->facet = builder_alloc(b, 4 * (size_t)b->record_count + 1, sizeof *bag->facet);
    if (!bag->facet) return -1;
    for (int i = 0; i < b->record_count; i++) {
        const ShellRecord *r = &b->records[i];
        for (int s = 0; s < r->source_count; s++) {
            if (r->source[s] != airbag) continue;
            int32_t *facet = bag->facet + 4 * (ptrdiff_t)bag->facet_count++;
            for (int a = 0; a < 4; a++) facet[a] = r->corner_count == 3 && a == 3 ? r->node[2] : r->node[a];
            if (r->sign[s] > 0) continue;
            int32_t second = facet[1];
            if (r->corner_count == 3) {
                facet[1] = facet[2];
                facet[2] = facet[3] = second;
            } else {
                facet[1] = facet[3];
                facet[3] = second;
            }
        }
    }
    return 0;
}

int build_areas(Builder *b)
{
    Model *m = b->model;
    for (int i = 0; i < m->airbag_count; i++) {
        Airbag *bag = &m->airbags[i];
        if (bag->gas.kind == GAS_FLUID_AND_GAS && list_facets(b, i)) return -1;
        bag->first_part = m->bag_part_count;
        m->bag_part_count += bag->part_count;
        for (int k = 0; k < bag->gas.leak_count; k++) {
            GasLeak *leak = &bag->gas.leaks[k];
            leak->initial_area = area_at(b, i, bag, leak->place, leak->of_reference);
        }
        for (int k = 0; k < bag->gas.hole_count; k++)
            bag->gas.holes[k].initial_area = area_at(b, i, bag, bag->gas.holes[k].place, false);
    }
    for (int i = 0; i < m->connection_count; i++) m->blockage |= m->connections[i].blocked;
    return place_groups(b);
}
