/* Stages of the element kernels: metric -> stress in natural directions, for several packs of points at a time.
 *
 * Each stage is a loop of its own over the packs: the roots and divisions of one pack wait for each other, so that the
 * processor needs several packs' at a time. Included by elements/kernels.c alone. */
#ifndef BILLOW_KERNEL_STAGES_H
#define BILLOW_KERNEL_STAGES_H

#include "elements/kernel_law.h"
#include "elements/kernels.h"

enum {
    LANES = BILLOW_LANES,
    PACKS = BILLOW_LANES / PACK_WIDTH, /* packs in a block */
    BLOCKS_AT_ONCE = 4,                /* blocks that go through the stages together, of elements with one point */
    STREAMS = BLOCKS_AT_ONCE * PACKS,  /* their packs */
};

/* Law constants of one call. */
typedef struct LawInput {
    FabricLaw law;
    Compliance compliance;
    double inverse_step;
    double count_work;           /* 1, or 0 when histories are only filled */
    bool new_account;            /* accounts begin */
    bool has_history, hourglass; /* of the group, for the further laws; hourglass: a one-point quad */
} LawInput;

/* What a kernel does besides the law; a constant of each kernel, so that its loops have no branch. */
enum {
    MODE_BIOT = 1,
    MODE_TENSION_FIELD = 2,
    MODE_LINER = 4,
    MODE_HISTORY = 8,      /* strain and stress of the last step are kept: stress-work ledger, damping */
    MODE_LOGARITHMIC = 16, /* with MODE_BIOT neither: Green */
    MODE_ACCOUNT = 32,     /* stresses give back at most what they got; without DAMP */
};

/* Where the constants and histories of one pack of points lie. */
typedef struct PointPlace {
    const double *point, *tail; /* elements/kernels.h */
    double *metric;             /* C of the last step, of an element with one point */
    float *stress;              /* S likewise */
    double *account;            /* of the element */
    double *memory;             /* of the further laws */
} PointPlace;

/* A pack of points: what comes in and what the stages leave. */
typedef struct PointPack {
    PackTensor c;      /* right Cauchy-Green tensor in material axes */
    PackTensor change; /* of c since the last step; where there are four points only with DAMP */
    PackTensor p;      /* weight x M S M^T, the stress in natural directions */
    Pack energy, viscous, rate;
    Pack trace; /* weight x tr S, where an element of several points keeps an account */
} PointPack;

ALWAYS_INLINE Pack lane_values(const double *from, int quantity)
{
    return pack_load(from + (ptrdiff_t)quantity * LANES);
}

/* C = M^T g M (eq. E4). */
ALWAYS_INLINE PackTensor material_metric(const double *point, PackTensor g)
{
    Pack m11 = lane_values(point, GEOMETRY_M11), m12 = lane_values(point, GEOMETRY_M12),
         m21 = lane_values(point, GEOMETRY_M21), m22 = lane_values(point, GEOMETRY_M22);
    Pack a1 = m11 * g.a11 + m21 * g.a12, a2 = m11 * g.a12 + m21 * g.a22;
    Pack b1 = m12 * g.a11 + m22 * g.a12, b2 = m12 * g.a12 + m22 * g.a22;
    PackTensor c = {m11 * a1 + m21 * a2, m12 * b1 + m22 * b2, m11 * b1 + m21 * b2};
    return c;
}

/* Second Piola-Kirchhoff stress to natural directions: weight x M S M^T. */
ALWAYS_INLINE PackTensor natural_directions(const double *point, PackTensor s)
{
    Pack m11 = lane_values(point, GEOMETRY_M11), m12 = lane_values(point, GEOMETRY_M12),
         m21 = lane_values(point, GEOMETRY_M21), m22 = lane_values(point, GEOMETRY_M22),
         weight = lane_values(point, GEOMETRY_WEIGHT);
    Pack s11 = weight * s.a11, s22 = weight * s.a22, s12 = weight * s.a12;
    Pack a1 = m11 * s11 + m12 * s12, a2 = m11 * s12 + m12 * s22;
    Pack b1 = m21 * s11 + m22 * s12, b2 = m21 * s12 + m22 * s22;
    PackTensor p = {m11 * a1 + m12 * a2, m21 * b1 + m22 * b2, m11 * b1 + m12 * b2};
    return p;
}

/* FORM 0 and 1: the second Piola-Kirchhoff stress from the Biot stress t (eq. F5); the frequency by (E22). major:
 * largest principal stress of the fabric. */
