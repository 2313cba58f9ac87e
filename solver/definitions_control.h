/* *CONTROL and *DATABASE of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_CONTROL_H
#define BILLOW_DEFINITIONS_CONTROL_H

#include <stdbool.h>

#include "solver/diagnostics.h"

typedef struct ControlDefinitions {
    struct {
        double endtim, dtmin, endeng, endmas, nosol;
        int endcyc;
        Source source;
        bool given;
    } termination;
    struct {
        double dtinit, tssfac, tslimt, dt2ms, dt2msf;
        int isdo, lctm, erode, ms1st, dt2mslc, imscl, rmscl, ihdo;
        double emscl;
        Source source;
        bool given;
    } timestep;
    struct {
        int ihq;
        double qh;
        Source source;
        bool given;
    } hourglass;
    struct {
        int hgen, rwen, slnten, rylen, irgen, maten, drlen, disen;
        Source source;
        bool given;
    } energy;
    struct {
        int osu, inn, pidosu, iacc;
        double exacc;
        Source source;
        bool given;
    } accuracy;
    struct {
        double q1, q2;
        int type, btype, tstype;
        Source source;
        bool given;
    } bulk_viscosity;
    struct {
        double wrpang;
        int esort, irnxx, istupd, theory, bwc, miter, proj;
        Source source;
        bool given;
    } shell;
    struct {
        int npopt, neecho, nrefup, iaccop, ipnint, ikedit, iflush, iprtf;
        double opifs;
        Source source;
        bool given;
    } output;
    struct { /* *CONTROL_DYNAMIC_RELAXATION */
        int nrcyck, irelal, idrflg;
        double drtol, drfctr, drterm, tssfdr, edttl;
        Source source;
        bool given;
    } relaxation;
    struct {
        double slsfac, rwpnal;
        int islchk, shlthk, penopt, thkchg, orien, enmass;
        int ignore;
        Source source;
        bool given;
    } contact;
} ControlDefinitions;

/* *DATABASE_<name>: output interval of one result. */
typedef struct DatabaseDefinition {
    char name[32]; /* "ABSTAT", "GLSTAT", "BINARY_D3PLOT", ... */
    double dt;     /* interval of time; of BINARY_D3DUMP and BINARY_RUNRSF in cycles */
    int lcur;      /* curve of intervals over time; 0 none */
    int npltc;     /* BINARY_D3PLOT: > 0 asks for this many states up to ENDTIM, dt is then ENDTIM / NPLTC */
    Source source;
} DatabaseDefinition;

typedef struct HistoryDefinition { /* *DATABASE_HISTORY_NODE(_SET) */
    bool is_set;
    int id;
    Source source;
} HistoryDefinition;

#endif
