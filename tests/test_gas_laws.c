/* Tests of the models whose pressure follows a law of volume and time, against closed forms. */
#include "tests/gas_case.h"

/* A bag of volume 1 with surface 1 of a kind. */
static void case_law(GasCase *c, GasKind kind)
{
    memset(c, 0, sizeof *c);
    gas_model_reset(&c->gas);
    c->gas.kind = kind;
    c->vsca = c->psca = 1.0;
    c->volume = 1.0;
    c->surface = 1.0;
}

/* B11: BETA CN/(V/V0) at the table's volumes; the work is the logarithm; PSCA and VSCA scale the walls' side. */
static void test_pressure_volume(void **unused)
{
    (void)unused;
    static const double table[][2] = {{0.5, 300e3}, {0.8, 187.5e3}, {1.0, 150e3}, {1.25, 120e3}, {2.0, 75e3}};
    GasCase c;
    case_law(&c, GAS_PRESSURE_VOLUME);
    c.gas.pressure_volume.coefficient = 75e3;
    c.gas.pressure_volume.factor = 2.0;
    c.volume = 0.07;
    c.psca = 3.0;
    c.vsca = 0.5;
    case_start(&c);
    for (int i = 0; i < 5; i++) {
        case_step(&c, 1e-3, 0.07 * table[i][0]);
        assert_relative(c.state.pressure, table[i][1], 1e-14);
        assert_relative(c.state.applied, 3.0 * table[i][1], 1e-14);
        assert_relative(c.state.stiffness, 1.5 * table[i][1] / (0.5 * 0.07 * table[i][0]), 1e-13);
        assert_relative(c.state.work, 150e3 * 0.035 * log(table[i][0]), i == 2 ? INFINITY : 1e-12);
    }
}

/* CN by a curve over time, and LCID over the relative volume in place of both. */
static void test_pressure_volume_curves(void **unused)
{
    (void)unused;
    GasCase c;
    case_law(&c, GAS_PRESSURE_VOLUME);
    c.gas.pressure_volume.coefficient_curve = case_curve(&c, 3, (double[]){0, 1e3, 1, 3e3, 2, 0});
    c.gas.pressure_volume.factor = 1.0;
    case_start(&c);
    case_run(&c, 0.5, 0.1);
    assert_relative(c.state.pressure, 2e3, 1e-12);
    case_run(&c, 1.5, 0.1);
    assert_relative(c.state.pressure, 1.5e3, 1e-12);
    assert_relative(gas_time_scale(&c.gas, c.curves, &c.state, 1.5), 0.5, 1e-6);
    c.gas.pressure_volume.relative_curve = case_curve(&c, 3, (double[]){0.5, 100, 1, 60, 1.5, 0});
    case_start(&c);
    assert_relative(c.state.pressure, 60, 1e-15);
    case_step(&c, 1, 0.7);
    assert_relative(c.state.pressure, 84, 1e-14);
    assert_relative(c.state.stiffness, 80, 1e-14);
    assert_relative(c.state.work, -0.3 * 72, 1e-13);
}

/* B1 with the same figures: p V^gamma, the work is the energy lost; PSF and PE act on the walls. */
static void test_adiabatic(void **unused)
{
    (void)unused;
    static const double table[][3] = {
        {0.05, 130788.74, -1149.84254}, {0.03, 267398.278, -4856.12086}, {0.015, 705668.287, -11263.8107}};
    GasCase c;
    case_law(&c, GAS_ADIABATIC);
    c.gas.adiabatic.gamma = 1.4;
    c.gas.adiabatic.factor = 0.5;
    c.gas.ambient_pressure = 100000.0;
    c.gas.overpressure = 1325.0;
    c.gas.density = 1.2;
    c.volume = 0.06;
    case_start(&c);
    for (int i = 0; i < 3; i++) {
        double from = i ? table[i - 1][0] : 0.06;
        for (int k = 1; k <= 7; k++) case_step(&c, 1e-4, from + (table[i][0] - from) * k / 7);
        assert_relative(c.state.pressure, table[i][1], 3e-9);
        assert_relative(c.state.work, table[i][2], 1e-8);
        assert_relative(c.state.applied, 0.5 * (c.state.pressure - 100000.0), 1e-14);
        assert_relative(c.state.density, 1.2 * 0.06 / table[i][0], 1e-13);
        assert_relative(c.state.stiffness, 0.5 * 1.4 * c.state.pressure / table[i][0], 1e-13);
        case_check_ledger(&c, 1e-14);
    }
}

