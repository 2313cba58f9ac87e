/* Contact entities in the time loop: probes against smooth shapes of rigid bodies (docs/theory.md, Smooth impactors).
 */
#include "contact/entity_loop.h"

#include <math.h>
#include <string.h>

#include "contact/contact_law.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* Where an entity and its body are at t_n, and how fast at n - 1/2. */
typedef struct EntityFrame {
    double origin[3], axes[9]; /* rows */
    double centre[3], v[3], spin[3];
} EntityFrame;

static EntityFrame frame_of(const ContactLoop *loop, const ContactEntity *entity)
{
    EntityFrame frame = {0};
    memcpy(frame.origin, entity->origin, sizeof frame.origin);
    memcpy(frame.axes, entity->axes, sizeof frame.axes);
    memcpy(frame.centre, entity->origin, sizeof frame.centre);
    if (entity->body < 0) return frame;
    const RigidBody *body = &loop->model->rigid_bodies[entity->body];
    const RigidState *state = &loop->state->rigid[entity->body];
    double turn[9], arm[3], moved[3];
    quaternion_matrix(state->rotation, turn);
    vector3_subtract(entity->origin, body->centre, arm);
    matrix3_apply(turn, arm, moved);
    for (int k = 0; k < 3; k++) frame.origin[k] = state->x[k] + moved[k];
    for (int k = 0; k < 3; k++) matrix3_apply(turn, entity->axes + 3 * (ptrdiff_t)k, frame.axes + 3 * (ptrdiff_t)k);
    memcpy(frame.centre, state->x, sizeof frame.centre);
    memcpy(frame.v, state->v, sizeof frame.v);
    memcpy(frame.spin, state->spin, sizeof frame.spin);
    return frame;
}

/* Mean of an array of vectors at a probe's nodes. */
static void at_probe(const ContactEntity *entity, int probe, const double *of_node, double mean[3])
{
    const int32_t *node = entity->node + 4 * (ptrdiff_t)probe;
    const double *weight = entity->weight + 4 * (ptrdiff_t)probe;
    if (probe < entity->node_count) {
        memcpy(mean, of_node + 3 * (ptrdiff_t)node[0], 3 * sizeof *mean);
        return;
    }
    for (int k = 0; k < 3; k++) {
        mean[k] = 0.0;
        for (int i = 0; i < 4; i++) mean[k] += weight[i] * of_node[3 * (ptrdiff_t)node[i] + k];
    }
}

/* 1/M + (r x n) . I^-1 (r x n): acceleration of the body's surface by a force along n (eq. I5). */
static double body_mobility(const ContactLoop *loop, int body, const double turn[3])
{
    double spin[3];
    if (body < 0) return 0.0;
    rigid_body_spin_of(&loop->model->rigid_bodies[body], &loop->state->rigid[body], turn, spin);
    return 1.0 / loop->model->rigid_bodies[body].mass + vector3_dot(turn, spin);
}

/* Square of the distance from the origin beyond which a probe cannot touch a bounded shape in this step; INFINITY for
 * the others, whose distance is as cheap. */
static double far_square(const ContactLoop *loop, const ContactEntity *entity, const EntityFrame *frame, double half)
{
    if (entity->inside || entity->shape == ENTITY_PLANE || entity->shape == ENTITY_CYLINDER ||
        entity->shape == ENTITY_RECTANGLE)
        return INFINITY;
    double arm[3], spin = vector3_norm(frame->spin), turned = half * spin;
    vector3_subtract(frame->origin, frame->centre, arm);
    double size = fmax(entity->size[0], fmax(entity->size[1], entity->size[2])) + entity->thickest;
    if (entity->shape == ENTITY_TORUS) size += entity->size[1];
    double way = half * (loop->fastest + vector3_norm(frame->v) + spin * vector3_norm(arm));
    double far = (size + way) / (1.0 - turned) * (1.0 + 1e-9);
    return turned < 0.5 ? far * far : INFINITY;
}

/* Was a probe that touches an open surface in front of it one step ago (eq. I13)? Others have come around its rim. */
static bool came_through(const ContactEntity *entity, const EntityHit *hit, double before)
{
    double ahead = hit->gap - before * vector3_dot(hit->speed, hit->normal);
    return ahead >= -0.1 * before * vector3_norm(hit->speed) - 1e-9 * entity->size[0];
}

