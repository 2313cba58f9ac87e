/* Reference geometries of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_REFERENCE_H
#define BILLOW_DEFINITIONS_REFERENCE_H

#include <stdbool.h>
#include <stddef.h>

#include "solver/diagnostics.h"

/* One block of *AIRBAG_REFERENCE_GEOMETRY or, if is_shell, *AIRBAG_SHELL_REFERENCE_GEOMETRY: its options and its
 * records [first, first + count) of reference_nodes or reference_shells. */
typedef struct ReferenceBlockDefinition {
    bool is_shell, rdt, has_birth;
    int id;            /* 0 without _ID */
    double sx, sy, sz; /* scale of the coordinates about node nid */
    int nid;           /* 0: the first node of the block */
    int iout;
    double birth;
    size_t first, count;
    Source source, id_source;
} ReferenceBlockDefinition;

typedef struct ReferenceNodeDefinition {
    int id;
    double x[3];
    Source source;
} ReferenceNodeDefinition;

typedef struct ReferenceShellDefinition {
    int id, part;
    int node[4]; /* as written */
    Source source;
} ReferenceShellDefinition;

#endif
