/* Contact in the time loop: when to search, the work of the threads, sums (docs/theory.md, Contact). */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "contact/contact_erosion.h"
#include "contact/contact_push.h"
#include "contact/contact_skin.h"
#include "contact/entity_loop.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* Share of a step by which the step that contact reckons with may fall short of the last one (eq. C4b). */
#define STEP_FALL 0.1

static double clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Velocities of a thread's share of the groups in pairs, now. */
static void follow_groups(ContactLoop *loop, int thread, int threads)
{
    for (int i = 0; i < loop->model->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        ContactGroups *all[3] = {&run->nodes, &run->triangles, &run->lines};
        for (int k = 0; k < 3; k++) {
            int64_t count = all[k]->count;
            loop->motion_kernels->follow(all[k], loop->state->v, (int)(count * thread / threads),
                                         (int)(count * (thread + 1) / threads));
        }
    }
}

/* Half of the room is for the springs of friction, if there is any. */
static double room_for_sliding(const Model *m)
{
    bool rubs = false;
    for (int i = 0; i < m->contact_count; i++)
        rubs = rubs || m->contacts[i].static_friction > 0.0 || m->contacts[i].dynamic_friction > 0.0;
    return rubs ? 0.5 * contact_room_left(m) : 0.0;
}

void contact_search(ContactLoop *loop, int thread, Team *team)
{
    double since = clock_seconds();
    contact_find_pairs(loop, thread, team);
    if (thread != 0) return;
    loop->searches++;
    loop->search_seconds += clock_seconds() - since;
}

static void set_thinness(ContactLoop *loop)
{
    const Model *m = loop->model;
    for (int i = 0; i < m->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        const ContactInterface *c = run->contact;
        run->thinness = 1.0;
        run->alive = loop->step.time >= c->birth && loop->step.time < c->death;
        if (run->alive && run->asleep) contact_awake(&run->faces), contact_awake(&run->edges);
        if (c->thickness_curve < 0) continue;
        const Curve *curve = &m->curves[c->thickness_curve];
        double most = 0.0, now = curve_value(curve, loop->step.time);
        for (int k = 0; k < curve->count; k++) most = curve->y[k] > most ? curve->y[k] : most;
        run->thinness = most > 0.0 && now > 0.0 ? now / most : 0.0;
    }
}

/* The step that contact reckons with: the longer of the two, which a step that falls at once pulls down in its own time
 * (eq. C4b). */
static double longer_step(double last, double before, double next)
{
    return fmax(fmax(before, next), last - STEP_FALL * next);
}

void contact_prepare(ContactLoop *loop, double time, double before, double next, int thread, Team *team)
{
    /* what thread 0 writes of this, it writes after the barriers of the search */
    bool eroded = loop->model->has_erosion && *loop->state->eroded_count != loop->eroded_seen;
    bool due = loop->search_due || eroded;
    if (loop->entities) entities_look(loop, time, before, next, thread, team_size(team));
    if (thread == 0) {
        loop->cycle++;
        loop->state->contact->longer = longer_step(loop->state->contact->longer, before, next);
        loop->step =
            (ContactStep){.time = time, .before = before, .next = next, .longer = loop->state->contact->longer};
        set_thinness(loop);
        if (due) contact_skin_choose(loop);
        if (eroded) contact_erode(loop);
    }
    if (due) contact_search(loop, thread, team);
    contact_renew_room(loop, thread, team);
    if (thread != 0 || !due) return;
    loop->search_due = false;
    if (eroded) loop->eroded_seen = *loop->state->eroded_count;
}

static ContactLaw law_of(const ContactLoop *loop, const ContactRun *run, int thread)
{
    const ContactInterface *c = run->contact;
    return (ContactLaw){.nodes = loop->node,
                        .pull = loop->parts[thread].pull,
                        .before = loop->step.before,
                        .next = loop->step.next,
                        .longer = loop->step.longer,
                        .sliding = room_for_sliding(loop->model),
                        .damping = c->damping,
                        .static_friction = c->static_friction,
                        .dynamic_friction = c->dynamic_friction,
                        .decay = c->decay,
                        .deepest = contact_deepest(c)};
}

