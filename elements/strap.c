/* Straps that come back along another curve. Equations (K6) to (K8) of docs/theory.md. */
#include "elements/strap.h"

#include <stdbool.h>

/* The piece and the strain where a curve reaches the force; -1: nowhere. */
static int find_force(const LawCurve *curve, double force, double *strain)
{
    int piece = 1;
    while (piece + 1 < curve->count && force > curve->y[piece + 1]) piece++;
    if (!(curve->slope[piece] > 0.0)) return -1;
    *strain = curve->x[piece] + (force - curve->y[piece]) / curve->slope[piece];
    return piece;
}

/* The shift of the unloading curve that lets it begin at the peak, and what the way back gives (K7). False where the
 * loading curve is the way back as well. */
static bool find_shift(const Strap *strap, double peak, double *shift, double *given)
{
    double strain;
    if (strap->unload.count == 0 || !(peak > strap->yield)) return false;
    if (find_force(&strap->unload, law_curve_stress(&strap->load, peak), &strain) < 0) return false;
    *shift = peak - strain;
    *given = law_curve_area(&strap->unload, strain);
    return *shift >= 0.0 && *given <= law_curve_area(&strap->load, peak);
}

double strap_force(const Strap *strap, double strain, double peak, double *work)
{
    double shift, given;
    if (!(strain < peak) || !find_shift(strap, peak, &shift, &given)) {
        *work = law_curve_area(&strap->load, strain);
        return law_curve_stress(&strap->load, strain);
    }
    *work = law_curve_area(&strap->load, peak) - given + law_curve_area(&strap->unload, strain - shift);
    return law_curve_stress(&strap->unload, strain - shift);
}

double strap_steepest(const Strap *strap)
{
    double load = law_curve_steepest(&strap->load),
           unload = strap->unload.count > 0 ? law_curve_steepest(&strap->unload) : 0.0;
    return load > unload ? load : unload;
}

/* Is the way back just above the strain less steep than the way out? */
static bool is_less_steep(const Strap *strap, double strain)
{
    const LawCurve *load = &strap->load, *unload = &strap->unload;
    const double above = strain * (1.0 + 1e-9);
    double back;
    int out = 1;
    while (out + 1 < load->count && above > load->x[out + 1]) out++;
    if (!(load->slope[out] > 0.0) || above < strap->yield) return false;
    int piece = find_force(unload, law_curve_stress(load, above), &back);
    if (piece < 0) return true;
    /* where it would begin left of the origin it is not taken */
    return back <= above && unload->slope[piece] < load->slope[out] * (1.0 - 1e-9);
}

double strap_creates_energy(const Strap *strap)
{
    double first = -1.0;
    if (strap->unload.count == 0) return first;
    for (int i = 1; i < strap->load.count + strap->unload.count; i++) {
        double strain;
        if (i < strap->load.count)
            strain = strap->load.x[i];
        else if (find_force(&strap->load, strap->unload.y[i - strap->load.count], &strain) < 0)
            continue;
        if (is_less_steep(strap, strain) && (first < 0.0 || strain < first)) first = strain;
    }
    return first;
}
