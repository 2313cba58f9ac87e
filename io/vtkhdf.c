/* results.vtkhdf: layout of the file, creation and appending states.
 *
 * Every state appends node_count rows to the point arrays and element_count rows to the cell arrays. The Steps group
 * says per state where its rows begin; an offset of 0 for every state marks what never changes: topology, ids, parts.
 * Rows pass through one small buffer in pieces, so that the memory a run holds for its results does not grow with the
 * mesh.
 */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "elements/membrane.h"
#include "io/vtkhdf_file.h"
#include "io/vtkhdf_mesh.h"
#include "solver/memory.h"

enum { PIECE_ROWS = 8192 }; /* staged together; divides CHUNK_ROWS_LIMIT */
enum { CHUNK_ROWS_LIMIT = 1 << 20, STEP_CHUNK = 128 };
enum { METADATA_RESERVE = 1 << 18 }; /* bytes: more than the index nodes that one state can add to all arrays */

const VtkHdfData vtkhdf_data[DATA_COUNT] = {
    [DATA_POINTS] = {"Points", 3, false, true},
    [DATA_VELOCITY] = {"PointData/velocity", 3, false, true},
    [DATA_DISPLACEMENT] = {"PointData/displacement", 3, false, false},
    [DATA_STRESS] = {"CellData/stress", 6, true, false},
    [DATA_STRAIN] = {"CellData/strain", 6, true, false},
    [DATA_THICKNESS] = {"CellData/thickness", 1, true, false},
    [DATA_CONTACT] = {"CellData/contact", 1, true, false},
    [DATA_ERODED] = {"CellData/eroded", 1, true, false},
};

const VtkHdfColumn vtkhdf_columns[COLUMN_COUNT] = {
    {"PartOffsets", 0, ROWS_NONE},
    {"NumberOfParts", 1, ROWS_NONE},
    {"PointOffsets", 0, ROWS_POINTS},
    {"CellOffsets", 0, ROWS_NONE},
    {"ConnectivityIdOffsets", 0, ROWS_NONE},
    {"PointDataOffsets/velocity", 0, ROWS_POINTS},
    {"PointDataOffsets/displacement", 0, ROWS_POINTS},
    {"PointDataOffsets/node_id", 0, ROWS_NONE},
    {"CellDataOffsets/stress", 0, ROWS_CELLS},
    {"CellDataOffsets/strain", 0, ROWS_CELLS},
    {"CellDataOffsets/thickness", 0, ROWS_CELLS},
    {"CellDataOffsets/part_id", 0, ROWS_NONE},
    {"CellDataOffsets/element_id", 0, ROWS_NONE},
    {"CellDataOffsets/contact", 0, ROWS_CELLS},
    {"CellDataOffsets/eroded", 0, ROWS_CELLS},
};

int vtkhdf_report_failure(VtkHdf *grid, const char *action)
{
    int cause = errno;
    if (!grid->reported)
        diagnostics_add(grid->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "cannot %s %s: %s; it holds %zu states, free space or choose another folder with -o", action,
                        grid->path, cause ? strerror(cause) : "HDF5 failed", grid->count);
    grid->reported = true;
    return -1;
}

int vtkhdf_report_memory(Diagnostics *diagnostics, const char *path)
{
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "not enough memory to write %s", path);
    return -1;
}

VtkHdf *vtkhdf_allocate(const char *path, const Model *model, Diagnostics *diagnostics)
{
    VtkHdf *grid = memory_alloc(1, sizeof *grid);
    if (!grid) return NULL;
    grid->diagnostics = diagnostics;
    grid->file = grid->root = grid->steps = -1;
    grid->space.file = -1;
    for (int i = 0; i < DATA_COUNT; i++) grid->data[i].dataset = -1;
    for (int i = 0; i < COLUMN_COUNT; i++) grid->columns[i].dataset = -1;
    grid->values.dataset = -1;
    grid->data_count = model->has_erosion ? DATA_COUNT : DATA_ERODED;
    grid->column_count = model->has_erosion ? COLUMN_COUNT : COLUMN_COUNT - 1;
    grid->points = (hsize_t)model->node_count;
    grid->cells = (hsize_t)model->element_count;
    grid->path = memory_alloc(strlen(path) + 1, 1);
    int most = model->node_count > model->element_count ? model->node_count : model->element_count;
    grid->piece = most > PIECE_ROWS ? PIECE_ROWS : most + 1;
    grid->rows = memory_alloc((size_t)grid->piece * 15, sizeof(float));
    if (!grid->path || !grid->rows) {
        vtkhdf_close(grid);
        return NULL;
    }
    strcpy(grid->path, path);
    return grid;
}

