/* What the tests of results.vtkhdf share: a fresh folder each, and reading back with HDF5's own calls. */
#ifndef BILLOW_VTKHDF_CASE_H
#define BILLOW_VTKHDF_CASE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <hdf5.h>
#include <stdlib.h>
#include <unistd.h>

#include "elements/membrane.h"
#include "io/results.h"
#include "tests/small_model.h"

enum { VALUES = 1 << 16 };

static SmallModel small;
static char folder[64], grid_path[128], xdmf_path[128];
static Diagnostics diagnostics;

static inline int setup(void **unused)
{
    (void)unused;
    snprintf(folder, sizeof folder, "test_vtkhdf.XXXXXX");
    if (!mkdtemp(folder)) return -1;
    snprintf(grid_path, sizeof grid_path, "%s/results.vtkhdf", folder);
    snprintf(xdmf_path, sizeof xdmf_path, "%s/results.xdmf", folder);
    small_create(&small);
    memset(&diagnostics, 0, sizeof diagnostics);
    return 0;
}

static inline int teardown(void **unused)
{
    char aside[160];
    (void)unused;
    snprintf(aside, sizeof aside, "%s.damaged", grid_path);
    remove(aside);
    remove(grid_path);
    remove(xdmf_path);
    diagnostics_free(&diagnostics);
    return rmdir(folder);
}

static inline int write_state(Results *results, double time)
{
    small_set_time(&small, time);
    return results_write_state(results, &small.model, &small.state, &small.view);
}

static inline Results *open_results(bool append, double time)
{
    Results *results = NULL;
    assert_int_equal(results_open(folder, &small.model, append, time, &results, &diagnostics), 0);
    return results;
}

static inline void write_run(bool append, double restart, const double *times, int count)
{
    Results *results = open_results(append, restart);
    for (int i = 0; i < count; i++) assert_int_equal(write_state(results, times[i]), 0);
    assert_int_equal(results_close(results), 0);
    assert_int_equal(diagnostics.environment, 0);
}

static inline hid_t open_grid(void)
{
    hid_t file = H5Fopen(grid_path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    return file;
}

/* Reads a dataset as doubles; rank and sizes are checked against rows and components (1: rank 1). */
static inline void read_set(hid_t file, const char *name, hsize_t rows, hsize_t components, double *values)
{
    hsize_t size[2] = {0, 1};
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set < 0) print_error("no dataset %s\n", name);
    assert_true(set >= 0);
    hid_t space = H5Dget_space(set);
    assert_int_equal(H5Sget_simple_extent_ndims(space), components == 1 ? 1 : 2);
    H5Sget_simple_extent_dims(space, size, NULL);
    if (size[0] != rows || size[1] != components) print_error("%s has the wrong size\n", name);
    assert_true(size[0] == rows && size[1] == components && rows * components <= VALUES);
    assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Sclose(space);
    H5Dclose(set);
}

static inline void expect_set(hid_t file, const char *name, int count, const double *expected)
{
    double values[VALUES];
    read_set(file, name, (hsize_t)count, 1, values);
    for (int i = 0; i < count; i++) {
        if (values[i] != expected[i]) print_error("%s[%d] is %g, not %g\n", name, i, values[i], expected[i]);
        assert_true(values[i] == expected[i]);
    }
}

static inline void expect_type(hid_t file, const char *name, hid_t expected)
{
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set);
    assert_true(H5Tequal(type, expected) > 0);
    H5Tclose(type);
    H5Dclose(set);
}

static inline long long read_steps(hid_t file)
{
    long long steps = -1;
    hid_t attribute = H5Aopen_by_name(file, "VTKHDF/Steps", "NSteps", H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0);
    H5Aread(attribute, H5T_NATIVE_LLONG, &steps);
    H5Aclose(attribute);
    return steps;
}

static const double three[3] = {0, 0.25, 1.0 / 3};

/* Positions and velocities to the bit, the rest in single precision. */
static inline void check_states(const double *times, int count)
{
    static double points[VALUES], velocity[VALUES], displacement[VALUES], stress[VALUES], strain[VALUES],
        thickness[VALUES];
    const hsize_t nodes = (hsize_t)count * SMALL_NODES, cells = (hsize_t)count * SMALL_ELEMENTS;
    hid_t file = open_grid();
    assert_int_equal(read_steps(file), count);
    expect_set(file, "VTKHDF/Steps/Values", count, times);
    read_set(file, "VTKHDF/Points", nodes, 3, points);
    read_set(file, "VTKHDF/PointData/velocity", nodes, 3, velocity);
    read_set(file, "VTKHDF/PointData/displacement", nodes, 3, displacement);
    read_set(file, "VTKHDF/CellData/stress", cells, 6, stress);
    read_set(file, "VTKHDF/CellData/strain", cells, 6, strain);
    read_set(file, "VTKHDF/CellData/thickness", cells, 1, thickness);
    H5Fclose(file);
    for (int s = 0; s < count; s++) {
        small_set_time(&small, times[s]);
        for (int i = 0; i < 3 * SMALL_NODES; i++) {
            int from = 3 * small.deck_node[i / 3] + i % 3, at = 3 * SMALL_NODES * s + i;
            assert_true(points[at] == small.x[from]);
            assert_true(velocity[at] == small.v[from]);
            assert_true(displacement[at] == (double)(float)(small.x[from] - small.initial[from]));
        }
        for (int e = 0; e < SMALL_ELEMENTS; e++) {
            ElementResult result;
            int at = SMALL_ELEMENTS * s + e;
            membrane_result(&small.model, &small.state, small.x, e, &result);
            for (int c = 0; c < 6; c++) {
                assert_true(stress[6 * at + c] == (double)(float)result.stress[c]);
                assert_true(strain[6 * at + c] == (double)(float)result.strain[c]);
            }
            assert_true(thickness[at] == (double)(float)result.thickness);
        }
    }
}

static inline int count_text(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = strstr(text, part); at; at = strstr(at + 1, part)) count++;
    return count;
}

/* The index as text; it must be whole XML each time it is looked at. */
static inline void check_xdmf(int states)
{
    static char text[1 << 20];
    static const char end[] = "    </Grid>\n  </Domain>\n</Xdmf>\n";
    FILE *file = fopen(xdmf_path, "r");
    assert_non_null(file);
    size_t length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = 0;
    assert_true(length > sizeof end);
    assert_string_equal(text + length - strlen(end), end);
    assert_int_equal(count_text(text, end), 1);
    assert_int_equal(count_text(text, "<Grid "), states + 1);
    assert_int_equal(count_text(text, "</Grid>"), states + 1);
    assert_int_equal(count_text(text, "<Time Value="), states);
    assert_int_equal(count_text(text, "<DataItem"), count_text(text, "</DataItem>"));
    if (states < 3) return;
    assert_non_null(strstr(text, "<Time Value=\"0.33333333333333331\"/>"));
    assert_non_null(strstr(text, ">results.vtkhdf:/VTKHDF/Points|14 0:1 1:7 3:21 3</DataItem>"));
    assert_non_null(strstr(text, ">results.vtkhdf:/VTKHDF/CellData/thickness|8:1:4:12</DataItem>"));
    assert_int_equal(count_text(text, ">results.vtkhdf:/VTKHDF/CellData/part_id|0:1:4:4</DataItem>"), states);
    assert_int_equal(count_text(text, "TopologyType=\"Mixed\" NumberOfElements=\"4\""), states);
}

#endif
