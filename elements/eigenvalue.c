/* The largest eigenvalue of a small symmetric matrix by cyclic Jacobi rotations. */
#include <math.h>

#include "elements/geometry.h"

static double off_diagonal(int n, const double *a)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) sum += a[i * n + j] * a[i * n + j];
    return sum;
}

static void rotate(int n, double *a, int p, int q)
{
    double apq = a[p * n + q];
    if (apq == 0.0) return;
    double theta = (a[q * n + q] - a[p * n + p]) / (2.0 * apq);
    double t = (theta >= 0.0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
    double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < n; k++) {
        double akp = a[k * n + p], akq = a[k * n + q];
        a[k * n + p] = c * akp - s * akq;
        a[k * n + q] = s * akp + c * akq;
    }
    for (int k = 0; k < n; k++) {
        double apk = a[p * n + k], aqk = a[q * n + k];
        a[p * n + k] = c * apk - s * aqk;
        a[q * n + k] = s * apk + c * aqk;
    }
}

double geometry_largest_eigenvalue(int n, double *matrix)
{
    double scale = 0.0;
    for (int i = 0; i < n * n; i++) scale += matrix[i] * matrix[i];
    for (int sweep = 0; sweep < 40 && off_diagonal(n, matrix) > 1e-28 * scale; sweep++)
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) rotate(n, matrix, p, q);
    double largest = matrix[0];
    for (int i = 1; i < n; i++) largest = matrix[i * n + i] > largest ? matrix[i * n + i] : largest;
    return largest;
}
