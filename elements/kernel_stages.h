/* Stages of the element kernels over one block: metric -> stress in natural directions, forces -> corner records.
 *
 * Every stage is a vector loop of its own over the block's lanes: the roots and divisions of one lane wait for each
 * other, short loops let the processor work on several lanes' at a time. Included by elements/kernels.c alone. */
#ifndef BILLOW_KERNEL_STAGES_H
#define BILLOW_KERNEL_STAGES_H

#include "elements/kernel_law.h"
#include "elements/kernels.h"

enum { LANES = BILLOW_LANES };

typedef double Lane[LANES];

/* Law constants of one call. */
typedef struct LawInput {
    FabricLaw law;
    Compliance compliance;
    double inverse_step;
    double count_work; /* 1, or 0 when histories are only filled */
} LawInput;

/* What a kernel does besides the law; a constant of each vector loop, so that the loop has no branch. */
enum {
    MODE_LOGARITHMIC = 1, /* else Green */
    MODE_TENSION_FIELD = 2,
    MODE_LINER = 4,
    MODE_HISTORY = 8, /* strain and stress of the last step are kept: stress-work ledger, damping */
};

/* Metric of a point in natural directions, and the stress that answers it: weight x M S M^T. */
typedef struct PointLanes {
    Lane g11, g22, g12;
    Lane c11, c22, c12; /* right Cauchy-Green tensor in material axes */
    Lane s11, s22, s12; /* second Piola-Kirchhoff stress */
    Lane p11, p22, p12; /* weight x M S M^T */
    Lane energy, viscous, rate;
} PointLanes;

/* C = M^T g M (eq. E4). */
ALWAYS_INLINE void stage_metric(const double *restrict point, PointLanes *restrict p)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double m11 = point[GEOMETRY_M11 * LANES + l], m12 = point[GEOMETRY_M12 * LANES + l],
               m21 = point[GEOMETRY_M21 * LANES + l], m22 = point[GEOMETRY_M22 * LANES + l];
        double g11 = p->g11[l], g22 = p->g22[l], g12 = p->g12[l];
        double a1 = m11 * g11 + m21 * g12, a2 = m11 * g12 + m21 * g22;
        double b1 = m12 * g11 + m22 * g12, b2 = m12 * g12 + m22 * g22;
        p->c11[l] = m11 * a1 + m21 * a2;
        p->c22[l] = m12 * b1 + m22 * b2;
        p->c12[l] = m11 * b1 + m21 * b2;
    }
}

/* FORM 0, 1 and MAT_ELASTIC (eq. F1 to F7). */
ALWAYS_INLINE void stage_logarithmic(int mode, const LawInput *in, const double *restrict tail, PointLanes *restrict p)
{
    Lane cosine, sine, c1, c2, narrow, wide, t11, t22, t12;
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        Tensor2 c = {p->c11[l], p->c22[l], p->c12[l]};
        StretchFrame f = stretch_frame(c);
        cosine[l] = f.cosine;
        sine[l] = f.sine;
        c1[l] = f.c1;
        c2[l] = f.c2;
        narrow[l] = f.narrow;
        wide[l] = f.wide;
    }
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        Tensor2 e = logarithmic_strain(cosine[l], sine[l], c1[l], c2[l]);
        t11[l] = e.a11;
        t22[l] = e.a22;
        t12[l] = e.a12;
    }
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        Tensor2 e = {t11[l], t22[l], t12[l]};
        double major, slack;
        Tensor2 t = logarithmic_stress(&in->law, mode & MODE_TENSION_FIELD, mode & MODE_LINER, e, &major, &slack);
        /* a slack element keeps its reference frequency, or what its liner has: it may be taut in the next cycle */
        double stretch = slack > 0.0 ? larger(1.0, in->law.slack_share * wide[l]) : wide[l];
        p->rate[l] = stretch * tail[GEOMETRY_RATE * LANES + l] +
                     larger(major, 0.0) * wide[l] * tail[GEOMETRY_STRESS_RATE * LANES + l];
        Tensor2 s = pull_back(t, cosine[l], sine[l], narrow[l], wide[l]);
        p->s11[l] = s.a11;
        p->s22[l] = s.a22;
        p->s12[l] = s.a12;
    }
}

