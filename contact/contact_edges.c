/* Edges against edges: where two lines cross, on which side the first passes the second. */
#include "contact/contact_geometry.h"
#include "contact/contact_push.h"
#include "contact/contact_sides.h"
#include "solver/memory.h"

/* A pair in contact is kept until its crossing is beyond an end by this share of the edge, so that the next edge can
 * take over. */
#define SLACK 0.05

/* A crossing that has slid on keeps its direction and its gap: cosine between the forces, and change of the gap over
 * the thickness. Another pair of edges nearby is on a side of its own. */
#define PASSAGE_TURN 0.5
#define PASSAGE_JUMP 0.5

/* Two edges whose lines cross within both. */
typedef struct Crossing {
    double normal[3]; /* unit normal of both lines: first x second */
    double height;    /* of the first line over the second */
    double s, t;      /* places of the crossing on the edges */
} Crossing;

/* False if they do not cross within their lengths or are farther apart than reach. */
static inline bool cross_edges(Crossing *c, const double *const p[4], double reach, double slack)
{
    double u[3], w[3], r[3], n[3];
    for (int k = 0; k < 3; k++) {
        u[k] = p[1][k] - p[0][k];
        w[k] = p[3][k] - p[2][k];
        r[k] = p[0][k] - p[2][k];
    }
    vector3_cross(u, w, n);
    double uu = vector3_dot(u, u), ww = vector3_dot(w, w), square = vector3_dot(n, n), height = vector3_dot(n, r);
    if (!(square > PARALLEL * uu * ww) || fabs(height) > reach * sqrt(square)) return false;
    double uw = vector3_dot(u, w), ur = vector3_dot(u, r), wr = vector3_dot(w, r), inverse = 1.0 / square;
    c->s = (uw * wr - ww * ur) * inverse;
    c->t = (uu * wr - uw * ur) * inverse;
    double over_s = c->s < 0.0 ? -c->s : c->s > 1.0 ? c->s - 1.0 : 0.0;
    double over_t = c->t < 0.0 ? -c->t : c->t > 1.0 ? c->t - 1.0 : 0.0;
    if (over_s > slack || over_t > slack) return false;
    c->s = c->s < 0.0 ? 0.0 : c->s > 1.0 ? 1.0 : c->s;
    c->t = c->t < 0.0 ? 0.0 : c->t > 1.0 ? 1.0 : c->t;
    double length = 1.0 / sqrt(square);
    for (int k = 0; k < 3; k++) c->normal[k] = n[k] * length;
    c->height = height * length;
    return true;
}

/* Keeps what a pair knew that ends while it pushes. */
static void note_ended(ContactPassages *passages, int e, int f, const ContactMemory *m)
{
    if (passages->count == CONTACT_PASSAGES) return;
    passages->ended[passages->count++] = (ContactPassage){.first = e, .second = f, .memory = *m};
}

/* Ends of both edges. */
static inline void edge_ends(const ContactInterface *c, const double *x, int e, int f, const double *p[4])
{
    for (int k = 0; k < 2; k++) {
        p[k] = x + 3 * (ptrdiff_t)c->edge[2 * e + k];
        p[2 + k] = x + 3 * (ptrdiff_t)c->edge[2 * f + k];
    }
}

/* Component of the direction remembered along a normal. */
static double along_memory(const ContactMemory *m, const double normal[3])
{
    return m->direction[0] * normal[0] + m->direction[1] * normal[1] + m->direction[2] * normal[2];
}

/* Lane l of a block: a pair that crosses, or knows something. */
static void meet_pair(const ContactLoop *loop, const ContactRun *run, const ContactLaw *law, const MeetEdges *block,
                      int l, ContactPart *part, ContactPassages *passages)
{
    const ContactInterface *c = run->contact;
    const int e = block->own[l], f = block->other[l];
    ContactMemory *m = block->memory[l];
    if (!(block->cross >> l & 1)) {
        if (!m) return;
        note_ended(passages, e, f, m);
        *m = (ContactMemory){0};
        return;
    }
    if (!m && !run->edge[e].moves && !run->edge[f].moves) return;
    ContactTouch t = {.thickness = block->thickness[l], .stiffness = c->stiffness[c->edge_side[e] == CONTACT_SIDE_B]};
    double normal[3];
    for (int k = 0; k < 4; k++) t.node[k] = block->nodes.node[k][l], t.weight[k] = block->weight[k][l];
    for (int k = 0; k < 3; k++) t.speed[k] = block->speed[k][l], normal[k] = block->normal[k][l];
    double before = block->height[l] - law->before * vector3_dot(t.speed, normal);
    /* the lines' normal turns over where they are parallel: a pair in contact knows its direction */
    t.side = m && m->side ? (along_memory(m, normal) < 0.0 ? -1 : 1) : (before > 0.0) - (before < 0.0);
    if (t.side == 0) return;
    t.gap = t.side * block->height[l];
    for (int k = 0; k < 3; k++) t.direction[k] = t.side * normal[k];
    contact_push_add(loop, part, &t, m, e, f);
}

