/* Beams, cables, trusses, springs and dampers of the deck -> links and dampers, and the masses they bring. */
#include <math.h>

#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* One element of either kind. */
typedef struct LinkCard {
    int id, part, node[2];
    const DiscreteDefinition *spring; /* NULL: a beam */
    const char *keyword;
    Source source;
} LinkCard;

static int find_nodes(Builder *b, const LinkCard *card, int32_t node[2])
{
    const int ends = card->spring && !card->spring->is_belt && card->node[1] == 0 ? 1 : 2;
    int status = 0;
    node[1] = -1; /* the ground */
    for (int end = 0; end < ends; end++) {
        node[end] = id_map_find(&b->index.nodes, card->node[end]);
        if (node[end] >= 0) continue;
        diagnostics_add(
            b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
            "element %d names node N%d = %d, which the deck does not define; add it under *NODE or correct the "
            "element",
            card->id, end + 1, card->node[end]);
        status = -1;
    }
    if (status == 0 && node[0] == node[1]) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                        "element %d joins node %d to itself; correct N1 or N2", card->id, card->node[0]);
        status = -1;
    }
    return status;
}

static int refuse_law(Builder *b, const LinkCard *card, const char *what, double value, const char *advice)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                    "element %d of part %d: %s = %g must be positive; %s", card->id, card->part, what, value, advice);
    return -1;
}

/* Stiffness, length without force and preload of a beam or cable of this length (K1, K3). */
static int beam_law(Builder *b, const LinkCard *card, const SectionBeamDefinition *section,
                    const MaterialDefinition *material, double length, Link *link)
{
    double area = beam_area(section);
    link->logarithmic = section->elform == 3;
    link->tension_only = section->elform == 6;
    link->length = section->elform == 6 ? length - section->offset : length;
    if (!(link->length > 0.0))
        return refuse_law(b, card, "length", link->length, "the length less OFFSET is where a cable's pull begins");
    if (link->tension_only && material->e < 0.0) {
        link->stiffness = -material->e;
    } else {
        if (!(area > 0.0))
            return refuse_law(b, card, section->elform == 6 ? "CA" : "A", area, "give it in *SECTION_BEAM");
        if (!(material->e > 0.0)) return refuse_law(b, card, "E", material->e, "give it in the material");
        link->stiffness = link->logarithmic ? material->e * area : material->e * area / link->length;
    }
    link->preload = link->tension_only ? material->f0 : 0.0;
    return 0;
}

static double beam_mass(const SectionBeamDefinition *section, const MaterialDefinition *material, double length)
{
    return material->ro * (section->elform == 6 ? section->vol : beam_area(section) * length);
}

/* A strap's curve, once for each element; its length with the slack (K6). */
static int belt_law(Builder *b, const LinkCard *card, const MaterialDefinition *material, double length, Link *link,
                    double *mass)
{
    Strap *strap = builder_alloc(b, 1, sizeof *strap);
    if (!strap || material_curve(b, material, "LLCID", material->llcid, &strap->load)) return -1;
    if (material->ulcid != 0 && material_curve(b, material, "ULCID", material->ulcid, &strap->unload)) return -1;
    strap->yield = strap->load.x[2];
    double strain = strap_creates_energy(strap);
    if (!(strain < 0.0)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, material->source, material->keyword,
                        "material %d, ULCID = %d: from the force at the strain %g of LLCID on, the unloading curve is "
                        "less steep than the loading curve, so that cycles would create energy; make it steeper",
                        material->id, material->ulcid, strain);
        return -1;
    }
    link->strap = strap;
    link->tension_only = true;
    link->length = length + card->spring->slack;
    if (!(link->length > 0.0)) return refuse_law(b, card, "length", link->length, "move its nodes apart or give SLEN");
    link->stiffness = strap_steepest(strap) / link->length;
    if (!(material->ro > 0.0)) return refuse_law(b, card, "MPUL", material->ro, "a strap needs its mass per length");
    *mass = material->ro * link->length;
    return 0;
}

/* A spring's stiffness or curve, and the length at which it is at rest (K1, K1a). */
static int spring_law(Builder *b, const LinkCard *card, const MaterialDefinition *material, double length, Link *link)
{
    const double scale = card->spring->s;
    link->length = length - card->spring->offset;
    if (link->node[1] < 0 && card->spring->offset != 0.0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                        "element %d: OFFSET = %g with N2 = 0: a spring to the ground starts without a length, so that "
                        "the offset has no direction; give it a second node that is held",
                        card->id, card->spring->offset);
        return -1;
    }
    if (material->lcd == 0) {
        link->stiffness = material->k * scale;
        if (!(link->stiffness > 0.0)) return refuse_law(b, card, "K S", link->stiffness, "a spring needs a stiffness");
        return 0;
    }
    if (!(scale > 0.0)) return refuse_law(b, card, "S", scale, "it is a factor on the forces");
    LawCurve *curve = builder_alloc(b, 1, sizeof *curve);
    if (!curve || material_force_curve(b, material, "LCD", material->lcd, scale, curve)) return -1;
    link->curve = curve;
    link->stiffness = law_curve_steepest(curve);
    return 0;
}

