/* The law of one pair: penalty, damping and friction (docs/theory.md, Contact). Inlined into the loops over nodes and
 * over edges. */
#ifndef BILLOW_CONTACT_LAW_H
#define BILLOW_CONTACT_LAW_H

#include <math.h>
#include <string.h>

#include "contact/contact_loop.h"
#include "solver/elementary.h"
#include "solver/vector3.h"

/* Share of what a gap is short of that floor by, which the coming step gives back. */
#define CONTACT_RISE 0.2

/* What a gap may close by in a step beyond the pair's velocity: shares of the thickness and of the way (eq. C8a). */
#define CONTACT_JUMP 0.02
#define CONTACT_JUMP_WAY 0.1

/* (w dt)^2 of a pair by itself at a share of 1, as SOFSCL gives it; 0.1 is the default (eq. C4). */
#define CONTACT_STIFFNESS 5.0

/* Coefficients of one interface in one cycle. */
typedef struct ContactLaw {
    const Model *model;
    const double *v, *inverse;
    ContactPull *pull;           /* of this thread (node_count) */
    int64_t cycle;               /* contact's count of cycles */
    const double *rows;          /* corner sums of the elements, elements/kernels.h (row_count x ROW_SIZE) */
    const double *pressure;      /* of each pressure set (pressure_set_count + 1) */
    const double *room;          /* by node, contact/contact_loop.h (node_count x 6) */
    const double *firm;          /* loads by pairs at the limit, likewise (node_count) */
    const double *corner;        /* loads of the last cycle, fourth in a node's row */
    const unsigned char *pulled; /* contact_list_pulled */
    double time, before, next;   /* t_n, dt_{n-1/2}, dt_{n+1/2} */
    double longer;               /* the step that stiffness and limit reckon with, eq. C4b */
    double sliding;              /* b for friction's springs */
    double damping;              /* share of critical */
    double static_friction, dynamic_friction, decay;
    double deepest; /* penetration at which a pair is given up [L] */
} ContactLaw;

/* A pair that is near: geometry of this cycle. */
typedef struct ContactTouch {
    int32_t node[4];
    double weight[4];
    double gap;          /* distance on the side where it is taken to be; negative behind [L] */
    double thickness;    /* distance at which it should stay [L] */
    double direction[3]; /* unit vector of the force on the first weight */
    double speed[3];     /* sum of weight v: velocity of the first against the second [L/T] */
    double stiffness;    /* share of the stability limit */
    int side;            /* for a new pair */
} ContactTouch;

/* Penetration at which a pair is given up. */
static inline double contact_deepest(const ContactInterface *c)
{
    return 10.0 * c->thickest > 0.5 * c->longest_side ? 10.0 * c->thickest : 0.5 * c->longest_side;
}

static inline void contact_speed(const ContactLaw *law, ContactTouch *t)
{
    for (int k = 0; k < 3; k++) t->speed[k] = 0.0;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) t->speed[k] += t->weight[i] * law->v[3 * (ptrdiff_t)t->node[i] + k];
}

/* Masses of one pair. */
typedef struct ContactMasses {
    double effective; /* eq. C3; 0: nothing of it can move */
    double load;      /* C of eq. C6 */
    double least;     /* M, the least m/S of its nodes */
    double firm;      /* the same as M with the loads of pairs at the limit alone */
    double stiff;     /* B, the least m R/S of them: k dt^2 must not be larger (eq. C4) */
} ContactMasses;

/* One over the (w dt)^2 that contact in the direction d may add at a node (eq. C12). */
static inline double contact_inverse_room(const double *h, const double *d)
{
    return h[0] * d[0] * d[0] + h[1] * d[1] * d[1] + h[2] * d[2] * d[2] +
           2.0 * (h[3] * d[0] * d[1] + h[4] * d[1] * d[2] + h[5] * d[2] * d[0]);
}

static inline double contact_room(const double *h, const double *d)
{
    return 1.0 / contact_inverse_room(h, d);
}

