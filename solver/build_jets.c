/* Jetting cards of *AIRBAG -> jets with the facets of their bags. */
#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/builder.h"
#include "solver/elementary.h"
#include "solver/memory.h"
#include "solver/vector3.h"

static int jet_error(Builder *b, Source source, const char *text)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, source, "*AIRBAG", "%s", text);
    return -1;
}

static int32_t find_node(Builder *b, int id, const char *field, Source source, int *status)
{
    int32_t found = id_map_find(&b->index.nodes, id);
    if (found >= 0) return b->model->deck_node[found];
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, source, "*AIRBAG", "%s = %d: there is no node of this id", field,
                    id);
    *status = -1;
    return -1;
}

/* A constant, or with a negative value the curve of that id; -1 none. */
static int curve_of(Builder *b, double value, const char *field, Source source, int *status)
{
    if (!(value < 0.0)) return -1;
    int curve = deck_index_curve(&b->index, (int)-value, field, source, "*AIRBAG", b->diagnostics);
    if (curve < 0) *status = -1;
    return curve;
}

/* Foci and head: three nodes if NODE1 and NODE2 are given, else coordinates. */
static int place_jet(Builder *b, const AirbagDefinition *bag, Jet *jet)
{
    const JetCards *cards = &bag->jet;
    int status = 0;
    jet->moving = cards->node[0] != 0 && cards->node[1] != 0;
    memcpy(jet->focus, cards->focus, sizeof jet->focus);
    memcpy(jet->head, cards->head, sizeof jet->head);
    memcpy(jet->second, cards->second, sizeof jet->second);
    if (jet->moving) {
        jet->focus_node = find_node(b, cards->node[0], "NODE1", cards->card10, &status);
        jet->head_node = find_node(b, cards->node[1], "NODE2", cards->card10, &status);
        jet->wedge = cards->node[2] != 0;
        if (jet->wedge) jet->second_node = find_node(b, cards->node[2], "NODE3", cards->card10, &status);
        if (status) return -1;
        const double *x = b->model->initial;
        memcpy(jet->focus, x + 3 * (size_t)jet->focus_node, sizeof jet->focus);
        memcpy(jet->head, x + 3 * (size_t)jet->head_node, sizeof jet->head);
    } else {
        jet->wedge = cards->second[0] != 0.0 || cards->second[1] != 0.0 || cards->second[2] != 0.0;
        if (cards->node[0] != 0 || cards->node[1] != 0 || cards->node[2] != 0)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, cards->card10, "*AIRBAG",
                            "NODE1 and NODE2 must both be given to place the jet; the coordinates are used instead");
    }
    double axis[3];
    vector3_subtract(jet->head, jet->focus, axis);
    if (vector3_norm(axis) > 0.0) return 0;
    return jet_error(b, cards->card9, "the jet has no direction: its head is at its focal point");
}

static int spread_jet(Builder *b, const AirbagDefinition *bag, Jet *jet)
{
    const JetCards *cards = &bag->jet;
    int status = 0;
    jet->efficiency = cards->beta;
    jet->efficiency_curve = curve_of(b, cards->beta, "BETA", cards->card9, &status);
    jet->angle_curve = jet->velocity_curve = -1;
    jet->cut_off = cards->angle > 0.0 ? cards->angle : 180.0;
    if (!jet->multiple) {
        jet->angle = cards->ca;
        jet->angle_curve = curve_of(b, cards->ca, "CA", cards->card9, &status);
        if (cards->ca == 0.0) return jet_error(b, cards->card9, "CA is 0, but must be the jet's angle in radians");
        if (jet->angle > 1.6 && jet->angle_curve < 0)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, cards->card9, "*AIRBAG",
                            "CA = %g is a very wide jet: the angle is in radians", cards->ca);
        return status;
    }
    int curve = deck_index_curve(&b->index, (int)cards->ca, "LCJRV", cards->card9, "*AIRBAG", b->diagnostics);
    if (curve < 0) return -1;
    jet->velocity_curve = curve;
    jet_spread(jet, b->model->curves);
    if (jet->spread[1][0] > 0.0) return status;
    return jet_error(b, cards->card9, "LCJRV is 0 for all angles (in degrees) up to ANGLE: there is no jet");
}

/* Parts that take the pressure; all if PSID = 0. targets: (part count). */
static int find_targets(Builder *b, const AirbagDefinition *bag, unsigned char *targets)
{
    memset(targets, bag->jet.psid == 0, (size_t)b->model->part_count);
    if (bag->jet.psid == 0) return 0;
    IndexList parts = {0};
    int status = sets_resolve_parts(&b->index, bag->jet.psid, bag->jet.card10, "*AIRBAG", &parts, b->diagnostics);
    for (size_t i = 0; i < parts.count; i++) targets[parts.items[i]] = 1;
    index_list_free(&parts);
    return status;
}

