/* The bag's surface: orientation, holes and caps on small meshes with known answers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "solver/memory.h"
#include "tests/surface_meshes.h"

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

static Mesh box(int n, int leave)
{
    Mesh mesh = mesh_create(6 * (n + 1) * (n + 1) + 8, 6 * n * n + 8);
    add_box(&mesh, n, 0, 1, 2, 3, leave);
    merge_nodes(&mesh);
    return mesh;
}

static int negatives(const Mesh *mesh)
{
    int count = 0;
    for (int f = 0; f < mesh->facet_count; f++) count += mesh->sign[f] < 0;
    return count;
}

static void test_mixed_windings_are_turned_outwards(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 20; seed++) {
        Mesh mesh = box(4, 0);
        int turned[96];
        memset(turned, 0, sizeof turned);
        Mesh straight = box(4, 0);
        scramble(&mesh, seed);
        assert_int_equal(mesh_close(&mesh), 0);
        for (int f = 0; f < 96; f++) {
            turned[f] = memcmp(mesh.facet + 4 * f, straight.facet + 4 * f, 4 * sizeof(int32_t)) != 0;
            assert_int_equal(mesh.sign[f], turned[f] ? -1 : 1);
        }
        assert_int_equal(mesh.closure.turned, negatives(&mesh));
        assert_int_equal(mesh.closure.components, 1);
        assert_int_equal(mesh.closure.free_edges + mesh.closure.cap_count, 0);
        assert_near(mesh.closure.volume, 6.0, 1e-13);
        assert_near(mesh.closure.area, 22.0, 1e-13);
        mesh_free(&mesh);
        mesh_free(&straight);
    }
}

static void test_inward_normals_are_all_turned(void **state)
{
    (void)state;
    Mesh mesh = box(3, 0);
    for (int f = 0; f < mesh.facet_count; f++) turn_facet(&mesh, f);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.turned, 54);
    assert_near(mesh.closure.volume, 6.0, 1e-13);
    mesh_free(&mesh);
}

static void test_box_without_lid_is_capped(void **state)
{
    (void)state;
    Mesh mesh = box(4, 32);
    scramble(&mesh, 3);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, 1);
    const SurfaceCap *cap = &mesh.closure.caps[0];
    assert_int_equal(cap->count, 16);
    assert_int_equal(mesh.closure.free_edges, 16);
    assert_near(cap->area, 2.0, 1e-13);
    assert_near(cap->size, sqrt(5.0), 1e-13);
    assert_near(cap->planarity, 0.0, 1e-13);
    assert_near(cap->centre[2], 3.0, 1e-13);
    assert_near(mesh.closure.area, 20.0, 1e-13);
    assert_near(mesh.closure.volume, 6.0, 1e-13);
    assert_near(mesh_leak(&mesh), 0.0, 1e-11);
    assert_true(said(&mesh, SEVERITY_NOTE, "hole of 16 edges capped", "area 2"));
    mesh_free(&mesh);
}

static void test_tube_has_two_caps(void **state)
{
    (void)state;
    Mesh mesh = box(2, 32 + 16);
    scramble(&mesh, 5);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, 2);
    assert_near(mesh.closure.volume, 6.0, 1e-13);
    assert_near(mesh_leak(&mesh), 0.0, 1e-11);
    mesh_free(&mesh);
}

/* Two flat discs (squares) that share their rim and lie on each other. */
static void test_flat_bag_keeps_most_windings(void **state)
{
    (void)state;
    for (int pass = 0; pass < 4; pass++) {
        Mesh mesh = mesh_create(100, 100);
        const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
        int odd = pass < 2 ? 7 : 0;
        int low = add_grid(&mesh, 4, 4, o, y, x), high = add_grid(&mesh, 4, 4, o, x, y);
        for (int i = 0; i < 4 * mesh.facet_count; i++) { /* the upper grid's rim becomes the lower one's */
            int at = mesh.facet[i] - high, col = at % 5, row = at / 5;
            if (at >= 0 && (col == 0 || col == 4 || row == 0 || row == 4))
                mesh.facet[i] = (int32_t)(low + 5 * col + row);
        }
        turn_facet(&mesh, odd);
        turn_facet(&mesh, 20);
        for (int f = 0; pass % 2 && f < mesh.facet_count; f++) turn_facet(&mesh, f);
        assert_int_equal(mesh_close(&mesh), 0);
        assert_near(mesh.closure.volume, 0.0, 1e-15);
        assert_int_equal(mesh.closure.holes, 0);
        for (int f = 0; f < mesh.facet_count; f++) assert_int_equal(mesh.sign[f], f == odd || f == 20 ? -1 : 1);
        assert_true(said(&mesh, SEVERITY_NOTE, "without volume", "most of the shells"));
        mesh_free(&mesh);
    }
}

