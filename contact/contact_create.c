/* Contact before and after the loop: memory, the state that a restart goes on from. */
#include <math.h>
#include <string.h>

#include "contact/contact_erosion.h"
#include "contact/contact_grid.h"
#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "contact/contact_patches.h"
#include "contact/entity_loop.h"
#include "solver/memory.h"
#include "solver/vector3.h"

static int list_create(ContactList *list, int owners)
{
    size_t groups = (size_t)(owners + CONTACT_GROUP - 1) / CONTACT_GROUP;
    list->owner_count = owners;
    list->group_count = (int)groups;
    list->sums = memory_alloc(groups + 1, sizeof *list->sums);
    list->pieces = memory_alloc(groups + 1, sizeof *list->pieces);
    list->passages = memory_alloc(groups + 1, sizeof *list->passages);
    list->candidates = memory_alloc(groups + 1, sizeof *list->candidates);
    list->start = memory_alloc(groups + 1, sizeof *list->start);
    list->next_start = memory_alloc(groups + 1, sizeof *list->next_start);
    list->deepest = memory_alloc(groups + 1, sizeof *list->deepest);
    list->allowed = memory_alloc(groups + 1, sizeof *list->allowed);
    list->holds = memory_alloc(groups + 1, 1);
    list->memory = memory_alloc((size_t)owners * CONTACT_SLOTS + 1, sizeof *list->memory);
    list->held = memory_alloc((size_t)owners + 1, 1);
    list->partner = memory_alloc((size_t)owners * CONTACT_SLOTS + 1, sizeof *list->partner);
    list->depth = memory_alloc((size_t)owners + 1, sizeof *list->depth);
    return list->sums && list->pieces && list->passages && list->start && list->next_start && list->deepest &&
                   list->allowed && list->holds && list->candidates && list->memory && list->held && list->partner &&
                   list->depth
               ? 0
               : -1;
}

static void list_free(ContactList *list)
{
    for (int g = 0; list->candidates && g < list->group_count; g++) contact_candidates_free(&list->candidates[g]);
    memory_free(list->candidates);
    memory_free(list->memory);
    memory_free(list->held);
    memory_free(list->holds);
    memory_free(list->partner);
    memory_free(list->depth);
    memory_free(list->deepest);
    memory_free(list->allowed);
    memory_free(list->start);
    contact_pairs_free(&list->pairs);
    memory_free(list->next_start);
    contact_pairs_free(&list->next);
    memory_free(list->pieces);
    memory_free(list->sums);
    memory_free(list->passages);
}

void contact_free(ContactLoop *loop)
{
    if (!loop) return;
    for (int i = 0; loop->runs && i < loop->model->contact_count; i++) {
        list_free(&loop->runs[i].faces);
        list_free(&loop->runs[i].edges);
        contact_groups_free(&loop->runs[i].nodes);
        contact_groups_free(&loop->runs[i].triangles);
        contact_groups_free(&loop->runs[i].lines);
        contact_living_free(&loop->runs[i]);
        memory_free(loop->runs[i].line_body);
        memory_free(loop->runs[i].line_shell);
        memory_free(loop->runs[i].line_wing);
        memory_free(loop->runs[i].line_place);
        memory_free(loop->runs[i].sharp);
        contact_records_free(&loop->runs[i]);
    }
    entities_free(loop->entities, loop->model);
    contact_grid_free(&loop->grid);
    memory_free(loop->box);
    for (int k = 0; loop->parts && k < BILLOW_MAX_THREADS; k++) {
        contact_pairs_free(&loop->parts[k].pairs);
        memory_free(loop->parts[k].force);
        memory_free(loop->parts[k].near);
        for (int p = 0; p < CONTACT_TURN; p++) memory_free(loop->parts[k].woken[p]);
        memory_free(loop->parts[k].limit);
        contact_sorting_free(&loop->parts[k].sorting);
        memory_free(loop->parts[k].other);
        memory_free(loop->parts[k].faces);
        memory_free(loop->parts[k].edges);
        memory_free(loop->parts[k].push);
        memory_free(loop->parts[k].pull);
        memory_free(loop->parts[k].pull_cycle);
        memory_free(loop->parts[k].found.item);
        memory_free(loop->parts[k].place);
    }
    memory_free(loop->parts);
    memory_free(loop->written);
    memory_free(loop->node);
    memory_free(loop->covered);
    memory_free(loop->around);
    memory_free(loop->pulled);
    memory_free(loop->mark);
    memory_free(loop->runs);
    memory_free(loop->resultant);
    memory_free(loop->motions);
    memory_free(loop->skin.from);
    memory_free(loop->skin.of);
    memory_free(loop);
}

