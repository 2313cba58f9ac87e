/* Distances and normals of the rigid walls' shapes. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include "contact/rigid_wall.h"

static const double UP[3] = {0, 0, 1};

static void expect_gap(const RigidWall *wall, double x, double y, double z, double distance, const double normal[3])
{
    WallGap gap = rigid_wall_gap(wall, (const double[3]){x, y, z});
    assert_true(gap.over);
    verify_near("distance", gap.distance, distance, 1e-14);
    for (int k = 0; k < 3; k++) verify_near("normal", gap.normal[k], normal[k], 1e-14);
}

static void shapes_have_their_distances(void **state)
{
    (void)state;
    RigidWall wall = {.shape = WALL_PLANE, .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .length = {2, 3, 0}};
    expect_gap(&wall, 1, 1, -0.5, -0.5, UP);
    assert_false(rigid_wall_gap(&wall, (const double[3]){-0.1, 1, -0.5}).over);
    assert_false(rigid_wall_gap(&wall, (const double[3]){1, 3.1, -0.5}).over);
    wall.shape = WALL_SPHERE;
    wall.radius = 2;
    expect_gap(&wall, 0, 0.6, 0.8, -1, (const double[3]){0, 0.6, 0.8});
    expect_gap(&wall, 3, 0, 0, 1, (const double[3]){1, 0, 0});
    wall.shape = WALL_CYLINDER;
    wall.length[2] = 0;
    expect_gap(&wall, 0.6, 0.8, 40, -1, (const double[3]){0.6, 0.8, 0});
    wall.length[2] = 5;
    expect_gap(&wall, 0.6, 0.8, 4.9, -0.1, UP);
    expect_gap(&wall, 0, 1, 0.25, -0.25, (const double[3]){0, 0, -1});
    wall.shape = WALL_PRISM;
    expect_gap(&wall, 1, 1, -0.25, -0.25, UP);
    expect_gap(&wall, 0.1, 1, -2, -0.1, (const double[3]){-1, 0, 0});
    expect_gap(&wall, 1, 2.8, -2, -0.2, (const double[3]){0, 1, 0});
    expect_gap(&wall, 1, 1, -4.7, -0.3, (const double[3]){0, 0, -1});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes_have_their_distances)};
    return cmocka_run_group_tests_name("shapes of rigid walls", tests, NULL, NULL);
}
