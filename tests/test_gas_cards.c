/* Every field of the two airbag cards acts, and acts as an independent integration of the equations says. */
#include "tests/gas_case.h"

/* --- The equations once more, written plainly and integrated by Runge and Kutta with small steps. --- */

typedef struct Reference {
    const GasCase *c;
    double y[3]; /* mass, energy, mass of the tank */
    double opened;
} Reference;

static double look_up(const GasCase *c, int curve, double x)
{
    const Curve *k = &c->curves[curve];
    if (x <= k->x[0]) return k->y[0];
    for (int i = 1; i < k->count; i++)
        if (x < k->x[i]) return k->y[i - 1] + (k->y[i] - k->y[i - 1]) * (x - k->x[i - 1]) / (k->x[i] - k->x[i - 1]);
    return k->y[k->count - 1];
}

static double gas_r(const GasModel *g)
{
    return g->temperature_dependent ? g->gas_constant / g->molar_mass : g->cp - g->cv;
}

static double cp_of(const GasModel *g, double t)
{
    return g->temperature_dependent ? (g->a + g->b * t) / g->molar_mass : g->cp;
}

static double enthalpy_of(const GasModel *g, double t)
{
    return g->temperature_dependent ? (g->a * t + 0.5 * g->b * t * t) / g->molar_mass : g->cp * t;
}

static double energy_of(const GasModel *g, double t)
{
    return enthalpy_of(g, t) - gas_r(g) * t;
}

/* T of the specific internal energy, by Newton. */
static double temperature_of(const GasModel *g, double u)
{
    double t = 300.0;
    for (int i = 0; i < 50; i++) t -= (energy_of(g, t) - u) / (cp_of(g, t) - gas_r(g));
    return t;
}

static double inflow_temperature_of(const GasCase *c, double time)
{
    const GasModel *g = &c->gas;
    if (g->temperature_curve >= 0) return look_up(c, g->temperature_curve, time);
    double t = g->inflow_temperature;
    if (g->temperature_rate_curve >= 0) t += 2e4 * time; /* the curve of the case below is constant */
    return t;
}

static double exit_of(const GasCase *c, double time, double p, double t)
{
    const GasModel *g = &c->gas;
    double pe = g->ambient_pressure;
    if (p <= pe) return 0.0;
    if (g->exit_flow_curve >= 0) return look_up(c, g->exit_flow_curve, p - pe);
    double mu = g->vent_coefficient, area = g->vent_area, cp23 = g->porosity_coefficient, ap23 = g->porosity_area;
    if (g->vent_coefficient_pressure_curve >= 0) mu = look_up(c, g->vent_coefficient_pressure_curve, p);
    if (g->vent_coefficient_time_curve >= 0) mu = look_up(c, g->vent_coefficient_time_curve, time);
    if (g->vent_coefficient_ratio_curve >= 0) mu = look_up(c, g->vent_coefficient_ratio_curve, pe / p);
    if (g->vent_area_pressure_curve >= 0) area = look_up(c, g->vent_area_pressure_curve, p);
    if (g->porosity_coefficient_time_curve >= 0) cp23 = look_up(c, g->porosity_coefficient_time_curve, time);
    if (g->porosity_area_pressure_curve >= 0) ap23 = look_up(c, g->porosity_area_pressure_curve, p);
    double r = gas_r(g), gamma = cp_of(g, t) / (cp_of(g, t) - r);
    double q = fmax(pe / p, pow(2.0 / (gamma + 1.0), gamma / (gamma - 1.0)));
    return (mu * area + cp23 * ap23) * p / (r * sqrt(t)) * pow(q, 1.0 / gamma) *
           sqrt(2.0 * g->gravity_conversion * gamma * r / (gamma - 1.0) * (1.0 - pow(q, (gamma - 1.0) / gamma)));
}

/* Volume of the mesh: a bag that grows and breathes. */
static double mesh_volume(double time)
{
    return 0.05 + 1.0 * time + 0.002 * sin(300.0 * time);
}

