/* Hard cases of membranes: slivers, slack and collapsed elements, long rotation (D3, D6, D12 of the reference
 * collection). */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define PRESSURE offsetof(VerifySample, pressure)

/* ---- slivers ------------------------------------------------------------------------------------------------------
 */

/* A strip of slivers 1 by 0.01, idle or stretched, with a little noise to start from. */
static void make_slivers(Scene *scene, ScenePattern pattern, double stretch, double tssfac)
{
    const double length = 1, width = 0.04, seed = 1e-9;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_rectangle(mesh, 1, pattern, 1, 4, length, width);
    scene_begin(deck, "slivers", 1e3, tssfac);
    scene_write_part(deck, 1, 1, 1, "slivers");
    scene_write_section(deck, 1, 9, 3.5e-4);
    SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    if (stretch > 0) {
        scene_write_ramp(deck, 1, 0.01, 1);
        for (int i = 0; i < mesh->node_count; i++)
            if (mesh->x[3 * i] > length - 1e-9) scene_write_motion(deck, i + 1, 1, 2, 1, stretch * length);
        scene_write_node_set(deck, 1, mesh, scene_select_plane, &(ScenePlane){0, 0, 1e-9});
        scene_write_spc(deck, 1, true, true, true);
        scene_write_curve(deck, 2, 4, (const double[]){0, 1500, 1.9, 1500, 1.91, 0, 1e3, 0});
        scene_write_damping(deck, 2, 0);
    }
    for (int i = 0; i < mesh->node_count; i++) {
        scene_print(deck, "*INITIAL_VELOCITY_NODE\n");
        SCENE_CARD(deck, i + 1, seed * (i % 3 - 1), seed * (i % 5 - 2), stretch > 0 ? seed * (i % 2) : 0);
    }
    scene_end(deck, mesh);
}

static void run_slivers(ScenePattern pattern, double stretch, double tssfac, int64_t cycles)
{
    Scene scene = {0};
    make_slivers(&scene, pattern, stretch, tssfac);
    VerifyRun run;
    verify_scene(&run, &scene,
                 &(VerifyOptions){.every = 100, .stop = cycles, .energy_limit = 1e9}); /* rounding is all there is */
    double from = stretch > 0 ? 2.0 : 0, late = run.samples[run.count - 1].time;
    double scale = 0.5 * 800 * 3.5e-4 * 0.04 * 2e8 / (800 * 0.91); /* m c^2 / 2 of the strip */
    print_message("    %ld cycles, %.2g s of model time, %.1f s\n", (long)run.cycles, late, run.times.total);
    verify_between("D3 kinetic energy over m c^2 / 2",
                   verify_largest(&run, from, offsetof(VerifySample, kinetic)) / scale, 0, stretch > 0 ? 1e-16 : 1e-20);
    assert_true(late > from);
    verify_free(&run);
}

static void slivers(void **state)
{
    (void)state;
    run_slivers(SCENE_DIAGONAL, 0, 0.9, 1000000);
    run_slivers(SCENE_QUADS, 0, 0.9, 1000000);
    run_slivers(SCENE_DIAGONAL, 0.01, 0.99, 200000);
    run_slivers(SCENE_QUADS, 0.01, 0.99, 200000);
}

/* ---- slack and collapsed elements ----------------------------------------------------------------------------------
 */

