/* Hard cases of the gas from the deck, step by step: squeezed to 1 % of the volume, cut off, a vent that would empty
 * the bag in one step, temperatures that jump, 17 gases; and conservation with everything on. */
#include "tests/airbag_box.h"

#include <stdio.h>
#include <string.h>

static const double AMBIENT = 101325;

/* Mass, temperature and pressure in every cycle; the run's gas stays possible. */
typedef struct Watch {
    double coldest, hottest, least_mass, least_pressure, largest_pressure;
    double surroundings; /* what the exits have let out [M] */
    bool finite;
} Watch;

static void watch_gas(void *user, const Model *model, const State *state, const StepView *view)
{
    Watch *watch = user;
    (void)view;
    for (int i = 0; i < model->airbag_count; i++) {
        const GasState *g = &state->gas[i];
        watch->coldest = fmin(watch->coldest, g->temperature);
        watch->hottest = fmax(watch->hottest, g->temperature);
        watch->least_mass = fmin(watch->least_mass, g->mass);
        watch->least_pressure = fmin(watch->least_pressure, g->pressure);
        watch->largest_pressure = fmax(watch->largest_pressure, g->pressure);
        watch->surroundings += (g->mass_flow_out_vent + g->mass_flow_out_porosity) * state->clock->step;
        watch->finite = watch->finite && isfinite(g->energy) && isfinite(g->applied) && isfinite(g->stiffness);
        for (int k = 0; k < model->airbags[i].gas.species_count; k++)
            watch->least_mass = fmin(watch->least_mass, g->species[k]);
    }
}

static Watch new_watch(void)
{
    return (Watch){.coldest = INFINITY, .least_mass = INFINITY, .least_pressure = INFINITY, .finite = true};
}

/* The box whose lid moves by stroke and back; limit: the largest step. */
static void run_watched(VerifyRun *run, Watch *watch, const char *cards, double stroke, double limit)
{
    *watch = new_watch();
    box_run(run, cards, 0.02, stroke, limit, &(VerifyOptions){.every = 1, .probe = watch_gas, .user = watch});
    assert_true(watch->finite);
    assert_true(watch->coldest > 0 && watch->least_mass >= 0 && watch->least_pressure > 0);
}

#define AIR "*AIRBAG_WANG_NEFSKE\n1,1\n717.6549,1004.71686,300,%d,%d,0,0,300\n1,0,%g\n101325,1.2,1\n0\n"
#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n3\n0,1\n1,1\n*DEFINE_CURVE\n4\n0,300\n0.01,300\n0.01000001,900\n0.015,900\n0.0150001,350\n"

/* The lid goes down to 1 % of the height: closed exactly adiabatic, vented between that and the ambient pressure. */
static void squeezed(void **state)
{
    (void)state;
    for (int vent = 0; vent < 2; vent++) {
        char text[600];
        snprintf(text, sizeof text, AIR, 0, 1, vent ? 1e-3 : 0.0);
        VerifyRun run;
        Watch watch;
        run_watched(&run, &watch, text, -0.99, 1e-5);
        double least = verify_smallest(&run, 0, offsetof(VerifySample, volume)) / 0.06;
        verify_between("volume left", least, 0.01, 0.012);
        if (!vent) verify_close("p V^gamma", watch.largest_pressure, AMBIENT * pow(least, -1.4), 1e-9);
        if (!vent) verify_close("home again", run.samples[run.count - 1].pressure, AMBIENT, 1e-9);
        if (vent) verify_between("vented", watch.largest_pressure, 1.1 * AMBIENT, AMBIENT * pow(least, -1.4));
        verify_free(&run);
    }
}

