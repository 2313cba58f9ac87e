/* Caps over holes: geometry, gradient by differences, force on the rim. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

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

/* Random shape of a capped mesh: gradient against central differences (V is a cubic of each coordinate). */
static void test_cap_gradient_by_differences(void **state)
{
    (void)state;
    static const double origin[3] = {0.2, -0.7, 0.4};
    Mesh mesh = box(3, 32 + 1);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_int_equal(mesh.closure.holes, 1);
    for (int i = 0; i < 3 * mesh.node_count; i++) mesh.x[i] += 0.2 * sin(7.0 * i);
    double *f = calloc((size_t)mesh.node_count * 3, sizeof *f), largest = 0.0;
    surface_cap_gradient(&mesh.closure, mesh.x, origin, 2.0, f);
    for (int i = 0; i < 3 * mesh.node_count; i++) {
        const double h = 1e-4, x = mesh.x[i];
        mesh.x[i] = x + h;
        double high = surface_cap_volume(&mesh.closure, mesh.x, origin);
        mesh.x[i] = x - h;
        double low = surface_cap_volume(&mesh.closure, mesh.x, origin);
        mesh.x[i] = x;
        assert_near(f[i], 2.0 * (high - low) / (2.0 * h), 1e-8);
        largest = fmax(largest, fabs(f[i]));
    }
    assert_true(largest > 0.1);
    free(f);
    mesh_free(&mesh);
}

/* The facets' shares and the caps' force are the exact gradient of the whole volume, and push nothing in sum. */
static void test_cap_force_closes_the_gradient(void **state)
{
    (void)state;
    static const double origin[3] = {3.2, -0.7, 0.4};
    Mesh mesh = box(3, 32 + 1 + 16);
    scramble(&mesh, 9);
    assert_int_equal(mesh_close(&mesh), 0);
    for (int i = 0; i < 3 * mesh.node_count; i++) mesh.x[i] += 0.1 * sin(5.0 * i);
    size_t size = (size_t)mesh.node_count * 3;
    double *f = calloc(size, sizeof *f), *g = calloc(size, sizeof *g), sum[3] = {0}, rim = 0.0;
    surface_cap_gradient(&mesh.closure, mesh.x, origin, 1.0, g);
    surface_cap_force(&mesh.closure, mesh.x, 1.0, f);
    for (size_t i = 0; i < size; i++) rim = fmax(rim, fabs(f[i]));
    for (int e = 0; e < mesh.facet_count; e++) {
        const double *p[4];
        double share[4][3], gradient[4][3];
        for (int i = 0; i < 4; i++) p[i] = mesh.x + 3 * mesh.facet[4 * e + i];
        volume_quad_shares(p[0], p[1], p[2], p[3], share);
        volume_quad_gradient(p[0], p[1], p[2], p[3], origin, gradient);
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++) {
                f[3 * mesh.facet[4 * e + i] + k] += mesh.sign[e] * share[i][k];
                g[3 * mesh.facet[4 * e + i] + k] += mesh.sign[e] * gradient[i][k];
            }
    }
    for (size_t i = 0; i < size; i++) {
        assert_near(f[i], g[i], 1e-13);
        sum[i % 3] += f[i];
    }
    assert_true(rim > 0.05);
    for (int k = 0; k < 3; k++) assert_near(sum[k], 0.0, 1e-13);
    free(f);
    free(g);
    mesh_free(&mesh);
}

static void test_warped_hole_is_warned_of(void **state)
{
    (void)state;
    Mesh mesh = box(4, 32);
    for (int n = 0; n < mesh.node_count; n++)
        if (mesh.x[3 * n + 2] > 2.9) mesh.x[3 * n + 2] += 2.0 * (mesh.x[3 * n] - 0.5) * (mesh.x[3 * n + 1] - 1.0);
    assert_int_equal(mesh_close(&mesh), 0);
    assert_true(mesh.closure.caps[0].planarity > 0.1);
    assert_true(said(&mesh, SEVERITY_WARNING, "hole of 16 edges", "far from plane"));
    mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cap_gradient_by_differences),
        cmocka_unit_test(test_cap_force_closes_the_gradient),
        cmocka_unit_test(test_warped_hole_is_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
