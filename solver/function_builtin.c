/* Table of the functions that expressions know. */
#include "solver/function_builtin.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "solver/elementary.h"

/* trunc, round, floor, ceil, fmod, copysign and sqrt are exact by definition: the C library's are the same everywhere.
 */
#define OF_ONE(NAME, EXPRESSION)                                                                                       \
    static double value_of_##NAME(const double *a, int count)                                                          \
    {                                                                                                                  \
        (void)count;                                                                                                   \
        return EXPRESSION;                                                                                             \
    }
OF_ONE(sin, elementary_sin(a[0]))
OF_ONE(cos, elementary_cos(a[0]))
OF_ONE(tan, elementary_tan(a[0]))
OF_ONE(csc, 1 / elementary_sin(a[0]))
OF_ONE(sec, 1 / elementary_cos(a[0]))
OF_ONE(ctn, elementary_cos(a[0]) / elementary_sin(a[0]))
OF_ONE(asin, elementary_asin(a[0]))
OF_ONE(acos, elementary_acos(a[0]))
OF_ONE(atan, elementary_atan(a[0]))
OF_ONE(sinh, elementary_sinh(a[0]))
OF_ONE(cosh, elementary_cosh(a[0]))
OF_ONE(tanh, elementary_tanh(a[0]))
OF_ONE(asinh, elementary_asinh(a[0]))
OF_ONE(acosh, elementary_acosh(a[0]))
OF_ONE(atanh, elementary_atanh(a[0]))
OF_ONE(exp, elementary_exp(a[0]))
OF_ONE(log, elementary_log(a[0]))
OF_ONE(log10, elementary_log10(a[0]))
OF_ONE(sqrt, sqrt(a[0]))
OF_ONE(same, a[0])
OF_ONE(abs, fabs(a[0]))
OF_ONE(trunc, trunc(a[0]))
OF_ONE(round, round(a[0]))
OF_ONE(floor, floor(a[0]))
OF_ONE(ceil, ceil(a[0]))
OF_ONE(atan2, elementary_atan2(a[0], a[1]))
OF_ONE(mod, fmod(a[0], a[1]))
OF_ONE(sign, copysign(fabs(a[0]), a[1] == 0 ? 1.0 : a[1]))

double function_builtin_power(double x, double y)
{
    if (x >= 0 || y != trunc(y)) return elementary_pow(x, y);
    double size = elementary_pow(-x, y);
    return fmod(y, 2.0) == 0 ? size : -size;
}

OF_ONE(pow, function_builtin_power(a[0], a[1]))

static double value_of_min(const double *a, int count)
{
    double least = a[0];
    for (int i = 1; i < count; i++) least = a[i] < least ? a[i] : least;
    return least;
}

static double value_of_max(const double *a, int count)
{
    double most = a[0];
    for (int i = 1; i < count; i++) most = a[i] > most ? a[i] : most;
    return most;
}

/* IF(e, a, b, c): a where e < 0, b where e = 0, c where e > 0. */
OF_ONE(if, a[0]<0 ? a[1] : a[0]> 0 ? a[3] : a[2])

/* STEP(x, x0, h0, x1, h1): from h0 to h1 by a cubic with level ends. */
static double value_of_step(const double *a, int count)
{
    (void)count;
    if (a[0] <= a[1]) return a[2];
    if (a[0] >= a[3]) return a[4];
    double share = (a[0] - a[1]) / (a[3] - a[1]);
    return a[2] + (a[4] - a[2]) * share * share * (3.0 - 2.0 * share);
}

/* SHF(x, x0, a, w, phi, b) = a sin(w (x - x0) - phi) + b */
OF_ONE(shf, a[2] * elementary_sin(a[3] * (a[0] - a[1]) - a[4]) + (count > 5 ? a[5] : 0.0))

/* POLY(x, x0, a0, a1, ...): powers of x - x0. */
static double value_of_poly(const double *a, int count)
{
    double sum = 0.0;
    for (int i = count - 1; i >= 2; i--) sum = sum * (a[0] - a[1]) + a[i];
    return sum;
}

/* CHEBY(x, x0, a0, a1, ...): Chebyshev's polynomials of x - x0. */
static double value_of_cheby(const double *a, int count)
{
    double x = a[0] - a[1], before = 1.0, now = x, sum = a[2];
    for (int i = 3; i < count; i++) {
        sum += a[i] * now;
        double next = 2.0 * x * now - before;
        before = now;
        now = next;
    }
    return sum;
}

