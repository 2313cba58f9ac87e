/* Hard cases of bags: flat and empty, wrong orientation, suction, violent inflow, overpressure (D1, D2, D7 to D9, D11
 * of the reference collection). */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define PRESSURE offsetof(VerifySample, pressure)

/* ---- bags from flat -------------------------------------------------------------------------------------------- */

/* Two discs sewn at the rim, exactly flat; the gas comes by curve 1. */
static void begin_flat_bag(Scene *scene, ScenePattern pattern, int n, const SceneFabric *fabric, double end)
{
    const double radius = 0.35;
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_disc(&scene->mesh, 1, pattern, n, radius);
    scene_sew_copy(&scene->mesh, 2, scene_select_radius, &radius);
    scene_begin(deck, "bag from flat", end, 0.9);
    scene_write_part(deck, 1, 1, 1, "upper");
    scene_write_part(deck, 2, 1, 1, "lower");
    scene_write_section(deck, 1, 9, 3.5e-4);
    scene_write_fabric(deck, 1, fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
}

static void flat_and_empty(void **state)
{
    (void)state;
    const double guards[] = {0, -1e-8, -1e-6};
    VerifyRun runs[3];
    for (int i = 0; i < 3; i++) {
        Scene scene = {0};
        SceneFabric fabric = scene_isotropic(2, true, 800, 2e8, 0.3);
        begin_flat_bag(&scene, SCENE_DIAGONAL, 10, &fabric, 0.03);
        scene_write_curve(&scene.deck, 1, 3, (const double[]){0, 0, 0.01, 1.5, 1, 1.5});
        SceneGas air = scene_air(101325, 293.15);
        air.inflow_curve = 1;
        air.inflow_temperature = 500;
        air.vini = guards[i];
        scene_write_simple_airbag(&scene.deck, 1, &air);
        scene_end(&scene.deck, &scene.mesh);
        verify_scene(&runs[i], &scene, &(VerifyOptions){.every = 1});
        const VerifySample *first = &runs[i].samples[0], *last = &runs[i].samples[runs[i].count - 1];
        verify_close("D1 first pressure [Pa]", first->pressure, 101325, 1e-9);
        double low = INFINITY, high = 0;
        for (size_t k = 1; k < 100; k++) {
            low = fmin(low, runs[i].samples[k].step);
            high = fmax(high, runs[i].samples[k].step);
        }
        verify_between("D1 least step over the largest, 100 cycles", low / high, 0.5, 1);
        verify_balance(&runs[i], 2e-2);
        assert_true(isfinite(last->pressure) && last->volume > 0.01);
        for (size_t k = 0; k < runs[i].count; k++) assert_true(isfinite(runs[i].samples[k].kinetic));
    }
    double full = runs[0].samples[runs[0].count - 1].volume, worst = 0, window = 5e-4;
    for (size_t k = 0; k < runs[0].count; k++) {
        const VerifySample *s = &runs[0].samples[k];
        if (s->volume < 0.01 * full) continue;
        if (s->time > runs[0].samples[runs[0].count - 1].time - window) break;
        double mean = verify_mean(&runs[0], s->time - window, s->time + window, PRESSURE); /* without its ringing */
        for (int i = 1; i < 3; i++)
            worst = fmax(worst, fabs(verify_mean(&runs[i], s->time - window, s->time + window, PRESSURE) / mean - 1));
    }
    verify_near("D1 pressure and guard volume", worst, 0, 0.01);
    for (int i = 0; i < 3; i++) verify_free(&runs[i]);
}

static void flat_to_static(void **state)
{
    (void)state;
    Scene scene = {0};
    SceneFabric fabric = scene_isotropic(2, true, 800, 2e8, 0.3);
    begin_flat_bag(&scene, SCENE_DIAGONAL, 20, &fabric, 0.35);
    scene_write_curve(&scene.deck, 1, 4, (const double[]){0, 1, 0.0277, 1, 0.0278, 0, 1, 0});
    scene_write_curve(&scene.deck, 2, 4, (const double[]){0, 0, 0.02, 0, 0.04, 150, 1, 150});
    scene_write_damping(&scene.deck, 2, 0);
    SceneGas air = scene_air(101325, 296.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 700;
    scene_write_simple_airbag(&scene.deck, 1, &air);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 20});
    const VerifySample *last = &run.samples[run.count - 1];
    /* the static volume at this pressure: parabola through 0 (A10), 1 and 5 kPa (A14) */
    double p = (last->pressure - 101325) / 1000, v0 = 0.052244226, v1 = 0.05269956, v5 = 0.054180355;
    double expected = v0 * (p - 1) * (p - 5) / 5 - v1 * p * (p - 5) / 4 + v5 * p * (p - 1) / 20;
    verify_between("D2 gauge pressure [kPa]", p, 2, 7);
    verify_close("D2 volume at this pressure [m3]", last->volume, expected, 5e-3);
    verify_balance(&run, 1e-2);
    verify_free(&run);
}

