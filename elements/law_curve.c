/* Stress-strain curves: pieces from points, the meeting of loading and unloading, bounds of the tangent. */
#include "elements/law_curve.h"

#include <math.h>

#include "solver/elementary.h"

size_t law_curve_size(int points)
{
    return 4 * ((size_t)points + 2); /* a piece to the left, and perhaps a point at zero strain */
}

static double largest_stress(int points, const double *y)
{
    double largest = 0.0;
    for (int i = 0; i < points; i++) largest = fmax(largest, fabs(y[i]));
    return largest;
}

/* y at x between the points, or the end values. */
static double interpolate(int points, const double *x, const double *y, double at)
{
    if (at <= x[0]) return y[0];
    for (int i = 1; i < points; i++)
        if (at <= x[i]) return y[i - 1] + (y[i] - y[i - 1]) * ((at - x[i - 1]) / (x[i] - x[i - 1]));
    return y[points - 1];
}

CurveFault law_curve_check(int points, const double *x, const double *y, bool shear, int *point)
{
    *point = 0;
    if (points < 2) return CURVE_TOO_SHORT;
    double size = largest_stress(points, y), nearly = 1e-9 * size;
    for (int i = 1; i < points; i++) {
        *point = i;
        if (y[i] < y[i - 1]) return CURVE_FALLS;
    }
    *point = 0;
    if (!(x[0] <= 0.0 && x[points - 1] > 0.0) || fabs(interpolate(points, x, y, 0.0)) > nearly) return CURVE_OFF_ORIGIN;
    if (!(y[points - 1] > nearly)) return CURVE_FLAT;
    for (int i = 0; shear && i < points && x[0] < 0.0; i++) {
        *point = i;
        if (fabs(x[i]) > fmin(-x[0], x[points - 1])) continue;
        if (fabs(interpolate(points, x, y, -x[i]) + y[i]) > 1e-6 * size) return CURVE_NOT_ODD;
    }
    return CURVE_FINE;
}

/* Starts an empty curve in its storage. */
static void open_curve(LawCurve *curve, int capacity, double *storage)
{
    curve->count = 0;
    curve->x = storage;
    curve->y = storage + capacity;
    curve->slope = storage + 2 * capacity;
    curve->area = storage + 3 * capacity;
}

static void add_piece(LawCurve *curve, double x, double y)
{
    curve->x[curve->count] = x;
    curve->y[curve->count++] = y;
}

/* Slopes between the points of pieces 1 .. and areas from zero strain, which is one of the points. Piece 0 repeats the
 * first point, with the slope to its right or, cut off, with none. */
