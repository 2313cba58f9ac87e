/* Heat capacity, enthalpy and entropy of one gas of a mixture. */
#include "airbag/species.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/elementary.h"

double species_piece_cp(const SpeciesPiece *piece, double t)
{
    const double *k = piece->cp;
    double value = k[0] + t * (k[1] + t * (k[2] + t * (k[3] + t * k[4])));
    return k[5] == 0.0 ? value : value + k[5] / (t * t);
}

double species_piece_enthalpy(const SpeciesPiece *piece, double t)
{
    const double *k = piece->cp;
    double value =
        t * (k[0] + t * (k[1] * (1.0 / 2.0) + t * (k[2] * (1.0 / 3.0) + t * (k[3] * 0.25 + t * (k[4] * 0.2)))));
    return piece->enthalpy + (k[5] == 0.0 ? value : value - k[5] / t);
}

double species_piece_entropy(const SpeciesPiece *piece, double t, double logarithm)
{
    const double *k = piece->cp;
    double value = k[0] * logarithm + t * (k[1] + t * (k[2] * 0.5 + t * (k[3] * (1.0 / 3.0) + t * (k[4] * 0.25))));
    return piece->entropy + (k[5] == 0.0 ? value : value - k[5] / (2.0 * t * t));
}

/* Adds a piece up to a temperature; h and the entropy go on from the piece before. */
static void add_piece(GasSpecies *s, double to, const double *cp)
{
    SpeciesPiece *piece = &s->piece[s->piece_count];
    const SpeciesPiece *before = s->piece_count > 0 ? piece - 1 : NULL;
    piece->from = before ? before->to : 0.0;
    piece->to = to;
    memcpy(piece->cp, cp, sizeof piece->cp);
    if (before) {
        double t = piece->from, logarithm = elementary_log(t);
        piece->enthalpy = species_piece_enthalpy(before, t) - species_piece_enthalpy(piece, t);
        piece->entropy = species_piece_entropy(before, t, logarithm) - species_piece_entropy(piece, t, logarithm);
    }
    s->piece_count++;
}

GasSpecies species_make(const char *name, double molar_mass, double gas_constant, const double limit[3],
                        const double molar_cp[2][SPECIES_TERMS])
{
    GasSpecies s = {.molar_mass = molar_mass, .r = gas_constant / molar_mass};
    SpeciesPiece range[2] = {{0}};
    snprintf(s.name, sizeof s.name, "%s", name);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < SPECIES_TERMS; j++) range[i].cp[j] = molar_cp[i][j] / molar_mass;
    if (limit[0] > 0.0) add_piece(&s, limit[0], (const double[SPECIES_TERMS]){species_piece_cp(&range[0], limit[0])});
    add_piece(&s, limit[1], range[0].cp);
    if (isfinite(limit[1])) add_piece(&s, limit[2], range[1].cp);
    if (isfinite(limit[2]))
        add_piece(&s, INFINITY, (const double[SPECIES_TERMS]){species_piece_cp(&range[1], limit[2])});
    return s;
}

const SpeciesPiece *species_piece(const GasSpecies *s, double t)
{
    int i = 0;
    while (i + 1 < s->piece_count && t > s->piece[i].to) i++;
    return &s->piece[i];
}

double species_cp(const GasSpecies *s, double t)
{
    return species_piece_cp(species_piece(s, t), t);
}

double species_enthalpy(const GasSpecies *s, double t)
{
    return species_piece_enthalpy(species_piece(s, t), t);
}

double species_entropy(const GasSpecies *s, double t, double logarithm)
{
    return species_piece_entropy(species_piece(s, t), t, logarithm);
}
