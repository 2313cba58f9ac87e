/* Heat capacity of one gas of a mixture over the temperature, per mass (docs/theory.md, G34 to G37). */
#ifndef BILLOW_SPECIES_H
#define BILLOW_SPECIES_H

enum { BILLOW_GAS_SPECIES = 32, BILLOW_SPECIES_NAME = 11, SPECIES_TERMS = 6 };

/* A stretch of temperatures with cp = k0 + k1 T + k2 T^2 + k3 T^3 + k4 T^4 + k5/T^2. */
typedef struct SpeciesPiece {
    double from, to;
    double cp[SPECIES_TERMS];
    double enthalpy; /* constant of h = int_0^T cp dT */
    double entropy;  /* constant of int cp/T dT, which is continuous */
} SpeciesPiece;

double species_piece_cp(const SpeciesPiece *piece, double temperature);
double species_piece_enthalpy(const SpeciesPiece *piece, double temperature);
double species_piece_entropy(const SpeciesPiece *piece, double temperature, double logarithm);

/* Pieces follow each other from 0 to infinity. */
typedef struct GasSpecies {
    char name[BILLOW_SPECIES_NAME];
    double molar_mass, r; /* r: gas constant per mass */
    int piece_count;
    SpeciesPiece piece[4]; /* per mass */
} GasSpecies;

/* From the molar cp below and above a middle temperature, terms as above. limit: low, middle, high temperature; below
 * the low and above the high one cp keeps the value that it has there. 0 and +infinity say that there is no limit. */
GasSpecies species_make(const char *name, double molar_mass, double gas_constant, const double limit[3],
                        const double molar_cp[2][SPECIES_TERMS]);

/* The piece at a temperature >= 0. */
const SpeciesPiece *species_piece(const GasSpecies *species, double temperature);

/* cp, h = int_0^T cp dT, and int cp/T dT up to a constant, logarithm = ln T. */
double species_cp(const GasSpecies *species, double temperature);
double species_enthalpy(const GasSpecies *species, double temperature);
double species_entropy(const GasSpecies *species, double temperature, double logarithm);

/* The built-in table: cp/R by range. */
typedef struct NasaSpecies {
    const char *name;
    double molar_mass; /* kg/kmol */
    double limit[3];
    double cp[2][5];
} NasaSpecies;
extern const NasaSpecies species_nasa[];
extern const int species_nasa_count;

/* By its chemical symbol in any case; NULL if it is not there. */
const NasaSpecies *species_find(const char *name);

#endif
