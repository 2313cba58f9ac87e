/* results.vtkhdf and results.xdmf: the published layout, and states to the bit. */
#include "tests/vtkhdf_case.h"

#include <sys/stat.h>

static void test_attributes(void **unused)
{
    (void)unused;
    write_run(false, 0, three, 3);
    long long version[2] = {0, 0};
    char text[17] = "";
    hid_t file = open_grid();
    hid_t attribute = H5Aopen_by_name(file, "VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT);
    assert_int_equal(H5Aget_storage_size(attribute), 16);
    H5Aread(attribute, H5T_NATIVE_LLONG, version);
    H5Aclose(attribute);
    assert_true(version[0] == 2 && version[1] == 0);
    attribute = H5Aopen_by_name(file, "VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
    hid_t type = H5Aget_type(attribute);
    assert_true(H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0);
    assert_true(H5Tget_cset(type) == H5T_CSET_ASCII && H5Tget_size(type) == 16);
    H5Aread(attribute, type, text);
    assert_string_equal(text, "UnstructuredGrid");
    H5Tclose(type);
    H5Aclose(attribute);
    assert_int_equal(read_steps(file), 3);
    H5Fclose(file);
}

/* Deck order: the model keeps its nodes in another one. */
static void test_static_mesh(void **unused)
{
    (void)unused;
    write_run(false, 0, three, 3);
    const double connectivity[13] = {0, 1, 2, 3, 1, 4, 2, 4, 5, 2, 4, 6, 5}, offsets[5] = {0, 4, 7, 10, 13};
    const double types[4] = {9, 5, 5, 5}, counts[3] = {7, 4, 13};
    const double nodes[7] = {101, 102, 103, 104, 105, 106, 107}, ids[4] = {11, 12, 13, 14}, parts[4] = {10, 10, 20, 30};
    const double mixed[17] = {5, 0, 1, 2, 3, 4, 1, 4, 2, 4, 4, 5, 2, 4, 4, 6, 5};
    hid_t file = open_grid();
    expect_set(file, "VTKHDF/NumberOfPoints", 1, counts);
    expect_set(file, "VTKHDF/NumberOfCells", 1, counts + 1);
    expect_set(file, "VTKHDF/NumberOfConnectivityIds", 1, counts + 2);
    expect_set(file, "VTKHDF/Connectivity", 13, connectivity);
    expect_set(file, "VTKHDF/Offsets", 5, offsets);
    expect_set(file, "VTKHDF/Types", 4, types);
    expect_set(file, "VTKHDF/PointData/node_id", 7, nodes);
    expect_set(file, "VTKHDF/CellData/element_id", 4, ids);
    expect_set(file, "VTKHDF/CellData/part_id", 4, parts);
    expect_set(file, "XDMF/Topology", 17, mixed);
    expect_type(file, "VTKHDF/Types", H5T_STD_U8LE);
    expect_type(file, "VTKHDF/Connectivity", H5T_STD_I64LE);
    expect_type(file, "VTKHDF/Offsets", H5T_STD_I64LE);
    expect_type(file, "VTKHDF/Points", H5T_IEEE_F64LE);
    H5Fclose(file);
}

/* The offsets by which a reader finds a state: 0 for what is static, growing by the mesh's size for what moves. */
static void test_step_columns(void **unused)
{
    (void)unused;
    write_run(false, 0, three, 3);
    static const struct {
        const char *name;
        double first, step;
    } columns[] = {
        {"PartOffsets", 0, 0},
        {"NumberOfParts", 1, 0},
        {"PointOffsets", 0, SMALL_NODES},
        {"CellOffsets", 0, 0},
        {"ConnectivityIdOffsets", 0, 0},
        {"PointDataOffsets/velocity", 0, SMALL_NODES},
        {"PointDataOffsets/displacement", 0, SMALL_NODES},
        {"PointDataOffsets/node_id", 0, 0},
        {"CellDataOffsets/stress", 0, SMALL_ELEMENTS},
        {"CellDataOffsets/strain", 0, SMALL_ELEMENTS},
        {"CellDataOffsets/thickness", 0, SMALL_ELEMENTS},
        {"CellDataOffsets/part_id", 0, 0},
        {"CellDataOffsets/element_id", 0, 0},
        {"CellDataOffsets/contact", 0, SMALL_ELEMENTS},
    };
    hid_t file = open_grid(), steps = H5Gopen2(file, "VTKHDF/Steps", H5P_DEFAULT);
    expect_set(steps, "Values", 3, three);
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++) {
        const double expected[3] = {columns[i].first, columns[i].first + columns[i].step,
                                    columns[i].first + 2 * columns[i].step};
        expect_set(steps, columns[i].name, 3, expected);
        expect_type(steps, columns[i].name, H5T_STD_I64LE);
    }
    H5Gclose(steps);
    H5Fclose(file);
}

static void test_states(void **unused)
{
    (void)unused;
    struct stat file;
    write_run(false, 0, three, 3);
    check_states(three, 3);
    assert_int_equal(stat(grid_path, &file), 0);
    assert_in_range(file.st_size, 0, 150000); /* nothing of the reserved space is left behind */
}

/* Many more states than one chunk of the Steps columns holds. */
static void test_many_states(void **unused)
{
    (void)unused;
    double times[150];
    for (int i = 0; i < 150; i++) times[i] = i / 7.0;
    write_run(false, 0, times, 150);
    check_states(times, 150);
}

static void test_xdmf(void **unused)
{
    (void)unused;
    Results *results = open_results(false, 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(write_state(results, three[i]), 0);
        check_xdmf(i + 1);
    }
    assert_int_equal(results_close(results), 0);
    write_run(true, 0.25, three, 2);
    check_xdmf(2);
    write_run(true, 0.25, three, 3);
    check_xdmf(3);
}

/* One kind of cell: plain topology, no XDMF group. */
static void test_triangles_only(void **unused)
{
    (void)unused;
    static char text[1 << 16];
    small.element_node[3] = small.element_node[2];
    write_run(false, 0, three, 1);
    hid_t file = open_grid();
    assert_int_equal(H5Lexists(file, "XDMF", H5P_DEFAULT), 0);
    H5Fclose(file);
    FILE *xdmf = fopen(xdmf_path, "r");
    assert_true(fread(text, 1, sizeof text - 1, xdmf) > 0);
    fclose(xdmf);
    assert_non_null(strstr(text, "TopologyType=\"Triangle\" NumberOfElements=\"4\"><DataItem Format=\"HDF\" "
                                 "NumberType=\"Int\" Precision=\"8\" Dimensions=\"12\">results.vtkhdf:/VTKHDF/"
                                 "Connectivity</DataItem>"));
}

int main(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_attributes, setup, teardown),
        cmocka_unit_test_setup_teardown(test_static_mesh, setup, teardown),
        cmocka_unit_test_setup_teardown(test_step_columns, setup, teardown),
        cmocka_unit_test_setup_teardown(test_states, setup, teardown),
        cmocka_unit_test_setup_teardown(test_many_states, setup, teardown),
        cmocka_unit_test_setup_teardown(test_xdmf, setup, teardown),
        cmocka_unit_test_setup_teardown(test_triangles_only, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
