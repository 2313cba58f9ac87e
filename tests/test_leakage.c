/* Tests of leakage through the fabric and of vents that are parts, on areas that the test gives. */
#include "tests/gas_case.h"

#include "airbag/leakage.h"

/* Air of reference B7 in 0.06 m3 at 130 kPa and 350 K with one leaking part. */
typedef struct LeakCase {
    GasCase c;
    GasLeak leak;
    GasHole hole;
    double area, blocked;
} LeakCase;

static void start_leak(LeakCase *l, int option)
{
    case_air(&l->c, 0.06, 350.0, 130000.0);
    l->leak = (GasLeak){.option = option,
                        .coefficient = 0.5,
                        .coefficient_curve = -1,
                        .factor = 1.0,
                        .factor_curve = -1,
                        .open_curve = -1,
                        .initial_area = 1.0};
    l->area = 1.0, l->blocked = 0.0;
    l->c.gas.leaks = &l->leak, l->c.gas.leak_count = 1;
}

static void run_leak(LeakCase *l, double end, double dt)
{
    double begin = l->c.time;
    int count = (int)ceil((end - begin) / dt - 1e-9);
    for (int i = 0; i < count; i++) {
        const char *why = NULL;
        double next = begin + (end - begin) * (i + 1) / count;
        GasStep step = {.time = l->c.time,
                        .dt = next - l->c.time,
                        .volume = 0.06,
                        .area = 0.8,
                        .areas = {&l->area, &l->blocked, NULL}};
        assert_int_equal(gas_advance(&l->c.gas, l->c.curves, 1.0, 1.0, 0.0, &step, &l->c.state, &why), 0);
        l->c.time = next;
    }
}

/* B7: Graefe, volume flow, orifice, porous medium, with and without blockage (there is none). */
static void test_laws(void **unused)
{
    (void)unused;
    static const double time[6] = {0.005, 0.01, 0.02, 0.03, 0.05, 0.08};
    static const double table[4][6] = {{127279.962, 124700.589, 119960.001, 115770.773, 109018.798, 102870.298},
                                       {126919.147, 124055.442, 118939.307, 114579.209, 107894.715, 102338.473},
                                       {129336.061, 128688.423, 127440.304, 126252.288, 124044.126, 121109.565},
                                       {129314.328, 128648.498, 127373.459, 126169.409, 123954.816, 121054.337}};
    static const double size[4] = {2e-3, 2e-3, 4e-6, 1.0}; /* FAC with FLC = 0.5 and 1 m2 */
    static const double mass[2][6] = {
        {0.0764700546, 0.0753598988, 0.073302269, 0.0714645415, 0.0684619888, 0.0656812446},
        {0.0763151504, 0.0750812071, 0.0728562248, 0.0709383765, 0.0679570245, 0.0654385199}};
    double worst = 0.0;
    for (int option = 1; option <= 8; option++) {
        int k = (option - 1) / 2;
        LeakCase l;
        start_leak(&l, option);
        l.leak.factor = size[k];
        if (k == 3) /* FAC(p) = k (p - pe), FLC area k = 1.6e-6 */
            l.leak.factor_curve = case_curve(&l.c, 2, (double[]){101325, 0, 201325, 1e5 * 3.2e-6});
        case_start(&l.c);
        for (int row = 0; row < 6; row++) {
            run_leak(&l, time[row], 1e-4);
            worst = fmax(worst, fabs(l.c.state.pressure / table[k][row] - 1.0));
            if (k < 2) worst = fmax(worst, fabs(l.c.state.mass / mass[k][row] - 1.0));
        }
        assert_true(l.c.state.mass_flow_out_vent == 0.0);
        assert_relative(l.c.state.mass_flow_out_porosity, l.c.state.mass_flow_out, 1e-9);
        case_check_ledger(&l.c, 1e-13);
    }
    print_message("B7: off by %.2g\n", worst);
    assert_true(worst < 1e-7); /* asked: 1e-4 */
}

static double area_of(const LeakCase *l, double time, double pressure)
{
    return gas_leak_area(&l->leak, l->c.curves, &(GasAreas){&l->area, &l->blocked, NULL}, time, pressure, 1e5);
}

