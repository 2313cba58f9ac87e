/* Tests of the gas against closed forms: adiabatic change, blowdown, tank, heat loss, orifice table, ledger. */
#include "tests/gas_case.h"

#include "airbag/gas_law.h"
#include "airbag/gas_pop.h"
#include "airbag/gas_vent.h"

/* B1: p V^gamma at the table's volumes, in steps of any size; the work is the table's; the cycle closes. */
static void test_adiabatic(void **unused)
{
    (void)unused;
    static const double table[][4] = {{0.05, 130788.74, 322.696127, -1149.84254},
                                      {0.04, 178749.31, 352.823707, -2676.18104},
                                      {0.03, 267398.278, 395.852373, -4856.12086},
                                      {0.02, 471722.258, 465.553672, -8387.36292},
                                      {0.015, 705668.287, 522.330338, -11263.8107}};
    static const int counts[] = {1, 7, 1000};
    for (int k = 0; k < 3; k++) {
        GasCase c;
        case_air(&c, 0.06, 300.0, 101325.0);
        case_start(&c);
        double volume = 0.06;
        for (int row = 0; row < 5; row++) {
            for (int i = 1; i <= counts[k]; i++) case_step(&c, 1e-5, volume + (table[row][0] - volume) * i / counts[k]);
            volume = table[row][0];
            assert_relative(c.state.pressure, table[row][1], 3e-9); /* the digits of the table */
            assert_relative(c.state.temperature, table[row][2], 3e-9);
            assert_relative(c.state.work, table[row][3], 1e-8);
            assert_relative(c.state.pressure * pow(volume, 1.4), 101325.0 * pow(0.06, 1.4), 1e-13);
        }
        for (int i = 1; i <= counts[k]; i++) case_step(&c, 1e-5, volume + (0.06 - volume) * i / counts[k]);
        assert_relative(c.state.pressure, 101325.0, 1e-12);
        assert_relative(c.state.temperature, 300.0, 1e-12);
        assert_true(fabs(c.state.work) < 1e-12 * c.state.energy);
        case_check_ledger(&c, 1e-14);
    }
}

/* 100,000 strokes of a piston squeeze the gas to a hundredth and back: no drift. */
static void test_adiabatic_drift(void **unused)
{
    (void)unused;
    GasCase c;
    case_air(&c, 0.06, 300.0, 101325.0);
    case_start(&c);
    for (int i = 0; i < 100000; i++) case_step(&c, 1e-5, i % 2 ? 0.06 : 0.0006 * (1 + i % 100));
    case_step(&c, 1e-5, 0.0006);
    assert_relative(c.state.pressure, 101325.0 * pow(100.0, 1.4), 1e-12);
    case_check_ledger(&c, 1e-13);
    case_step(&c, 1e-5, 0.06);
    assert_relative(c.state.pressure, 101325.0, 1e-12);
}

static const double blowdown[][4] = {
    {0.005, 288096.388, 395.399532, 0.152292062}, {0.01, 276729.518, 390.877976, 0.147975525},
    {0.02, 255499.221, 382.064473, 0.139774687},  {0.03, 236110.074, 373.545734, 0.132113239},
    {0.05, 202163.314, 357.341257, 0.118248269},  {0.06, 187305.216, 349.631879, 0.111973293},
    {0.08, 161375.644, 335.059484, 0.100668055},  {0.1, 140331.287, 321.946552, 0.0911058648},
    {0.12, 123987.123, 310.75538, 0.0833937553},  {0.15, 107892.949, 298.652546, 0.0755096478}};

static void start_blowdown(GasCase *c)
{
    case_air(c, 0.06, 400.0, 300000.0);
    c->gas.vent_coefficient = 0.75;
    c->gas.vent_area = 2e-3;
    case_start(c);
}

