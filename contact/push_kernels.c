/* Compiled once per instruction set, with BILLOW_PUSH_TABLE naming its table. */
#include "contact/push_kernels.h"

#include <stddef.h>

#include "contact/pack_lanes.h"
#include "solver/elementary.h"

/* Share of what a gap is short of that floor by, which the coming step gives back (eq. C13). */
#define CONTACT_RISE 0.2

/* What a gap may close by in a step beyond the pair's velocity: shares of the thickness and of the way (eq. C8a). */
#define CONTACT_JUMP 0.02
#define CONTACT_JUMP_WAY 0.1

/* One register of pairs, as they are in PushPairs. */
typedef struct Pairs {
    Pack weight[4], gap, thickness, speed[3], normal_speed;
    Pack3 direction;
    Pack h;                 /* half of what the gap changes by in the mean step [L] */
    PackMask known;         /* those that remember something */
    PackMask touch;         /* those that touch now */
    Pack distance, k, last; /* remembered */
    Pack limit, friction[3];
} Pairs;

/* Their masses. */
typedef struct Masses {
    PackMask movable; /* something of it can move; the others have no masses */
    Pack effective;   /* eq. C3 */
    Pack load;        /* C of eq. C6 */
    Pack least;       /* M, the least m/S of its nodes */
    Pack firm;        /* the same as M with the loads of pairs at the limit alone */
    Pack stiff;       /* B, the least m R/S of them: k dt^2 must not be larger (eq. C4) */
} Masses;

ALWAYS_INLINE Pack3 load3(const double from[3][PUSH_LANES], int r)
{
    return (Pack3){{pack_load(from[0] + r), pack_load(from[1] + r), pack_load(from[2] + r)}};
}

ALWAYS_INLINE Pairs load_pairs(const ContactLaw *law, const PushPairs *f, int r)
{
    Pairs p = {.gap = pack_load(f->gap + r),
               .thickness = pack_load(f->thickness + r),
               .direction = load3(f->direction, r),
               .distance = pack_load(f->distance + r),
               .k = pack_load(f->k + r),
               .last = pack_load(f->last + r)};
    Pack zero = pack_of(0.0);
    Pack3 speed = load3(f->speed, r);
    for (int i = 0; i < 4; i++) p.weight[i] = pack_load(f->weight[i] + r);
    for (int k = 0; k < 3; k++) p.speed[k] = speed.at[k];
    p.normal_speed = pack3_dot(speed, p.direction);
    p.h = 0.25 * (law->before + law->next) * pack_absolute(p.normal_speed);
    p.known = mask_less(zero, pack_load(f->known + r));
    p.touch = mask_less(p.gap, p.thickness + p.h);
    p.limit = mask_choose(p.known & p.touch, pack_load(f->limit + r), zero);
    for (int k = 0; k < 3; k++) p.friction[k] = mask_choose(p.known & p.touch, pack_load(f->friction[k] + r), zero);
    return p;
}

/* One over the (w dt)^2 that contact in the direction d may add at nodes (eq. C12). */
ALWAYS_INLINE Pack inverse_room(const PackRows *diagonal, const PackRows *rest, const Pack3 *direction)
{
    const Pack *d = direction->at;
    return diagonal->at[0] * d[0] * d[0] + diagonal->at[1] * d[1] * d[1] + diagonal->at[2] * d[2] * d[2] +
           2.0 * (diagonal->at[3] * d[0] * d[1] + rest->at[0] * d[1] * d[2] + rest->at[1] * d[2] * d[0]);
}

ALWAYS_INLINE Masses masses_of(const ContactLaw *law, const PushPairs *f, const Pairs *p, int r)
{
    enum { STRIDE = sizeof(ContactNode) / sizeof(double) };
    Masses m = {.load = pack_of(0.0)};
    Pack zero = pack_of(0.0), one = pack_of(1.0);
    Pack inverse = zero, worst = zero, softest = zero, firm = zero; /* one over the effective mass, over M, B, M_L */
    PackRows node[4];
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        node[i] = rows_load(&law->nodes->load, STRIDE, f->node[i] + r);
        m.load += mask_choose(mask_less(zero, node[i].at[2]), pack_absolute(p->weight[i]), zero);
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        Pack share = pack_absolute(p->weight[i]), own = m.load * share, of_node = node[i].at[2];
        PackMask counts = mask_less(zero, share);
        PackRows diagonal = rows_load(law->nodes->room, STRIDE, f->node[i] + r);
        PackRows rest = rows_load(law->nodes->room + 4, STRIDE, f->node[i] + r);
        inverse += share * share * of_node;
        Pack loaded = mask_choose(counts, pack_larger(node[i].at[0], own) * of_node, zero);
        worst = pack_larger(loaded, worst);
        softest = pack_larger(loaded * inverse_room(&diagonal, &rest, &p->direction), softest);
        firm = pack_larger(mask_choose(counts, pack_larger(node[i].at[1], own) * of_node, zero), firm);
    }
    m.movable = mask_less(zero, inverse);
    m.effective = one / mask_choose(m.movable, inverse, one);
    m.least = one / mask_choose(m.movable, worst, one);
    m.firm = one / mask_choose(m.movable, firm, one);
    m.stiff = one / mask_choose(m.movable, softest, one);
    return m;
}

