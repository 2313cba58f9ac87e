/* The law of a mixture of gases: sums over its species by mass fraction (docs/theory.md, G34 to G38). */
#include "airbag/gas_law.h"
#include "solver/elementary.h"

enum { NEWTON_STEPS = 60 };
static const double NEWTON_CHANGE = 1e-9; /* relative; the next change would be its square */

/* Sums the gases' pieces at near, as far as all of them reach. */
static void mix_pieces(GasLaw *law)
{
    SpeciesPiece *mixed = &law->mixed;
    *mixed = (SpeciesPiece){.to = INFINITY};
    for (int i = 0; i < law->count; i++) {
        const SpeciesPiece *piece = species_piece(&law->species[i], law->near);
        double share = law->fraction[i];
        if (!(share > 0.0)) continue;
        for (int j = 0; j < SPECIES_TERMS; j++) mixed->cp[j] += share * piece->cp[j];
        mixed->enthalpy += share * piece->enthalpy;
        mixed->entropy += share * piece->entropy;
        mixed->from = fmax(mixed->from, piece->from);
        mixed->to = fmin(mixed->to, piece->to);
    }
}

void gas_law_mix(GasLaw *law, const double *mass)
{
    double total = 0.0, r = 0.0;
    for (int i = 0; i < law->count; i++) total += mass[i];
    if (!(total > 0.0)) return;
    for (int i = 0; i < law->count; i++) {
        law->fraction[i] = mass[i] / total;
        r += law->fraction[i] * law->species[i].r;
    }
    law->r = r;
    mix_pieces(law);
}

static bool in_piece(const GasLaw *law, double temperature)
{
    return temperature >= law->mixed.from && temperature <= law->mixed.to;
}

double gas_mixture_cp(const GasLaw *law, double temperature)
{
    if (in_piece(law, temperature)) return species_piece_cp(&law->mixed, temperature);
    double sum = 0.0;
    for (int i = 0; i < law->count; i++) sum += law->fraction[i] * species_cp(&law->species[i], temperature);
    return sum;
}

double gas_mixture_enthalpy(const GasLaw *law, double temperature)
{
    if (in_piece(law, temperature)) return species_piece_enthalpy(&law->mixed, temperature);
    double sum = 0.0;
    for (int i = 0; i < law->count; i++) sum += law->fraction[i] * species_enthalpy(&law->species[i], temperature);
    return sum;
}

static double mixture_entropy(const GasLaw *law, double temperature, double logarithm)
{
    if (in_piece(law, temperature)) return species_piece_entropy(&law->mixed, temperature, logarithm);
    double sum = 0.0;
    for (int i = 0; i < law->count; i++)
        sum += law->fraction[i] * species_entropy(&law->species[i], temperature, logarithm);
    return sum;
}

/* (G38): the left side grows with T where cv > 0, so that a step which would leave T > 0 is halved towards 0. */
double gas_mixture_temperature(const GasLaw *law, double mass, double outflow, double energy)
{
    if (!(energy > 0.0)) return energy == 0.0 ? 0.0 : NAN;
    double t = law->near > 0.0 ? law->near : 300.0;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        double h = gas_mixture_enthalpy(law, t), cv = gas_mixture_cp(law, t) - law->r;
        double slope = mass * cv + outflow * law->r;
        if (!(slope > 0.0)) return NAN;
        double next = t - (mass * (h - law->r * t) + outflow * law->r * t - energy) / slope;
        if (!(next > 0.1 * t)) next = 0.1 * t;
        double change = fabs(next - t);
        t = next;
        if (change <= NEWTON_CHANGE * t) break;
    }
    return t;
}

/* (G6) for a mixture: s(T1) - s(T) - R ln(T1/T) + R ln ratio = 0 with s = int cp/T dT; Newton in ln T1. */
double gas_mixture_isentropic(const GasLaw *law, double temperature, double ratio)
{
    double start = elementary_log(temperature), drop = law->r * elementary_log(ratio);
    double wanted = mixture_entropy(law, temperature, start) - law->r * start - drop;
    double y = start, t = temperature;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        double cv = gas_mixture_cp(law, t) - law->r;
        if (!(cv > 0.0)) return NAN;
        double change = (i == 0 ? drop : mixture_entropy(law, t, y) - law->r * y - wanted) / cv;
        y -= change;
        t = elementary_exp(y);
        if (fabs(change) < NEWTON_CHANGE) break;
    }
    return t;
}