ALWAYS_INLINE PackTensor stress_biot(int mode, const LawInput *in, const PointPlace *place, const BiotState *f,
                                     PackTensor t, Pack major, PointPack *p)
{
    PackTensor s = pull_back_biot(t, f);
    Pack wide = f->wide;
    if (mode & MODE_TENSION_FIELD) {
        /* a slack element may be taut in the next cycle: it has that frequency, at most twice the reference's (eq.
         * E24), or what its liner has */
        Pack slack = pack_smaller(wide, pack_of(4.0));
        if (mode & MODE_LINER) slack = pack_larger(slack, in->law.slack_share * wide);
        wide = pack_where_positive(major, wide, slack);
    }
    /* compression stiffens against rotation in the plane; only the cut-off takes it away */
    Pack bound = mode & MODE_TENSION_FIELD ? major_bound(s) : size_bound(s);
    p->rate = wide * lane_values(place->tail, GEOMETRY_RATE) + bound * lane_values(place->tail, GEOMETRY_STRESS_RATE);
    return s;
}

/* MAT_ELASTIC (eq. F13, F14); the frequency by (E23). */
ALWAYS_INLINE PackTensor stress_logarithmic(const LawInput *in, const PointPlace *place, PointPack *p)
{
    LogarithmicState f = logarithmic_state(p->c);
    PackTensor t = apply_moduli(&in->law.whole, f.strain);
    p->rate = f.wide * (lane_values(place->tail, GEOMETRY_RATE) +
                        pack_larger(major_value(t), pack_of(0.0)) * lane_values(place->tail, GEOMETRY_STRESS_RATE));
    return pull_back(t, p->c, f.jacobian, f.pull);
}

/* FORM 2 (eq. F8 to F12). */
ALWAYS_INLINE PackTensor stress_green(int mode, const LawInput *in, const PointPlace *place, PointPack *p)
{
    GreenResult r =
        green_stress(&in->law, &in->compliance, mode & MODE_TENSION_FIELD, mode & MODE_LINER, green_strain(p->c));
    p->energy = lane_values(place->point, GEOMETRY_WEIGHT) * r.energy;
    p->rate = major_value(p->c) * lane_values(place->tail, GEOMETRY_RATE) +
              r.tension * lane_values(place->tail, GEOMETRY_STRESS_RATE);
    return r.stress;
}

/* The stress with DAMP 2/omega / dt of the strain rate (eq. E12). */
ALWAYS_INLINE PackTensor add_damping(const LawInput *in, const PointPlace *place, PackTensor change, PackTensor s)
{
    if (!(in->law.damping > 0.0)) return s;
    Pack factor = (in->law.damping * in->inverse_step) * lane_values(place->tail, GEOMETRY_PERIOD);
    PackTensor rate = {factor * change.a11, factor * change.a22, factor * change.a12};
    return add_tensors(s, apply_moduli(&in->law.whole, rate));
}

/* The change of a value that work is counted of, kept for the next step. */
ALWAYS_INLINE Pack change_of(Pack value, double *kept)
{
    Pack change = value - pack_load(kept);
    pack_store(kept, value);
    return change;
}

/* Twice the mean of a stress and the last step's, kept for the next one. */
ALWAYS_INLINE Pack sum_with_last(Pack stress, float *kept)
{
    Pack sum = stress + pack_load_single(kept);
    pack_store_single(kept, stress);
    return sum;
}

/* Share of the stress that acts (eq. F7b). psi: energy of the straight path to the strain; drive: the work that the
 * whole stress would do in this step. */
#define BILLOW_ACCOUNT_HALF 0.5 /* share of psi below which an account limits what comes back */
#define BILLOW_ACCOUNT_WAY 0.1  /* share of psi given or taken until the stress has followed */
ALWAYS_INLINE Pack acting_share(const LawInput *in, double *account, Pack psi, Pack drive)
{
    if (in->new_account) {
        pack_store(account + ACCOUNT_SHARE * LANES, pack_of(1.0));
        return pack_of(1.0);
    }
    Pack last = pack_load(account + ACCOUNT_SHARE * LANES), by_psi = 1.0 / pack_larger(psi, pack_of(BILLOW_TINY));
    Pack allowed = pack_larger(pack_load(account) * by_psi * (1.0 / BILLOW_ACCOUNT_HALF), pack_of(0.0));
    Pack aim = pack_smaller(pack_where_positive(drive, pack_of(1.0), allowed), pack_of(1.0));
    Pack way = pack_smaller(pack_absolute(drive) * by_psi * (1.0 / BILLOW_ACCOUNT_WAY), pack_of(1.0));
    Pack share = last + way * (aim - last);
    pack_store(account + ACCOUNT_SHARE * LANES, share);
    return share;
}

/* work: of the step. */
ALWAYS_INLINE void keep_account(const LawInput *in, double *account, Pack psi, Pack work)
{
    pack_store(account, in->new_account ? psi : pack_load(account) + work);
}

ALWAYS_INLINE PackTensor scale_tensor(Pack factor, PackTensor t)
{
    PackTensor scaled = {factor * t.a11, factor * t.a22, factor * t.a12};
    return scaled;
}

/* An element of one point: damping and the stress-work ledger, dW = (S_n + S_n+1)/2 : (E_n+1 - E_n), 2 dE = dC (eq. E12
 * to E14). */
