/* Growing arrays in an HDF5 file. */
#include "io/hdf5_array.h"

#include <string.h>

/* The oldest format that serves (readers from HDF5 1.8 on), and no lock: a viewer may open the file of a live run. */
static hid_t file_access(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access < 0) return -1;
    herr_t status = H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
#if H5_VERSION_GE(1, 10, 7) && !(H5_VERSION_GE(1, 12, 0) && !H5_VERSION_GE(1, 12, 1))
    if (status >= 0) status = H5Pset_file_locking(access, 0, 1);
#endif
    if (status >= 0) return access;
    H5Pclose(access);
    return -1;
}

/* No printing by the library, and no clean-up at exit: that could crash on a file whose writing has failed. */
static void quiet_library(void)
{
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

hid_t hdf5_create_file(const char *path)
{
    quiet_library();
    hid_t access = file_access();
    if (access < 0) return -1;
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    return file;
}

hid_t hdf5_open_file(const char *path)
{
    quiet_library();
    hid_t access = file_access();
    if (access < 0) return -1;
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, access);
    H5Pclose(access);
    return file;
}

hid_t hdf5_create_group(hid_t parent, const char *name)
{
    return H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

static int rank_of(const HdfArray *array)
{
    return array->components == 1 ? 1 : 2;
}

int hdf5_create_array(hid_t parent, const char *name, hid_t file_type, hid_t type, int components, hsize_t chunk_rows,
                      HdfArray *array)
{
    *array = (HdfArray){-1, type, components};
    const hsize_t width = (hsize_t)components;
    const hsize_t size[2] = {0, width}, limit[2] = {H5S_UNLIMITED, width}, chunk[2] = {chunk_rows, width};
    hid_t space = H5Screate_simple(rank_of(array), size, limit);
    hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    if (space >= 0 && creation >= 0 && H5Pset_chunk(creation, rank_of(array), chunk) >= 0 &&
        H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0)
        array->dataset = H5Dcreate2(parent, name, file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (creation >= 0) H5Pclose(creation);
    if (space >= 0) H5Sclose(space);
    return array->dataset < 0 ? -1 : 0;
}

int hdf5_open_array(hid_t parent, const char *name, hid_t type, int components, HdfArray *array, hsize_t *rows)
{
    hsize_t size[2] = {0, 0};
    *array = (HdfArray){H5Dopen2(parent, name, H5P_DEFAULT), type, components};
    if (array->dataset < 0) return -1;
    hid_t space = H5Dget_space(array->dataset);
    if (space < 0) return -1;
    bool fits = H5Sget_simple_extent_ndims(space) == rank_of(array) &&
                H5Sget_simple_extent_dims(space, size, NULL) >= 0 &&
                (components == 1 || size[1] == (hsize_t)components);
    H5Sclose(space);
    *rows = size[0];
    return fits ? 0 : -1;
}

int hdf5_resize_array(const HdfArray *array, hsize_t rows)
{
    const hsize_t size[2] = {rows, (hsize_t)array->components};
    return H5Dset_extent(array->dataset, size) < 0 ? -1 : 0;
}

/* Moves count rows from first between the file and data. */
static int transfer_rows(const HdfArray *array, hsize_t first, hsize_t count, void *into, const void *from)
{
    const hsize_t start[2] = {first, 0}, size[2] = {count, (hsize_t)array->components};
    int status = -1;
    hid_t memory = H5Screate_simple(rank_of(array), size, NULL);
    hid_t space = H5Dget_space(array->dataset);
    if (memory >= 0 && space >= 0 && H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, size, NULL) >= 0) {
        herr_t done = from ? H5Dwrite(array->dataset, array->type, memory, space, H5P_DEFAULT, from)
                           : H5Dread(array->dataset, array->type, memory, space, H5P_DEFAULT, into);
        status = done < 0 ? -1 : 0;
    }
    if (space >= 0) H5Sclose(space);
    if (memory >= 0) H5Sclose(memory);
    return status;
}

int hdf5_write_rows(const HdfArray *array, hsize_t first, hsize_t count, const void *data)
{
    return transfer_rows(array, first, count, NULL, data);
}

int hdf5_append_rows(const HdfArray *array, hsize_t first, hsize_t count, const void *data)
{
    return hdf5_resize_array(array, first + count) ? -1 : hdf5_write_rows(array, first, count, data);
}

int hdf5_read_rows(const HdfArray *array, hsize_t first, hsize_t count, void *data)
{
    return transfer_rows(array, first, count, data, NULL);
}

int hdf5_close_array(HdfArray *array)
{
    herr_t status = array->dataset >= 0 ? H5Dclose(array->dataset) : 0;
    array->dataset = -1;
    return status < 0 ? -1 : 0;
}

int hdf5_create_constant(hid_t parent, const char *name, hid_t file_type, hid_t type, hsize_t count, HdfArray *array)
{
    *array = (HdfArray){-1, type, 1};
    hid_t space = H5Screate_simple(1, &count, NULL);
    if (space < 0) return -1;
    array->dataset = H5Dcreate2(parent, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Sclose(space);
    return array->dataset < 0 ? -1 : 0;
}

int hdf5_write_constant(hid_t parent, const char *name, hid_t file_type, hid_t type, hsize_t count, const void *data)
{
    HdfArray array;
    if (hdf5_create_constant(parent, name, file_type, type, count, &array)) return -1;
    int status = hdf5_write_rows(&array, 0, count, data);
    return hdf5_close_array(&array) ? -1 : status;
}

int hdf5_write_integers(hid_t object, const char *name, int count, const long long *values)
{
    hsize_t size = (hsize_t)count;
    int status = -1;
    hid_t attribute = -1;
    hid_t space = count == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    if (space < 0) return -1;
    if (H5Aexists(object, name) > 0)
        attribute = H5Aopen(object, name, H5P_DEFAULT);
    else
        attribute = H5Acreate2(object, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute >= 0) {
        status = H5Awrite(attribute, H5T_NATIVE_LLONG, values) < 0 ? -1 : 0;
        if (H5Aclose(attribute) < 0) status = -1;
    }
    H5Sclose(space);
    return status;
}

int hdf5_write_text(hid_t object, const char *name, const char *text)
{
    int status = -1;
    hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
    if (space >= 0 && type >= 0 && H5Tset_size(type, strlen(text)) >= 0 && H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 &&
        H5Tset_cset(type, H5T_CSET_ASCII) >= 0) {
        hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
        if (attribute >= 0) {
            status = H5Awrite(attribute, type, text) < 0 ? -1 : 0;
            if (H5Aclose(attribute) < 0) status = -1;
        }
    }
    if (type >= 0) H5Tclose(type);
    if (space >= 0) H5Sclose(space);
    return status;
}
