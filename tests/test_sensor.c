/* Airbag sensors: every level, cumulated duration, local frame, shifted inflow, the user's function. A rigid box is the
 * bag; the sensor sits on a rigid plate of its own whose motion is prescribed. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/read.h"

typedef struct SensorCase {
    const char *cards;  /* RBID, then the sensor's cards */
    const char *frame;  /* card 3 of the plate's *MAT_RIGID, "" none */
    const char *motion; /* *BOUNDARY_PRESCRIBED_MOTION_RIGID cards with their curves */
    const char *library;
    const char *model; /* keyword and %s for the cards, NULL: WANG_NEFSKE */
} SensorCase;

static const char *const wang_nefske = "*AIRBAG_WANG_NEFSKE\n1,1,%s700.,1000.,400.,0,1,0,0,293.\n0,0,0,0,0,0,0,0\n"
                                       "101325.,1.2,1.,0,0,0,0,0\n0,0,0,0,0,0\n";

static const char *const box =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
    "11,2,0,0\n12,4,0,0\n13,4,1,0\n14,2,1,0\n"
    "*ELEMENT_SHELL\n1,1,4,3,2,1\n2,1,5,6,7,8\n3,1,1,2,6,5\n4,1,2,3,7,6\n5,1,3,4,8,7\n6,1,4,1,5,8\n"
    "7,9,11,12,13,14\n"
    "*SECTION_SHELL\n1,9\n1.E-3,1.E-3,1.E-3,1.E-3\n"
    "*PART\nbox\n1,1,1\n*PART\nplate\n9,1,2\n"
    "*MAT_RIGID\n1,1000.,1.E9,0.3\n1,7,7\n"
    "*SET_PART_LIST\n1\n1\n*CONTROL_TERMINATION\n0.03\n*CONTROL_TIMESTEP\n1.E-5\n"
    "*DEFINE_CURVE\n1\n0.,2.\n1.,2.\n";

static void build(VerifyRun *run, const SensorCase *c, int *status)
{
    static char text[8000];
    const char *model = c->model ? c->model : wang_nefske, *rest = strstr(model, "%s") + 2;
    int length = snprintf(text, sizeof text,
                          "*KEYWORD\n%s*MAT_RIGID\n2,1000.,1.E9,0.3\n\n%s%.*s%s%s%s*DATABASE_ABSTAT\n1.E-3\n*END\n",
                          box, c->frame, (int)(rest - 2 - model), model, c->cards, rest, c->motion);
    assert_true(length < (int)sizeof text);
    *status = verify_build(run, text, (size_t)length, &(VerifyOptions){.every = 1});
    if (*status && c->library) diagnostics_print(&run->diagnostics, SEVERITY_ERROR, stderr);
}

/* Time at which the sensor fires, INFINITY if it does not; the mass that has flowed in must be that since then. */
static double firing_time(const SensorCase *c)
{
    VerifyRun run;
    int status;
    build(&run, c, &status);
    if (status) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(status, 0);
    assert_int_equal(verify_loop(&run), 0);
    double start = run.state.gas[0].inflow_start, in = run.state.gas[0].mass_in;
    double expected = start < 0.03 ? 2.0 * (0.03 - start) : 0.0;
    if (!(fabs(in - expected) <= 1e-9)) fail_msg("fired at %g, but %g flowed in, not %g", start, in, expected);
    verify_free(&run);
    return start;
}

#define LEVELS(A, V, U) "-9,1,1,0,0,0\n" A "\n" V "\n" U "\n"
/* acceleration 100 along x from 0.01 to 0.013 and from 0.02 to 0.03 */
static const char *const pulses =
    "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n9,1,1,7,1.\n"
    "*DEFINE_CURVE\n7\n0.,0.\n0.00999,0.\n0.01,100.\n0.013,100.\n0.01301,0.\n0.01999,0.\n0.02,100.\n1.,100.\n";

static void assert_fires(const char *name, const SensorCase *c, double time, double tolerance)
{
    double fired = firing_time(c);
    if (!(fabs(fired - time) <= tolerance)) fail_msg("%s: fired at %g, not %g", name, fired, time);
}