/* Takes the forces of the group's pairs, and what they remember. */
static void take_pushed(const ContactLoop *loop, ContactRun *run, const ContactPart *part, ContactSums *sums,
                        ContactForce *forces)
{
    for (int place = 0; place < part->push_count; place++) {
        const PushPairs *block = &part->push[place / PUSH_LANES];
        const int l = place % PUSH_LANES, e = block->owner[l], f = block->other[l];
        ContactForce *out = &forces[sums->count];
        if (!contact_push_take(&run->edges, block, l, sums, out)) continue;
        out->blocks = contact_is_sharp(loop, run, e) && contact_is_sharp(loop, run, f);
        double sign = run->contact->edge_side[e] & CONTACT_SIDE_A ? 1.0 : -1.0;
        for (int k = 0; k < 3; k++) sums->force[k] += sign * out->force[k];
    }
}

/* Puts a pair into the next lane of blocks. */
static void add_pair(const ContactRun *run, const ContactLaw *law, int e, int f, ContactMemory *m, MeetEdges *block,
                     int place)
{
    const ContactEdge *first = &run->edge[e], *second = &run->edge[f];
    const int l = place % MEET_LANES;
    block += place / MEET_LANES;
    for (int k = 0; k < 2; k++) {
        block->nodes.node[k][l] = first->node[k];
        block->nodes.node[2 + k][l] = second->node[k];
    }
    block->own[l] = e;
    block->other[l] = f;
    block->memory[l] = m;
    block->thickness[l] = run->thinness * (run->radius[first->radius] + run->radius[second->radius]);
    block->remembered[l] = m ? law->deepest : 0.0;
    block->slack[l] = m ? SLACK : 0.0;
}

/* Of the others of edge e [0, count) those that it may cross, and what it remembers, into lanes from place on; left:
 * others of it and of the edges after it. Returns the next place. */
static int choose_pairs(const ContactLoop *loop, const ContactRun *run, const ContactLaw *law, const MeetStep *step,
                        int e, const int32_t *other, int count, int left, MeetEdges *block, int place)
{
    MeetNodes nodes;
    for (int l = 0; l < MEET_LANES; l++)
        for (int k = 0; k < 2; k++) nodes.node[k][l] = run->edge[e].node[k];
    for (int first = 0; first < count; first += MEET_LANES) {
        int some = count - first < MEET_LANES ? count - first : MEET_LANES;
        for (int l = 0; l < MEET_LANES; l++)
            for (int k = 0; k < 2; k++) nodes.node[2 + k][l] = run->edge[other[l < some ? first + l : first]].node[k];
        for (int l = some; l < left - first && l < some + MEET_LANES; l++)
            __builtin_prefetch(&run->edge[other[first + l]]);
        unsigned set = loop->meet_kernels->may_cross(step, &nodes);
        for (int l = 0; l < some; l++) {
            ContactMemory *m = contact_ask(&run->edges, e, other[first + l]);
            if (m || set >> l & 1) add_pair(run, law, e, other[first + l], m, block, place++);
        }
    }
    return place;
}

static int owner_group(const ContactRun *run, int e)
{
    return run->line_place[e] / CONTACT_GROUP;
}

