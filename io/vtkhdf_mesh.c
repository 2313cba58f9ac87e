/* The constant part of results.vtkhdf. */
#include "io/vtkhdf_mesh.h"

#include <string.h>

#include "io/hdf5_array.h"
#include "solver/memory.h"

enum { VTK_TRIANGLE = 5, VTK_QUAD = 9 };            /* VTK's cell types */
enum { XDMF_TRIANGLE = 4, XDMF_QUADRILATERAL = 5 }; /* XDMF's */

enum { PIECE_ITEMS = 8192, PIECE_BYTES = 40 }; /* cells or points written together; more bytes than one's values */

/* The arrays are made and written in pieces, in deck order. */
typedef struct MeshWriter {
    const Model *model;
    int32_t *deck_place; /* deck-order place of each internal node (node_count) */
    void *values;        /* of the piece at hand (PIECE_ITEMS x PIECE_BYTES bytes) */
    int64_t corners;     /* of the cells before the one at hand, for the offsets */
} MeshWriter;

typedef enum ValueKind { VALUE_INT64, VALUE_INT32, VALUE_UINT8 } ValueKind;

/* Sets the values of the items (cells or points) first to last - 1; returns how many values these are. */
typedef hsize_t FillPiece(MeshWriter *writer, int first, int last);

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

static int corner_count(const Model *model, int element)
{
    return is_quad(model, element) ? 4 : 3;
}

static hsize_t fill_connectivity(MeshWriter *writer, int first, int last)
{
    int64_t *values = writer->values;
    hsize_t count = 0;
    for (int e = first; e < last; e++)
        for (int c = 0; c < corner_count(writer->model, e); c++)
            values[count++] = writer->deck_place[writer->model->element_node[4 * (ptrdiff_t)e + c]];
    return count;
}

/* One item more than cells: the last is the length of the connectivity. */
static hsize_t fill_offsets(MeshWriter *writer, int first, int last)
{
    int64_t *values = writer->values;
    for (int e = first; e < last; e++) {
        values[e - first] = writer->corners;
        if (e < writer->model->element_count) writer->corners += corner_count(writer->model, e);
    }
    return (hsize_t)(last - first);
}

static hsize_t fill_types(MeshWriter *writer, int first, int last)
{
    uint8_t *values = writer->values;
    for (int e = first; e < last; e++) values[e - first] = is_quad(writer->model, e) ? VTK_QUAD : VTK_TRIANGLE;
    return (hsize_t)(last - first);
}

/* Each cell's XDMF type, then its corners. */
static hsize_t fill_mixed_topology(MeshWriter *writer, int first, int last)
{
    int32_t *values = writer->values;
    hsize_t count = 0;
    for (int e = first; e < last; e++) {
        values[count++] = is_quad(writer->model, e) ? XDMF_QUADRILATERAL : XDMF_TRIANGLE;
        for (int c = 0; c < corner_count(writer->model, e); c++)
            values[count++] = writer->deck_place[writer->model->element_node[4 * (ptrdiff_t)e + c]];
    }
    return count;
}

static hsize_t fill_element_ids(MeshWriter *writer, int first, int last)
{
    int32_t *values = writer->values;
    for (int e = first; e < last; e++) values[e - first] = writer->model->element_id[e];
    return (hsize_t)(last - first);
}

static hsize_t fill_part_ids(MeshWriter *writer, int first, int last)
{
    int32_t *values = writer->values;
    for (int e = first; e < last; e++) values[e - first] = writer->model->parts[writer->model->element_part[e]].id;
    return (hsize_t)(last - first);
}

static hsize_t fill_node_ids(MeshWriter *writer, int first, int last)
{
    int32_t *values = writer->values;
    for (int i = first; i < last; i++) values[i - first] = writer->model->node_id[writer->model->deck_node[i]];
    return (hsize_t)(last - first);
}

