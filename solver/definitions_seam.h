/* Seams and tears of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_SEAM_H
#define BILLOW_DEFINITIONS_SEAM_H

#include "solver/diagnostics.h"

typedef struct SpotweldDefinition { /* *CONSTRAINED_SPOTWELD */
    int node[2];
    double sn, ss, n, m, tf, ep;
    Source source;
} SpotweldDefinition;

typedef struct TiedNodesDefinition { /* *CONSTRAINED_TIED_NODES_FAILURE */
    int nsid, etype;
    double eppf;
    Source source;
} TiedNodesDefinition;

typedef struct ErosionDefinition { /* *MAT_ADD_EROSION */
    int mid, idam, lcregd, lcfld, nsff, lceps12, lceps13, lcepsmx;
    double excl, mxpres, mneps, effeps, voleps, numfip, ncs;
    double mnpres, sigp1, sigvm, mxeps, epssh, sigth, impulse, failtm;
    double epsthin, engcrt, radcrt, dteflt, volfrac, mxtmp, dtmin;
    Source source;
} ErosionDefinition;

#endif
