/* Load curves: value, slope, exact integral and corners of a piecewise linear function. */
#include "solver/curve.h"

#include <math.h>

/* Largest i with x[i] <= x, -1 left of the first point. */
static int find_segment(const Curve *curve, double x)
{
    int low = -1, high = curve->count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (curve->x[middle] <= x) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/* y in segment i (as find_segment gives it); exact at the points, so that a curve meets its table. */
static double value_in_segment(const Curve *curve, int i, double x)
{
    if (i < 0) return curve->y[0];
    if (i >= curve->count - 1) return curve->y[curve->count - 1];
    double width = curve->x[i + 1] - curve->x[i], share = (x - curve->x[i]) / width;
    double line = curve->y[i] + share * (curve->y[i + 1] - curve->y[i]);
    if (!curve->bend) return line;
    double rest = 1.0 - share; /* the chord less the cubics that have the bends at the ends */
    return line -
           width * width / 6.0 *
               (rest * (1.0 - rest * rest) * curve->bend[i] + share * (1.0 - share * share) * curve->bend[i + 1]);
}

/* Integral of y from a to b within segment i of a spline by Simpson's rule, which is exact for a cubic. */
static double spline_integral(const Curve *curve, int i, double a, double b)
{
    double ends = value_in_segment(curve, i, a) + value_in_segment(curve, i, b);
    return (b - a) / 6.0 * (ends + 4.0 * value_in_segment(curve, i, 0.5 * (a + b)));
}

void curve_fill_area(Curve *curve)
{
    curve->area[0] = 0.0;
    for (int i = 1; i < curve->count; i++) {
        double width = curve->x[i] - curve->x[i - 1];
        curve->area[i] = curve->area[i - 1] + 0.5 * width * (curve->y[i] + curve->y[i - 1]);
        if (curve->bend) curve->area[i] -= width * width * width / 24.0 * (curve->bend[i] + curve->bend[i - 1]);
    }
}

/* Continuous slopes: a tridiagonal system for the bends, none at the ends. */
void curve_fill_spline(Curve *curve, double *work)
{
    int last = curve->count - 1;
    double *bend = curve->bend, *x = curve->x, *y = curve->y;
    bend[0] = work[0] = 0.0;
    for (int i = 1; i < last; i++) {
        double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
        double pivot = 2.0 * (left + right) - left * work[i - 1];
        work[i] = right / pivot;
        double kink = 6.0 * ((y[i + 1] - y[i]) / right - (y[i] - y[i - 1]) / left);
        bend[i] = (kink - left * bend[i - 1]) / pivot;
    }
    bend[last] = 0.0;
    for (int i = last - 1; i > 0; i--) bend[i] -= work[i] * bend[i + 1];
    curve_fill_area(curve);
}

double curve_value(const Curve *curve, double x)
{
    return value_in_segment(curve, find_segment(curve, x), x);
}

double curve_slope(const Curve *curve, double x)
{
    int i = find_segment(curve, x);
    if (i < 0 || i >= curve->count - 1) return 0.0;
    double width = curve->x[i + 1] - curve->x[i], slope = (curve->y[i + 1] - curve->y[i]) / width;
    if (!curve->bend) return slope;
    double share = (x - curve->x[i]) / width, rest = 1.0 - share;
    return slope - width / 6.0 *
                       ((3.0 * rest * rest - 1.0) * curve->bend[i] + (1.0 - 3.0 * share * share) * curve->bend[i + 1]);
}

/* The trapezoid inside one segment is computed from its ends: a difference of two running areas would lose the digits
 * of a short step late on a long curve. */
double curve_integral(const Curve *curve, double a, double b)
{
    if (b < a) return -curve_integral(curve, b, a);
    int ia = find_segment(curve, a), ib = find_segment(curve, b);
    if (curve->bend) {
        if (ia == ib) return spline_integral(curve, ia, a, b);
        double head = spline_integral(curve, ia, a, curve->x[ia + 1]),
               tail = spline_integral(curve, ib, curve->x[ib], b);
        return head + (curve->area[ib] - curve->area[ia + 1]) + tail;
    }
    double ya = value_in_segment(curve, ia, a), yb = value_in_segment(curve, ib, b);
    if (ia == ib) return 0.5 * (b - a) * (ya + yb);
    double head = 0.5 * (curve->x[ia + 1] - a) * (ya + curve->y[ia + 1]);
    double tail = 0.5 * (b - curve->x[ib]) * (curve->y[ib] + yb);
    return head + (curve->area[ib] - curve->area[ia + 1]) + tail;
}

double curve_next_corner(const Curve *curve, double x)
{
    int i = find_segment(curve, x);
    return i < curve->count - 1 ? curve->x[i + 1] : INFINITY;
}