/* Largest speed at the start. */
static double find_fastest(const Model *m, const State *state)
{
    double fastest = 0.0;
    for (int n = 0; n < m->moving_count; n++) {
        const double *v = state->v + 3 * (ptrdiff_t)n;
        fastest = fmax(fastest, vector3_dot(v, v));
    }
    return sqrt(fastest);
}

/* Memories of the State go to their pairs. */
static void restore_memories(ContactLoop *loop)
{
    for (int i = 0; i < loop->model->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        const ContactMemory *stored = loop->state->contact_memory + run->contact->first_memory;
        for (int k = 0; k < loop->state->contact_memories[i]; k++) {
            bool edge = stored[k].pair[0] >= run->contact->node_count;
            int owner = edge ? stored[k].pair[0] - run->contact->node_count : stored[k].pair[0];
            contact_keep(edge ? &run->edges : &run->faces, owner, stored[k].pair[1], &stored[k]);
        }
        memset(run->faces.holds, 1, (size_t)run->faces.group_count);
        memset(run->edges.holds, 1, (size_t)run->edges.group_count);
        for (int k = 0; k < run->nodes.count * CONTACT_GROUP; k++) {
            int g = k / CONTACT_GROUP, node = run->nodes.lanes[g].item[k % CONTACT_GROUP];
            if (node >= 0) run->faces.deepest[g] = fmax(run->faces.deepest[g], run->faces.depth[node]);
        }
    }
}

/* Items that share a node are neighbours. */
static int group_items(ContactGroups *groups, const ContactItems *items, int nodes)
{
    int links = items->count * items->corners, status = -1;
    int32_t *item = memory_alloc((size_t)links + 1, sizeof *item);
    int32_t *order = memory_alloc((size_t)items->count + 1, sizeof *order);
    for (int k = 0; item && k < links; k++) item[k] = k / items->corners;
    if (item && order) status = contact_patches(items->count, nodes, links, item, items->node, CONTACT_GROUP, order);
    if (!status) status = contact_groups_create(groups, items, order);
    memory_free(item);
    memory_free(order);
    return status;
}

/* Nodes of one triangle are neighbours. */
static int group_nodes(ContactGroups *groups, const ContactInterface *c, const ContactItems *items, int nodes)
{
    int links = 0, status = -1;
    int32_t *place_of = memory_alloc((size_t)nodes + 1, sizeof *place_of);
    int32_t *item = memory_alloc(3 * (size_t)c->triangle_count + 1, sizeof *item);
    int32_t *place = memory_alloc(3 * (size_t)c->triangle_count + 1, sizeof *place);
    int32_t *order = memory_alloc((size_t)items->count + 1, sizeof *order);
    if (place_of && item && place && order) {
        for (int k = 0; k < c->node_count; k++) place_of[c->node[k]] = k + 1;
        for (int k = 0; k < 3 * c->triangle_count; k++) {
            if (place_of[c->triangle[k]] == 0) continue; /* a triangle that only other nodes meet */
            item[links] = place_of[c->triangle[k]] - 1;
            place[links++] = k / 3;
        }
        status = contact_patches(c->node_count, c->triangle_count, links, item, place, CONTACT_GROUP, order);
        if (!status) status = contact_groups_create(groups, items, order);
    }
    memory_free(place_of);
    memory_free(item);
    memory_free(place);
    memory_free(order);
    return status;
}

