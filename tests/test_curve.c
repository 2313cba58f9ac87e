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

/* A natural cubic spline: meets its points, slopes are continuous, no bend at the ends, integral and slope are those of
 * its values; three points in closed form: through (0,0), (1,1), (2,0) it is 1.5 x - 0.5 x^3 on the left. */
static void test_spline(void **state)
{
    (void)state;
    double x[5] = {0, 1, 2, 3.5, 4}, y[5] = {0, 1, 0, 2, -1}, area[5], bend[5], work[5];
    Curve three = {.id = 1, .count = 3, .x = x, .y = y, .area = area, .bend = bend};
    curve_fill_spline(&three, work);
    for (double t = 0; t <= 1.0; t += 0.125) {
        assert_near(curve_value(&three, t), 1.5 * t - 0.5 * t * t * t, 1e-15);
        assert_near(curve_slope(&three, t), t < 1 ? 1.5 - 1.5 * t * t : 0.0, 1e-14);
        assert_near(curve_integral(&three, 0.0, t), 0.75 * t * t - 0.125 * t * t * t * t, 1e-15);
    }
    assert_near(curve_integral(&three, -1.0, 3.0), 1.25, 1e-14);
    Curve five = {.id = 1, .count = 5, .x = x, .y = y, .area = area, .bend = bend};
    curve_fill_spline(&five, work);
    assert_true(bend[0] == 0.0 && bend[4] == 0.0);
    double sum = 0.0;
    for (int i = 0; i < 5; i++) {
        assert_near(curve_value(&five, x[i]), y[i], 1e-15);
        if (i > 0 && i < 4) assert_near(curve_slope(&five, x[i] - 1e-9), curve_slope(&five, x[i]), 1e-7);
    }
    for (int i = 0; i < 400000; i++) {
        double t = (i + 0.5) * 1e-5;
        sum += curve_value(&five, t) * 1e-5;
        if (i % 1000 == 7)
            assert_near((curve_value(&five, t + 1e-5) - curve_value(&five, t - 1e-5)) / 2e-5, curve_slope(&five, t),
                        1e-6);
    }
    assert_near(sum, curve_integral(&five, 0.0, 4.0), 1e-8);
    assert_near(curve_integral(&five, 0.3, 3.7), curve_integral(&five, 0.3, 2.2) + curve_integral(&five, 2.2, 3.7),
                1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value),       cmocka_unit_test(test_slope),
        cmocka_unit_test(test_integral),    cmocka_unit_test(test_integral_adds_up),
        cmocka_unit_test(test_next_corner), cmocka_unit_test(test_spline),
    };
    return cmocka_run_group_tests(tests, fill_areas, NULL);
}
