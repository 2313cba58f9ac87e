/* Intersections of a mesh: counts and places of triangles and quadrilaterals made to go through each other. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "contact/mesh_crossing.h"
#include "examples/scene.h"
#include "solver/memory.h"
#include "tests/program.h"

static const double plate[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static MeshCrossings look(int facets, const int32_t *facet, const double *x)
{
    MeshCrossings found;
    assert_int_equal(mesh_find_crossings(facets, facet, x, NULL, &found), 0);
    return found;
}

static MeshCrossings look_at_two(const double other[9])
{
    static const int32_t facet[] = {0, 1, 2, 2, 3, 4, 5, 5};
    double x[18];
    memcpy(x, plate, sizeof plate);
    memcpy(x + 9, other, sizeof plate);
    return look(2, facet, x);
}

static void finds_an_edge_through_a_triangle(void **state)
{
    (void)state;
    const MeshCrossings found = look_at_two((const double[]){0.2, 0.3, -0.1, 0.2, 0.3, 0.9, 0.201, 0.3, 0.9});
    assert_int_equal(found.count, 1);
    assert_float_equal(found.depth, 0.1, 1e-6);
    assert_float_equal(found.place[0], 0.2, 1e-3);
    assert_float_equal(found.place[1], 0.3, 1e-14);
    assert_float_equal(found.place[2], 0, 1e-14);
}

static void touching_and_coplanar_triangles_do_not_cross(void **state)
{
    (void)state;
    assert_int_equal(look_at_two((const double[]){0.2, 0.3, 0, 0.2, 0.3, 0.9, 2, 2, 0.4}).count, 0);
    assert_int_equal(look_at_two(plate).count, 0);
    assert_int_equal(look_at_two((const double[]){0.1, 0.1, 0, 0.9, 0.2, 0, 0.3, 0.8, 0}).count, 0);
    /* beside it, above it, and through its plane beyond the edge */
    assert_int_equal(look_at_two((const double[]){0.6, 0.6, -1, 0.6, 0.6, 1, 2, 2, 0}).count, 0);
    assert_int_equal(look_at_two((const double[]){0, 0, 1e-9, 1, 0, 1e-9, 0, 1, 1e-9}).count, 0);
}

static void a_shared_node_is_no_crossing(void **state)
{
    (void)state;
    const int32_t facet[] = {0, 1, 2, 2, 0, 3, 4, 4};
    const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.3, -0.5, 0.2, 0.3, 0.5};
    assert_int_equal(look(2, facet, x).count, 0);
}

static void both_halves_of_a_quadrilateral_count(void **state)
{
    (void)state;
    const int32_t facet[] = {0, 1, 2, 3, 4, 5, 6, 6};
    double x[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.7, 0.2, -1, 0.7, 0.2, 1, 5, 5, 0};
    assert_int_equal(look(2, facet, x).count, 1);
    x[12] = x[15] = 0.2, x[13] = x[16] = 0.7;
    assert_int_equal(look(2, facet, x).count, 1);
}

static void flags_pass_over_pairs(void **state)
{
    (void)state;
    const int32_t facet[] = {0, 1, 2, 2, 3, 4, 5, 5};
    const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.3, -0.1, 0.2, 0.3, 0.9, 2, 2, 0.4};
    MeshCrossings found;
    assert_int_equal(mesh_find_crossings(2, facet, x, (const unsigned char[]){0, 0}, &found), 0);
    assert_int_equal(found.count, 0);
    assert_int_equal(mesh_find_crossings(2, facet, x, (const unsigned char[]){0, 1}, &found), 0);
    assert_int_equal(found.count, 1);
}

/* Two spheres that overlap: every pair by hand against the grid. */
static void the_grid_misses_none(void **state)
{
    (void)state;
    SceneMesh mesh = {0};
    scene_add_sphere(&mesh, 1, SCENE_DIAGONAL, 6, 1.0);
    const int first = mesh.node_count;
    scene_add_sphere(&mesh, 2, SCENE_QUADS, 7, 0.8);
    scene_transform(&mesh, first, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[]){0.71, 0.53, 0.32});
    assert_false(mesh.failed);
    const MeshCrossings all = look(mesh.shell_count, (const int32_t *)mesh.shell, mesh.x);
    int pairs = 0;
    for (int a = 0; a < mesh.shell_count; a++)
        for (int b = a + 1; b < mesh.shell_count; b++) {
            int32_t two[8];
            memcpy(two, mesh.shell[a], sizeof mesh.shell[a]);
            memcpy(two + 4, mesh.shell[b], sizeof mesh.shell[b]);
            pairs += look(2, two, mesh.x).count;
        }
    assert_true(pairs > 50);
    assert_int_equal(all.count, pairs);
    assert_true(all.depth > 0.01);
    scene_mesh_free(&mesh);
}

static void missing_memory_is_told(void **state)
{
    (void)state;
    const int32_t facet[] = {0, 1, 2, 2};
    for (long k = 1; k <= 3; k++) {
        MeshCrossings found;
        memory_fail_after(k);
        assert_int_equal(mesh_find_crossings(1, facet, plate, NULL, &found), -1);
    }
    memory_fail_after(0);
}

static void billow_check_tells_the_pair(void **state)
{
    (void)state;
    Program program = {0};
    program_open(&program);
    program_write_bag(&program, "good.k", 4, NULL);
    assert_int_equal(program_run(&program, "check good.k"), 0);
    assert_non_null(strstr(program.out, "none: no shell goes through another one"));
    program_write_bag(&program, "bad.k", 4,
                      "*NODE\n9001,0.0,0.0,0.0\n9002,0.0,0.1,9.0\n9003,0.1,0.0,9.0\n"
                      "*ELEMENT_SHELL\n9001,1,9001,9002,9003,9003\n");
    program_run(&program, "check bad.k");
    assert_non_null(strstr(program.out, "shells go through each other; the deepest: "));
    assert_non_null(strstr(program.out, "9001, by"));
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_an_edge_through_a_triangle),
        cmocka_unit_test(touching_and_coplanar_triangles_do_not_cross),
        cmocka_unit_test(a_shared_node_is_no_crossing),
        cmocka_unit_test(both_halves_of_a_quadrilateral_count),
        cmocka_unit_test(flags_pass_over_pairs),
        cmocka_unit_test(the_grid_misses_none),
        cmocka_unit_test(missing_memory_is_told),
        cmocka_unit_test(billow_check_tells_the_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