/* A pair that was not in contact (eq. C8): what it is closer by than it can have come in the last step, it was before.
 * Returns those that met faster than one thickness in a step. */
ALWAYS_INLINE PackMask begin(const ContactLaw *law, Pairs *p)
{
    Pack zero = pack_of(0.0), came = pack_larger(-p->normal_speed * law->before, zero);
    p->distance = mask_choose(p->known, p->distance, pack_smaller(p->gap + came, p->thickness));
    p->k = mask_choose(p->known, p->k, zero);
    return ~p->known & mask_less(zero, p->thickness) & mask_less(p->thickness, came);
}

/* A gap that closes by more than the pair's velocity explains has jumped: onto another triangle or edge, or with lines
 * that turn. What it jumped by does no work, so the distance gives way by it (eq. C8a). */
ALWAYS_INLINE void yield(const ContactLaw *law, Pairs *p)
{
    const Pack *v = p->speed;
    Pack way = law->before * pack_root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    Pack jump = p->last + law->before * p->normal_speed - p->gap - CONTACT_JUMP_WAY * way - CONTACT_JUMP * p->thickness;
    PackMask jumped = p->known & mask_less(pack_of(0.0), jump);
    p->distance = mask_choose(jumped, p->distance - jump, p->distance);
}

/* An initial penetration eases; one that parts gets the distance at which its mean depth over the step is zero, so that
 * it goes without a push (eq. C8b). */
ALWAYS_INLINE void ease(Pairs *p)
{
    Pack cleared = mask_choose(mask_less(pack_of(0.0), p->normal_speed), p->gap - p->h, p->gap);
    cleared = pack_smaller(cleared, p->thickness);
    PackMask eased = mask_less(p->distance, cleared) | (~p->known & mask_less(cleared, p->gap));
    p->distance = mask_choose(eased, cleared, p->distance);
}

/* The stiffness follows the step as long as its bound allows; where it rises under load the distance falls, so that no
 * energy comes of it (eq. C4a). */
ALWAYS_INLINE void stiffen(Pairs *p, Pack k)
{
    PackMask falls = ~p->known | mask_less(k, p->k), rises = ~falls & mask_less(1.25 * p->k, k);
    Pack shorter = p->gap + (p->distance - p->gap) * pack_root(p->k / k);
    p->distance = mask_choose(rises & mask_less(p->gap, p->distance), shorter, p->distance);
    p->k = mask_choose(falls | rises, k, p->k);
}

/* Mean over the step of a penetration that grows or shrinks by 2 h, as far as it is positive (eq. C2). */
ALWAYS_INLINE Pack mean_depth(Pack depth, Pack h)
{
    Pack partly = (depth + h) * (depth + h) / (4.0 * h);
    return mask_choose(mask_less(depth, h), mask_choose(mask_less(-h, depth), partly, pack_of(0.0)), depth);
}

/* Penalty and damping of those that touch (eq. C1 to C5). */
ALWAYS_INLINE Pack penalty(const ContactLaw *law, const Masses *m, Pairs *p, Pack share)
{
    double z = law->damping, step2 = law->longer * law->longer;
    Pack root = pack_root(4.0 * z * z + 0.8 * m->stiff / m->least) - 2.0 * z; /* of b, eq. C5 */
    Pack most = root * root * m->least, wanted = CONTACT_STIFFNESS * share * m->effective;
    yield(law, p);
    p->last = p->gap;
    ease(p);
    stiffen(p, pack_smaller(wanted, most) / step2);
    Pack depth = mean_depth(p->distance - p->gap, p->h), force = p->k * depth;
    if (z > 0.0) {
        Pack c = pack_smaller(pack_root(p->k * m->effective), root * m->least / law->longer);
        Pack damped = pack_larger(force - 2.0 * z * c * p->normal_speed, pack_of(0.0));
        force = mask_choose(mask_less(pack_of(0.0), depth), damped, force);
    }
    return force;
}

/* Force that keeps the coming step from closing the gap (eq. C13): an impulse without rebound. It begins with that of
 * the last step, rises by no more than all pairs of its nodes may together, and falls as fast as it can. */
ALWAYS_INLINE Pack limit_of(const ContactLaw *law, const PushPairs *f, const Masses *m, const Pairs *p, Pack force,
                            int r)
{
    double mean = 0.5 * (law->before + law->next);
    Pack zero = pack_of(0.0), least = CONTACT_FLOOR * p->distance, way = least - p->gap;
    Pack risen = mask_choose(mask_less(zero, least), CONTACT_RISE * pack_smaller(way, least), zero);
    way = mask_choose(mask_less(zero, way), risen, way);
    Pack slowest = way / law->longer, most = mask_choose(mask_less(zero, p->limit), m->firm, m->least);
    Pack3 pull = {{zero, zero, zero}};
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        PackRows a = rows_load(law->pull->a, sizeof(ContactPull) / sizeof(double), f->node[i] + r);
        for (int k = 0; k < 3; k++) pull.at[k] += p->weight[i] * a.at[k];
    }
    Pack speed = p->normal_speed + (pack3_dot(pull, p->direction) + (force + p->limit) / m->effective) * mean;
    Pack mass = mask_choose(mask_less(m->effective, most) | mask_less(slowest, speed), m->effective, most);
    return pack_larger(p->limit + mass * (slowest - speed) / mean, zero);
}

