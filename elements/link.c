/* Forces and energies of links. Equations (K1) to (K8), (K1a) of docs/theory.md. */
#include "elements/link.h"

#include "solver/elementary.h"

double link_tension(const Link *link, double length, double peak, double *energy)
{
    if (link->strap) {
        double force = strap_force(link->strap, length / link->length - 1.0, peak, energy);
        *energy *= link->length;
        return force;
    }
    if (link->curve) {
        *energy = law_curve_area(link->curve, length - link->length);
        return law_curve_stress(link->curve, length - link->length);
    }
    if (link->logarithmic) {
        double strain = elementary_log(length / link->length);
        *energy = link->stiffness * (length * strain - length + link->length);
        return link->stiffness * strain;
    }
    double tension = link->preload + link->stiffness * (length - link->length);
    if (link->tension_only && tension < 0.0) tension = 0.0;
    *energy = 0.5 * tension * tension / link->stiffness;
    return tension;
}

double link_peak(const Link *link, double length, double peak)
{
    double strain = link->strap ? length / link->length - 1.0 : 0.0;
    return strain > peak ? strain : peak;
}

double link_slope(const Link *link, double length)
{
    double energy;
    if (link->logarithmic) return link->stiffness / length;
    if (link->strap || link->curve) {
        const double step = 1e-6 * (link->curve ? link->curve->x[link->curve->count - 1] : link->length);
        return (link_tension(link, length + step, 0.0, &energy) - link_tension(link, length - step, 0.0, &energy)) /
               (2.0 * step);
    }
    return link->tension_only && !(link_tension(link, length, 0.0, &energy) > 0.0) ? 0.0 : link->stiffness;
}

double link_rate(const Link *link, double length, double tension)
{
    double along = link->logarithmic ? link->stiffness / length : link->stiffness;
    double across = length > 0.0 ? tension / length : 0.0;
    return (along > across ? along : across) * (link->inverse[0] + link->inverse[1]);
}