/* Largest relative error of p, T and m over the table. */
static double blowdown_error(double dt)
{
    GasCase c;
    start_blowdown(&c);
    double worst = 0.0;
    for (int row = 0; row < 10; row++) {
        if (dt > 0.0) {
            case_run(&c, blowdown[row][0], dt);
        } else {
            case_run_scaled(&c, blowdown[row][0]);
        }
        worst = fmax(worst, fabs(c.state.pressure / blowdown[row][1] - 1.0));
        worst = fmax(worst, fabs(c.state.temperature / blowdown[row][2] - 1.0));
        worst = fmax(worst, fabs(c.state.mass / blowdown[row][3] - 1.0));
    }
    case_check_ledger(&c, 1e-13);
    return worst;
}

/* B2: choked and subsonic blowdown; second order in the step; the gas's own step holds the tolerance too. */
static void test_blowdown(void **unused)
{
    (void)unused;
    double fine = blowdown_error(1e-5), coarse = blowdown_error(1e-3), middle = blowdown_error(5e-4);
    double scaled = blowdown_error(0.0);
    print_message("B2: dt 10 us %.2g, 0.5 ms %.2g, 1 ms %.2g, own step %.2g\n", fine, middle, coarse, scaled);
    assert_true(fine < 1e-8); /* asked: 1e-4 */
    assert_true(coarse < 1e-4 && middle < coarse / 3.0);
    assert_true(scaled < 1e-5);
}

/* B2: the end: ambient pressure reached at 0.185371 s with the isentropic temperature, and then nothing more. */
static void test_blowdown_end(void **unused)
{
    (void)unused;
    GasCase c;
    start_blowdown(&c);
    case_run(&c, 0.1850, 1e-5);
    assert_true(c.state.pressure > 101325.0 * (1.0 + 1e-6));
    case_run(&c, 0.1860, 1e-5);
    assert_relative(c.state.pressure, 101325.0, 1e-8);
    assert_relative(c.state.temperature, 293.34112, 1e-6);
    assert_relative(c.state.mass, 0.07219702, 1e-6);
    case_run(&c, 0.3, 1e-4);
    assert_relative(c.state.pressure, 101325.0, 1e-12);
    assert_true(c.state.mass_flow_out < 1e-9);
}

/* B3: tank test with constant flow: exact at any step, the gas's own included. */
static void test_tank(void **unused)
{
    (void)unused;
    static const double steps[] = {1e-6, 1e-5, 1e-3, 0.0};
    for (int k = 0; k < 4; k++) {
        GasCase c;
        case_air(&c, 0.0283168, 296.15, 101325.0);
        c.gas.inflow_temperature = 700.0;
        c.gas.mass_flow_curve = case_curve(&c, 2, (double[]){0.0, 1.0, 0.05, 1.0});
        case_start(&c);
        for (int row = 1; row <= 5; row++) {
            double t = 0.01 * row;
            if (steps[k] > 0.0) {
                case_run(&c, t, steps[k]);
            } else {
                case_run_scaled(&c, t);
            }
            double m = 101325.0 * 0.0283168 / (CASE_R * 296.15) + t;
            double p = 101325.0 + 0.4 * 3.5 * CASE_R * 700.0 * t / 0.0283168;
            assert_relative(c.state.mass, m, 1e-12);
            assert_relative(c.state.pressure, p, 1e-12); /* asked: 1e-8 */
            assert_relative(c.state.temperature, p * 0.0283168 / (m * CASE_R), 1e-12);
        }
        assert_relative(c.state.pressure, 598063.1927, 1e-9); /* the table's digits */
        assert_relative(c.state.temperature, 704.4187986, 1e-9);
        case_check_ledger(&c, 1e-14);
    }
}