/* The source's place among a record's, or -1. */
static int source_place(const ShellRecord *record, int airbag)
{
    for (int s = 0; s < record->source_count; s++)
        if (record->source[s] == airbag) return s;
    return -1;
}

/* Fills one facet; row: of its first corner in the group's table. */
static void fill_facet(Jet *jet, const ShellRecord *record, int sign, const int32_t *row, bool target)
{
    JetFacet *facet = &jet->facet[jet->facet_count];
    int32_t *node = jet->node + 4 * (size_t)jet->facet_count++;
    const int chunk = jet->chunk_count - 1;
    bool triangle = record->corner_count == 3;
    facet->corner_count = (int8_t)record->corner_count;
    jet->side[jet->facet_count - 1] = (int8_t)sign;
    facet->target = target;
    for (int c = 0; c < 4; c++) {
        int corner = triangle && c == 3 ? 2 : c;
        node[c] = record->node[corner];
        facet->row[c] = row[corner * BILLOW_LANES] - jet->chunk_row[chunk];
        jet->row_node[jet->chunk_weight[chunk] + facet->row[c]] = node[c];
    }
}

/* The facets of one segment of elements. */
static void begin_chunk(const Model *m, const ElementGroup *group, int segment, Jet *jet)
{
    int chunk = jet->chunk_count++;
    jet->segment_chunk[segment] = chunk;
    jet->chunk_start[chunk] = jet->facet_count;
    jet->chunk_row[chunk] = m->row_start[segment];
    jet->chunk_weight[chunk] = jet->row_count;
    jet->row_count += m->row_start[segment + 1] - m->row_start[segment];
    const PressureSet *set = &m->pressure_sets[group->pressure_set];
    for (int k = 0; k < set->count; k++)
        if (set->source[k] == jet->airbag) jet->chunk_sign[chunk] = (int8_t)set->sign[k];
}

/* Room for the facets of the jet's bag. */
static int allocate_facets(Builder *b, Jet *jet)
{
    const Model *m = b->model;
    size_t count = 0, segments = (size_t)m->segment_count + 1;
    for (int i = 0; i < b->record_count; i++) count += source_place(&b->records[i], jet->airbag) >= 0;
    jet->facet = builder_alloc(b, count + 1, sizeof *jet->facet);
    jet->side = builder_alloc(b, count + 1, sizeof *jet->side);
    jet->node = builder_alloc(b, 4 * count + 1, sizeof *jet->node);
    jet->chunk_start = builder_alloc(b, segments, sizeof *jet->chunk_start);
    jet->segment_chunk = builder_alloc(b, segments, sizeof *jet->segment_chunk);
    jet->chunk_row = builder_alloc(b, segments, sizeof *jet->chunk_row);
    jet->chunk_weight = builder_alloc(b, segments, sizeof *jet->chunk_weight);
    jet->chunk_sign = builder_alloc(b, segments, sizeof *jet->chunk_sign);
    jet->row_node = builder_alloc(b, (size_t)m->row_count + 1, sizeof *jet->row_node);
    const void *needed[] = {jet->facet,        jet->side,       jet->node,     jet->chunk_start,  jet->chunk_row,
                            jet->chunk_weight, jet->chunk_sign, jet->row_node, jet->segment_chunk};
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        if (!needed[i]) return -1;
    for (int s = 0; s < m->segment_count; s++) jet->segment_chunk[s] = -1;
    return 0;
}

static int list_facets(Builder *b, const AirbagDefinition *bag, Jet *jet)
{
    Model *m = b->model;
    unsigned char *targets = memory_alloc((size_t)m->part_count + 1, 1);
    int status = targets ? find_targets(b, bag, targets) : -1;
    if (allocate_facets(b, jet)) status = -1;
    int first = 0, pushed = 0, segment = 0, last = -1;
    for (int g = 0; !status && g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        for (int e = 0; e < group->element_count; e++) {
            const ShellRecord *record = &b->records[b->order[first + e]];
            int place = source_place(record, jet->airbag);
            if (place < 0) continue;
            bool target = record->part >= 0 ? targets[record->part] : bag->jet.psid == 0;
            int block = e / BILLOW_LANES, chunk = group->first_chunk + block / BILLOW_CHUNK;
            while (m->segment_chunk[segment + 1] <= chunk) segment++;
            if (segment != last) begin_chunk(m, group, segment, jet);
            last = segment;
            const int32_t *row = group->row + block * group->corner_count * BILLOW_LANES + e % BILLOW_LANES;
            fill_facet(jet, record, record->sign[place], row, target);
            jet->facet[jet->facet_count - 1].slot = group->first_element + e;
            pushed += target;
        }
        first += group->element_count;
    }
    if (!status) jet->chunk_start[jet->chunk_count] = jet->facet_count;
    if (!status) jet->chunk_weight[jet->chunk_count] = jet->row_count;
    memory_free(targets);
    if (!status && pushed == 0) return jet_error(b, bag->jet.card10, "no part of PSID is on the surface of this bag");
    return status;
}