static double gas_volume(const GasCase *c, double time)
{
    return c->vsca * mesh_volume(time) - c->vini;
}

static double volume_rate(const GasCase *c, double time)
{
    return c->vsca * (1.0 + 0.6 * cos(300.0 * time));
}

static void rates(const Reference *s, double time, const double y[3], double dy[3])
{
    const GasCase *c = s->c;
    const GasModel *g = &c->gas;
    double r = gas_r(g), t = temperature_of(g, y[1] / y[0]), v = gas_volume(c, time), p = y[0] * r * t / v;
    double tin = inflow_temperature_of(c, time), in = 0.0;
    if (g->mass_flow_curve >= 0) in = fmax(look_up(c, g->mass_flow_curve, time), 0.0);
    if (g->tank_pressure_curve >= 0) { /* energy balance of the tank, its temperature from p V = m R T */
        double slope = curve_slope(&c->curves[g->tank_pressure_curve], time);
        double pt = g->ambient_pressure + look_up(c, g->tank_pressure_curve, time) - c->y[g->tank_pressure_curve][0];
        double tt = pt * g->tank_volume / (y[2] * r), cv = cp_of(g, tt) - r;
        in = cv * g->tank_volume * slope / (r * (enthalpy_of(g, tin) - energy_of(g, tt) + cv * tt));
    }
    double out = s->opened > 0.0 ? exit_of(c, time, p, t) : 0.0;
    double h = g->heat_transfer_curve >= 0 ? look_up(c, g->heat_transfer_curve, time) : g->heat_transfer;
    double text =
        g->ambient_temperature > 0.0 ? g->ambient_temperature : g->ambient_pressure / (g->ambient_density * r);
    dy[0] = in - out;
    dy[1] = in * enthalpy_of(g, tin) - out * enthalpy_of(g, t) - h * c->surface * (t - text) - p * volume_rate(c, time);
    dy[2] = in;
}

static void reference_step(Reference *s, double time, double dt)
{
    double k[4][3], y[3];
    static const double part[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 3; j++) y[j] = s->y[j] + (i ? part[i] * dt * k[i - 1][j] : 0.0);
        rates(s, time + part[i] * dt * 0.999999, y, k[i]); /* stays left of a corner at the end */
    }
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) s->y[j] += weight[i] * dt * k[i][j];
}

/* p, T and m at end. */
static void reference_run(const GasCase *c, double end, int count, double result[3])
{
    const GasModel *g = &c->gas;
    double r = gas_r(g), t0 = g->initial_temperature, p0 = g->ambient_pressure + g->overpressure;
    if (t0 == 0.0) t0 = g->ambient_pressure / (g->ambient_density * r);
    Reference s = {.c = c, .opened = g->pop_pressure > 0.0 ? 0.0 : 1.0};
    s.y[0] = p0 * gas_volume(c, 0.0) / (r * t0);
    s.y[1] = s.y[0] * energy_of(g, t0);
    s.y[2] = g->ambient_pressure * g->tank_volume / (r * t0);
    for (int i = 0; i < count; i++) {
        reference_step(&s, end * i / count, end / count);
        double t = temperature_of(g, s.y[1] / s.y[0]), p = s.y[0] * r * t / gas_volume(c, end * (i + 1) / count);
        if (p - g->ambient_pressure >= g->pop_pressure) s.opened = 1.0;
        result[0] = p, result[1] = t, result[2] = s.y[0];
    }
}

/* --- The cases: each changes one field of a card. --- */

static void base_case(GasCase *c)
{
    case_air(c, mesh_volume(0.0), 0.0, 101325.0);
    c->gas.inflow_temperature = 700.0;
    c->gas.mass_flow_curve = case_curve(c, 3, (double[]){0.0, 0.0, 0.01, 8.0, 0.04, 2.0});
    c->gas.vent_coefficient = 0.7;
    c->gas.vent_area = 4e-3;
    c->gas.a = 28.11, c->gas.b = 0.0067, c->gas.molar_mass = 0.028964, c->gas.gas_constant = 8.314462618;
}

