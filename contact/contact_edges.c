/* Edges against edges: where two lines cross, on which side the first passes the second. */
#include "contact/contact_law.h"

/* Edges at a smaller angle (sine squared) are as good as parallel: their nodes do the work. */
#define PARALLEL 1e-3

/* A pair in contact is kept until its crossing is beyond an end by this share of the edge, so that the next edge can
 * take over. */
#define SLACK 0.05

/* Two edges whose lines cross within both. */
typedef struct Crossing {
    double normal[3]; /* unit normal of both lines: first x second */
    double height;    /* of the first line over the second */
    double s, t;      /* places of the crossing on the edges */
} Crossing;

/* False if they do not cross within their lengths or are farther apart than reach; *bound is then less than their
 * distance. */
static inline bool cross_edges(Crossing *c, const double *const p[4], double reach, double slack, double *bound)
{
    double u[3], w[3], r[3], n[3];
    for (int k = 0; k < 3; k++) {
        u[k] = p[1][k] - p[0][k];
        w[k] = p[3][k] - p[2][k];
        r[k] = p[0][k] - p[2][k];
    }
    vector3_cross(u, w, n);
    double uu = vector3_dot(u, u), ww = vector3_dot(w, w), square = vector3_dot(n, n), height = vector3_dot(n, r);
    if (!(square > PARALLEL * uu * ww)) {
        /* from the first's start to the second's line, less what the first may come nearer by */
        double along = ww > 0.0 ? vector3_dot(w, r) / ww : 0.0, away = 0.0;
        for (int k = 0; k < 3; k++) away += (r[k] - along * w[k]) * (r[k] - along * w[k]);
        *bound = sqrt(away) - sqrt(PARALLEL * uu);
        return false;
    }
    *bound = fabs(height) / sqrt(square);
    if (*bound > reach) return false;
    double uw = vector3_dot(u, w), ur = vector3_dot(u, r), wr = vector3_dot(w, r), inverse = 1.0 / square;
    c->s = (uw * wr - ww * ur) * inverse;
    c->t = (uu * wr - uw * ur) * inverse;
    double over_s = c->s < 0.0 ? -c->s : c->s > 1.0 ? c->s - 1.0 : 0.0;
    double over_t = c->t < 0.0 ? -c->t : c->t > 1.0 ? c->t - 1.0 : 0.0;
    if (over_s > slack || over_t > slack) {
        /* an end's distance from the other line: (excess length x sine)^2 + height^2 */
        double a = over_s * over_s * square / ww, b = over_t * over_t * square / uu;
        *bound = sqrt(*bound * *bound + (a > b ? a : b));
        return false;
    }
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

/* How far both edges together have gone, and may go in this step. */
static double edge_way(const ContactRun *run, int e, int f)
{
    return run->lines.way[e / CONTACT_GROUP] + run->lines.way[f / CONTACT_GROUP];
}

static double edge_step(const ContactLoop *loop, const ContactRun *run, int e, int f)
{
    return (run->lines.speed[e / CONTACT_GROUP] + run->lines.speed[f / CONTACT_GROUP]) * loop->step.longer;
}

static void meet_pair(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int e, int32_t pair, ContactSums *sums,
                      ContactForce *forces, ContactPassages *passages)
{
    const ContactInterface *c = run->contact;
    ContactPairs *pairs = &run->edges.pairs;
    ContactMemory fresh = {0}, *m = contact_recall(&run->edges, e, pair);
    if (!m) m = &fresh;
    int f = pairs->other[pair];
    const int32_t *a = c->edge + 2 * (ptrdiff_t)e, *b = c->edge + 2 * (ptrdiff_t)f;
    const double *p[4];
    double full = c->edge_radius[e] + c->edge_radius[f], thickness = run->thinness * full, bound;
    double reach = thickness + edge_step(loop, run, e, f) + (m->side ? law->deepest : 0.0);
    Crossing cross;
    edge_ends(c, loop->state->x, e, f, p);
    if (!cross_edges(&cross, p, reach, m->side ? SLACK : 0.0, &bound)) {
        if (m->side) note_ended(passages, e, f, m);
        contact_forget(&run->edges, e, pair);
        pairs->wake[pair] = edge_way(run, e, f) + bound - full;
        return;
    }
    ContactTouch t = {.node = {a[0], a[1], b[0], b[1]},
                      .weight = {1.0 - cross.s, cross.s, cross.t - 1.0, -cross.t},
                      .thickness = thickness,
                      .stiffness = c->stiffness[c->edge_side[e] == CONTACT_SIDE_B]};
    pairs->wake[pair] = 0.0;
    contact_speed(law, &t);
    double before = cross.height - law->before * vector3_dot(t.speed, cross.normal);
    /* the lines' normal turns over where they are parallel: a pair in contact knows its direction */
    t.side = m->side ? (vector3_dot(m->direction, cross.normal) < 0.0 ? -1 : 1) : (before > 0.0) - (before < 0.0);
    if (m->side) t.side = m->side;
    if (t.side == 0) return;
    t.gap = t.side * cross.height;
    for (int k = 0; k < 3; k++) t.direction[k] = t.side * cross.normal[k];
    ContactForce *out = &forces[sums->count];
    int counts = contact_push(law, &t, m, out, sums);
    if (m->side) memcpy(m->direction, t.direction, sizeof m->direction);
    if (m != &fresh && m->side == 0) pairs->slot[pair] = 0;
    if (m == &fresh && m->side != 0) contact_keep(&run->edges, e, pair, m);
    if (!counts) return;
    sums->count++;
    double sign = c->edge_side[e] & CONTACT_SIDE_A ? 1.0 : -1.0;
    for (int k = 0; k < 3; k++) sums->force[k] += sign * out->force[k];
}

/* Place of a pair of edges in the list, -1 if it is none; *swapped if the list has it the other way round. */
static int32_t find_pair(const ContactPairs *pairs, int e, int f, bool *swapped)
{
    *swapped = f < e;
    int owner = *swapped ? f : e, other = *swapped ? e : f;
    for (int32_t p = pairs->start[owner]; p < pairs->start[owner + 1]; p++)
        if (pairs->other[p] == other) return p;
    return -1;
}

/* Gives a memory to the pair e, f if they cross and know nothing yet; its side by the direction of the force. */
static bool leave_to(ContactLoop *loop, ContactRun *run, const ContactPassage *ended, int e, int f)
{
    ContactPairs *pairs = &run->edges.pairs;
    const double *p[4];
    Crossing cross;
    double bound;
    bool swapped;
    int32_t pair = e == f ? -1 : find_pair(pairs, e, f, &swapped);
    if (pair < 0 || pairs->slot[pair]) return false;
    edge_ends(run->contact, loop->state->x, swapped ? f : e, swapped ? e : f, p);
    if (!cross_edges(&cross, p, INFINITY, SLACK, &bound)) return false;
    double sign = swapped ? -1.0 : 1.0;
    ContactMemory m = ended->memory;
    m.side = sign * vector3_dot(ended->memory.direction, cross.normal) >= 0.0 ? 1 : -1;
    for (int k = 0; k < 3; k++) {
        m.direction[k] = m.side * cross.normal[k];
        m.friction[k] *= sign;
    }
    contact_keep(&run->edges, swapped ? f : e, pair, &m);
    pairs->wake[pair] = run->edges.idle[(swapped ? f : e) / CONTACT_CHUNK] = 0.0;
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
    for (int k = 0; k < run->edges.chunk_count; k++)
        for (int i = 0; i < run->edges.passages[k].count; i++) {
            const ContactPassage *ended = &run->edges.passages[k].ended[i];
            int m = edges_around(run->contact, ended->first, first, AROUND);
            int n = edges_around(run->contact, ended->second, second, AROUND);
            for (int a = 0, left = 0; a < m && !left; a++)
                for (int b = 0; b < n && !left; b++) left = leave_to(loop, run, ended, first[a], second[b]);
        }
}

void contact_meet_edges(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int chunk)
{
    ContactList *list = &run->edges;
    int first = chunk * CONTACT_CHUNK,
        end = first + CONTACT_CHUNK < list->owner_count ? first + CONTACT_CHUNK : list->owner_count;
    ContactSums *sums = &list->sums[chunk];
    ContactPassages *passages = &list->passages[chunk];
    *sums = (ContactSums){0};
    passages->count = 0;
    if (list->idle[chunk] > loop->motion + 2.0 * loop->fastest * loop->step.longer) return;
    bool awake = false;
    for (int e = first; e < end; e++)
        for (int32_t pair = list->pairs.start[e]; pair < list->pairs.start[e + 1]; pair++) {
            int f = list->pairs.other[pair];
            if (list->pairs.wake[pair] > edge_way(run, e, f) + edge_step(loop, run, e, f)) continue;
            awake = true;
            meet_pair(loop, run, law, e, pair, sums, list->forces + list->pairs.start[first], passages);
        }
    if (!awake) list->idle[chunk] = contact_rest(list, first, end, loop->motion, run->lines.way, run->lines.way);
}
