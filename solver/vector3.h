/* Small vectors of three components, 3 x 3 matrices (row-major) and unit quaternions (w, x, y, z). */
#ifndef BILLOW_VECTOR3_H
#define BILLOW_VECTOR3_H

#include <math.h>

static inline double vector3_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double vector3_norm(const double a[3])
{
    return sqrt(vector3_dot(a, a));
}

/* out = a x b; out may not be a or b. */
static inline void vector3_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void vector3_subtract(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

/* Scales a to length 1 and returns its length before; a zero vector stays. */
static inline double vector3_normalize(double a[3])
{
    double norm = vector3_norm(a);
    if (norm > 0) {
        for (int i = 0; i < 3; i++) a[i] /= norm;
    }
    return norm;
}

/* out = m a; out may not be a. */
static inline void matrix3_apply(const double m[9], const double a[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = vector3_dot(m + 3 * i, a);
}

/* out = transposed(m) a; out may not be a. */
static inline void matrix3_apply_transposed(const double m[9], const double a[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = m[i] * a[0] + m[3 + i] * a[1] + m[6 + i] * a[2];
}

/* The rotation matrix of a unit quaternion. */
static inline void quaternion_matrix(const double q[4], double m[9])
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    m[0] = 1 - 2 * (y * y + z * z), m[1] = 2 * (x * y - w * z), m[2] = 2 * (x * z + w * y);
    m[3] = 2 * (x * y + w * z), m[4] = 1 - 2 * (x * x + z * z), m[5] = 2 * (y * z - w * x);
    m[6] = 2 * (x * z - w * y), m[7] = 2 * (y * z + w * x), m[8] = 1 - 2 * (x * x + y * y);
}

/* out = p q; out may not be p or q. */
static inline void quaternion_multiply(const double p[4], const double q[4], double out[4])
{
    out[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    out[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    out[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    out[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

#endif
