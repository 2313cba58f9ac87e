/* *CONTACT_ENTITY -> contact entities: their parts and probes; then the same in the model's order of nodes. */
#include <math.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/vector3.h"

static const char KEYWORD[] = "*CONTACT_ENTITY";

enum { MOST_ORDER = 5 };

/* The rigid part that the shape goes with. */
static int find_part(Builder *b, const EntityDefinition *d, ContactEntity *entity)
{
    const Definitions *all = b->definitions;
    int32_t part = id_map_find(&b->index.parts, d->pid);
    entity->part_id = d->pid;
    if (part >= 0 && all->materials.items[b->parts[part].material].kind == MATERIAL_RIGID) return 0;
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->card1, KEYWORD,
                    part < 0 ? "PID = %d is not a part of this deck; name the rigid part that the shape moves with"
                             : "part %d is not rigid; give it a *MAT_RIGID: the shape moves with it",
                    d->pid);
    return -1;
}

/* Who is named: a mark for each shell (by parts) or node. */
static int mark_named(Builder *b, const EntityDefinition *d, unsigned char *node, unsigned char *shell)
{
    IndexList list = {0};
    int status = 0;
    if (d->sstyp == 0) {
        status = sets_resolve_nodes(&b->index, d->ssid, d->card1, KEYWORD, &list, b->diagnostics);
        for (size_t k = 0; k < list.count; k++) node[list.items[k]] = 1;
    } else if (d->sstyp == 2) {
        status = sets_resolve_parts(&b->index, d->ssid, d->card1, KEYWORD, &list, b->diagnostics);
    } else {
        int32_t part = id_map_find(&b->index.parts, d->ssid);
        if (part < 0)
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->card1, KEYWORD, "SSID = %d is not a part of this deck",
                            d->ssid);
        status = part < 0 || index_list_add(&list, part) ? -1 : 0;
    }
    for (size_t k = 0; d->sstyp != 0 && !status && k < list.count; k++) {
        int32_t part = list.items[k];
        for (int32_t i = b->index.part_shell_start[part]; i < b->index.part_shell_start[part + 1]; i++) {
            const ShellRecord *r = &b->records[b->index.part_shell[i]];
            shell[b->index.part_shell[i]] = 1;
            for (int a = 0; a < r->corner_count; a++) node[r->node[a]] = 1;
        }
    }
    index_list_free(&list);
    return status;
}

/* Points and weights of the rule by Gauss and Legendre on (-1, 1), positive half. */
static double gauss_point(int order, int i)
{
    static const double points[MOST_ORDER][MOST_ORDER] = {
        {0.0},
        {-0.57735026918962576, 0.57735026918962576},
        {-0.77459666924148338, 0.0, 0.77459666924148338},
        {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258},
        {-0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309, 0.90617984593866399}};
    return points[order - 1][i];
}

/* Adds the points within one shell: of a quadrilateral by Gauss's rule, of a triangle in even rows. */
static void add_points(ContactEntity *entity, const ShellRecord *r, int order, double radius)
{
    for (int i = 0; i < order; i++)
        for (int j = 0; j < (r->corner_count == 3 ? order - i : order); j++) {
            ptrdiff_t p = entity->probe_count++;
            double *w = entity->weight + 4 * p, s = gauss_point(order, i), t = gauss_point(order, j);
            for (int a = 0; a < 4; a++) entity->node[4 * p + a] = r->node[a < r->corner_count ? a : 2];
            if (r->corner_count == 3) {
                w[0] = (i + 1.0 / 3.0) / order;
                w[1] = (j + 1.0 / 3.0) / order;
                w[2] = 1.0 - w[0] - w[1];
            } else {
                const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
                for (int a = 0; a < 4; a++) w[a] = 0.25 * (1 + s * corner[a][0]) * (1 + t * corner[a][1]);
            }
            entity->radius[p] = radius;
        }
}

