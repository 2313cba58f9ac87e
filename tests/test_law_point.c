/* The membrane laws at a point: stress as the gradient of the energy, random strain paths, the bound of the frequency,
 * unloading curves and dissipation. */
#include "tests/law_triangle.h"

static LawCase cases[LAW_CASES];

/* dW = S : dE, dC = 2 dE; by central differences. */
static void test_stress_is_the_gradient(void **unused)
{
    (void)unused;
    for (int k = 0; k < LAW_CASES; k++) {
        const LawCase *l = &cases[k];
        if (!law_stores_energy(l->kind, &l->law)) continue;
        double worst = 0;
        for (int n = 0; n < 2000; n++) {
            const double h = 1e-6;
            double c[3];
            metric(random_between(0.7, 1.5), random_between(0.7, 1.5), random_between(0, 7), c);
            LawPoint p = at(l, c, NULL);
            for (int i = 0; i < 3; i++) {
                double up[3] = {c[0], c[1], c[2]}, down[3] = {c[0], c[1], c[2]};
                up[i] += h;
                down[i] -= h;
                double slope = (at(l, up, NULL).energy - at(l, down, NULL).energy) / (2 * h);
                double stress = i == 2 ? 1.0 : 0.5; /* by C11, C22, C12 = C21 */
                double scale = l->law.whole.d11 * 0.1;
                worst = fmax(worst, fabs(slope - stress * p.stress[i]) / scale);
            }
        }
        if (!(worst < 1e-6)) fail_msg("%s: stress off the energy's gradient by %g", l->name, worst);
    }
}

/* A crumpled corner of a quad that may fold takes the metric's determinant through 0 (F1a): the stress stays bounded
 * and has no jump. */
static void test_collapsing_point(void **unused)
{
    (void)unused;
    int seen = 0;
    for (int k = 0; k < LAW_CASES; k++) {
        const LawCase *l = &cases[k];
        if (l->kind != LAW_BIOT) continue;
        double last[3] = {0}, step = 0, largest = 0;
        enum { POINTS = 4000 };
        for (int i = 0; i <= POINTS; i++) {
            double c[3] = {0.9, 0.1, 0.27 + 0.06 * i / POINTS}; /* det C = 0 at 0.3 */
            LawPoint p = at(l, c, NULL);
            for (int j = 0; j < 3; j++) {
                largest = fmax(largest, fabs(p.stress[j]));
                if (i > 0) step = fmax(step, fabs(p.stress[j] - last[j]));
                last[j] = p.stress[j];
            }
        }
        seen++;
        if (!(largest < 50 * l->law.whole.d11))
            fail_msg("%s: stress of %g moduli", l->name, largest / l->law.whole.d11);
        if (!(step < 0.02 * l->law.whole.d11)) fail_msg("%s: a jump of %g moduli", l->name, step / l->law.whole.d11);
    }
    assert_true(seen > 0);
}

/* ---- bound of the frequency ---- */

enum { PATHS = 1000, LEGS = 5, STEPS = 120 };

typedef struct PathResult {
    double ratio;         /* largest true over bounded squared frequency */
    double work, largest; /* of the stress, and its largest value on the way */
    double least;         /* smallest work, and stored energy */
    bool sound;
} PathResult;

