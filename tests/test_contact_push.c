/* The law of a pair of contact: the kernels of all instruction sets against the equations one pair at a time. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "contact/contact_motion.h"
#include "contact/push_kernels.h"
#include "elements/kernels.h"
#include "solver/elementary.h"
#include "solver/vector3.h"
#include "tests/next_number.h"

enum { NODES = 4 * PUSH_LANES, ROUNDS = 20000 };

/* Masses of a pair. */
typedef struct Masses {
    double effective, load, least, firm, stiff; /* (C3), C of (C6), M, M_L, B */
} Masses;

static Masses masses_of(const ContactLaw *law, const PushPairs *f, int l, const double d[3])
{
    Masses m = {0};
    double inverse = 0.0, worst = 0.0, softest = 0.0, firm = 0.0;
    for (int i = 0; i < 4; i++)
        if (law->nodes[f->node[i][l]].inverse > 0.0) m.load += fabs(f->weight[i][l]);
    for (int i = 0; i < 4; i++) {
        const ContactNode *node = &law->nodes[f->node[i][l]];
        const double *h = node->room;
        double share = fabs(f->weight[i][l]), own = m.load * share, loaded = fmax(node->load, own) * node->inverse;
        double room = h[0] * d[0] * d[0] + h[1] * d[1] * d[1] + h[2] * d[2] * d[2] +
                      2.0 * (h[3] * d[0] * d[1] + h[4] * d[1] * d[2] + h[5] * d[2] * d[0]);
        if (share == 0.0 || node->inverse == 0.0) continue;
        inverse += share * share * node->inverse;
        worst = fmax(worst, loaded);
        softest = fmax(softest, loaded * room);
        firm = fmax(firm, fmax(node->firm, own) * node->inverse);
    }
    if (!(inverse > 0.0)) return m;
    m.effective = 1.0 / inverse;
    m.least = 1.0 / worst;
    m.firm = 1.0 / firm;
    m.stiff = 1.0 / softest;
    return m;
}

/* (C8), (C8a), (C8b), (C4a): the distance at which the pair begins to push, and its stiffness. */
static void renew_memory(const ContactLaw *law, PushPairs *f, int l, double v, double h, double k)
{
    double gap = f->gap[l], thickness = f->thickness[l], speed[3] = {f->speed[0][l], f->speed[1][l], f->speed[2][l]};
    double *g = &f->distance[l], cleared = fmin(v > 0.0 ? gap - h : gap, thickness);
    bool new = f->known[l] == 0.0;
    if (new) {
        *g = fmin(gap + fmax(-v * law->before, 0.0), thickness);
        f->k[l] = 0.0;
    } else {
        double way = law->before * vector3_norm(speed);
        double jump = f->last[l] + law->before * v - gap - 0.1 * way - 0.02 * thickness;
        if (jump > 0.0) *g -= jump;
    }
    f->last[l] = gap;
    if (cleared > *g || (new &&cleared < gap)) *g = cleared;
    if (!new &&k > 1.25 * f->k[l] && *g > gap) *g = gap + (*g - gap) * sqrt(f->k[l] / k);
    if (new || k < f->k[l] || k > 1.25 * f->k[l]) f->k[l] = k;
}

/* (C2) to (C7). */
static double penalty(const ContactLaw *law, PushPairs *f, int l, const Masses *m, double v, double h)
{
    double z = law->damping, root = sqrt(4.0 * z * z + 0.8 * m->stiff / m->least) - 2.0 * z;
    double k = fmin(CONTACT_STIFFNESS * f->stiffness[l] * m->effective, root * root * m->least);
    renew_memory(law, f, l, v, h, k / (law->longer * law->longer));
    double p = f->distance[l] - f->gap[l];
    double mean = p >= h ? p : p <= -h ? 0.0 : (p + h) * (p + h) / (4.0 * h), force = f->k[l] * mean;
    if (z > 0.0 && mean > 0.0) {
        double c = fmin(sqrt(f->k[l] * m->effective), root * m->least / law->longer);
        force = fmax(force - 2.0 * z * c * v, 0.0);
    }
    return force;
}