/* A level fires at its time; one that is not reached, or of another axis, does not. */
static void levels_fire(void **state)
{
    (void)state;
    SensorCase c = {.frame = "1.,0.,0.,0.,1.,0.\n", .motion = pulses};
    const double step = 1e-4;
    const struct {
        const char *cards;
        double time;
    } cases[] = {
        {LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0"), 0.01},
        {LEVELS("50.,0,0,0,0.005", "0,0,0,0", "0,0,0,0"), 0.022}, /* 3 ms and 2 ms: cumulated */
        {LEVELS("0,50.,0,0,0", "0,0,0,0", "0,0,0,0"), INFINITY},
        {LEVELS("0,0,50.,0,0", "0,0,0,0", "0,0,0,0"), INFINITY},
        {LEVELS("150.,0,0,0,0", "0,0,0,0", "0,0,0,0"), INFINITY},
        {LEVELS("0,0,0,50.,0.001", "0,0,0,0", "0,0,0,0"), 0.011},
        {LEVELS("0,0,0,0,0", "0.5,0,0,0", "0,0,0,0"), 0.022},
        {LEVELS("0,0,0,0,0", "0,0.5,0,0", "0,0,0,0"), INFINITY},
        {LEVELS("0,0,0,0,0", "0,0,0.5,0", "0,0,0,0"), INFINITY},
        {LEVELS("0,0,0,0,0", "0,0,0,0.8", "0,0,0,0"), 0.025},
        {LEVELS("0,0,0,0,0", "0,0,0,0", "2.55E-3,0,0,0"), 0.02},
        {LEVELS("0,0,0,0,0", "0,0,0,0", "0,1.E-3,0,0"), INFINITY},
        {LEVELS("0,0,0,0,0", "0,0,0,0", "0,0,1.E-3,0"), INFINITY},
        {LEVELS("0,0,0,0,0", "0,0,0,0", "0,0,0,2.55E-3"), 0.02},
        {LEVELS("0,0,0,0,0", "0.5,0,0,0", "0,0,0,2.55E-3"), 0.02}, /* the first of two */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        c.cards = cases[i].cards;
        double fired = firing_time(&c);
        if (cases[i].time < 1 ? !(fabs(fired - cases[i].time) <= 2 * step) : fired < 1)
            fail_msg("case %zu: fired at %g, not %g", i, fired, cases[i].time);
    }
}

/* Mixtures wait as the single gas does: mass flow and temperature of each gas, or of all. */
static void mixtures_wait(void **state)
{
    (void)state;
    static const char *const models[] = {
        "*AIRBAG_HYBRID\n1,1,%s293.,101325.,1.2,8.314\n0\n0,0,1\n1,2,0,0.029,1,28.\n0\n*DEFINE_CURVE\n2\n0,400.\n1,400."
        "\n",
        "*AIRBAG_HYBRID\n1,1,%s293.,101325.,1.2,8.314\n0\n0,0,1,0,1\n3,2,0,0.029,1,28.\n0\n"
        "*DEFINE_CURVE\n2\n0,400.\n1,400.\n*DEFINE_CURVE\n3\n0,1.\n1,1.\n",
        "*AIRBAG_HYBRID_CHEMKIN\n1,1,%s1,2,1,2,293.,101325.,8.314\n0\n0\nN2,0.028,0,1,1\n"
        "*DEFINE_CURVE\n2\n0,400.\n1,400.\n"};
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        SensorCase c = {.cards = LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0"), .motion = pulses, .model = models[i]};
        c.frame = "1.,0.,0.,0.,1.,0.\n";
        assert_fires(models[i], &c, 0.01, 2e-4);
        c.cards = LEVELS("150.,0,0,0,0", "0,0,0,0", "0,0,0,0");
        assert_true(firing_time(&c) > 1);
    }
}

/* The inflator's chamber burns from when the sensor fires: nothing is in the bag before, all it has at the end. */
static void inflator_waits(void **state)
{
    (void)state;
    SensorCase c = {.cards = LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0"), .motion = pulses};
    c.frame = "1.,0.,0.,0.,1.,0.\n";
    c.model = "*AIRBAG_WANG_NEFSKE\n1,1,%s700.,1000.,400.,0,0,0,0,293.\n0,0,0,0,0,0,0,0\n101325.,1.2,1.,0,0,0,0,0\n"
              "1.,1.E-3,1.E-3,1000.,800.,2\n*DEFINE_CURVE\n2\n0,0\n0.005,1.\n1.,1.\n";
    double in[2];
    for (int i = 0; i < 2; i++) {
        VerifyRun run;
        int status;
        if (i == 1) c.cards = "0,1,1,0,0,0\n";
        build(&run, &c, &status);
        assert_int_equal(status, 0);
        assert_int_equal(verify_loop(&run), 0);
        double start = run.state.gas[0].inflow_start;
        for (size_t k = 0; k < run.count; k++)
            if (run.samples[k].time <= start) assert_true(run.samples[k].mass == run.state.gas[0].initial_mass);
        in[i] = verify_at(&run, start + 0.01, offsetof(VerifySample, mass)) - run.state.gas[0].initial_mass;
        assert_true(in[i] > 0.1);
        verify_free(&run);
    }
    verify_close("mass 10 ms after the start", in[0], in[1], 1e-3);
}

/* Models without an inflow: no pressure before the sensor fires, then all begins there: curves, V0, mass, level. */
static void laws_begin(void **state)
{
    (void)state;
    static const struct {
        const char *model;
        double start, slope; /* pressure on the walls at t since the sensor fired */
        double mass;
    } laws[] = {
        {"*AIRBAG_LOAD_CURVE\n1,1,%s0,2\n", 1e5, 1e6, 0},
        {"*AIRBAG_LOAD_CURVE\n1,1,%s0,0,1.2,1e5,2e4,300,0\n", 2e4, 0, 1.2},
        {"*AIRBAG_SIMPLE_PRESSURE_VOLUME\n1,1,%s-2,2\n", 2e5, 2e6, 0},
        {"*AIRBAG_SIMPLE_PRESSURE_VOLUME\n1,1,%s3e5,2\n", 6e5, 0, 0},
        {"*AIRBAG_ADIABATIC_GAS_MODEL\n1,1,%s2,0,1.4,2e4,1e5,1.2\n", 4e4, 0, 1.2},
        {"*AIRBAG_LINEAR_FLUID\n1,1,%s1e9,1000,0,0,0,2\n", 1e5, 1e6, 1000},
        {"*AIRBAG_FLUID_AND_GAS\n1,1,%s0.25,0,0.25,0,0,1000,0,2\n-3,3,0,0,1.4,2e9\n", 1e5, 1e6, 250},
        {"*AIRBAG_FLUID_AND_GAS\n1,1,%s0,0,0,0,0,1000,4,2\n-3,3,0,0,1.4,2e9\n", 1e5, 1e6, 1000 * (0.2 + 10 * 0.02)},
    };
    char model[400];
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        snprintf(model, sizeof model, "%s*DEFINE_CURVE\n2\n0,1e5\n1,1.1e6\n*DEFINE_CURVE\n4\n0,0.2\n0.05,0.7\n",
                 laws[i].model);
        SensorCase c = {.cards = LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0"), .motion = pulses, .model = model};
        c.frame = "1.,0.,0.,0.,1.,0.\n";
        VerifyRun run;
        int status;
        build(&run, &c, &status);
        if (status) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
        assert_int_equal(status, 0);
        assert_int_equal(verify_loop(&run), 0);
        double fired = run.state.gas[0].inflow_start;
        verify_near(laws[i].model, fired, 0.01, 2e-4);
        for (size_t k = 0; k < run.count; k++) {
            const VerifySample *s = &run.samples[k];
            double expected = s->time < fired ? 0 : laws[i].start + laws[i].slope * (s->time - fired);
            if (!(fabs(s->applied - expected) <= 1e-9 * laws[i].start))
                fail_msg("%s at %g: %g, not %g", laws[i].model, s->time, s->applied, expected);
        }
        verify_near("mass", run.state.gas[0].mass, laws[i].mass, 1e-9 + (i == 7 ? 1000 * 10 * 2e-4 : 0));
        verify_free(&run);
    }
}

/* The frame: vectors, a coordinate system, principal axes; it turns with the body. */
static void frame_is_local(void **state)
{
    (void)state;
    SensorCase c = {.frame = "0.,1.,0.,-1.,0.,0.\n", .motion = pulses};
    c.cards = LEVELS("0,50.,0,0,0", "0,0,0,0", "0,0,0,0"); /* local y is global -x */
    assert_fires("vectors", &c, 0.01, 2e-4);
    c.frame = "5\n";
    char motion[600];
    snprintf(motion, sizeof motion, "%s*DEFINE_COORDINATE_SYSTEM\n5,0,0,0,0,0,1.\n1.,0,0\n", pulses);
    c.motion = motion; /* x along global z, y along global x */
    assert_fires("LCO", &c, 0.01, 2e-4);
    c.frame = ""; /* longest along x, so the smallest moment is about x */
    c.motion = pulses;
    double x = firing_time(&(SensorCase){LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0"), "", pulses, NULL, NULL});
    double y = firing_time(&(SensorCase){LEVELS("0,50.,0,0,0", "0,0,0,0", "0,0,0,0"), "", pulses, NULL, NULL});
    double z = firing_time(&(SensorCase){LEVELS("0,0,50.,0,0", "0,0,0,0", "0,0,0,0"), "", pulses, NULL, NULL});
    assert_int_equal((x < 1) + (y < 1) + (z < 1), 1); /* just one principal axis lies along x */
    /* a quarter turn about z by 5 ms: what pushes along global x is then felt along local -y */
    c.frame = "1.,0.,0.,0.,1.,0.\n";
    snprintf(motion, sizeof motion,
             "%s*BOUNDARY_PRESCRIBED_MOTION_RIGID\n9,7,0,8,1.\n*DEFINE_CURVE\n8\n0.,314.159265\n0.005,314.159265\n"
             "0.0050001,0.\n1.,0.\n",
             pulses);
    c.motion = motion;
    c.cards = LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0");
    assert_true(firing_time(&c) > 1);
    c.cards = LEVELS("0,50.,0,0,0", "0,0,0,0", "0,0,0,0");
    assert_fires("turned", &c, 0.01, 2e-4);
}

/* RBID > 0: the example's function, with the constants of the cards. */
static void user_function_fires(void **state)
{
    (void)state;
    SensorCase c = {.frame = "-1.,0.,0.,0.,1.,0.\n", .motion = pulses, .library = BILLOW_SENSOR_EXAMPLE};
    c.cards = "9,1,1,0,0,0\n6\n50.,1.E-3,0,0,0\n7.\n";
    static char text[8000];
    int length = snprintf(text, sizeof text,
                          "*KEYWORD\n%s*MAT_RIGID\n2,1000.,1.E9,0.3\n\n%s"
                          "*AIRBAG_SIMPLE_AIRBAG_MODEL\n1,1,%s700.,1000.,400.,1,0,0,101325.,1.2\n0\n%s*END\n",
                          box, c.frame, c.cards, c.motion);
    Definitions definitions = {0};
    Diagnostics diagnostics = {0};
    Model model;
    assert_int_equal(deck_read_text("case.k", text, (size_t)length, &definitions, &diagnostics), 0);
    BuildOptions options = {.sensor_library = c.library};
    int status = model_build(&definitions, &options, &model, &diagnostics);
    if (status) diagnostics_print(&diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(status, 0);
    assert_int_equal(model.sensor_count, 1);
    assert_int_equal(model.sensors[0].constant_count, 6);
    assert_true(model.sensors[0].constant[0] == 50.0 && model.sensors[0].constant[5] == 7.0);
    SensorState sensor = {0};
    SensorMotion motion = {.step = 1e-4, .acceleration = {100, 0, 0}, .turn = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    int calls = 1;
    while (!sensor_fires(&model.sensors[0], &motion, &sensor)) calls++;
    assert_int_equal(calls, 7);                                      /* 1 - 0.9^7 = 0.52 */
    assert_false(sensor_fires(&model.sensors[0], &motion, &sensor)); /* only once */
    model_free(&model);
    definitions_free(&definitions);
    diagnostics_free(&diagnostics);
}

static void assert_refused(const SensorCase *c, const char *text)
{
    VerifyRun run;
    int status;
    build(&run, c, &status);
    if (!verify_message(&run.diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
        fail_msg("no message with '%s'", text);
    }
    assert_int_equal(status, -1);
    verify_free(&run);
}

static void mistakes_are_explained(void **state)
{
    (void)state;
    SensorCase c = {.frame = "", .motion = ""};
    c.cards = "9,1,1,0,0,0\n0\n";
    assert_refused(&c, "--sensor-library FILE");
    c.cards = "9,1,1,0,0,0\n26\n1.,1.\n";
    assert_refused(&c, "0 to 25 constants");
    c.cards = "-8,1,1,0,0,0\n1.\n0.\n0.\n";
    assert_refused(&c, "there is no part of this id");
    c.cards = "-9,1,1,0,0,0\n-1.\n0.\n0.\n";
    assert_refused(&c, "negative");
    c.cards = LEVELS("50.,0,0,0,0", "0,0,0,0", "0,0,0,0");
    c.frame = "1.,0.,0.,2.,0.,0.\n";
    assert_refused(&c, "do not span a plane");
    c.frame = "";
    c.model = NULL;
    c.cards = "-1,1,1,0,0,0\n1.\n0.\n0.\n";
    VerifyRun run;
    int status;
    build(&run, &c, &status);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "never moves"));
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_fire),
        cmocka_unit_test(mixtures_wait),
        cmocka_unit_test(inflator_waits),
        cmocka_unit_test(laws_begin),
        cmocka_unit_test(frame_is_local),
        cmocka_unit_test(user_function_fires),
        cmocka_unit_test(mistakes_are_explained),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