/* From rest through random way points back to rest. */
static void follow_path(const LawCase *l, bool check_rate, PathResult *r)
{
    Triangle t;
    make_triangle(l, &t);
    double history[MEMORY_POINT_SIZE] = {0}, c0[3] = {1, 1, 0}, s0[3] = {0};
    Waypoint from = {0, 0, random_between(0, 6)};
    *r = (PathResult){.largest = 1e-5 * l->law.whole.d11, .sound = true};
    for (int leg = 0; leg < LEGS; leg++) {
        Waypoint to = {random_between(-0.3, 0.35), random_between(-0.3, 0.35), from.angle + random_between(-1, 1)};
        if (leg == LEGS - 1) to = (Waypoint){0, 0, from.angle};
        for (int i = 1; i <= STEPS; i++) {
            double share = (double)i / STEPS, f[3][2], c[3], y[9];
            Waypoint p = {from.log1 + share * (to.log1 - from.log1), from.log2 + share * (to.log2 - from.log2),
                          from.angle + share * (to.angle - from.angle)};
            corners_at(&t, p, y);
            deform(&t, y, f, c);
            LawPoint point;
            law_point(l->kind, &l->law, c, history, 1, t.rate, t.stress_rate, &point);
            for (int k = 0; k < 3; k++) r->work += (k == 2 ? 0.5 : 0.25) * (point.stress[k] + s0[k]) * (c[k] - c0[k]);
            memcpy(s0, point.stress, sizeof s0);
            memcpy(c0, c, sizeof c0);
            r->sound = r->sound && isfinite(r->work) && isfinite(point.energy) && isfinite(point.rate);
            r->largest = fmax(r->largest, r->work);
            r->least = fmin(r->least, fmin(r->work, point.energy));
            if (check_rate && i % 30 == 15) r->ratio = fmax(r->ratio, true_rate(l, &t, y, history) / point.rate);
        }
        from = to;
    }
}

static void test_random_paths(void **unused)
{
    (void)unused;
    bool passed = false;
    for (int k = 0; k < LAW_CASES; k++) { /* MAT_ELASTIC has no energy, see (F14); what it gives back has a bound */
        const LawCase *l = &cases[k];
        double ratio = 0, least = 0, returned = INFINITY;
        bool stores = law_stores_energy(l->kind, &l->law);
        for (int n = 0; n < PATHS; n++) {
            PathResult r;
            follow_path(l, true, &r);
            if (!r.sound) fail_msg("%s: path %d is not finite", l->name, n);
            ratio = fmax(ratio, r.ratio);
            least = fmin(least, r.least / r.largest);
            returned = fmin(returned, r.work / r.largest);
            if (stores && !(fabs(r.work) < 0.005 * r.largest))
                fail_msg("%s: a cycle leaves %g of %g", l->name, r.work, r.largest);
        }
        print_message("%-28s squared frequency %.4f of its bound; least work %.2g, after a cycle %.2g\n", l->name,
                      ratio, least, returned);
        passed = passed || !(ratio <= 1 + 1e-5);
        if (l->kind == LAW_LOGARITHMIC && !(least > -0.3)) fail_msg("%s: energy falls to %g", l->name, least);
        if (l->kind == LAW_CURVE || stores) {
            if (!(least > -0.005)) fail_msg("%s: energy falls to %g", l->name, least);
            if (!(returned > -0.005)) fail_msg("%s: a cycle gives back %g more than it took", l->name, returned);
        }
    }
    assert_false(passed);
}

/* ---- curves ---- */

static double line_at(int n, const double *x, const double *y, double at_x)
{
    int i = 1;
    while (i < n - 1 && at_x > x[i]) i++;
    return y[i - 1] + (y[i] - y[i - 1]) * (at_x - x[i - 1]) / (x[i] - x[i - 1]);
}

/* Stress along the warp at a Green strain, weft and shear at rest. */
static double warp_stress(const LawCase *l, double strain, double *history)
{
    const double c[3] = {1 + 2 * strain, 1, 0};
    return at(l, c, history).stress[0];
}

static void close_to(const char *what, double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%s: %.15g, expected %.15g", what, value, expected);
}

/* Unloading from where the curves meet runs down the very curve of the deck; reloading comes back to the point. */
static void test_unloading_curve(void **unused)
{
    (void)unused;
    static LawCase l;
    law_case_curves(&l, "unloading", (CurveChoice){.unloading = true});
    double history[MEMORY_POINT_SIZE] = {0}, size = 4.5e7;
    for (int i = 0; i <= 200; i++) {
        double e = 0.001 * i;
        close_to("loading", warp_stress(&l, e, history), line_at(5, warp_x, warp_y, e), 1e-12 * size);
    }
    for (int i = 200; i >= -50; i--) {
        double e = 0.001 * i;
        close_to("unloading", warp_stress(&l, e, history), i > 0 ? line_at(4, back_x, back_y, e) : 5e7 * e,
                 1e-9 * size);
    }
    for (int i = 0; i <= 200; i++) {
        double e = 0.001 * i;
        close_to("reloading", warp_stress(&l, e, history), line_at(4, back_x, back_y, e), 1e-9 * size);
    }
    close_to("beyond", warp_stress(&l, 0.22, history), 4.5e7 + 0.02 * 1.9e7 / 0.08, 1e-9 * size);
}

