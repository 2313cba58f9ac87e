/* Caps over free-edge loops: fans about the loop's mean point, their geometry, volume, gradient and force. */
#include <math.h>
#include <string.h>

#include "airbag/surface_internal.h"
#include "solver/memory.h"

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void relative(const double *x, int32_t node, const double origin[3], double r[3])
{
    for (int k = 0; k < 3; k++) r[k] = x[3 * (size_t)node + (size_t)k] - origin[k];
}

/* Mean of the nodes relative to origin. */
static void fan_centre(const int32_t *node, int count, const double *x, const double origin[3], double centre[3])
{
    for (int k = 0; k < 3; k++) {
        centre[k] = 0.0;
        for (int i = 0; i < count; i++) centre[k] += x[3 * (size_t)node[i] + (size_t)k] - origin[k];
        centre[k] /= count;
    }
}

/* Sum of r_i x r_(i+1) about origin: twice the area vector of any surface over the closed loop. */
static void fan_moment(const int32_t *node, int count, const double *x, const double origin[3], double moment[3])
{
    double last[3], next[3], part[3];
    for (int k = 0; k < 3; k++) moment[k] = 0.0;
    relative(x, node[count - 1], origin, last);
    for (int i = 0; i < count; i++) {
        relative(x, node[i], origin, next);
        cross(last, next, part);
        for (int k = 0; k < 3; k++) moment[k] += part[k];
        memcpy(last, next, sizeof last);
    }
}

double fan_volume(const int32_t *node, int count, const double *x, const double origin[3])
{
    double centre[3], moment[3];
    fan_centre(node, count, x, origin, centre);
    fan_moment(node, count, x, origin, moment);
    return dot(centre, moment) / 6.0;
}

void cap_measure(SurfaceCap *cap, const double *x)
{
    static const double zero[3] = {0.0, 0.0, 0.0};
    double moment[3], r[3], radius = 0.0, off = 0.0;
    fan_centre(cap->node, cap->count, x, zero, cap->centre);
    fan_moment(cap->node, cap->count, x, cap->centre, moment);
    double length = sqrt(dot(moment, moment));
    for (int i = 0; i < cap->count; i++) {
        relative(x, cap->node[i], cap->centre, r);
        radius = fmax(radius, sqrt(dot(r, r)));
        if (length > 0.0) off = fmax(off, fabs(dot(r, moment)) / length);
    }
    cap->area = 0.5 * length;
    cap->size = 2.0 * radius;
    cap->planarity = off > 1e-12 * cap->size ? off / cap->size : 0.0;
    for (int k = 0; k < 3; k++) /* these are for reading: no rounding errors next to zero */
        if (fabs(cap->centre[k]) < 1e-9 * cap->size) cap->centre[k] = 0.0;
}

bool loop_is_narrow(const int32_t *node, int count, const double *x)
{
    static const double narrow = 1e-3, zero[3] = {0.0, 0.0, 0.0}; /* a circle has 0.08, a slit of 1:250 has 0.001 */
    double centre[3], last[3], next[3], part[3], area = 0.0, length = 0.0;
    fan_centre(node, count, x, zero, centre);
    relative(x, node[count - 1], centre, last);
    for (int i = 0; i < count; i++) {
        relative(x, node[i], centre, next);
        cross(last, next, part);
        area += 0.5 * sqrt(dot(part, part));
        for (int k = 0; k < 3; k++) part[k] = next[k] - last[k];
        length += sqrt(dot(part, part));
        memcpy(last, next, sizeof last);
    }
    return area < narrow * length * length;
}

double surface_cap_volume(const SurfaceClosure *closure, const double *x, const double origin[3])
{
    double volume = 0.0;
    for (int c = 0; c < closure->cap_count; c++)
        volume += fan_volume(closure->caps[c].node, closure->caps[c].count, x, origin);
    return volume;
}

/* V = c . S / 6 with c = sum r_i / n, S = sum r_i x r_(i+1):  dV/dr_i = ((r_(i+1) - r_(i-1)) x c + S / n) / 6. */
void surface_cap_gradient(const SurfaceClosure *closure, const double *x, const double origin[3], double scale,
                          double *f)
{
    for (int c = 0; c < closure->cap_count; c++) {
        const int32_t *node = closure->caps[c].node;
        int count = closure->caps[c].count;
        double centre[3], moment[3], chord[3], part[3];
        fan_centre(node, count, x, origin, centre);
        fan_moment(node, count, x, origin, moment);
        for (int i = 0; i < count; i++) {
            size_t next = 3 * (size_t)node[(i + 1) % count], last = 3 * (size_t)node[(i + count - 1) % count];
            for (int k = 0; k < 3; k++) chord[k] = x[next + (size_t)k] - x[last + (size_t)k];
            cross(chord, centre, part);
            for (int k = 0; k < 3; k++)
                f[3 * (size_t)node[i] + (size_t)k] += scale / 6.0 * (part[k] + moment[k] / count);
        }
    }
}

/* Each fan triangle gives a third of its area vector to each corner, the centre's third goes to all nodes alike. */
void surface_cap_force(const SurfaceClosure *closure, const double *x, double scale, double *f)
{
    static const double zero[3] = {0.0, 0.0, 0.0};
    for (int c = 0; c < closure->cap_count; c++) {
        const int32_t *node = closure->caps[c].node;
        int count = closure->caps[c].count;
        double centre[3], moment[3], last[3], next[3], part[3];
        fan_centre(node, count, x, zero, centre);
        fan_moment(node, count, x, centre, moment);
        relative(x, node[count - 1], centre, last);
        for (int i = 0; i < count; i++) {
            double *before = f + 3 * (size_t)node[(i + count - 1) % count], *here = f + 3 * (size_t)node[i];
            relative(x, node[i], centre, next);
            cross(last, next, part);
            for (int k = 0; k < 3; k++) {
                before[k] += scale / 6.0 * part[k];
                here[k] += scale / 6.0 * (part[k] + moment[k] / count);
            }
            memcpy(last, next, sizeof last);
        }
    }
}

void surface_closure_free(SurfaceClosure *closure)
{
    memory_free(closure->caps);
    memory_free(closure->node_store);
    memset(closure, 0, sizeof *closure);
}
