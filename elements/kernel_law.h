/* Point functions of the membrane laws: metric in, second Piola-Kirchhoff stress out (docs/theory.md, Fabric).
 * Branch-free, on packs of points. Tensors are (11, 22, 12) in material axes. */
#ifndef BILLOW_KERNEL_LAW_H
#define BILLOW_KERNEL_LAW_H

#include <stdbool.h>

#include "elements/law.h"
#include "elements/pack.h"

typedef struct PackTensor {
    Pack a11, a22, a12;
} PackTensor;

/* What the Green law returns at a point. */
typedef struct GreenResult {
    PackTensor stress; /* second Piola-Kirchhoff */
    Pack energy;       /* density per reference volume */
    Pack tension;      /* largest principal stress, not below 0 */
} GreenResult;

/* Keeps roots and quotients of zero finite; lost in any other number. */
#define BILLOW_TINY 1e-280
/* Squared stretches are kept above this: an element folded to less than 1e-6 of its width pushes no harder. */
#define BILLOW_LEAST_SQUARED_STRETCH 1e-12
/* Squared width to length that FORM 0 and 1 follow a point down to (eq. F1a). */
#define BILLOW_LEAST_SQUARED_ASPECT 2.5e-3

#define BILLOW_LOG2 0.6931471805599453

/* x = 2^k m with m in [sqrt(1/2), sqrt(2)). x: normal and positive. */
ALWAYS_INLINE void split_exponent(Pack x, Pack *m, Pack *k)
{
    PackBits bits = (PackBits)x, shifted = bits - 0x3FE6A09E667F3BCDu + (1024ull << 52), count = shifted >> 52;
    *m = (Pack)(bits - (count << 52) + (1024ull << 52));
    *k = (Pack)(count | 0x4330000000000000u) - (4503599627370496.0 + 1024.0); /* 2^52 + count as a double */
}

/* 2 atanh(s) for |s| <= (sqrt(2) - 1)/(sqrt(2) + 1): Chebyshev's polynomial, error below 1e-17. */
ALWAYS_INLINE Pack log_series(Pack s)
{
    const double c0 = 0.666666666666667, c1 = 0.39999999999878855, c2 = 0.28571428630292806, c3 = 0.22222210753758562,
                 c4 = 0.18182908682787055, c5 = 0.15331129900213797, c6 = 0.14624176245198378;
    Pack u = s * s, uu = u * u;
    Pack p = (c0 + u * c1) + uu * ((c2 + u * c3) + uu * ((c4 + u * c5) + uu * c6));
    return 2.0 * s + s * u * p;
}

ALWAYS_INLINE PackTensor apply_moduli(const PlaneModuli *d, PackTensor e)
{
    PackTensor s = {d->d11 * e.a11 + d->d12 * e.a22, d->d12 * e.a11 + d->d22 * e.a22, (2.0 * d->d33) * e.a12};
    return s;
}

ALWAYS_INLINE PackTensor add_tensors(PackTensor a, PackTensor b)
{
    PackTensor sum = {a.a11 + b.a11, a.a22 + b.a22, a.a12 + b.a12};
    return sum;
}

ALWAYS_INLINE PackTensor tensor_where_positive(Pack x, PackTensor yes, PackTensor no)
{
    PackTensor t = {pack_where_positive(x, yes.a11, no.a11), pack_where_positive(x, yes.a22, no.a22),
                    pack_where_positive(x, yes.a12, no.a12)};
    return t;
}

ALWAYS_INLINE Pack contract(PackTensor a, PackTensor b)
{
    return a.a11 * b.a11 + a.a22 * b.a22 + 2.0 * (a.a12 * b.a12);
}

/* Larger principal value of a tensor. */
ALWAYS_INLINE Pack major_value(PackTensor t)
{
    Pack half = 0.5 * (t.a11 - t.a22);
    return 0.5 * (t.a11 + t.a22) + pack_root(half * half + t.a12 * t.a12);
}

/* A bound of sqrt(a^2 + b^2), at most 8.3 % above it: larger + (sqrt(2) - 1) smaller. */
ALWAYS_INLINE Pack radius_bound(Pack a, Pack b)
{
    Pack u = pack_absolute(a), v = pack_absolute(b), larger = pack_larger(u, v);
    return 0.5857864376269050 * larger + 0.4142135623730951 * (u + v);
}

