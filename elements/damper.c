/* Forces of dampers. Equations (K9) and (K11) of docs/theory.md. */
#include "elements/damper.h"

double damper_tension(const Damper *damper, double rate)
{
    return damper->curve ? law_curve_stress(damper->curve, rate) : damper->coefficient * rate;
}

double damper_rate(const Damper *damper)
{
    return damper->coefficient * (damper->inverse[0] + damper->inverse[1]);
}