/* A triangle of mass flow between two steps, and corners inside steps: the mass is the area whatever the step. */
static void test_mass_flow_exact(void **unused)
{
    (void)unused;
    static const double steps[] = {0.1, 0.013, 3e-4, 0.0};
    for (int k = 0; k < 4; k++) {
        GasCase c;
        case_air(&c, 0.0283168, 296.15, 101325.0);
        c.gas.inflow_temperature = 700.0;
        c.gas.mass_flow_curve =
            case_curve(&c, 6, (double[]){0.0, 0.0, 0.0111, 0.0, 0.0112, 2.0, 0.0113, -1.0, 0.0114, -1.0, 0.0115, 0.0});
        case_start(&c);
        if (steps[k] > 0.0) {
            case_run(&c, 0.1, steps[k]);
        } else {
            case_run_scaled(&c, 0.1);
        }
        assert_relative(c.state.mass_in, 0.5 * (1e-4 + 2.0 / 3.0 * 1e-4) * 2.0, 1e-11); /* no negative flow */
        assert_relative(c.state.enthalpy_in, c.state.mass_in * 3.5 * CASE_R * 700.0, 1e-11);
    }
}

/* B6: heat loss alone follows the exponential at any step; by a curve of HCONV too. */
static void test_heat_loss(void **unused)
{
    (void)unused;
    static const double table[][3] = {{0.01, 596.135506, 248389.794},
                                      {0.05, 581.162819, 242151.175},
                                      {0.2, 531.373037, 221405.432},
                                      {1.0, 380.631634, 158596.514}};
    for (int k = 0; k < 4; k++) {
        GasCase c;
        case_air(&c, 0.06, 600.0, 250000.0);
        c.gas.ambient_temperature = 296.15;
        if (k < 2) {
            c.gas.heat_transfer = 100.0;
        } else {
            c.gas.heat_transfer_curve = case_curve(&c, 2, (double[]){0.0, 100.0, 5.0, 100.0});
        }
        case_start(&c);
        for (int row = 0; row < 4; row++) {
            if (k == 3) {
                case_run_scaled(&c, table[row][0]);
            } else {
                case_run(&c, table[row][0], k == 0 ? 1e-4 : 0.5);
            }
            assert_relative(c.state.temperature, table[row][1], 3e-9);
            assert_relative(c.state.pressure, table[row][2], 3e-9);
        }
        assert_relative(c.state.heat_out, c.state.initial_energy - c.state.energy, 1e-12);
        case_check_ledger(&c, 1e-14);
    }
}

/* B8: the flow function, to the digits of the table. */
static void test_orifice_table(void **unused)
{
    (void)unused;
    static const double air[][2] = {{1.0, 0.0},         {1.001, 15.4407236}, {1.01, 48.8121573},
                                    {1.05, 108.991247}, {1.1, 153.861292},   {1.2, 216.817399},
                                    {1.5, 339.24633},   {1.8, 424.863473},   {1.89292916, 447.530669},
                                    {2.0, 472.844604},  {2.5, 591.055755},   {4.0, 945.689208}};
    static const double argon[][2] = {
        {1.0, 0.0},       {1.001, 18.1352318}, {1.01, 57.3742163},       {1.1, 182.180708},
        {1.5, 412.61506}, {2.0, 588.736515},   {2.05282082, 604.487345}, {4.0, 1177.86675}};
    GasLaw law = {.c0 = 2.5 * CASE_R, .r = CASE_R};
    for (int i = 0; i < 12; i++)
        assert_relative(gas_orifice_flux(&law, 1.0, 101325.0, 101325.0 * air[i][0], 300.0), air[i][1], 3e-9);
    double r = 8.314462618 / 0.039948;
    GasLaw noble = {.c0 = r / 0.6667, .r = r};
    for (int i = 0; i < 8; i++)
        assert_relative(gas_orifice_flux(&noble, 1.0, 101325.0, 101325.0 * argon[i][0], 300.0), argon[i][1], 3e-9);
    for (int i = 1; i < 400; i++) { /* against the formula as the keyword manual writes it, and no flow inwards */
        double ratio = 1.0 + 0.01 * i, q = fmax(1.0 / ratio, pow(2.0 / 2.4, 3.5)), p = 101325.0 * ratio;
        double flux = p / (CASE_R * sqrt(350.0)) * pow(q, 1.0 / 1.4) *
                      sqrt(2.0 * (1.4 * CASE_R / 0.4) * (1.0 - pow(q, 0.4 / 1.4)));
        assert_relative(gas_orifice_flux(&law, 1.0, 101325.0, p, 350.0), flux, 1e-12);
        double rho = p / (CASE_R * 350.0); /* the same as SIMPLE_AIRBAG_MODEL writes it */
        double simple = sqrt(2.0 * p * rho) * sqrt(1.4 * (pow(q, 2.0 / 1.4) - pow(q, 2.4 / 1.4)) / 0.4);
        assert_relative(simple, flux, 1e-12);
        assert_true(gas_orifice_flux(&law, 1.0, 101325.0, 101325.0 / ratio, 350.0) == 0.0);
    }
}

