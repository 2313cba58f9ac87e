/* *CONSTRAINED_SPOTWELD: seams of the model. */
#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/vector3.h"

#define KEYWORD "*CONSTRAINED_SPOTWELD"

#define REFUSE(b, card, ...) diagnostics_add((b)->diagnostics, SEVERITY_ERROR, (card)->source, KEYWORD, __VA_ARGS__)

/* Index in deck order of a node, -1 after an error. */
static int32_t find_node(Builder *b, const SpotweldDefinition *card, int k)
{
    const int32_t node = id_map_find(&b->index.nodes, card->node[k]);
    if (node < 0) REFUSE(b, card, "N%d names node %d, which is not defined", k + 1, card->node[k]);
    return node;
}

int build_seams(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    if (d->spotwelds.count == 0) return 0;
    const int errors = b->diagnostics->errors;
    m->seams = builder_alloc(b, d->spotwelds.count, sizeof *m->seams);
    unsigned char *used = memory_alloc((size_t)b->node_count + 1, 1);
    if (!m->seams || !used) {
        memory_free(used);
        return -1;
    }
    for (size_t i = 0; i < d->spotwelds.count; i++) {
        const SpotweldDefinition *card = &d->spotwelds.items[i];
        Seam *seam = &m->seams[i];
        *seam = (Seam){{find_node(b, card, 0), find_node(b, card, 1)}, card->sn, card->ss, card->n, card->m, card->tf};
        if (seam->node[0] < 0 || seam->node[1] < 0) continue;
        if (seam->node[0] == seam->node[1]) REFUSE(b, card, "N1 and N2 are both node %d", card->node[0]);
        for (int k = 0; k < 2; k++) {
            if (used[seam->node[k]] && seam->node[0] != seam->node[1])
                REFUSE(b, card, "node %d is in another spotweld already; billow joins nodes in pairs", card->node[k]);
            if (!(b->mass[seam->node[k]] > 0.0))
                REFUSE(b, card, "node %d has no mass; a spotweld joins nodes of deformable shells", card->node[k]);
            used[seam->node[k]] = 1;
        }
    }
    m->seam_count = (int)d->spotwelds.count;
    memory_free(used);
    return b->diagnostics->errors > errors ? -1 : 0;
}

void mark_seam_nodes(const Builder *b, unsigned char *special)
{
    for (int i = 0; i < b->model->seam_count; i++)
        for (int k = 0; k < 2; k++) special[b->model->seams[i].node[k]] = 1;
}

/* What else acts on velocities would be at odds with a seam. */
void mark_bound_nodes(const Model *m, unsigned char *bound)
{
    const Constraints *c = &m->constraints;
    for (int i = 0; i < c->support_count; i++) bound[c->supports[i].node] = 1;
    for (int i = 0; i < c->node_motion_count; i++) bound[c->motions[i].node] = 1;
    for (int i = 0; i < c->hanging_count; i++) {
        bound[c->hanging[i].node] = 1;
        for (int k = 0; k < 2; k++) bound[c->hanging[i].end[k]] = 1;
    }
    for (int i = 0; i < m->rigid_body_count; i++)
        for (int k = 0; k < m->rigid_bodies[i].node_count; k++) bound[m->rigid_bodies[i].node[k]] = 1;
    for (int n = m->moving_count; n < m->node_count; n++) bound[n] = 1;
}

/* How far apart the nodes are: they keep this vector, which does not turn. */
static void warn_apart(Builder *b)
{
    const Model *m = b->model;
    int count = 0;
    double farthest = 0.0;
    for (int i = 0; i < m->seam_count; i++) {
        double way[3];
        vector3_subtract(m->initial + 3 * (ptrdiff_t)m->seams[i].node[0],
                         m->initial + 3 * (ptrdiff_t)m->seams[i].node[1], way);
        const double distance = vector3_norm(way);
        count += distance > 0.0;
        if (distance > farthest) farthest = distance;
    }
    if (count > 0)
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, b->definitions->spotwelds.items[0].source, KEYWORD,
            "%d of %d spotwelds join nodes that are apart, by up to %.4g: the vector between them is kept and "
            "does not turn, so that they take up moments",
            count, m->seam_count, farthest);
}

int build_seam_nodes(Builder *b)
{
    Model *m = b->model;
    if (m->seam_count == 0) return 0;
    const int errors = b->diagnostics->errors;
    unsigned char *bound = memory_alloc((size_t)m->node_count + 1, 1);
    if (!bound) return -1;
    mark_bound_nodes(m, bound);
    for (int i = 0; i < m->seam_count; i++) {
        const SpotweldDefinition *card = &b->definitions->spotwelds.items[i];
        int32_t node[2];
        for (int k = 0; k < 2; k++) {
            node[k] = m->seams[i].node[k] = m->deck_node[m->seams[i].node[k]];
            if (bound[node[k]])
                REFUSE(b, card,
                       "node %d is also held, driven, hanging or part of a rigid body, which a spotweld cannot "
                       "share; put the other node in *CONSTRAINED_EXTRA_NODES or the like",
                       card->node[k]);
        }
        for (int c = 0; m->velocity && c < 3; c++)
            if (m->velocity[3 * (ptrdiff_t)node[0] + c] != m->velocity[3 * (ptrdiff_t)node[1] + c]) {
                REFUSE(b, card, "nodes %d and %d start with different velocities", card->node[0], card->node[1]);
                break;
            }
    }
    memory_free(bound);
    if (m->relax.kind != RELAX_NONE)
        REFUSE(b, &b->definitions->spotwelds.items[0],
               "the phase before the run (--relax, *CONTROL_DYNAMIC_RELAXATION) does not know seams; leave out one of "
               "the two");
    warn_apart(b);
    return b->diagnostics->errors > errors ? -1 : 0;
}
