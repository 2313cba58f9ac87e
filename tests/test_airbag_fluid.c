/* *AIRBAG_FLUID_AND_GAS from the deck: level, gas, hydrostatic pressure in a box 0.2 x 0.3 x 1 whose lid moves. */
#include "tests/airbag_box.h"

#include <stdio.h>
#include <string.h>

#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n3\n0,0.2\n0.05,0.7\n*DEFINE_CURVE\n4\n0,1e4\n0.05,3e4\n*DEFINE_CURVE\n5\n0,1\n1,1\n"               \
    "*LOAD_BODY_Z\n5,9.81\n"

/* Runs the box with cards 3 and 4; the state at the end is left in run. */
static void fluid_run(VerifyRun *run, const char *card3, const char *card4, double stroke, double stop)
{
    char text[1200];
    snprintf(text, sizeof text, "*AIRBAG_FLUID_AND_GAS\n1,1\n%s\n%s\n" CURVES, card3, card4);
    box_run(run, text, 0.05, stroke, 1e-3, &(VerifyOptions){.every = 1, .stop_time = stop});
}

/* The fluid's volume is the box below the level; the lid's stroke leaves it and moves the gas alone. */
static void gas_above_fluid(void **state)
{
    (void)state;
    VerifyRun run;
    fluid_run(&run, "0.4,0,0.4,2e4,0,1000", "-3,3,0,0,1.4,2e9", -0.2, 0.025);
    const GasState *g = run.state.gas;
    verify_close("volume of the fluid", g->fluid_volume, 0.4 * 0.06, 1e-12);
    verify_close("level", g->fluid_level, 0.4, 1e-12);
    double room = g->volume - 0.024;
    verify_close("p v^KAPPA", g->pressure * pow(room / 0.036, 1.4), 2e4, 1e-9);
    assert_true(room < 0.028);
    verify_close("mass", g->mass, 24, 1e-12);
    verify_free(&run);
    /* without fluid, KAPPA = 1: SIMPLE_PRESSURE_VOLUME */
    fluid_run(&run, "-1,0,-1,2e4,0,1000", "-3,3,0,0,1,2e9", -0.2, 0);
    for (size_t i = 1; i < run.count; i++)
        assert_true(fabs(run.samples[i].pressure * run.samples[i].volume / (2e4 * 0.06) - 1) < 1e-12);
    verify_free(&run);
}

/* Filling by XWADD to XW, by LCXW; the gas's pressure by P and TEND, by LCP. */
static void filling(void **state)
{
    (void)state;
    VerifyRun run;
    fluid_run(&run, "0.1,5e-4,0.5,1e4,0.02,1000", "-3,3,0,0,1.4,2e9", 0, 0.0101);
    verify_close("level after some steps", run.state.gas->fluid_level, 0.1 + 5e-4 * (double)run.cycles, 1e-9);
    verify_close("gas pressure halfway to TEND", run.state.gas->pressure, 1e4 * run.samples[run.count - 1].time / 0.02,
                 1e-9);
    verify_free(&run);
    fluid_run(&run, "0.1,0.02,0.5,1e4,0.02,1000", "-3,3,0,0,1.4,2e9", 0, 0);
    verify_close("level at the end", run.state.gas->fluid_level, 0.5, 1e-12);
    verify_close("volume of the fluid", run.state.gas->fluid_volume, 0.03, 1e-12);
    verify_close("gas pressure at the end", run.state.gas->pressure, 1e4, 1e-9);
    verify_free(&run);
    fluid_run(&run, "0.1,0.02,0.5,1e4,0.02,1000,3,4", "-3,3,0,0,1.4,2e9", -0.1, 0.0401);
    double t = run.samples[run.count - 1].time;
    verify_close("LCXW", run.state.gas->fluid_level, 0.2 + 10 * t, 1e-9);
    verify_close("LCP", run.state.gas->pressure, 1e4 + 4e5 * t, 1e-9);
    verify_free(&run);
}

/* A full box: the bulk modulus. Gravity along the positive axis turns up and down. */
static void full_and_upside_down(void **state)
{
    (void)state;
    VerifyRun run;
    fluid_run(&run, "2,0,2,0,0,1000", "-3,3,0,0,1.4,2e6", -0.05, 0.025);
    double volume = run.state.gas->volume;
    verify_close("K (V0/V - 1)", run.state.gas->pressure, 2e6 * (0.06 / volume - 1), 1e-9);
    verify_close("level at the lid", run.state.gas->fluid_level, volume / 0.06, 1e-9);
    verify_free(&run);
    fluid_run(&run, "0.7,0,0.7,0,0,1000", "3,3,0,0,1.4,2e6", 0, 0.01);
    verify_close("upside down", run.state.gas->fluid_volume, 0.3 * 0.06, 1e-12);
    verify_free(&run);
}

