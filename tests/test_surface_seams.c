/* The bag's surface at hanging nodes: slivers and mismatched sides become seams. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/surface_meshes.h"

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

/* A box of n quads per side whose lid is refined by k per quad side: each lid edge meets k lid facets' edges. */
static Mesh box_with_fine_lid(int n, int k)
{
    Mesh mesh = mesh_create(6 * (n + 1) * (n + 1) * k * k + 50, 6 * n * n * k * k + 50);
    const double z[3] = {0, 0, 3}, xz[3] = {1, 0, 3}, yz[3] = {0, 2, 3};
    add_box(&mesh, n, 0, 1, 2, 3, 32);
    add_grid(&mesh, n * k, n * k, z, xz, yz);
    merge_nodes(&mesh);
    return mesh;
}

static void test_hanging_nodes_become_seams(void **state)
{
    (void)state;
    for (int k = 2; k <= 5; k++)
        for (unsigned seed = 0; seed < 4; seed++) {
            Mesh mesh = box_with_fine_lid(3, k);
            scramble(&mesh, seed);
            assert_int_equal(mesh_close(&mesh), 0);
            assert_int_equal(mesh.closure.seams, 12);
            assert_int_equal(mesh.closure.holes, 0);
            assert_int_equal(mesh.closure.free_edges, 12 * (k + 1));
            assert_int_equal(mesh.closure.components, 1);
            for (int c = 0; c < 12; c++) assert_int_equal(mesh.closure.caps[c].count, k + 1);
            assert_near(mesh.closure.volume, 6.0, 1e-12);
            assert_near(mesh.closure.area, 22.0, 1e-12);
            assert_true(said(&mesh, SEVERITY_NOTE, "12 slivers of hanging nodes", "closed as seams"));
            /* the slivers open when the bag deforms: they keep it closed */
            for (int i = 0; i < 3 * mesh.node_count; i++) mesh.x[i] += 0.05 * sin(5.0 * i);
            mesh.closure.volume = mesh_volume(&mesh, (const double[3]){0, 0, 0});
            assert_near(mesh_leak(&mesh), 0.0, 1e-11);
            mesh_free(&mesh);
        }
}

/* Three quads against two on a straight line: no edge is a chord of the other side's chain, the loop is narrow all the
 * same. */
static void test_mismatched_sides_become_seams(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(100, 100);
    const double z[3] = {0, 0, 3}, xz[3] = {1, 0, 3}, yz[3] = {0, 2, 3};
    add_box(&mesh, 2, 0, 1, 2, 3, 32);
    add_grid(&mesh, 3, 3, z, xz, yz);
    merge_nodes(&mesh);
    scramble(&mesh, 2);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.seams, 4);
    assert_int_equal(mesh.closure.holes, 0);
    for (int c = 0; c < 4; c++) assert_int_equal(mesh.closure.caps[c].count, 5);
    assert_near(mesh.closure.volume, 6.0, 1e-12);
    mesh_free(&mesh);
}

/* A tetrahedron of which one face is cut in four: its three long edges also make a cycle of three. A sag of the middle
 * nodes beyond the seams' tolerance leaves the choice to the search for cycles. */
static void test_refined_triangle_between_coarse_ones(void **state)
{
    (void)state;
    for (int pass = 0; pass < 2; pass++) {
        Mesh mesh = mesh_create(10, 20);
        double sag = pass ? 0.05 : 0.0;
        add_node(&mesh, 0, 0, 0);
        add_node(&mesh, 1, 0, 0);
        add_node(&mesh, 0, 1, 0);
        add_node(&mesh, 0, 0, 1);
        add_node(&mesh, 0.5, -sag, -sag);
        add_node(&mesh, 0.5 + sag, 0.5 + sag, -sag);
        add_node(&mesh, -sag, 0.5, -sag);
        add_triangle(&mesh, 0, 1, 3);
        add_triangle(&mesh, 1, 2, 3);
        add_triangle(&mesh, 2, 0, 3);
        add_triangle(&mesh, 0, 6, 4);
        add_triangle(&mesh, 4, 5, 1);
        add_triangle(&mesh, 5, 6, 2);
        add_triangle(&mesh, 4, 6, 5);
        scramble(&mesh, 4);
        assert_int_equal(mesh_close(&mesh), 0);
        assert_int_equal(mesh.closure.cap_count, 3);
        assert_int_equal(mesh.closure.seams, pass ? 0 : 3);
        for (int c = 0; c < 3; c++) assert_int_equal(mesh.closure.caps[c].count, 3);
        assert_int_equal(mesh.closure.components, 1);
        if (pass == 0) assert_near(mesh.closure.volume, 1.0 / 6.0, 1e-14);
        assert_near(mesh_leak(&mesh), 0.0, 1e-11);
        mesh_free(&mesh);
    }
}

/* A strip closed to a band by a seam that turns it over. */
static void test_one_sided_seam_is_an_error(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(30, 30);
    for (int i = 0; i < 10; i++) {
        double t = 0.2 * 3.14159265358979 * i;
        for (int k = -1; k <= 1; k += 2)
            add_node(&mesh, (1 + 0.2 * k * cos(0.5 * t)) * cos(t), (1 + 0.2 * k * cos(0.5 * t)) * sin(t),
                     0.2 * k * sin(0.5 * t));
    }
    int middle = add_node(&mesh, 1, 0, 0);
    for (int i = 0; i < 8; i++) add_quad(&mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
    add_quad(&mesh, 16, 18, 19, 17);
    add_triangle(&mesh, 18, 1, middle);
    add_triangle(&mesh, 18, middle, 19);
    add_triangle(&mesh, 19, middle, 0);
    assert_int_equal(mesh_close(&mesh), -1);
    assert_true(said(&mesh, SEVERITY_ERROR, "cannot be oriented", "nodes 1001 and 1000") ||
                said(&mesh, SEVERITY_ERROR, "cannot be oriented", "nodes 1000 and 1001"));
    mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hanging_nodes_become_seams),
        cmocka_unit_test(test_mismatched_sides_become_seams),
        cmocka_unit_test(test_refined_triangle_between_coarse_ones),
        cmocka_unit_test(test_one_sided_seam_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
