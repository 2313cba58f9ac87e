/* Masses beside those of elements: on nodes, and spread over parts. Equations (M26) and (M27) of docs/theory.md. */
#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/motion_input.h"

/* ---- over parts ---- */

/* By what a mass is shared among the elements of some parts. */
typedef struct Sharing {
    const unsigned char *chosen; /* 1: the part is one of them (part count) */
    bool by_mass;                /* else by area of shells, or by volume of solids */
    double shells, solids, mass; /* sums of the weights, and the elements' masses [M] */
} Sharing;

static const char *part_keyword(const PartMassDefinition *card)
{
    return card->is_set ? "*ELEMENT_MASS_PART_SET" : "*ELEMENT_MASS_PART";
}

/* Faces of solids are surfaces without mass. */
static double shell_weight(const Builder *b, const Sharing *sharing, const ShellRecord *r)
{
    if (!sharing->chosen[r->part] || b->parts[r->part].kind != SECTION_SHELL) return 0.0;
    return sharing->by_mass ? r->mass : r->area;
}

static double solid_mass(const Solid *solid)
{
    double mass = 0.0;
    for (int a = 0; a < 8; a++) mass += solid->share[a];
    return mass;
}

static double solid_weight(const Builder *b, const Sharing *sharing, const Solid *solid)
{
    const double mass = solid_mass(solid), density = b->parts[solid->part].density;
    if (!sharing->chosen[solid->part] || !(density > 0.0)) return 0.0;
    return sharing->by_mass ? mass : mass / density;
}

static void sum_weights(const Builder *b, Sharing *sharing)
{
    for (int i = 0; i < b->shell_count; i++) sharing->shells += shell_weight(b, sharing, &b->records[i]);
    for (int i = 0; i < b->model->solid_count; i++) sharing->solids += solid_weight(b, sharing, &b->model->solids[i]);
    for (int p = 0; p < b->model->part_count; p++)
        if (sharing->chosen[p]) sharing->mass += b->model->parts[p].mass;
}

/* The mass to add; 0 after an error. */
static double mass_to_add(Builder *b, const PartMassDefinition *card, const Sharing *sharing)
{
    const char *noun = card->is_set ? "part set" : "part";
    if (!(sharing->shells + sharing->solids > 0.0)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, part_keyword(card),
                        "%s %d has no shells and no solids of a density to carry the mass; use *ELEMENT_MASS on nodes",
                        noun, card->target);
        return 0.0;
    }
    if (sharing->shells > 0.0 && sharing->solids > 0.0 && !sharing->by_mass) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, part_keyword(card),
                        "part set %d has shells and solids, which share neither by area nor by volume; give MWD = 1, "
                        "or a card for each",
                        card->target);
        return 0.0;
    }
    if (card->addmass > 0.0) return card->addmass;
    if (card->finmass > sharing->mass) return card->finmass - sharing->mass;
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, part_keyword(card),
                    "FINMASS = %g of %s %d is not more than the mass %g that it has; nothing can be added",
                    card->finmass, noun, card->target, sharing->mass);
    return 0.0;
}

/* Each element's mass grows by its share, and with it those of its nodes (M27). */
static void spread_mass(Builder *b, const Sharing *sharing, double added)
{
    const double each = added / (sharing->shells + sharing->solids);
    for (int i = 0; i < b->shell_count; i++) {
        ShellRecord *r = &b->records[i];
        const double share = each * shell_weight(b, sharing, r);
        r->mass += share;
        b->model->parts[r->part].mass += share;
    }
    for (int i = 0; i < b->model->solid_count; i++) {
        Solid *solid = &b->model->solids[i];
        const double share = each * solid_weight(b, sharing, solid);
        if (!(share > 0.0)) continue;
        const double factor = 1.0 + share / solid_mass(solid);
        for (int a = 0; a < 8; a++) solid->share[a] *= factor;
        b->model->parts[solid->part].mass += share;
    }
}

