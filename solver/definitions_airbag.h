/* Airbags of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_AIRBAG_H
#define BILLOW_DEFINITIONS_AIRBAG_H

#include <stdbool.h>

#include "airbag/billow_sensor.h"
#include "solver/billow.h"
#include "solver/diagnostics.h"

enum { BILLOW_AIRBAG_GASES = 17 }; /* of one mixture, as in the manual */

typedef enum AirbagModel {
    AIRBAG_SIMPLE,
    AIRBAG_WANG_NEFSKE,
    AIRBAG_HYBRID,
    AIRBAG_CHEMKIN,
    AIRBAG_PRESSURE_VOLUME,
    AIRBAG_ADIABATIC,
    AIRBAG_LOAD_CURVE,
    AIRBAG_LINEAR_FLUID,
    AIRBAG_FLUID_AND_GAS,
} AirbagModel;

/* One gas of *AIRBAG_HYBRID (cards 5.1, 5.2) or *AIRBAG_HYBRID_CHEMKIN (cards 6, 7). */
typedef struct AirbagGasDefinition {
    int lcidm, lcidt; /* HYBRID */
    double mw, initm, a, b, c, fmass;
    char chname[11]; /* CHEMKIN */
    int lcidn;
    double fmole, fmolet;
    double tlow, tmid, thigh, low[7], high[7]; /* DATA = 1: a b c d e f h */
    double d, e;                               /* DATA = 3, with a b c */
    Source source;                             /* of the first card */
} AirbagGasDefinition;

/* Cards 2a or 2b of *AIRBAG with RBID. */
typedef struct SensorCards {
    double a[4], tdur, dv[4], u[4]; /* levels of x, y, z and magnitude */
    int n;                          /* user's constants */
    double c[BILLOW_SENSOR_CONSTANTS];
} SensorCards;

/* Cards 9 to 11 of *AIRBAG_WANG_NEFSKE_JETTING and the like. */
typedef struct JetCards {
    bool given, multiple, cm;
    double focus[3], head[3], second[3];
    double ca, beta; /* ca: CA or LCJRV */
    int psid;
    double angle;
    int node[3], nreact;
    Source card9, card10, card11;
} JetCards;

/* *AIRBAG_<model>(_ID): cards as in the manual; the Source of every card so that messages name the right line. */
typedef struct AirbagDefinition {
    AirbagModel model;
    int id; /* 0 without _ID */
    char heading[BILLOW_TITLE_LENGTH];
    int sid, sidtyp, rbid;
    double vsca, psca, vini, mwd, spsf;
    double cv, cp, t;
    int lcid;                           /* SIMPLE: mass flow curve */
    double mu, area, pe, ro;            /* SIMPLE card 3 */
    int lou;                            /* SIMPLE card 4 */
    double text, a, b, mw, gasc, hconv; /* SIMPLE 4a, WANG_NEFSKE 7 */
    int lct, lcmt, lcdt;                /* WANG_NEFSKE 3 */
    double tvol, iabt;
    double c23, a23, cp23, ap23; /* WANG_NEFSKE 4 */
    int lcc23, lca23, lccp23, lcap23;
    double gc, pover, ppop, opt; /* WANG_NEFSKE 5 (pe, ro above) */
    int lcefr, knkdn;
    double ioc, ioa, ivol, iro, it; /* WANG_NEFSKE 6 */
    int lcbf;
    double tdp, axp, ayp, azp, amagp, tdurp, tda; /* WANG_NEFSKE 8, option POP */
    int rbidp;
    double atmost, atmosp, atmosd, cc; /* HYBRID 3, with gc, hconv; CHEMKIN 3 has atmost, atmosp and gc as RG */
    int ngas;                          /* HYBRID 5, with opt, lcefr, ppop as PVENT; CHEMKIN 3 */
    int lcidm0, vntopt, lcidm, lcidt, data;
    AirbagGasDefinition gases[BILLOW_AIRBAG_GASES]; /* (ngas) */
    double cn, beta;                                /* SIMPLE_PRESSURE_VOLUME 3, with lcid */
    int lciddr;
    double psf, gamma, p0; /* ADIABATIC_GAS_MODEL 3, with lcid, pe, ro; LOAD_CURVE 3 has p0, pe, ro, t too */
    double stime, t0;      /* LOAD_CURVE 3, with lcid */
    double bulk;           /* LINEAR_FLUID 3, with ro, lcid */
    int lcint, lcoutt, lcoutp, lcfit, lcbulk;
    double p_limit; /* LINEAR_FLUID 4 */
    int p_limlc, nonull;
    double xwini, xwadd, xw, p, tend; /* FLUID_AND_GAS 3, with ro */
    int lcxw, lcp;
    double gdir, kappa, kbm; /* FLUID_AND_GAS 4 */
    int nproj, idir, iidir;
    SensorCards sensor;
    JetCards jet;
    Source source, card1, card3, card4, card5, card6, card7, card8;
} AirbagDefinition;

/* *MAT_ADD_AIRBAG_POROSITY_LEAKAGE: names as those of FabricCard. */
typedef struct PorosityDefinition {
    int mid;
    double flc, fac, ela, fvopt, x0, x1;
    Source source;
} PorosityDefinition;

/* *AIRBAG_INTERACTION */
typedef struct InteractionDefinition {
    int ab1, ab2;
    double area, sf;
    int pid, lcid, iflow, excp;
    Source source;
} InteractionDefinition;

#endif
