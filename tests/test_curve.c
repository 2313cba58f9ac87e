/* Tests of solver/curve.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "solver/curve.h"

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) print_message("%.17g, expected %.17g\n", value, expected);
    assert_true(fabs(value - expected) <= tolerance);
}

static double x_points[] = {1.0, 2.0, 4.0, 4.5};
static double y_points[] = {10.0, 30.0, -10.0, 0.0};
static double area_points[4];
static Curve curve = {.id = 7, .count = 4, .x = x_points, .y = y_points, .area = area_points};

static double single_x[] = {3.0}, single_y[] = {5.0}, single_area[1];
static Curve single = {.id = 8, .count = 1, .x = single_x, .y = single_y, .area = single_area};

static int fill_areas(void **state)
{
    (void)state;
    curve_fill_area(&curve);
    curve_fill_area(&single);
    return 0;
}

static void test_value(void **state)
{
    (void)state;
    for (int i = 0; i < curve.count; i++) assert_true(curve_value(&curve, x_points[i]) == y_points[i]);
    assert_near(curve_value(&curve, 1.25), 15.0, 1e-14);
    assert_near(curve_value(&curve, 3.0), 10.0, 1e-14);
    assert_near(curve_value(&curve, 4.25), -5.0, 1e-14);
    assert_true(curve_value(&curve, -100.0) == 10.0); /* the end values hold */
    assert_true(curve_value(&curve, 100.0) == 0.0);
    assert_true(curve_value(&single, -1.0) == 5.0 && curve_value(&single, 9.0) == 5.0);
}

static void test_slope(void **state)
{
    (void)state;
    assert_near(curve_slope(&curve, 1.0), 20.0, 1e-13); /* right of the point */
    assert_near(curve_slope(&curve, 1.9), 20.0, 1e-13);
    assert_near(curve_slope(&curve, 2.0), -20.0, 1e-13);
    assert_near(curve_slope(&curve, 4.4), 20.0, 1e-13);
    assert_true(curve_slope(&curve, 0.5) == 0.0);
    assert_true(curve_slope(&curve, 4.5) == 0.0 && curve_slope(&curve, 5.0) == 0.0);
    assert_true(curve_slope(&single, 3.0) == 0.0);
}

static void test_integral(void **state)
{
    (void)state;
    assert_near(curve_integral(&curve, 1.0, 2.0), 20.0, 1e-13);
    assert_near(curve_integral(&curve, 1.0, 4.5), 20.0 + 20.0 - 2.5, 1e-13);
    assert_near(curve_integral(&curve, 0.0, 1.5), 10.0 + 7.5, 1e-13);
    assert_near(curve_integral(&curve, -2.0, -1.0), 10.0, 1e-13);
    assert_near(curve_integral(&curve, 4.25, 10.0), -0.625, 1e-13);
    assert_near(curve_integral(&curve, 3.0, 3.5), 2.5, 1e-13);
    assert_near(curve_integral(&curve, 10.0, 0.0), -47.5, 1e-13);
    assert_true(curve_integral(&curve, 3.0, 3.0) == 0.0);
    assert_near(curve_integral(&single, 1.0, 5.0), 20.0, 1e-13);
}

/* The sum over any steps is the whole: short steps late on the curve lose nothing. */
static void test_integral_adds_up(void **state)
{
    (void)state;
    double sum = 0.0, t = 0.5;
    for (int i = 0; i < 100000; i++) {
        double next = 0.5 + 5.0 * (i + 1) / 100000.0;
        sum += curve_integral(&curve, t, next);
        t = next;
    }
    assert_near(sum, curve_integral(&curve, 0.5, 5.5), 1e-11);
    double step = curve_integral(&curve, 4.4, 4.4 + 1e-9);
    assert_near(step / ((4.4 + 1e-9) - 4.4), -2.0 + 1e-8, 1e-13);
}

static void test_next_corner(void **state)
{
    (void)state;
    assert_true(curve_next_corner(&curve, -5.0) == 1.0);
    assert_true(curve_next_corner(&curve, 1.0) == 2.0); /* strictly after */
    assert_true(curve_next_corner(&curve, 3.9) == 4.0);
    assert_true(curve_next_corner(&curve, 4.5) == INFINITY);
    assert_true(curve_next_corner(&single, 0.0) == 3.0 && curve_next_corner(&single, 3.0) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value),       cmocka_unit_test(test_slope),
        cmocka_unit_test(test_integral),    cmocka_unit_test(test_integral_adds_up),
        cmocka_unit_test(test_next_corner),
    };
    return cmocka_run_group_tests(tests, fill_areas, NULL);
}