static double warp_area(double e)
{
    double area = 0;
    for (int i = 0; i < 40000; i++) area += line_at(5, warp_x, warp_y, e * (i + 0.5) / 40000) * e / 40000;
    return area;
}

/* Unloading from below the meeting point: the share of the loading stress is that of the given pair of curves at the
 * same share of energy. */
static void test_partial_unloading(void **unused)
{
    (void)unused;
    static LawCase l;
    law_case_curves(&l, "unloading", (CurveChoice){.unloading = true});
    double history[MEMORY_POINT_SIZE] = {0}, whole = warp_area(0.2), part = warp_area(0.1);
    warp_stress(&l, 0.1, history);
    double before = warp_stress(&l, 0.1, history);
    for (double e = 0.09; e > 0.01; e -= 0.02) {
        double aim = warp_area(e) / part * whole, low = 0, high = 0.2;
        for (int i = 0; i < 60; i++) {
            double middle = 0.5 * (low + high);
            if (warp_area(middle) < aim)
                low = middle;
            else
                high = middle;
        }
        double share = line_at(4, back_x, back_y, low) / line_at(5, warp_x, warp_y, low);
        close_to("partial unloading", warp_stress(&l, e, history), share * line_at(5, warp_x, warp_y, e), 1e-6 * 4.5e7);
    }
    close_to("loop closes", warp_stress(&l, 0.1, history), before, 1e-12 * 4.5e7);
}

/* RL = 1: reloading on the straight line to the point where unloading began, and back on it. */
static void test_reloading_line(void **unused)
{
    (void)unused;
    static LawCase l;
    law_case_curves(&l, "reloading", (CurveChoice){.unloading = true, .reload = 1});
    double history[MEMORY_POINT_SIZE] = {0};
    warp_stress(&l, 0.2, history);
    double low = warp_stress(&l, 0.08, history);
    close_to("unloading", low, line_at(4, back_x, back_y, 0.08), 1e-9 * 4.5e7);
    for (int pass = 0; pass < 2; pass++) {
        double middle = warp_stress(&l, 0.14, history);
        close_to("line", middle, low + (4.5e7 - low) * 0.5, 1e-9 * 4.5e7);
        close_to("back on the line", warp_stress(&l, 0.08, history), low, 1e-9 * 4.5e7);
    }
    close_to("lower", warp_stress(&l, 0.05, history), line_at(4, back_x, back_y, 0.05), 1e-9 * 4.5e7);
    close_to("top", warp_stress(&l, 0.2, history), 4.5e7, 1e-9 * 4.5e7);
}

/* H is the share of the energy that a cycle of load and full unload dissipates. */
static void test_hysteresis_share(void **unused)
{
    (void)unused;
    static LawCase l;
    const double shares[] = {0.1, 0.5, 0.9};
    for (int s = 0; s < 3; s++) {
        law_case_curves(&l, "H", (CurveChoice){.hysteresis = shares[s]});
        double history[MEMORY_POINT_SIZE] = {0}, up = 0, down = 0;
        enum { MANY = 20000 };
        for (int i = 0; i < MANY; i++) up += warp_stress(&l, 0.2 * (i + 0.5) / MANY, history) * 0.2 / MANY;
        warp_stress(&l, 0.2, history);
        for (int i = MANY - 1; i >= 0; i--) down += warp_stress(&l, 0.2 * (i + 0.5) / MANY, history) * 0.2 / MANY;
        close_to("H", 1 - down / up, shares[s], 1e-6);
    }
}

static int make_cases(void **unused)
{
    (void)unused;
    law_cases_make(cases);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stress_is_the_gradient), cmocka_unit_test(test_collapsing_point),
        cmocka_unit_test(test_random_paths),           cmocka_unit_test(test_unloading_curve),
        cmocka_unit_test(test_partial_unloading),      cmocka_unit_test(test_reloading_line),
        cmocka_unit_test(test_hysteresis_share),
    };
    return cmocka_run_group_tests(tests, make_cases, NULL);
}
