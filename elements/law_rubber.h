/* Constants of incompressible rubber (docs/theory.md, Rubber). */
#ifndef BILLOW_LAW_RUBBER_H
#define BILLOW_LAW_RUBBER_H

enum { RUBBER_TERMS = 8 };

typedef struct RubberLaw {
    double a, b;                                  /* MAT_MOONEY-RIVLIN_RUBBER [F/L2]; used where terms = 0 */
    int terms;                                    /* MAT_OGDEN_RUBBER */
    double mu[RUBBER_TERMS], alpha[RUBBER_TERMS]; /* [F/L2], [-] */
} RubberLaw;

#endif
