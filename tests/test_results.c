/* Histories of a run: columns, and LS-DYNA's layouts. */
#include "tests/results_case.h"

/* Compares row (from 1, after the heading) of a CSV file with values, bit by bit, and its heading with the contract's.
 */
static void check_row(const char *name, const char *heading, int row, const double *values, int count)
{
    char *text = read_whole(name);
    assert_non_null(text);
    char *line = strchr(text, '\n');
    assert_non_null(line);
    *line++ = 0;
    assert_string_equal(text, heading);
    for (int i = 1; i < row; i++) line = strchr(line, '\n') + 1;
    for (int i = 0; i < count; i++) {
        char *end = NULL;
        assert_true(strtod(line, &end) == values[i]);
        assert_int_equal(*end, i + 1 < count ? ',' : '\n');
        line = end + 1;
    }
    free(text);
}

/* Headings are those of DESIGN's contract, typed again here so that a slip on either side shows. */
static void test_energy_and_gas_columns(void **unused)
{
    (void)unused;
    const double times[2] = {0.1, 1.0 / 3};
    write_run(false, 0, times, 2);
    const Energies *e = &small.energy;
    const GasState *g = &small.gas;
    const double t = times[1], total = e->kinetic + e->internal + e->hourglass + e->damping + e->contact;
    const double glstat[] = {t,          33,         small.clock.step, e->kinetic,     e->internal, e->hourglass,
                             e->damping, e->contact, e->external_work, e->airbag_work, total,       e->ratio,
                             0.0625};
    const double abstat[] = {t,
                             7,
                             g->volume,
                             g->pressure,
                             g->energy,
                             g->mass_flow_in,
                             g->density,
                             g->mass_flow_out,
                             g->mass,
                             g->temperature,
                             g->area,
                             g->reaction,
                             g->mass_flow_out_porosity,
                             g->mass_flow_out_vent};
    check_row("glstat.csv",
              "time,cycle,time_step,kinetic_energy,internal_energy,hourglass_energy,damping_energy,contact_energy,"
              "external_work,airbag_work,total_energy,energy_ratio,dt_element",
              2, glstat, 13);
    check_row("abstat.csv",
              "time,airbag,volume,pressure,internal_energy,mass_flow_in,density,mass_flow_out,mass,temperature,area,"
              "reaction,mass_flow_out_porosity,mass_flow_out_vent",
              2, abstat, 14);
}

static void test_motion_columns(void **unused)
{
    (void)unused;
    const double times[2] = {0.1, 1.0 / 3};
    write_run(false, 0, times, 2);
    const double t = times[1];
    const int node = 3 * small.deck_node[6];
    double nodout[14] = {t, 107};
    for (int c = 0; c < 3; c++) {
        nodout[2 + c] = small.x[node + c];
        nodout[5 + c] = small.x[node + c] - small.initial[node + c];
        nodout[8 + c] = small.v[node + c];
        nodout[11 + c] = small.a[node + c];
    }
    const double moving[] = {t, 20, 1.5 + t, 0.5, -t, 0.25, 0.5, t, t, 2, 3};
    const double matsum[] = {t, 20, 1.1 + t, 1.3, 1.2, 4, 1.4, 2.4, 3.4};
    check_row("nodout.csv", "time,node,x,y,z,ux,uy,uz,vx,vy,vz,ax,ay,az", 4, nodout, 14);
    check_row("rbdout.csv", "time,part,x,y,z,vx,vy,vz,ax,ay,az", 3, moving, 11);
    check_row("matsum.csv",
              "time,part,internal_energy,kinetic_energy,hourglass_energy,mass,x_momentum,y_momentum,z_momentum", 5,
              matsum, 9);
}

/* The fixed part rests at its centre of mass; areas of part 10 and 20 to begin with. */
static void test_fixed_body_and_areas(void **unused)
{
    (void)unused;
    const double times[1] = {0};
    write_run(false, 0, times, 1);
    char *text = read_whole("rbdout.csv");
    assert_non_null(strstr(text, "\n0,30,"));
    double x[9];
    assert_int_equal(sscanf(strstr(text, "\n0,30,") + 6, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", x, x + 1, x + 2, x + 3,
                            x + 4, x + 5, x + 6, x + 7, x + 8),
                     9);
    const double expected[9] = {7.0 / 3, 0.5};
    for (int c = 0; c < 9; c++) assert_true(fabs(x[c] - expected[c]) < 1e-14);
    free(text);
    text = read_whole("abstat_parts.csv");
    assert_string_equal(text, "time,airbag,part,unblocked_area,blocked_area,mass_flow_out\n0,7,10,1.5,0,0\n"
                              "0,7,20,0.5,0,0\n");
    free(text);
}