/* While the flag is zero the walls feel PSF P0 whatever the volume; then the gas is closed. */
static void test_preload(void **unused)
{
    (void)unused;
    GasCase c;
    case_law(&c, GAS_ADIABATIC);
    c.gas.adiabatic.gamma = 1.3;
    c.gas.adiabatic.factor = 2.0;
    c.gas.ambient_pressure = 100000.0;
    c.gas.overpressure = 20000.0;
    c.gas.density = 1.2;
    c.gas.adiabatic.preload_curve = case_curve(&c, 3, (double[]){0, 0, 0.1, 0, 0.11, 1});
    case_start(&c);
    for (int i = 0; i < 10; i++) {
        assert_relative(c.state.applied, 40000.0, 1e-14);
        assert_true(c.state.stiffness == 0.0 && c.state.opened == 0.0);
        case_step(&c, 0.01, 1.0 + 0.05 * i);
    }
    case_step(&c, 0.01, 2.0);
    assert_true(c.state.opened == 1.0);
    assert_relative(c.state.applied, 40000.0, 1e-12);
    assert_relative(c.state.mass, 2.4, 1e-14);
    case_step(&c, 0.01, 1.0);
    assert_relative(c.state.pressure, 120000.0 * pow(2.0, 1.3), 1e-12);
    case_check_ledger(&c, 1e-14);
}

/* LCID from STIME on, exact at and between points; with LCID = 0 an isothermal gas. */
static void test_load_curve(void **unused)
{
    (void)unused;
    GasCase c;
    case_law(&c, GAS_LOAD_CURVE);
    c.gas.load_curve.start_time = 0.5;
    c.gas.load_curve.pressure_curve = case_curve(&c, 3, (double[]){0, 100, 1, 300, 2, 100});
    case_start(&c);
    assert_relative(gas_time_scale(&c.gas, c.curves, &c.state, 0.0), 0.5, 1e-9);
    assert_relative(gas_time_scale(&c.gas, c.curves, &c.state, 0.75), 0.75, 1e-9);
    for (int i = 1; i <= 10; i++) {
        double t = 0.25 * i, since = t - 0.5;
        case_step(&c, 0.25, 1.0 + 0.1 * i);
        c.time = t;
        double expected = since < 0 ? 0 : since < 1 ? 100 + 200 * since : 300 - 200 * (since - 1);
        assert_true(fabs(c.state.applied - expected) < 1e-9);
    }
    case_law(&c, GAS_LOAD_CURVE);
    c.gas.load_curve = (LoadCurveLaw){.start_time = 0.1, .pressure_curve = -1, .temperature = 20.0, .zero = -273.0};
    c.gas.ambient_pressure = 1e5, c.gas.overpressure = 2e4, c.gas.density = 1.3;
    case_start(&c);
    assert_true(c.state.applied == 0.0); /* before STIME */
    assert_relative(c.state.pressure, 1.2e5, 1e-14);
    case_step(&c, 0.2, 0.5);
    assert_relative(c.state.applied, 1.4e5, 1e-13);
    assert_relative(c.state.temperature, 293.0, 1e-15);
    assert_relative(c.state.mass, 1.3, 1e-15);
    assert_relative(c.state.stiffness, 2.4e5 / 0.5, 1e-13);
    assert_relative(c.state.work, 1.2e5 * log(0.5), 1e-13);
}

static void case_fluid(GasCase *c)
{
    case_law(c, GAS_LINEAR_FLUID);
    c->gas.fluid.bulk = 2e6;
    c->gas.density = 1000.0;
}

/* B10: K ln(V0/V). */
static void test_linear_fluid(void **unused)
{
    (void)unused;
    static const double table[][2] = {
        {1.05, -97580.33}, {0.99, 20100.67}, {0.95, 102586.6}, {0.9, 210721}, {0.8, 446287.1}};
    GasCase c;
    case_fluid(&c);
    case_start(&c);
    assert_true(c.state.pressure == 0.0);
    assert_relative(c.state.mass, 1000.0, 1e-15);
    for (int i = 0; i < 5; i++) {
        case_step(&c, 1e-3, table[i][0]);
        assert_relative(c.state.pressure, 2e6 * log(1 / table[i][0]), 1e-13);
        assert_relative(c.state.pressure, table[i][1], 1e-6); /* the table's digits */
        assert_relative(c.state.stiffness, 2e6 / table[i][0], 1e-13);
    }
}

/* Flows in and out by time are exact at any step; what LCFIT adds, LCBULK and the limits. */
static void test_fluid_by_time(void **unused)
{
    (void)unused;
    for (int k = 0; k < 2; k++) {
        GasCase c;
        case_fluid(&c);
        c.gas.fluid.inflow_curve = case_curve(&c, 3, (double[]){0, 0, 1, 100, 2, 0});
        c.gas.fluid.outflow_curve = case_curve(&c, 2, (double[]){0, 20, 2, 0});
        c.gas.fluid.added_pressure_curve = case_curve(&c, 2, (double[]){0, 0, 2, 6000});
        c.gas.fluid.bulk_curve = case_curve(&c, 2, (double[]){0, 2e6, 2, 4e6});
        case_start(&c);
        case_run(&c, 1.0, k ? 1.0 : 0.013);
        assert_relative(c.state.mass, 1000.0 + 50.0 - 15.0, 1e-13);
        assert_relative(c.state.mass_in, 50.0, 1e-12);
        assert_relative(c.state.mass_out, 15.0, 1e-12);
        double p = 3e6 * log(1.035) + 3000;
        assert_relative(c.state.applied, p, 1e-11);
        c.gas.fluid.limit = 0.5 * p;
        case_step(&c, 1e-9, 1.0);
        assert_relative(c.state.applied, 0.5 * p, 1e-12);
        assert_true(c.state.stiffness == 0.0);
    }
    GasCase c;
    case_fluid(&c);
    c.gas.fluid.limit = 1.0; /* the curve is in its place */
    c.gas.fluid.limit_curve = case_curve(&c, 2, (double[]){0, 0, 1, 1e5});
    case_start(&c);
    case_step(&c, 0.5, 0.9);
    assert_relative(c.state.applied, 5e4, 1e-13);
    c.gas.fluid.pressure_curve = case_curve(&c, 2, (double[]){0, 0, 10, 1e5});
    case_step(&c, 0.5, 0.8);
    assert_relative(c.state.applied, 1e4, 1e-13);
    assert_relative(c.state.mass, 800.0, 1e-13); /* density times volume */
    assert_relative(c.state.mass_out, 200.0, 1e-13);
}

