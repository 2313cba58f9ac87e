/* exp, log, pow, sin, cos and what is made of them with the same bits on every processor.
 * The C library picks its variant by the processor (FMA or not); these use only + - * / and bit moves,
 * so that states do not depend on the machine (docs/architecture.md, same bits). Error below 1.5 ulp on the tested
 * ranges (tests/test_elementary.c). All are branch-free in the main range so that loops over them vectorise. */
#ifndef BILLOW_ELEMENTARY_H
#define BILLOW_ELEMENTARY_H

double elementary_exp(double x);           /* overflow: +inf, underflow: 0 */
double elementary_log(double x);           /* x > 0; 0: -inf; negative: NaN; subnormals allowed */
double elementary_pow(double x, double y); /* x >= 0; relative error below 4e-16 (1 + |y log x|) at worst */
double elementary_sin(double x);           /* |x| < 1e6 */
double elementary_cos(double x);

/* Functions made of the above (solver/elementary_derived.c): a few ulp. */
double elementary_tan(double x);             /* |x| < 1e6 */
double elementary_atan(double x);            /* below 1.5 ulp */
double elementary_atan2(double y, double x); /* angle of (x, y) in (-pi, pi]; 0 at the origin */
double elementary_asin(double x);            /* NaN beyond [-1, 1] */
double elementary_acos(double x);            /* NaN beyond [-1, 1] */
double elementary_sinh(double x);
double elementary_cosh(double x);
double elementary_tanh(double x);
double elementary_asinh(double x);
double elementary_acosh(double x); /* NaN below 1 */
double elementary_atanh(double x); /* NaN beyond [-1, 1] */
double elementary_log10(double x); /* exact for whole powers of ten */

#endif
