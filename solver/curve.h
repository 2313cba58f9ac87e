/* Load curves of *DEFINE_CURVE: piecewise linear or a natural cubic spline, constant beyond the last points. */
#ifndef BILLOW_CURVE_H
#define BILLOW_CURVE_H

#include <stddef.h>

typedef struct Curve {
    int id;
    int sidr;      /* 0 transient only, 1 dynamic relaxation only, 2 both */
    int count;     /* points, >= 1 */
    double *x, *y; /* abscissae (strictly increasing) and ordinates (count), scaled: SFA (a + OFFA), SFO (o + OFFO) */
    double *area;  /* integral of y from x[0] to x[i] (count) */
    double *bend;  /* NULL: linear; else the second derivatives of the spline at the points (count) */
} Curve;

/* Fills area from x and y (count entries each, area allocated by the caller). */
void curve_fill_area(Curve *curve);

/* Fills bend (count entries, allocated by the caller) with the natural spline's second derivatives, then area. work:
 * count doubles. */
void curve_fill_spline(Curve *curve, double *work);

/* y(x). Outside the points the end values hold, as LS-DYNA does for load curves.
 * Time curves (mass flow, pressure, motion) use the same rule. */
double curve_value(const Curve *curve, double x);

/* dy/dx right of x; 0 beyond the ends. */
double curve_slope(const Curve *curve, double x);

/* Exact integral of y from a to b (a <= b or the negative), end values held. */
double curve_integral(const Curve *curve, double a, double b);

/* The first corner (abscissa) strictly after x, or +infinity. */
double curve_next_corner(const Curve *curve, double x);

#endif
