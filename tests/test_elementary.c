/* Tests of solver/elementary.c against the long double functions of the C library. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "solver/elementary.h"

enum { SAMPLES = 300000 };

static uint64_t random_bits(uint64_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return *seed;
}

/* Uniform in [a, b). */
static double random_between(uint64_t *seed, double a, double b)
{
    return a + (b - a) * ((double)(random_bits(seed) >> 11) * 0x1p-53);
}

/* Distance in units of the last place of the exact value's double. */
static double ulp_error(double value, long double exact)
{
    double nearest = (double)exact;
    if (value == nearest)
        return (double)(fabsl((long double)value - exact) / (nextafter(fabs(nearest), INFINITY) - fabs(nearest)));
    double ulp = nextafter(fabs(nearest), INFINITY) - fabs(nearest);
    return (double)(fabsl((long double)value - exact) / (long double)ulp);
}

static void judge(const char *name, double worst, double at, double limit)
{
    if (!(worst <= limit)) print_message("%s: %.3f ulp at %.17g\n", name, worst, at);
    assert_true(worst <= limit);
}

static void scan(const char *name, double (*f)(double), long double (*exact)(long double), double a, double b,
                 double limit)
{
    uint64_t seed = UINT64_C(0x9e3779b97f4a7c15);
    double worst = 0.0, at = a;
    for (int i = 0; i < SAMPLES; i++) {
        double x = random_between(&seed, a, b);
        double error = ulp_error(f(x), exact((long double)x));
        if (!(error <= worst)) worst = error, at = x;
    }
    judge(name, worst, at, limit);
}

static void test_exp(void **state)
{
    (void)state;
    scan("exp", elementary_exp, expl, -0.4, 0.4, 1.5);
    scan("exp", elementary_exp, expl, -20.0, 20.0, 1.5);
    scan("exp", elementary_exp, expl, -708.0, 709.7, 1.5);
    scan("exp small", elementary_exp, expl, -1e-6, 1e-6, 1.5);
    scan("exp subnormal", elementary_exp, expl, -744.0, -708.0, 1.5);
    assert_true(elementary_exp(0.0) == 1.0);
    assert_true(elementary_exp(710.0) == INFINITY && elementary_exp(1e300) == INFINITY);
    assert_true(elementary_exp(INFINITY) == INFINITY && elementary_exp(-INFINITY) == 0.0);
    assert_true(elementary_exp(-746.0) == 0.0 && elementary_exp(-1e300) == 0.0);
    assert_true(isnan(elementary_exp(NAN)));
}

static void test_log(void **state)
{
    (void)state;
    scan("log", elementary_log, logl, 0.5, 2.0, 1.5);
    scan("log near 1", elementary_log, logl, 0.999999, 1.000001, 1.5);
    scan("log", elementary_log, logl, 0.0, 1e6, 1.5);
    scan("log", elementary_log, logl, 0.0, 1e-300, 1.5);
    scan("log", elementary_log, logl, 1e300, 1.7e308, 1.5);
    uint64_t seed = 12345;
    double worst = 0.0, at = 0.0;
    for (int i = 0; i < SAMPLES; i++) { /* all exponents */
        double x = ldexp(random_between(&seed, 0.5, 1.0), (int)(random_bits(&seed) % 2090u) - 1070);
        double error = ulp_error(elementary_log(x), logl((long double)x));
        if (!(error <= worst)) worst = error, at = x;
    }
    judge("log, all exponents", worst, at, 1.5);
    assert_true(elementary_log(1.0) == 0.0);
    assert_true(elementary_log(0.0) == -INFINITY);
    assert_true(elementary_log(INFINITY) == INFINITY);
    assert_true(isnan(elementary_log(-1.0)) && isnan(elementary_log(NAN)));
    assert_true(ulp_error(elementary_log(0x1p-1074), logl(0x1p-1074L)) < 1.0);
}

/* x^y with results over the whole range; long double powl carries 64 bits, enough to judge 2 ulp. */
static void test_pow(void **state)
{
    (void)state;
    uint64_t seed = 777;
    double worst = 0.0, at = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        double x = ldexp(random_between(&seed, 0.5, 1.0), (int)(random_bits(&seed) % 41u) - 20);
        double y = random_between(&seed, -3.0, 3.0);
        double error = ulp_error(elementary_pow(x, y), powl((long double)x, (long double)y));
        if (!(error <= worst)) worst = error, at = x;
    }
    judge("pow of gases", worst, at, 2.0);
    worst = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        double x = ldexp(random_between(&seed, 0.5, 1.0), (int)(random_bits(&seed) % 3u) - 1);
        double y = random_between(&seed, -700.0, 700.0) / fabs(log(x));
        if (fabs(y) > 1e15) continue;
        double error = ulp_error(elementary_pow(x, y), powl((long double)x, (long double)y));
        if (!(error <= worst)) worst = error, at = x;
    }
    judge("pow with large exponents", worst, at, 2.0);
    worst = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        double x = random_between(&seed, 0.98, 1.02);
        double y = random_between(&seed, 0.0, 2.0);
        double error = ulp_error(elementary_pow(x, y), powl((long double)x, (long double)y));
        if (!(error <= worst)) worst = error, at = x;
    }
    judge("pow of ratios near 1", worst, at, 2.0);
}

