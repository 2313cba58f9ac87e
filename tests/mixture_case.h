/* Gas cases of mixtures: the five gases of reference B4, molar cp = a + b T + c T^2. */
#ifndef BILLOW_TESTS_MIXTURE_CASE_H
#define BILLOW_TESTS_MIXTURE_CASE_H

#include "tests/gas_case.h"

enum { MIX_AIR, MIX_N2, MIX_CO2, MIX_AR, MIX_HE, MIX_COUNT };

static const double mixture_cards[MIX_COUNT][4] = {{0.028964, 28.11, 0.001967, 4.802e-06},
                                                   {0.0280134, 28.9, -0.001571, 8.081e-06},
                                                   {0.0440095, 22.26, 0.05981, -3.501e-05},
                                                   {0.039948, 20.786, 0, 0},
                                                   {0.0040026, 20.786, 0, 0}};

typedef struct MixtureCase {
    GasCase c;
    GasSpecies species[BILLOW_GAS_SPECIES];
    GasSource sources[BILLOW_GAS_SPECIES];
} MixtureCase;

/* Air at 296.15 K and 101325 Pa in a volume; the other gases are there to flow in. Inflow is by mass_flow_curve with
 * mole fractions; none at first. */
static inline void mixture_start(MixtureCase *m, double volume)
{
    memset(m, 0, sizeof *m);
    case_air(&m->c, volume, 296.15, 101325.0);
    GasModel *gas = &m->c.gas;
    gas->kind = GAS_HYBRID;
    gas->ambient_temperature = 296.15;
    gas->species_count = MIX_COUNT;
    gas->species = m->species;
    gas->sources = m->sources;
    for (int i = 0; i < MIX_COUNT; i++) {
        const double *card = mixture_cards[i];
        m->species[i] = species_make("", card[0], 8.314462618, (const double[3]){0.0, INFINITY, INFINITY},
                                     (const double[2][SPECIES_TERMS]){{card[1], card[2], card[3]}});
        m->sources[i] = (GasSource){.mass_flow_curve = -1, .temperature_curve = -1, .mole_fraction_curve = -1};
    }
    m->sources[MIX_AIR].initial_fraction = 1.0;
}

#endif
