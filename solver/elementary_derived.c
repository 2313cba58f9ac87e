/* tan, inverse and hyperbolic functions from those of elementary.c: the same bits on every processor. */
#include <math.h>

#include "solver/elementary.h"

static const double HALF_PI_HI = 0x1.921fb54442d18p+0, HALF_PI_LO = 0x1.1a62633145c07p-54;

double elementary_tan(double x)
{
    return elementary_sin(x) / elementary_cos(x);
}

/* atan(k/8) as pairs. */
static const double table_hi[9] = {
    0.0,
    0x1.fd5ba9aac2f6ep-4,
    0x1.f5b75f92c80ddp-3,
    0x1.6f61941e4def1p-2,
    0x1.dac670561bb4fp-2,
    0x1.1e00babdefeb4p-1,
    0x1.4978fa3269ee1p-1,
    0x1.700a7c5784634p-1,
    0x1.921fb54442d18p-1,
};
static const double table_lo[9] = {
    0.0,
    -0x1.cd37686760c17p-59,
    0x1.8ab6e3cf7afbdp-57,
    -0x1.c63aae6f6e918p-56,
    0x1.a2b7f222f65e2p-56,
    -0x1.928df287a668fp-58,
    0x1.2419a87f2a458p-56,
    -0x1.8c34d25aadef6p-56,
    0x1.1a62633145c07p-55,
};

/* atan x = atan(k/8) + atan t, t = (x - k/8)/(1 + k x/8), |t| <= 1/16: Taylor's series to t^17. 0 <= x <= 1. */
static double atan_unit(double x)
{
    int k = (int)(8.0 * x + 0.5);
    double t = (x - k / 8.0) / (1.0 + k / 8.0 * x), z = t * t;
    double series =
        z *
        (-1.0 / 3 +
         z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13 + z * (-1.0 / 15 + z / 17)))))));
    return table_hi[k] + (t + (t * series + table_lo[k]));
}

double elementary_atan(double x)
{
    double size = fabs(x);
    if (!(size > 0.0)) return x;
    double angle = size <= 1.0 ? atan_unit(size) : HALF_PI_HI - (atan_unit(1.0 / size) - HALF_PI_LO);
    return x < 0.0 ? -angle : angle;
}

double elementary_atan2(double y, double x)
{
    if (x != x || y != y) return NAN;
    if (x == 0.0 && y == 0.0) return 0.0;
    double angle =
        fabs(y) <= fabs(x) ? atan_unit(fabs(y) / fabs(x)) : HALF_PI_HI - (atan_unit(fabs(x) / fabs(y)) - HALF_PI_LO);
    if (x < 0.0) angle = 2.0 * HALF_PI_HI - (angle - 2.0 * HALF_PI_LO);
    return y < 0.0 ? -angle : angle;
}

double elementary_asin(double x)
{
    if (!(fabs(x) <= 1.0)) return NAN;
    return elementary_atan2(x, sqrt((1.0 - x) * (1.0 + x)));
}

double elementary_acos(double x)
{
    if (!(fabs(x) <= 1.0)) return NAN;
    return elementary_atan2(sqrt((1.0 - x) * (1.0 + x)), x);
}

/* Taylor's series to x^15 where the difference of the exponentials would lose digits. */
double elementary_sinh(double x)
{
    double size = fabs(x);
    if (size < 0.5) {
        double z = x * x, series = 0.0;
        for (int n = 15; n >= 3; n -= 2) series = z / (n * (n - 1)) * (1.0 + series);
        return x + x * series;
    }
    double e = elementary_exp(0.5 * size), half = 0.5 * e * e; /* in halves, so that it does not overflow early */
    double value = half - 0.25 / half;
    return x < 0.0 ? -value : value;
}

double elementary_cosh(double x)
{
    double e = elementary_exp(0.5 * fabs(x)), half = 0.5 * e * e;
    return half + 0.25 / half;
}

double elementary_tanh(double x)
{
    double size = fabs(x);
    if (size < 0.5) return elementary_sinh(x) / elementary_cosh(x);
    double value = 1.0 - 2.0 / (elementary_exp(2.0 * size) + 1.0);
    return x < 0.0 ? -value : value;
}

/* log(1 + u) without the loss of u's last digits (Kahan). */
static double log_one_plus(double u)
{
    double w = 1.0 + u;
    if (w == 1.0 || !(w < INFINITY)) return u;
    return elementary_log(w) * (u / (w - 1.0));
}

double elementary_asinh(double x)
{
    double size = fabs(x);
    double value = size > 1e8 ? elementary_log(size) + 0x1.62e42fefa39efp-1
                              : log_one_plus(size + size * size / (1.0 + sqrt(1.0 + size * size)));
    return x < 0.0 ? -value : value;
}

double elementary_acosh(double x)
{
    if (!(x >= 1.0)) return NAN;
    double t = x - 1.0;
    if (x > 1e8) return elementary_log(x) + 0x1.62e42fefa39efp-1;
    return log_one_plus(t + sqrt(2.0 * t + t * t));
}

double elementary_atanh(double x)
{
    double size = fabs(x);
    if (!(size <= 1.0)) return NAN;
    double value = 0.5 * log_one_plus(2.0 * size / (1.0 - size));
    return x < 0.0 ? -value : value;
}

double elementary_log10(double x)
{
    double value = elementary_log(x) * 0x1.bcb7b1526e50ep-2;
    double whole = nearbyint(value), power = 1.0;
    if (!(fabs(whole) <= 22.0)) return value;
    for (int i = 0; i < (int)fabs(whole); i++) power *= 10.0; /* exact */
    return x == (whole < 0.0 ? 1.0 / power : power) ? whole : value;
}