static void slack_panel(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_CROSS, SCENE_QUADS};
    for (int k = 0; k < 4; k++) {
        const double side = 0.3;
        Scene scene = {0};
        SceneText *deck = &scene.deck;
        deck->exact = true;
        scene_add_rectangle(&scene.mesh, 1, patterns[k % 2], 8, 8, side, side);
        scene_begin(deck, "slack panel", 0.02, 0.9);
        scene_write_part(deck, 1, 1, 1, "panel");
        scene_write_section(deck, 1, 9, 3.5e-4);
        SceneFabric fabric = scene_isotropic(k < 2 ? 2 : 0, true, 800, 2e8, 0.3);
        scene_write_fabric(deck, 1, &fabric);
        scene_write_node_set(deck, 1, &scene.mesh, scene_select_plane, &(ScenePlane){0, 0, 1e-9});
        scene_write_spc(deck, 1, true, true, true);
        scene_write_curve(deck, 1, 4, (const double[]){0, 0, 0.01, -1, 0.015, -1, 0.02, 0});
        for (int i = 0; i < scene.mesh.node_count; i++) {
            const double *x = scene.mesh.x + 3 * i;
            /* all of it, so that every element's area becomes exactly zero, and comes back */
            if (x[0] > 1e-9) scene_write_motion(deck, i + 1, 1, 2, 1, x[0]);
        }
        scene_end(deck, &scene.mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        double least = verify_smallest(&run, 1e-4, offsetof(VerifySample, step));
        verify_between("D6 least step over the first", least / run.samples[1].step, 0.1, 2);
        verify_between("D6 energy at the end [J]", run.samples[run.count - 1].internal, -1e-3, 1e-3);
        assert_true(isfinite(run.samples[run.count - 1].kinetic));
        verify_free(&run);
    }
}

/* ---- long rotation
 * --------------------------------------------------------------------------------------------------------- */

static double spin_momentum(const VerifyRun *run)
{
    double sum = 0;
    for (int i = 0; i < run->model.node_count; i++) {
        const double *x = run->x + 3 * i, *v = run->v + 3 * i;
        sum += run->model.mass[run->model.deck_node[i]] * (x[0] * v[1] - x[1] * v[0]);
    }
    return sum;
}

static void thousand_turns(void **state)
{
    (void)state;
    for (int form = 0; form <= 2; form += 2) {
        const double omega = 200, turn = 2 * 3.14159265358979 / omega;
        Scene scene = {0};
        SceneText *deck = &scene.deck;
        deck->exact = true;
        scene_add_sphere(&scene.mesh, 1, SCENE_DIAGONAL, 3, 0.3);
        scene_begin(deck, "thousand turns", 1000 * turn, 0.9);
        scene_write_part(deck, 1, 1, 1, "bag");
        scene_write_section(deck, 1, 9, 3.5e-4);
        SceneFabric fabric = scene_isotropic(form, false, 800, 2e8, 0.3);
        fabric.damp = 0.3;
        scene_write_fabric(deck, 1, &fabric);
        scene_write_part_set(deck, 1, 1, (const int[]){1});
        scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1, 0});
        SceneGas air = scene_air(101325, 293.15);
        air.inflow_curve = 1;
        air.overpressure = 20000;
        scene_write_wang_nefske(deck, 1, &air);
        scene_print(deck, "*INITIAL_VELOCITY_GENERATION\n");
        SCENE_CARD(deck, 1, 2, omega, 0, 0, 0, 0, 0);
        SCENE_CARD(deck, 0, 0, 0, 0, 0, 1, 0, 0);
        scene_end(deck, &scene.mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        const VerifySample *last = &run.samples[run.count - 1];
        double early = verify_mean(&run, 100 * turn, 110 * turn, PRESSURE);
        double late = verify_mean(&run, 990 * turn, 1000 * turn, PRESSURE);
        double internal = verify_mean(&run, 100 * turn, 110 * turn, offsetof(VerifySample, internal));
        print_message("    %ld cycles, %.1f s, spin momentum %.12g\n", (long)run.cycles, run.times.total,
                      spin_momentum(&run));
        verify_close("D12 pressure, turns 990 and 100", late, early, 1e-6);
        verify_close("D12 membrane energy, turns 990 and 100",
                     verify_mean(&run, 990 * turn, 1000 * turn, offsetof(VerifySample, internal)), internal, 1e-6);
        verify_between("D12 pressure [Pa]", last->pressure, 1.1e5, 1.3e5);
        double centre = 0, speed = 0;
        for (int i = 0; i < run.model.node_count; i++) {
            centre += run.model.mass[run.model.deck_node[i]] * run.v[3 * i];
            speed += run.model.mass[run.model.deck_node[i]] * fabs(run.v[3 * i]);
        }
        verify_near("D12 momentum over |m v|", centre / speed, 0, 1e-10);
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slivers), cmocka_unit_test(slack_panel),
                                       cmocka_unit_test(thousand_turns)};
    return cmocka_run_group_tests_name("hard cases", tests, NULL, NULL);
}