/* A damper's coefficient or curve (K9). */
static int damper_law(Builder *b, const LinkCard *card, const MaterialDefinition *material, Damper *damper)
{
    const double scale = card->spring->s;
    if (card->spring->offset != 0.0)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, card->keyword,
                        "element %d: OFFSET = %g has no effect on a damper", card->id, card->spring->offset);
    damper->coefficient = material->dc * scale;
    if (material->lcdr == 0)
        return damper->coefficient > 0.0
                   ? 0
                   : refuse_law(b, card, "DC S", damper->coefficient, "a damper needs a coefficient");
    if (!(scale > 0.0)) return refuse_law(b, card, "S", scale, "it is a factor on the forces");
    LawCurve *curve = builder_alloc(b, 1, sizeof *curve);
    if (!curve || material_force_curve(b, material, "LCDR", material->lcdr, scale, curve)) return -1;
    damper->curve = curve;
    damper->coefficient = law_curve_steepest(curve);
    return 0;
}

/* One element: its mass goes to the nodes; a beam of a rigid part is no link. */
static int build_link(Builder *b, const LinkCard *card, SectionKind kind)
{
    const Definitions *d = b->definitions;
    int32_t part = id_map_find(&b->index.parts, card->part), node[2];
    int status = find_nodes(b, card, node);
    if (part < 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                        "element %d belongs to part PID = %d, which the deck does not define", card->id, card->part);
        return -1;
    }
    const PartRecord *record = &b->parts[part];
    if (record->kind != kind) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                        "element %d is of part %d, whose section is not of its kind; give the part a *SECTION_%s",
                        card->id, card->part, kind == SECTION_BEAM ? "BEAM" : "DISCRETE");
        return -1;
    }
    if (status || record->material < 0) return -1;
    const MaterialDefinition *material = &d->materials.items[record->material];
    const double *near = b->x + 3 * (ptrdiff_t)node[0], *far = node[1] < 0 ? near : b->x + 3 * (ptrdiff_t)node[1];
    double span[3];
    vector3_subtract(far, near, span);
    double length = vector3_norm(span), mass = 0.0;
    Link link = {.id = card->id, .part = part, .node = {node[0], node[1]}, .ground = {far[0], far[1], far[2]}};
    if (card->spring && card->spring->is_belt != (material->kind == MATERIAL_BELT)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                        "element %d of part %d: straps have *MAT_SEATBELT, springs and dampers *MAT_SPRING_... and "
                        "*MAT_DAMPER_...; correct MID",
                        card->id, card->part);
        return -1;
    }
    if (card->spring && card->spring->is_belt) {
        if (belt_law(b, card, material, length, &link, &mass)) return -1;
    } else if (card->spring && material->kind == MATERIAL_DAMPER) {
        Damper damper = {.id = card->id, .part = part, .node = {node[0], node[1]}, .ground = {far[0], far[1], far[2]}};
        if (damper_law(b, card, material, &damper)) return -1;
        b->model->dampers[b->model->damper_count++] = damper;
        return 0;
    } else if (card->spring) {
        if (spring_law(b, card, material, length, &link)) return -1;
    } else {
        const SectionBeamDefinition *section = &d->beam_sections.items[record->section];
        mass = beam_mass(section, material, length);
        if (material->kind == MATERIAL_RIGID && !(mass > 0.0))
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, card->keyword,
                            "beam %d of rigid part %d brings no mass: its section has no area that billow knows",
                            card->id, card->part);
        if (material->kind != MATERIAL_RIGID && beam_law(b, card, section, material, length, &link)) return -1;
    }
    for (int end = 0; mass > 0.0 && end < 2; end++) b->link_mass[node[end]] += 0.5 * mass;
    b->model->parts[part].mass += mass;
    if (material->kind != MATERIAL_RIGID) b->model->links[b->model->link_count++] = link;
    return 0;
}

int build_links(Builder *b)
{
    const Definitions *d = b->definitions;
    size_t count = d->beams.count + d->discretes.count;
    int status = 0;
    if (count == 0) return 0;
    if (!b->x) return -1; /* no nodes: told by build_shells */
    b->model->links = builder_alloc(b, count, sizeof *b->model->links);
    b->model->dampers = builder_alloc(b, d->discretes.count + 1, sizeof *b->model->dampers);
    b->link_mass = memory_alloc((size_t)b->node_count + 1, sizeof *b->link_mass);
    if (!b->model->links || !b->model->dampers || !b->link_mass) return -1;
    for (size_t i = 0; i < d->beams.count; i++) {
        const BeamDefinition *beam = &d->beams.items[i];
        LinkCard card = {beam->id, beam->part, {beam->node[0], beam->node[1]}, NULL, "*ELEMENT_BEAM", beam->source};
        if (build_link(b, &card, SECTION_BEAM)) status = -1;
    }
    for (size_t i = 0; i < d->discretes.count; i++) {
        const DiscreteDefinition *spring = &d->discretes.items[i];
        LinkCard card = {spring->id,
                         spring->part,
                         {spring->node[0], spring->node[1]},
                         spring,
                         spring->is_belt ? "*ELEMENT_SEATBELT" : "*ELEMENT_DISCRETE",
                         spring->source};
        if (build_link(b, &card, SECTION_DISCRETE)) status = -1;
    }
    return status;
}