/* Fills hit from a probe at x and tells whether it touches (eq. I7). half: half the mean step. */
static bool probe_touches(const ContactLoop *loop, const ContactEntity *entity, const EntityFrame *frame,
                          const double x[3], int probe, double half, EntityHit *hit)
{
    double r[3], local[3], arm[3], v[3], turned[3];
    vector3_subtract(x, frame->origin, r);
    matrix3_apply(frame->axes, r, local);
    EntityGap gap = entity_gap(entity, local);
    matrix3_apply_transposed(frame->axes, gap.normal, hit->normal);
    vector3_subtract(x, frame->centre, arm);
    vector3_cross(frame->spin, arm, turned);
    at_probe(entity, probe, loop->state->v, v);
    for (int k = 0; k < 3; k++) hit->speed[k] = v[k] - frame->v[k] - turned[k];
    hit->probe = probe;
    hit->gap = gap.distance;
    vector3_cross(arm, hit->normal, hit->turn);
    return gap.distance < entity->radius[probe] + half * fabs(vector3_dot(hit->speed, hit->normal));
}

/* m of (I6): the least m_i/w_i of the probe's nodes; 0 if none of them moves. */
static double probe_mass(const ContactLoop *loop, const ContactEntity *entity, int probe)
{
    double least = INFINITY;
    for (int i = 0; i < 4; i++) {
        double weight = entity->weight[4 * (ptrdiff_t)probe + i],
               inverse = loop->model->contact_inverse[entity->node[4 * (ptrdiff_t)probe + i]];
        if (weight > 0.0 && inverse > 0.0) least = fmin(least, 1.0 / (weight * inverse));
    }
    return isfinite(least) ? least : 0.0;
}

/* before: the last step. far: beyond this squared distance from the origin nothing touches. */
static void look_at_chunk(ContactLoop *loop, EntityRun *run, int chunk, const EntityFrame *frame, double before,
                          double half, double far)
{
    const ContactEntity *entity = run->entity;
    EntitySums *sums = &run->sums[chunk];
    EntityHit *hits = run->hits + (ptrdiff_t)chunk * ENTITY_CHUNK;
    ContactMemory *memory = loop->state->entity_memory + entity->first_memory;
    int first = chunk * ENTITY_CHUNK, end = first + ENTITY_CHUNK;
    *sums = (EntitySums){0};
    for (int p = first; p < end && p < entity->probe_count; p++) {
        double x[3], r[3];
        at_probe(entity, p, loop->state->x, x);
        vector3_subtract(x, frame->origin, r);
        bool near = vector3_dot(r, r) < far;
        EntityHit *hit = &hits[sums->count];
        if (near && probe_touches(loop, entity, frame, x, p, half, hit) &&
            (!entity->open || run->held[p] || came_through(entity, hit, before))) {
            double mass = probe_mass(loop, entity, p);
            if (mass > 0.0) {
                sums->mobility += mass * body_mobility(loop, entity->body, hit->turn);
                sums->count++;
                continue;
            }
        }
        if (!run->held[p]) continue;
        memory[p] = (ContactMemory){0};
        run->held[p] = 0;
    }
}

void entities_look(ContactLoop *loop, double time, double before, double next, int thread, int threads)
{
    double half = 0.25 * (before + next);
    for (int i = 0; i < loop->model->entity_count; i++) {
        EntityRun *run = &loop->entities->runs[i];
        EntityFrame frame = frame_of(loop, run->entity);
        bool alive = time >= run->entity->birth && time < run->entity->death;
        double far = far_square(loop, run->entity, &frame, half);
        for (int c = thread; c < run->chunk_count; c += threads)
            look_at_chunk(loop, run, c, &frame, before, half, alive ? far : -1.0);
    }
}

/* beta of a body: how much all that touch it would move it, against themselves (eq. I6). */
static double body_share(const ContactLoop *loop, int body)
{
    double sum = 0.0;
    for (int i = 0; i < loop->model->entity_count && body >= 0; i++) {
        const EntityRun *run = &loop->entities->runs[i];
        for (int c = 0; c < run->chunk_count && run->entity->body == body; c++) sum += run->sums[c].mobility;
    }
    return sum;
}