static void hot_case(GasCase *c) /* CV = 0 */
{
    base_case(c);
    c->gas.temperature_dependent = true;
}

static void porous_case(GasCase *c)
{
    base_case(c);
    c->gas.porosity_coefficient = 0.3, c->gas.porosity_area = 5e-3;
}

static void heat_case(GasCase *c)
{
    hot_case(c);
    c->gas.heat_transfer = 2000.0;
}

static void tank_case(GasCase *c)
{
    base_case(c);
    c->gas.mass_flow_curve = -1;
    c->gas.tank_pressure_curve = case_curve(c, 3, (double[]){0.0, 3e3, 0.01, 3e5, 0.04, 9e5});
    c->gas.tank_volume = 0.06;
}

static void hot_tank_case(GasCase *c)
{
    tank_case(c);
    c->gas.temperature_dependent = true;
}

#define CHANGE(name, statement)                                                                                        \
    static void name(GasCase *c)                                                                                       \
    {                                                                                                                  \
        statement;                                                                                                     \
    }
#define POINTS(...)                                                                                                    \
    case_curve(c, (int)(sizeof((double[]){__VA_ARGS__}) / (2 * sizeof(double))), (double[]){__VA_ARGS__})

CHANGE(set_cv, c->gas.cv *= 0.9)
CHANGE(set_cp, c->gas.cp *= 1.1)
CHANGE(set_t, c->gas.inflow_temperature = 500.0)
CHANGE(set_lcid, c->gas.mass_flow_curve = POINTS(0.0, 0.0, 0.005, 5.0, 0.04, 1.0))
CHANGE(set_mu, c->gas.vent_coefficient = 0.4)
CHANGE(set_mu_curve, c->gas.vent_coefficient = 0.0;
       c->gas.vent_coefficient_pressure_curve = POINTS(101325.0, 0.1, 250000.0, 0.9))
CHANGE(set_area, c->gas.vent_area = 1e-3)
CHANGE(set_area_curve, c->gas.vent_area = 0.0; c->gas.vent_area_pressure_curve = POINTS(110000.0, 0.0, 150000.0, 5e-3))
CHANGE(set_pe, c->gas.ambient_pressure = 80000.0)
CHANGE(set_ro, c->gas.ambient_density *= 1.2)
CHANGE(set_lou, c->gas.exit_flow_curve = POINTS(0.0, 0.0, 50000.0, 3.0, 100000.0, 4.0))
CHANGE(set_t_ext, c->gas.initial_temperature = 400.0)
CHANGE(set_a, c->gas.a = 33.0)
CHANGE(set_b, c->gas.b = 0.02)
CHANGE(set_negative_b, c->gas.b = -0.003)
CHANGE(set_mw, c->gas.molar_mass = 0.02)
CHANGE(set_gasc, c->gas.gas_constant = 8.0)
CHANGE(set_lct, c->gas.temperature_curve = POINTS(0.0, 300.0, 0.02, 900.0, 0.020001, 500.0))
CHANGE(set_lcdt, c->gas.temperature_rate_curve = POINTS(0.0, 2e4, 1.0, 2e4))
CHANGE(set_tvol, c->gas.tank_volume = 0.03)
CHANGE(set_iabt, c->gas.initial_temperature = 350.0)
CHANGE(set_lcc23, c->gas.vent_coefficient = 0.0;
       c->gas.vent_coefficient_time_curve = POINTS(0.0, 0.0, 0.01, 0.9, 0.03, 0.2))
CHANGE(set_lcc23_ratio, c->gas.vent_coefficient = 0.0; c->gas.vent_coefficient_ratio_curve = POINTS(0.5, 0.9, 1.0, 0.3))
CHANGE(set_cp23, c->gas.porosity_coefficient = 0.6)
CHANGE(set_lccp23, c->gas.porosity_coefficient = 0.0;
       c->gas.porosity_coefficient_time_curve = POINTS(0.0, 0.0, 0.02, 0.5))