/* FORM 2 (eq. F5, F8 to F11). */
ALWAYS_INLINE void stage_green(int mode, const LawInput *in, const double *restrict point, const double *restrict tail,
                               PointLanes *restrict p)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        Tensor2 c = {p->c11[l], p->c22[l], p->c12[l]};
        GreenResult r =
            green_stress(&in->law, &in->compliance, mode & MODE_TENSION_FIELD, mode & MODE_LINER, green_strain(c));
        p->s11[l] = r.stress.a11;
        p->s22[l] = r.stress.a22;
        p->s12[l] = r.stress.a12;
        p->energy[l] = point[GEOMETRY_WEIGHT * LANES + l] * r.energy;
        p->rate[l] = major_stretch_squared(c) * tail[GEOMETRY_RATE * LANES + l] +
                     r.tension * tail[GEOMETRY_STRESS_RATE * LANES + l];
    }
}

/* Damping and the stress-work ledger: dW = (S_n + S_n+1)/2 : (E_n+1 - E_n) (eq. E12 to E14). */
ALWAYS_INLINE void stage_history(int mode, const LawInput *in, const double *restrict point,
                                 const double *restrict tail, double *restrict history, PointLanes *restrict p)
{
    if (in->law.damping > 0.0) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            Tensor2 c = {p->c11[l], p->c22[l], p->c12[l]}, e = green_strain(c);
            double factor = tail[GEOMETRY_VISCOSITY * LANES + l] * in->inverse_step;
            Tensor2 rate = {factor * (e.a11 - history[0 * LANES + l]), factor * (e.a22 - history[1 * LANES + l]),
                            factor * (e.a12 - history[2 * LANES + l])};
            Tensor2 viscous = apply_moduli(&in->law.whole, rate);
            p->s11[l] += viscous.a11;
            p->s22[l] += viscous.a22;
            p->s12[l] += viscous.a12;
        }
    }
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        Tensor2 c = {p->c11[l], p->c22[l], p->c12[l]}, e = green_strain(c);
        Tensor2 de = {e.a11 - history[0 * LANES + l], e.a22 - history[1 * LANES + l], e.a12 - history[2 * LANES + l]};
        Tensor2 mean = {0.5 * (p->s11[l] + history[3 * LANES + l]), 0.5 * (p->s22[l] + history[4 * LANES + l]),
                        0.5 * (p->s12[l] + history[5 * LANES + l])};
        double work = in->count_work * (point[GEOMETRY_WEIGHT * LANES + l] * contract(mean, de));
        if (mode & MODE_LOGARITHMIC) {
            p->energy[l] = work;
        } else {
            p->viscous[l] = work; /* less the stored energy's change this is what was dissipated */
        }
        history[0 * LANES + l] = e.a11;
        history[1 * LANES + l] = e.a22;
        history[2 * LANES + l] = e.a12;
        history[3 * LANES + l] = p->s11[l];
        history[4 * LANES + l] = p->s22[l];
        history[5 * LANES + l] = p->s12[l];
    }
}

/* From C to the natural stress of one point in all lanes. */
ALWAYS_INLINE void natural_stress(int mode, const LawInput *in, const double *restrict point,
                                  const double *restrict tail, double *restrict history, PointLanes *restrict p)
{
    if (mode & MODE_LOGARITHMIC)
        stage_logarithmic(mode, in, tail, p);
    else
        stage_green(mode, in, point, tail, p);
    if (mode & MODE_HISTORY) stage_history(mode, in, point, tail, history, p);
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double m11 = point[GEOMETRY_M11 * LANES + l], m12 = point[GEOMETRY_M12 * LANES + l],
               m21 = point[GEOMETRY_M21 * LANES + l], m22 = point[GEOMETRY_M22 * LANES + l],
               weight = point[GEOMETRY_WEIGHT * LANES + l];
        double s11 = weight * p->s11[l], s22 = weight * p->s22[l], s12 = weight * p->s12[l];
        double a1 = m11 * s11 + m12 * s12, a2 = m11 * s12 + m12 * s22;
        double b1 = m21 * s11 + m22 * s12, b2 = m21 * s12 + m22 * s22;
        p->p11[l] = m11 * a1 + m12 * a2;
        p->p22[l] = m21 * b1 + m22 * b2;
        p->p12[l] = m11 * b1 + m12 * b2;
    }
}

#endif