/* Masses of one hit; share: 1 + beta. */
static ContactMasses masses_of(const ContactLoop *loop, const ContactEntity *entity, const ContactTouch *t,
                               const EntityHit *hit, double share)
{
    ContactMasses masses = {.load = share};
    double inverse = body_mobility(loop, entity->body, hit->turn), worst = 0.0, stiff = INFINITY;
    for (int i = 0; i < 4; i++) {
        const ContactNode *node = &loop->node[t->node[i]];
        double of_node = node->inverse, weight = t->weight[i], own = share * weight, all = node->load;
        if (weight == 0.0 || of_node == 0.0) continue;
        inverse += weight * weight * of_node;
        all = all > own ? all : own;
        worst = all * of_node > worst ? all * of_node : worst;
        double own_stiff = contact_room(node->room, t->direction) / (all * of_node);
        stiff = own_stiff < stiff ? own_stiff : stiff;
    }
    masses.effective = 1.0 / inverse;
    masses.least = masses.firm = 1.0 / worst;
    masses.stiff = stiff;
    return masses;
}

/* Force on a probe that touches: penalty, damping, friction (eq. I8). */
static void push_hit(const ContactLoop *loop, const ContactEntity *entity, const ContactLaw *law, double share,
                     EntityHit *hit, ContactMemory *m)
{
    ContactTouch t = {
        .gap = hit->gap, .thickness = entity->radius[hit->probe], .stiffness = entity->stiffness, .side = 1};
    memcpy(t.node, entity->node + 4 * (ptrdiff_t)hit->probe, sizeof t.node);
    memcpy(t.weight, entity->weight + 4 * (ptrdiff_t)hit->probe, sizeof t.weight);
    memcpy(t.direction, hit->normal, sizeof t.direction);
    memcpy(t.speed, hit->speed, sizeof t.speed);
    bool new_pair = m->side == 0;
    double speed = vector3_dot(t.speed, t.direction), h = 0.25 * (law->before + law->next) * fabs(speed);
    double step2 = law->longer * law->longer, z = law->damping;
    ContactMasses masses = masses_of(loop, entity, &t, hit, share);
    double root = sqrt(4.0 * z * z + 0.8 * masses.stiff / masses.least) - 2.0 * z;
    double most = root * root * masses.least, wanted = CONTACT_STIFFNESS * t.stiffness * masses.effective;
    if (new_pair) contact_begin(&t, speed, law->before, m);
    m->gap = (float)t.gap;
    contact_ease(&t, speed > 0.0 ? t.gap - h : t.gap, new_pair, m);
    contact_stiffen(&t, (wanted < most ? wanted : most) / step2, new_pair, m);
    double depth = contact_mean_depth(m->distance - t.gap, h), force = m->stiffness * depth;
    if (z > 0.0 && depth > 0.0) {
        double c = sqrt(m->stiffness * masses.effective), bound = root * masses.least / law->longer;
        force -= 2.0 * z * (c < bound ? c : bound) * speed;
        force = force > 0.0 ? force : 0.0;
    }
    for (int k = 0; k < 3; k++) hit->force[k] = force * t.direction[k];
    if (law->static_friction == 0.0) return;
    double sliding = law->sliding * masses.least / step2;
    contact_friction(law, &t, speed, force, m->stiffness < sliding ? m->stiffness : sliding, m);
    for (int k = 0; k < 3; k++) hit->force[k] += m->friction[k];
}

static void push_chunk(ContactLoop *loop, EntityRun *run, int chunk, const double centre[3], const ContactLaw *law,
                       double share)
{
    const ContactEntity *entity = run->entity;
    EntitySums *sums = &run->sums[chunk];
    EntityHit *hits = run->hits + (ptrdiff_t)chunk * ENTITY_CHUNK;
    for (int h = 0; h < sums->count; h++) {
        EntityHit *hit = &hits[h];
        double x[3], arm[3], part[3];
        push_hit(loop, entity, law, share, hit, loop->state->entity_memory + entity->first_memory + hit->probe);
        run->held[hit->probe] = 1;
        at_probe(entity, hit->probe, loop->state->x, x);
        vector3_subtract(x, centre, arm);
        vector3_cross(arm, hit->force, part);
        for (int k = 0; k < 3; k++) {
            sums->force[k] -= hit->force[k];
            sums->moment[k] -= part[k];
        }
        sums->power += vector3_dot(hit->force, hit->speed);
    }
}

void entities_push(ContactLoop *loop, int thread, int threads)
{
    for (int i = 0; i < loop->model->entity_count; i++) {
        EntityRun *run = &loop->entities->runs[i];
        const ContactEntity *entity = run->entity;
        ContactLaw law = {.before = loop->step.before,
                          .next = loop->step.next,
                          .longer = loop->step.longer,
                          .sliding = 0.5 * contact_room_left(loop->model),
                          .damping = entity->damping,
                          .static_friction = entity->friction,
                          .dynamic_friction = entity->friction};
        double share = 1.0 + body_share(loop, entity->body);
        const double *centre = entity->body < 0 ? entity->origin : loop->state->rigid[entity->body].x;
        for (int c = thread; c < run->chunk_count; c += threads) push_chunk(loop, run, c, centre, &law, share);
    }
}

