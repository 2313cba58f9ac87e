/* User's functions in the exit fields of *AIRBAG_WANG_NEFSKE: a box with 3 bar blows down as it does with constants and
 * curves; each field takes a function; others refuse it. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define PRESSURE offsetof(VerifySample, pressure)

/* Card 4 of the bag, and what follows it in the deck. */
static void write_box(Scene *scene, const char *card4, const char *definitions)
{
    verify_begin_box(scene, (const double[3]){0.2, 0.3, 1}, 1, 7, 0.05);
    SceneText *deck = &scene->deck;
    double r = 8.314462618 / 0.028964;
    scene_print(deck, "*AIRBAG_WANG_NEFSKE\n");
    SCENE_CARD(deck, 1, 1, 0, 1, 1, 0, 0, 0);
    SCENE_CARD(deck, 2.5 * r, 3.5 * r, 293.15, 0, 1, 0, 0, 400);
    scene_print(deck, "%s\n", card4);
    SCENE_CARD(deck, 101325, 101325 / (r * 293.15), 1, 0, 300000 - 101325, 0, 0, 0);
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0);
    scene_print(deck, "%s", definitions);
    scene_end(deck, &scene->mesh);
}

static double final_pressure(const char *card4, const char *definitions)
{
    Scene scene = {0};
    write_box(&scene, card4, definitions);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double pressure = run.samples[run.count - 1].pressure;
    verify_free(&run);
    return pressure;
}

static const double B2_AT_50_MS = 202163.314;

static void constant_functions_do_as_constants(void **state)
{
    (void)state;
    const char *area = "*DEFINE_CURVE_FUNCTION\n         7\n1.5E-3 / 0.6\n";
    const char *coefficient = "*DEFINE_FUNCTION\n         7\nfloat f(float p, float v, float t) { return 10*v; }\n";
    double plain =
        final_pressure("       0.6         0    2.5E-3         0         0         0         0         0", "");
    verify_close("B2 with constants", plain, B2_AT_50_MS, 1e-4);
    verify_close("LCA23", final_pressure("0.6,0,0,7,0,0,0,0", area), plain, 1e-12);
    verify_close("LCC23", final_pressure("0,7,2.5E-3,0,0,0,0,0", coefficient), plain, 1e-12);
    verify_close("LCC23 < 0", final_pressure("0,-7,2.5E-3,0,0,0,0,0", coefficient), plain, 1e-12);
    verify_close("LCAP23", final_pressure("0,0,0,0,0.6,0,0,7", area), plain, 1e-12);
    verify_close("LCCP23", final_pressure("0,0,0,0,0,7,2.5E-3,0", coefficient), plain, 1e-12);
}

/* The value holds over a step and is that of its middle: a ramp in time to second order, a slope over pressure to first
 * order. */
static void varying_functions_do_as_curves(void **state)
{
    (void)state;
    const char *ramp = "*DEFINE_CURVE\n         7\n0.,0.\n0.05,1.2\n";
    double curve = final_pressure("0,7,2.5E-3,0,0,0,0,0", ramp);
    verify_close("in time", final_pressure("0,8,2.5E-3,0,0,0,0,0", "*DEFINE_CURVE_FUNCTION\n         8\n24*TIME\n"),
                 curve, 1e-5);
    verify_close(
        "LC7 in time",
        final_pressure("0,8,2.5E-3,0,0,0,0,0",
                       "*DEFINE_CURVE\n         7\n0.,0.\n0.05,1.2\n*DEFINE_CURVE_FUNCTION\n         8\nLC7\n"),
        curve, 1e-5);
    verify_close("argument t",
                 final_pressure("0,8,2.5E-3,0,0,0,0,0",
                                "*DEFINE_FUNCTION\n         8\nreal function f(p,v,t)\nf = 24.*t\nend\n"),
                 curve, 1e-5);
    double slope = final_pressure("0.6,0,0,7,0,0,0,0", "*DEFINE_CURVE\n         7\n1.E5,0.\n3.E5,5.E-3\n");
    verify_close("over pressure",
                 final_pressure("0.6,0,0,8,0,0,0,0", "*DEFINE_FUNCTION\n         8\nf(p)=2.5E-8*(p-1.E5)\n"), slope,
                 1e-3);
}