static inline ContactMasses contact_masses(const ContactLaw *law, const ContactTouch *t)
{
    ContactMasses masses = {0};
    double inverse = 0.0, worst = 0.0, softest = 0.0, firm = 0.0; /* one over the effective mass, over M, B and M_L */
    for (int i = 0; i < 4; i++)
        if (law->inverse[t->node[i]] > 0.0) masses.load += fabs(t->weight[i]);
    for (int i = 0; i < 4; i++) {
        double of_node = law->inverse[t->node[i]], share = fabs(t->weight[i]);
        if (share == 0.0 || of_node == 0.0) continue;
        double own = masses.load * share, all = law->corner[CONTACT_ROW * (ptrdiff_t)t->node[i] + 3];
        inverse += share * share * of_node;
        double loaded = (all > own ? all : own) * of_node;
        worst = loaded > worst ? loaded : worst;
        double soft = loaded * contact_inverse_room(law->room + 6 * (ptrdiff_t)t->node[i], t->direction);
        softest = soft > softest ? soft : softest;
        double held = law->firm[t->node[i]];
        held = (held > own ? held : own) * of_node;
        firm = held > firm ? held : firm;
    }
    if (!(inverse > 0.0)) return masses;
    masses.effective = 1.0 / inverse;
    masses.least = 1.0 / worst;
    masses.firm = 1.0 / firm;
    masses.stiff = 1.0 / softest;
    return masses;
}

/* A pair that was not in contact (eq. C8). What it is closer by than it can have come in the last step, it was before.
 */
static inline void contact_begin(const ContactTouch *t, double normal_speed, double before, ContactMemory *m)
{
    double came = normal_speed < 0.0 ? -normal_speed * before : 0.0;
    *m = (ContactMemory){.side = t->side, .distance = t->gap + came < t->thickness ? t->gap + came : t->thickness};
}

/* An initial penetration eases; one that parts gets the distance at which its mean depth over the step is zero, so that
 * it goes without a push (eq. C8b). cleared: the gap, of a parting pair less h. */
static inline void contact_ease(const ContactTouch *t, double cleared, bool new_pair, ContactMemory *m)
{
    if (cleared > t->thickness) cleared = t->thickness;
    if (cleared > m->distance || (new_pair && cleared < t->gap)) m->distance = cleared;
}

/* A gap that closes by more than the pair's velocity explains has jumped: onto another triangle or edge, or with lines
 * that turn. What it jumped by does no work, so the distance gives way by it (eq. C8a). */
static inline void contact_yield(const ContactTouch *t, double normal_speed, double before, ContactMemory *m)
{
    double way = before * vector3_norm(t->speed);
    double jump = m->gap + before * normal_speed - t->gap - CONTACT_JUMP_WAY * way - CONTACT_JUMP * t->thickness;
    if (jump > 0.0) m->distance -= jump;
}

/* Tangential force on the node: a spring that slips at the friction limit (eq. C9, C10). */
static inline void contact_friction(const ContactLaw *law, const ContactTouch *t, double normal_speed,
                                    double normal_force, double stiffness, ContactMemory *m)
{
    double slip[3], friction[3] = {m->friction[0], m->friction[1], m->friction[2]}, speed2 = 0.0;
    double along = vector3_dot(friction, t->direction);
    for (int k = 0; k < 3; k++) {
        slip[k] = t->speed[k] - normal_speed * t->direction[k];
        speed2 += slip[k] * slip[k];
        friction[k] -= along * t->direction[k] + stiffness * law->before * slip[k];
    }
    double mu = law->static_friction;
    if (law->decay > 0.0)
        mu = law->dynamic_friction +
             (mu - law->dynamic_friction) * elementary_exp(-law->decay * sqrt(speed2)); /* eq. C11 */
    double size = vector3_norm(friction), most = mu * normal_force, scale = size <= most ? 1.0 : most / size;
    for (int k = 0; k < 3; k++) m->friction[k] = (float)(scale * friction[k]);
}

/* Mean over the step of a penetration that grows or shrinks by 2 h, as far as it is positive (eq. C2). */
static inline double contact_mean_depth(double depth, double h)
{
    if (depth >= h) return depth;
    return depth <= -h ? 0.0 : (depth + h) * (depth + h) / (4.0 * h);
}

/* The stiffness follows the step as long as its bound allows; where it rises under load the distance falls, so that
 * no energy comes of it (eq. C4a). */
static inline void contact_stiffen(const ContactTouch *t, double stiffness, bool new_pair, ContactMemory *m)
{
    if (new_pair || stiffness < m->stiffness) {
        m->stiffness = stiffness;
    } else if (stiffness > 1.25 * m->stiffness) {
        if (m->distance > t->gap) m->distance = t->gap + (m->distance - t->gap) * sqrt(m->stiffness / stiffness);
        m->stiffness = stiffness;
    }
}

/* Forms a node's acceleration by its elements and the gas (contact/contact_pull.c). */
void contact_form_pull(const ContactLaw *law, int32_t node, double a[3]);

/* The same, formed once a cycle. */
static inline const double *contact_pull(const ContactLaw *law, int32_t node)
{
    ContactPull *pull = &law->pull[node];
    if (pull->cycle != law->cycle) {
        contact_form_pull(law, node, pull->a);
        pull->cycle = law->cycle;
    }
    return pull->a;
}