/* Coefficient of friction at a square of the slip's speed (eq. C11). */
ALWAYS_INLINE Pack friction_at(const ContactLaw *law, Pack square)
{
    if (!(law->decay > 0.0)) return pack_of(law->static_friction);
    _Alignas(64) double at[PACK_WIDTH];
    pack_store(at, pack_root(square));
    for (int l = 0; l < PACK_WIDTH; l++)
        at[l] = law->dynamic_friction +
                (law->static_friction - law->dynamic_friction) * elementary_exp(-law->decay * at[l]);
    return pack_load(at);
}

/* Numbers as single precision keeps them. */
ALWAYS_INLINE Pack as_kept(Pack a)
{
    return __builtin_convertvector(__builtin_convertvector(a, PackFloat), Pack);
}

/* Tangential force on the first side: a spring that slips at the friction limit (eq. C9, C10). */
ALWAYS_INLINE void rub(const ContactLaw *law, const Masses *m, Pairs *p, Pack normal_force)
{
    const Pack *d = p->direction.at;
    Pack k = pack_smaller(p->k, law->sliding * m->least / (law->longer * law->longer)), square = pack_of(0.0);
    Pack along = p->friction[0] * d[0] + p->friction[1] * d[1] + p->friction[2] * d[2], friction[3];
    for (int i = 0; i < 3; i++) {
        Pack slip = p->speed[i] - p->normal_speed * d[i];
        square += slip * slip;
        friction[i] = p->friction[i] - (along * d[i] + k * law->before * slip);
    }
    Pack size = pack_root(friction[0] * friction[0] + friction[1] * friction[1] + friction[2] * friction[2]);
    Pack most = friction_at(law, square) * normal_force;
    Pack scale = mask_choose(mask_less(most, size), most / size, pack_of(1.0));
    for (int i = 0; i < 3; i++) p->friction[i] = as_kept(scale * friction[i]);
}

ALWAYS_INLINE void store_memory(PushPairs *f, const Pairs *p, int r)
{
    pack_store(f->last + r, p->last);
    pack_store(f->distance + r, p->distance);
    pack_store(f->k + r, p->k);
    pack_store(f->limit + r, p->limit);
    for (int i = 0; i < 3; i++) pack_store(f->friction[i] + r, p->friction[i]);
}

/* PACK_WIDTH pairs from lane r on. */
ALWAYS_INLINE void push_pack(const ContactLaw *law, PushPairs *f, int r)
{
    Pairs p = load_pairs(law, f, r);
    Pack zero = pack_of(0.0), ahead = pack_ahead(-p.normal_speed * law->next, p.thickness), power = zero;
    Masses m = masses_of(law, f, &p, r);
    PackMask count = p.touch | mask_less(p.gap, p.thickness + ahead), deep = mask_less(p.gap, pack_of(-law->deepest));
    PackMask fast = begin(law, &p) & p.touch;
    Pack force = mask_choose(p.touch, penalty(law, &m, &p, pack_load(f->stiffness + r)), zero);
    p.distance = mask_choose(p.touch, p.distance, p.thickness);
    p.limit = as_kept(limit_of(law, f, &m, &p, force, r));
    force += p.limit;
    bool rubs = law->static_friction > 0.0 || law->dynamic_friction > 0.0;
    if (rubs) rub(law, &m, &p, force);
    for (int k = 0; k < 3; k++) {
        Pack component = force * p.direction.at[k];
        if (rubs) component += mask_choose(p.touch, p.friction[k], zero);
        pack_store(f->force[k] + r, component);
        power += component * p.speed[k];
    }
    store_memory(f, &p, r);
    pack_store(f->power + r, power);
    pack_store(f->load + r, m.load);
    pack_store(f->firm + r, mask_choose(mask_less(zero, p.limit), m.load, zero));
    PackMask kept = count & m.movable & ~deep;
    f->count |= mask_lanes(kept) << r;
    f->keep |= mask_lanes(kept & p.touch) << r;
    f->lost |= mask_lanes(deep & p.known & p.touch & m.movable) << r;
    f->fast |= mask_lanes(kept & fast) << r;
}

static void push(const ContactLaw *law, PushPairs *block, int blocks)
{
    for (PushPairs *f = block; f < block + blocks; f++) {
        f->count = f->keep = f->lost = f->fast = 0;
        for (int r = 0; r < PUSH_LANES; r += PACK_WIDTH) push_pack(law, f, r);
    }
}

const PushKernels BILLOW_PUSH_TABLE = {.push = push};