/* The lid's displacement opens the vent. */
static void functions_see_the_walls(void **state)
{
    (void)state;
    Scene scene = {0};
    verify_begin_box(&scene, (const double[3]){0.2, 0.3, 1}, 1, 4, 0.05);
    SceneText *deck = &scene.deck;
    double r = 8.314462618 / 0.028964;
    scene_print(deck, "*AIRBAG_WANG_NEFSKE\n");
    SCENE_CARD(deck, 1, 1, 0, 1, 1, 0, 0, 0);
    SCENE_CARD(deck, 2.5 * r, 3.5 * r, 293.15, 0, 1, 0, 0, 400);
    SCENE_CARD(deck, 1, 0, 0, 8, 0, 0, 0, 0);
    SCENE_CARD(deck, 101325, 101325 / (r * 293.15), 1, 0, 100000, 0, 0, 0);
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0);
    scene_print(deck, "*DEFINE_CURVE_FUNCTION\n         8\nIF(DZ(5,1)+0.01, 1.E-2, 0, 0)\n");
    scene_write_curve(deck, 2, 2, (const double[]){0, -1, 1, -1});
    scene_write_rigid_motion(deck, 2, 3, 0, 2, 1);
    scene_end(deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = 4});
    double opened = 1;
    for (size_t i = 0; i < run.count; i++)
        if (run.samples[i].mass_flow_out > 0 && run.samples[i].time < opened) opened = run.samples[i].time;
    verify_between("the vent opens 10 mm down [s]", opened, 0.01, 0.0105);
    verify_free(&run);
}

/* Only the State goes on: a function of the gas, the step and the cycle is not remembered anywhere else. */
static void same_bits_after_a_restart(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int restart = 0; restart < 2; restart++) {
        Scene scene = {0};
        write_box(&scene, "0.6,0,0,7,0,8,1.E-4,0",
                  "*DEFINE_FUNCTION\n         7\nf(p,v,t)=2.5E-8*(p-1.E5)*exp(-t)\n"
                  "*DEFINE_CURVE_FUNCTION\n         8\n0.1+TIMESTEP+sin(NCYCLE)**2\n");
        VerifyRun run;
        const VerifyOptions options = {.stop = restart ? 20 : 41};
        assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &options), 0);
        assert_int_equal(verify_loop(&run), 0);
        run.options.stop = 41;
        if (restart) assert_int_equal(verify_loop(&run), 0);
        hash[restart] = state_hash(&run.state);
        verify_free(&run);
        scene_free(&scene);
    }
    assert_true(hash[0] == hash[1]);
}

static void assert_refused(const char *card4, const char *definitions, const char *text)
{
    Scene scene = {0};
    write_box(&scene, card4, definitions);
    VerifyRun run;
    int status = verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
    if (!verify_message(&run.diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
        fail_msg("no message with '%s'", text);
    }
    assert_int_equal(status, -1);
    verify_free(&run);
    scene_free(&scene);
}

static void misuse_is_refused(void **state)
{
    (void)state;
    assert_refused("0.6,0,0,7,0,0,0,0", "*DEFINE_FUNCTION\n         7\nf(a,b,c,d)=a\n", "4 arguments");
    assert_refused("0.6,0,0,7,0,0,0,0", "*DEFINE_CURVE_FUNCTION\n         7\nDX(99999)\n", "node 99999");
    assert_refused("0.6,0,0,7,0,0,0,0", "*DEFINE_CURVE_FUNCTION\n         7\nLC44\n", "LC = 44");
    assert_refused("0.6,0,0,9,0,0,0,0", "*DEFINE_CURVE_FUNCTION\n         7\nTIME\n", "there is no curve");
    assert_refused("0.6,0,0,1,0,0,0,0", "*DEFINE_CURVE_FUNCTION\n         1\nTIME\n", "is a curve and a function");
    assert_refused(
        "0.6,0,1.,0,0,0,0,0",
        "*DEFINE_CURVE_FUNCTION\n         7\nTIME\n*LOAD_NODE_POINT\n         5         1         7       1.0\n",
        "takes only a *DEFINE_CURVE");
}

/* A value that is not finite stops the run. */
static void bad_values_stop_the_run(void **state)
{
    (void)state;
    Scene scene = {0};
    write_box(&scene, "0.6,0,0,7,0,0,0,0", "*DEFINE_CURVE_FUNCTION\n         7\n1.E-3/MAX(0.,0.01-TIME)\n");
    VerifyRun run;
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), 0);
    assert_int_equal(verify_loop(&run), -1);
    assert_non_null(strstr(run.failure.cause, "function 7 of airbag 1: its value is not a finite number"));
    verify_free(&run);
    scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_functions_do_as_constants),
        cmocka_unit_test(varying_functions_do_as_curves),
        cmocka_unit_test(functions_see_the_walls),
        cmocka_unit_test(misuse_is_refused),
        cmocka_unit_test(bad_values_stop_the_run),
        cmocka_unit_test(same_bits_after_a_restart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
