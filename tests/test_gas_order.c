/* The gas converges with the second order in the step, whatever acts, and the inflow is exact across corners. */
#include "tests/gas_case.h"

static const double END = 0.02;

/* A vent that opens and closes in time, over a breathing volume. */
static void vent_case(GasCase *c)
{
    case_air(c, 0.06, 350.0, 160000.0);
    c->gas.vent_coefficient_time_curve = case_curve(c, 2, (double[]){0.0, 0.0, END, 1.0});
    c->gas.vent_area = 2e-3;
    c->gas.porosity_coefficient_time_curve = case_curve(c, 2, (double[]){0.0, 0.5, END, 0.0});
    c->gas.porosity_area = 1e-3;
}

/* Heat loss with temperature-dependent heat capacity and a coefficient that grows. */
static void heat_case(GasCase *c)
{
    case_air(c, 0.06, 900.0, 160000.0);
    c->gas.temperature_dependent = true;
    c->gas.a = 22.26, c->gas.b = 0.04, c->gas.molar_mass = 0.044, c->gas.gas_constant = 8.314462618;
    c->gas.ambient_temperature = 300.0;
    c->gas.heat_transfer_curve = case_curve(c, 2, (double[]){0.0, 0.0, END, 4000.0});
}

/* Inflow of changing temperature into the vented bag. */
static void through_case(GasCase *c)
{
    vent_case(c);
    c->gas.mass_flow_curve = case_curve(c, 2, (double[]){0.0, 0.0, END, 1.5});
    c->gas.temperature_curve = case_curve(c, 2, (double[]){0.0, 900.0, END, 400.0});
}

static double volume_at(double time)
{
    return 0.06 * (1.0 + 0.1 * sin(200.0 * time));
}

static void run(void (*make)(GasCase *), int count, GasCase *c)
{
    make(c);
    case_start(c);
    for (int i = 1; i <= count; i++) {
        case_step(c, END / count, volume_at(END * i / count));
        c->time = END * i / count;
    }
}

static double difference(const GasCase *a, const GasCase *b)
{
    return fabs(a->state.pressure / b->state.pressure - 1.0) + fabs(a->state.temperature / b->state.temperature - 1.0) +
           fabs(a->state.mass / b->state.mass - 1.0);
}

static void test_order(void **unused)
{
    (void)unused;
    static void (*const cases[])(GasCase *) = {vent_case, heat_case, through_case};
    for (int k = 0; k < 3; k++) {
        GasCase fine, coarse, middle;
        run(cases[k], 6400, &fine);
        run(cases[k], 100, &coarse);
        run(cases[k], 200, &middle);
        double e1 = difference(&coarse, &fine), e2 = difference(&middle, &fine);
        if (!(e1 < 1e-4 && e1 > 3.5 * e2)) print_message("case %d: errors %.3g, %.3g\n", k, e1, e2);
        assert_true(e1 < 1e-4);
        assert_true(e1 > 3.5 * e2);
    }
}

/* Mass flow and temperature with corners and a jump inside one large step: mass and enthalpy to rounding. */
static void test_inflow_exact(void **unused)
{
    (void)unused;
    for (int dependent = 0; dependent < 2; dependent++) {
        GasCase c;
        case_air(&c, 0.06, 300.0, 101325.0);
        c.gas.temperature_dependent = dependent;
        c.gas.a = 28.11, c.gas.b = 0.0067, c.gas.molar_mass = 0.028964, c.gas.gas_constant = 8.314462618;
        c.gas.mass_flow_curve = case_curve(&c, 3, (double[]){0.0, 0.0, 0.010, 2.0, 0.020, 0.0});
        c.gas.temperature_curve =
            case_curve(&c, 5, (double[]){0.0, 300.0, 0.005, 800.0, 0.005000001, 500.0, 0.015, 500.0, 0.02, 700.0});
        GasCase whole = c;
        case_start(&whole);
        case_step(&whole, 0.03, 0.06);
        case_start(&c);
        for (int i = 0; i < 3; i++) case_step(&c, 0.01, 0.06);
        assert_relative(whole.state.mass_in, 0.02, 1e-14);
        assert_relative(c.state.mass_in, 0.02, 1e-14);
        double expected = 0.0, a = c.gas.a / 0.028964, b = dependent ? 0.5 * c.gas.b / 0.028964 : 0.0;
        if (!dependent) a = c.gas.cp;
        for (int i = 0; i < 4000000; i++) { /* midpoint rule, far finer */
            double t = 0.02 * (i + 0.5) / 4000000;
            double temperature = curve_value(&c.curves[1], t);
            expected += curve_value(&c.curves[0], t) * temperature * (a + b * temperature) * (0.02 / 4000000);
        }
        assert_relative(whole.state.enthalpy_in, expected, 2e-7); /* the jump is one point wide for the midpoint rule */
        assert_relative(c.state.enthalpy_in, whole.state.enthalpy_in, 1e-13);
    }
}

/* dT/dt by a curve (LCDT) with corners inside the step: mdot times a quadratic T, squared for cp(T), is exact too. */
static void test_temperature_rate_exact(void **unused)
{
    (void)unused;
    GasCase c;
    case_air(&c, 0.06, 300.0, 101325.0);
    c.gas.temperature_dependent = true;
    c.gas.a = 28.11, c.gas.b = 0.0067, c.gas.molar_mass = 0.028964, c.gas.gas_constant = 8.314462618;
    c.gas.inflow_temperature = 400.0;
    c.gas.mass_flow_curve = case_curve(&c, 2, (double[]){0.0, 0.0, 0.02, 2.0});
    c.gas.temperature_rate_curve = case_curve(&c, 3, (double[]){0.0, 0.0, 0.01, 6e4, 0.02, 0.0});
    GasCase whole = c;
    case_start(&whole);
    case_step(&whole, 0.02, 0.06);
    case_start(&c);
    for (int i = 0; i < 2000; i++) {
        case_step(&c, 0.02 * (i + 1) / 2000 - c.time, 0.06);
        c.time = 0.02 * (i + 1) / 2000;
    }
    assert_relative(whole.state.enthalpy_in, c.state.enthalpy_in, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_inflow_exact),
        cmocka_unit_test(test_temperature_rate_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
