/* The bag's surface on edges of three and more facets: inner walls, tethers, flaps, second layers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/surface_meshes.h"

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

static int left_out(const Mesh *mesh, int first, int end)
{
    int count = 0;
    for (int f = first; f < end; f++) count += mesh->sign[f] == 0;
    return count;
}

/* ---- walls ---- */

/* A box divided by walls at the grid lines at[i] along x; the walls' nodes are the box's. */
static Mesh box_with_walls(int n, int count, const int *at)
{
    Mesh mesh = mesh_create((6 + count) * (n + 1) * (n + 1) + 10, (6 + count) * n * n + 10);
    add_box(&mesh, n, 0, 1, 2, 3, 0);
    for (int i = 0; i < count; i++) {
        double x = (double)at[i] / n;
        const double o[3] = {x, 0, 0}, y[3] = {x, 2, 0}, z[3] = {x, 0, 3};
        add_grid(&mesh, n, n, o, y, z);
    }
    merge_nodes(&mesh);
    return mesh;
}

static void test_inner_walls_count_for_nothing(void **state)
{
    (void)state;
    static const int at[3][3] = {{3, 0, 0}, {2, 3, 0}, {1, 3, 5}};
    for (int count = 1; count <= 3; count++)
        for (unsigned seed = 0; seed < 4; seed++) {
            Mesh mesh = box_with_walls(6, count, at[count - 1]);
            int outer = 6 * 36;
            scramble(&mesh, seed);
            assert_int_equal(mesh_close(&mesh), 0);
            assert_int_equal(left_out(&mesh, 0, outer), 0);
            assert_int_equal(left_out(&mesh, outer, mesh.facet_count), 36 * count);
            assert_int_equal(mesh.closure.inner, 36 * count);
            assert_int_equal(mesh.closure.components, 1);
            assert_near(mesh.closure.volume, 6.0, 1e-12);
            assert_near(mesh.closure.area, 22.0, 1e-12);
            assert_near(mesh_leak(&mesh), 0.0, 1e-10);
            assert_true(said(&mesh, SEVERITY_NOTE, "bound no gas", "in inner walls"));
            mesh_free(&mesh);
        }
}

/* A hole in the wall is no hole of the bag. */
static void test_wall_with_a_hole(void **state)
{
    (void)state;
    Mesh mesh = box_with_walls(5, 1, (const int[]){2});
    int hole = 6 * 25 + 12;
    for (int i = 0; i < 4; i++) mesh.facet[4 * hole + i] = mesh.facet[4 * hole];
    scramble(&mesh, 1);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, 0);
    assert_int_equal(mesh.closure.inner, 24);
    assert_near(mesh.closure.volume, 6.0, 1e-12);
    mesh_free(&mesh);
}

/* A ring with one wall across: no second chamber; even a flat ring is clear. */
static void test_wall_across_a_flat_ring(void **state)
{
    (void)state;
    enum { AROUND = 12, ACROSS = 4 };
    for (int flat = 0; flat < 2; flat++) {
        Mesh mesh = mesh_create(AROUND * ACROSS, AROUND * ACROSS + 1);
        static const double u[ACROSS] = {1, 2, 2, 1}, w[ACROSS] = {0, 0, 1, 1};
        for (int i = 0; i < AROUND; i++)
            for (int j = 0; j < ACROSS; j++)
                add_node(&mesh, u[j] * cos(i * 3.14159265358979 / 6), u[j] * sin(i * 3.14159265358979 / 6),
                         flat ? 0.0 : w[j]);
        for (int i = 0; i < AROUND; i++)
            for (int j = 0; j < ACROSS; j++)
                add_quad(&mesh, i * ACROSS + j, (i + 1) % AROUND * ACROSS + j,
                         (i + 1) % AROUND * ACROSS + (j + 1) % ACROSS, i * ACROSS + (j + 1) % ACROSS);
        add_quad(&mesh, 0, 1, 2, 3);
        scramble(&mesh, 6);
        assert_int_equal(mesh_close(&mesh), 0);
        assert_int_equal(mesh.sign[AROUND * ACROSS], 0);
        assert_int_equal(mesh.closure.inner, 1);
        assert_near(mesh.closure.volume, flat ? 0.0 : 9.0, 1e-12);
        mesh_free(&mesh);
    }
}

/* A ring with two walls on one circle, which bulge apart: the space between them is a chamber of the bag too. If the
 * ring is flat the walls follow each other and their pressures cancel. */
