/* results.vtkhdf after a restart: reopening, dropping late states, setting a damaged file aside. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "io/vtkhdf_file.h"
#include "solver/memory.h"

static int read_count(hid_t root, const char *name, int64_t *count)
{
    HdfArray array;
    hsize_t rows = 0;
    int status = hdf5_open_array(root, name, H5T_NATIVE_INT64, 1, &array, &rows);
    if (status == 0) status = rows == 1 ? hdf5_read_rows(&array, 0, 1, count) : -1;
    hdf5_close_array(&array);
    return status;
}

/* Opens groups and arrays of an existing file. 0, or -1 if something is missing or does not fit. */
static int open_arrays(VtkHdf *grid, hsize_t *states)
{
    hsize_t rows = 0;
    grid->root = H5Gopen2(grid->file, "VTKHDF", H5P_DEFAULT);
    if (grid->root < 0) return -1;
    grid->steps = H5Gopen2(grid->root, "Steps", H5P_DEFAULT);
    if (grid->steps < 0) return -1;
    if (hdf5_open_array(grid->steps, "Values", H5T_NATIVE_DOUBLE, 1, &grid->values, states)) return -1;
    for (int i = 0; i < grid->data_count; i++) {
        hsize_t per_state = vtkhdf_data[i].per_cell ? grid->cells : grid->points;
        if (hdf5_open_array(grid->root, vtkhdf_data[i].name,
                            vtkhdf_data[i].is_double ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT, vtkhdf_data[i].components,
                            &grid->data[i], &rows))
            return -1;
        if (rows < *states * per_state) *states = rows / per_state;
    }
    for (int i = 0; i < grid->column_count; i++) {
        if (hdf5_open_array(grid->steps, vtkhdf_columns[i].name, H5T_NATIVE_INT64, 1, &grid->columns[i], &rows))
            return -1;
        if (rows < *states) *states = rows;
    }
    return 0;
}

/* Sets the file to its first count states. */
static int set_state_count(VtkHdf *grid, size_t count)
{
    const long long states = (long long)count;
    if (vtkhdf_reserve_space(grid, 0)) return -1;
    for (int i = 0; i < grid->data_count; i++)
        if (hdf5_resize_array(&grid->data[i], count * (vtkhdf_data[i].per_cell ? grid->cells : grid->points)))
            return -1;
    for (int i = 0; i < grid->column_count; i++)
        if (hdf5_resize_array(&grid->columns[i], count)) return -1;
    grid->count = count;
    return hdf5_resize_array(&grid->values, count) || hdf5_write_integers(grid->steps, "NSteps", 0, &states) ||
                   vtkhdf_flush(grid)
               ? -1
               : 0;
}

/* Reads the times and keeps the states up to restart_time. */
static int drop_late_states(VtkHdf *grid, hsize_t states, double restart_time)
{
    size_t keep = 0;
    if (memory_reserve((void **)&grid->times, &grid->capacity, states + 1, sizeof *grid->times))
        return vtkhdf_report_memory(grid->diagnostics, grid->path);
    if (states > 0 && hdf5_read_rows(&grid->values, 0, states, grid->times)) return vtkhdf_report_failure(grid, "read");
    while (keep < states && grid->times[keep] <= restart_time) keep++;
    return set_state_count(grid, keep) ? vtkhdf_report_failure(grid, "shorten") : 0;
}

/* Moves a file that cannot be continued out of the way. */
static int set_aside(const char *path, Diagnostics *diagnostics)
{
    char aside[4096];
    int length = snprintf(aside, sizeof aside, "%s.damaged", path);
    if (length < 0 || length >= (int)sizeof aside || rename(path, aside)) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "%s is damaged and cannot be moved out of the way: %s", path, strerror(errno));
        return -1;
    }
    diagnostics_add(diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, NULL,
                    "%s was cut off and cannot be continued; it is kept as %s, and the new file starts at the restart",
                    path, aside);
    return 0;
}

int vtkhdf_append(const char *path, const Model *model, double restart_time, VtkHdf **grid, Diagnostics *diagnostics)
{
    int64_t points = -1, cells = -1;
    hsize_t states = 0;
    int status = 0;
    VtkHdf *opened = vtkhdf_allocate(path, model, diagnostics);
    *grid = NULL;
    if (!opened) return vtkhdf_report_memory(diagnostics, path);
    opened->file = hdf5_open_file(path);
    bool damaged = opened->file < 0 || read_count(opened->file, "VTKHDF/NumberOfPoints", &points) ||
                   read_count(opened->file, "VTKHDF/NumberOfCells", &cells);
    if (!damaged && (points != model->node_count || cells != model->element_count)) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "%s holds the results of another model; choose another folder with -o", path);
        status = -1;
    } else {
        damaged = damaged || open_arrays(opened, &states);
        if (!damaged) status = drop_late_states(opened, states, restart_time);
    }
    if (!damaged && status == 0) {
        *grid = opened;
        return 0;
    }
    opened->reported = true; /* closing a damaged file may fail again */
    vtkhdf_close(opened);
    if (status) return -1;
    return set_aside(path, diagnostics) || vtkhdf_create(path, model, grid, diagnostics) ? -1 : 0;
}