CHANGE(set_ap23, c->gas.porosity_area = 1e-3)
CHANGE(set_lcap23, c->gas.porosity_area = 0.0;
       c->gas.porosity_area_pressure_curve = POINTS(101325.0, 1e-3, 200000.0, 8e-3))
CHANGE(set_gc, c->gas.gravity_conversion = 0.25)
CHANGE(set_pover, c->gas.overpressure = 40000.0)
CHANGE(set_ppop, c->gas.pop_pressure = 60000.0)
CHANGE(set_hconv, c->gas.heat_transfer = 1000.0)
CHANGE(set_hconv_curve, c->gas.heat_transfer = 0.0; c->gas.heat_transfer_curve = POINTS(0.0, 0.0, 0.02, 5000.0))
CHANGE(set_text, c->gas.ambient_temperature = 700.0)
CHANGE(set_vsca, c->vsca = 1.5)
CHANGE(set_vini, c->vini = 0.01)

typedef struct Field {
    const char *name;
    void (*base)(GasCase *), (*change)(GasCase *);
} Field;

static const Field fields[] = {
    {"CV", base_case, set_cv},
    {"CP", base_case, set_cp},
    {"T", base_case, set_t},
    {"LCID, LCMT", base_case, set_lcid},
    {"MU, C23", base_case, set_mu},
    {"MU < 0", base_case, set_mu_curve},
    {"AREA, A23", base_case, set_area},
    {"AREA < 0, LCA23", base_case, set_area_curve},
    {"PE", base_case, set_pe},
    {"RO", base_case, set_ro},
    {"LOU, LCEFR", base_case, set_lou},
    {"T_EXT", hot_case, set_t_ext},
    {"A", hot_case, set_a},
    {"B", hot_case, set_b},
    {"B < 0", hot_case, set_negative_b},
    {"MW", hot_case, set_mw},
    {"GASC", hot_case, set_gasc},
    {"CV = 0", base_case, hot_case},
    {"LCT", base_case, set_lct},
    {"LCT, CV = 0", hot_case, set_lct},
    {"LCDT", base_case, set_lcdt},
    {"LCDT, CV = 0", hot_case, set_lcdt},
    {"TVOL", tank_case, set_tvol},
    {"TVOL with LCT", tank_case, set_lct},
    {"TVOL with LCDT", tank_case, set_lcdt},
    {"TVOL, CV = 0", hot_tank_case, set_tvol},
    {"TVOL with LCDT, CV = 0", hot_tank_case, set_lcdt},
    {"IABT", base_case, set_iabt},
    {"LCC23 > 0", base_case, set_lcc23},
    {"LCC23 < 0", base_case, set_lcc23_ratio},
    {"CP23, AP23", base_case, porous_case},
    {"CP23", porous_case, set_cp23},
    {"LCCP23", porous_case, set_lccp23},
    {"AP23", porous_case, set_ap23},
    {"LCAP23", porous_case, set_lcap23},
    {"GC", base_case, set_gc},
    {"POVER", base_case, set_pover},
    {"PPOP", base_case, set_ppop},
    {"HCONV", hot_case, heat_case},
    {"HCONV, value", heat_case, set_hconv},
    {"HCONV < 0", heat_case, set_hconv_curve},
    {"TEXT", heat_case, set_text},
    {"VSCA", base_case, set_vsca},
    {"VINI", base_case, set_vini},
};

enum { STEPS = 3600 };
static const double END = 0.036;

static void run_case(GasCase *c)
{
    case_start(c);
    for (int i = 0; i < STEPS; i++) {
        double next = END * (i + 1) / STEPS;
        case_step(c, next - c->time, mesh_volume(next));
        c->time = next;
    }
    case_check_ledger(c, 1e-13);
}

