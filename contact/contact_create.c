/* Contact before and after the loop: memory, the state that a restart goes on from. */
#include <math.h>
#include <string.h>

#include "contact/contact_grid.h"
#include "contact/contact_loop.h"
#include "solver/memory.h"
#include "solver/vector3.h"

static int list_create(ContactList *list, int owners)
{
    list->owner_count = owners;
    list->chunk_count = (owners + CONTACT_CHUNK - 1) / CONTACT_CHUNK;
    list->sums = memory_alloc((size_t)list->chunk_count + 1, sizeof *list->sums);
    list->passages = memory_alloc((size_t)list->chunk_count + 1, sizeof *list->passages);
    list->memory = memory_alloc((size_t)owners * CONTACT_SLOTS + 1, sizeof *list->memory);
    list->depth = memory_alloc((size_t)owners + 1, sizeof *list->depth);
    list->idle = memory_alloc((size_t)list->chunk_count + 1, sizeof *list->idle);
    return list->sums && list->passages && list->memory && list->depth && list->idle ? 0 : -1;
}

static void pairs_free(ContactPairs *pairs)
{
    memory_free(pairs->start);
    memory_free(pairs->other);
    memory_free(pairs->wake);
    memory_free(pairs->slot);
}

static void list_free(ContactList *list)
{
    pairs_free(&list->pairs);
    pairs_free(&list->before);
    memory_free(list->memory);
    memory_free(list->depth);
    memory_free(list->idle);
    memory_free(list->forces);
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
        memory_free(loop->runs[i].plane);
        memory_free(loop->runs[i].used);
        memory_free(loop->runs[i].calm);
    }
    contact_grid_free(&loop->grid);
    memory_free(loop->box);
    for (int k = 0; loop->parts && k < BILLOW_MAX_THREADS; k++) {
        memory_free(loop->parts[k].other);
        memory_free(loop->parts[k].height);
        memory_free(loop->parts[k].found.item);
    }
    memory_free(loop->parts);
    memory_free(loop->written);
    memory_free(loop->room);
    memory_free(loop->around);
    memory_free(loop->runs);
    memory_free(loop->resultant);
    memory_free(loop->motions);
    memory_free(loop);
}

/* Largest speeds of the chunks of nodes at the start. */
static void fill_speeds(ContactLoop *loop)
{
    const Model *m = loop->model;
    double fastest = 0.0;
    for (int n = 0; n < m->moving_count; n++) {
        const double *v = loop->state->v + 3 * (ptrdiff_t)n;
        ContactMotion *motion = &loop->motions[n / CONTACT_NODE_CHUNK];
        motion->fastest = fmax(motion->fastest, vector3_dot(v, v));
        fastest = fmax(fastest, motion->fastest);
    }
    loop->fastest = sqrt(fastest);
    for (int i = 0; i < m->contact_count; i++) contact_move_groups(loop, &loop->runs[i], 0.0);
}

/* Can two nodes have come nearer by the skin since the last search? */
static bool has_moved(const Model *m, const State *state)
{
    ContactDrift drift = {0};
    for (int n = 0; n < m->moving_count; n++)
        for (int k = 0; k < 3; k++) {
            double way = state->x[3 * (ptrdiff_t)n + k] - state->contact_searched[3 * (ptrdiff_t)n + k];
            contact_drift_add(&drift, k, way, way);
        }
    return contact_drift_exceeds(&drift, state->contact->skin);
}

/* Memories of the State go to their pairs after the first search. */
static void restore_memories(ContactLoop *loop)
{
    for (int i = 0; i < loop->model->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        const ContactMemory *stored = loop->state->contact_memory + run->contact->first_memory;
        for (int k = 0; k < loop->state->contact_memories[i]; k++) {
            bool edge = stored[k].pair[0] >= run->contact->node_count;
            ContactPairs *pairs = edge ? &run->edges.pairs : &run->faces.pairs;
            int owner = edge ? stored[k].pair[0] - run->contact->node_count : stored[k].pair[0];
            for (int32_t p = pairs->start[owner]; p < pairs->start[owner + 1]; p++)
                if (pairs->other[p] == stored[k].pair[1])
                    contact_keep(edge ? &run->edges : &run->faces, owner, p, &stored[k]);
        }
    }
}

static int run_create(ContactLoop *loop, int i)
{
    ContactRun *run = &loop->runs[i];
    const ContactInterface *c = &loop->model->contacts[i];
    size_t triangles = (size_t)c->triangle_count + 1;
    run->contact = c;
    run->force = loop->resultant + 3 * (ptrdiff_t)i;
    run->plane = memory_alloc(4 * triangles, sizeof(double));
    run->used = memory_alloc(triangles, 1);
    run->calm = memory_alloc(triangles, 1);
    if (!run->plane || !run->used || !run->calm) return -1;
    return list_create(&run->faces, c->node_count) || list_create(&run->edges, c->edge_count) ||
                   contact_groups_create(&run->nodes, loop->model, c->node_count, 1, c->node) ||
                   contact_groups_create(&run->triangles, loop->model, c->triangle_count, 3, c->triangle) ||
                   contact_groups_create(&run->lines, loop->model, c->edge_count, 2, c->edge)
               ? -1
               : 0;
}

ContactLoop *contact_create(const Model *model, State *state, double *rows, const double *pressure)
{
    ContactLoop *loop = memory_alloc(1, sizeof *loop);
    if (!loop) return NULL;
    loop->model = model;
    loop->state = state;
    loop->rows = rows;
    loop->pressure = pressure;
    loop->corner = rows + CONTACT_ROW * (ptrdiff_t)model->contact_row;
    loop->runs = memory_alloc((size_t)model->contact_count, sizeof *loop->runs);
    loop->parts = memory_alloc(BILLOW_MAX_THREADS, sizeof *loop->parts);
    loop->motion_count = (model->moving_count + CONTACT_NODE_CHUNK - 1) / CONTACT_NODE_CHUNK;
    loop->motions = memory_alloc((size_t)loop->motion_count + 1, sizeof *loop->motions);
    loop->written = memory_alloc((size_t)model->node_count / CONTACT_NODE_CHUNK + 1, 1);
    loop->room = memory_alloc(6 * (size_t)model->node_count, sizeof(double));
    loop->around = memory_alloc((size_t)model->node_count, sizeof(double));
    loop->resultant = memory_alloc(3 * (size_t)model->contact_count, sizeof(double));
    int status =
        loop->runs && loop->parts && loop->motions && loop->written && loop->resultant && loop->room && loop->around
            ? 0
            : -1;
    for (int i = 0; !status && i < model->contact_count; i++) status = run_create(loop, i);
    if (!status && state->contact->started) {
        loop->restored = true;
        contact_search(loop, 0, NULL);
        loop->restored = false;
        if (!loop->out_of_memory) restore_memories(loop);
        loop->search_due = has_moved(model, state);
        for (int n = 0; n < model->node_count; n++)
            loop->corner[CONTACT_ROW * (ptrdiff_t)n + 3] = state->contact_load[n];
        memset(loop->written, 1, (size_t)model->node_count / CONTACT_NODE_CHUNK + 1);
    } else {
        loop->search_due = true;
    }
    if (status || loop->out_of_memory) {
        contact_free(loop);
        return NULL;
    }
    fill_speeds(loop);
    return loop;
}
