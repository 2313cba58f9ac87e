/* Convex meshes: what is one, distances against closed forms and libccd at random places, overlaps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <ccd/ccd.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "contact/convex_hull.h"
#include "examples/scene.h"
#include "solver/vector3.h"
#include "tests/ccd_ball.h"

static HullKind make(const SceneMesh *mesh, int count, ConvexHull *hull)
{
    HullKind kind;
    assert_int_equal(convex_hull_make(count, &mesh->shell[0][0], mesh->x, hull, &kind), 0);
    return kind;
}

static void make_box(SceneMesh *mesh, double a, double b, double c, double x)
{
    *mesh = (SceneMesh){0};
    scene_add_box(mesh, 1, 1, 1, a, b, c);
    scene_transform(mesh, 0, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[]){x, 0, 0});
}

/* Distance from a box about the origin in closed form. */
static double box_distance(const double half[3], const double r[3])
{
    double out = 0, in = -INFINITY;
    for (int k = 0; k < 3; k++) {
        double beyond = fabs(r[k]) - half[k];
        out += beyond > 0 ? beyond * beyond : 0;
        in = fmax(in, beyond);
    }
    return in > 0 ? sqrt(out) : in;
}

static void boxes(void **state)
{
    (void)state;
    SceneMesh mesh;
    ConvexHull hull;
    const double half[3] = {1, 0.75, 0.5};
    make_box(&mesh, 2, 1.5, 1, 3);
    assert_int_equal(make(&mesh, mesh.shell_count, &hull), HULL_CONVEX);
    assert_int_equal(hull.plane_count, 6);
    assert_int_equal(hull.corner_count, 8);
    assert_true(fabs(hull.origin[0] - 4) < 1e-14 && fabs(hull.radius - vector3_norm(half)) < 1e-14);
    for (int i = 0; i < 20000; i++) {
        double r[3], n[3];
        for (int k = 0; k < 3; k++) r[k] = random_number(-2, 2);
        double d = convex_hull_distance(&hull, r, n);
        assert_true(fabs(d - box_distance(half, r)) < 1e-12);
        assert_true(fabs(vector3_norm(n) - 1) < 1e-12);
        double back[3]; /* the foot is on the surface */
        for (int k = 0; k < 3; k++) back[k] = r[k] - d * n[k];
        assert_true(fabs(box_distance(half, back)) < 1e-9);
    }
    convex_hull_free(&hull);
    scene_mesh_free(&mesh);
}

static void support_hull(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
    const ConvexHull *hull = object;
    double most = -INFINITY;
    for (int c = 0; c < hull->corner_count; c++) {
        double along = vector3_dot(direction->v, hull->corner + 3 * c);
        if (along > most) memcpy(point->v, hull->corner + 3 * c, sizeof point->v);
        most = fmax(most, along);
    }
}

/* Outside the radius from which on a ball meets the hull is the distance; inside libccd's way out is no shorter. */
static void against_libccd(void **state)
{
    (void)state;
    SceneMesh mesh = {0};
    ConvexHull hull;
    double outside = 0, least = 1;
    scene_add_sphere(&mesh, 1, SCENE_DIAGONAL, 3, 1);
    scene_transform(&mesh, 0, (const double[]){1.5, 0.3, 0, 0, 0.8, 0, 0, 0.2, 0.6}, (const double[]){0, 0, 0});
    assert_int_equal(make(&mesh, mesh.shell_count, &hull), HULL_CONVEX);
    assert_true(hull.dent < 1e-14);
    for (int i = 0; i < 500; i++) {
        double r[3], n[3];
        ccd_t ccd;
        for (int k = 0; k < 3; k++) r[k] = random_number(-1.5, 1.5);
        double d = convex_hull_distance(&hull, r, n);
        Ball ball = {{r[0], r[1], r[2]}, 1e-3};
        CCD_INIT(&ccd);
        ccd.support1 = support_hull;
        ccd.support2 = support_ball;
        ccd.center1 = middle_at_origin;
        ccd.center2 = middle_of_ball;
        ccd.mpr_tolerance = 1e-12;
        ccd.max_iterations = 10000;
        if (d > 0) {
            double low = 0, high = 10;
            for (int j = 0; j < 60; j++) {
                ball.radius = 0.5 * (low + high);
                *(ccdMPRIntersect(&hull, &ball, &ccd) ? &high : &low) = ball.radius;
            }
            outside = fmax(outside, fabs(d - high));
        } else {
            ccd_real_t depth = 0;
            ccd_vec3_t direction, position;
            assert_int_equal(ccdMPRPenetration(&hull, &ball, &ccd, &depth, &direction, &position), 0);
            least = fmin(least, depth - ball.radius + d);
        }
    }
    print_message("    outside off by %.2g, depth by libccd more by %.2g at least\n", outside, least);
    assert_true(outside < 1e-11 && least > -1e-11);
    convex_hull_free(&hull);
    scene_mesh_free(&mesh);
}

static void kinds(void **state)
{
    (void)state;
    SceneMesh mesh;
    ConvexHull hull;
    make_box(&mesh, 1, 1, 1, 0);
    assert_int_equal(make(&mesh, mesh.shell_count - 1, &hull), HULL_OPEN);
    convex_hull_free(&hull);
    assert_int_equal(make(&mesh, 0, &hull), HULL_OPEN);
    convex_hull_free(&hull);
    for (int k = 0; k < 3; k++) mesh.x[3 * 6 + k] -= 0.4; /* a corner pushed in */
    assert_int_equal(make(&mesh, mesh.shell_count, &hull), HULL_CONCAVE);
    convex_hull_free(&hull);
    scene_mesh_free(&mesh);
    make_box(&mesh, 1, 1, 1e-5, 0);
    assert_int_equal(make(&mesh, mesh.shell_count, &hull), HULL_FLAT);
    convex_hull_free(&hull);
    scene_mesh_free(&mesh);
    scene_add_sphere(&mesh, 1, SCENE_QUADS, 6, 1); /* its quadrilaterals are not quite flat */
    assert_int_equal(make(&mesh, mesh.shell_count, &hull), HULL_CONVEX);
    print_message("    a sphere of 216 quadrilaterals has dents of %.2g of its radius\n", hull.dent / hull.radius);
    convex_hull_free(&hull);
    scene_mesh_free(&mesh);
}

static void overlaps(void **state)
{
    (void)state;
    SceneMesh mesh[2];
    ConvexHull hull[2];
    double place[3];
    const double shift[] = {0.9, 1.0, 1.2, 1.9999, 2.001, 5};
    for (int i = 0; i < 6; i++) {
        make_box(&mesh[0], 2, 3, 4, 0);
        make_box(&mesh[1], 2, 3, 4, shift[i]);
        for (int k = 0; k < 2; k++) assert_int_equal(make(&mesh[k], mesh[k].shell_count, &hull[k]), HULL_CONVEX);
        double depth = convex_hull_overlap(&hull[0], &hull[1], place);
        if (shift[i] < 2) {
            assert_true(fabs(depth - (2 - shift[i])) < 1e-5);
            assert_true(place[0] > shift[i] - 1e-5 && place[0] < 2 + 1e-5);
        } else {
            assert_true(depth == 0);
        }
        for (int k = 0; k < 2; k++) {
            convex_hull_free(&hull[k]);
            scene_mesh_free(&mesh[k]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(boxes), cmocka_unit_test(against_libccd),
                                       cmocka_unit_test(kinds), cmocka_unit_test(overlaps)};
    return cmocka_run_group_tests_name("convex meshes", tests, NULL, NULL);
}
