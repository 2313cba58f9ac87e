/* GMRES by modified Gram-Schmidt and Givens rotations. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "solver/gmres.h"

enum { WIDTH = GMRES_WIDTH };

/* The small problem: column m of the Hessenberg matrix, turned to a triangle. */
typedef struct Triangle {
    double h[WIDTH + 1][WIDTH];
    double right[WIDTH + 1], cosine[WIDTH], sine[WIDTH];
} Triangle;

static double product(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Makes q orthogonal to the m + 1 directions before it, of length 1; false if nothing is left of it. */
static bool orthogonalise(Triangle *t, int n, int m, const double *basis, double *q)
{
    for (int k = 0; k <= m; k++) {
        const double *b = basis + (size_t)k * (size_t)n;
        double along = t->h[k][m] = product(n, q, b);
        for (int i = 0; i < n; i++) q[i] -= along * b[i];
    }
    double length = t->h[m + 1][m] = sqrt(product(n, q, q));
    if (!(length > 0.0)) return false;
    for (int i = 0; i < n; i++) q[i] /= length;
    return true;
}

/* Turns the new column to the triangle's; what is left of the right side. */
static double rotate(Triangle *t, int m)
{
    for (int k = 0; k < m; k++) {
        double upper = t->cosine[k] * t->h[k][m] + t->sine[k] * t->h[k + 1][m];
        t->h[k + 1][m] = t->cosine[k] * t->h[k + 1][m] - t->sine[k] * t->h[k][m];
        t->h[k][m] = upper;
    }
    double length = sqrt(t->h[m][m] * t->h[m][m] + t->h[m + 1][m] * t->h[m + 1][m]);
    t->cosine[m] = length > 0.0 ? t->h[m][m] / length : 1.0;
    t->sine[m] = length > 0.0 ? t->h[m + 1][m] / length : 0.0;
    t->h[m][m] = length;
    t->right[m + 1] = -t->sine[m] * t->right[m];
    t->right[m] *= t->cosine[m];
    return fabs(t->right[m + 1]);
}

static void substitute(const Triangle *t, int n, int m, const double *direction, double *x)
{
    double y[WIDTH];
    memset(x, 0, (size_t)n * sizeof *x);
    for (int k = m - 1; k >= 0; k--) {
        y[k] = t->right[k];
        for (int j = k + 1; j < m; j++) y[k] -= t->h[k][j] * y[j];
        y[k] = t->h[k][k] > 0.0 ? y[k] / t->h[k][k] : 0.0;
        for (int i = 0; i < n; i++) x[i] += y[k] * direction[(size_t)k * (size_t)n + (size_t)i];
    }
}

int gmres_solve(const GmresProblem *problem, const double *right, double tolerance, double *work, double *x)
{
    const int n = problem->count;
    double *basis = work, *direction = work + (size_t)(WIDTH + 1) * (size_t)n;
    Triangle t = {0};
    double size = t.right[0] = sqrt(product(n, right, right)), left = size;
    int m = 0;
    for (int i = 0; i < n && size > 0.0; i++) basis[i] = right[i] / size;
    while (m < WIDTH && left > tolerance * size) {
        double *q = basis + (size_t)(m + 1) * (size_t)n, *z = direction + (size_t)m * (size_t)n;
        if (problem->precondition(problem->user, basis + (size_t)m * (size_t)n, z)) return -1;
        if (problem->apply(problem->user, z, q)) return -1;
        bool more = orthogonalise(&t, n, m, basis, q);
        left = rotate(&t, m++);
        if (!more) break;
    }
    substitute(&t, n, m, direction, x);
    return 0;
}
