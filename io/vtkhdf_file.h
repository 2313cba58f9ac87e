/* Inside of results.vtkhdf: the open file and the layout of its arrays. Included by io/vtkhdf*.c only. */
#ifndef BILLOW_VTKHDF_FILE_H
#define BILLOW_VTKHDF_FILE_H

#include "io/disk_space.h"
#include "io/hdf5_array.h"
#include "io/vtkhdf.h"

typedef enum DataArray {
    DATA_POINTS,
    DATA_VELOCITY,
    DATA_DISPLACEMENT,
    DATA_STRESS,
    DATA_STRAIN,
    DATA_THICKNESS,
    DATA_CONTACT,
    DATA_ERODED, /* the last: only of models with erosion */
    DATA_COUNT
} DataArray;

/* Arrays that grow with every state. */
typedef struct VtkHdfData {
    const char *name; /* below the VTKHDF group */
    int components;
    bool per_cell, is_double;
} VtkHdfData;
extern const VtkHdfData vtkhdf_data[DATA_COUNT];

typedef enum RowsPerState { ROWS_NONE, ROWS_POINTS, ROWS_CELLS } RowsPerState;

/* Integer columns of the Steps group: value = base + state index * rows per state. */
typedef struct VtkHdfColumn {
    const char *name; /* below the Steps group */
    int base;
    RowsPerState rows;
} VtkHdfColumn;
enum { COLUMN_COUNT = 15 }; /* the last for DATA_ERODED */
extern const VtkHdfColumn vtkhdf_columns[COLUMN_COUNT];

struct VtkHdf {
    Diagnostics *diagnostics; /* borrowed */
    char *path;
    hid_t file, root, steps;
    HdfArray data[DATA_COUNT], columns[COLUMN_COUNT], values;
    int data_count, column_count; /* of this model */
    hsize_t points, cells;        /* rows per state */
    bool reported;
    bool broken; /* HDF5 failed: it must not be called for this file again, it may crash */
    DiskSpace space;
    double *times; /* of the states in the file (count) */
    size_t count, capacity;
    int piece;    /* rows of a state that are staged and written together */
    double *rows; /* workspace for one piece: doubles (piece x 3) or floats (piece x 15) */
};

/* Memory and names for a file that is not open yet; NULL without memory (reported). */
VtkHdf *vtkhdf_allocate(const char *path, const Model *model, Diagnostics *diagnostics);

/* Adds the environment error "cannot ACTION PATH: errno" once; returns -1. */
int vtkhdf_report_failure(VtkHdf *grid, const char *action);
int vtkhdf_report_memory(Diagnostics *diagnostics, const char *path);

/* Takes disk space for bytes of data and the metadata of one state. 0, or -1 with errno set. */
int vtkhdf_reserve_space(VtkHdf *grid, hsize_t bytes);

/* Hands everything to the system and gives back what was reserved and not used. 0 or -1. */
int vtkhdf_flush(VtkHdf *grid);

#endif