static void test_fields(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        GasCase base, c;
        fields[i].base(&base);
        run_case(&base);
        fields[i].base(&c);
        fields[i].change(&c);
        run_case(&c);
        double difference = fabs(c.state.pressure / base.state.pressure - 1.0) +
                            fabs(c.state.temperature / base.state.temperature - 1.0) +
                            fabs(c.state.mass / base.state.mass - 1.0);
        double expected[3];
        reference_run(&c, END, 4 * STEPS, expected);
        double errors[3] = {c.state.pressure / expected[0] - 1.0, c.state.temperature / expected[1] - 1.0,
                            c.state.mass / expected[2] - 1.0};
        double limit = c.gas.pop_pressure > 0.0 ? 1e-3 : 2e-5; /* the pop is resolved to one step */
        for (int j = 0; j < 3; j++) {
            if (!(fabs(errors[j]) < limit))
                print_message("%s: error %.3g in %c\n", fields[i].name, errors[j], "pTm"[j]);
            assert_true(fabs(errors[j]) < limit);
        }
        if (!(difference > 5e-3)) print_message("%s: no effect (%.3g)\n", fields[i].name, difference);
        assert_true(difference > 5e-3);
    }
}

/* PSCA scales what acts on the walls and its stiffness, nothing in the gas; VSCA scales the stiffness. */
static void test_applied(void **unused)
{
    (void)unused;
    GasCase base, c;
    base_case(&base);
    run_case(&base);
    base_case(&c);
    c.psca = 2.5;
    run_case(&c);
    assert_true(c.state.pressure == base.state.pressure && c.state.mass == base.state.mass);
    assert_relative(base.state.applied, base.state.pressure - 101325.0, 1e-15);
    assert_relative(c.state.applied, 2.5 * base.state.applied, 1e-15);
    assert_relative(c.state.stiffness, 2.5 * base.state.stiffness, 1e-15);
    for (int dependent = 0; dependent < 2; dependent++) { /* stiffness = |d applied / dV| of the closed bag */
        GasCase left, right;
        base_case(&left);
        left.gas.temperature_dependent = dependent;
        left.gas.mass_flow_curve = -1, left.gas.vent_area = 0.0;
        left.vsca = 3.0, left.psca = 0.5;
        case_start(&left);
        right = left;
        case_step(&left, 1e-6, left.volume * (1.0 - 1e-5));
        case_step(&right, 1e-6, right.volume * (1.0 + 1e-5));
        double slope = (left.state.applied - right.state.applied) / (2e-5 * left.volume);
        case_start(&left);
        assert_relative(left.state.stiffness, slope, 1e-8);
    }
}

/* The two kinds of exit flow are told apart, and the rates are the means of the step. */
static void test_flow_columns(void **unused)
{
    (void)unused;
    GasCase c;
    porous_case(&c);
    c.gas.overpressure = 50000.0;
    case_start(&c);
    for (int i = 0; i < 50; i++) {
        GasState before = c.state;
        case_step(&c, 1e-4, c.volume);
        assert_relative(c.state.mass_flow_out, (c.state.mass_out - before.mass_out) / 1e-4, 1e-9);
        assert_relative(c.state.mass_flow_in, (c.state.mass_in - before.mass_in) / 1e-4, 1e-9);
        assert_relative(c.state.mass_flow_out_vent + c.state.mass_flow_out_porosity, c.state.mass_flow_out, 1e-9);
        assert_relative(c.state.mass_flow_out_vent / c.state.mass_flow_out_porosity, 0.7 * 4e-3 / (0.3 * 5e-3), 1e-9);
    }
    set_lou(&c);
    case_start(&c);
    case_step(&c, 1e-4, c.volume);
    assert_true(c.state.mass_flow_out_porosity == 0.0);
    assert_relative(c.state.mass_flow_out_vent, c.state.mass_flow_out, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields),
        cmocka_unit_test(test_applied),
        cmocka_unit_test(test_flow_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