void entities_gather(ContactLoop *loop, int32_t first, int32_t end)
{
    for (int i = 0; i < loop->model->entity_count; i++) {
        const EntityRun *run = &loop->entities->runs[i];
        const ContactEntity *entity = run->entity;
        double share = 1.0 + body_share(loop, entity->body);
        for (int c = 0; c < run->chunk_count; c++)
            for (int h = 0; h < run->sums[c].count; h++) {
                const EntityHit *hit = &run->hits[(ptrdiff_t)c * ENTITY_CHUNK + h];
                for (int k = 0; k < 4; k++) {
                    int32_t node = entity->node[4 * (ptrdiff_t)hit->probe + k];
                    double weight = entity->weight[4 * (ptrdiff_t)hit->probe + k];
                    double *to = loop->corner + CONTACT_ROW * (ptrdiff_t)node;
                    if (weight == 0.0 || node < first || node >= end) continue;
                    for (int a = 0; a < 3; a++) to[a] += weight * hit->force[a];
                    loop->node[node].load += weight * share;
                    loop->covered[node] = 1;
                    loop->written[node / CONTACT_NODE_CHUNK] = 1;
                }
            }
    }
}

void entities_add_wrench(const ContactLoop *loop, int body, double force[3], double moment[3])
{
    for (int i = 0; i < loop->model->entity_count; i++) {
        const EntityRun *run = &loop->entities->runs[i];
        for (int c = 0; c < run->chunk_count && run->entity->body == body; c++)
            for (int k = 0; k < 3; k++) {
                force[k] += run->sums[c].force[k];
                moment[k] += run->sums[c].moment[k];
            }
    }
}

void entities_sum(ContactLoop *loop)
{
    for (int i = 0; i < loop->model->entity_count; i++) {
        const EntityRun *run = &loop->entities->runs[i];
        double *force = loop->entities->resultant + 6 * (ptrdiff_t)i, *moment = force + 3;
        memset(force, 0, 6 * sizeof *force);
        for (int c = 0; c < run->chunk_count; c++) {
            loop->power += run->sums[c].power;
            for (int k = 0; k < 3; k++) {
                force[k] += run->sums[c].force[k];
                moment[k] += run->sums[c].moment[k];
            }
        }
        if (run->entity->body < 0) continue;
        const RigidState *body = &loop->state->rigid[run->entity->body];
        loop->power_after += vector3_dot(force, body->v) + vector3_dot(moment, body->spin);
    }
}

static int run_create(EntityRun *run, const ContactEntity *entity, const ContactMemory *memory)
{
    size_t probes = (size_t)entity->probe_count;
    *run = (EntityRun){.entity = entity, .chunk_count = (entity->probe_count + ENTITY_CHUNK - 1) / ENTITY_CHUNK};
    run->hits = memory_alloc(probes + 1, sizeof *run->hits);
    run->sums = memory_alloc((size_t)run->chunk_count + 1, sizeof *run->sums);
    run->held = memory_alloc(probes + 1, 1);
    if (!run->hits || !run->sums || !run->held) return -1;
    for (size_t p = 0; p < probes; p++) run->held[p] = memory[p].side != 0;
    return 0;
}

EntityLoop *entities_create(const Model *model, const State *state)
{
    EntityLoop *entities = memory_alloc(1, sizeof *entities);
    if (!entities) return NULL;
    entities->runs = memory_alloc((size_t)model->entity_count, sizeof *entities->runs);
    entities->resultant = memory_alloc(6 * (size_t)model->entity_count, sizeof(double));
    int status = entities->runs && entities->resultant ? 0 : -1;
    for (int i = 0; !status && i < model->entity_count; i++)
        status =
            run_create(&entities->runs[i], &model->entities[i], state->entity_memory + model->entities[i].first_memory);
    if (!status) return entities;
    entities_free(entities, model);
    return NULL;
}

void entities_free(EntityLoop *entities, const Model *model)
{
    if (!entities) return;
    for (int i = 0; entities->runs && i < model->entity_count; i++) {
        memory_free(entities->runs[i].hits);
        memory_free(entities->runs[i].sums);
        memory_free(entities->runs[i].held);
    }
    memory_free(entities->runs);
    memory_free(entities->resultant);
    memory_free(entities);
}