/* ---- orientation
 * ------------------------------------------------------------------------------------------------------ */

static int build_only(Scene *scene, VerifyRun *run)
{
    assert_true(scene_ok(scene));
    int status = verify_build(run, scene->deck.text, scene->deck.length, &(VerifyOptions){0});
    scene_free(scene);
    return status;
}

static void begin_skin(Scene *scene, double inflow)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "skin", 0.01, 0.9);
    scene_write_part(deck, 1, 1, 1, "skin");
    scene_write_section(deck, 1, 9, 3.5e-4);
    SceneFabric fabric = scene_isotropic(2, true, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 1, (const int[]){1});
    scene_write_curve(deck, 1, 2, (const double[]){0, inflow, 1, inflow});
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 300;
    scene_write_simple_airbag(deck, 1, &air);
}

static void orientation(void **state)
{
    (void)state;
    double pressures[3];
    for (int k = 0; k < 3; k++) { /* as it should be, half turned, all turned */
        Scene scene = {0};
        scene_add_sphere(&scene.mesh, 1, SCENE_QUADS, 4, 0.3);
        for (int e = 0; e < scene.mesh.shell_count; e++)
            if (k == 2 || (k == 1 && e % 2 == 0)) scene_reverse(&scene.mesh, e, e + 1);
        begin_skin(&scene, 1);
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        pressures[k] = run.samples[run.count - 1].pressure;
        verify_between("D7 volume at the start [m3]", run.samples[0].volume, 0.1, 0.12);
        verify_free(&run);
    }
    verify_close("D7 pressure, half turned", pressures[1], pressures[0], 1e-9);
    verify_close("D7 pressure, all turned", pressures[2], pressures[0], 1e-9);
}

static void wrong_surfaces(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    begin_skin(&scene, 0); /* a Moebius strip */
    for (int i = 0; i < 12; i++) {
        double a = 0.5235987755982988 * i, c = cos(a), s = sin(a), h = 0.1 * cos(a / 2), z = 0.1 * sin(a / 2);
        scene_add_node(&scene.mesh, (1 + h) * c, (1 + h) * s, z);
        scene_add_node(&scene.mesh, (1 - h) * c, (1 - h) * s, -z);
    }
    for (int i = 0; i < 12; i++) {
        int a = 2 * i, b = 2 * i + 1, c = (2 * i + 2) % 24, d = (2 * i + 3) % 24;
        if (i == 11)
            scene_add_shell(&scene.mesh, 1, a, b, c, d);
        else
            scene_add_shell(&scene.mesh, 1, a, b, d, c);
    }
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(build_only(&scene, &run), -1);
    assert_int_equal(diagnostics_exit_code(&run.diagnostics), BILLOW_EXIT_INPUT);
    diagnostics_print(&run.diagnostics, SEVERITY_ERROR, stdout);
    verify_free(&run);

    begin_skin(&scene, 0); /* a bow-tie quad in a closed sphere */
    scene_add_sphere(&scene.mesh, 1, SCENE_QUADS, 3, 0.3);
    int *bow = scene.mesh.shell[7], second = bow[1];
    bow[1] = bow[2];
    bow[2] = second;
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(build_only(&scene, &run), -1);
    assert_int_equal(diagnostics_exit_code(&run.diagnostics), BILLOW_EXIT_INPUT);
    diagnostics_print(&run.diagnostics, SEVERITY_ERROR, stdout);
    verify_free(&run);
}

