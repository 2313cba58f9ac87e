/* Ends of links and dampers: their nodes in the model's order, and the masses that bound the stable step. */
#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/vector3.h"

void mark_link_nodes(const Builder *b, unsigned char *special)
{
    const Model *m = b->model;
    for (int i = 0; i < 2 * m->link_count; i++)
        if (m->links[i / 2].node[i % 2] >= 0) special[m->links[i / 2].node[i % 2]] = 1;
    for (int i = 0; i < 2 * m->damper_count; i++)
        if (m->dampers[i / 2].node[i % 2] >= 0) special[m->dampers[i / 2].node[i % 2]] = 1;
}

void renumber_links(Builder *b, const int32_t *new_index)
{
    const Model *m = b->model;
    for (int i = 0; i < 2 * m->link_count; i++) {
        int32_t *node = &m->links[i / 2].node[i % 2];
        if (*node >= 0) *node = new_index[*node];
    }
    for (int i = 0; i < 2 * m->damper_count; i++) {
        int32_t *node = &m->dampers[i / 2].node[i % 2];
        if (*node >= 0) *node = new_index[*node];
    }
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

/* One end; the ground has none. */
typedef struct End {
    int32_t node;
    int id, part; /* of the element */
    double *inverse;
} End;

/* Where the node is fixed no mass is needed. */
static int check_mass(Builder *b, const End *end, double mobility)
{
    const Model *m = b->model;
    if (mobility > 0.0 || end->node >= m->moving_count) return 0;
    if (m->mass[end->node] > 0.0) return 0;
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, b->definitions->parts.items[end->part].source, "*PART",
                    "node %d of element %d of part %d has no mass; give the cable a VOL and RO or the node a mass by "
                    "*ELEMENT_MASS, or hold the node",
                    m->node_id[end->node], end->id, m->parts[end->part].id);
    return -1;
}

/* Mobility of each end, times the number of ends that hold the same node or body (K5, K11). share: one place for each
 * node and body, all 0. */
static int share_ends(Builder *b, const End *ends, int count, const int32_t *body_of, int32_t *share)
{
    const int nodes = b->model->node_count;
    int status = 0;
    for (int i = 0; i < count; i++) {
        const int32_t body = body_of[ends[i].node];
        share[body ? nodes + body - 1 : ends[i].node]++;
    }
    for (int i = 0; i < count; i++) {
        const int32_t body = body_of[ends[i].node];
        const double mobility = node_mobility(b, body_of, ends[i].node);
        *ends[i].inverse = share[body ? nodes + body - 1 : ends[i].node] * mobility;
        if (check_mass(b, &ends[i], mobility)) status = -1;
    }
    return status;
}

/* Links share the nodes' masses among themselves for their stiffness, dampers for their damping. */
int build_link_ends(Builder *b)
{
    Model *m = b->model;
    const size_t places = (size_t)m->node_count + (size_t)b->motion.rigid_body_count + 1;
    int link_ends = 0, damper_ends = 0;
    if (m->link_count + m->damper_count == 0) return 0;
    int32_t *share = memory_alloc(2 * places, sizeof *share), *body_of = memory_alloc(places, sizeof *body_of);
    End *ends = memory_alloc(2 * (size_t)(m->link_count + m->damper_count), sizeof *ends);
    int status = share && body_of && ends ? 0 : -1;
    for (int k = 0; !status && k < b->motion.rigid_body_count; k++)
        for (int n = 0; n < b->motion.rigid_bodies[k].node_count; n++)
            body_of[b->motion.rigid_bodies[k].node[n]] = k + 1;
    for (int i = 0; !status && i < 2 * m->link_count; i++) {
        Link *link = &m->links[i / 2];
        if (link->node[i % 2] >= 0)
            ends[link_ends++] = (End){link->node[i % 2], link->id, link->part, &link->inverse[i % 2]};
    }
    for (int i = 0; !status && i < 2 * m->damper_count; i++) {
        Damper *damper = &m->dampers[i / 2];
        if (damper->node[i % 2] >= 0)
            ends[link_ends + damper_ends++] =
                (End){damper->node[i % 2], damper->id, damper->part, &damper->inverse[i % 2]};
    }
    if (!status && share_ends(b, ends, link_ends, body_of, share)) status = -1;
    if (!status && share_ends(b, ends + link_ends, damper_ends, body_of, share + places)) status = -1;
    memory_free(share);
    memory_free(body_of);
    memory_free(ends);
    return status;
}