/* A contact that is not born yet, or is dead, forgets. */
static void sleep_list(ContactList *list)
{
    memset(list->memory, 0, (size_t)list->owner_count * CONTACT_SLOTS * sizeof *list->memory);
    memset(list->held, 0, (size_t)list->owner_count);
    memset(list->depth, 0, (size_t)list->owner_count * sizeof *list->depth);
    memset(list->deepest, 0, (size_t)list->group_count * sizeof *list->deepest);
    for (int c = 0; c < list->group_count; c++) list->sums[c] = (ContactSums){0};
}

void contact_forces(ContactLoop *loop, int thread, int threads)
{
    ContactPart *part = &loop->parts[thread];
    part->force_count = 0;
    if (!part->pull && contact_pulls_create(part, loop->model->node_count)) {
        part->failed = true;
        return;
    }
    for (int i = 0; i < loop->model->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        if (!run->alive) {
            if (thread != 0 || run->asleep) continue;
            sleep_list(&run->faces), sleep_list(&run->edges);
            run->asleep = true;
            continue;
        }
        if (thread == 0) run->asleep = false;
        ContactLaw law = law_of(loop, run, thread);
        int faces = run->faces.group_count, all = faces + run->edges.group_count;
        for (int k = thread * CONTACT_TURN; k < all; k += threads * CONTACT_TURN) {
            int end = k + CONTACT_TURN < all ? k + CONTACT_TURN : all;
            for (int g = k; g < end; g++) contact_wake(loop, run, g >= faces, g < faces ? g : g - faces, thread, g - k);
            for (int g = k; g < end && !part->failed; g++)
                if (g < faces)
                    contact_meet_faces(loop, run, &law, g, thread, g - k);
                else
                    contact_meet_edges(loop, run, &law, g - faces, thread, g - k);
        }
    }
    if (loop->entities) entities_push(loop, thread, threads);
}

/* Forces before its turn that the nodes of one are asked for. */
enum { GATHER_AHEAD = 2 };

/* Adds what the forces of one list give to the nodes [first, end), in the list's order. */
static void gather_list(ContactLoop *loop, const ContactList *list, int32_t first, int32_t end)
{
    for (int c = 0; c < list->group_count; c++) {
        if (list->sums[c].count == 0) continue;
        const ContactForce *force = loop->parts[list->pieces[c].thread].force + list->pieces[c].first;
        for (int k = 0; k < list->sums[c].count; k++, force++) {
            for (int i = 0; i < 4 && k + GATHER_AHEAD < list->sums[c].count; i++) {
                __builtin_prefetch(loop->corner + CONTACT_ROW * (ptrdiff_t)force[GATHER_AHEAD].node[i], 1);
                __builtin_prefetch(&loop->node[force[GATHER_AHEAD].node[i]], 1);
            }
            for (int i = 0; i < 4; i++) {
                int32_t node = force->node[i];
                double weight = force->weight[i], *to = loop->corner + CONTACT_ROW * (ptrdiff_t)node;
                if (node < first || node >= end) continue;
                for (int a = 0; a < 3; a++) to[a] += weight * force->force[a];
                loop->node[node].load += fabs(weight) * force->load;
                loop->node[node].firm += fabs(weight) * force->firm;
                if (force->blocks && weight != 0.0) loop->covered[node] = 1;
                loop->written[node / CONTACT_NODE_CHUNK] = 1;
            }
        }
    }
}