/* ---- hard gas
 * ------------------------------------------------------------------------------------------------------------ */

static void suction(void **state)
{
    (void)state;
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    verify_begin_box(&scene, (const double[3]){0.2, 0.3, 1}, 1, 4, 0.1);
    SceneGas air = scene_air(101325, 300);
    air.inflow_curve = 1;
    air.vent_coefficient = 0.7;
    air.vent_area = 1e-2;
    scene_write_simple_airbag(deck, 1, &air);
    scene_write_curve(deck, 2, 2, (const double[]){0, 0, 0.1, 20});
    scene_write_rigid_motion(deck, 2, 3, 2, 2, 1);
    scene_end(deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    const VerifySample *first = &run.samples[0], *last = &run.samples[run.count - 1];
    verify_close("D8 mass kept", last->mass, first->mass, 1e-12);
    verify_close("D8 pressure [Pa]", last->pressure, 101325 * pow(last->volume / first->volume, -1.4), 1e-6);
    verify_between("D8 temperature [K]", last->temperature, 50, 150);
    verify_free(&run);
}

static void violent_inflow(void **state)
{
    (void)state;
    for (int vent = 0; vent < 2; vent++) {
        Scene scene = {0};
        verify_begin_box(&scene, (const double[3]){0.01, 0.01, 0.01}, 1, 7, 0.01);
        scene_write_curve(&scene.deck, 2, 4, (const double[]){0, 0, 1e-9, 5, 0.005, 5, 0.0051, 0});
        SceneGas air = scene_air(101325, 293.15);
        air.inflow_curve = 2;
        air.inflow_temperature = 800;
        air.vent_coefficient = vent;
        air.vent_area = vent * 1e-2;
        scene_write_simple_airbag(&scene.deck, 1, &air);
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        print_message("    %ld cycles\n", (long)run.cycles);
        double hottest = verify_largest(&run, 0, offsetof(VerifySample, temperature));
        verify_between("D9 hottest [K]", hottest, 293, 1.4 * 800 * (1 + 1e-9));
        verify_between("D9 coldest [K]", verify_smallest(&run, 0, offsetof(VerifySample, temperature)), 50, 1120);
        verify_between("D9 least pressure [Pa]", verify_smallest(&run, 0, PRESSURE), 101325 * (1 - 1e-6), 1e12);
        if (vent) verify_close("D9 pressure at the end [Pa]", run.samples[run.count - 1].pressure, 101325, 1e-3);
        verify_free(&run);
    }
}

static void overpressure(void **state)
{
    (void)state;
    Scene scene = {0};
    begin_skin(&scene, 2500);
    scene_add_sphere(&scene.mesh, 1, SCENE_DIAGONAL, 6, 0.3);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    const VerifySample *last = &run.samples[run.count - 1];
    verify_between("D11 largest pressure [Pa]", verify_largest(&run, 0, PRESSURE), 1.0e6, 1e8);
    verify_between("D11 step, last over first", last->element_step / run.samples[0].element_step, 0.01, 0.99);
    verify_balance(&run, 1e-2);
    verify_free(&run);

    begin_skin(&scene, 0); /* the density of the card gives 1055 K */
    scene_add_sphere(&scene.mesh, 1, SCENE_DIAGONAL, 2, 0.3);
    SceneGas hot = scene_air(101325, 1055);
    hot.inflow_curve = 1;
    scene_print(&scene.deck, "$ a second bag on the same skin\n");
    scene_write_simple_airbag(&scene.deck, 1, &hot);
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(build_only(&scene, &run), 0);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "1055"));
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flat_and_empty), cmocka_unit_test(flat_to_static),
                                       cmocka_unit_test(orientation),    cmocka_unit_test(wrong_surfaces),
                                       cmocka_unit_test(suction),        cmocka_unit_test(violent_inflow),
                                       cmocka_unit_test(overpressure)};
    return cmocka_run_group_tests_name("hard bags", tests, NULL, NULL);
}