/* Probes of the named nodes and shells, in deck order. */
static int make_probes(Builder *b, const EntityDefinition *d, const unsigned char *node, const unsigned char *shell,
                       ContactEntity *entity)
{
    size_t most = 1;
    double *thickness = memory_alloc((size_t)b->node_count + 1, sizeof *thickness);
    if (!thickness) return -1;
    for (int s = 0; s < b->shell_count; s++) {
        const ShellRecord *r = &b->records[s];
        for (int a = 0; a < r->corner_count; a++) thickness[r->node[a]] = fmax(thickness[r->node[a]], r->thickness);
        if (shell[s]) most += (size_t)d->intord * (size_t)d->intord;
    }
    for (int n = 0; n < b->node_count; n++) most += node[n];
    entity->node = builder_alloc(b, 4 * most, sizeof *entity->node);
    entity->weight = builder_alloc(b, 4 * most, sizeof *entity->weight);
    entity->radius = builder_alloc(b, most, sizeof *entity->radius);
    int status = entity->node && entity->weight && entity->radius ? 0 : -1;
    for (int n = 0; !status && n < b->node_count; n++) {
        if (!node[n]) continue;
        ptrdiff_t p = entity->probe_count++;
        for (int a = 0; a < 4; a++) entity->node[4 * p + a] = n;
        entity->weight[4 * p] = 1.0;
        entity->radius[p] = d->ithk == 1 ? 0.5 * thickness[n] : 0.0;
    }
    entity->node_count = entity->probe_count;
    for (int s = 0; !status && s < b->shell_count && d->intord > 0; s++)
        if (shell[s]) add_points(entity, &b->records[s], d->intord, d->ithk == 1 ? 0.5 * b->records[s].thickness : 0.0);
    memory_free(thickness);
    return status;
}

static int resolve(Builder *b, const EntityDefinition *d, ContactEntity *entity)
{
    unsigned char *node = memory_alloc((size_t)b->node_count + 1, 1),
                  *shell = memory_alloc((size_t)b->shell_count + 1, 1);
    int status = node && shell ? mark_named(b, d, node, shell) : -1;
    if (!status) status = make_probes(b, d, node, shell, entity);
    memory_free(node);
    memory_free(shell);
    if (!status && entity->probe_count == 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->card1, KEYWORD,
                        "SSID = %d of type %d holds no nodes, so nothing can meet the shape", d->ssid, d->sstyp);
        status = -1;
    }
    return status;
}

int build_entities(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    int status = 0;
    if (d->entities.count == 0) return 0;
    m->entities = builder_alloc(b, d->entities.count, sizeof *m->entities);
    if (!m->entities) return -1;
    m->entity_count = (int)d->entities.count;
    for (int i = 0; i < m->entity_count; i++) {
        const EntityDefinition *definition = &d->entities.items[i];
        ContactEntity *entity = &m->entities[i];
        *entity = (ContactEntity){.id = i + 1,
                                  .source = definition->card1,
                                  .inside = definition->inout == 1,
                                  .friction = definition->cf,
                                  .damping = 0.01 * definition->df,
                                  .stiffness = 0.1 * definition->sf,
                                  .birth = definition->birth,
                                  .death = definition->death};
        if (find_part(b, definition, entity) | build_entity_shape(b, definition, entity) |
            resolve(b, definition, entity))
            status = -1;
    }
    return status;
}

/* Does any node of the probe move by itself, and none belong to the body of the shape? */
static bool probe_counts(const Builder *b, const ContactEntity *entity, ptrdiff_t p, int body)
{
    bool moves = false;
    for (int a = 0; a < 4; a++) {
        int32_t node = entity->node[4 * p + a];
        if (entity->weight[4 * p + a] == 0.0) continue;
        if (b->motion.node_body[node] == body) return false;
        moves = moves || b->model->contact_inverse[node] > 0.0;
    }
    return moves;
}

int build_entity_nodes(Builder *b)
{
    Model *m = b->model;
    for (int i = 0; i < m->entity_count; i++) {
        ContactEntity *e = &m->entities[i];
        int32_t part = id_map_find(&b->index.parts, e->part_id);
        int body = b->motion.part_body[part], all = e->probe_count, nodes = e->node_count;
        e->body = body >= 0 ? body : -1;
        for (ptrdiff_t k = 0; k < 4 * (ptrdiff_t)all; k++) e->node[k] = m->deck_node[e->node[k]];
        e->probe_count = e->node_count = 0;
        for (ptrdiff_t p = 0; p < all; p++) {
            if (!probe_counts(b, e, p, body)) continue;
            ptrdiff_t q = e->probe_count++;
            e->node_count += p < nodes;
            memmove(e->node + 4 * q, e->node + 4 * p, 4 * sizeof *e->node);
            memmove(e->weight + 4 * q, e->weight + 4 * p, 4 * sizeof *e->weight);
            e->radius[q] = e->radius[p];
            e->thickest = fmax(e->thickest, e->radius[q]);
        }
        if (e->probe_count == 0)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, e->source, KEYWORD,
                            "entity %d has no nodes to act on: none that SSID names moves apart from part %d", e->id,
                            e->part_id);
        e->first_memory = m->entity_probe_count;
        m->entity_probe_count += (size_t)e->probe_count;
    }
    return 0;
}