/* Outflow by pressure: dm/dt = -c p, p = K ln(m/m0): the logarithm decays exponentially up to second order of the step;
 * any step is stable and ends without pressure, and a curve with a jump at zero does not ring. */
static void test_fluid_by_pressure(void **unused)
{
    (void)unused;
    double error[2];
    for (int k = 0; k < 4; k++) {
        GasCase c;
        case_fluid(&c);
        c.gas.fluid.outflow_pressure_curve = case_curve(&c, 2, (double[]){0, 0, 1e6, 1000});
        case_start(&c);
        case_step(&c, 1e-12, 0.99);
        static const double steps[4] = {1e-2, 5e-3, 1.0, 100.0};
        if (k < 2) {
            c.volume = 0.99;
            case_run(&c, 0.5, steps[k]);
            double y = log(1 / 0.99), t = 0, dt = 1e-5; /* dy/dt = -c K y exp(-y)/m0 */
            for (int i = 0; i < 50000; i++, t += dt) {
                double mid = y - 0.5 * dt * 1e-3 * 2e6 * y * exp(-y) / 990.0;
                y -= dt * 1e-3 * 2e6 * mid * exp(-mid) / 990.0;
            }
            error[k] = fabs(c.state.pressure / (2e6 * y) - 1.0);
        } else {
            for (int i = 0; i < 40; i++) {
                double last = c.state.pressure;
                case_step(&c, steps[k], 0.99);
                assert_true(c.state.pressure <= last + 1e-9 && c.state.pressure > -1e-6);
            }
            assert_true(c.state.pressure < 1.0);
        }
        assert_relative(c.state.initial_mass - c.state.mass_out, c.state.mass, 1e-13);
    }
    print_message("outflow by pressure: errors %.2g, %.2g\n", error[0], error[1]);
    assert_true(error[0] < 1e-3 && error[1] < 0.3 * error[0]);
    GasCase c;
    case_fluid(&c);
    c.gas.fluid.outflow_pressure_curve = case_curve(&c, 3, (double[]){-1, 0, 0, 0, 1e-3, 500});
    case_start(&c);
    case_step(&c, 1e-12, 0.9);
    for (int i = 0; i < 100; i++) case_step(&c, 0.01, 0.9);
    assert_true(fabs(c.state.pressure) < 1.0);
}

/* What cannot be is refused with the name of the field. */
static void test_impossible(void **unused)
{
    (void)unused;
    static const char *const named[] = {"GAMMA", "PE", "R0", "P0", "RO", "BULK", "R0", "T must"};
    for (int k = 0; k < 8; k++) {
        GasCase c;
        case_law(&c, k < 4 ? GAS_ADIABATIC : k < 6 ? GAS_LINEAR_FLUID : GAS_LOAD_CURVE);
        c.gas.adiabatic.gamma = k == 0 ? 1.0 : 1.4;
        c.gas.ambient_pressure = k == 1 ? -1.0 : 1e5;
        c.gas.overpressure = k == 3 ? -2e5 : 0.0;
        c.gas.density = k == 2 || k == 4 || k == 6 ? 0.0 : 1.0;
        c.gas.fluid.bulk = k == 5 ? 0.0 : 1e6;
        c.gas.load_curve.temperature = k == 7 ? 0.0 : 300.0;
        const char *why = NULL;
        assert_int_equal(gas_initialize(&c.gas, c.curves, 1.0, 1.0, 0.0, 1.0, 1.0, &c.state, &why), -1);
        if (!strstr(why, named[k])) print_message("%s: %s\n", named[k], why);
        assert_non_null(strstr(why, named[k]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pressure_volume), cmocka_unit_test(test_pressure_volume_curves),
        cmocka_unit_test(test_adiabatic),       cmocka_unit_test(test_preload),
        cmocka_unit_test(test_load_curve),      cmocka_unit_test(test_linear_fluid),
        cmocka_unit_test(test_fluid_by_time),   cmocka_unit_test(test_fluid_by_pressure),
        cmocka_unit_test(test_impossible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