static void test_moebius_strip_is_an_error_that_names_an_edge(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(20, 10);
    for (int i = 0; i < 10; i++) {
        double t = 0.2 * 3.14159265358979 * i;
        for (int k = -1; k <= 1; k += 2)
            add_node(&mesh, (1 + 0.2 * k * cos(0.5 * t)) * cos(t), (1 + 0.2 * k * cos(0.5 * t)) * sin(t),
                     0.2 * k * sin(0.5 * t));
    }
    for (int i = 0; i < 9; i++) add_quad(&mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
    add_quad(&mesh, 18, 1, 0, 19);
    assert_int_equal(mesh_close(&mesh), -1);
    assert_true(said(&mesh, SEVERITY_ERROR, "cannot be oriented", "edge between nodes 10"));
    assert_true(said(&mesh, SEVERITY_ERROR, "shells 50", "one-sided"));
    assert_null(mesh.closure.caps);
    mesh_free(&mesh);
}

static void test_flat_sheet_is_an_open_bag(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(200, 200);
    const double o[3] = {0.3, 0, 0.1}, x[3] = {4.3, 1, 0.2}, y[3] = {0, 3, 0.7};
    add_grid(&mesh, 7, 5, o, x, y);
    assert_int_equal(mesh_close(&mesh), -1);
    assert_true(said(&mesh, SEVERITY_ERROR, "the bag is open", "loop of 24 edges (nodes 10"));
    mesh_free(&mesh);
    mesh = mesh_create(200, 200); /* a flat ring: two loops, the error names the outer one */
    add_grid(&mesh, 7, 5, o, x, y);
    for (int i = 0; i < 4; i++) mesh.facet[4 * 17 + i] = mesh.facet[4 * 17];
    assert_int_equal(mesh_close(&mesh), -1);
    assert_true(said(&mesh, SEVERITY_ERROR, "the bag is open", "loop of 24 edges"));
    mesh_free(&mesh);
}

/* Hole sets in the 4 x 4 lid of a box by bit of the lid's facets; expected loops with their numbers of edges. */
static void check_lid(unsigned holes, int expected_count, const int *expected)
{
    for (unsigned seed = 0; seed < 3; seed++) {
        Mesh mesh = box(4, 0);
        scramble(&mesh, seed);
        for (int f = 80; f < 96; f++)
            for (int i = 0; (holes >> (f - 80) & 1) && i < 4; i++) mesh.facet[4 * f + i] = mesh.facet[4 * f];
        assert_int_equal(mesh_close(&mesh), 0);
        assert_int_equal(mesh.closure.holes, expected_count);
        int found[16] = {0};
        for (int c = 0; c < expected_count; c++) found[c] = mesh.closure.caps[c].count;
        for (int c = 0; c < expected_count; c++) assert_int_equal(found[c], expected[c]);
        assert_near(mesh.closure.volume, 6.0, 1e-12);
        assert_near(mesh_leak(&mesh), 0.0, 1e-11);
        mesh_free(&mesh);
    }
}

static void test_holes_that_touch_at_nodes(void **state)
{
    (void)state;
    check_lid(0x0021u, 2, (const int[]){4, 4});                   /* two facets across one node */
    check_lid(0x0033u | 0x4c00u, 2, (const int[]){8, 8});         /* 2 x 2 block and an L across its corner */
    check_lid(0x5a5au, 8, (const int[]){4, 4, 4, 4, 4, 4, 4, 4}); /* chequered: nine nodes of four free edges */
    check_lid(0x0690u, 3, (const int[]){4, 4, 6});
}

/* Eight free edges at one node: every second of eight triangles around the pole of a pyramid is missing. */
static void test_eight_free_edges_at_one_node(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(20, 40);
    int pole = add_node(&mesh, 0, 0, 1), foot = add_node(&mesh, 0, 0, -1);
    for (int i = 0; i < 8; i++) add_node(&mesh, cos(0.25 * 3.14159265 * i), sin(0.25 * 3.14159265 * i), 0.1 * (i % 2));
    for (int i = 0; i < 8; i++) {
        int a = 2 + i, b = 2 + (i + 1) % 8;
        if (i % 2) add_triangle(&mesh, pole, a, b);
        add_triangle(&mesh, foot, b, a);
    }
    scramble(&mesh, 11);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, 4);
    for (int c = 0; c < 4; c++) assert_int_equal(mesh.closure.caps[c].count, 3);
    assert_true(mesh.closure.volume > 0.5);
    assert_near(mesh_leak(&mesh), 0.0, 1e-11);
    mesh_free(&mesh);
}

