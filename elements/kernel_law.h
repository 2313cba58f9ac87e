/* Point functions of the membrane laws: metric in, second Piola-Kirchhoff stress out (docs/theory.md, Fabric).
 * Inline and branch-free: each is one lane of a vector loop. Tensors are (11, 22, 12) in material axes. */
#ifndef BILLOW_KERNEL_LAW_H
#define BILLOW_KERNEL_LAW_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "elements/law.h"

typedef struct Tensor2 {
    double a11, a22, a12;
} Tensor2;

/* What the Green law returns at a point. */
typedef struct GreenResult {
    Tensor2 stress; /* second Piola-Kirchhoff */
    double energy;  /* density per reference volume */
    double tension; /* largest principal stress, not below 0 */
} GreenResult;

/* The vector loops need every call dissolved. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))

#define BILLOW_TINY 1e-150
/* Squared stretches are kept above this: an element folded to less than 1e-6 of its width pushes no harder. */
#define BILLOW_LEAST_SQUARED_STRETCH 1e-12

ALWAYS_INLINE double larger(double a, double b)
{
    return a > b ? a : b;
}
ALWAYS_INLINE double smaller(double a, double b)
{
    return a < b ? a : b;
}

#define BILLOW_LOG2 0.6931471805599453

/* x = 2^k m with m in [sqrt(1/2), sqrt(2)), in operations that vectorise. x: normal and positive. */
ALWAYS_INLINE void split_lane(double x, double *m, double *k)
{
    uint64_t bits, shifted, mantissa, count;
    memcpy(&bits, &x, sizeof bits);
    shifted = bits - 0x3FE6A09E667F3BCDu + (1024ull << 52);
    count = shifted >> 52;
    mantissa = bits - (count << 52) + (1024ull << 52);
    uint64_t biased = count | 0x4330000000000000u; /* 2^52 + count as a double */
    memcpy(m, &mantissa, sizeof *m);
    memcpy(k, &biased, sizeof *k);
    *k -= 4503599627370496.0 + 1024.0;
}

/* 2 atanh(s) for |s| <= (sqrt(2) - 1)/(sqrt(2) + 1): Chebyshev's polynomial, error below 1e-17. */
ALWAYS_INLINE double log_series(double s)
{
    const double c0 = 0.666666666666667, c1 = 0.39999999999878855, c2 = 0.28571428630292806, c3 = 0.22222210753758562,
                 c4 = 0.18182908682787055, c5 = 0.15331129900213797, c6 = 0.14624176245198378;
    double u = s * s, uu = u * u;
    double p = (c0 + u * c1) + uu * ((c2 + u * c3) + uu * ((c4 + u * c5) + uu * c6));
    return 2.0 * s + s * u * p;
}

ALWAYS_INLINE Tensor2 apply_moduli(const PlaneModuli *d, Tensor2 e)
{
    Tensor2 s = {d->d11 * e.a11 + d->d12 * e.a22, d->d12 * e.a11 + d->d22 * e.a22, 2.0 * d->d33 * e.a12};
    return s;
}

ALWAYS_INLINE double contract(Tensor2 a, Tensor2 b)
{
    return a.a11 * b.a11 + a.a22 * b.a22 + 2.0 * a.a12 * b.a12;
}

/* Removes negative principal values: the projection of t onto the tensile cone (eq. F7). *major receives the largest
 * principal value before. */
ALWAYS_INLINE Tensor2 remove_compression(Tensor2 t, double *major)
{
    double mean = 0.5 * (t.a11 + t.a22), half = 0.5 * (t.a11 - t.a22);
    double radius = sqrt(half * half + t.a12 * t.a12);
    double upper = larger(mean + radius, 0.0), lower = larger(mean - radius, 0.0);
    double scale = 0.5 * (upper - lower) / (radius + BILLOW_TINY), centre = 0.5 * (upper + lower);
    Tensor2 kept = {centre + scale * half, centre - scale * half, scale * t.a12};
    *major = mean + radius;
    int taut = mean - radius >= 0.0; /* nothing to remove: keep the very bits */
    kept.a11 = taut ? t.a11 : kept.a11;
    kept.a22 = taut ? t.a22 : kept.a22;
    kept.a12 = taut ? t.a12 : kept.a12;
    return kept;
}

/* Plane-stress compliance of the wrinkling law: a(theta) = n.n:C:n.n = b0 + b1 cos 2theta + b2 cos^2 2theta (eq. F9).
 */
typedef struct Compliance {
    double b0, b1, b2;
} Compliance;

