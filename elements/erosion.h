/* Erosion: fabric that is stretched or stressed too far is taken out, *MAT_ADD_EROSION (docs/theory.md, Seams and
 * tears). */
#ifndef BILLOW_EROSION_H
#define BILLOW_EROSION_H

#include <stdbool.h>
#include <stdint.h>

struct ElementGroup;

/* Bits of ErosionCriteria.active. */
enum {
    EROSION_LEAST_STRAIN = 1,
    EROSION_EFFECTIVE_STRAIN = 2,
    EROSION_LARGEST_STRAIN = 4,
    EROSION_SHEAR_STRAIN = 8,
    EROSION_LARGEST_STRESS = 16,
    EROSION_EQUIVALENT_STRESS = 32,
};

/* What ends an element of one material; only what is active counts. */
typedef struct ErosionCriteria {
    unsigned active;
    int needed;               /* NCS: so many must be met at one point */
    double least_strain;      /* MNEPS */
    double effective_strain;  /* EFFEPS */
    double largest_strain;    /* MXEPS */
    double shear_strain;      /* EPSSH */
    double largest_stress;    /* SIGP1 [F/L2] */
    double equivalent_stress; /* SIGVM [F/L2] */
    double end;               /* FAILTM: from this time on all elements are out; infinite without [T] */
} ErosionCriteria;

/* Are enough of the criteria met at a point of the element (eq. X8)? The time is not asked. geometry: the lane's
 * constants; memory: the first value that its law remembers (stride BILLOW_LANES), NULL if it remembers nothing. */
bool erosion_reached(const ErosionCriteria *criteria, const struct ElementGroup *group, const double *geometry,
                     const double *memory, const double *x, int64_t place);

/* Energy stored in the element, by a law that stores one (else 0), and its hourglass energy. */
void erosion_energy(const struct ElementGroup *group, const double *geometry, const double *x, int64_t place,
                    double *stored, double *hourglass);

/* Work that the stress of the last position took up over the first half of the step that led to x, with the velocity v
 * over it (eq. X9). geometry: as before the element was taken out. */
double erosion_last_work(const struct ElementGroup *group, const double *geometry, const double *memory,
                         const double *x, const double *v, double step, int64_t place);

/* Takes the element out of the kernels: weights, frequencies, hourglass stiffness and area vector of the lane are 0. */
void erosion_take_out(const struct ElementGroup *group, double *geometry);

#endif
