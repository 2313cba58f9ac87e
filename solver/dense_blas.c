/* BLAS's and LAPACK's names over the dense kernels. */
#define _GNU_SOURCE
#include "solver/dense_blas.h"

#include <dlfcn.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/dense_kernels.h"

/* BLAS's interface has no room for it, so it is the one thing here that outlives a call. */
static const DenseKernels *kernels = &dense_kernels_v2;

void dense_blas_start(void)
{
    const KernelTable *table = kernels_select(NULL);
    int level = table ? table->level : 2;
    kernels = level >= 4 ? &dense_kernels_v4 : level == 3 ? &dense_kernels_v3 : &dense_kernels_v2;
}

/* The library's function of that name, behind this program's. */
static void find_library_function(const char *name, void *function)
{
    void *symbol = dlsym(RTLD_NEXT, name);
    memcpy(function, &symbol, sizeof symbol);
}

static bool transposes(const char *trans)
{
    return *trans == 'T' || *trans == 'C';
}

void dgemm_(const char *trans_a, const char *trans_b, const int *m, const int *n, const int *k, const double *alpha,
            const double *a, const int *lda, const double *b, const int *ldb, const double *beta, double *c,
            const int *ldc)
{
    if (*trans_a == 'N' && transposes(trans_b) && *alpha == 1.0 && *beta == 0.0) {
        kernels->multiply(*m, *n, *k, (DenseIn){a, *lda}, (DenseIn){b, *ldb}, (DenseOut){c, *ldc}, DENSE_SET, false);
        return;
    }
    void (*library)(const char *, const char *, const int *, const int *, const int *, const double *, const double *,
                    const int *, const double *, const int *, const double *, double *, const int *);
    find_library_function("dgemm_", &library);
    library(trans_a, trans_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc);
}

void dsyrk_(const char *triangle, const char *trans, const int *n, const int *k, const double *alpha, const double *a,
            const int *lda, const double *beta, double *c, const int *ldc)
{
    if (*triangle == 'L' && *trans == 'N' && *alpha == 1.0 && *beta == 0.0) {
        kernels->multiply(*n, *n, *k, (DenseIn){a, *lda}, (DenseIn){a, *lda}, (DenseOut){c, *ldc}, DENSE_SET, true);
        return;
    }
    void (*library)(const char *, const char *, const int *, const int *, const double *, const double *, const int *,
                    const double *, double *, const int *);
    find_library_function("dsyrk_", &library);
    library(triangle, trans, n, k, alpha, a, lda, beta, c, ldc);
}

void dtrsm_(const char *side, const char *triangle, const char *trans, const char *diagonal, const int *m, const int *n,
            const double *alpha, const double *a, const int *lda, double *b, const int *ldb)
{
    if (*side == 'R' && *triangle == 'L' && transposes(trans) && *diagonal == 'N' && *alpha == 1.0) {
        kernels->solve_right(*m, *n, (DenseIn){a, *lda}, (DenseOut){b, *ldb});
        return;
    }
    void (*library)(const char *, const char *, const char *, const char *, const int *, const int *, const double *,
                    const double *, const int *, double *, const int *);
    find_library_function("dtrsm_", &library);
    library(side, triangle, trans, diagonal, m, n, alpha, a, lda, b, ldb);
}

void dpotrf_(const char *triangle, const int *n, double *a, const int *lda, int *info)
{
    if (*triangle == 'L') {
        *info = (int)kernels->factor(*n, (DenseOut){a, *lda});
        return;
    }
    void (*library)(const char *, const int *, double *, const int *, int *);
    find_library_function("dpotrf_", &library);
    library(triangle, n, a, lda, info);
}

void dtrsv_(const char *triangle, const char *trans, const char *diagonal, const int *n, const double *a,
            const int *lda, double *x, const int *step)
{
    if (*triangle == 'L' && *diagonal == 'N' && *step == 1) {
        if (transposes(trans))
            kernels->solve_backward(*n, (DenseIn){a, *lda}, x);
        else
            kernels->solve_forward(*n, (DenseIn){a, *lda}, x);
        return;
    }
    void (*library)(const char *, const char *, const char *, const int *, const double *, const int *, double *,
                    const int *);
    find_library_function("dtrsv_", &library);
    library(triangle, trans, diagonal, n, a, lda, x, step);
}

void dgemv_(const char *trans, const int *m, const int *n, const double *alpha, const double *a, const int *lda,
            const double *x, const int *step_x, const double *beta, double *y, const int *step_y)
{
    if (*alpha == -1.0 && *beta == 1.0 && *step_x == 1 && *step_y == 1) {
        if (transposes(trans))
            kernels->subtract_transposed(*m, *n, (DenseIn){a, *lda}, x, y);
        else
            kernels->subtract_times(*m, *n, (DenseIn){a, *lda}, x, y);
        return;
    }
    void (*library)(const char *, const int *, const int *, const double *, const double *, const int *, const double *,
                    const int *, const double *, double *, const int *);
    find_library_function("dgemv_", &library);
    library(trans, m, n, alpha, a, lda, x, step_x, beta, y, step_y);
}