static void test_two_walls_on_one_circle(void **state)
{
    (void)state;
    for (int pass = 0; pass < 12; pass++) {
        int flat = pass % 2;
        Mesh mesh = mesh_create(60, 80);
        static const double u[4] = {1, 2, 2, 1}, w[4] = {0, 0, 1, 1};
        for (int i = 0; i < 48; i++)
            add_node(&mesh, u[i % 4] * cos(i / 4 * 3.14159265358979 / 6), u[i % 4] * sin(i / 4 * 3.14159265358979 / 6),
                     flat ? 0.0 : w[i % 4]);
        for (int i = 0; i < 12; i++)
            for (int j = 0; j < 4; j++)
                add_quad(&mesh, 4 * i + j, 4 * ((i + 1) % 12) + j, 4 * ((i + 1) % 12) + (j + 1) % 4,
                         4 * i + (j + 1) % 4);
        for (int side = -1; side <= 1; side += 2) {
            int middle = add_node(&mesh, 1.5, 0.2 * side, flat ? 0.0 : 0.5);
            for (int j = 0; j < 4; j++) add_triangle(&mesh, j, (j + 1) % 4, middle);
        }
        scramble(&mesh, (unsigned)pass);
        assert_int_equal(mesh_close(&mesh), 0);
        assert_int_equal(left_out(&mesh, 0, 48), 0);
        assert_int_equal(mesh.closure.inner, flat ? 0 : 8);
        assert_near(mesh.closure.volume, flat ? 0.0 : 9.0, 1e-12);
        for (int i = 0; i < 3 * mesh.node_count; i++) mesh.x[i] += 0.05 * sin(5.0 * i);
        mesh.closure.volume = mesh_volume(&mesh, (const double[3]){0, 0, 0});
        assert_near(mesh_leak(&mesh), 0.0, 1e-11); /* every edge cancels */
        mesh_free(&mesh);
    }
}

/* Two chambers that share a flat wall, all of it flat: which is the wall cannot be known. */
static void test_undecidable_wall_names_the_edge(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(12, 12);
    for (int i = 0; i < 4; i++) add_node(&mesh, i % 2, i / 2, 0);
    for (int layer = 0; layer < 3; layer++) {
        int middle = add_node(&mesh, 0.5, 0.5, 0);
        add_triangle(&mesh, 0, 1, middle);
        add_triangle(&mesh, 1, 3, middle);
        add_triangle(&mesh, 3, 2, middle);
        add_triangle(&mesh, 2, 0, middle);
    }
    for (int n = 0; n < mesh.node_count; n++) /* rounding gives it volumes that mean nothing */
        mesh.x[3 * n + 2] = 0.37 * mesh.x[3 * n] + 0.11 * mesh.x[3 * n + 1] + 1e-13 * sin(n);
    assert_int_equal(mesh_close(&mesh), -1);
    assert_true(said(&mesh, SEVERITY_ERROR, "3 shells (5000, 5004, 5008) meet", "between nodes 1000 and 1001"));
    mesh_free(&mesh);
}

/* Two boxes on one common edge (four facets) are two chambers of one bag; a third of the same kind makes six. */
static void test_boxes_that_touch_along_an_edge(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(500, 500);
    add_box(&mesh, 2, 0, 1, 1, 1, 0);
    int first = mesh.node_count;
    add_box(&mesh, 2, 1, 1, 1, 1, 0);
    for (int n = first; n < mesh.node_count; n++) mesh.x[3 * n + 1] += 1.0;
    merge_nodes(&mesh);
    scramble(&mesh, 8);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.inner, 0);
    assert_near(mesh.closure.volume, 2.0, 1e-13);
    assert_near(mesh_leak(&mesh), 0.0, 1e-11);
    mesh_free(&mesh);
}

/* Two tubes stitched together along a line that ends in both rims: no flaps, two holes at each end. */
static void test_stitched_line_up_to_the_rim(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(500, 500);
    add_box(&mesh, 2, 0, 1, 1, 1, 48);
    int first = mesh.node_count;
    add_box(&mesh, 2, 1, 1, 1, 1, 48);
    for (int n = first; n < mesh.node_count; n++) mesh.x[3 * n + 1] += 1.0;
    merge_nodes(&mesh);
    scramble(&mesh, 8);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.inner, 0);
    assert_int_equal(mesh.closure.holes, 4);
    assert_near(mesh.closure.volume, 2.0, 1e-13);
    mesh_free(&mesh);
}

/* ---- tethers, flaps, second layers, loose sheets ---- */

static void test_tether_and_flap(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 4; seed++) {
        Mesh mesh = mesh_create(500, 500);
        add_box(&mesh, 4, 0, 1, 2, 3, 0);
        int outer = mesh.facet_count;
        const double a[3] = {0.25, 0.5, 0}, b[3] = {0.25, 1.0, 0}, c[3] = {0.25, 0.5, 3};
        add_grid(&mesh, 1, 5, a, b, c); /* a strap from floor to lid */
        const double d[3] = {1, 0.5, 1.5}, e[3] = {1, 1.5, 1.5}, f[3] = {1.4, 0.5, 1.8};
        add_grid(&mesh, 2, 2, d, e, f); /* a flap outside */
        merge_nodes(&mesh);
        scramble(&mesh, seed);
        assert_int_equal(mesh_close(&mesh), 0);
        assert_int_equal(left_out(&mesh, 0, outer), 0);
        assert_int_equal(left_out(&mesh, outer, mesh.facet_count), 9);
        assert_int_equal(mesh.closure.holes, 0);
        assert_near(mesh.closure.volume, 6.0, 1e-12);
        assert_true(said(&mesh, SEVERITY_NOTE, "9 shells, the first 5096", "9 in flaps and tethers"));
        mesh_free(&mesh);
    }
}

