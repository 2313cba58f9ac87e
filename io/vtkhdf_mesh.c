/* The constant part of results.vtkhdf. */
#include "io/vtkhdf_mesh.h"

#include <string.h>

#include "io/hdf5_array.h"
#include "solver/memory.h"

enum { VTK_TRIANGLE = 5, VTK_QUAD = 9 };            /* VTK's cell types */
enum { XDMF_TRIANGLE = 4, XDMF_QUADRILATERAL = 5 }; /* XDMF's */

/* Cells in deck order: types, corner offsets and corners as deck-order points; topology also has XDMF's types. */
typedef struct CellTables {
    int64_t *connectivity, *offsets;
    uint8_t *types;
    int32_t *topology, *ids, *parts;
    int32_t *deck_place; /* deck-order place of each internal node (node_count) */
    int64_t corners, topology_length;
} CellTables;

static bool is_quad(const Model *model, int element)
{
    const int32_t *node = model->element_node + 4 * (ptrdiff_t)element;
    return node[3] != node[2];
}

MeshCount vtkhdf_count_cells(const Model *model)
{
    MeshCount count = {0, 0};
    for (int e = 0; e < model->element_count; e++) count.quads += is_quad(model, e);
    count.triangles = model->element_count - count.quads;
    return count;
}

static void free_tables(CellTables *tables)
{
    memory_free(tables->connectivity);
    memory_free(tables->offsets);
    memory_free(tables->types);
    memory_free(tables->topology);
    memory_free(tables->ids);
    memory_free(tables->parts);
    memory_free(tables->deck_place);
}

static int allocate_tables(const Model *model, CellTables *tables)
{
    size_t cells = (size_t)model->element_count + 1;
    *tables = (CellTables){
        .connectivity = memory_alloc(4 * cells, sizeof(int64_t)),
        .offsets = memory_alloc(cells, sizeof(int64_t)),
        .types = memory_alloc(cells, 1),
        .topology = memory_alloc(5 * cells, sizeof(int32_t)),
        .ids = memory_alloc(cells, sizeof(int32_t)),
        .parts = memory_alloc(cells, sizeof(int32_t)),
        .deck_place = memory_alloc((size_t)model->node_count + 1, sizeof(int32_t)),
    };
    bool complete = tables->connectivity && tables->offsets && tables->types && tables->topology && tables->ids &&
                    tables->parts && tables->deck_place;
    return complete ? 0 : -1;
}

static void fill_tables(const Model *model, CellTables *tables)
{
    for (int i = 0; i < model->node_count; i++) tables->deck_place[model->deck_node[i]] = i;
    for (int e = 0; e < model->element_count; e++) {
        const int32_t *node = model->element_node + 4 * (ptrdiff_t)e;
        int corners = is_quad(model, e) ? 4 : 3;
        tables->types[e] = corners == 4 ? VTK_QUAD : VTK_TRIANGLE;
        tables->topology[tables->topology_length++] = corners == 4 ? XDMF_QUADRILATERAL : XDMF_TRIANGLE;
        for (int c = 0; c < corners; c++) {
            int32_t place = tables->deck_place[node[c]];
            tables->connectivity[tables->corners++] = place;
            tables->topology[tables->topology_length++] = place;
        }
        tables->offsets[e + 1] = tables->corners;
        tables->ids[e] = model->element_id[e];
        tables->parts[e] = model->parts[model->element_part[e]].id;
    }
}

static int write_topology(hid_t root, const Model *model, const CellTables *tables)
{
    const int64_t points = model->node_count, cells = model->element_count, corners = tables->corners;
    const hid_t type = H5T_NATIVE_INT64, stored = H5T_STD_I64LE;
    return hdf5_write_constant(root, "NumberOfPoints", stored, type, 1, &points) ||
                   hdf5_write_constant(root, "NumberOfCells", stored, type, 1, &cells) ||
                   hdf5_write_constant(root, "NumberOfConnectivityIds", stored, type, 1, &corners) ||
                   hdf5_write_constant(root, "Connectivity", stored, type, (hsize_t)corners, tables->connectivity) ||
                   hdf5_write_constant(root, "Offsets", stored, type, (hsize_t)cells + 1, tables->offsets) ||
                   hdf5_write_constant(root, "Types", H5T_STD_U8LE, H5T_NATIVE_UINT8, (hsize_t)cells, tables->types)
               ? -1
               : 0;
}

/* Ids and the contact flags: all 0, nothing touches. Reuses the tables of types and deck places. */
static int write_ids(hid_t root, const Model *model, CellTables *tables)
{
    const hsize_t points = (hsize_t)model->node_count, cells = (hsize_t)model->element_count;
    const hid_t type = H5T_NATIVE_INT32, stored = H5T_STD_I32LE;
    memset(tables->types, 0, cells);
    for (int i = 0; i < model->node_count; i++) tables->deck_place[i] = model->node_id[model->deck_node[i]];
    return hdf5_write_constant(root, "CellData/element_id", stored, type, cells, tables->ids) ||
                   hdf5_write_constant(root, "CellData/part_id", stored, type, cells, tables->parts) ||
                   hdf5_write_constant(root, "CellData/contact", H5T_STD_U8LE, H5T_NATIVE_UINT8, cells,
                                       tables->types) ||
                   hdf5_write_constant(root, "PointData/node_id", stored, type, points, tables->deck_place)
               ? -1
               : 0;
}

static int write_mixed_topology(hid_t file, const CellTables *tables)
{
    hid_t group = hdf5_create_group(file, "XDMF");
    if (group < 0) return -1;
    int status = hdf5_write_constant(group, "Topology", H5T_STD_I32LE, H5T_NATIVE_INT32,
                                     (hsize_t)tables->topology_length, tables->topology);
    return H5Gclose(group) < 0 ? -1 : status;
}

int vtkhdf_write_mesh(hid_t file, hid_t root, const Model *model)
{
    CellTables tables;
    MeshCount count = vtkhdf_count_cells(model);
    int status = allocate_tables(model, &tables);
    if (status == 0) {
        fill_tables(model, &tables);
        status = write_topology(root, model, &tables);
        if (status == 0 && count.triangles > 0 && count.quads > 0) status = write_mixed_topology(file, &tables);
        if (status == 0) status = write_ids(root, model, &tables);
    }
    free_tables(&tables);
    return status;
}