/* The forms of the effective area. */
static void test_forms(void **unused)
{
    (void)unused;
    LeakCase l;
    start_leak(&l, 1);
    l.leak.initial_area = 0.8;
    l.leak.factor = 0.4;
    assert_relative(area_of(&l, 0, 2e5), 0.2, 1e-15); /* current area */
    l.leak.coefficient_curve = case_curve(&l.c, 2, (double[]){0, 0, 1, 1});
    l.leak.factor_curve = case_curve(&l.c, 2, (double[]){1e5, 0, 3e5, 2});
    assert_relative(area_of(&l, 0.25, 2e5), 0.25, 1e-14); /* FLC(t), FAC(p) */
    l.leak.form = LEAK_STRETCH;                           /* FLC(rs), FAC(rp) */
    l.leak.coefficient_curve = case_curve(&l.c, 2, (double[]){1, 0, 2, 1});
    l.leak.factor_curve = case_curve(&l.c, 2, (double[]){0, 0, 1, 1});
    assert_relative(area_of(&l, 0, 2e5), 0.8 * 0.25 * 0.5, 1e-14);
    l.leak.form = LEAK_POLYNOMIAL;
    l.leak.x[0] = 0.1, l.leak.x[1] = 0.2, l.leak.x[2] = 0.3, l.leak.x[3] = 0.4;
    assert_relative(area_of(&l, 0, 2e5), 0.8 * (0.1 + 0.2 * 1.25 + 0.3 * 0.5 + 0.4 * 1.25 * 0.5), 1e-14);
    l.leak.x[0] = -5.0;
    assert_true(area_of(&l, 0, 2e5) == 0.0);
    l.leak.form = LEAK_SEAL;
    assert_relative(area_of(&l, 0, 2e5), 0.2, 1e-14);
    l.area = 0.5;
    assert_true(area_of(&l, 0, 2e5) == 0.0);
}

/* Blockage counts for even options, less what ELA lets through, by a curve over time too. */
static void test_blockage(void **unused)
{
    (void)unused;
    for (int option = 1; option <= 8; option++) {
        LeakCase l;
        start_leak(&l, option);
        l.blocked = 0.25;
        assert_relative(area_of(&l, 0, 2e5), option % 2 ? 0.5 : 0.375, 1e-15);
        l.leak.open = 0.2;
        assert_relative(area_of(&l, 0, 2e5), option % 2 ? 0.5 : 0.4, 1e-14);
        l.leak.open_curve = case_curve(&l.c, 2, (double[]){0, 0, 1, 1});
        assert_relative(area_of(&l, 0.4, 2e5), option % 2 ? 0.5 : 0.425, 1e-14);
        l.leak.form = LEAK_STRETCH;
        assert_relative(area_of(&l, 0.4, 2e5), option % 2 ? 0.5 : 0.425, 1e-14);
    }
    LeakCase l;
    start_leak(&l, 1);
    l.blocked = 0.25;
    GasAreas areas = {&l.area, &l.blocked, NULL};
    l.hole = (GasHole){.initial_area = 0.4};
    assert_relative(gas_hole_area(&l.hole, &areas), 1.0, 1e-15);
    l.hole.blocked = true;
    assert_relative(gas_hole_area(&l.hole, &areas), 0.75, 1e-15);
    l.hole.increase = true;
    assert_relative(gas_hole_area(&l.hole, &areas), 0.35, 1e-15);
    l.area = 0.1;
    assert_true(gas_hole_area(&l.hole, &areas) == 0.0);
}

/* A vent that is a part is the vent of B2: C23 times its area. */
static void test_hole(void **unused)
{
    (void)unused;
    LeakCase l;
    case_air(&l.c, 0.06, 400.0, 300000.0);
    l.hole = (GasHole){0};
    l.area = 2e-3, l.blocked = 0.0;
    l.c.gas.vent_coefficient = 0.75;
    l.c.gas.holes = &l.hole, l.c.gas.hole_count = 1;
    case_start(&l.c);
    run_leak(&l, 0.05, 1e-4);
    assert_relative(l.c.state.pressure, 202163.314, 1e-7);
    assert_relative(l.c.state.mass_flow_out_vent, l.c.state.mass_flow_out, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_laws), cmocka_unit_test(test_forms),
                                       cmocka_unit_test(test_blockage), cmocka_unit_test(test_hole)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