/* HDF5 leaves an unreadable file behind when the disk runs full, so the space is taken before HDF5 starts to write. */
int vtkhdf_reserve_space(VtkHdf *grid, hsize_t bytes)
{
    return grid->broken ? -1 : disk_space_reserve(&grid->space, grid->path, (off_t)bytes + METADATA_RESERVE);
}

/* Hands everything to the system and gives back what was reserved and not used. */
int vtkhdf_flush(VtkHdf *grid)
{
    hsize_t size = 0;
    if (H5Fflush(grid->file, H5F_SCOPE_GLOBAL) < 0 || H5Fget_filesize(grid->file, &size) < 0) return -1;
    return disk_space_trim(&grid->space, (off_t)size);
}

/* Bytes of one state, in whole chunks. */
static hsize_t state_bytes(const VtkHdf *grid)
{
    hsize_t bytes = 0;
    for (int i = 0; i < grid->data_count; i++) {
        hsize_t rows = vtkhdf_data[i].per_cell ? grid->cells : grid->points;
        if (rows > CHUNK_ROWS_LIMIT) rows = (rows / CHUNK_ROWS_LIMIT + 1) * CHUNK_ROWS_LIMIT;
        bytes += rows * (hsize_t)vtkhdf_data[i].components * (vtkhdf_data[i].is_double ? 8 : 4);
    }
    return bytes + (hsize_t)(grid->column_count + 1) * STEP_CHUNK * 8;
}

static int create_groups(VtkHdf *grid)
{
    static const char *const names[] = {
        "PointData", "CellData", "FieldData", "Steps", "Steps/PointDataOffsets", "Steps/CellDataOffsets"};
    const long long version[2] = {2, 0}, no_states = 0;
    grid->root = hdf5_create_group(grid->file, "VTKHDF");
    if (grid->root < 0 || hdf5_write_integers(grid->root, "Version", 2, version) ||
        hdf5_write_text(grid->root, "Type", "UnstructuredGrid"))
        return -1;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        hid_t group = hdf5_create_group(grid->root, names[i]);
        if (group < 0 || H5Gclose(group) < 0) return -1;
    }
    grid->steps = H5Gopen2(grid->root, "Steps", H5P_DEFAULT);
    return grid->steps < 0 || hdf5_write_integers(grid->steps, "NSteps", 0, &no_states) ? -1 : 0;
}

/* One state is one chunk, so that its rows lie together in the file. */
static int create_arrays(VtkHdf *grid)
{
    for (int i = 0; i < grid->data_count; i++) {
        hsize_t rows = vtkhdf_data[i].per_cell ? grid->cells : grid->points;
        hsize_t chunk = rows > CHUNK_ROWS_LIMIT ? CHUNK_ROWS_LIMIT : rows < 1 ? 1 : rows;
        bool is_double = vtkhdf_data[i].is_double;
        if (hdf5_create_array(grid->root, vtkhdf_data[i].name, is_double ? H5T_IEEE_F64LE : H5T_IEEE_F32LE,
                              is_double ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT, vtkhdf_data[i].components, chunk,
                              &grid->data[i]))
            return -1;
    }
    for (int i = 0; i < grid->column_count; i++)
        if (hdf5_create_array(grid->steps, vtkhdf_columns[i].name, H5T_STD_I64LE, H5T_NATIVE_INT64, 1, STEP_CHUNK,
                              &grid->columns[i]))
            return -1;
    return hdf5_create_array(grid->steps, "Values", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, STEP_CHUNK, &grid->values);
}

