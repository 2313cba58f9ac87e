/* Arrays in an HDF5 file that grow by whole rows, and small fixed ones. HDF5's own error printing stays off; every
 * function returns 0 or -1. */
#ifndef BILLOW_HDF5_ARRAY_H
#define BILLOW_HDF5_ARRAY_H

#include <hdf5.h>

/* A dataset of rows x components (rank 1 for one component) whose number of rows grows. */
typedef struct HdfArray {
    hid_t dataset; /* open handle, negative if closed */
    hid_t type;    /* of the memory, a constant of the library */
    int components;
} HdfArray;

/* Creates (or truncates) or opens a file that HDF5 1.8 and newer can read, unlocked. Returns a handle or a negative. */
hid_t hdf5_create_file(const char *path);
hid_t hdf5_open_file(const char *path);

hid_t hdf5_create_group(hid_t parent, const char *name);

/* Creates an array without rows; chunk_rows rows are stored together. */
int hdf5_create_array(hid_t parent, const char *name, hid_t file_type, hid_t type, int components, hsize_t chunk_rows,
                      HdfArray *array);

/* Opens an array and checks its components; *rows is set. */
int hdf5_open_array(hid_t parent, const char *name, hid_t type, int components, HdfArray *array, hsize_t *rows);

/* Sets the number of rows; new ones are undefined. */
int hdf5_resize_array(const HdfArray *array, hsize_t rows);

/* Makes the array first + count rows long and writes the last count rows from data. */
int hdf5_append_rows(const HdfArray *array, hsize_t first, hsize_t count, const void *data);

/* Writes count of the rows the array already has, from first. */
int hdf5_write_rows(const HdfArray *array, hsize_t first, hsize_t count, const void *data);

/* Reads count rows from first. */
int hdf5_read_rows(const HdfArray *array, hsize_t first, hsize_t count, void *data);

int hdf5_close_array(HdfArray *array);

/* A dataset that never changes: rank 1, count values, written whole or by hdf5_write_rows in pieces. */
int hdf5_create_constant(hid_t parent, const char *name, hid_t file_type, hid_t type, hsize_t count, HdfArray *array);
int hdf5_write_constant(hid_t parent, const char *name, hid_t file_type, hid_t type, hsize_t count, const void *data);

/* Attributes: count integers (a scalar for count 0), a fixed-length ASCII string. write replaces the value of an
 * existing scalar. */
int hdf5_write_integers(hid_t object, const char *name, int count, const long long *values);
int hdf5_write_text(hid_t object, const char *name, const char *text);

#endif
