/* Point functions of rubber: incompressible Mooney-Rivlin and Ogden membranes (docs/theory.md, Rubber). On packs. */
#ifndef BILLOW_KERNEL_HYPERELASTIC_H
#define BILLOW_KERNEL_HYPERELASTIC_H

#include "elements/kernel_law.h"
#include "elements/law_rubber.h"

/* exp(x), |x| < 700, to about one unit in the last place: 2^k exp(r), |r| <= ln 2/2, a polynomial of degree 12. */
ALWAYS_INLINE Pack pack_exp(Pack x)
{
    const double magic = 6755399441055744.0; /* 1.5 2^52: adding it leaves the whole number in the low bits */
    x = pack_larger(pack_smaller(x, pack_of(700.0)), pack_of(-700.0));
    Pack shifted = x * 1.4426950408889634 + magic, k = shifted - magic;
    Pack r = (x - k * 0.693147180369123816490) - k * 1.90821492927058770002e-10;
    Pack p = pack_of(1.0 / 479001600.0);
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    Pack value = 1.0 + (r + (r * r) * p);
    return (Pack)((PackBits)value + ((PackBits)shifted << 52));
}

ALWAYS_INLINE Pack pack_log(Pack x)
{
    Pack m, k;
    split_exponent(x, &m, &k);
    return k * BILLOW_LOG2 + log_series((m - 1.0) / (m + 1.0));
}

typedef struct RubberResult {
    PackTensor stress; /* second Piola-Kirchhoff */
    Pack energy;       /* per reference volume */
    Pack modulus;      /* bound of the second derivative of the energy by the deformation gradient (eq. H8) */
} RubberResult;

/* Invariants of C: trace, determinant (kept away from 0), the principal values c1 >= c2. */
typedef struct RubberState {
    Pack trace, det, by_det, jacobian, c1, c2, by_radius, half;
} RubberState;

ALWAYS_INLINE RubberState rubber_state(PackTensor c)
{
    RubberState f;
    f.half = 0.5 * (c.a11 - c.a22);
    f.trace = pack_larger(c.a11 + c.a22, pack_of(BILLOW_LEAST_SQUARED_STRETCH));
    f.det = pack_larger(c.a11 * c.a22 - c.a12 * c.a12, BILLOW_LEAST_SQUARED_STRETCH * f.trace);
    f.jacobian = pack_root(f.det);
    f.by_det = 1.0 / f.det;
    Pack radius = pack_root(f.half * f.half + c.a12 * c.a12 + BILLOW_TINY);
    f.by_radius = 1.0 / radius;
    f.c1 = 0.5 * f.trace + radius;
    f.c2 = f.det / f.c1;
    return f;
}

/* Larger eigenvalue of [w11 w12; w12 w22]. */
ALWAYS_INLINE Pack larger_eigenvalue(Pack w11, Pack w22, Pack w12)
{
    Pack half = 0.5 * (w11 - w22);
    return 0.5 * (w11 + w22) + pack_root(half * half + w12 * w12);
}

/* W = A (I1 - 3) + B (I2 - 3), the thickness from constant volume (eq. H1 to H3, H9). */
ALWAYS_INLINE RubberResult mooney_stress(const RubberLaw *law, PackTensor c)
{
    RubberState f = rubber_state(c);
    double a = 2.0 * law->a, b = 2.0 * law->b;
    Pack thin = f.by_det, inverse = thin * thin; /* C33; times adj C it is C^-1/det C */
    Pack sphere = a + b * thin, along = b - inverse * (a + b * f.trace);
    RubberResult r;
    r.stress.a11 = sphere + along * c.a22;
    r.stress.a22 = sphere + along * c.a11;
    r.stress.a12 = -along * c.a12;
    r.energy = law->a * (f.trace + thin - 3.0) + law->b * (f.trace * thin + f.det - 3.0);
    Pack by1 = 1.0 / f.c1, by2 = 1.0 / f.c2, by_jacobian = f.jacobian * thin;
    Pack w11 = a + 3.0 * a * (thin * by1) + 3.0 * b * (by1 * by1) + b * f.c2;
    Pack w22 = a + 3.0 * a * (thin * by2) + 3.0 * b * (by2 * by2) + b * f.c1;
    r.modulus = larger_eigenvalue(w11, w22, 2.0 * a * (thin * by_jacobian) + 2.0 * b * f.jacobian);
    return r;
}

/* W = sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3), l3 = 1/(l1 l2) (eq. H4 to H8). */
ALWAYS_INLINE RubberResult ogden_stress(const RubberLaw *law, PackTensor c)
{
    RubberState f = rubber_state(c);
    Pack log1 = 0.5 * pack_log(f.c1), log2 = 0.5 * pack_log(f.c2), by1 = 1.0 / f.c1, by2 = 1.0 / f.c2;
    Pack by_jacobian = f.jacobian * f.by_det, s1 = pack_of(0.0), s2 = s1, w11 = s1, w22 = s1, w12 = s1, shear = s1,
         spin = s1;
    Pack by_sum = 1.0 / (pack_root(f.c1) + pack_root(f.c2)), root1 = pack_root(by1), root2 = pack_root(by2);
    RubberResult r = {.energy = pack_of(0.0)};
    for (int i = 0; i < law->terms; i++) {
        double mu = law->mu[i], alpha = law->alpha[i];
        Pack p1 = pack_exp(alpha * log1), p2 = pack_exp(alpha * log2), p3 = pack_exp(-alpha * (log1 + log2));
        Pack m1 = p1 * by1, m2 = p2 * by2;
        r.energy += (mu / alpha) * ((p1 - 1.0) + (p2 - 1.0) + (p3 - 1.0));
        s1 += mu * ((p1 - p3) * by1);
        s2 += mu * ((p2 - p3) * by2);
        w11 += mu * ((alpha - 1.0) * m1 + (alpha + 1.0) * (p3 * by1));
        w22 += mu * ((alpha - 1.0) * m2 + (alpha + 1.0) * (p3 * by2));
        w12 += mu * alpha * (p3 * by_jacobian);
        double bend = mu * (alpha - 1.0);
        if (bend > 0.0) shear += bend * pack_larger(m1, m2);
        shear += mu * (p3 * by_jacobian);
        spin += mu * ((p1 * root1 + p2 * root2) * by_sum - p3 * by_jacobian);
    }
    Pack mean = 0.5 * (s1 + s2), spread = 0.5 * (s1 - s2) * f.by_radius;
    r.stress.a11 = mean + spread * f.half;
    r.stress.a22 = mean - spread * f.half;
    r.stress.a12 = spread * c.a12;
    Pack most = pack_larger(larger_eigenvalue(w11, w22, w12), pack_larger(shear, spin));
    r.modulus = pack_larger(most, pack_larger(s1, s2));
    return r;
}

#endif