/* FORCOS(x, x0, w, a0, a1, ...) = sum of a_j cos(j w (x - x0)) */
static double value_of_forcos(const double *a, int count)
{
    double sum = a[3];
    for (int i = 4; i < count; i++) sum += a[i] * elementary_cos((i - 3) * a[2] * (a[0] - a[1]));
    return sum;
}

/* FORSIN(x, x0, w, a0, a1, ...) = a0 + sum of a_j sin(j w (x - x0)) */
static double value_of_forsin(const double *a, int count)
{
    double sum = a[3];
    for (int i = 4; i < count; i++) sum += a[i] * elementary_sin((i - 3) * a[2] * (a[0] - a[1]));
    return sum;
}

#define REAL(NAME, FUNCTION, LEAST, MOST)                                                                              \
    {                                                                                                                  \
        NAME, LEAST, MOST, BUILTIN_REAL, BUILTIN_EVERYWHERE, value_of_##FUNCTION                                       \
    }
#define WHOLE(NAME, FUNCTION)                                                                                          \
    {                                                                                                                  \
        NAME, 1, 1, BUILTIN_INTEGER, BUILTIN_EVERYWHERE, value_of_##FUNCTION                                           \
    }
#define KEEPS(NAME, FUNCTION, LEAST, MOST)                                                                             \
    {                                                                                                                  \
        NAME, LEAST, MOST, BUILTIN_KEEPS, BUILTIN_EVERYWHERE, value_of_##FUNCTION                                      \
    }
#define NEW(NAME, FUNCTION, LEAST, MOST)                                                                               \
    {                                                                                                                  \
        NAME, LEAST, MOST, BUILTIN_REAL, BUILTIN_FUNCTIONS, value_of_##FUNCTION                                        \
    }

enum { MOST = BILLOW_MOST_ARGUMENTS };
static const FunctionBuiltin builtins[] = {
    REAL("sin", sin, 1, 1),         REAL("cos", cos, 1, 1),
    REAL("tan", tan, 1, 1),         REAL("csc", csc, 1, 1),
    REAL("sec", sec, 1, 1),         REAL("ctn", ctn, 1, 1),
    REAL("asin", asin, 1, 1),       REAL("acos", acos, 1, 1),
    REAL("atan", atan, 1, 1),       REAL("sinh", sinh, 1, 1),
    REAL("cosh", cosh, 1, 1),       REAL("tanh", tanh, 1, 1),
    REAL("asinh", asinh, 1, 1),     REAL("acosh", acosh, 1, 1),
    REAL("atanh", atanh, 1, 1),     REAL("exp", exp, 1, 1),
    REAL("log", log, 1, 1),         REAL("ln", log, 1, 1),
    REAL("log10", log10, 1, 1),     REAL("sqrt", sqrt, 1, 1),
    REAL("float", same, 1, 1),      REAL("real", same, 1, 1),
    REAL("ls_real", same, 1, 1),    REAL("aint", trunc, 1, 1),
    REAL("anint", round, 1, 1),     REAL("atan2", atan2, 2, 2),
    WHOLE("ls_integer", trunc),     WHOLE("int", trunc),
    WHOLE("nint", round),           KEEPS("abs", abs, 1, 1),
    KEEPS("mod", mod, 2, 2),        KEEPS("sign", sign, 2, 2),
    KEEPS("min", min, 1, MOST),     KEEPS("max", max, 1, MOST),
    NEW("pow", pow, 2, 2),          NEW("fabs", abs, 1, 1),
    NEW("fmod", mod, 2, 2),         NEW("fmin", min, 2, 2),
    NEW("fmax", max, 2, 2),         NEW("trunc", trunc, 1, 1),
    NEW("round", round, 1, 1),      NEW("floor", floor, 1, 1),
    NEW("ceil", ceil, 1, 1),        NEW("if", if, 4, 4),
    NEW("step", step, 5, 5),        NEW("shf", shf, 5, 6),
    NEW("poly", poly, 3, MOST),     NEW("cheby", cheby, 3, MOST),
    NEW("forcos", forcos, 4, MOST), NEW("forsin", forsin, 4, MOST),
};

int function_builtin_find(const char *text, size_t length)
{
    for (size_t i = 0; i < sizeof builtins / sizeof *builtins; i++)
        if (strlen(builtins[i].name) == length && strncasecmp(builtins[i].name, text, length) == 0) return (int)i;
    return -1;
}

const FunctionBuiltin *function_builtin(int number)
{
    return &builtins[number];
}