/* An open box whose wall reaches up to the rim: the wall is the flap, the rim stays one hole. */
static void test_wall_up_to_the_rim_of_a_hole(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(500, 500);
    add_box(&mesh, 4, 0, 1, 2, 3, 32);
    int outer = mesh.facet_count;
    const double o[3] = {0.5, 0, 0}, y[3] = {0.5, 2, 0}, z[3] = {0.5, 0, 3};
    add_grid(&mesh, 4, 4, o, y, z);
    merge_nodes(&mesh);
    scramble(&mesh, 3);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(left_out(&mesh, 0, outer), 0);
    assert_int_equal(mesh.closure.inner, 16);
    assert_int_equal(mesh.closure.holes, 1);
    assert_int_equal(mesh.closure.caps[0].count, 16);
    assert_near(mesh.closure.volume, 6.0, 1e-12);
    mesh_free(&mesh);
}

static void test_second_layers_are_left_out(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(500, 500);
    add_box(&mesh, 4, 0, 1, 2, 3, 0);
    int outer = mesh.facet_count;
    for (int f = 3; f < 40; f += 4) {
        const int32_t *n = mesh.facet + 4 * f;
        int copy = add_quad(&mesh, n[2], n[3], n[0], n[1]);
        if (f % 8 == 3) turn_facet(&mesh, copy);
    }
    merge_nodes(&mesh);
    scramble(&mesh, 3);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(left_out(&mesh, 0, outer), 0);
    assert_int_equal(mesh.closure.inner, mesh.facet_count - outer);
    assert_near(mesh.closure.volume, 6.0, 1e-12);
    assert_near(mesh.closure.area, 22.0, 1e-12);
    assert_true(said(&mesh, SEVERITY_NOTE, "10 shells", "10 in second layers"));
    mesh_free(&mesh);
}

static void test_loose_sheet_beside_a_closed_bag(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(500, 500);
    add_box(&mesh, 2, 0, 1, 2, 3, 0);
    const double o[3] = {0.5, 0.2, 0.2}, y[3] = {0.5, 1, 0.2}, z[3] = {0.5, 0.2, 2};
    add_grid(&mesh, 2, 2, o, y, z);
    merge_nodes(&mesh);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.inner, 4);
    assert_int_equal(mesh.closure.components, 1);
    assert_int_equal(mesh.closure.holes, 0);
    assert_near(mesh.closure.volume, 6.0, 1e-12);
    assert_true(said(&mesh, SEVERITY_WARNING, "left out of the bag: 4 shells", "loop of 8 edges"));
    mesh_free(&mesh);
}

/* The order of the facets and the start of each facet's node list do not matter for what is found. */
static void test_order_does_not_matter(void **state)
{
    (void)state;
    double volume = 0.0;
    for (int pass = 0; pass < 5; pass++) {
        Mesh mesh = box_with_walls(6, 2, (const int[]){2, 4});
        Mesh other = mesh_create(mesh.node_count, mesh.facet_count);
        for (int n = 0; n < mesh.node_count; n++) add_node(&other, mesh.x[3 * n], mesh.x[3 * n + 1], mesh.x[3 * n + 2]);
        for (int i = 0; i < mesh.facet_count; i++) {
            const int32_t *n = mesh.facet + 4 * ((i * 61 + 13 * pass) % mesh.facet_count);
            add_quad(&other, n[pass % 4], n[(1 + pass) % 4], n[(2 + pass) % 4], n[(3 + pass) % 4]);
        }
        scramble(&other, (unsigned)pass);
        assert_int_equal(mesh_close(&other), 0);
        assert_int_equal(other.closure.inner, 72);
        if (pass > 0) assert_near(other.closure.volume, volume, 1e-12);
        volume = other.closure.volume;
        mesh_free(&mesh);
        mesh_free(&other);
    }
    assert_near(volume, 6.0, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inner_walls_count_for_nothing),   cmocka_unit_test(test_wall_with_a_hole),
        cmocka_unit_test(test_wall_across_a_flat_ring),         cmocka_unit_test(test_undecidable_wall_names_the_edge),
        cmocka_unit_test(test_boxes_that_touch_along_an_edge),  cmocka_unit_test(test_two_walls_on_one_circle),
        cmocka_unit_test(test_stitched_line_up_to_the_rim),     cmocka_unit_test(test_tether_and_flap),
        cmocka_unit_test(test_wall_up_to_the_rim_of_a_hole),    cmocka_unit_test(test_second_layers_are_left_out),
        cmocka_unit_test(test_loose_sheet_beside_a_closed_bag), cmocka_unit_test(test_order_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
