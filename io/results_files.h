/* Inside of the results module: what its writers share. Included by io/results.c and the history writers only. */
#ifndef BILLOW_RESULTS_FILES_H
#define BILLOW_RESULTS_FILES_H

#include "io/history.h"
#include "io/results.h"
#include "io/vtkhdf.h"
#include "io/xdmf.h"

typedef enum HistoryKind {
    HISTORY_GLSTAT,
    HISTORY_ABSTAT,
    HISTORY_ABSTAT_PARTS,
    HISTORY_NODOUT,
    HISTORY_RBDOUT,
    HISTORY_MATSUM,
    HISTORY_RWFORC,
    HISTORY_RCFORC,
    HISTORY_GCEOUT,
    HISTORY_COUNT
} HistoryKind;

struct Results {
    Diagnostics *diagnostics; /* borrowed */
    History history[HISTORY_COUNT];
    char *grid_path, *xdmf_path; /* owned */
    VtkHdf *grid;                /* NULL until the first state */
    Xdmf *xdmf;
    double *part_flow;   /* workspace of abstat (2 x part_count) */
    double *part_centre; /* initial centre of mass of each part, for fixed rigid bodies (part_count x 3) [L] */
};

/* Formats of the histories, defined beside their writers. */
extern const HistoryFormat results_glstat_format, results_abstat_format, results_abstat_parts_format,
    results_nodout_format, results_rbdout_format, results_matsum_format, results_rwforc_format, results_rcforc_format,
    results_gceout_format;

#endif
