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

/* What a law returns at a point. */
typedef struct PointResult {
    Tensor2 stress; /* second Piola-Kirchhoff */
    double energy;  /* density per reference volume, laws with a stored energy only */
    double stretch; /* factor on the squared frequency of the reference state (eq. E21, E22) */
    double tension; /* largest principal stress, not below 0, times the stretch factor where it acts on it */
} PointResult;

/* The vector loops need every call dissolved. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))

#define BILLOW_TINY 1e-300
/* Squared stretches are kept above this: an element folded to less than 1e-6 of its width pushes no harder. */
#define BILLOW_LEAST_SQUARED_STRETCH 1e-12

ALWAYS_INLINE double larger(double a, double b) { return a > b ? a : b; }
ALWAYS_INLINE double smaller(double a, double b) { return a < b ? a : b; }

/* Natural logarithm of a normal positive number, to 1 ulp, in operations that vectorise. x = 2^k m, m in
 * [sqrt(1/2), sqrt(2)), log m = 2 atanh((m - 1)/(m + 1)); the polynomial is Chebyshev's on that range. */
ALWAYS_INLINE double log_lane(double x)
{
    const double c0 = 0.666666666666667, c1 = 0.39999999999878855, c2 = 0.28571428630292806, c3 = 0.22222210753758562,
                 c4 = 0.18182908682787055, c5 = 0.15331129900213797, c6 = 0.14624176245198378;
    uint64_t bits, shifted, mantissa, count;
    memcpy(&bits, &x, sizeof bits);
    shifted = bits - 0x3FE6A09E667F3BCDu + (1024ull << 52);
    count = shifted >> 52;
    mantissa = bits - (count << 52) + (1024ull << 52);
    uint64_t biased = count | 0x4330000000000000u; /* 2^52 + count as a double */
    double m, k;
    memcpy(&m, &mantissa, sizeof m);
    memcpy(&k, &biased, sizeof k);
    k -= 4503599627370496.0 + 1024.0;
    double f = m - 1.0, s = f / (m + 1.0), u = s * s;
    double p = c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * (c5 + u * c6)))));
    return k * 0.6931471805599453 + (2.0 * s + s * u * p);
}

ALWAYS_INLINE Tensor2 apply_moduli(const PlaneModuli *d, Tensor2 e)
{
    Tensor2 s = {d->d11 * e.a11 + d->d12 * e.a22, d->d12 * e.a11 + d->d22 * e.a22, 2.0 * d->d33 * e.a12};
    return s;
}

ALWAYS_INLINE double contract(Tensor2 a, Tensor2 b) { return a.a11 * b.a11 + a.a22 * b.a22 + 2.0 * a.a12 * b.a12; }

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

/* Plane-stress compliance of the wrinkling law: a(theta) = n.n:C:n.n = b0 + b1 cos 2theta + b2 cos^2 2theta (eq. F9). */
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
 * e(theta)^2 / a(theta); that direction by a fixed number of safeguarded Newton steps from the principal direction of the
 * strain, so that every lane does the same work. */
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
ALWAYS_INLINE PointResult green_point(const FabricLaw *law, const Compliance *b, bool field, bool liner,
                                      Tensor2 c)
{
    PointResult result;
    Tensor2 e = green_strain(c);
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
    result.stretch = major_stretch_squared(c);
    result.tension = larger(major, 0.0);
    return result;
}

/* FORM 0, 1 and MAT_ELASTIC: Cauchy stress t = D : ln U on the constant thickness, S = J U^-1 t U^-1 (eq. F1 to F4). */
ALWAYS_INLINE PointResult logarithmic_point(const FabricLaw *law, bool field, bool liner, Tensor2 c)
{
    PointResult result;
    double half = 0.5 * (c.a11 - c.a22), mean = 0.5 * (c.a11 + c.a22);
    double radius = sqrt(half * half + c.a12 * c.a12);
    double c1 = larger(mean + radius, BILLOW_LEAST_SQUARED_STRETCH), det = c.a11 * c.a22 - c.a12 * c.a12;
    double c2 = larger(det / c1, BILLOW_LEAST_SQUARED_STRETCH);
    double l1 = 0.5 * log_lane(c1), l2 = 0.5 * log_lane(c2);
    double scale = 0.5 * (l1 - l2) / (radius + BILLOW_TINY), centre = 0.5 * (l1 + l2);
    Tensor2 e = {centre + scale * half, centre - scale * half, scale * c.a12};
    Tensor2 t = apply_moduli(&law->fabric, e);
    double major = 0.0;
    if (field) {
        t = remove_compression(t, &major);
    } else {
        major = 0.5 * (t.a11 + t.a22) + sqrt(0.25 * (t.a11 - t.a22) * (t.a11 - t.a22) + t.a12 * t.a12);
    }
    int slack = field && major <= 0.0;
    if (liner) {
        Tensor2 more = apply_moduli(&law->liner, e);
        t.a11 += more.a11;
        t.a22 += more.a22;
        t.a12 += more.a12;
        major += larger(more.a11, 0.0) + larger(more.a22, 0.0) + fabs(more.a12);
    }
    double jacobian = sqrt(c1 * c2), inverse = 1.0 / (jacobian * sqrt(2.0 * mean + 2.0 * jacobian));
    /* U^-1 = (tr U 1 - U) / J with U = (C + J 1) / sqrt(tr C + 2 J) */
    Tensor2 u = {(c.a22 + jacobian) * inverse, (c.a11 + jacobian) * inverse, -c.a12 * inverse};
    double w11 = t.a11 * u.a11 + t.a12 * u.a12, w12 = t.a11 * u.a12 + t.a12 * u.a22;
    double w21 = t.a12 * u.a11 + t.a22 * u.a12, w22 = t.a12 * u.a12 + t.a22 * u.a22;
    result.stress.a11 = jacobian * (u.a11 * w11 + u.a12 * w21);
    result.stress.a22 = jacobian * (u.a12 * w12 + u.a22 * w22);
    result.stress.a12 = jacobian * (u.a11 * w12 + u.a12 * w22);
    result.energy = 0.0;
    /* a slack element keeps its reference frequency, or what its liner has: it may be taut in the next cycle */
    double stretch = c1 / jacobian;
    result.stretch = slack ? larger(1.0, law->slack_share * stretch) : stretch;
    result.tension = larger(major, 0.0) * (c1 / jacobian);
    return result;
}

#endif
