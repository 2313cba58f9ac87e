/* Definitions -> Model: validates, renumbers, orients, closes and freezes the scene. */
#ifndef BILLOW_BUILD_H
#define BILLOW_BUILD_H

#include "solver/definitions.h"
#include "solver/model.h"

/* What the command line decides about the model. */
typedef struct BuildOptions {
    double end_time;            /* > 0 overrides ENDTIM */
    bool one_point_quads;       /* one-point quads with hourglass control in place of 2 x 2 points */
    bool caps_push_rim;         /* hole caps give their pressure force to the rim */
    const char *sensor_library; /* shared library with the user's sensor (RBID > 0), NULL none */
    bool walls_block;           /* nodes on rigid walls count as covered, like those in contact */
    bool relax;                 /* --relax: static equilibrium before the run */
    bool relaxation_phase;      /* the model of that phase: curves with SIDR = 1 or 2 act, those with 0 do not */
    bool all_explicit;          /* no small elements are integrated implicitly */
    double energy_error_limit;  /* > 0: stop beyond this share in place of 0.1 */
} BuildOptions;

/* Builds the model; all errors of the deck go to diagnostics together. Returns 0, or -1 if there was an error (the
 * model is then empty). */
int model_build(const Definitions *definitions, const BuildOptions *options, Model *model, Diagnostics *diagnostics);

#endif