static void close_curve(LawCurve *curve, bool tension)
{
    int last = curve->count - 1, zero = 1;
    double *x = curve->x, *y = curve->y, *area = curve->area;
    for (int i = 1; i < last; i++) curve->slope[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    curve->slope[last] = curve->slope[last - 1];
    curve->slope[0] = tension ? 0.0 : curve->slope[1];
    while (x[zero] < 0.0) zero++;
    area[zero] = 0.0;
    for (int i = zero + 1; i <= last; i++) area[i] = area[i - 1] + 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
    for (int i = zero - 1; i >= 1; i--) area[i] = area[i + 1] - 0.5 * (y[i] + y[i + 1]) * (x[i + 1] - x[i]);
    area[0] = area[1];
}

void law_curve_make(LawCurve *curve, int points, const double *x, const double *y, double share, bool tension,
                    double *storage)
{
    open_curve(curve, points + 2, storage);
    bool origin = false, first = true;
    for (int i = 0; i < points; i++) {
        if (tension && x[i] < 0.0) continue;
        if (!origin && x[i] >= 0.0) {
            if (first) add_piece(curve, 0.0, 0.0);
            add_piece(curve, 0.0, 0.0);
            origin = true;
            first = false;
            if (x[i] == 0.0) continue;
        }
        if (first) add_piece(curve, x[i], share * y[i]);
        add_piece(curve, x[i], share * y[i]);
        first = false;
    }
    close_curve(curve, tension);
}

void law_curve_make_line(LawCurve *curve, double modulus, bool tension, double *storage)
{
    open_curve(curve, 3, storage);
    add_piece(curve, 0.0, 0.0);
    add_piece(curve, 0.0, 0.0);
    curve->slope[0] = tension ? 0.0 : modulus;
    curve->slope[1] = modulus;
    curve->area[0] = curve->area[1] = 0.0;
}

static int find_piece(const LawCurve *curve, double strain)
{
    int piece = 0;
    while (piece + 1 < curve->count && strain > curve->x[piece + 1]) piece++;
    return piece;
}

double law_curve_stress(const LawCurve *curve, double strain)
{
    int i = find_piece(curve, strain);
    return curve->y[i] + curve->slope[i] * (strain - curve->x[i]);
}

double law_curve_area(const LawCurve *curve, double strain)
{
    int i = find_piece(curve, strain);
    double way = strain - curve->x[i];
    return curve->area[i] + (curve->y[i] + 0.5 * curve->slope[i] * way) * way;
}

double law_curve_steepest(const LawCurve *curve)
{
    double slope = 0.0;
    for (int i = 0; i < curve->count; i++) slope = fmax(slope, curve->slope[i]);
    return slope;
}

static void scale_curve(LawCurve *curve, double factor)
{
    for (int i = 0; i < curve->count; i++) {
        curve->y[i] *= factor;
        curve->slope[i] *= factor;
        curve->area[i] *= factor;
    }
}

void law_curves_scale(CurveLaw *law, double factor)
{
    for (int d = 0; d < CURVE_DIRECTIONS; d++) {
        scale_curve(&law->load[d], factor);
        scale_curve(&law->unload[d], factor);
        law->meet_area[d] *= factor;
    }
}

double law_curve_meet(CurveLaw *law, int direction)
{
    LawCurve *unload = &law->unload[direction];
    int last = unload->count - 1;
    double strain = unload->x[last], factor = law_curve_stress(&law->load[direction], strain) / unload->y[last];
    law->meet_strain[direction] = strain;
    law->meet_area[direction] = law_curve_area(&law->load[direction], strain);
    scale_curve(unload, factor);
    return factor;
}

/* Points of both curves in (0, meeting strain], in rising order: the next one after x. */
static double next_point(const CurveLaw *law, int direction, double x)
{
    const LawCurve *curves[] = {&law->load[direction], &law->unload[direction]};
    double next = law->meet_strain[direction];
    for (int c = 0; c < 2; c++)
        for (int i = 0; i < curves[c]->count; i++)
            if (curves[c]->x[i] > x && curves[c]->x[i] < next) next = curves[c]->x[i];
    return next;
}

double law_curve_crossing(const CurveLaw *law, int direction)
{
    double x = 0.0;
    while (x < law->meet_strain[direction]) {
        x = next_point(law, direction, x);
        double load = law_curve_stress(&law->load[direction], x), unload = law_curve_stress(&law->unload[direction], x);
        if (unload > load * (1.0 + 1e-9)) return x;
    }
    return -1.0;
}

/* f^2/(2 W): a mean of the slopes up to the strain, weighted by the stress; 0 where there is no stress. */
static double mean_modulus(const LawCurve *load, double strain)
{
    double f = law_curve_stress(load, strain), area = law_curve_area(load, strain);
    return area > 0.0 ? f * f / (2.0 * area) : 0.0;
}

double law_curve_tangent(const CurveLaw *law, int direction)
{
    const LawCurve *load = &law->load[direction], *unload = &law->unload[direction];
    double steepest = law_curve_steepest(load), bound = steepest, largest = load->slope[load->count - 1], x = 0.0;
    if (unload->count == 0) return bound;
    for (int i = 0; i < load->count; i++)
        if (load->x[i] > 0.0) largest = fmax(largest, mean_modulus(load, load->x[i]));
    while (x < law->meet_strain[direction]) {
        double left = x, right = next_point(law, direction, x), middle = 0.5 * (left + right);
        double f1 = law_curve_stress(load, right), u1 = law_curve_stress(unload, right),
               u0 = law_curve_stress(unload, left);
        double f0 = law_curve_stress(load, left), f_slope = load->slope[find_piece(load, middle)],
               u_slope = unload->slope[find_piece(unload, middle)];
        x = right;
        if (!(f1 > 0.0)) continue;
        double at_right = u1 / f1, at_left = f0 > 0.0 ? u0 / f0 : u_slope / f_slope;
        double mean_right = mean_modulus(load, right), mean_left = f0 > 0.0 ? mean_modulus(load, left) : mean_right;
        double steeper = fmax(u_slope - fmin(at_left, at_right) * f_slope, 0.0);
        bound = fmax(bound, fmax(at_left, at_right) * steepest + largest / fmin(mean_left, mean_right) * steeper);
    }
    return bound;
}

/* Share of the energy that comes back: integral of w/(w + q (1 - w)) over w from 0 to 1. */
static double returned_share(double q)
{
    double d = 1.0 - q;
    if (fabs(d) < 1e-3) return 0.5 + d / 6.0 + d * d / 12.0; /* series about q = 1 */
    return (d + q * elementary_log(q)) / (d * d);
}

double law_softening(double h)
{
    if (!(h > 0.0)) return 0.0;
    double low = 1e-12, high = 1e12;
    for (int i = 0; i < 200; i++) { /* the share falls with q; bisection on its logarithm */
        double middle = sqrt(low * high);
        if (returned_share(middle) > 1.0 - h)
            low = middle;
        else
            high = middle;
    }
    return sqrt(low * high);
}

double law_softening_stiffer(double q)
{
    return q == 0.0 ? 1.0 : q < 0.25 ? 1.125 / (1.0 - q) : 1.0 + 2.0 * q;
}
