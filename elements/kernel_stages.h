/* Stages of the element kernels: metric -> stress in natural directions, for several packs of points at a time.
 *
 * Each stage is a loop of its own over the packs: the roots and divisions of one pack wait for each other, so that the
 * processor needs several packs' at a time. Included by elements/kernels.c alone. */
#ifndef BILLOW_KERNEL_STAGES_H
#define BILLOW_KERNEL_STAGES_H

#include "elements/kernel_law.h"
#include "elements/kernels.h"

enum { LANES = BILLOW_LANES, PACKS = BILLOW_LANES / PACK_WIDTH };

/* Law constants of one call. */
typedef struct LawInput {
    FabricLaw law;
    Compliance compliance;
    double inverse_step;
    double count_work; /* 1, or 0 when histories are only filled */
} LawInput;

/* What a kernel does besides the law; a constant of each kernel, so that its loops have no branch. */
enum {
    MODE_BIOT = 1,
    MODE_TENSION_FIELD = 2,
    MODE_LINER = 4,
    MODE_HISTORY = 8,      /* strain and stress of the last step are kept: stress-work ledger, damping */
    MODE_LOGARITHMIC = 16, /* with MODE_BIOT neither: Green */
};

/* Where the constants and histories of one pack of points lie. */
typedef struct PointPlace {
    const double *point, *tail; /* elements/kernels.h */
    double *history;
} PointPlace;

/* A pack of points: what comes in and what the stages leave. */
typedef struct PointPack {
    PackTensor c; /* right Cauchy-Green tensor in material axes */
    PackTensor p; /* weight x M S M^T, the stress in natural directions */
    Pack energy, viscous, rate;
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

/* FORM 0 and 1 (eq. F1 to F7); the frequency by (E22). */
ALWAYS_INLINE PackTensor stress_biot(int mode, const LawInput *in, const PointPlace *place, const BiotState *f,
                                     PointPack *p)
{
    Pack major, shear = (2.0 * in->law.whole.d33) * lane_values(place->tail, GEOMETRY_STRESS_RATE);
    PackTensor s =
        pull_back_biot(biot_stress(&in->law, mode & MODE_TENSION_FIELD, mode & MODE_LINER, f->stretch, &major), f);
    Pack reference = lane_values(place->tail, GEOMETRY_RATE);
    Pack stretched = (1.0 + f->skew) * (reference + f->skew * shear);
    /* a slack element keeps its reference frequency, or what its liner has: it may be taut in the next cycle */
    if (mode & MODE_TENSION_FIELD)
        stretched = pack_where_positive(major, stretched, pack_larger(reference, in->law.slack_share * stretched));
    p->rate = stretched + pack_larger(major_value(s), pack_of(0.0)) * lane_values(place->tail, GEOMETRY_STRESS_RATE);
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

/* Damping and the stress-work ledger: dW = (S_n + S_n+1)/2 : (E_n+1 - E_n) (eq. E12 to E14). */
ALWAYS_INLINE PackTensor keep_history(int mode, const LawInput *in, const PointPlace *place, PackTensor s, PointPack *p)
{
    double *h = place->history;
    PackTensor e = green_strain(p->c);
    PackTensor change = {e.a11 - lane_values(h, 0), e.a22 - lane_values(h, 1), e.a12 - lane_values(h, 2)};
    if (in->law.damping > 0.0) {
        Pack factor = lane_values(place->tail, GEOMETRY_VISCOSITY) * in->inverse_step;
        PackTensor rate = {factor * change.a11, factor * change.a22, factor * change.a12};
        s = add_tensors(s, apply_moduli(&in->law.whole, rate));
    }
    PackTensor mean = {0.5 * (s.a11 + lane_values(h, 3)), 0.5 * (s.a22 + lane_values(h, 4)),
                       0.5 * (s.a12 + lane_values(h, 5))};
    Pack work = in->count_work * (lane_values(place->point, GEOMETRY_WEIGHT) * contract(mean, change));
    if (mode & (MODE_BIOT | MODE_LOGARITHMIC))
        p->energy = work;
    else
        p->viscous = work; /* less the stored energy's change this is what was dissipated */
    const Pack kept[HISTORY_POINT_SIZE] = {e.a11, e.a22, e.a12, s.a11, s.a22, s.a12};
    for (int i = 0; i < HISTORY_POINT_SIZE; i++) pack_store(h + (ptrdiff_t)i * LANES, kept[i]);
    return s;
}

/* From C to the natural stress of count packs of points. */
ALWAYS_INLINE void natural_stress(int mode, const LawInput *in, int count, const PointPlace *place,
                                  PointPack *restrict p)
{
    BiotState state[PACKS > 4 ? PACKS : 4];
    if (mode & MODE_BIOT)
        for (int i = 0; i < count; i++) state[i] = biot_state(p[i].c);
    for (int i = 0; i < count; i++) {
        p[i].viscous = pack_of(0.0);
        PackTensor s = mode & MODE_BIOT          ? stress_biot(mode, in, &place[i], &state[i], &p[i])
                       : mode & MODE_LOGARITHMIC ? stress_logarithmic(in, &place[i], &p[i])
                                                 : stress_green(mode, in, &place[i], &p[i]);
        if (mode & MODE_HISTORY) s = keep_history(mode, in, &place[i], s, &p[i]);
        p[i].p = natural_directions(place[i].point, s);
    }
}

#endif