/* Everything at once for 100,000 steps: inflow, vent, leakage, heat, a pumping volume. */
static void test_ledger(void **unused)
{
    (void)unused;
    for (int dependent = 0; dependent < 2; dependent++) {
        GasCase c;
        case_air(&c, 0.05, 300.0, 120000.0);
        c.gas.temperature_dependent = dependent;
        c.gas.a = 28.11, c.gas.b = 0.0067, c.gas.molar_mass = 0.028964, c.gas.gas_constant = 8.314462618;
        c.gas.inflow_temperature = 700.0;
        c.gas.mass_flow_curve = case_curve(&c, 3, (double[]){0.0, 0.0, 0.3, 0.7, 1.0, 0.2});
        c.gas.temperature_curve = case_curve(&c, 3, (double[]){0.0, 500.0, 0.5, 900.0, 0.50001, 400.0});
        c.gas.vent_coefficient = 0.7, c.gas.vent_area = 1e-3;
        c.gas.porosity_coefficient = 0.2, c.gas.porosity_area = 1e-3;
        c.gas.heat_transfer = 50.0;
        case_start(&c);
        for (int i = 0; i < 100000; i++) case_step(&c, 1e-5, 0.05 * (1.0 + 0.3 * sin(1e-3 * i)));
        case_check_ledger(&c, 1e-14); /* asked: 1e-12 */
        assert_relative(c.state.mass_in, 0.5 * 0.3 * 0.7 + 0.7 * 0.45, 1e-12);
        double p = c.state.mass * CASE_R * c.state.temperature / c.state.volume;
        assert_relative(c.state.pressure, p, 1e-12);
        assert_relative(c.state.density * c.state.volume, c.state.mass, 1e-15);
        assert_true(c.state.mass_out > 0.1 && c.state.heat_out > 0.0);
    }
}

/* B14: the inflator's chamber, at steps from a microsecond to a millisecond; energy of bag and chamber is that
 * released. */
static void test_inflator(void **unused)
{
    (void)unused;
    static const double table[][7] = {{0.002, 6327380.9, 1294.3106, 0.50329581, 105987.32, 307.3797, 0.069704632},
                                      {0.005, 13479993, 1281.3494, 1.0776419, 127557.29, 357.57108, 0.072115029},
                                      {0.01, 21445431, 1222.4448, 1.755249, 189877.78, 483.93944, 0.079316951},
                                      {0.02, 29536842, 1132.0826, 2.5121386, 366781.85, 733.17537, 0.10113066},
                                      {0.03, 33056635, 1078.0587, 2.8810848, 574163.39, 904.66054, 0.1283018},
                                      {0.04, 13256422, 830.35104, 1.3164793, 706164.81, 963.83537, 0.14811059},
                                      {0.06, 2863242.1, 535.91928, 0.35393782, 775452.67, 965.12278, 0.16242603}};
    static const double steps[] = {1e-6, 2e-4, 1e-3};
    for (int k = 0; k < 3; k++) {
        GasCase c;
        const double r = 8.314462618 / 0.0280134;
        case_air(&c, 0.06, 296.15, 101325.0);
        c.gas.cv = 2.5 * r, c.gas.cp = 3.5 * r;
        c.gas.inflator = (InflatorChamber){.coefficient = 0.9,
                                           .area = 8e-5,
                                           .volume = 0.4e-3,
                                           .density = 250.0, /* 0.1 kg */
                                           .temperature = 1000.0,
                                           .burn_curve = case_curve(&c, 2, (double[]){0, 0, 0.03, 1})};
        case_start(&c);
        double mass = c.state.inflator_mass, energy = c.state.inflator_energy + c.state.energy, worst = 0.0;
        for (int row = 0; row < 7; row++) {
            case_run(&c, table[row][0], steps[k]);
            const GasState *s = &c.state;
            double pi = s->inflator_energy * 0.4 / 0.4e-3, ti = s->inflator_energy / (s->inflator_mass * c.gas.cv);
            double values[6] = {pi, ti, s->mass_flow_in, s->pressure, s->temperature, s->mass};
            for (int i = 0; i < 6; i++)
                if (i != 2 || k == 0) worst = fmax(worst, fabs(values[i] / table[row][i + 1] - 1.0));
        }
        print_message("B14: dt %g, off by %.2g\n", steps[k], worst);
        assert_true(worst < 1e-3);
        assert_relative(c.state.inflator_mass + c.state.mass_in, mass + 0.1, 1e-12);
        assert_relative(c.state.inflator_energy + c.state.energy, energy + 0.1 * 3.5 * r * 1000.0, 1e-12);
        case_run(&c, 2.0, 1e-3); /* it empties to the bag's pressure and stays there */
        assert_relative(c.state.inflator_energy * 0.4 / 0.4e-3, c.state.pressure, 1e-6);
    }
}

