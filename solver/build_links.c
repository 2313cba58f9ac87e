/* Beams, cables, trusses and springs of the deck -> links, and the masses they bring. */
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
    int status = 0;
    for (int end = 0; end < 2; end++) {
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
    double span[3];
    vector3_subtract(b->x + 3 * (ptrdiff_t)node[1], b->x + 3 * (ptrdiff_t)node[0], span);
    double length = vector3_norm(span), mass = 0.0;
    Link link = {.id = card->id, .part = part, .node = {node[0], node[1]}};
    if (card->spring && card->spring->is_belt != (material->kind == MATERIAL_BELT)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, card->keyword,
                        "element %d of part %d: straps have *MAT_SEATBELT, springs *MAT_SPRING_ELASTIC; correct MID",
                        card->id, card->part);
        return -1;
    }
    if (card->spring && card->spring->is_belt) {
        if (belt_law(b, card, material, length, &link, &mass)) return -1;
    } else if (card->spring) {
        link.stiffness = material->k * card->spring->s;
        link.length = length - card->spring->offset;
        if (!(link.stiffness > 0.0)) return refuse_law(b, card, "K S", link.stiffness, "a spring needs a stiffness");
    } else {
        const SectionBeamDefinition *section = &d->beam_sections.items[record->section];
        mass = beam_mass(section, material, length);
        if (material->kind == MATERIAL_RIGID && !(mass > 0.0))
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, card->keyword,
                            "beam %d of rigid part %d brings no mass: its section has no area that billow knows",
                            card->id, card->part);
        if (material->kind != MATERIAL_RIGID && beam_law(b, card, section, material, length, &link)) return -1;
    }
    for (int end = 0; end < 2; end++) b->link_mass[node[end]] += 0.5 * mass;
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
    b->link_mass = memory_alloc((size_t)b->node_count + 1, sizeof *b->link_mass);
    if (!b->model->links || !b->link_mass) return -1;
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

/* 1/m that a force at this node of a body meets at most: 1/M + r^2/I. */
static double body_mobility(const RigidBody *body, int32_t node)
{
    double least = 0.0, arm = 0.0;
    for (int i = 0; i < 3; i++)
        if (body->inertia[i] > 0.0 && (least == 0.0 || body->inertia[i] < least)) least = body->inertia[i];
    for (int k = 0; k < body->node_count; k++)
        if (body->node[k] == node) arm = vector3_norm(body->offset + 3 * (size_t)k);
    return 1.0 / body->mass + (least > 0.0 ? arm * arm / least : 0.0);
}

/* A node's 1/m for forces: its own, that of its body, or for a hanging node that of its edge's ends. */
static double node_mobility(const Builder *b, const int32_t *body_of, int32_t node)
{
    const Constraints *constraints = &b->motion.constraints;
    if (body_of[node]) return body_mobility(&b->motion.rigid_bodies[body_of[node] - 1], node);
    double mobility = b->model->inverse_mass[node];
    for (int h = 0; h < constraints->hanging_count; h++)
        if (constraints->hanging[h].node == node)
            for (int end = 0; end < 2; end++)
                mobility += 0.5 * node_mobility(b, body_of, constraints->hanging[h].end[end]);
    return mobility;
}

/* Where the node is fixed no mass is needed. */
static int check_mass(Builder *b, const Link *link, int32_t node, double mobility)
{
    const Model *m = b->model;
    if (mobility > 0.0 || node >= m->moving_count) return 0;
    if (m->mass[node] > 0.0) return 0;
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, b->definitions->parts.items[link->part].source, "*PART",
                    "node %d of element %d of part %d has no mass; give the cable a VOL and RO or the node a mass by "
                    "*ELEMENT_MASS, or hold the node",
                    m->node_id[node], link->id, m->parts[link->part].id);
    return -1;
}

/* Mobility of each link's ends, times the number of links that hold the same node or body (K5). */
int build_link_ends(Builder *b)
{
    Model *m = b->model;
    if (m->link_count == 0) return 0;
    int32_t *share = memory_alloc((size_t)m->node_count + (size_t)b->motion.rigid_body_count + 1, sizeof *share);
    int32_t *body_of = memory_alloc((size_t)m->node_count + 1, sizeof *body_of);
    int status = share && body_of ? 0 : -1;
    for (int k = 0; !status && k < b->motion.rigid_body_count; k++)
        for (int n = 0; n < b->motion.rigid_bodies[k].node_count; n++)
            body_of[b->motion.rigid_bodies[k].node[n]] = k + 1;
    for (int i = 0; share && body_of && i < 2 * m->link_count; i++) {
        int32_t node = m->links[i / 2].node[i % 2], body = body_of[node];
        share[body ? m->node_count + body - 1 : node]++;
    }
    for (int i = 0; share && body_of && i < 2 * m->link_count; i++) {
        Link *link = &m->links[i / 2];
        int32_t node = link->node[i % 2], body = body_of[node];
        double mobility = node_mobility(b, body_of, node);
        link->inverse[i % 2] = share[body ? m->node_count + body - 1 : node] * mobility;
        if (check_mass(b, link, node, mobility)) status = -1;
    }
    memory_free(share);
    memory_free(body_of);
    return status;
}