/* (C13). */
static double limit_of(const ContactLaw *law, const PushPairs *f, int l, const Masses *m, double v, double force,
                       double last, const double d[3])
{
    double mean = 0.5 * (law->before + law->next), e = CONTACT_FLOOR * f->distance[l], way = e - f->gap[l];
    double pull[3] = {0.0, 0.0, 0.0}, most = last > 0.0 ? m->firm : m->least;
    if (way > 0.0) way = e > 0.0 ? 0.2 * fmin(way, e) : 0.0;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) pull[k] += f->weight[i][l] * law->pull[f->node[i][l]].a[k];
    double least = way / law->longer, speed = v + (vector3_dot(pull, d) + (force + last) / m->effective) * mean;
    double mass = speed < least ? fmin(m->effective, most) : m->effective;
    return fmax(last + mass * (least - speed) / mean, 0.0);
}

/* (C9) to (C11). */
static void rub(const ContactLaw *law, PushPairs *f, int l, const Masses *m, double v, double force, const double d[3])
{
    double k = fmin(f->k[l], law->sliding * m->least / (law->longer * law->longer)), square = 0.0, rubbed[3];
    double old[3] = {f->friction[0][l], f->friction[1][l], f->friction[2][l]}, along = vector3_dot(old, d);
    for (int i = 0; i < 3; i++) {
        double slip = f->speed[i][l] - v * d[i];
        square += slip * slip;
        rubbed[i] = old[i] - (along * d[i] + k * law->before * slip);
    }
    double mu = law->static_friction;
    if (law->decay > 0.0)
        mu = law->dynamic_friction + (mu - law->dynamic_friction) * elementary_exp(-law->decay * sqrt(square));
    double size = vector3_norm(rubbed), scale = size <= mu * force ? 1.0 : mu * force / size;
    for (int i = 0; i < 3; i++) f->friction[i][l] = (float)(scale * rubbed[i]);
}

static void forget(PushPairs *f, int l)
{
    f->limit[l] = 0.0;
    for (int k = 0; k < 3; k++) f->friction[k][l] = 0.0;
}

/* Pushes one pair. */
static void push_pair(const ContactLaw *law, PushPairs *f, int l)
{
    double d[3] = {f->direction[0][l], f->direction[1][l], f->direction[2][l]};
    double u[3] = {f->speed[0][l], f->speed[1][l], f->speed[2][l]}, v = vector3_dot(u, d), out[3];
    double h = 0.25 * (law->before + law->next) * fabs(v), thickness = f->thickness[l];
    bool known = f->known[l] > 0.0, touch = f->gap[l]<thickness + h, rubs = law->static_friction> 0.0;
    bool counts = touch || f->gap[l] < thickness + contact_ahead(-v * law->next, thickness);
    bool deep = f->gap[l] < -law->deepest;
    Masses m = masses_of(law, f, l, d);
    bool moves = m.effective > 0.0;
    if (!known || !touch) forget(f, l);
    f->lost |= (unsigned)(counts && deep && known && touch && moves) << l;
    if (!counts || !moves || deep) return;
    f->count |= 1u << l;
    f->keep |= (unsigned)touch << l;
    f->fast |= (unsigned)(touch && !known && thickness > 0.0 && -v * law->before > thickness) << l;
    double force = touch ? penalty(law, f, l, &m, v, h) : 0.0, last = f->limit[l];
    if (!touch) f->distance[l] = thickness;
    f->limit[l] = (float)limit_of(law, f, l, &m, v, force, last, d);
    force += f->limit[l];
    if (touch && rubs) rub(law, f, l, &m, v, force, d);
    for (int k = 0; k < 3; k++) {
        out[k] = force * d[k];
        if (touch && rubs) out[k] += f->friction[k][l];
        f->force[k][l] = out[k];
    }
    f->power[l] = vector3_dot(out, u);
    f->load[l] = m.load;
    f->firm[l] = f->limit[l] > 0.0 ? m.load : 0.0;
}

/* Nodes of which every sixth is fixed and some are loaded, and accelerations. */
static void fill_nodes(ContactNode *nodes, ContactPull *pull)
{
    for (int n = 0; n < NODES; n++) {
        nodes[n] = (ContactNode){.load = n % 3 ? 0.0 : 4.0 + 3.0 * next_number(), .inverse = n % 6 == 5 ? 0.0 : 1.5};
        nodes[n].firm = n % 2 ? 0.5 * nodes[n].load : 0.0;
        nodes[n].inverse *= 1.0 + 0.5 * next_number();
        for (int k = 0; k < 6; k++) nodes[n].room[k] = (k < 3 ? 0.6 : 0.0) + 0.1 * next_number();
        for (int k = 0; k < 3; k++) pull[n].a[k] = 0.1 * next_number();
    }
}

