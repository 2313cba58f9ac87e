/* Volume and area of facets: formulas against quadrature and finite differences. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/surface_meshes.h"

static const double quad[4][3] = {{0.1, -0.2, 0.3}, {1.4, 0.1, -0.2}, {1.2, 1.1, 0.9}, {-0.3, 0.8, 0.1}};
static const double origin[3] = {0.4, 0.3, -1.7};

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Position, normal (r_u x r_v) and shape values of the bilinear patch. */
static void patch(double u, double v, double r[3], double normal[3], double shape[4])
{
    double ru[3] = {0}, rv[3] = {0};
    const double du[4] = {-(1 - v), 1 - v, v, -v}, dv[4] = {-(1 - u), -u, u, 1 - u};
    shape[0] = (1 - u) * (1 - v);
    shape[1] = u * (1 - v);
    shape[2] = u * v;
    shape[3] = (1 - u) * v;
    for (int k = 0; k < 3; k++) {
        r[k] = 0.0;
        for (int i = 0; i < 4; i++) {
            r[k] += shape[i] * quad[i][k];
            ru[k] += du[i] * quad[i][k];
            rv[k] += dv[i] * quad[i][k];
        }
    }
    cross(ru, rv, normal);
}

/* The 2 x 2 Gauss rule is exact here: the integrands are cubics in u and v at most. */
static void test_quad_is_the_bilinear_patch(void **state)
{
    (void)state;
    double volume = 0.0, share[4][3] = {{0}}, expected[4][3];
    for (int g = 0; g < 4; g++) {
        double u = 0.5 + (g & 1 ? 0.5 : -0.5) / sqrt(3.0), v = 0.5 + (g & 2 ? 0.5 : -0.5) / sqrt(3.0);
        double r[3], normal[3], shape[4];
        patch(u, v, r, normal, shape);
        for (int k = 0; k < 3; k++) volume += 0.25 / 3.0 * (r[k] - origin[k]) * normal[k];
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++) share[i][k] += 0.25 * shape[i] * normal[k];
    }
    assert_true(fabs(volume_quad(quad[0], quad[1], quad[2], quad[3], origin) - volume) < 1e-15);
    volume_quad_shares(quad[0], quad[1], quad[2], quad[3], expected);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) assert_true(fabs(share[i][k] - expected[i][k]) < 1e-15);
}

/* A repeated corner makes the quad a triangle. */
static void test_quad_degenerates_to_triangle(void **state)
{
    (void)state;
    double expected = volume_triangle(quad[0], quad[1], quad[2], origin);
    assert_true(fabs(volume_quad(quad[0], quad[1], quad[2], quad[2], origin) - expected) < 1e-15);
    assert_true(fabs(volume_quad(quad[0], quad[0], quad[1], quad[2], origin) - expected) < 1e-15);
    const int32_t node[4] = {0, 1, 2, 2};
    assert_true(fabs(volume_facet(node, &quad[0][0], origin) - expected) < 1e-15);
}

static void test_gradients_by_differences(void **state)
{
    (void)state;
    double x[4][3], triangle[3][3], four[4][3];
    memcpy(x, quad, sizeof x);
    volume_triangle_gradient(quad[0], quad[1], quad[2], origin, triangle);
    volume_quad_gradient(quad[0], quad[1], quad[2], quad[3], origin, four);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            const double h = 1e-3; /* V is linear in each coordinate: only rounding is left */
            x[i][k] = quad[i][k] + h;
            double high = volume_quad(x[0], x[1], x[2], x[3], origin), tri = volume_triangle(x[0], x[1], x[2], origin);
            x[i][k] = quad[i][k] - h;
            double low = volume_quad(x[0], x[1], x[2], x[3], origin);
            tri -= volume_triangle(x[0], x[1], x[2], origin);
            x[i][k] = quad[i][k];
            assert_true(fabs((high - low) / (2 * h) - four[i][k]) < 1e-12);
            if (i < 3) assert_true(fabs(tri / (2 * h) - triangle[i][k]) < 1e-12);
        }
}

/* On a closed surface the shares add up to the gradients at every node, and to zero in all. */
static void test_shares_are_the_gradient_of_a_closed_surface(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(400, 400);
    add_box(&mesh, 3, 0, 1, 2, 3, 0);
    merge_nodes(&mesh);
    for (int n = 0; n < mesh.node_count; n++) /* warp it */
        for (int k = 0; k < 3; k++)
            mesh.x[3 * n + k] += 0.1 * sin(3.0 * mesh.x[3 * n + (k + 1) % 3]) + 0.05 * mesh.x[3 * n + (k + 2) % 3];
    double *gradient = calloc((size_t)mesh.node_count * 3, sizeof *gradient), sum[3] = {0};
    for (int f = 0; f < mesh.facet_count; f++) {
        const double *p[4];
        double one[4][3], other[4][3];
        for (int i = 0; i < 4; i++) p[i] = mesh.x + 3 * mesh.facet[4 * f + i];
        volume_quad_gradient(p[0], p[1], p[2], p[3], origin, one);
        volume_quad_shares(p[0], p[1], p[2], p[3], other);
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++) {
                gradient[3 * mesh.facet[4 * f + i] + k] += one[i][k] - other[i][k];
                sum[k] += other[i][k];
            }
    }
    for (int i = 0; i < 3 * mesh.node_count; i++) assert_true(fabs(gradient[i]) < 1e-14);
    for (int k = 0; k < 3; k++) assert_true(fabs(sum[k]) < 1e-13);
    free(gradient);
    mesh_free(&mesh);
}

static void test_area_and_signs(void **state)
{
    (void)state;
    Mesh mesh = mesh_create(400, 400);
    add_box(&mesh, 2, 0, 1, 2, 3, 0);
    merge_nodes(&mesh);
    double area = 0.0;
    for (int f = 0; f < mesh.facet_count; f++) area += volume_facet_area(mesh.facet + 4 * f, mesh.x);
    assert_true(fabs(area - 22.0) < 1e-13);
    assert_true(fabs(volume_surface(mesh.facet_count, mesh.facet, NULL, mesh.x, origin) - 6.0) < 1e-13);
    for (int f = 0; f < mesh.facet_count; f++) mesh.sign[f] = -1;
    assert_true(fabs(volume_surface(mesh.facet_count, mesh.facet, mesh.sign, mesh.x, origin) + 6.0) < 1e-13);
    for (int f = 0; f < mesh.facet_count; f++) mesh.sign[f] = 0;
    assert_true(fabs(volume_surface(mesh.facet_count, mesh.facet, mesh.sign, mesh.x, origin)) <= 0.0);
    mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quad_is_the_bilinear_patch),
        cmocka_unit_test(test_quad_degenerates_to_triangle),
        cmocka_unit_test(test_gradients_by_differences),
        cmocka_unit_test(test_shares_are_the_gradient_of_a_closed_surface),
        cmocka_unit_test(test_area_and_signs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
