/* The dense kernels under CHOLMOD: right to rounding, the same bits in every set, and found before a library's. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cholmod.h>
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/dense_blas.h"
#include "solver/dense_kernels.h"
#include "tests/next_number.h"

enum { MOST = 300, LD = MOST + 5 };

typedef struct Set {
    const char *name;
    const DenseKernels *kernels;
} Set;

static double a[LD * MOST], b[LD * MOST], c[LD * MOST], expected[LD * MOST], first[LD * MOST];
static const ptrdiff_t sizes[] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 65, 100, 257, MOST};
enum { SIZES = sizeof sizes / sizeof *sizes };

static void fill(double *matrix)
{
    for (int i = 0; i < LD * MOST; i++) matrix[i] = next_number();
}

/* The sets that this processor has. */
static int list_sets(Set *set)
{
    const Set all[] = {{"v2", &dense_kernels_v2}, {"v3", &dense_kernels_v3}, {"v4", &dense_kernels_v4}};
    int count = 0;
    for (int i = 0; i < 3; i++)
        if (kernels_select(all[i].name)) set[count++] = all[i];
    return count;
}

static void naive_product(ptrdiff_t m, ptrdiff_t n, ptrdiff_t k, bool subtract, bool lower)
{
    for (ptrdiff_t j = 0; j < n; j++)
        for (ptrdiff_t i = lower ? j : 0; i < m; i++) {
            double sum = 0.0;
            for (ptrdiff_t p = 0; p < k; p++) sum += a[p * LD + i] * b[p * LD + j];
            expected[j * LD + i] = subtract ? expected[j * LD + i] - sum : sum;
        }
}

static void assert_near(double bound)
{
    for (int i = 0; i < LD * MOST; i++)
        if (!(fabs(c[i] - expected[i]) <= bound)) fail_msg("entry %d: %g instead of %g", i, c[i], expected[i]);
}

static void products(void **state)
{
    (void)state;
    Set set[3];
    int count = list_sets(set);
    for (int trial = 0; trial < 150; trial++) {
        ptrdiff_t m = sizes[rand() % SIZES], n = sizes[rand() % SIZES], k = sizes[rand() % SIZES];
        bool lower = trial % 3 == 0;
        DenseMode mode = trial % 2 ? DENSE_SUBTRACT : DENSE_SET;
        if (lower) n = m;
        fill(a);
        fill(b);
        fill(first);
        memcpy(expected, first, sizeof expected);
        naive_product(m, n, k, mode == DENSE_SUBTRACT, lower);
        for (int s = 0; s < count; s++) {
            memcpy(c, first, sizeof c);
            set[s].kernels->multiply(m, n, k, (DenseIn){a, LD}, (DenseIn){b, LD}, (DenseOut){c, LD}, mode, lower);
            assert_near(1e-13 * (double)(k + 1));
            if (s > 0) assert_memory_equal(c, expected, sizeof c);
            memcpy(expected, c, sizeof c); /* the next set: these very bits */
        }
    }
}

/* A = L L^T with a diagonal that makes it well behaved. */
static void make_definite(ptrdiff_t n)
{
    fill(a);
    for (ptrdiff_t j = 0; j < n; j++)
        for (ptrdiff_t i = 0; i < n; i++)
            b[j * LD + i] = i < j ? 0.0 : i == j ? 4.0 + a[j * LD + i] : 0.1 * a[j * LD + i];
    for (ptrdiff_t j = 0; j < n; j++)
        for (ptrdiff_t i = j; i < n; i++) {
            first[j * LD + i] = 0.0;
            for (ptrdiff_t p = 0; p < n; p++) first[j * LD + i] += b[p * LD + i] * b[p * LD + j];
        }
}

static void factors(void **state)
{
    (void)state;
    Set set[3];
    int count = list_sets(set);
    for (int z = 0; z < SIZES; z++) {
        ptrdiff_t n = sizes[z];
        fill(first);
        make_definite(n);
        memcpy(expected, first, sizeof expected); /* what lies above the diagonal is left alone */
        for (ptrdiff_t j = 0; j < n; j++) memcpy(expected + j * LD + j, b + j * LD + j, (size_t)(n - j) * sizeof *b);
        for (int s = 0; s < count; s++) {
            memcpy(c, first, sizeof c);
            assert_int_equal(set[s].kernels->factor(n, (DenseOut){c, LD}), 0);
            assert_near(1e-12);
            if (s > 0) assert_memory_equal(c, expected, sizeof c);
            memcpy(expected, c, sizeof c);
        }
        for (int s = 0; s < count && n > 0; s++) { /* not definite from row n/2 on */
            memcpy(c, first, sizeof c);
            c[(n / 2) * LD + n / 2] = s == 0 ? -1.0 : NAN;
            assert_int_equal(set[s].kernels->factor(n, (DenseOut){c, LD}), n / 2 + 1);
        }
    }
}

