/* results.xdmf: an XML index of the arrays in results.vtkhdf for ParaView before 5.12 and other readers of XDMF 3.
 * The file is whole XML after every state. */
#ifndef BILLOW_XDMF_H
#define BILLOW_XDMF_H

#include <stdbool.h>
#include <stdint.h>

#include "solver/diagnostics.h"

typedef struct Xdmf Xdmf;

/* Sizes of the mesh that every state shares. */
typedef struct XdmfMesh {
    int64_t point_count, cell_count;
    int64_t topology_length; /* numbers in the connectivity array */
    bool erodes;             /* a field eroded is there */
    int corner_count;        /* 3: triangles only, 4: quads only, 0: mixed, with the cells' types in the array */
} XdmfMesh;

/* Starts the file at path anew, for heavy data in the file heavy_name beside it. 0, or -1 with an environment error. */
int xdmf_create(const char *path, const char *heavy_name, const XdmfMesh *mesh, Xdmf **xdmf, Diagnostics *diagnostics);

/* Appends the state whose rows come after those of state others in the heavy data. 0, or -1 with an environment error;
 * the file then ends with the state before. */
int xdmf_add_state(Xdmf *xdmf, int64_t state, double time);

/* Closes and frees. 0, or -1 with an environment error. NULL is allowed. */
int xdmf_close(Xdmf *xdmf);

#endif