/* Gives a memory to the pair e, f if they cross and know nothing yet; its side by the direction of the force. */
static bool leave_to(ContactLoop *loop, ContactRun *run, const ContactPassage *ended, int e, int f)
{
    const double *p[4];
    Crossing cross;
    bool swapped = owner_group(run, f) < owner_group(run, e) || (owner_group(run, f) == owner_group(run, e) && f < e);
    int owner = swapped ? f : e, other = swapped ? e : f;
    if (e == f || contact_recall(&run->edges, owner, other)) return false;
    if (!contact_is_sharp(loop, run, e) && !contact_is_sharp(loop, run, f)) return false;
    if (!contact_edges_meet(loop->model, run->contact, owner, other)) return false;
    edge_ends(run->contact, loop->state->x, owner, other, p);
    /* it has slid along: the gap is about what it was */
    double thickness = run->thinness * (run->contact->edge_radius[e] + run->contact->edge_radius[f]);
    if (!cross_edges(&cross, p, thickness + fabs(ended->memory.gap), SLACK)) return false;
    double sign = swapped ? -1.0 : 1.0, along = sign * along_memory(&ended->memory, cross.normal);
    ContactMemory m = ended->memory;
    m.side = along >= 0.0 ? 1 : -1;
    if (fabs(along) < PASSAGE_TURN || fabs(m.side * cross.height - m.gap) > PASSAGE_JUMP * thickness) return false;
    for (int k = 0; k < 3; k++) {
        m.direction[k] = (float)(m.side * cross.normal[k]);
        m.friction[k] = swapped ? -m.friction[k] : m.friction[k];
    }
    contact_keep(&run->edges, owner, other, &m);
    run->edges.holds[owner_group(run, owner)] = 1;
    return true;
}

/* The edges at the ends of an edge, itself first. */
static int edges_around(const ContactInterface *c, int e, int32_t *around, int most)
{
    int count = 0;
    around[count++] = e;
    for (int k = 0; k < 2; k++) {
        int32_t node = c->edge[2 * e + k];
        for (int32_t i = c->edge_start[node]; i < c->edge_start[node + 1] && count < most; i++)
            if (c->edge_list[i] != e) around[count++] = c->edge_list[i];
    }
    return count;
}

void contact_pass_on(ContactLoop *loop, ContactRun *run)
{
    enum { AROUND = 32 };
    int32_t first[AROUND], second[AROUND];
    for (int k = 0; k < run->edges.group_count; k++)
        for (int i = 0; i < run->edges.passages[k].count; i++) {
            const ContactPassage *ended = &run->edges.passages[k].ended[i];
            int m = edges_around(run->contact, ended->first, first, AROUND);
            int n = edges_around(run->contact, ended->second, second, AROUND);
            for (int a = 0, left = 0; a < m && !left; a++)
                for (int b = 0; b < n && !left; b++) left = leave_to(loop, run, ended, first[a], second[b]);
        }
}

/* Pairs of the group's edges that may cross, in lanes of the thread's blocks. Returns how many, -1 without memory. */
static int find_crossings(ContactLoop *loop, ContactRun *run, const ContactLaw *law, const ContactLanes *lanes,
                          ContactPart *part, const int start[CONTACT_GROUP + 1])
{
    const MeetStep step = {.x = loop->state->x, .v = loop->state->v, .longer = loop->step.longer};
    int count = 0;
    if (memory_reserve((void **)&part->edges, &part->edges_capacity, (size_t)start[CONTACT_GROUP] / MEET_LANES + 1,
                       sizeof *part->edges))
        return -1;
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++)
        count = choose_pairs(loop, run, law, &step, lanes->item[k], part->other + start[k], start[k + 1] - start[k],
                             start[CONTACT_GROUP] - start[k], part->edges, count);
    int blocks = (count + MEET_LANES - 1) / MEET_LANES;
    for (int place = count; place < blocks * MEET_LANES; place++)
        add_pair(run, law, lanes->item[0], lanes->item[0], NULL, part->edges, place);
    loop->meet_kernels->edges(&step, part->edges, blocks);
    return count;
}

void contact_meet_edges(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int group, int thread, int turn)
{
    ContactList *list = &run->edges;
    ContactPart *part = &loop->parts[thread];
    ContactSums *sums = &list->sums[group];
    ContactPassages *passages = &list->passages[group];
    const ContactLanes *lanes = &run->lines.lanes[group];
    int start[CONTACT_GROUP + 1];
    *sums = (ContactSums){0};
    list->pieces[group] = (ContactPiece){.thread = thread, .first = (int32_t)part->force_count};
    passages->count = 0;
    contact_find_near(loop, run, true, group, thread, turn, start);
    if (part->failed || start[CONTACT_GROUP] == 0) return;
    int count = find_crossings(loop, run, law, lanes, part, start);
    ContactForce *forces = count < 0 ? NULL : contact_force_room(part, (size_t)count + 1);
    if (!forces || contact_push_begin(part, count)) {
        part->failed = true;
        return;
    }
    for (int place = 0; place < count; place++)
        meet_pair(loop, run, law, &part->edges[place / MEET_LANES], place % MEET_LANES, part, passages);
    contact_push_all(loop, law, part);
    take_pushed(loop, run, part, sums, forces);
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++)
        if (start[k + 1] > start[k]) contact_count_held(list, lanes->item[k]);
    part->force_count += (size_t)sums->count;
}
