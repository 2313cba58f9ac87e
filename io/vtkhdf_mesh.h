/* What never changes in results.vtkhdf: topology, ids, parts. Part of io/vtkhdf.c's file layout. */
#ifndef BILLOW_VTKHDF_MESH_H
#define BILLOW_VTKHDF_MESH_H

#include <hdf5.h>

#include "solver/model.h"

/* Kinds of cells in the mesh. */
typedef struct MeshCount {
    int triangles, quads;
} MeshCount;

MeshCount vtkhdf_count_cells(const Model *model);

/* Writes counts, topology, ids and parts below root (the VTKHDF group, with its groups PointData and
 * CellData), in deck order; where triangles and quads are mixed also the file's /XDMF/Topology, in which each cell's
 * corners follow its XDMF type. 0, or -1. */
int vtkhdf_write_mesh(hid_t file, hid_t root, const Model *model);

#endif