/* A torus of which every second facet is missing, so that the others meet at nodes alone. */
static void test_chequered_torus(void **state)
{
    (void)state;
    enum { N = 12 };
    Mesh mesh = mesh_create(N * N, N * N);
    for (int i = 0; i < N * N; i++) {
        double s = i / N * 3.14159265358979 / 6, t = i % N * 3.14159265358979 / 6;
        add_node(&mesh, (3 + cos(t)) * cos(s), (3 + cos(t)) * sin(s), sin(t));
    }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            add_quad(&mesh, i * N + j, (i + 1) % N * N + j, (i + 1) % N * N + (j + 1) % N, i * N + (j + 1) % N);
    assert_int_equal(mesh_close(&mesh), 0);
    double volume = mesh.closure.volume;
    for (int f = 0; f < N * N; f++)
        for (int i = 0; (f / N + f) % 2 && i < 4; i++) mesh.facet[4 * f + i] = mesh.facet[4 * f];
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, N * N / 2);
    assert_int_equal(mesh.closure.components, 1);
    assert_near(mesh.closure.volume, volume, 1e-10); /* facets and holes are symmetric trapezoids: planar */
    for (int i = 0; i < 3 * N * N; i++)
        mesh.x[i] += 0.08 * sin(5.0 * i); /* some facets are smaller than the holes now */
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, N * N / 2);
    assert_int_equal(mesh.closure.inner, 0);
    mesh_free(&mesh);
}

static void test_two_shells_are_both_outward_and_reported(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(500, 500);
    add_box(&mesh, 3, 0, 4, 4, 4, 0);
    merge_nodes(&mesh);
    int outer = mesh.node_count, facets = mesh.facet_count;
    add_box(&mesh, 2, 1, 1, 1, 1, 0);
    for (int n = outer; n < mesh.node_count; n++)
        for (int k = 1; k < 3; k++) mesh.x[3 * n + k] += 1.0;
    merge_nodes(&mesh);
    for (int f = facets; f < mesh.facet_count; f++) turn_facet(&mesh, f);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.components, 2);
    assert_int_equal(mesh.closure.turned, mesh.facet_count - facets);
    assert_near(mesh.closure.volume, 65.0, 1e-12);
    assert_true(said(&mesh, SEVERITY_WARNING, "closed surface 2 lies within", "closed surface 1"));
    mesh_free(&mesh);
}

static void test_facets_without_area_change_nothing(void **state)
{
    (void)state;
    Mesh mesh = box(2, 0);
    int count = mesh.facet_count;
    for (int f = 0; f < count; f++) { /* every quad into four triangles, one of them of zero area, one of one node */
        int a = mesh.facet[4 * f], b = mesh.facet[4 * f + 1], c = mesh.facet[4 * f + 2], d = mesh.facet[4 * f + 3];
        if (f % 5) continue;
        double m[3];
        for (int k = 0; k < 3; k++) m[k] = 0.5 * (mesh.x[3 * a + k] + mesh.x[3 * c + k]);
        if (mesh.facet_count + 5 > 32) break;
        int n = add_node(&mesh, m[0], m[1], m[2]);
        mesh.facet[4 * f + 3] = mesh.facet[4 * f + 2]; /* a b c */
        add_triangle(&mesh, a, c, n);                  /* no area: n lies on a-c */
        add_triangle(&mesh, a, n, d);
        add_triangle(&mesh, n, c, d);
        add_quad(&mesh, b, b, b, b);
        add_quad(&mesh, a, b, a, d); /* folded on itself */
    }
    assert_true(mesh.facet_count > count);
    scramble(&mesh, 2);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.components, 1);
    assert_int_equal(mesh.closure.free_edges, 0);
    assert_near(mesh.closure.volume, 6.0, 1e-12);
    assert_near(mesh.closure.area, 22.0, 1e-12);
    mesh_free(&mesh);
}