static int add_to_parts(Builder *b, const PartMassDefinition *card, unsigned char *chosen)
{
    const int errors = b->diagnostics->errors;
    MotionInput input = {.index = &b->index};
    IndexList parts = {0};
    Sharing sharing = {.chosen = chosen, .by_mass = card->is_set && card->mwd == 1};
    int status =
        motion_find_parts(&input, card->is_set, card->target, card->source, part_keyword(card), &parts, b->diagnostics);
    for (size_t k = 0; k < parts.count; k++) {
        const PartDefinition *part = &b->definitions->parts.items[parts.items[k]];
        chosen[parts.items[k]] = 1;
        if (part->has_inertia)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, part_keyword(card),
                            "the mass has no effect on part %d, whose mass TM is that of *PART_INERTIA; raise TM",
                            part->id);
    }
    if (!status) {
        sum_weights(b, &sharing);
        double added = mass_to_add(b, card, &sharing);
        if (added > 0.0) spread_mass(b, &sharing, added);
    }
    for (size_t k = 0; k < parts.count; k++) chosen[parts.items[k]] = 0;
    index_list_free(&parts);
    return status || b->diagnostics->errors > errors ? -1 : 0;
}

/* ---- on nodes ---- */

static const char *node_keyword(const MassDefinition *card)
{
    return card->is_set ? "*ELEMENT_MASS_NODE_SET" : "*ELEMENT_MASS";
}

/* The nodes of a card, which share its mass equally (M26). */
static int add_to_nodes(Builder *b, int number, size_t *capacity)
{
    const MassDefinition *card = &b->definitions->masses.items[number];
    MotionInput input = {.index = &b->index};
    IndexList nodes = {0};
    int32_t part = card->part != 0 ? id_map_find(&b->index.parts, card->part) : -1;
    int status =
        motion_find_nodes(&input, card->is_set, card->target, card->source, node_keyword(card), &nodes, b->diagnostics);
    if (card->part != 0 && part < 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, node_keyword(card),
                        "mass element %d belongs to part PID = %d, which the deck does not define; correct it, or "
                        "leave it blank",
                        card->id, card->part);
        status = -1;
    }
    if (!status && nodes.count == 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, node_keyword(card),
                        "node set %d of mass element %d has no nodes", card->target, card->id);
        status = -1;
    }
    if (!status && memory_reserve((void **)&b->point_masses, capacity, (size_t)b->point_mass_count + nodes.count,
                                  sizeof *b->point_masses))
        status = -1;
    for (size_t k = 0; !status && k < nodes.count; k++)
        b->point_masses[b->point_mass_count++] =
            (PointMass){.node = nodes.items[k], .part = part, .mass = card->mass / (double)nodes.count, .card = number};
    index_list_free(&nodes);
    return status;
}

int build_masses(Builder *b)
{
    const Definitions *d = b->definitions;
    size_t capacity = 0;
    int status = 0;
    unsigned char *chosen = memory_alloc(d->parts.count + 1, 1);
    if (!chosen) return -1;
    for (size_t i = 0; i < d->part_masses.count; i++)
        if (add_to_parts(b, &d->part_masses.items[i], chosen)) status = -1;
    memory_free(chosen);
    for (size_t i = 0; i < d->masses.count; i++)
        if (add_to_nodes(b, (int)i, &capacity)) status = -1;
    return status;
}

/* A mass on a node of a moving rigid part counts for that part; where a card gives the body's mass it has no say and is
 * left out. The rest goes to the Model. */
int build_point_masses(Builder *b)
{
    Model *m = b->model;
    int told = -1;
    if (b->point_mass_count == 0) return 0;
    m->point_masses = builder_alloc(b, (size_t)b->point_mass_count, sizeof *m->point_masses);
    if (!m->point_masses) return -1;
    for (int i = 0; i < b->point_mass_count; i++) {
        PointMass mass = b->point_masses[i];
        const int number = b->motion.node_body[mass.node];
        const RigidBody *body = number >= 0 ? &b->motion.rigid_bodies[number] : NULL;
        if (body && body->given) {
            const MassDefinition *card = &b->definitions->masses.items[mass.card];
            if (told != mass.card)
                diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, node_keyword(card),
                                "the mass at node %d has no effect: rigid body %d has its mass TM by the option "
                                "INERTIA; raise TM",
                                b->definitions->nodes.items[mass.node].id, body->part_id);
            told = mass.card;
            continue;
        }
        if (body && !body->nodal && mass.part < 0) mass.part = id_map_find(&b->index.parts, body->part_id);
        if (mass.part >= 0) m->parts[mass.part].point_mass += mass.mass;
        m->point_masses[m->point_mass_count++] = mass;
    }
    return 0;
}