/* The lid goes through the bottom: the run stops and says so, with the last good state. */
static void cut_off(void **state)
{
    (void)state;
    char text[600];
    snprintf(text, sizeof text, AIR "*DEFINE_CURVE\n2\n0,0\n0.01,-1.2\n1,-1.2\n", 0, 1, 1.0);
    Scene scene = {0};
    verify_begin_box(&scene, (const double[3]){0.2, 0.3, 1}, 1, 4, 0.02);
    scene_print(&scene.deck, "%s", text);
    scene_write_rigid_motion(&scene.deck, 2, 3, 2, 2, 1);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    Watch watch = new_watch();
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length,
                                  &(VerifyOptions){.every = 1, .probe = watch_gas, .user = &watch}),
                     0);
    assert_int_equal(verify_loop(&run), -1);
    print_message("    %s\n    %s\n", run.failure.cause, run.failure.advice);
    assert_non_null(strstr(run.failure.cause, "airbag 1: the volume of the gas became negative"));
    assert_true(watch.finite && watch.least_mass > 0 && watch.coldest > 0);
    verify_close("time of the stop", run.state.clock->time, 0.01 / 1.2, 2e-2);
    verify_free(&run);
    scene_free(&scene);
}

/* A vent of 100 m2, and temperatures of the inflow that jump. */
static void vent_and_jump(void **state)
{
    (void)state;
    char text[900];
    VerifyRun run;
    Watch watch;
    snprintf(text, sizeof text, AIR "*DEFINE_CURVE\n5\n0,0\n1,0\n", 0, 5, 100.0);
    char *pover = strstr(text, "101325,1.2,1\n");
    assert_non_null(pover);
    char vented[900];
    snprintf(vented, sizeof vented, "%.*s101325,1.2,1,0,5e5\n%s", (int)(pover - text), text, pover + 13);
    run_watched(&run, &watch, vented, 0, 1e-4);
    verify_near("never below the ambient pressure", fmin(watch.least_pressure / AMBIENT - 1, 0), 0, 1e-12);
    verify_close("relaxed after a millisecond", verify_at(&run, 1e-3, offsetof(VerifySample, pressure)), AMBIENT, 1e-6);
    verify_free(&run);
    snprintf(text, sizeof text, AIR CURVES, 4, 3, 1e-3);
    run_watched(&run, &watch, text, -0.3, 0);
    verify_between("hottest", watch.hottest, 350, 1.4 * 900);
    const GasState *g = &run.state.gas[0];
    double in = 1004.71686 * (300 * 0.01 + 900 * 0.005 + 350 * 0.005); /* 1 kg/s */
    verify_close("enthalpy of the inflow", g->enthalpy_in, in, 1e-5);
    verify_free(&run);
}

/* 17 gases, each with a mass flow and the temperature that jumps. */
static void seventeen_gases(void **state)
{
    (void)state;
    char text[4000];
    int used =
        snprintf(text, sizeof text, "*AIRBAG_HYBRID\n1,1\n300,101325,1.2,8.314462618,1,20\n0.7,0,1e-2\n0,0,17\n");
    for (int i = 0; i < 17; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%d,4,0,%g,%g,%g,0.002\n0\n", i ? 3 : 0,
                         0.004 + 0.003 * i, i < 2 ? 0.5 : 0.0, 21.0 + i);
    snprintf(text + used, sizeof text - (size_t)used, CURVES);
    VerifyRun run;
    Watch watch;
    run_watched(&run, &watch, text, -0.95, 0);
    const GasState *g = &run.state.gas[0];
    double sum = 0;
    for (int k = 0; k < 17; k++) sum += g->species[k];
    verify_close("masses of the gases", sum, g->mass, 1e-12);
    verify_close("mass that came in", g->mass_in, 16 * 0.02, 1e-10);
    verify_close("mass balance", g->initial_mass + g->mass_in - g->mass_out, g->mass, 1e-12);
    verify_close("mass that the surroundings got", watch.surroundings, g->mass_out, 1e-10);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(squeezed), cmocka_unit_test(cut_off),
                                       cmocka_unit_test(vent_and_jump), cmocka_unit_test(seventeen_gases)};
    return cmocka_run_group_tests_name("hard gas", tests, NULL, NULL);
}