/* Every allocation failing in turn: an error, an empty closure, nothing leaked. */
static void test_memory_shortage_is_reported(void **state)
{
    (void)state;
    Mesh mesh = box(4, 0);
    for (int f = 80; f < 96; f++)
        for (int i = 0; (0x0a5au >> (f - 80) & 1) && i < 4; i++) mesh.facet[4 * f + i] = mesh.facet[4 * f];
    add_triangle(&mesh, mesh.facet[0], mesh.facet[1], mesh.facet[4 * 40]); /* a flap */
    for (long k = 1;; k++) {
        assert_true(k < 1000);
        surface_closure_free(&mesh.closure);
        diagnostics_free(&mesh.diagnostics);
        size_t held = memory_in_use();
        memory_fail_after(k);
        int result = mesh_close(&mesh);
        memory_fail_after(0);
        if (result == 0) break;
        assert_int_equal(diagnostics_exit_code(&mesh.diagnostics), 3);
        assert_null(mesh.closure.caps);
        diagnostics_free(&mesh.diagnostics);
        assert_int_equal(memory_in_use(), held);
    }
    assert_int_equal(diagnostics_exit_code(&mesh.diagnostics), 0);
    mesh_free(&mesh);
}

/* A torus of 200,000 quads and triangles with mixed windings. */
static void test_large_surface(void **state)
{
    (void)state;
    enum { AROUND = 400, ACROSS = 400 };
    Mesh mesh = mesh_create(AROUND * ACROSS, 2 * AROUND * ACROSS);
    for (int i = 0; i < AROUND; i++)
        for (int j = 0; j < ACROSS; j++) {
            double s = 2 * 3.14159265358979 * i / AROUND, t = 2 * 3.14159265358979 * j / ACROSS;
            add_node(&mesh, (3 + cos(t)) * cos(s), (3 + cos(t)) * sin(s), sin(t));
        }
    for (int i = 0; i < AROUND; i++)
        for (int j = 0; j < ACROSS; j++) {
            int a = i * ACROSS + j, b = (i + 1) % AROUND * ACROSS + j;
            int c = (i + 1) % AROUND * ACROSS + (j + 1) % ACROSS, d = i * ACROSS + (j + 1) % ACROSS;
            if (j % 4) {
                add_quad(&mesh, a, b, c, d);
            } else {
                add_triangle(&mesh, a, b, c);
                add_triangle(&mesh, a, c, d);
            }
        }
    scramble(&mesh, 1);
    assert_int_equal(mesh.facet_count, 200000);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_near(mesh.closure.volume, 6 * 3.14159265358979 * 3.14159265358979, 0.01);
    assert_true(mesh.closure.turned > 90000 && mesh.closure.turned < 110000);
    mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mixed_windings_are_turned_outwards),
        cmocka_unit_test(test_inward_normals_are_all_turned),
        cmocka_unit_test(test_box_without_lid_is_capped),
        cmocka_unit_test(test_tube_has_two_caps),
        cmocka_unit_test(test_flat_bag_keeps_most_windings),
        cmocka_unit_test(test_moebius_strip_is_an_error_that_names_an_edge),
        cmocka_unit_test(test_flat_sheet_is_an_open_bag),
        cmocka_unit_test(test_holes_that_touch_at_nodes),
        cmocka_unit_test(test_eight_free_edges_at_one_node),
        cmocka_unit_test(test_chequered_torus),
        cmocka_unit_test(test_two_shells_are_both_outward_and_reported),
        cmocka_unit_test(test_facets_without_area_change_nothing),
        cmocka_unit_test(test_memory_shortage_is_reported),
        cmocka_unit_test(test_large_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
