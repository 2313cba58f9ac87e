/* The tree of boxes answers as a test of every facet does, also after its facets have moved. */
#include "airbag/ray_tree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>
#include <math.h>

#include "solver/memory.h"

enum { FACETS = 1000, NODES = 2000 };
static double x[3 * NODES];
static int32_t node[4 * FACETS];

static uint64_t seed = UINT64_C(0x2545f4914f6cdd1d);
static double random_unit(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) * 0x1p-53;
}

/* Facets of a size of 0.1 in the unit cube, quads and triangles. */
static void scatter(void)
{
    for (int f = 0; f < FACETS; f++) {
        int first = 4 * (int)(random_unit() * (NODES / 4));
        for (int c = 0; c < 4; c++) node[4 * f + c] = first + c;
        if (f % 3 == 0) node[4 * f + 3] = node[4 * f + 2];
    }
    for (int n = 0; n < NODES; n += 4)
        for (int k = 0; k < 3; k++) {
            double middle = random_unit();
            for (int c = 0; c < 4; c++) x[3 * (n + c) + k] = middle + 0.1 * random_unit();
        }
}

/* Without the tree: a second formula, by signed volumes. */
static double volume(const double *a, const double *b, const double *c, const double *d)
{
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/* side: 0 or the sign of the normal a b c that must look at p. */
static bool crosses(const double *p, const double *q, int side, const double *a, const double *b, const double *c)
{
    if (side * volume(p, a, b, c) > 0) return false;
    double ends = volume(p, a, b, c) * volume(q, a, b, c);
    double s = volume(p, q, a, b), t = volume(p, q, b, c), u = volume(p, q, c, a);
    return ends < 0 && ((s > 0 && t > 0 && u > 0) || (s < 0 && t < 0 && u < 0));
}

static bool blocked_by_any(const double *p, const double *q, int skip, const int8_t *side)
{
    for (int f = 0; f < FACETS; f++) {
        const double *corner[4];
        for (int c = 0; c < 4; c++) corner[c] = x + 3 * node[4 * f + c];
        if (f == skip) continue;
        int look = side ? side[f] : 0;
        if (crosses(p, q, look, corner[0], corner[1], corner[2])) return true;
        if (node[4 * f + 3] != node[4 * f + 2] && crosses(p, q, look, corner[0], corner[2], corner[3])) return true;
    }
    return false;
}

static void compare(RayTree *tree)
{
    int blocked = 0;
    for (int i = 0; i < 4000; i++) {
        double p[3], q[3];
        for (int k = 0; k < 3; k++) p[k] = random_unit(), q[k] = p[k] + 1.6 * (random_unit() - 0.5);
        if (i % 10 == 0) q[1] = p[1]; /* rays along planes of the boxes */
        if (i % 20 == 0) q[2] = p[2];
        int skip = i % 2 ? -1 : i % FACETS;
        bool expected = blocked_by_any(p, q, skip, NULL);
        blocked += expected;
        if (ray_tree_blocked(tree, x, p, q, skip, 0.0) != expected) fail_msg("ray %d: not %d", i, expected);
    }
    assert_in_range(blocked, 400, 3600); /* the comparison means something */
}

static void test_against_all_facets(void **state)
{
    (void)state;
    RayTree tree;
    scatter();
    assert_int_equal(ray_tree_create(&tree, FACETS, node), 0);
    ray_tree_build(&tree, x);
    assert_true(tree.box_count < 2 * FACETS);
    compare(&tree);
    for (int i = 0; i < 3 * NODES; i++) x[i] += 0.02 * random_unit(); /* a little: the layout stays */
    double built = tree.built_size;
    ray_tree_refit(&tree, x);
    assert_true(tree.built_size == built);
    compare(&tree);
    scatter(); /* altogether: built anew */
    ray_tree_refit(&tree, x);
    assert_true(tree.built_size != built);
    compare(&tree);
    ray_tree_free(&tree);
    assert_int_equal(memory_in_use(), 0);
}

/* Only facets that turn their outer side to the line's start; lines start on a focal line. */
static void test_sides(void **state)
{
    (void)state;
    static int8_t side[FACETS];
    RayTree tree;
    scatter();
    for (int f = 0; f < FACETS; f++) side[f] = random_unit() < 0.5 ? -1 : 1;
    assert_int_equal(ray_tree_create(&tree, FACETS, node), 0);
    for (int look = 0; look < 4; look++) {
        int blocked = 0, more = 0;
        double from[3], to[3];
        for (int k = 0; k < 3; k++) from[k] = random_unit(), to[k] = look % 2 ? random_unit() : from[k];
        ray_tree_sides(&tree, side, from, to);
        ray_tree_refit(&tree, x);
        for (int i = 0; i < 1000; i++) {
            double p[3], q[3], share = random_unit();
            for (int k = 0; k < 3; k++) p[k] = from[k] + share * (to[k] - from[k]), q[k] = random_unit();
            bool expected = blocked_by_any(p, q, i, side);
            blocked += expected;
            more += blocked_by_any(p, q, i, NULL) != expected;
            if (ray_tree_blocked(&tree, x, p, q, i, 0.0) != expected) fail_msg("line %d: not %d", i, expected);
        }
        assert_in_range(blocked, 100, 990);
        assert_in_range(more, 1, 500);
        for (int i = 0; i < 3 * NODES; i++) x[i] += 0.05 * random_unit();
    }
    ray_tree_free(&tree);
}

static void test_margin_and_edges(void **state)
{
    (void)state;
    static const double sheet[] = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    static const int32_t quad[] = {0, 1, 2, 3};
    RayTree tree;
    assert_int_equal(ray_tree_create(&tree, 1, quad), 0);
    ray_tree_refit(&tree, sheet); /* the first one builds */
    const double below[3] = {0.5, 0.4, 0}, above[3] = {0.5, 0.4, 2}, near[3] = {0.5, 0.4, 1.005},
                 out[3] = {0.5, 2.4, 2};
    assert_true(ray_tree_blocked(&tree, sheet, below, above, -1, 0.01));
    assert_true(ray_tree_blocked(&tree, sheet, above, below, -1, 0.01));
    assert_false(ray_tree_blocked(&tree, sheet, below, above, 0, 0.01));
    assert_false(ray_tree_blocked(&tree, sheet, below, near, -1, 0.01)); /* a layer behind another */
    assert_true(ray_tree_blocked(&tree, sheet, below, near, -1, 0.001));
    assert_false(ray_tree_blocked(&tree, sheet, below, out, -1, 0.0));
    assert_false(ray_tree_blocked(&tree, sheet, below, below, -1, 0.0));
    ray_tree_free(&tree);
    assert_int_equal(ray_tree_create(&tree, 0, quad), 0);
    ray_tree_refit(&tree, sheet);
    assert_false(ray_tree_blocked(&tree, sheet, below, above, -1, 0.0));
    ray_tree_free(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_all_facets),
        cmocka_unit_test(test_sides),
        cmocka_unit_test(test_margin_and_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
