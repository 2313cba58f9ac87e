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
    double share = (x - curve->x[i]) / (curve->x[i + 1] - curve->x[i]);
    return curve->y[i] + share * (curve->y[i + 1] - curve->y[i]);
}

void curve_fill_area(Curve *curve)
{
    curve->area[0] = 0.0;
    for (int i = 1; i < curve->count; i++) {
        double width = curve->x[i] - curve->x[i - 1];
        curve->area[i] = curve->area[i - 1] + 0.5 * width * (curve->y[i] + curve->y[i - 1]);
    }
}

double curve_value(const Curve *curve, double x)
{
    return value_in_segment(curve, find_segment(curve, x), x);
}

double curve_slope(const Curve *curve, double x)
{
    int i = find_segment(curve, x);
    if (i < 0 || i >= curve->count - 1) return 0.0;
    return (curve->y[i + 1] - curve->y[i]) / (curve->x[i + 1] - curve->x[i]);
}

/* The trapezoid inside one segment is computed from its ends: a difference of two running areas would lose the digits
 * of a short step late on a long curve. */
double curve_integral(const Curve *curve, double a, double b)
{
    if (b < a) return -curve_integral(curve, b, a);
    int ia = find_segment(curve, a), ib = find_segment(curve, b);
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