/* Solid angle of the triangle a b c seen from o (van Oosterom and Strackee 1983). */
static double solid_angle(const double o[3], const double *a, const double *b, const double *c)
{
    double u[3], v[3], w[3], n[3];
    vector3_subtract(a, o, u);
    vector3_subtract(b, o, v);
    vector3_subtract(c, o, w);
    vector3_cross(v, w, n);
    double p = vector3_norm(u), q = vector3_norm(v), r = vector3_norm(w);
    double below = p * q * r + vector3_dot(u, v) * r + vector3_dot(v, w) * p + vector3_dot(w, u) * q;
    return 2.0 * elementary_atan2(vector3_dot(u, n), below);
}

/* From outside the bag no inner face can be seen: warned of unless the bag is flat at the start. */
static void check_focus(Builder *b, const AirbagDefinition *bag, const Jet *jet)
{
    const SurfaceClosure *closure = &b->closures[jet->airbag];
    if (!(closure->volume > BILLOW_GAS_FLAT * closure->area * sqrt(closure->area))) return;
    double sum = 0.0;
    for (int f = 0; f < jet->facet_count; f++) {
        const double *x[4];
        for (int c = 0; c < 4; c++) x[c] = b->model->initial + 3 * (size_t)jet->node[4 * (size_t)f + (size_t)c];
        double angle = solid_angle(jet->focus, x[0], x[1], x[2]);
        if (jet->facet[f].corner_count == 4) angle += solid_angle(jet->focus, x[0], x[2], x[3]);
        sum += jet->side[f] * angle;
    }
    if (sum > 6.283185307179586) return; /* half of the full angle: holes let some of it out */
    diagnostics_add(
        b->diagnostics, SEVERITY_WARNING, bag->jet.card9, "*AIRBAG",
        "the jet's focal point (%.6g, %.6g, %.6g) lies outside the bag: it sees no inner face, so that the jet "
        "has no effect",
        jet->focus[0], jet->focus[1], jet->focus[2]);
}

static int build_jet(Builder *b, int number, Jet *jet)
{
    const AirbagDefinition *bag = &b->definitions->airbags.items[number];
    const JetCards *cards = &bag->jet;
    int status = 0;
    jet->airbag = number;
    jet->multiple = cards->multiple;
    jet->same_momentum = cards->cm;
    jet->react_node = jet->knock_curve = -1;
    if (place_jet(b, bag, jet)) status = -1;
    if (spread_jet(b, bag, jet)) status = -1;
    if (cards->nreact != 0) jet->react_node = find_node(b, cards->nreact, "NREACT", cards->card11, &status);
    if (bag->knkdn != 0)
        jet->knock_curve = deck_index_curve(&b->index, bag->knkdn, "KNKDN", bag->card5, "*AIRBAG", b->diagnostics);
    if (bag->knkdn != 0 && jet->knock_curve < 0) status = -1;
    if (jet->react_node >= 0 && !(b->model->mass[jet->react_node] > 0.0))
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, cards->card11, "*AIRBAG",
                        "NREACT = %d has no mass: nothing feels the jet's reaction", cards->nreact);
    if (list_facets(b, bag, jet)) status = -1;
    if (!status) check_focus(b, bag, jet);
    return status;
}

void mark_jet_nodes(Builder *b, unsigned char *special)
{
    for (size_t i = 0; i < b->definitions->airbags.count; i++) {
        const JetCards *cards = &b->definitions->airbags.items[i].jet;
        int32_t node = cards->given && cards->nreact != 0 ? id_map_find(&b->index.nodes, cards->nreact) : -1;
        if (node >= 0) special[node] = 1;
    }
}

int build_jets(Builder *b)
{
    Model *m = b->model;
    int count = 0, status = 0;
    for (int i = 0; i < m->airbag_count; i++) count += b->definitions->airbags.items[i].jet.given;
    if (count == 0) return 0;
    m->jets = builder_alloc(b, (size_t)count, sizeof *m->jets);
    if (!m->jets) return -1;
    for (int i = 0; i < m->airbag_count; i++) {
        if (!b->definitions->airbags.items[i].jet.given) continue;
        Jet *jet = &m->jets[m->jet_count++];
        jet->first_facet = m->jet_facet_count;
        jet->first_weight = m->jet_row_count;
        if (build_jet(b, i, jet)) status = -1;
        m->jet_facet_count += jet->facet_count;
        m->jet_row_count += jet->row_count;
    }
    return status;
}