ALWAYS_INLINE Compliance make_compliance(const PlaneModuli *d)
{
    double det = d->d11 * d->d22 - d->d12 * d->d12;
    double s11 = d->d22 / det, s22 = d->d11 / det, s12 = -d->d12 / det, s66 = 1.0 / d->d33;
    Compliance c = {0.25 * (s11 + s22 + 2.0 * s12 + s66), 0.5 * (s11 - s22), 0.25 * (s11 + s22 - 2.0 * s12 - s66)};
    return c;
}

/* Tension field (eq. F8 to F11): the stress that minimises the energy over all wrinkle strains. Taut where D : e has no
 * negative principal value, slack where e has no positive one, else uniaxial along the direction that maximises
 * e(theta)^2 / a(theta); that direction by a fixed number of safeguarded Newton steps from the principal direction of
 * the strain, so that every lane does the same work. */
ALWAYS_INLINE Tensor2 relax_compression(const PlaneModuli *d, const Compliance *b, Tensor2 e, double *major)
{
    enum { STEPS = 7 };
    Tensor2 t = apply_moduli(d, e);
    double mean = 0.5 * (t.a11 + t.a22), half = 0.5 * (t.a11 - t.a22);
    double radius = sqrt(half * half + t.a12 * t.a12);
    double p = 0.5 * (e.a11 + e.a22), q = 0.5 * (e.a11 - e.a22), r = e.a12;
    double spread = sqrt(q * q + r * r) + BILLOW_TINY;
    double c = (q + BILLOW_TINY) / spread, s = r / spread;
#pragma GCC unroll 8
    for (int i = 0; i < STEPS; i++) {
        double along = p + q * c + r * s, slope = r * c - q * s, bend = -(q * c + r * s);
        double a = b->b0 + c * (b->b1 + b->b2 * c), a1 = -s * (b->b1 + 2.0 * b->b2 * c),
               a2 = -b->b1 * c - 2.0 * b->b2 * (c * c - s * s);
        double g = 2.0 * slope * a - along * a1, dg = 2.0 * bend * a + slope * a1 - along * a2;
        double newton = -g / (dg < 0.0 ? dg : -BILLOW_TINY);
        double step = dg < 0.0 ? newton : (g >= 0.0 ? 0.4 : -0.4);
        step = larger(smaller(step, 0.4), -0.4);
        double length = 1.0 / sqrt(1.0 + step * step), turned = (c - s * step) * length;
        s = (s + c * step) * length;
        c = turned;
    }
    double along = p + q * c + r * s, a = b->b0 + c * (b->b1 + b->b2 * c);
    double uniaxial = larger(along, 0.0) / a;
    int taut = mean - radius >= 0.0, slack = p + spread <= 0.0;
    double pull = slack ? 0.0 : uniaxial;
    Tensor2 kept = {0.5 * pull * (1.0 + c), 0.5 * pull * (1.0 - c), 0.5 * pull * s};
    kept.a11 = taut ? t.a11 : kept.a11;
    kept.a22 = taut ? t.a22 : kept.a22;
    kept.a12 = taut ? t.a12 : kept.a12;
    *major = taut ? mean + radius : pull;
    return kept;
}

ALWAYS_INLINE Tensor2 green_strain(Tensor2 c)
{
    Tensor2 e = {0.5 * (c.a11 - 1.0), 0.5 * (c.a22 - 1.0), 0.5 * c.a12};
    return e;
}

ALWAYS_INLINE double major_stretch_squared(Tensor2 c)
{
    double half = 0.5 * (c.a11 - c.a22);
    return 0.5 * (c.a11 + c.a22) + sqrt(half * half + c.a12 * c.a12);
}

/* FORM 2: S = D : E with the tension field and the liner (eq. F5). */
ALWAYS_INLINE GreenResult green_stress(const FabricLaw *law, const Compliance *b, bool field, bool liner, Tensor2 e)
{
    GreenResult result;
    double major;
    if (field) {
        result.stress = relax_compression(&law->fabric, b, e, &major);
    } else {
        result.stress = apply_moduli(&law->fabric, e);
        major = 0.5 * (result.stress.a11 + result.stress.a22) +
                sqrt(0.25 * (result.stress.a11 - result.stress.a22) * (result.stress.a11 - result.stress.a22) +
                     result.stress.a12 * result.stress.a12);
    }
    if (liner) {
        Tensor2 t = apply_moduli(&law->liner, e);
        result.stress.a11 += t.a11;
        result.stress.a22 += t.a22;
        result.stress.a12 += t.a12;
        major += larger(t.a11, 0.0) + larger(t.a22, 0.0) + fabs(t.a12);
    }
    result.energy = 0.5 * contract(result.stress, e);
    result.tension = larger(major, 0.0);
    return result;
}