void contact_gather(ContactLoop *loop, int thread, int threads)
{
    int64_t nodes = loop->model->node_count, chunks = (nodes + CONTACT_NODE_CHUNK - 1) / CONTACT_NODE_CHUNK;
    int32_t low = (int32_t)(chunks * thread / threads), high = (int32_t)(chunks * (thread + 1) / threads);
    int32_t first = low * CONTACT_NODE_CHUNK;
    int32_t end = high * CONTACT_NODE_CHUNK < nodes ? high * CONTACT_NODE_CHUNK : (int32_t)nodes;
    if (thread == 0) loop->state->contact->unseen++;
    for (int i = 0; thread == 0 && i < loop->model->contact_count; i++)
        if (loop->runs[i].alive) contact_pass_on(loop, &loop->runs[i]);
    for (int32_t c = low; c < high; c++) {
        int32_t from = c * CONTACT_NODE_CHUNK, to = from + CONTACT_NODE_CHUNK < end ? from + CONTACT_NODE_CHUNK : end;
        if (!loop->written[c]) continue;
        memset(loop->corner + CONTACT_ROW * (ptrdiff_t)from, 0, CONTACT_ROW * (size_t)(to - from) * sizeof(double));
        for (int32_t n = from; n < to; n++) loop->node[n].load = loop->node[n].firm = 0.0;
        memset(loop->covered + from, 0, (size_t)(to - from));
        loop->written[c] = 0;
    }
    for (int i = 0; i < loop->model->contact_count; i++) {
        if (!loop->runs[i].alive) continue;
        gather_list(loop, &loop->runs[i].faces, first, end);
        gather_list(loop, &loop->runs[i].edges, first, end);
    }
    if (loop->entities) entities_gather(loop, first, end);
}

/* Share of each element's nodes that are in contact, for leakage (docs/theory.md, Leakage). */
static void share_blocked(ContactLoop *loop, int thread, int threads)
{
    const Model *m = loop->model;
    int64_t count = m->element_count;
    for (int e = (int)(count * thread / threads), end = (int)(count * (thread + 1) / threads); e < end; e++) {
        const int32_t *node = m->element_node + 4 * (ptrdiff_t)e;
        int corners = node[3] == node[2] ? 3 : 4, touching = 0;
        if (m->has_erosion && loop->state->eroded[m->element_slot[e]]) corners = 0;
        for (int k = 0; k < corners; k++) touching += loop->covered[node[k]];
        loop->state->contact_share[e] = corners ? (double)touching / corners : 0.0;
    }
}

/* Power of the contact forces on the velocities of a chunk of nodes. */
static double power_of_chunk(const ContactLoop *loop, int chunk, int count)
{
    double sum = 0.0;
    for (int n = chunk * CONTACT_NODE_CHUNK, end = n + count; n < end && loop->written[chunk]; n++)
        sum += vector3_dot(loop->corner + CONTACT_ROW * (ptrdiff_t)n, loop->state->v + 3 * (ptrdiff_t)n);
    return sum;
}

void contact_follow(ContactLoop *loop, int thread, int threads, double pending)
{
    const double *x = loop->state->x, *v = loop->state->v;
    const ContactSkin *skin = &loop->skin;
    DriftOrigin origin = {0};
    for (int k = 0; k < 3; k++) {
        origin.velocity[k] = skin->velocity[k];
        origin.way[k] = (skin->since + loop->step.next) * skin->velocity[k];
    }
    int first = (int)((int64_t)loop->motion_count * thread / threads),
        end = (int)((int64_t)loop->motion_count * (thread + 1) / threads);
    for (int c = first; c < end; c++) {
        int from_node = c * CONTACT_NODE_CHUNK, left = loop->model->moving_count - from_node;
        int count = left < CONTACT_NODE_CHUNK ? left : CONTACT_NODE_CHUNK;
        ptrdiff_t at = 3 * (ptrdiff_t)from_node;
        ContactMotion *motion = &loop->motions[c];
        *motion = (ContactMotion){.power = power_of_chunk(loop, c, count)};
        origin.from = skin->from + at;
        loop->motion_kernels->drift(motion, x + at, v + at, &origin, pending, count);
    }
    follow_groups(loop, thread, threads);
    if (loop->model->blockage) share_blocked(loop, thread, threads);
    if (thread == 0) loop->pending = true;
}

