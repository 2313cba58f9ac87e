/* Edges against edges: where two lines cross, on which side the first passes the second. */
#include "contact/contact_law.h"
#include "contact/contact_sides.h"

/* Edges at a smaller angle (sine squared) are as good as parallel: their nodes do the work. */
#define PARALLEL 1e-3

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

/* Edges that do not cross within their lengths, most of them: cheap, and for no pair that does. */
static inline bool pass_by(const double *const p[4])
{
    double u[3], w[3], r[3];
    for (int k = 0; k < 3; k++) {
        u[k] = p[1][k] - p[0][k];
        w[k] = p[3][k] - p[2][k];
        r[k] = p[0][k] - p[2][k];
    }
    double uu = vector3_dot(u, u), ww = vector3_dot(w, w), uw = vector3_dot(u, w);
    double ur = vector3_dot(u, r), wr = vector3_dot(w, r), least = 1e-9 * uu * ww, most = uu * ww - uw * uw + least;
    double s = uw * wr - ww * ur, t = uu * wr - uw * ur;
    return (s < -least) | (t < -least) | (s > most) | (t > most);
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

/* How fast two edges may come nearer at most. */
static double closing_speed(const double *v, const int32_t *a, const int32_t *b)
{
    double most = 0.0;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            double u[3];
            vector3_subtract(v + 3 * (ptrdiff_t)a[i], v + 3 * (ptrdiff_t)b[k], u);
            most = larger(most, vector3_dot(u, u));
        }
    return sqrt(most);
}

static void meet_pair(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int e, int f, ContactSums *sums,
                      ContactForce *forces, ContactPassages *passages)
{
    const ContactInterface *c = run->contact;
    const int32_t *a = c->edge + 2 * (ptrdiff_t)e, *b = c->edge + 2 * (ptrdiff_t)f;
    const double *p[4], *inverse = loop->model->contact_inverse;
    ContactMemory *m = contact_recall(&run->edges, e, f);
    edge_ends(c, loop->state->x, e, f, p);
    if (!m && pass_by(p)) return;
    double thickness = run->thinness * (c->edge_radius[e] + c->edge_radius[f]);
    double reach = thickness + contact_ahead(closing_speed(loop->state->v, a, b) * loop->step.longer, thickness) +
                   (m ? law->deepest : 0.0);
    Crossing cross;
    if (!cross_edges(&cross, p, reach, m ? SLACK : 0.0)) {
        if (!m) return;
        note_ended(passages, e, f, m);
        *m = (ContactMemory){0};
        return;
    }
    if (!m && !(contact_moves(inverse, a[0], a + 1, 1) || contact_moves(inverse, b[0], b + 1, 1))) return;
    ContactMemory fresh = {0};
    if (!m) m = &fresh;
    ContactTouch t = {.node = {a[0], a[1], b[0], b[1]},
                      .weight = {1.0 - cross.s, cross.s, cross.t - 1.0, -cross.t},
                      .thickness = thickness,
                      .stiffness = c->stiffness[c->edge_side[e] == CONTACT_SIDE_B]};
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
    if (m == &fresh && m->side != 0) contact_keep(&run->edges, e, f, m);
    if (!counts) return;
    out->blocks = contact_is_sharp(loop, run, e) && contact_is_sharp(loop, run, f);
    sums->count++;
    double sign = c->edge_side[e] & CONTACT_SIDE_A ? 1.0 : -1.0;
    for (int k = 0; k < 3; k++) sums->force[k] += sign * out->force[k];
}

static int owner_group(const ContactRun *run, int e)
{
    return run->line_place[e] / CONTACT_GROUP;
}

/* Gives a memory to the pair e, f if they cross and know nothing yet; its side by the direction of the force. */
static bool leave_to(ContactLoop *loop, ContactRun *run, const ContactPassage *ended, int e, int f)
{
    const double *p[4], *was = ended->memory.direction;
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
    double sign = swapped ? -1.0 : 1.0, along = sign * vector3_dot(was, cross.normal);
    ContactMemory m = ended->memory;
    m.side = along >= 0.0 ? 1 : -1;
    if (fabs(along) < PASSAGE_TURN || fabs(m.side * cross.height - m.gap) > PASSAGE_JUMP * thickness) return false;
    for (int k = 0; k < 3; k++) {
        m.direction[k] = m.side * cross.normal[k];
        m.friction[k] *= sign;
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

void contact_meet_edges(ContactLoop *loop, ContactRun *run, const ContactLaw *law, int group, int thread, int place)
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
    contact_find_near(loop, run, true, group, thread, place, start);
    if (part->failed || start[CONTACT_GROUP] == 0) return;
    ContactForce *forces = contact_force_room(part, (size_t)start[CONTACT_GROUP]);
    if (!forces) return;
    for (int k = 0; k < CONTACT_GROUP && lanes->item[k] >= 0; k++) {
        for (int i = start[k]; i < start[k + 1]; i++)
            meet_pair(loop, run, law, lanes->item[k], part->other[i], sums, forces, passages);
        if (start[k + 1] > start[k]) contact_count_held(list, lanes->item[k]);
    }
    part->force_count += (size_t)sums->count;
}