/* Logarithms of two normal positive numbers with one division: see log_lane. */
ALWAYS_INLINE void log_pair(double x, double y, double *log_x, double *log_y)
{
    double mx, kx, my, ky;
    split_lane(x, &mx, &kx);
    split_lane(y, &my, &ky);
    double fx = mx - 1.0, fy = my - 1.0, px = mx + 1.0, py = my + 1.0, inverse = 1.0 / (px * py);
    *log_x = kx * BILLOW_LOG2 + log_series(fx * py * inverse);
    *log_y = ky * BILLOW_LOG2 + log_series(fy * px * inverse);
}

/* The principal frame of C and the stretches, FORM 0, 1 and MAT_ELASTIC, first stage. Double angle (c, s). */
typedef struct StretchFrame {
    double cosine, sine; /* of twice the angle of the major direction */
    double c1, c2;       /* squared principal stretches, c1 >= c2 */
    double narrow, wide; /* l2/l1 and l1/l2 */
} StretchFrame;

ALWAYS_INLINE StretchFrame stretch_frame(Tensor2 c)
{
    StretchFrame f;
    double half = 0.5 * (c.a11 - c.a22), mean = 0.5 * (c.a11 + c.a22);
    double radius = sqrt(half * half + c.a12 * c.a12) + BILLOW_TINY;
    f.c1 = larger(mean + radius, BILLOW_LEAST_SQUARED_STRETCH);
    double det = larger(c.a11 * c.a22 - c.a12 * c.a12, BILLOW_LEAST_SQUARED_STRETCH * f.c1);
    double inverse = 1.0 / (f.c1 * det * radius); /* one division for three */
    double by_c1 = det * radius * inverse, by_det = f.c1 * radius * inverse, by_radius = f.c1 * det * inverse;
    f.cosine = (half + BILLOW_TINY) * by_radius;
    f.sine = c.a12 * by_radius;
    f.c2 = det * by_c1;
    double jacobian = sqrt(det);
    f.narrow = jacobian * by_c1;
    f.wide = f.c1 * jacobian * by_det;
    return f;
}

/* Second stage: the logarithmic strain in material axes (eq. F1). */
ALWAYS_INLINE Tensor2 logarithmic_strain(double cosine, double sine, double c1, double c2)
{
    double l1, l2;
    log_pair(c1, c2, &l1, &l2);
    double centre = 0.25 * (l1 + l2), spread = 0.25 * (l1 - l2);
    Tensor2 e = {centre + spread * cosine, centre - spread * cosine, spread * sine};
    return e;
}

/* Third stage: Cauchy stress t = D : ln U with the tension field and the liner (eq. F4 to F7). *major: largest
 * principal stress; *slack: 1 where the fabric carries nothing, else 0. */
ALWAYS_INLINE Tensor2 logarithmic_stress(const FabricLaw *law, bool field, bool liner, Tensor2 e, double *major,
                                         double *slack)
{
    Tensor2 t = apply_moduli(&law->fabric, e);
    if (field) {
        t = remove_compression(t, major);
    } else {
        double half = 0.5 * (t.a11 - t.a22);
        *major = 0.5 * (t.a11 + t.a22) + sqrt(half * half + t.a12 * t.a12);
    }
    *slack = field && *major <= 0.0 ? 1.0 : 0.0;
    if (liner) {
        Tensor2 more = apply_moduli(&law->liner, e);
        t.a11 += more.a11;
        t.a22 += more.a22;
        t.a12 += more.a12;
        *major += larger(more.a11, 0.0) + larger(more.a22, 0.0) + fabs(more.a12);
        if (field) { /* a sheet without any direction in tension is slack, its liner too (eq. F7a) */
            double half = 0.5 * (t.a11 - t.a22);
            int loose = 0.5 * (t.a11 + t.a22) + sqrt(half * half + t.a12 * t.a12) <= 0.0;
            t.a11 = loose ? 0.0 : t.a11;
            t.a22 = loose ? 0.0 : t.a22;
            t.a12 = loose ? 0.0 : t.a12;
        }
    }
    return t;
}

/* Fourth stage: S = J U^-1 t U^-1 on the constant thickness; in the principal axes of C: S11 = t11 l2/l1,
 * S22 = t22 l1/l2, S12 = t12 (eq. F4). */
ALWAYS_INLINE Tensor2 pull_back(Tensor2 t, double cosine, double sine, double narrow, double wide)
{
    double t_mean = 0.5 * (t.a11 + t.a22), t_half = 0.5 * (t.a11 - t.a22);
    double along = t_half * cosine + t.a12 * sine, across = t.a12 * cosine - t_half * sine;
    double s1 = (t_mean + along) * narrow, s2 = (t_mean - along) * wide;
    double s_mean = 0.5 * (s1 + s2), s_half = 0.5 * (s1 - s2);
    double turned = s_half * cosine - across * sine;
    Tensor2 s = {s_mean + turned, s_mean - turned, s_half * sine + across * cosine};
    return s;
}

#endif