static void solutions(void **state)
{
    (void)state;
    Set set[3];
    int count = list_sets(set);
    for (int trial = 0; trial < 60; trial++) {
        ptrdiff_t m = sizes[rand() % SIZES], n = sizes[rand() % SIZES];
        make_definite(n); /* L in b */
        fill(expected);   /* X */
        memcpy(c, expected, sizeof c);
        for (ptrdiff_t j = 0; j < n; j++)
            for (ptrdiff_t i = 0; i < m; i++) {
                double sum = 0.0;
                for (ptrdiff_t p = 0; p <= j; p++) sum += expected[p * LD + i] * b[p * LD + j];
                c[j * LD + i] = sum;
            }
        memcpy(first, c, sizeof c);
        for (int s = 0; s < count; s++) {
            memcpy(c, first, sizeof c);
            set[s].kernels->solve_right(m, n, (DenseIn){b, LD}, (DenseOut){c, LD});
            assert_near(1e-11);
            if (s > 0) assert_memory_equal(c, expected, sizeof c);
            memcpy(expected, c, sizeof c);
        }
    }
}

static void one_right_side(void **state)
{
    (void)state;
    Set set[3];
    int count = list_sets(set);
    for (int z = 0; z < SIZES; z++) {
        ptrdiff_t n = sizes[z], m = sizes[SIZES - 1 - z];
        double x[MOST], y[MOST], sum[4][MOST], before[4][MOST];
        make_definite(n);
        for (int i = 0; i < MOST; i++) x[i] = next_number();
        for (int s = 0; s < count; s++) {
            for (int k = 0; k < 4; k++)
                for (int i = 0; i < MOST; i++) sum[k][i] = 0.25 * x[i];
            set[s].kernels->subtract_times(m, n, (DenseIn){a, LD}, x, sum[0]);
            set[s].kernels->subtract_transposed(m, n, (DenseIn){a, LD}, x, sum[1]);
            set[s].kernels->solve_forward(n, (DenseIn){b, LD}, sum[2]);
            set[s].kernels->solve_backward(n, (DenseIn){b, LD}, sum[3]);
            if (s > 0) assert_memory_equal(sum, before, sizeof sum);
            memcpy(before, sum, sizeof sum);
        }
        for (ptrdiff_t i = 0; i < m; i++) {
            y[i] = 0.25 * x[i];
            for (ptrdiff_t p = 0; p < n; p++) y[i] -= a[p * LD + i] * x[p];
            assert_true(fabs(y[i] - sum[0][i]) < 1e-12);
        }
        for (ptrdiff_t j = 0; j < n; j++) {
            double transposed = 0.25 * x[j], forward = 0.0, backward = 0.0;
            for (ptrdiff_t p = 0; p < m; p++) transposed -= a[j * LD + p] * x[p];
            for (ptrdiff_t p = 0; p < n; p++) {
                forward += b[p * LD + j] * sum[2][p];
                backward += b[j * LD + p] * sum[3][p];
            }
            assert_true(fabs(transposed - sum[1][j]) < 1e-12);
            assert_true(fabs(forward - 0.25 * x[j]) < 1e-12);
            assert_true(fabs(backward - 0.25 * x[j]) < 1e-12);
        }
    }
}

/* The names that CHOLMOD looks up are this program's; calls that it does not make reach the library. */
static void names(void **state)
{
    (void)state;
    const char *name[] = {"dgemm_", "dsyrk_", "dtrsm_", "dpotrf_", "dtrsv_", "dgemv_"};
    Dl_info own, found;
    int version[3];
    assert_true(cholmod_version(version) > 0); /* it brings the library with it */
    dense_blas_start();
    void (*start)(void) = dense_blas_start;
    void *address;
    memcpy(&address, &start, sizeof address);
    assert_true(dladdr(address, &own));
    for (int i = 0; i < 6; i++) {
        void *symbol = dlsym(RTLD_DEFAULT, name[i]);
        assert_non_null(symbol);
        assert_true(dladdr(symbol, &found));
        assert_ptr_equal(found.dli_fbase, own.dli_fbase);
    }
    const int n = 2, one = 1;
    const double two = 2.0, zero = 0.0, p[4] = {1, 2, 3, 4}, q[4] = {5, 6, 7, 8};
    double r[4] = {0}, x[2] = {1, 2}, y[2] = {3, 4}, full[4] = {4, 0, 2, 5};
    int info = -1;
    dgemm_("N", "N", &n, &n, &n, &two, p, &n, q, &n, &zero, r, &n);
    assert_true(r[0] == 46 && r[1] == 68 && r[2] == 62 && r[3] == 92);
    dsyrk_("U", "N", &n, &n, &two, p, &n, &zero, r, &n);
    assert_true(r[0] == 20 && r[2] == 28 && r[3] == 40);
    dgemv_("N", &n, &n, &two, p, &n, x, &one, &zero, y, &one);
    assert_true(y[0] == 14 && y[1] == 20);
    dpotrf_("U", &n, full, &n, &info);
    assert_true(info == 0 && full[0] == 2 && full[2] == 1 && full[3] == 2);
    dtrsv_("U", "N", "N", &n, full, &n, x, &one);
    assert_true(x[1] == 1 && x[0] == 0);
    dtrsm_("L", "U", "N", "N", &n, &one, &two, full, &n, y, &n);
    assert_true(y[1] == 20 && y[0] == 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(products), cmocka_unit_test(factors),
                                       cmocka_unit_test(solutions), cmocka_unit_test(one_right_side),
                                       cmocka_unit_test(names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