int vtkhdf_create(const char *path, const Model *model, VtkHdf **grid, Diagnostics *diagnostics)
{
    *grid = vtkhdf_allocate(path, model, diagnostics);
    if (!*grid) return vtkhdf_report_memory(diagnostics, path);
    errno = 0;
    (*grid)->file = hdf5_create_file(path);
    if ((*grid)->file >= 0 && vtkhdf_reserve_space(*grid, 80 * ((*grid)->points + (*grid)->cells)) == 0 &&
        create_groups(*grid) == 0 && create_arrays(*grid) == 0 &&
        vtkhdf_write_mesh((*grid)->file, (*grid)->root, model) == 0 && vtkhdf_flush(*grid) == 0)
        return 0;
    vtkhdf_report_failure(*grid, "create");
    if ((*grid)->file >= 0) remove(path);
    (*grid)->broken = true;
    vtkhdf_close(*grid);
    *grid = NULL;
    return -1;
}

int vtkhdf_state_count(const VtkHdf *grid)
{
    return (int)grid->count;
}

double vtkhdf_state_time(const VtkHdf *grid, int index)
{
    return grid->times[index];
}

/* Makes room in every array for the rows of the coming state. */
static int extend_arrays(VtkHdf *grid)
{
    for (int i = 0; i < grid->data_count; i++)
        if (hdf5_resize_array(&grid->data[i],
                              (grid->count + 1) * (vtkhdf_data[i].per_cell ? grid->cells : grid->points)))
            return -1;
    return 0;
}

/* Writes count rows of one array, from row first of the coming state. */
static int write_piece(VtkHdf *grid, DataArray which, int first, int count, const void *rows)
{
    hsize_t per_state = vtkhdf_data[which].per_cell ? grid->cells : grid->points;
    return hdf5_write_rows(&grid->data[which], grid->count * per_state + (hsize_t)first, (hsize_t)count, rows);
}

/* Rows of the piece that begins at first of total rows. */
static int piece_length(const VtkHdf *grid, int first, int total)
{
    return total - first < grid->piece ? total - first : grid->piece;
}

/* Positions or velocities in deck order. */
static int write_vectors(VtkHdf *grid, const Model *model, DataArray which, const double *source)
{
    for (int first = 0; first < model->node_count; first += grid->piece) {
        int count = piece_length(grid, first, model->node_count);
        for (int i = 0; i < count; i++)
            for (int c = 0; c < 3; c++)
                grid->rows[3 * (ptrdiff_t)i + c] = source[3 * (ptrdiff_t)model->deck_node[first + i] + c];
        if (write_piece(grid, which, first, count, grid->rows)) return -1;
    }
    return 0;
}

/* Share of an element's corners that are in contact. */
static float contact_share(const Model *model, const double *contact, int e)
{
    const int32_t *node = model->element_node + 4 * (ptrdiff_t)e;
    int corners = node[3] == node[2] ? 3 : 4, count = 0;
    if (!contact) return 0.0f;
    for (int k = 0; k < corners; k++) {
        count += contact[8 * (ptrdiff_t)node[k] + 3] > 0.0;
    }
    return (float)count / (float)corners;
}

static int write_displacements(VtkHdf *grid, const Model *model, const double *x)
{
    float *displacement = (float *)(void *)grid->rows;
    for (int first = 0; first < model->node_count; first += grid->piece) {
        int count = piece_length(grid, first, model->node_count);
        for (int i = 0; i < count; i++) {
            ptrdiff_t node = 3 * (ptrdiff_t)model->deck_node[first + i];
            for (int c = 0; c < 3; c++)
                displacement[3 * (ptrdiff_t)i + c] = (float)(x[node + c] - model->initial[node + c]);
        }
        if (write_piece(grid, DATA_DISPLACEMENT, first, count, displacement)) return -1;
    }
    return 0;
}