/* What contact covers is told from the rest; the measuring is test_airbag_leakage's. */
static void test_blocked_areas(void **unused)
{
    (void)unused;
    const double times[1] = {0.5};
    write_run(false, 0, times, 1);
    char *text = read_whole("abstat_parts.csv");
    assert_non_null(strstr(text, "\n0.5,7,10,1.875,0.125,0\n0.5,7,20,0.875,0.125,0\n"));
    free(text);
}

/* Lines as LS-DYNA writes them: readers cut by column. */
static void test_ascii_layouts(void **unused)
{
    (void)unused;
    const double times[1] = {0.5};
    write_run(false, 0, times, 1);
    static const struct {
        const char *name, *text;
    } expected[] = {
        {"glstat", "\n\n dt of cycle      50 is controlled by shell        12 of part        10\n\n"
                   " time...........................   5.00000E-01\n"
                   " time step......................   1.76667E-01\n"
                   " kinetic energy.................   2.50000E+00\n"},
        {"glstat", "\n hourglass energy ..............   2.78571E+00\n"},
        {"glstat", "\n external work..................   6.57143E+00\n"},
        {"glstat", "\n total energy / initial energy..   3.78571E+00\n"},
        {"abstat", "\n{BEGIN LEGEND}\n Entity #        Title\n        7     cushion "},
        {"abstat",
         "\n\n\n      time   airbag/cv #  volume        pressure    internal energy      dm/dt in      density "
         "dm/dt out  total mass gas temp. surface area   reaction dm/dt outp dm/dt outv\n"
         " 5.00000E-01       7     1.5000E+00     2.1667E+00     "},
        {"abstat", "\n    Material I.D.=          10  Unblocked  Area=  "},
        {"nodout",
         "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p      50                              "
         "( at time 5.0000000E-01 )\n\n nodal point  x-disp     y-disp      z-disp      x-vel       y-vel   "
         "    z-vel      x-accl      y-accl      z-accl      x-coor      y-coor      z-coor\n"
         "      102   1.1429E+00  1.2143E+00  1.2857E+00"},
        {"rbdout", "1\n\n  r i g i d   b o d y   m o t i o n   a t  cycle=      50    time=   5.000000E-01\n\n"
                   " rigid body      20\n   global             x           y           z          x-rot       y-rot    "
                   "   z-rot\n   coordinates:    2.0000E+00  5.0000E-01 -5.0000E-01\n"
                   " displacements:    5.0000E-01  0.0000E+00 -5.0000E-01  0.0000E+00  0.0000E+00  1.5708E+00\n"},
        {"rbdout", "    -1.0000E+00     0.0000E+00\n     row 2     1.0000E+00"},
        {"matsum", "\n\n\n time =   5.0000E-01\n mat.#=   10             inten=   6.0000E-01     kinen=   3.0000E-01"
                   "     eroded_ie=   0.0000E+00     eroded_ke=   0.0000E+00\n x-mom=   4.0000E-01     y-mom=   "
                   "1.4000E+00     z-mom=   2.4000E+00\n x-rbv=   8.0000E-02"},
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        char *text = read_whole(expected[i].name);
        assert_non_null(text);
        if (!strstr(text, expected[i].text))
            print_error("%s lacks\n%s\nit is\n%s", expected[i].name, expected[i].text, text);
        assert_non_null(strstr(text, expected[i].text));
        free(text);
    }
}

/* Exponents of three digits would run two columns together. */
static void test_ascii_columns_stay_apart(void **unused)
{
    (void)unused;
    Results *results = open_results(false, 0);
    small_set_time(&small, 1);
    small.gas.mass = -1e-200;
    small.gas.pressure = -1e200;
    assert_int_equal(results_write_abstat(results, &small.model, &small.state, &small.view), 0);
    assert_int_equal(results_close(results), 0);
    char *text = read_whole("abstat");
    assert_non_null(strstr(text, "    -9.9000E+99 "));
    assert_non_null(strstr(text, "  0.000E+00 "));
    assert_null(strstr(text, "E-200"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_energy_and_gas_columns, setup, teardown),
        cmocka_unit_test_setup_teardown(test_motion_columns, setup, teardown),
        cmocka_unit_test_setup_teardown(test_fixed_body_and_areas, setup, teardown),
        cmocka_unit_test_setup_teardown(test_blocked_areas, setup, teardown),
        cmocka_unit_test_setup_teardown(test_ascii_layouts, setup, teardown),
        cmocka_unit_test_setup_teardown(test_ascii_columns_stay_apart, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
