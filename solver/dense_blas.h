/* The functions of BLAS and LAPACK that CHOLMOD calls, billow's own: CHOLMOD finds them in the program before it looks
 * into a library. A BLAS library made for speed has other bits on other processors, and the plain one takes half of the
 * phase; these are fast and have the same bits everywhere. Calls that CHOLMOD does not make go on to the library.
 *
 * Arguments as in BLAS: all by address, matrices column by column. */
#ifndef BILLOW_DENSE_BLAS_H
#define BILLOW_DENSE_BLAS_H

/* Chooses the kernels of this processor (BILLOW_KERNELS as for the elements'). Before the first of the others. */
void dense_blas_start(void);

void dgemm_(const char *trans_a, const char *trans_b, const int *m, const int *n, const int *k, const double *alpha,
            const double *a, const int *lda, const double *b, const int *ldb, const double *beta, double *c,
            const int *ldc);
void dsyrk_(const char *triangle, const char *trans, const int *n, const int *k, const double *alpha, const double *a,
            const int *lda, const double *beta, double *c, const int *ldc);
void dtrsm_(const char *side, const char *triangle, const char *trans, const char *diagonal, const int *m, const int *n,
            const double *alpha, const double *a, const int *lda, double *b, const int *ldb);
void dpotrf_(const char *triangle, const int *n, double *a, const int *lda, int *info);
void dtrsv_(const char *triangle, const char *trans, const char *diagonal, const int *n, const double *a,
            const int *lda, double *x, const int *step);
void dgemv_(const char *trans, const int *m, const int *n, const double *alpha, const double *a, const int *lda,
            const double *x, const int *step_x, const double *beta, double *y, const int *step_y);

#endif