/* Counts what happened in a group; of the first the node and the time are kept. */
static void note(int64_t *total, int64_t *node, double *time, int count, int id, const ContactLoop *loop)
{
    if (count > 0 && *total == 0) {
        *node = id;
        *time = loop->step.time;
    }
    *total += count;
}

/* Sums of the lists in the groups' order; the first pairs that were lost or too fast are remembered for the log. */
static void sum_list(ContactLoop *loop, ContactRun *run, const ContactList *list)
{
    ContactClock *clock = loop->state->contact;
    for (int c = 0; c < list->group_count; c++) {
        const ContactSums *s = &list->sums[c];
        for (int k = 0; k < 3; k++) run->force[k] += s->force[k];
        loop->power += s->power;
        note(&clock->fast, &clock->fast_node, &clock->fast_time, s->fast, loop->model->node_id[s->fast_node], loop);
        note(&clock->lost, &clock->lost_node, &clock->lost_time, s->lost, loop->model->node_id[s->lost_node], loop);
    }
}

void contact_sum(ContactLoop *loop)
{
    double fastest = 0.0;
    if (!loop->pending) return;
    loop->pending = false;
    loop->power = loop->power_after = 0.0;
    for (int i = 0; i < loop->model->contact_count; i++) {
        ContactRun *run = &loop->runs[i];
        for (int k = 0; k < 3; k++) run->force[k] = 0.0;
        if (!run->alive) continue;
        sum_list(loop, run, &run->faces);
        sum_list(loop, run, &run->edges);
    }
    if (loop->entities) entities_sum(loop);
    for (int k = 0; k < BILLOW_MAX_THREADS; k++) {
        loop->out_of_memory = loop->out_of_memory || loop->parts[k].failed;
        loop->search_due = loop->search_due || loop->parts[k].deep;
        loop->parts[k].deep = false;
    }
    for (int c = 0; c < loop->motion_count; c++) {
        const ContactMotion *m = &loop->motions[c];
        loop->power_after += m->power;
        fastest = m->fastest > fastest ? m->fastest : fastest;
    }
    loop->fastest = sqrt(fastest) + vector3_norm(loop->skin.velocity);
    if (contact_skin_used_up(loop)) loop->search_due = true;
}

static int compare_memories(const void *a, const void *b)
{
    const ContactMemory *m = a, *n = b;
    return (m->pair[1] > n->pair[1]) - (m->pair[1] < n->pair[1]);
}

static void store_list(const ContactList *list, int base, ContactMemory *to, int capacity, int *count)
{
    for (int i = 0; i < list->owner_count; i++) {
        int first = *count;
        for (int k = 0; k < list->held[i] && *count < capacity; k++) {
            const ContactMemory *m = contact_slot(list, i, k);
            if (!m->side) continue;
            to[*count] = *m;
            to[(*count)++].pair[0] = base + i;
        }
        qsort(to + first, (size_t)(*count - first), sizeof *to, compare_memories);
    }
}

void contact_store(ContactLoop *loop)
{
    for (int i = 0; i < loop->model->contact_count; i++) {
        const ContactRun *run = &loop->runs[i];
        ContactMemory *to = loop->state->contact_memory + run->contact->first_memory;
        int count = 0, capacity = run->contact->memory_capacity;
        store_list(&run->faces, 0, to, capacity, &count);
        store_list(&run->edges, run->contact->node_count, to, capacity, &count);
        int before = loop->state->contact_memories[i]; /* what is beyond those is zero */
        if (before > count) memset(to + count, 0, (size_t)(before - count) * sizeof *to);
        loop->state->contact_memories[i] = count;
    }
    for (int n = 0; n < loop->model->node_count; n++) {
        loop->state->contact_load[2 * (ptrdiff_t)n] = loop->node[n].load;
        loop->state->contact_load[2 * (ptrdiff_t)n + 1] = loop->node[n].firm;
    }
}
