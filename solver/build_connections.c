/* *AIRBAG_INTERACTION -> connections between bags; mixtures that meet get one list of gases. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "airbag/gas_law.h"
#include "solver/build_airbags.h"

static int refuse(Builder *b, const InteractionDefinition *card, const char *what)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, "*AIRBAG_INTERACTION", "airbags %d and %d: %s",
                    card->ab1, card->ab2, what);
    return -1;
}

static int find_bag(Builder *b, int id, const char *field, const InteractionDefinition *card)
{
    for (size_t i = 0; i < b->definitions->airbags.count; i++)
        if (b->definitions->airbags.items[i].id == id) return (int)i;
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, "*AIRBAG_INTERACTION",
                    "%s = %d is not the ABID of any airbag; give the bag's keyword the option _ID", field, id);
    return -1;
}

static bool near(double a, double b)
{
    return fabs(a - b) <= 1e-6 * fabs(b);
}

/* What may flow between the two. */
static int check_gases(Builder *b, const InteractionDefinition *card, const GasModel *one, const GasModel *two)
{
    if (!gas_connects(one->kind) || !gas_connects(two->kind) || one->kind == GAS_CHEMKIN || two->kind == GAS_CHEMKIN) {
        diagnostics_add(
            b->diagnostics, SEVERITY_ERROR, card->source, "*AIRBAG_INTERACTION",
            "bags of %s and %s cannot be connected; SIMPLE_AIRBAG_MODEL, WANG_NEFSKE and HYBRID can, by LCID "
            "LOAD_CURVE and LINEAR_FLUID too",
            gas_name(one->kind), gas_name(two->kind));
        return -1;
    }
    const bool law = one->kind >= GAS_PRESSURE_VOLUME, other = two->kind >= GAS_PRESSURE_VOLUME;
    const bool hybrid = one->kind == GAS_HYBRID, second = two->kind == GAS_HYBRID;
    if (law != other) return refuse(b, card, "a gas with a temperature cannot flow into a bag without one");
    if (law && card->lcid == 0) return refuse(b, card, "LOAD_CURVE and LINEAR_FLUID need LCID");
    if (hybrid != second) return refuse(b, card, "HYBRID can only be connected to HYBRID, which knows its gases");
    if (card->lcid != 0 || hybrid) return 0;
    GasState none = {0};
    GasLaw first = gas_law_of(one, &none), last = gas_law_of(two, &none);
    if (!near(first.r, last.r) || !near(first.c0, last.c0) || !near(first.c1 + 1.0, last.c1 + 1.0) ||
        !near(one->gravity_conversion, two->gravity_conversion))
        return refuse(b, card,
                      "AREA and SF ask for the same gas in both bags, but CV, CP (or A, B, MW) or GC differ; use "
                      "HYBRID, or LCID");
    return 0;
}

static int build_connection(Builder *b, const InteractionDefinition *card, GasConnection *c)
{
    int status = 0;
    *c = (GasConnection){.area_curve = -1, .part = -1, .coefficient_curve = -1, .direction = card->iflow};
    c->bag[0] = find_bag(b, card->ab1, "AB1", card);
    c->bag[1] = find_bag(b, card->ab2, "AB2", card);
    if (c->bag[0] < 0 || c->bag[1] < 0) return -1;
    if (check_gases(b, card, &b->model->airbags[c->bag[0]].gas, &b->model->airbags[c->bag[1]].gas)) status = -1;
    c->flow_curve = airbag_curve(b, card->lcid, "LCID", card->source, &status);
    if (card->lcid != 0) return status;
    if (card->area < 0.0)
        c->area_curve = airbag_curve(b, (int)card->area, "AREA", card->source, &status);
    else
        c->area = card->area;
    if (card->sf < 0.0)
        c->coefficient_curve = airbag_curve(b, (int)card->sf, "SF", card->source, &status);
    else
        c->coefficient = card->sf;
    if (card->area == 0.0) {
        c->part = id_map_find(&b->index.parts, abs(card->pid));
        c->blocked = card->pid < 0;
        if (c->part < 0) {
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, card->source, "*AIRBAG_INTERACTION",
                            "PID = %d: there is no part of this id", abs(card->pid));
            status = -1;
        }
    }
    return status;
}

static bool same_species(const GasSpecies *a, const GasSpecies *b)
{
    if (a->molar_mass != b->molar_mass || a->r != b->r || a->piece_count != b->piece_count) return false;
    return memcmp(a->piece[0].cp, b->piece[0].cp, sizeof a->piece[0].cp) == 0;
}

/* All gases of the connected mixtures, each once. -1 if they are too many. */
static int list_gases(const Builder *b, GasSpecies *all)
{
    int count = 0;
    for (int k = 0; k < 2 * b->model->connection_count; k++) {
        const GasModel *gas = &b->model->airbags[b->model->connections[k / 2].bag[k % 2]].gas;
        for (int i = 0; i < gas->species_count; i++) {
            int j = 0;
            while (j < count && !same_species(&all[j], &gas->species[i])) j++;
            if (j < count) continue;
            if (count == BILLOW_GAS_SPECIES) return -1;
            all[count++] = gas->species[i];
        }
    }
    return count;
}

/* Gives a bag the joint list. Returns 1 if it lists one gas twice, whose two inflows have no two places there. */
static int take_gases(Builder *b, GasModel *gas, const GasSpecies *all, int count)
{
    GasSpecies *species = builder_alloc(b, BILLOW_GAS_SPECIES, sizeof *species);
    GasSource *sources = builder_alloc(b, BILLOW_GAS_SPECIES, sizeof *sources);
    if (!species || !sources) return -1;
    for (int j = 0; j < count; j++) {
        species[j] = all[j];
        sources[j] = (GasSource){.mass_flow_curve = -1, .temperature_curve = -1, .mole_fraction_curve = -1};
        bool found = false;
        for (int i = 0; i < gas->species_count; i++) {
            if (!same_species(&all[j], &gas->species[i])) continue;
            if (found) return 1;
            sources[j] = gas->sources[i];
            found = true;
        }
    }
    gas->species_count = count;
    gas->species = species;
    gas->sources = sources;
    return 0;
}

static int join_mixtures(Builder *b)
{
    Model *m = b->model;
    GasSpecies all[BILLOW_GAS_SPECIES];
    int count = list_gases(b, all);
    if (count == 0) return 0;
    const InteractionDefinition *first = &b->definitions->interactions.items[0];
    if (count < 0) return refuse(b, first, "the connected mixtures have more than 32 different gases together");
    for (int k = 0; k < 2 * m->connection_count; k++) {
        GasModel *gas = &m->airbags[m->connections[k / 2].bag[k % 2]].gas;
        if (gas->species_count == 0) continue;
        int status = take_gases(b, gas, all, count);
        if (status > 0)
            return refuse(b, first,
                          "a connected HYBRID bag lists the same gas (MW, A, B, C) twice; give it one mass flow curve");
        if (status < 0) return -1;
    }
    return 0;
}

int build_connections(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    int status = 0;
    if (d->interactions.count == 0) return 0;
    m->connections = builder_alloc(b, d->interactions.count, sizeof *m->connections);
    if (!m->connections) return -1;
    for (size_t i = 0; i < d->interactions.count; i++)
        if (build_connection(b, &d->interactions.items[i], &m->connections[i])) status = -1;
    if (status) return -1;
    m->connection_count = (int)d->interactions.count;
    return join_mixtures(b);
}