static void test_pow_special(void **state)
{
    (void)state;
    assert_true(elementary_pow(0.0, 0.4) == 0.0 && elementary_pow(0.0, -0.4) == INFINITY);
    assert_true(elementary_pow(0.0, 0.0) == 1.0 && elementary_pow(3.0, 0.0) == 1.0);
    assert_true(elementary_pow(1.0, 1e300) == 1.0);
    assert_true(elementary_pow(2.0, 10.0) == 1024.0 && elementary_pow(2.0, -2.0) == 0.25);
    assert_true(elementary_pow(INFINITY, 2.0) == INFINITY && elementary_pow(INFINITY, -2.0) == 0.0);
    assert_true(elementary_pow(2.0, 1e4) == INFINITY && elementary_pow(2.0, -1e4) == 0.0);
    assert_true(elementary_pow(2.0, INFINITY) == INFINITY && elementary_pow(0.5, INFINITY) == 0.0);
    assert_true(elementary_pow(2.0, 1e200) == INFINITY && elementary_pow(2.0, -1e200) == 0.0);
    assert_true(isnan(elementary_pow(-1.0, 2.0)) && isnan(elementary_pow(2.0, NAN)) && isnan(elementary_pow(NAN, 2.0)));
}

static void test_sin_cos(void **state)
{
    (void)state;
    scan("sin", elementary_sin, sinl, -0.8, 0.8, 1.5);
    scan("sin", elementary_sin, sinl, -10.0, 10.0, 1.5);
    scan("sin", elementary_sin, sinl, -1e6, 1e6, 1.5);
    scan("cos", elementary_cos, cosl, -0.8, 0.8, 1.5);
    scan("cos", elementary_cos, cosl, -10.0, 10.0, 1.5);
    scan("cos", elementary_cos, cosl, -1e6, 1e6, 1.5);
    double worst = 0.0, at = 0.0; /* the doubles next to multiples of pi/2, where the remainder cancels */
    for (int n = 1; n < 600000; n += 3) {
        double x = (double)((long double)n * 1.57079632679489661923132169163975144L);
        double s = ulp_error(elementary_sin(x), sinl((long double)x));
        double c = ulp_error(elementary_cos(x), cosl((long double)x));
        if (!(s <= worst)) worst = s, at = x;
        if (!(c <= worst)) worst = c, at = x;
    }
    judge("sin and cos next to multiples of pi/2", worst, at, 1.5);
    assert_true(elementary_sin(0.0) == 0.0 && elementary_cos(0.0) == 1.0);
    assert_true(isnan(elementary_sin(NAN)) && isnan(elementary_cos(INFINITY)) && isnan(elementary_sin(2e6)));
}

static void test_derived(void **state)
{
    (void)state;
    scan("atan", elementary_atan, atanl, -1.2, 1.2, 1.5);
    scan("atan", elementary_atan, atanl, -50.0, 50.0, 1.5);
    scan("tan", elementary_tan, tanl, -1.5, 1.5, 3.0);
    scan("asin", elementary_asin, asinl, -1.0, 1.0, 3.0);
    scan("acos", elementary_acos, acosl, -1.0, 1.0, 3.0);
    scan("sinh", elementary_sinh, sinhl, -0.5, 0.5, 3.0);
    scan("sinh", elementary_sinh, sinhl, -700.0, 700.0, 5.0);
    scan("cosh", elementary_cosh, coshl, -700.0, 700.0, 5.0);
    scan("tanh", elementary_tanh, tanhl, -3.0, 3.0, 5.0);
    scan("asinh", elementary_asinh, asinhl, -1e3, 1e3, 4.0);
    scan("acosh", elementary_acosh, acoshl, 1.0, 1e3, 4.0);
    scan("atanh", elementary_atanh, atanhl, -0.999, 0.999, 4.0);
    scan("log10", elementary_log10, log10l, 0.0, 1e6, 3.0);
    assert_true(elementary_log10(1e15) == 15.0 && elementary_log10(1e-7) == -7.0);
    const double quarter = 0.78539816339744830962, turn = 3.14159265358979323846;
    assert_true(elementary_atan2(1.0, 1.0) == quarter && elementary_atan2(-1.0, 1.0) == -quarter);
    assert_true(elementary_atan2(0.0, -1.0) == turn && elementary_atan2(0.0, 0.0) == 0.0);
    assert_true(fabs(elementary_atan2(2.0, -2.0) - 3.0 * quarter) < 1e-15);
    assert_true(isnan(elementary_asin(1.1)) && isnan(elementary_acosh(0.5)) && isnan(elementary_atan2(NAN, 1.0)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exp),         cmocka_unit_test(test_log),     cmocka_unit_test(test_pow),
        cmocka_unit_test(test_pow_special), cmocka_unit_test(test_sin_cos), cmocka_unit_test(test_derived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
