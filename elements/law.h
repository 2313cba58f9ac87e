/* Membrane laws: constants of the plane-stress fabric and elastic laws (docs/theory.md, section Fabric). */
#ifndef BILLOW_LAW_H
#define BILLOW_LAW_H

#include <stdbool.h>

#include "elements/law_curve.h"
#include "elements/law_rubber.h"

typedef enum LawKind {
    LAW_SURFACE,     /* no stress */
    LAW_BIOT,        /* FORM 0, 1: Biot stress = D : (U - 1), thickness constant */
    LAW_LOGARITHMIC, /* MAT_ELASTIC: Cauchy stress = D : ln U, thickness constant */
    LAW_GREEN,       /* FORM 2, 3, 12, 13: second Piola-Kirchhoff stress = D : E */
    LAW_CURVE,       /* FORM 4, 14, -14, 24: curves of fibres and shear */
    LAW_RUBBER,      /* MAT_MOONEY-RIVLIN_RUBBER, MAT_OGDEN_RUBBER: incompressible */
} LawKind;

/* Plane-stress moduli in material axes: S11 = d11 E11 + d12 E22, S22 = d12 E11 + d22 E22, S12 = 2 d33 E12 (d33 = G). */
typedef struct PlaneModuli {
    double d11, d12, d22, d33;
} PlaneModuli;

typedef struct FabricLaw {
    PlaneModuli fabric; /* share (1 - LRATIO) included */
    PlaneModuli liner;  /* share LRATIO included; zero without liner */
    PlaneModuli whole;  /* fabric + liner */
    bool has_liner;
    bool no_compression;     /* CSE = 1: tension field */
    bool free_fold;          /* quads of 2 x 2 points fold about a diagonal without strain: FORM 0, 1 */
    double damping;          /* DAMP: share of critical at the element's highest frequency */
    double density;          /* [M/L3] */
    double hourglass;        /* QH of the one-point quad */
    double slack_share;      /* stiffness left when only the liner acts: largest eigenvalue of liner relative to all */
    const CurveLaw *curves;  /* LAW_CURVE: share (1 - LRATIO) included; fabric has the largest tangents. The Model's */
    const RubberLaw *rubber; /* LAW_RUBBER; fabric has the moduli of small strains. The Model's */
    bool has_memory;         /* the stress depends on the past: curves with unloading or softening */
} FabricLaw;

/* Sets the moduli of small strains: E = 3 mu, Poisson's ratio 1/2 (eq. H10). */
void law_rubber_moduli(const RubberLaw *rubber, FabricLaw *law);

/* Is the energy a function of the strain alone? Else it is the summed work of the stress. */
bool law_stores_energy(LawKind kind, const FabricLaw *law);

/* Has the stress no energy of its own and no damping that takes up what it feeds, so that accounts limit what it gives
 * back (eq. F7a)? */
bool law_keeps_account(LawKind kind, const FabricLaw *law);

/* Are strain and stress of the last step kept, for the work or for damping? */
bool law_has_history(LawKind kind, const FabricLaw *law);

/* Doubles per point and lane that the law remembers beyond that. */
int law_memory_size(LawKind kind, const FabricLaw *law);

/* Isotropic plane-stress moduli (eq. F2). */
PlaneModuli law_isotropic(double e, double nu);

/* Orthotropic ones (eq. F3). nu_ba (PRBA) goes with ea: strain 22 from stress 11 ... both are used as given; an
 * inconsistent pair (nu_ba ea != nu_ab eb) has its coupling modulus made symmetric by the mean. */
PlaneModuli law_orthotropic(double ea, double eb, double nu_ba, double nu_ab, double g);

/* Sets fabric, liner, whole and slack_share from the moduli and LRATIO. */
void law_set(FabricLaw *law, PlaneModuli fabric, PlaneModuli liner, double liner_share, bool has_liner);

#endif
