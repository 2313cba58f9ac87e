/* Dense products and factors for CHOLMOD's supernodes, once per instruction set with the same bits (docs/theory.md,
 * Static equilibrium). Matrices lie column by column, ld entries from one column to the next. Private to
 * solver/dense_*.c. */
#ifndef BILLOW_DENSE_KERNELS_H
#define BILLOW_DENSE_KERNELS_H

#include <stdbool.h>
#include <stddef.h>

/* A matrix that is read, and one that is written. */
typedef struct DenseIn {
    const double *at;
    ptrdiff_t ld;
} DenseIn;

typedef struct DenseOut {
    double *at;
    ptrdiff_t ld;
} DenseOut;

typedef enum DenseMode {
    DENSE_SET,     /* C = A B^T */
    DENSE_SUBTRACT /* C -= A B^T */
} DenseMode;

typedef struct DenseKernels {
    /* C (m x n) from A (m x k) and B (n x k). lower: only entries on and below the diagonal are touched. Each entry is
     * a sum in the order of k, by blocks of 256 (eq. Q19). */
    void (*multiply)(ptrdiff_t m, ptrdiff_t n, ptrdiff_t k, DenseIn a, DenseIn b, DenseOut c, DenseMode mode,
                     bool lower);
    /* The lower triangle of A (n x n) becomes L of A = L L^T. 0, or the number from 1 of the first pivot that is not
     * positive. */
    ptrdiff_t (*factor)(ptrdiff_t n, DenseOut a);
    /* B (m x n) becomes the X of X L^T = B, L (n x n). */
    void (*solve_right)(ptrdiff_t m, ptrdiff_t n, DenseIn l, DenseOut b);
    /* x (n) becomes the solution of L y = x, or of L^T y = x. */
    void (*solve_forward)(ptrdiff_t n, DenseIn l, double *x);
    void (*solve_backward)(ptrdiff_t n, DenseIn l, double *x);
    /* y (m) -= A x (n), and y (n) -= A^T x (m). */
    void (*subtract_times)(ptrdiff_t m, ptrdiff_t n, DenseIn a, const double *x, double *y);
    void (*subtract_transposed)(ptrdiff_t m, ptrdiff_t n, DenseIn a, const double *x, double *y);
} DenseKernels;

extern const DenseKernels dense_kernels_v2, dense_kernels_v3, dense_kernels_v4;

#endif