static int write_cell_data(VtkHdf *grid, const Model *model, const State *state, const double *x, const double *contact)
{
    float *stress = (float *)(void *)grid->rows, *strain = stress + 6 * (ptrdiff_t)grid->piece,
          *thickness = strain + 6 * (ptrdiff_t)grid->piece, *share = thickness + grid->piece,
          *eroded = share + grid->piece;
    for (int first = 0; first < model->element_count; first += grid->piece) {
        int count = piece_length(grid, first, model->element_count);
        for (int e = 0; e < count; e++) {
            ElementResult result;
            membrane_result(model, state, x, first + e, &result);
            for (int c = 0; c < 6; c++) {
                stress[6 * (ptrdiff_t)e + c] = (float)result.stress[c];
                strain[6 * (ptrdiff_t)e + c] = (float)result.strain[c];
            }
            thickness[e] = (float)result.thickness;
            eroded[e] = model->has_erosion && state->eroded[model->element_slot[first + e]] ? 1.0f : 0.0f;
            share[e] = eroded[e] > 0.0f     ? 0.0f
                       : model->walls_block ? (float)state->contact_share[first + e]
                                            : contact_share(model, contact, first + e);
        }
        if (write_piece(grid, DATA_STRESS, first, count, stress) ||
            write_piece(grid, DATA_STRAIN, first, count, strain) ||
            write_piece(grid, DATA_THICKNESS, first, count, thickness) ||
            write_piece(grid, DATA_CONTACT, first, count, share) ||
            (model->has_erosion && write_piece(grid, DATA_ERODED, first, count, eroded)))
            return -1;
    }
    return 0;
}

static int append_rows(VtkHdf *grid, const Model *model, const State *state, const double *x, const double *v,
                       const double *contact)
{
    return extend_arrays(grid) || write_vectors(grid, model, DATA_POINTS, x) ||
                   write_vectors(grid, model, DATA_VELOCITY, v) || write_displacements(grid, model, x) ||
                   write_cell_data(grid, model, state, x, contact)
               ? -1
               : 0;
}

/* The Steps group last: until NSteps counts the state, readers do not see it. */
static int append_step(VtkHdf *grid, double time)
{
    const long long states = (long long)grid->count + 1;
    for (int i = 0; i < grid->column_count; i++) {
        hsize_t stride = vtkhdf_columns[i].rows == ROWS_POINTS  ? grid->points
                         : vtkhdf_columns[i].rows == ROWS_CELLS ? grid->cells
                                                                : 0;
        const int64_t value = vtkhdf_columns[i].base + (int64_t)(grid->count * stride);
        if (hdf5_append_rows(&grid->columns[i], grid->count, 1, &value)) return -1;
    }
    return hdf5_append_rows(&grid->values, grid->count, 1, &time) ||
                   hdf5_write_integers(grid->steps, "NSteps", 0, &states) || vtkhdf_flush(grid)
               ? -1
               : 0;
}

int vtkhdf_write_state(VtkHdf *grid, const Model *model, const State *state, double time, const double *x,
                       const double *v, const double *contact)
{
    if (grid->count > 0 && !(time > grid->times[grid->count - 1])) return 0;
    if (memory_reserve((void **)&grid->times, &grid->capacity, grid->count + 1, sizeof *grid->times))
        return vtkhdf_report_memory(grid->diagnostics, grid->path);
    errno = 0;
    if (vtkhdf_reserve_space(grid, state_bytes(grid))) return vtkhdf_report_failure(grid, "write");
    if (append_rows(grid, model, state, x, v, contact) || append_step(grid, time)) {
        grid->broken = true;
        return vtkhdf_report_failure(grid, "write");
    }
    grid->times[grid->count++] = time;
    return 0;
}

static int close_handles(VtkHdf *grid)
{
    int status = 0;
    errno = 0;
    for (int i = 0; i < grid->data_count; i++) status |= hdf5_close_array(&grid->data[i]);
    for (int i = 0; i < grid->column_count; i++) status |= hdf5_close_array(&grid->columns[i]);
    status |= hdf5_close_array(&grid->values);
    if (grid->steps >= 0 && H5Gclose(grid->steps) < 0) status = -1;
    if (grid->root >= 0 && H5Gclose(grid->root) < 0) status = -1;
    if (grid->file >= 0 && H5Fclose(grid->file) < 0) status = -1;
    return status;
}

int vtkhdf_close(VtkHdf *grid)
{
    int status = 0;
    if (!grid) return 0;
    if (!grid->broken) status = close_handles(grid);
    if (disk_space_close(&grid->space)) status = -1;
    if (status) vtkhdf_report_failure(grid, "close");
    memory_free(grid->path);
    memory_free(grid->times);
    memory_free(grid->rows);
    memory_free(grid);
    return status ? -1 : 0;
}
