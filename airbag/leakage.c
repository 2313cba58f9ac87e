/* Effective areas of leaking fabric and of vents that are parts. */
#include "airbag/leakage.h"

#include <math.h>

double gas_hole_area(const GasHole *hole, const GasAreas *areas)
{
    double area = areas->part[hole->place];
    if (hole->blocked) area -= areas->blocked[hole->place];
    if (areas->eroded) area += areas->eroded[hole->place];
    if (hole->increase) area -= hole->initial_area;
    return fmax(area, 0.0);
}

static double factor_of(double constant, int curve, const Curve *curves, double x)
{
    return curve >= 0 ? fmax(curve_value(&curves[curve], x), 0.0) : constant;
}

/* Share of the area that is free, ELA included (G48). */
static double free_share(const GasLeak *leak, const Curve *curves, const GasAreas *areas, double time)
{
    double area = areas->part[leak->place], blocked = areas->blocked[leak->place];
    if (leak->option % 2 != 0 || !(blocked > 0.0) || !(area > 0.0)) return 1.0;
    double open = fmin(factor_of(leak->open, leak->open_curve, curves, time), 1.0);
    return fmax(1.0 - (1.0 - open) * blocked / area, 0.0);
}

double gas_leak_area(const GasLeak *leak, const Curve *curves, const GasAreas *areas, double time, double pressure,
                     double ambient)
{
    double area = areas->part[leak->place], first = leak->initial_area;
    double share = free_share(leak, curves, areas, time), ratio = ambient / pressure;
    double stretch = first > 0.0 ? area / first : 1.0;
    switch (leak->form) {
    case LEAK_FACTORS:
        return share * area * factor_of(leak->coefficient, leak->coefficient_curve, curves, time) *
               factor_of(leak->factor, leak->factor_curve, curves, pressure);
    case LEAK_STRETCH:
        return share * first * factor_of(leak->coefficient, leak->coefficient_curve, curves, stretch) *
               factor_of(leak->factor, leak->factor_curve, curves, leak->option > 6 ? pressure : ratio);
    case LEAK_POLYNOMIAL:
        return share * first *
               fmax(leak->x[0] + leak->x[1] * stretch + leak->x[2] * ratio + leak->x[3] * stretch * ratio, 0.0);
    case LEAK_SEAL:
        return share * fmax(area - first, 0.0);
    }
    return 0.0;
}
