/* exp, log, pow, sin, cos from + - * / and bit moves only, so that every processor computes the same bits. */
#include "solver/elementary.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* A value as an unevaluated sum hi + lo with |lo| <= ulp(hi)/2. */
typedef struct DoubleDouble {
    double hi, lo;
} DoubleDouble;

static const double LN2_HI = 0x1.62e42fefa3800p-1; /* 42 bits: k LN2_HI is exact for |k| < 2048 */
static const double LN2_LO = 0x1.ef35793c76730p-45;
static const double ROUND_SHIFT = 0x1.8p52; /* adding it rounds to an integer, kept in the low bits */

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Exact sum of two doubles, any order of size (Knuth). */
static DoubleDouble two_sum(double a, double b)
{
    double s = a + b, t = s - a;
    return (DoubleDouble){s, (a - (s - t)) + (b - t)};
}

/* Exact sum if |a| >= |b| (Dekker). */
static DoubleDouble fast_two_sum(double a, double b)
{
    double s = a + b;
    return (DoubleDouble){s, b - (s - a)};
}

/* Exact product (Dekker, Veltkamp's splitting): an FMA would give other bits where it is missing. */
static DoubleDouble two_product(double a, double b)
{
    double ca = 0x1.0000002p27 * a, cb = 0x1.0000002p27 * b;
    double ah = ca - (ca - a), al = a - ah;
    double bh = cb - (cb - b), bl = b - bh;
    double p = a * b;
    return (DoubleDouble){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

static DoubleDouble multiply(DoubleDouble a, DoubleDouble b)
{
    DoubleDouble p = two_product(a.hi, b.hi);
    return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static DoubleDouble add(DoubleDouble a, DoubleDouble b)
{
    DoubleDouble s = two_sum(a.hi, b.hi);
    return fast_two_sum(s.hi, s.lo + (a.lo + b.lo));
}

/* 2^k as a factor in two halves, so that results below the normal range are reached with one rounding. */
static double scale_by_power(double x, int64_t k)
{
    int64_t half = k >> 1;
    return x * double_of((uint64_t)(1023 + half) << 52) * double_of((uint64_t)(1023 + k - half) << 52);
}

/* exp(hi + lo), |lo| far below |hi|: hi = k ln 2 + r, |r| <= ln2/2, Taylor's series to r^14. */
static double exp_of_pair(double hi, double lo)
{
    static const double c[] = {1.0 / 2,
                               1.0 / 6,
                               1.0 / 24,
                               1.0 / 120,
                               1.0 / 720,
                               1.0 / 5040,
                               1.0 / 40320,
                               1.0 / 362880,
                               1.0 / 3628800,
                               1.0 / 39916800,
                               1.0 / 479001600,
                               1.0 / 6227020800.0,
                               1.0 / 87178291200.0};
    double x = hi > 800.0 ? 800.0 : hi > -800.0 ? hi : -800.0; /* beyond, the result is 0 or infinity anyway */
    double shifted = x * 0x1.71547652b82fep+0 + ROUND_SHIFT;
    double k = shifted - ROUND_SHIFT;
    double r_hi = x - k * LN2_HI;
    double r_lo = lo - k * LN2_LO;
    double r = r_hi + r_lo, r2 = r * r, r4 = r2 * r2;
    double p0 = (c[0] + r * c[1]) + r2 * (c[2] + r * c[3]);
    double p1 = (c[4] + r * c[5]) + r2 * (c[6] + r * c[7]);
    double p2 = (c[8] + r * c[9]) + r2 * (c[10] + r * c[11]) + r4 * c[12];
    double tail = r2 * (p0 + r4 * (p1 + r4 * p2));
    double y = 1.0 + (r_hi + (r_lo + tail));
    return hi != hi ? hi : scale_by_power(y, (int64_t)k);
}

/* 2/5, 2/7, ... 2/25: log((1+s)/(1-s)) = 2 s + 2/3 s^3 + s^5 (2/5 + 2/7 s^2 + ...), |s| <= 0.1716. */
static double log_tail(double z)
{
    static const double c[] = {0x1.999999999999ap-2, 0x1.2492492492492p-2, 0x1.c71c71c71c71cp-3, 0x1.745d1745d1746p-3,
                               0x1.3b13b13b13b14p-3, 0x1.1111111111111p-3, 0x1.e1e1e1e1e1e1ep-4, 0x1.af286bca1af28p-4,
                               0x1.8618618618618p-4, 0x1.642c8590b2164p-4, 0x1.47ae147ae147bp-4};
    double z2 = z * z, z4 = z2 * z2;
    return (c[0] + z * c[1]) + z2 * (c[2] + z * c[3]) +
           z4 * ((c[4] + z * c[5]) + z2 * (c[6] + z * c[7]) + z4 * ((c[8] + z * c[9]) + z2 * c[10]));
}

/* x = 2^k m with m in [sqrt(1/2), sqrt 2); returns m - 1, which is exact. */
static double split_exponent(double x, double *k)
{
    int subnormal = x < 0x1p-1022;
    uint64_t bits = bits_of(subnormal ? x * 0x1p54 : x);
    uint64_t shifted = bits - UINT64_C(0x3fe6a09e667f3bcd); /* sqrt(1/2): m is put at or above it */
    *k = (double)((int64_t)shifted >> 52) - (subnormal ? 54.0 : 0.0);
    return double_of(bits - (shifted & UINT64_C(0xfff0000000000000))) - 1.0;
}

/* log x for 0 < x < infinity to about 2^-66 relative to the larger of log x and 1, s = (m - 1)/(m + 1) as a pair. */
static DoubleDouble log_pair(double x)
{
    double k, f = split_exponent(x, &k);
    DoubleDouble d = two_sum(f, 2.0);
    double q = f / d.hi;
    DoubleDouble product = two_product(q, d.hi);
    DoubleDouble s = fast_two_sum(q, ((f - product.hi) - product.lo - q * d.lo) / d.hi);

    DoubleDouble s2 = multiply(s, s);
    DoubleDouble s3 = multiply(s2, s);
    DoubleDouble cubic = multiply(s3, (DoubleDouble){0x1.5555555555555p-1, 0x1.5555555555555p-55});
    cubic.lo += s3.hi * s2.hi * log_tail(s2.hi);
    DoubleDouble log_m = add((DoubleDouble){2.0 * s.hi, 2.0 * s.lo}, fast_two_sum(cubic.hi, cubic.lo));
    return add(fast_two_sum(k * LN2_HI, k * LN2_LO), log_m);
}

/* The same to one unit of the last place: 2 s = f - s f, so that log m = f - (f^2/2 - s (f^2/2 + tail)). */
static double log_single(double x)
{
    double k, f = split_exponent(x, &k);
    double s = f / (2.0 + f), z = s * s, half = 0.5 * f * f;
    double tail = z * (2.0 / 3.0 + z * log_tail(z));
    return k * LN2_HI + (f - (half - (s * (half + tail) + k * LN2_LO)));
}

double elementary_exp(double x)
{
    return exp_of_pair(x, 0.0);
}

double elementary_log(double x)
{
    if (x > 0.0 && x < INFINITY) return log_single(x);
    if (x == 0.0) return -INFINITY;
    return x > 0.0 ? x : NAN;
}

double elementary_pow(double x, double y)
{
    if (y == 0.0 || x == 1.0) return 1.0;
    if (!(x > 0.0 && x < INFINITY) || !(fabs(y) < 0x1p100)) {
        if (!(x >= 0.0) || y != y) return NAN;
        if (x == 0.0 || x == INFINITY) return (x == 0.0) == (y > 0.0) ? 0.0 : INFINITY;
        return (x > 1.0) == (y > 0.0) ? INFINITY : 0.0;
    }
    DoubleDouble l = log_pair(x);
    double rough = l.hi * y;
    if (!(fabs(rough) < 800.0)) return rough > 0.0 ? INFINITY : 0.0;
    DoubleDouble p = two_product(l.hi, y);
    p = fast_two_sum(p.hi, p.lo + l.lo * y);
    return exp_of_pair(p.hi, p.lo);
}

/* x = n pi/2 + (hi + lo), |hi| <= pi/4 and a bit; pi/2 in three parts of 33 bits and a fourth of 53, so that n times a
 * part is exact for |n| < 2^20 and the remainder keeps its digits even next to a multiple of pi/2. Returns n mod 4. */
static unsigned reduce_angle(double x, DoubleDouble *rest)
{
    double shifted = x * 0x1.45f306dc9c883p-1 + ROUND_SHIFT;
    double n = shifted - ROUND_SHIFT;
    DoubleDouble a = two_sum(x - n * 0x1.921fb54400000p+0, -(n * 0x1.0b4611a600000p-34));
    DoubleDouble b = two_sum(a.hi, -(n * 0x1.3198a2e000000p-69));
    *rest = two_sum(b.hi, (a.lo + b.lo) - n * 0x1.b839a252049c1p-104);
    return (unsigned)bits_of(shifted) & 3u;
}

/* Taylor's series to r^17 and r^18 on |r| <= pi/4. */
static double sine_kernel(DoubleDouble r)
{
    double z = r.hi * r.hi, z2 = z * z;
    double p0 = (-1.0 / 6 + z * (1.0 / 120)) + z2 * (-1.0 / 5040 + z * (1.0 / 362880));
    double p1 =
        (-1.0 / 39916800 + z * (1.0 / 6227020800.0)) + z2 * (-1.0 / 1307674368000.0 + z * (1.0 / 355687428096000.0));
    return r.hi + (r.lo * (1.0 - 0.5 * z) + r.hi * z * (p0 + z2 * z2 * p1));
}

static double cosine_kernel(DoubleDouble r)
{
    double z = r.hi * r.hi, z2 = z * z, half = 0.5 * z, w = 1.0 - half;
    double p0 = (1.0 / 24 + z * (-1.0 / 720)) + z2 * (1.0 / 40320 + z * (-1.0 / 3628800));
    double p1 = (1.0 / 479001600 + z * (-1.0 / 87178291200.0)) +
                z2 * (1.0 / 20922789888000.0 + z * (-1.0 / 6402373705728000.0));
    return w + (((1.0 - w) - half) + (z2 * (p0 + z2 * z2 * p1) - r.hi * r.lo));
}

/* sin(x + quarters pi/2) */
static double sine_shifted(double x, unsigned quarters)
{
    if (!(fabs(x) < 1e6)) return NAN;
    DoubleDouble r;
    unsigned n = (reduce_angle(x, &r) + quarters) & 3u;
    double value = n & 1u ? cosine_kernel(r) : sine_kernel(r);
    return n & 2u ? -value : value;
}

double elementary_sin(double x)
{
    return sine_shifted(x, 0);
}

double elementary_cos(double x)
{
    return sine_shifted(x, 1);
}