/* Node against triangle, or edge against edge; lanes of which every third remembers nothing. */
static void fill_pairs(PushPairs *f, int round)
{
    *f = (PushPairs){.count = 0};
    for (int l = 0; l < PUSH_LANES; l++) {
        double s = 0.5 + 0.5 * next_number(), t = 0.5 + 0.5 * next_number(), d[3];
        bool edges = (round + l) % 2;
        const double weight[2][4] = {{1.0, -s, l == 3 ? 0.0 : -(1.0 - s) * t, l == 3 ? s - 1.0 : (s - 1.0) * (1.0 - t)},
                                     {1.0 - s, s, t - 1.0, -t}};
        for (int i = 0; i < 4; i++) {
            f->node[i][l] = round % 9 == 0 && l == 0 ? 5 : 4 * l + i;
            f->weight[i][l] = weight[edges][i];
        }
        for (int k = 0; k < 3; k++) d[k] = next_number(), f->speed[k][l] = (l == 5 ? 3.0 : 0.3) * next_number();
        vector3_normalize(d);
        for (int k = 0; k < 3; k++) f->direction[k][l] = d[k], f->friction[k][l] = (float)(0.01 * next_number());
        f->thickness[l] = l == 7 ? 0.0 : 0.1;
        f->gap[l] = l == 6 ? -1.2 + 0.4 * next_number() : 0.06 + 0.1 * next_number();
        f->stiffness[l] = 0.1;
        f->known[l] = (round + l) % 3 ? 1.0 : 0.0;
        f->last[l] = (float)(f->gap[l] + 0.03 * next_number());
        f->distance[l] = 0.08 + 0.02 * next_number();
        f->k[l] = 0.05 + 0.05 * next_number();
        f->limit[l] = l % 2 ? (float)(0.05 + 0.05 * next_number()) : 0.0;
    }
}

/* The pairs that count, and what those that touch remember. */
static void compare(const PushPairs *a, const PushPairs *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->keep, b->keep);
    assert_int_equal(a->lost, b->lost);
    assert_int_equal(a->fast, b->fast);
    for (int l = 0; l < PUSH_LANES; l++) {
        if (!(a->count >> l & 1)) continue;
        assert_true(a->load[l] == b->load[l] && a->firm[l] == b->firm[l] && a->power[l] == b->power[l]);
        for (int k = 0; k < 3; k++) assert_true(a->force[k][l] == b->force[k][l]);
        if (!(a->keep >> l & 1)) continue;
        assert_true(a->last[l] == b->last[l] && a->distance[l] == b->distance[l]);
        assert_true(a->k[l] == b->k[l] && a->limit[l] == b->limit[l]);
        for (int k = 0; k < 3; k++) assert_true(a->friction[k][l] == b->friction[k][l]);
    }
}

static void law_of_pairs(void **state)
{
    (void)state;
    const char *name[] = {"v2", "v3", "v4"};
    const PushKernels *kernels[] = {&push_kernels_v2, &push_kernels_v3, &push_kernels_v4};
    int seen[4] = {0};
    for (int round = 0; round < ROUNDS; round++) {
        ContactNode nodes[NODES];
        ContactPull pull[NODES];
        PushPairs given, expected;
        fill_nodes(nodes, pull);
        fill_pairs(&given, round);
        const ContactLaw law = {.nodes = nodes,
                                .pull = pull,
                                .before = 0.11,
                                .next = 0.1,
                                .longer = round % 4 ? 0.11 : 0.13,
                                .sliding = 0.4,
                                .damping = round % 2 ? 0.2 : 0.0,
                                .static_friction = round % 3 ? 0.4 : 0.0,
                                .dynamic_friction = round % 3 ? 0.3 : 0.0,
                                .decay = round % 5 ? 0.0 : 2.0,
                                .deepest = 1.0};
        expected = given;
        for (int l = 0; l < PUSH_LANES; l++) push_pair(&law, &expected, l);
        for (int s = 0; s < 3; s++) {
            PushPairs block = given;
            if (!kernels_select(name[s])) continue;
            kernels[s]->push(&law, &block, 1);
            compare(&expected, &block);
        }
        seen[0] += __builtin_popcount(expected.count), seen[1] += __builtin_popcount(expected.keep);
        seen[2] += __builtin_popcount(expected.lost), seen[3] += __builtin_popcount(expected.fast);
    }
    assert_true(seen[0] > seen[1] + ROUNDS / 10 && seen[1] > ROUNDS && seen[2] > ROUNDS / 10 && seen[3] > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(law_of_pairs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