ALWAYS_INLINE PackTensor keep_history(int mode, bool energy_is_work, const LawInput *in, const PointPlace *place,
                                      PackTensor s, PointPack *p)
{
    PackTensor change = {change_of(p->c.a11, place->metric), change_of(p->c.a22, place->metric + LANES),
                         change_of(p->c.a12, place->metric + 2 * LANES)};
    Pack weight = lane_values(place->point, GEOMETRY_WEIGHT), psi = pack_of(0.0);
    if (mode & MODE_ACCOUNT) {
        psi = 0.25 * weight * (contract(s, p->c) - (s.a11 + s.a22));
        Pack drive = 0.5 * weight * contract(s, change);
        s = scale_tensor(acting_share(in, place->account, psi, drive), s);
    }
    s = add_damping(in, place, change, s);
    PackTensor sum = {sum_with_last(s.a11, place->stress), sum_with_last(s.a22, place->stress + LANES),
                      sum_with_last(s.a12, place->stress + 2 * LANES)};
    Pack work = (0.25 * in->count_work) * weight * contract(sum, change);
    if (mode & MODE_ACCOUNT) keep_account(in, place->account, psi, work);
    if (energy_is_work)
        p->energy = work;
    else
        p->viscous = work; /* less the stored energy's change this is what was dissipated */
    return s;
}

/* What the history adds to the stress of a point. */
ALWAYS_INLINE PackTensor with_history(int mode, bool one_point, bool energy_is_work, const LawInput *in,
                                      const PointPlace *place, PackTensor s, PointPack *p)
{
    if (one_point) return keep_history(mode, energy_is_work, in, place, s, p);
    if (mode & MODE_ACCOUNT) p->trace = lane_values(place->point, GEOMETRY_WEIGHT) * (s.a11 + s.a22);
    return add_damping(in, place, p->change, s);
}

/* FORM 0 and 1 (eq. F1 to F7) from C to the natural stress: a stage for each root. count: known where this is
 * inlined. */
ALWAYS_INLINE void natural_stress_biot(int mode, bool one_point, const LawInput *in, int count, const PointPlace *place,
                                       PointPack *restrict p)
{
    BiotState state[STREAMS];
    PackTensor t[STREAMS];
    Pack square[STREAMS], root[STREAMS], jacobian[STREAMS], by_jacobian[STREAMS], major;
    int whole = (count + PACKS_TOGETHER - 1) / PACKS_TOGETHER * PACKS_TOGETHER;
    for (int i = count; i < whole; i++) square[i] = pack_of(1.0);
#pragma GCC unroll 4
    for (int i = 0; i < count; i++) square[i] = biot_determinant(p[i].c);
    pack_reciprocal_roots(whole, square, by_jacobian);
#pragma GCC unroll 4
    for (int i = 0; i < count; i++) {
        jacobian[i] = square[i] * by_jacobian[i];
        square[i] = biot_trace(p[i].c) + 2.0 * jacobian[i];
    }
    pack_reciprocal_roots(whole, square, root);
#pragma GCC unroll 4
    for (int i = 0; i < count; i++) {
        state[i] = biot_state_from(p[i].c, jacobian[i], by_jacobian[i], root[i]);
        t[i] = biot_elastic(&in->law.fabric, state[i].stretch);
        if (mode & MODE_TENSION_FIELD) square[i] = radius_square(t[i]);
    }
    if (mode & MODE_TENSION_FIELD) pack_reciprocal_roots(whole, square, root);
#pragma GCC unroll 4
    for (int i = 0; i < count; i++) {
        if (mode & MODE_TENSION_FIELD)
            t[i] = remove_compression(t[i], square[i], root[i], &major);
        else
            major = pack_of(0.0);
        if (mode & MODE_LINER) t[i] = add_tensors(t[i], biot_elastic(&in->law.liner, state[i].stretch));
        PackTensor s = stress_biot(mode, in, &place[i], &state[i], t[i], major, &p[i]);
        p[i].viscous = pack_of(0.0);
        if (mode & MODE_HISTORY) s = with_history(mode, one_point, true, in, &place[i], s, &p[i]);
        p[i].p = natural_directions(place[i].point, s);
    }
}

/* From C to the natural stress of count packs of points. one_point: of elements with one point, which keep its history;
 * quad_work keeps that of four. */
ALWAYS_INLINE void natural_stress(int mode, bool one_point, const LawInput *in, int count, const PointPlace *place,
                                  PointPack *restrict p)
{
    if (mode & MODE_BIOT) {
        natural_stress_biot(mode, one_point, in, count, place, p);
        return;
    }
    for (int i = 0; i < count; i++) {
        p[i].viscous = pack_of(0.0);
        PackTensor s = mode & MODE_LOGARITHMIC ? stress_logarithmic(in, &place[i], &p[i])
                                               : stress_green(mode, in, &place[i], &p[i]);
        if (mode & MODE_HISTORY) s = with_history(mode, one_point, mode & MODE_LOGARITHMIC, in, &place[i], s, &p[i]);
        p[i].p = natural_directions(place[i].point, s);
    }
}

#endif