/* The corner of a triangle that an edge lacks. A free edge or a branch has none: its wings have no area. */
static int32_t wing_of(const ContactInterface *c, int e, int32_t triangle)
{
    const int32_t *ends = c->edge + 2 * (ptrdiff_t)e;
    for (int k = 0; k < 3 && triangle >= 0; k++) {
        int32_t node = c->triangle[3 * (ptrdiff_t)triangle + k];
        if (node != ends[0] && node != ends[1]) return node;
    }
    return ends[0];
}

void contact_items(ContactRun *run, ContactItems items[3])
{
    const ContactInterface *c = run->contact;
    items[0] = (ContactItems){c->node_count, 1, c->node, c->node_side, c->node_body, c->node_radius, NULL, NULL, NULL};
    items[1] = (ContactItems){
        c->triangle_count,  3,   c->triangle, c->triangle_side, c->triangle_body, c->triangle_radius, c->triangle_shell,
        c->triangle_fourth, NULL};
    items[2] = (ContactItems){c->edge_count,   2,    c->edge,       c->edge_side, run->line_body, c->edge_radius,
                              run->line_shell, NULL, run->line_wing};
    for (int e = 0; e < c->edge_count; e++) {
        for (int k = 0; k < 2; k++) run->line_wing[2 * e + k] = wing_of(c, e, c->edge_triangle[2 * e + k]);
        run->line_body[e] = c->triangle_body[c->edge_triangle[2 * e]];
        run->line_shell[e] = c->triangle_shell[c->edge_triangle[2 * e]];
    }
}

static int groups_create(ContactRun *run, int nodes)
{
    ContactItems items[3];
    contact_items(run, items);
    if (group_nodes(&run->nodes, run->contact, &items[0], nodes) || group_items(&run->triangles, &items[1], nodes) ||
        group_items(&run->lines, &items[2], nodes))
        return -1;
    for (int k = 0; k < run->lines.count * CONTACT_GROUP; k++) {
        int32_t e = run->lines.lanes[k / CONTACT_GROUP].item[k % CONTACT_GROUP];
        if (e >= 0) run->line_place[e] = k;
    }
    return 0;
}

static int run_create(ContactLoop *loop, int i)
{
    ContactRun *run = &loop->runs[i];
    const ContactInterface *c = &loop->model->contacts[i];
    run->contact = c;
    if (loop->model->has_erosion && contact_living_create(run, c, loop->model->node_count)) return -1;
    run->force = loop->resultant + 3 * (ptrdiff_t)i;
    run->line_body = memory_alloc((size_t)c->edge_count + 1, sizeof *run->line_body);
    run->line_shell = memory_alloc((size_t)c->edge_count + 1, sizeof *run->line_shell);
    run->line_wing = memory_alloc(2 * (size_t)c->edge_count + 1, sizeof *run->line_wing);
    run->line_place = memory_alloc((size_t)c->edge_count + 1, sizeof *run->line_place);
    run->sharp = memory_alloc((size_t)c->edge_count / CONTACT_GROUP + 1, sizeof *run->sharp);
    if (!run->line_body || !run->line_shell || !run->line_wing || !run->line_place || !run->sharp) return -1;
    if (contact_records_create(run)) return -1;
    contact_records_fill(run, loop->model);
    return list_create(&run->faces, c->node_count) || list_create(&run->edges, c->edge_count) ||
                   groups_create(run, loop->model->node_count)
               ? -1
               : 0;
}