/* Force that keeps the coming step from closing the gap (eq. C13): an impulse without rebound. It begins with that of
 * the last step, rises by no more than all pairs of its nodes may together, and falls as fast as it can. */
static inline double contact_limit(const ContactLaw *law, const ContactTouch *t, const ContactMasses *masses,
                                   double normal_speed, double force, const ContactMemory *m)
{
    double mean = 0.5 * (law->before + law->next), least = CONTACT_FLOOR * m->distance;
    double way = least - t->gap, pull[3] = {0.0, 0.0, 0.0};
    if (way > 0.0) way = least > 0.0 ? CONTACT_RISE * (way < least ? way : least) : 0.0;
    double slowest = way / law->longer, most = m->limit > 0.0 ? masses->firm : masses->least;
    for (int i = 0; i < 4; i++) {
        if (t->weight[i] == 0.0) continue;
        const double *a = contact_pull(law, t->node[i]);
        for (int k = 0; k < 3; k++) pull[k] += t->weight[i] * a[k];
    }
    double speed = normal_speed + (vector3_dot(pull, t->direction) + (force + m->limit) / masses->effective) * mean;
    double mass = masses->effective < most || speed > slowest ? masses->effective : most;
    double limit = m->limit + mass * (slowest - speed) / mean;
    return limit > 0.0 ? limit : 0.0;
}

/* Force of the pair. Returns 1 if it counts for the nodes' loads (it touches or will in the coming step), else 0 with
 * the memory cleared where the contact has ended. */
static inline int contact_push(const ContactLaw *law, ContactTouch *t, ContactMemory *m, ContactForce *out,
                               ContactSums *sums)
{
    double normal_speed = vector3_dot(t->speed, t->direction);
    double h = 0.25 * (law->before + law->next) * fabs(normal_speed);
    bool new_pair = m->side == 0, touching = t->gap < t->thickness + h;
    if (!touching) *m = (ContactMemory){0};
    if (!touching && !(t->gap < t->thickness + contact_ahead(-normal_speed * law->next, t->thickness))) return 0;
    ContactMasses masses = contact_masses(law, t);
    if (masses.effective == 0.0 || t->gap < -law->deepest) {
        sums->lost += m->side != 0 && masses.effective > 0.0;
        if (m->side != 0 && masses.effective > 0.0) sums->lost_node = t->node[0];
        *m = (ContactMemory){0};
        return 0;
    }
    memcpy(out->node, t->node, sizeof out->node);
    memcpy(out->weight, t->weight, sizeof out->weight);
    out->load = masses.load;
    out->blocks = true;
    double force = 0.0, step2 = law->longer * law->longer;
    if (touching) {
        double z = law->damping;
        double root = sqrt(4.0 * z * z + 0.8 * masses.stiff / masses.least) - 2.0 * z; /* of b, eq. C5 */
        double most = root * root * masses.least, wanted = CONTACT_STIFFNESS * t->stiffness * masses.effective;
        if (new_pair) {
            contact_begin(t, normal_speed, law->before, m);
            if (t->thickness > 0.0 && -normal_speed * law->before > t->thickness) {
                sums->fast++;
                sums->fast_node = t->node[0];
            }
        }
        if (!new_pair) contact_yield(t, normal_speed, law->before, m);
        m->gap = (float)t->gap;
        contact_ease(t, normal_speed > 0.0 ? t->gap - h : t->gap, new_pair, m);
        contact_stiffen(t, (wanted < most ? wanted : most) / step2, new_pair, m);
        double depth = contact_mean_depth(m->distance - t->gap, h);
        force = m->stiffness * depth;
        if (z > 0.0 && depth > 0.0) {
            double c = sqrt(m->stiffness * masses.effective), bound = root * masses.least / law->longer;
            force -= 2.0 * z * (c < bound ? c : bound) * normal_speed;
            force = force > 0.0 ? force : 0.0;
        }
    }
    if (!touching) m->distance = t->thickness;
    m->limit = (float)contact_limit(law, t, &masses, normal_speed, force, m);
    out->firm = m->limit > 0.0 ? masses.load : 0.0;
    force += m->limit;
    for (int k = 0; k < 3; k++) out->force[k] = force * t->direction[k];
    if (touching && (law->static_friction > 0.0 || law->dynamic_friction > 0.0)) {
        double sliding = law->sliding * masses.least / step2;
        contact_friction(law, t, normal_speed, force, m->stiffness < sliding ? m->stiffness : sliding, m);
        for (int k = 0; k < 3; k++) out->force[k] += m->friction[k];
    }
    if (!touching) *m = (ContactMemory){0};
    sums->power += vector3_dot(out->force, t->speed);
    return 1;
}

#endif