/* The exits open TDP after PPOP was reached, or TDA after the cumulated time of an acceleration, whichever is first. */
static void test_pop_criteria(void **unused)
{
    (void)unused;
    GasCase c;
    case_air(&c, 0.06, 300.0, 101325.0);
    c.gas.vent_coefficient = 1.0, c.gas.vent_area = 1e-3;
    c.gas.pop_pressure = 1000.0, c.gas.pop.delay = 0.01;
    case_start(&c);
    c.volume = 0.05;
    case_run(&c, 0.0095, 5e-4);
    assert_true(c.state.mass_out == 0.0);
    case_run(&c, 0.012, 5e-4);
    assert_true(c.state.mass_out > 0.0);
    c.gas.pop_pressure = 0.0; /* then only the delay counts */
    c.volume = 0.06;
    case_start(&c);
    assert_true(c.state.opened == 0.0);
    case_run(&c, 0.011, 5e-4);
    assert_true(c.state.opened == 1.0);
    static const double limits[4][4] = {{5, 0, 0, 0}, {0, 5, 0, 0}, {0, 0, 5, 0}, {0, 0, 0, 8}};
    for (int k = 0; k < 4; k++) {
        for (int j = 0; j < 3; j++) c.gas.pop.acceleration[j] = limits[k][j];
        c.gas.pop.magnitude = limits[k][3];
        c.gas.pop.duration = 0.002, c.gas.pop.acceleration_delay = 0.003;
        case_start(&c);
        assert_true(c.state.opened == 0.0 && gas_pops_by_acceleration(&c.gas));
        for (int i = 0; i < 20; i++) {
            double a[3] = {0}, t = 1e-3 * (i + 1);
            a[k < 3 ? k : 0] = i % 3 == 0 ? (k < 3 ? -6 : 9) : 4; /* beyond in steps 0, 3, ...: not continuous */
            if (k < 3) a[(k + 1) % 3] = 100;
            gas_sense_pop(&c.gas, a, t, 1e-3, &c.state);
            gas_check_pop(&c.gas, t, &c.state);
            assert_true((c.state.opened > 0.0) == (i >= 6)); /* 2 ms at t = 4 ms, 3 ms later */
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_adiabatic),    cmocka_unit_test(test_adiabatic_drift),
        cmocka_unit_test(test_blowdown),     cmocka_unit_test(test_blowdown_end),
        cmocka_unit_test(test_tank),         cmocka_unit_test(test_mass_flow_exact),
        cmocka_unit_test(test_heat_loss),    cmocka_unit_test(test_orifice_table),
        cmocka_unit_test(test_ledger),       cmocka_unit_test(test_inflator),
        cmocka_unit_test(test_pop_criteria),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