static void choose_kernels(ContactLoop *loop)
{
    const KernelTable *table = kernels_select(NULL);
    int level = table ? table->level : 2;
    loop->kernels = level == 4 ? &near_kernels_v4 : level == 3 ? &near_kernels_v3 : &near_kernels_v2;
    loop->motion_kernels = level == 4 ? &motion_kernels_v4 : level == 3 ? &motion_kernels_v3 : &motion_kernels_v2;
    loop->sharp_kernels = level == 4 ? &sharp_kernels_v4 : level == 3 ? &sharp_kernels_v3 : &sharp_kernels_v2;
    loop->push_kernels = level == 4 ? &push_kernels_v4 : level == 3 ? &push_kernels_v3 : &push_kernels_v2;
    loop->meet_kernels = level == 4 ? &meet_kernels_v4 : level == 3 ? &meet_kernels_v3 : &meet_kernels_v2;
    loop->grid.overlap = loop->motion_kernels->overlap;
}

ContactLoop *contact_create(const Model *model, State *state, double *rows, const double *pressure)
{
    ContactLoop *loop = memory_alloc(1, sizeof *loop);
    if (!loop) return NULL;
    loop->model = model;
    loop->state = state;
    choose_kernels(loop);
    loop->rows = rows;
    loop->pressure = pressure;
    loop->corner = rows + CONTACT_ROW * (ptrdiff_t)model->contact_row;
    loop->runs = memory_alloc((size_t)model->contact_count + 1, sizeof *loop->runs);
    loop->parts = memory_alloc(BILLOW_MAX_THREADS, sizeof *loop->parts);
    loop->motion_count = (model->moving_count + CONTACT_NODE_CHUNK - 1) / CONTACT_NODE_CHUNK;
    loop->motions = memory_alloc((size_t)loop->motion_count + 1, sizeof *loop->motions);
    loop->skin.from = memory_alloc(3 * (size_t)model->node_count, sizeof(double));
    loop->skin.of = memory_alloc((size_t)model->node_count / CONTACT_NODE_CHUNK + 1, sizeof(double));
    loop->written = memory_alloc((size_t)model->node_count / CONTACT_NODE_CHUNK + 1, 1);
    loop->node = memory_alloc((size_t)model->node_count, sizeof *loop->node);
    loop->around = memory_alloc((size_t)model->node_count, sizeof(double));
    loop->covered = memory_alloc((size_t)model->node_count, 1);
    loop->pulled = contact_list_pulled(model);
    loop->resultant = memory_alloc(3 * (size_t)model->contact_count + 1, sizeof(double));
    if (model->entity_count > 0) loop->entities = entities_create(model, state);
    int status = loop->runs && loop->parts && loop->motions && loop->skin.from && loop->skin.of && loop->written &&
                         loop->resultant && loop->node && loop->around && loop->covered && loop->pulled &&
                         (model->entity_count == 0 || loop->entities)
                     ? 0
                     : -1;
    for (int n = 0; !status && n < model->node_count; n++) loop->node[n].inverse = model->contact_inverse[n];
    for (int i = 0; !status && i < model->contact_count; i++) status = run_create(loop, i);
    if (model->has_erosion) {
        loop->mark = memory_alloc((size_t)model->node_count + 1, 1);
        if (!loop->mark) status = -1;
        if (!status && *state->eroded_count > 0) contact_erode(loop);
        loop->eroded_seen = *state->eroded_count;
    }
    if (!status && state->contact->started) {
        contact_fill_room(loop, 0, 1);
        restore_memories(loop);
        for (int n = 0; n < model->node_count; n++) {
            loop->node[n].load = state->contact_load[2 * (ptrdiff_t)n];
            loop->node[n].firm = state->contact_load[2 * (ptrdiff_t)n + 1];
        }
        memset(loop->written, 1, (size_t)model->node_count / CONTACT_NODE_CHUNK + 1);
    }
    loop->search_due = true;
    if (status) {
        contact_free(loop);
        return NULL;
    }
    loop->fastest = find_fastest(model, state);
    return loop;
}