/* A bound of the larger principal value, not below 0: Gershgorin's circles. */
ALWAYS_INLINE Pack major_bound(PackTensor t)
{
    return pack_larger(pack_larger(t.a11, t.a22) + pack_absolute(t.a12), pack_of(0.0));
}

/* The same for the size of both principal values. */
ALWAYS_INLINE Pack size_bound(PackTensor t)
{
    return pack_larger(pack_absolute(t.a11), pack_absolute(t.a22)) + pack_absolute(t.a12);
}

/* Squared radius of Mohr's circle, not quite 0. */
ALWAYS_INLINE Pack radius_square(PackTensor t)
{
    Pack half = 0.5 * (t.a11 - t.a22);
    return half * half + t.a12 * t.a12 + BILLOW_TINY;
}

/* Removes negative principal values: the projection of t onto the tensile cone (eq. F7). square, by_radius: of Mohr's
 * circle of t. *major receives the largest principal value before. */
ALWAYS_INLINE PackTensor remove_compression(PackTensor t, Pack square, Pack by_radius, Pack *major)
{
    Pack mean = 0.5 * (t.a11 + t.a22), half = 0.5 * (t.a11 - t.a22), radius = square * by_radius;
    Pack pull = 0.5 * pack_larger(mean + radius, pack_of(0.0)), scale = pull * by_radius;
    PackTensor uniaxial = {pull + scale * half, pull - scale * half, scale * t.a12};
    *major = mean + radius;
    return tensor_where_positive(radius - mean, uniaxial, t); /* nothing to remove: keep the very bits */
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

/* One safeguarded Newton step of the direction (c, s) of 2 theta that maximises e(theta)^2 / a(theta). */
ALWAYS_INLINE void turn_direction(const Compliance *b, Pack p, Pack q, Pack r, Pack *c, Pack *s)
{
    Pack along = p + q * *c + r * *s, slope = r * *c - q * *s, bend = -(q * *c + r * *s);
    Pack a = b->b0 + *c * (b->b1 + b->b2 * *c), a1 = -*s * (b->b1 + (2.0 * b->b2) * *c),
         a2 = -b->b1 * *c - (2.0 * b->b2) * (*c * *c - *s * *s);
    Pack g = 2.0 * slope * a - along * a1, curvature = -(2.0 * bend * a + slope * a1 - along * a2);
    Pack newton = g / pack_where_positive(curvature, curvature, pack_of(1.0));
    Pack uphill = pack_where_positive(-g, pack_of(-0.4), pack_of(0.4));
    Pack step = pack_where_positive(curvature, newton, uphill);
    step = pack_larger(pack_smaller(step, pack_of(0.4)), pack_of(-0.4));
    Pack length = pack_reciprocal_root(1.0 + step * step), turned = (*c - *s * step) * length;
    *s = (*s + *c * step) * length;
    *c = turned;
}

/* Tension field (eq. F8 to F11): the stress that minimises the energy over all wrinkle strains. Taut where D : e has no
 * negative principal value, slack where e has no positive one, else uniaxial along the direction that maximises
 * e(theta)^2 / a(theta); that direction by a fixed number of steps from the principal direction of the strain, so that
 * every lane does the same work. */
ALWAYS_INLINE PackTensor relax_compression(const PlaneModuli *d, const Compliance *b, PackTensor e, Pack *major)
{
    enum { STEPS = 7 };
    PackTensor t = apply_moduli(d, e);
    Pack mean = 0.5 * (t.a11 + t.a22), half = 0.5 * (t.a11 - t.a22);
    Pack radius = pack_root(half * half + t.a12 * t.a12);
    Pack p = 0.5 * (e.a11 + e.a22), q = 0.5 * (e.a11 - e.a22), r = e.a12;
    Pack square = q * q + r * r + BILLOW_TINY, by_spread = pack_reciprocal_root(square), spread = square * by_spread;
    Pack c = (q + BILLOW_TINY) * by_spread, s = r * by_spread;
    for (int i = 0; i < STEPS; i++) turn_direction(b, p, q, r, &c, &s);
    Pack along = p + q * c + r * s, a = b->b0 + c * (b->b1 + b->b2 * c);
    Pack pull = pack_where_positive(p + spread, pack_larger(along, pack_of(0.0)) / a, pack_of(0.0));
    PackTensor uniaxial = {0.5 * pull * (1.0 + c), 0.5 * pull * (1.0 - c), 0.5 * pull * s};
    *major = pack_where_positive(radius - mean, pull, mean + radius);
    return tensor_where_positive(radius - mean, uniaxial, t);
}

ALWAYS_INLINE PackTensor green_strain(PackTensor c)
{
    PackTensor e = {0.5 * (c.a11 - 1.0), 0.5 * (c.a22 - 1.0), 0.5 * c.a12};
    return e;
}

/* FORM 2: S = D : E with the tension field and the liner (eq. F12). */
ALWAYS_INLINE GreenResult green_stress(const FabricLaw *law, const Compliance *b, bool field, bool liner, PackTensor e)
{
    GreenResult result;
    Pack major;
    if (field) {
        result.stress = relax_compression(&law->fabric, b, e, &major);
    } else {
        result.stress = apply_moduli(&law->fabric, e);
        major = major_value(result.stress);
    }
    if (liner) {
        PackTensor t = apply_moduli(&law->liner, e);
        result.stress = add_tensors(result.stress, t);
        major += pack_larger(t.a11, pack_of(0.0)) + pack_larger(t.a22, pack_of(0.0)) + pack_absolute(t.a12);
    }
    result.energy = 0.5 * contract(result.stress, e);
    result.tension = pack_larger(major, pack_of(0.0));
    return result;
}

/* What FORM 0 and 1 need of C: the stretch U = sqrt(C) and the way back to the second Piola-Kirchhoff stress. */
typedef struct BiotState {
    PackTensor stretch;       /* U in material axes */
    Pack by_sum, by_jacobian; /* 1/tr U, 1/det U */
    Pack wide;                /* l1/l2 */
} BiotState;

/* tr C and det C, kept away from 0 (eq. F1a). */
ALWAYS_INLINE Pack biot_trace(PackTensor c)
{
    return pack_larger(c.a11 + c.a22, pack_of(BILLOW_LEAST_SQUARED_STRETCH));
}

ALWAYS_INLINE Pack biot_determinant(PackTensor c)
{
    Pack trace = biot_trace(c);
    return pack_larger(c.a11 * c.a22 - c.a12 * c.a12, BILLOW_LEAST_SQUARED_ASPECT * (trace * trace));
}

/* U = (C + J 1)/tr U with tr U = sqrt(tr C + 2 J) (eq. F1): no eigenvectors. jacobian: J. */
ALWAYS_INLINE BiotState biot_state_from(PackTensor c, Pack jacobian, Pack by_jacobian, Pack by_sum)
{
    BiotState f = {.by_sum = by_sum, .by_jacobian = by_jacobian};
    f.stretch.a11 = (c.a11 + jacobian) * by_sum;
    f.stretch.a22 = (c.a22 + jacobian) * by_sum;
    f.stretch.a12 = c.a12 * by_sum;
    f.wide = (0.5 * biot_trace(c) + radius_bound(0.5 * (c.a11 - c.a22), c.a12)) * by_jacobian;
    return f;
}

ALWAYS_INLINE BiotState biot_state(PackTensor c)
{
    Pack det = biot_determinant(c), by_jacobian = pack_reciprocal_root(det), jacobian = det * by_jacobian;
    return biot_state_from(c, jacobian, by_jacobian, pack_reciprocal_root(biot_trace(c) + 2.0 * jacobian));
}

/* Biot stress before the tension field: T = D : (U - 1) (eq. F4). */
ALWAYS_INLINE PackTensor biot_elastic(const PlaneModuli *moduli, PackTensor u)
{
    PackTensor e = {u.a11 - 1.0, u.a22 - 1.0, u.a12};
    return apply_moduli(moduli, e);
}

/* Biot stress T = D : (U - 1), the fabric's share with the compression removed, the liner's as it is (eq. F4, F6, F7).
 * *major: largest principal stress of the fabric. */
ALWAYS_INLINE PackTensor biot_stress(const FabricLaw *law, bool field, bool liner, PackTensor u, Pack *major)
{
    PackTensor t = biot_elastic(&law->fabric, u);
    if (field) {
        Pack square = radius_square(t);
        t = remove_compression(t, square, pack_reciprocal_root(square), major);
    } else {
        *major = major_value(t);
    }
    if (liner) t = add_tensors(t, biot_elastic(&law->liner, u));
    return t;
}

/* The S of 1/2 (S U + U S) = T: S = (2 T - tr S U - (tr T - tr S tr U) 1)/tr U, tr S = adj U : T / J (eq. F5). */
ALWAYS_INLINE PackTensor pull_back_biot(PackTensor t, const BiotState *f)
{
    const PackTensor *u = &f->stretch;
    Pack trace = ((u->a22 * t.a11 + u->a11 * t.a22) - (u->a12 + u->a12) * t.a12) * f->by_jacobian;
    Pack twice = f->by_sum + f->by_sum, along = trace * f->by_sum, sphere = (t.a11 + t.a22) * f->by_sum - trace;
    PackTensor s = {(twice * t.a11 - along * u->a11) - sphere, (twice * t.a22 - along * u->a22) - sphere,
                    twice * t.a12 - along * u->a12};
    return s;
}

/* What MAT_ELASTIC needs of C: the strain and the way back to the second Piola-Kirchhoff stress. */
typedef struct LogarithmicState {
    PackTensor strain;   /* ln U in material axes */
    Pack jacobian, pull; /* J and 1/(J (l1 + l2)^2), the factor of pull_back */
    Pack wide;           /* l1/l2 */
} LogarithmicState;

/* ln U = (ln det C)/4 1 + ((ln c1)/2 - (ln det C)/4) dev C / radius (eq. F13), c1 the larger squared principal stretch.
 * One division for the two logarithms and for the way back. */
ALWAYS_INLINE LogarithmicState logarithmic_state(PackTensor c)
{
    LogarithmicState f;
    Pack half = 0.5 * (c.a11 - c.a22), mean = 0.5 * (c.a11 + c.a22);
    Pack square = half * half + c.a12 * c.a12 + BILLOW_TINY, by_radius = pack_reciprocal_root(square);
    Pack c1 = pack_larger(mean + square * by_radius, pack_of(BILLOW_LEAST_SQUARED_STRETCH));
    Pack det = pack_larger(c.a11 * c.a22 - c.a12 * c.a12, BILLOW_LEAST_SQUARED_STRETCH * c1);
    Pack by_jacobian = pack_reciprocal_root(det);
    f.jacobian = det * by_jacobian;
    Pack sum = 2.0 * (mean + f.jacobian), m1, k1, md, kd; /* sum: (l1 + l2)^2 */
    split_exponent(c1, &m1, &k1);
    split_exponent(det, &md, &kd);
    Pack p1 = m1 + 1.0, pd = md + 1.0, both = p1 * pd, inverse = 1.0 / (both * sum), by_both = inverse * sum;
    Pack log_c1 = k1 * BILLOW_LOG2 + log_series((m1 - 1.0) * (pd * by_both));
    Pack log_det = kd * BILLOW_LOG2 + log_series((md - 1.0) * (p1 * by_both));
    f.pull = by_jacobian * (both * inverse);
    f.wide = c1 * by_jacobian;
    Pack centre = 0.25 * log_det, spread = (0.5 * log_c1 - centre) * by_radius;
    f.strain.a11 = centre + spread * half;
    f.strain.a22 = centre - spread * half;
    f.strain.a12 = spread * c.a12;
    return f;
}

/* S = J U^-1 t U^-1 on the constant thickness (eq. F14). With K = adj C + J 1 = (l1 + l2) adj U this is
 * S = K t K / (J (l1 + l2)^2). */
ALWAYS_INLINE PackTensor pull_back(PackTensor t, PackTensor c, Pack jacobian, Pack pull)
{
    Pack k11 = c.a22 + jacobian, k22 = c.a11 + jacobian, k12 = c.a12; /* K12 = -k12 */
    Pack a1 = k11 * t.a11 - k12 * t.a12, a2 = k11 * t.a12 - k12 * t.a22;
    Pack b1 = k22 * t.a12 - k12 * t.a11, b2 = k22 * t.a22 - k12 * t.a12;
    PackTensor s = {pull * (k11 * a1 - k12 * a2), pull * (k22 * b2 - k12 * b1), pull * (k22 * a2 - k12 * a1)};
    return s;
}

#endif