/* Gravity along +z: the lid, at 0.3 below a level of 0.7, feels rho g 0.3 and what the gas adds; PSCA, RHO and the
 * curve of *LOAD_BODY act. With gravity along -z it feels the gas alone. */
static void hydrostatic(void **state)
{
    (void)state;
    static const struct {
        double psca, density, load, pressure;
        int direction;
        double force;
    } cases[] = {{1, 1000, 9.81, 0, 3, 1000 * 9.81 * 0.3},
                 {2, 500, 9.81, 0, 3, 1000 * 9.81 * 0.3},
                 {1, 1000, 4.9, 0, 3, 1000 * 4.9 * 0.3},
                 {1, 1000, 9.81, 500, 3, 1000 * 9.81 * 0.3 + 500},
                 {1, 1000, 9.81, 500, -3, 500}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        VerifyRun run;
        char text[600];
        snprintf(text, sizeof text,
                 "*AIRBAG_FLUID_AND_GAS\n1,1,0,1,%g\n0.7,0,0.7,%g,0,%g\n%d,3,0,0,1.4,2e9\n*DEFINE_CURVE\n5\n0,1\n1,1\n"
                 "*LOAD_BODY_Z\n5,%g\n",
                 cases[k].psca, cases[k].pressure, cases[k].density, cases[k].direction, cases[k].load);
        box_run(&run, text, 0.01, -1e-9, 1e-3, &(VerifyOptions){.every = 1, .stop_time = 0.003});
        double lid = 0;
        for (int i = 4; i < 8; i++) lid += run.f[3 * i + 2];
        verify_close("force on the lid", lid, 0.06 * cases[k].force, 1e-6);
        verify_free(&run);
    }
}

/* Free corners of a box of null shells feel the pressure at their height, on any number of threads alike. */
static void free_nodes(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        Scene scene = {0};
        SceneText *deck = &scene.deck;
        deck->exact = true;
        scene_add_box(&scene.mesh, 1, 1, 1, 0.2, 0.3, 1);
        scene_begin(deck, "box", 1e-4, 0);
        scene_write_part(deck, 1, 1, 1, "box");
        scene_write_section(deck, 1, 9, 1e-3);
        scene_write_null(deck, 1, 1000);
        scene_write_part_set(deck, 1, 1, (const int[]){1});
        scene_print(deck,
                    "*AIRBAG_FLUID_AND_GAS\n1,1\n0.7,0,0.7,500,0,1000\n-3,3,0,0,1.4,2e9\n*DEFINE_CURVE\n5\n0,1\n1,1\n"
                    "*LOAD_BODY_Z\n5,9.81\n");
        scene_end(deck, &scene.mesh);
        VerifyRun run;
        int node = k ? 4 : 0; /* at the bottom, at the lid above the level */
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = node, .threads = 1 + k, .energy_limit = 1e30});
        assert_int_equal(run.model.free_count, 8);
        double pressure = k ? 500 : 500 + 1000 * 9.81 * 0.7, mass = run.model.mass[0];
        verify_close("across x", run.samples[0].a[0], -pressure * 0.3 * 1 / 4 / mass, 1e-9);
        verify_close("across y", run.samples[0].a[1], -pressure * 0.2 * 1 / 4 / mass, 1e-9);
        hash[k] = state_hash(&run.state);
        verify_free(&run);
    }
    assert_true(hash[0] == hash[1]);
}

static void messages(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"*AIRBAG_FLUID_AND_GAS\n1,1\n0.4,0,0.4,0,0,1000\n0,3,0,0,1.4,2e9\n", "GDIR is 0"},
        {"*AIRBAG_FLUID_AND_GAS\n1,1\n0.4,-0.1,0.6,0,0,1000\n-3,3,0,0,1.4,2e9\n", "away from XW"}};
    for (int i = 0; i < 3; i++) {
        Scene scene = {0};
        verify_begin_box(&scene, (const double[3]){1, 1, 1}, 1, 7, 0.01);
        scene_print(&scene.deck, "%s",
                    i < 2 ? wrong[i][0] : "*AIRBAG_FLUID_AND_GAS\n1,1\n0.4,0,0.4,0,0,1000\n-3,3,0,0,1.4,2e9\n");
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        int status = verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
        assert_int_equal(status, i < 2 ? -1 : 0);
        assert_true(verify_message(&run.diagnostics, i < 2 ? SEVERITY_ERROR : SEVERITY_WARNING,
                                   i < 2 ? wrong[i][1] : "has no weight"));
        verify_free(&run);
        scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(gas_above_fluid),      cmocka_unit_test(filling),
                                       cmocka_unit_test(full_and_upside_down), cmocka_unit_test(hydrostatic),
                                       cmocka_unit_test(free_nodes),           cmocka_unit_test(messages)};
    return cmocka_run_group_tests_name("fluid and gas", tests, NULL, NULL);
}
