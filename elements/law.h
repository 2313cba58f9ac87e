/* Membrane laws: constants of the plane-stress fabric and elastic laws (docs/theory.md, section Fabric). */
#ifndef BILLOW_LAW_H
#define BILLOW_LAW_H

#include <stdbool.h>

typedef enum LawKind {
    LAW_SURFACE,     /* no stress */
    LAW_BIOT,        /* FORM 0, 1: Biot stress = D : (U - 1), thickness constant */
    LAW_LOGARITHMIC, /* MAT_ELASTIC: Cauchy stress = D : ln U, thickness constant */
    LAW_GREEN,       /* FORM 2: second Piola-Kirchhoff stress = D : E */
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
    bool no_compression; /* CSE = 1: tension field */
    bool free_fold;      /* quads of 2 x 2 points fold about a diagonal without strain: FORM 0, 1 */
    double damping;      /* DAMP: share of critical at the element's highest frequency */
    double density;      /* [M/L3] */
    double hourglass;    /* QH of the one-point quad */
    double slack_share;  /* stiffness left when only the liner acts: largest eigenvalue of liner relative to all */
} FabricLaw;

/* Isotropic plane-stress moduli (eq. F2). */
PlaneModuli law_isotropic(double e, double nu);

/* Orthotropic ones (eq. F3). nu_ba (PRBA) goes with ea: strain 22 from stress 11 ... both are used as given; an
 * inconsistent pair (nu_ba ea != nu_ab eb) has its coupling modulus made symmetric by the mean. */
PlaneModuli law_orthotropic(double ea, double eb, double nu_ba, double nu_ab, double g);

/* Sets fabric, liner, whole and slack_share from the moduli and LRATIO. */
void law_set(FabricLaw *law, PlaneModuli fabric, PlaneModuli liner, double liner_share, bool has_liner);

#endif
