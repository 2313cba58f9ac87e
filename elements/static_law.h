/* The membrane laws at one point for the static equilibrium: stress, consistent tangent, stored energy (docs/theory.md,
 * Static equilibrium). Voigt order: strain (E11, E22, 2 E12), stress (S11, S22, S12), in material axes. */
#ifndef BILLOW_STATIC_LAW_H
#define BILLOW_STATIC_LAW_H

#include "elements/law.h"

/* Constants of one law, once for a group. */
typedef struct StaticLaw {
    LawKind kind;
    FabricLaw fabric;
    double compliance[3]; /* b0, b1, b2 of the tension field (eq. F9) */
} StaticLaw;

typedef struct StaticPoint {
    double stress[3];     /* second Piola-Kirchhoff, the very bits of the explicit kernels */
    double tangent[3][3]; /* dS/dE, symmetric part */
    double energy;        /* per reference volume; of laws without a stored energy an estimate (eq. Q9) */
} StaticPoint;

StaticLaw static_law_make(LawKind kind, const FabricLaw *fabric);

/* Why a law has no static equilibrium (what it misses), or NULL if it has one. */
const char *static_law_refusal(LawKind kind, const FabricLaw *fabric);

/* Is the tangent symmetric everywhere? Else the law stores no energy. */
bool static_law_is_symmetric(LawKind kind, const FabricLaw *fabric);

/* Stress and energy at the right Cauchy-Green tensor c (11, 22, 12), and the tangent if it is wanted. */
void static_law_point(const StaticLaw *law, const double c[3], bool tangent, StaticPoint *point);

#endif