/* Writes a dataset of count values that belong to a number of items. */
static int write_pieces(MeshWriter *writer, hid_t parent, const char *name, ValueKind kind, hsize_t count, int items,
                        FillPiece *fill)
{
    const hid_t stored[] = {H5T_STD_I64LE, H5T_STD_I32LE, H5T_STD_U8LE};
    const hid_t types[] = {H5T_NATIVE_INT64, H5T_NATIVE_INT32, H5T_NATIVE_UINT8};
    HdfArray array;
    hsize_t written = 0;
    int status = hdf5_create_constant(parent, name, stored[kind], types[kind], count, &array);
    for (int first = 0; status == 0 && first < items; first += PIECE_ITEMS) {
        hsize_t filled = fill(writer, first, items - first < PIECE_ITEMS ? items : first + PIECE_ITEMS);
        status = hdf5_write_rows(&array, written, filled, writer->values);
        written += filled;
    }
    return hdf5_close_array(&array) ? -1 : status;
}

static int write_topology(MeshWriter *writer, hid_t root, int64_t corners)
{
    const int items = writer->model->element_count;
    const int64_t points = writer->model->node_count, cells = items;
    const hid_t type = H5T_NATIVE_INT64, stored = H5T_STD_I64LE;
    return hdf5_write_constant(root, "NumberOfPoints", stored, type, 1, &points) ||
                   hdf5_write_constant(root, "NumberOfCells", stored, type, 1, &cells) ||
                   hdf5_write_constant(root, "NumberOfConnectivityIds", stored, type, 1, &corners) ||
                   write_pieces(writer, root, "Connectivity", VALUE_INT64, (hsize_t)corners, items,
                                fill_connectivity) ||
                   write_pieces(writer, root, "Offsets", VALUE_INT64, (hsize_t)cells + 1, items + 1, fill_offsets) ||
                   write_pieces(writer, root, "Types", VALUE_UINT8, (hsize_t)cells, items, fill_types)
               ? -1
               : 0;
}

static int write_mixed_topology(MeshWriter *writer, hid_t file, int64_t corners)
{
    const int items = writer->model->element_count;
    hid_t group = hdf5_create_group(file, "XDMF");
    if (group < 0) return -1;
    int status =
        write_pieces(writer, group, "Topology", VALUE_INT32, (hsize_t)(corners + items), items, fill_mixed_topology);
    return H5Gclose(group) < 0 ? -1 : status;
}

static int write_ids(MeshWriter *writer, hid_t root)
{
    const int points = writer->model->node_count, cells = writer->model->element_count;
    return write_pieces(writer, root, "CellData/element_id", VALUE_INT32, (hsize_t)cells, cells, fill_element_ids) ||
                   write_pieces(writer, root, "CellData/part_id", VALUE_INT32, (hsize_t)cells, cells, fill_part_ids) ||
                   write_pieces(writer, root, "PointData/node_id", VALUE_INT32, (hsize_t)points, points, fill_node_ids)
               ? -1
               : 0;
}

int vtkhdf_write_mesh(hid_t file, hid_t root, const Model *model)
{
    const MeshCount count = vtkhdf_count_cells(model);
    const int64_t corners = 3 * (int64_t)count.triangles + 4 * (int64_t)count.quads;
    MeshWriter writer = {.model = model,
                         .deck_place = memory_alloc((size_t)model->node_count + 1, sizeof(int32_t)),
                         .values = memory_alloc(PIECE_ITEMS, PIECE_BYTES)};
    int status = writer.deck_place && writer.values ? 0 : -1;
    if (status == 0) {
        for (int i = 0; i < model->node_count; i++) writer.deck_place[model->deck_node[i]] = i;
        status = write_topology(&writer, root, corners);
        if (status == 0 && count.triangles > 0 && count.quads > 0)
            status = write_mixed_topology(&writer, file, corners);
        if (status == 0) status = write_ids(&writer, root);
    }
    memory_free(writer.deck_place);
    memory_free(writer.values);
    return status;
}
