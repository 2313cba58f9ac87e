/* Materials of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_MATERIAL_H
#define BILLOW_DEFINITIONS_MATERIAL_H

#include <stdbool.h>

#include "solver/diagnostics.h"

typedef enum MaterialKind {
    MATERIAL_FABRIC,
    MATERIAL_ELASTIC,
    MATERIAL_NULL,
    MATERIAL_RIGID,
    MATERIAL_SPRING,      /* *MAT_SPRING_ELASTIC: k, _NONLINEAR_ELASTIC: lcd */
    MATERIAL_DAMPER,      /* *MAT_DAMPER_VISCOUS: dc, _NONLINEAR_VISCOUS: lcdr */
    MATERIAL_CABLE,       /* *MAT_CABLE_DISCRETE_BEAM: ro, e, f0 */
    MATERIAL_ORTHOTROPIC, /* *MAT_ORTHOTROPIC_ELASTIC: the card of a fabric of FORM 2 */
    MATERIAL_RUBBER,      /* *MAT_MOONEY-RIVLIN_RUBBER, *MAT_OGDEN_RUBBER */
    MATERIAL_BELT,        /* *MAT_SEATBELT */
} MaterialKind;

/* *MAT_FABRIC (MAT_034): every field of the cards, names as in the manual; *MAT_FABRIC_MAP's PXX, PYY and SXY are in
 * lca, lcb and lcab, its SRFAC in tsrfac. */
typedef struct FabricCard {
    bool is_map;
    double ea, eb, prba, prab;
    double gab, cse, el, prl, lratio, damp;
    double aopt, flc, fac, ela, lnrc, fvopt, tsrfac;
    int form;
    double rgbrth, a0ref, a1, a2, a3, x0, x1;
    double v1, v2, v3, beta, isrefg;
    int lca, lcb, lcab, lcua, lcub, lcuab; /* forms 4, 14, -14, 24 */
    double rl;
    int lcaa, lcbb; /* form -14 */
    double h, dt, ecoat, scoat, tcoat;
} FabricCard;

/* *MAT_MOONEY-RIVLIN_RUBBER and *MAT_OGDEN_RUBBER. */
typedef struct RubberCard {
    bool is_ogden;
    double a, b, ref, sgl, sw, st, g, sigf, mu[8], alpha[8];
    int lcid, n, nv;
} RubberCard;

/* *MAT_RIGID. con1/con2 as written; lco_or_a1 may name a local system when cmo < 0. */
typedef struct RigidCard {
    double e, pr, n, couple, m;
    char alias[11];
    double cmo;
    double con1, con2;
    double lco_or_a1, a2, a3, v1, v2, v3;
} RigidCard;

typedef struct MaterialDefinition {
    int id;
    MaterialKind kind;
    char title[BILLOW_TITLE_LENGTH];
    double ro;
    double e, pr, da, db, k;     /* MAT_ELASTIC; MAT_NULL's YM and PR are in e and pr */
    double pc, mu, terod, cerod; /* MAT_NULL */
    double f0;                   /* MAT_CABLE_DISCRETE_BEAM */
    double dc;                   /* MAT_DAMPER_VISCOUS */
    int lcd, lcdr;               /* MAT_SPRING_NONLINEAR_ELASTIC, MAT_DAMPER_NONLINEAR_VISCOUS */
    int llcid, ulcid;            /* MAT_SEATBELT; its MPUL is in ro */
    const char *keyword;         /* as messages call it, a constant of the reader; NULL: *MAT_FABRIC and others' own */
    FabricCard fabric;
    RubberCard rubber;
    RigidCard rigid;
    Source source;
} MaterialDefinition;

#endif
