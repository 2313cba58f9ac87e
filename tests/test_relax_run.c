/* The phase before the run: hand-over to the time loop, dynamic relaxation, what has no equilibrium. */
#define _GNU_SOURCE
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/memory.h"
#include "solver/relax.h"
#include "tests/verify.h"

typedef struct Relaxed {
    VerifyRun run;
    SceneMesh mesh;
    RelaxReport report;
    double volume;
    double *x; /* deck order */
} Relaxed;

static void free_relaxed(Relaxed *r)
{
    memory_free(r->x);
    verify_free(&r->run);
    scene_mesh_free(&r->mesh);
}

/* Both ways to the equilibrium of the phase's loads (SIDR = 1): the run's own curve has another pressure. */
static void relax_disc(int flag, bool automatic, double tolerance, Relaxed *r)
{
    Scene scene = {.deck.exact = true};
    SceneText *deck = &scene.deck;
    const double radius = 0.3;
    scene_add_disc(&scene.mesh, 1, SCENE_DIAGONAL, 10, radius);
    scene_begin(deck, "disc", 1e-3, 0.9);
    scene_write_part(deck, 1, 1, 1, "disc");
    scene_write_section(deck, 1, 9, 3.5e-4);
    SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_print(deck, "*DEFINE_CURVE\n         1         1\n                 0.0                 1.0\n"
                      "                 1.0                 1.0\n");
    scene_write_curve(deck, 2, 2, (const double[]){0, 0.25, 1, 0.25});
    scene_write_pressure(deck, 1, &scene.mesh, 0, 1, 20000);
    scene_print(deck, "*LOAD_SEGMENT_SET\n         1         2    -20000\n");
    scene_write_node_set(deck, 2, &scene.mesh, scene_select_radius, &radius);
    scene_write_spc(deck, 2, true, true, true);
    scene_print(deck, "*CONTROL_DYNAMIC_RELAXATION\n");
    SCENE_CARD(deck, 100, tolerance, 0.98, 0, 0, automatic, 0.04, flag);
    scene_end(deck, &scene.mesh);
    memset(r, 0, sizeof *r);
    if (verify_build(&r->run, deck->text, deck->length, &(VerifyOptions){0})) {
        diagnostics_print(&r->run.diagnostics, SEVERITY_ERROR, stderr);
        fail();
    }
    Model phase;
    Diagnostics again = {0};
    assert_int_equal(model_build(&r->run.definitions, &(BuildOptions){.relaxation_phase = true}, &phase, &again), 0);
    Failure failure;
    if (relax_run(&phase, &r->run.model, 1, NULL, &r->run.state, &r->report, &failure)) {
        print_error("%s\n", failure.cause);
        fail();
    }
    r->x = memory_alloc(3 * (size_t)phase.node_count, sizeof *r->x);
    for (int i = 0; i < phase.node_count; i++)
        memcpy(r->x + 3 * i, r->run.state.x + 3 * r->run.model.deck_node[i], 3 * sizeof *r->x);
    r->volume = verify_volume(&scene.mesh, r->x);
    r->mesh = scene.mesh;
    scene.mesh = (SceneMesh){0};
    scene_free(&scene);
    diagnostics_free(&again);
    model_free(&phase);
}

/* Newton's method in the kernels of each instruction set. */
static void same_bits(void **state)
{
    (void)state;
    const char *level[] = {"v2", "v3", "v4"};
    Relaxed first, again;
    for (int i = 0; i < 3; i++) {
        if (!kernels_select(level[i])) continue;
        setenv("BILLOW_KERNELS", level[i], 1);
        relax_disc(5, false, 1e-6, i == 0 ? &first : &again);
        if (i == 0) continue;
        assert_memory_equal(first.x, again.x, 3 * (size_t)first.run.model.node_count * sizeof *first.x);
        free_relaxed(&again);
    }
    unsetenv("BILLOW_KERNELS");
    free_relaxed(&first);
}

static void dynamic_relaxation(void **state)
{
    (void)state;
    Relaxed still, damped, automatic;
    relax_disc(5, false, 1e-3, &still);
    relax_disc(1, false, 1e-15, &damped);
    relax_disc(1, true, 1e-15, &automatic);
    print_message("  %d steps; %ld cycles with DRFCTR, %ld with IRELAL\n", still.report.steps, damped.report.cycles,
                  automatic.report.cycles);
    verify_close("volume [m3]", still.volume, 0.01345663, 1e-2);
    verify_close("volume by damped steps [m3]", damped.volume, still.volume, 1e-6);
    verify_close("energy by damped steps [J]", damped.report.energy, still.report.energy, 1e-6);
    verify_close("volume, damping by itself [m3]", automatic.volume, still.volume, 1e-6);
    double largest = 0;
    for (int i = 0; i < 3 * still.run.model.node_count; i++) largest = fmax(largest, fabs(still.x[i] - damped.x[i]));
    verify_near("largest distance of nodes [m]", largest, 0, 1e-6);
    assert_true(automatic.report.cycles < damped.report.cycles);
    free_relaxed(&still);
    free_relaxed(&damped);
    free_relaxed(&automatic);
}

/* The phase ignores a bag of WANG_NEFSKE unless its curve LCMT is flagged; a flag of 1 leaves the run without inflow.
 */
static void flagged_bag(void **state)
{
    (void)state;
    for (int sidr = 0; sidr < 3; sidr++) {
        Scene scene = {.deck.exact = true};
        SceneText *deck = &scene.deck;
        scene_add_sphere(&scene.mesh, 1, SCENE_DIAGONAL, 4, 0.3);
        scene_begin(deck, "ball", 1e-3, 0.9);
        scene_write_part(deck, 1, 1, 1, "skin");
        scene_write_section(deck, 1, 9, 3.5e-4);
        SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, 0.3);
        scene_write_fabric(deck, 1, &fabric);
        scene_write_part_set(deck, 1, 1, (const int[]){1});
        scene_print(deck,
                    "*AIRBAG_WANG_NEFSKE\n1,1\n718,1005,300,0,7,0,0,300\n0\n101325,1.2,1,0,2e4\n0\n"
                    "*DEFINE_CURVE\n7,%d\n0,1\n1,1\n*CONTROL_DYNAMIC_RELAXATION\n100,1e-9,0.98,2e-3,0,0,0,1\n",
                    sidr);
        scene_end(deck, &scene.mesh);
        VerifyRun run;
        Model phase;
        Diagnostics again = {0};
        assert_int_equal(verify_build(&run, deck->text, deck->length, &(VerifyOptions){0}), 0);
        assert_true(verify_message(&run.diagnostics, SEVERITY_NOTE, "has no pressure in dynamic relaxation") ==
                    (sidr == 0));
        assert_true((run.model.airbags[0].gas.mass_flow_curve >= 0) == (sidr != 1));
        assert_int_equal(model_build(&run.definitions, &(BuildOptions){.relaxation_phase = true}, &phase, &again), 0);
        RelaxReport report;
        Failure failure;
        double before = run.model.airbags[0].closure.volume;
        assert_int_equal(relax_run(&phase, &run.model, 1, NULL, &run.state, &report, &failure), 0);
        double grown = run.state.gas[0].volume / before - 1;
        if (sidr == 0)
            verify_near("volume of the ignored bag", grown, 0, 1e-12);
        else
            verify_between("volume of the flagged bag", grown, 1e-3, 1);
        verify_near("gauge pressure at the start", run.state.gas[0].applied, 2e4, 1e-6);
        diagnostics_free(&again);
        model_free(&phase);
        verify_free(&run);
        scene_free(&scene);
    }
}

/* A prestressed bag in free flight: the run starts in balance, with the stored energy in its ledger. */
static void hand_over(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    scene_prestressed_cushion(&scene, 8);
    VerifyOptions options = {.every = 1, .stop = 100};
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &options), 0);
    RelaxReport report;
    Failure failure;
    assert_int_equal(relax_run(&run.model, &run.model, 2, NULL, &run.state, &report, &failure), 0);
    double volume = run.state.gas[0].volume, internal = run.state.energy->internal;
    assert_true(run.state.v[2] == -6.0);
    assert_int_equal(verify_loop(&run), 0);
    verify_close("pressure above the outside [Pa]", run.samples[0].pressure - 101325, 5000, 1e-9);
    verify_close("energy at the start [J]", run.samples[0].internal, internal, 1e-12);
    verify_close("stored energy [J]", internal, report.energy, 1e-12);
    verify_close("volume in flight [m3]", run.samples[run.count - 1].volume, volume, 1e-9);
    verify_close("energy in flight [J]", run.samples[run.count - 1].internal, internal, 1e-8);
    verify_balance(&run, 1e-8);
    verify_free(&run);
    scene_free(&scene);
}

static void write_sphere(Scene *scene, double pressure)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_sphere(&scene->mesh, 1, SCENE_DIAGONAL, 8, 0.3);
    scene_begin(deck, "sphere", 5e-3, 0.9);
    scene_write_part(deck, 1, 1, 1, "sphere");
    scene_write_section(deck, 1, 9, 3.5e-4);
    scene_write_elastic(deck, 1, 800, 2e8, 0.3);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_pressure(deck, 1, &scene->mesh, 0, 1, pressure);
    scene_end(deck, &scene->mesh);
}

/* The ledger of stress work starts from what the law has stored; the sphere is free in space. */
static void hand_over_ledger(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    write_sphere(&scene, 20000);
    VerifyOptions options = {.every = 1, .stop = 100};
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &options), 0);
    run.model.relax = (RelaxControl){.kind = RELAX_STATIC, .tolerance = 1e-8};
    RelaxReport report;
    Failure failure;
    assert_int_equal(relax_run(&run.model, &run.model, 1, NULL, &run.state, &report, &failure), 0);
    assert_int_equal(verify_loop(&run), 0);
    const VerifySample *first = &run.samples[0], *last = &run.samples[run.count - 1];
    double strain = log(1.0314265), stress = 2e8 / 0.7 * strain; /* A7, thickness kept */
    verify_close("stored energy [J]", report.energy,
                 stress * strain * 1.0314265 * 1.0314265 * 3.5e-4 * 4 * 3.14159265358979 * 0.09, 5e-2);
    verify_close("energy at the start [J]", first->internal, report.energy, 1e-12);
    verify_close("energy after 100 cycles [J]", last->internal, first->internal, 1e-8);
    verify_near("kinetic energy after 100 cycles [J]", last->kinetic, 0, 1e-8 * first->internal);
    verify_free(&run);
    scene_free(&scene);
}

/* Gravity on a sheet that nothing holds; a loaded node on null fabric alone. */
static void free_mechanisms(void **state)
{
    (void)state;
    for (int null = 0; null < 2; null++) {
        Scene scene = {.deck.exact = true};
        SceneText *deck = &scene.deck;
        scene_add_rectangle(&scene.mesh, 1, SCENE_QUADS, 2, 2, 1, 1);
        scene_begin(deck, "free sheet", 1e-3, 0.9);
        scene_write_part(deck, 1, 1, 1, "sheet");
        scene_write_section(deck, 1, 9, 1e-3);
        if (null)
            scene_write_null(deck, 1, 800);
        else
            scene_write_elastic(deck, 1, 800, 2e8, 0.3);
        scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
        scene_write_gravity(deck, 1, 9.81);
        scene_end(deck, &scene.mesh);
        VerifyRun run;
        VerifyOptions options = {0};
        assert_int_equal(verify_build(&run, deck->text, deck->length, &options), 0);
        run.model.relax = (RelaxControl){.kind = RELAX_STATIC, .tolerance = 1e-8};
        RelaxReport report;
        Failure failure;
        assert_int_equal(relax_run(&run.model, &run.model, 1, NULL, &run.state, &report, &failure), -1);
        print_message("  %s; %s\n", failure.cause, failure.advice);
        assert_non_null(strstr(failure.cause, null ? "nothing resists the load at node 1, 2"
                                                   : "along z moves the unsupported piece of node 1, 2"));
        verify_free(&run);
        scene_free(&scene);
    }
}

/* Beyond its limit pressure a sphere of Hooke's logarithmic law has no equilibrium. */
static void no_equilibrium(void **state)
{
    (void)state;
    Scene scene = {0};
    write_sphere(&scene, 1e6);
    VerifyRun run;
    VerifyOptions options = {0};
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &options), 0);
    run.model.relax = (RelaxControl){.kind = RELAX_STATIC, .tolerance = 1e-8};
    RelaxReport report;
    Failure failure;
    assert_int_equal(relax_run(&run.model, &run.model, 1, NULL, &run.state, &report, &failure), -1);
    print_message("  %s\n  %s\n", failure.cause, failure.advice);
    assert_non_null(strstr(failure.cause, "no static equilibrium"));
    assert_non_null(strstr(failure.cause, "node "));
    assert_non_null(strstr(failure.advice, "largest pressure"));
    verify_free(&run);
    scene_free(&scene);
}

static bool select_edge(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9 * a;
    return x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small;
}

/* A square cushion with CSE = 1 and PRBA > 0, from nearly flat. */
static void write_cushion(Scene *scene, ScenePattern pattern, int form, double liner, int flag)
{
    const double side = 0.6;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_rectangle(mesh, 1, pattern, 10, 10, side, side);
    const int upper = mesh->node_count;
    scene_sew_copy(mesh, 2, select_edge, &side);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->x + 3 * i, u = 2 * x[0] / side - 1, v = 2 * x[1] / side - 1;
        x[2] = (i < upper ? 0.005 : -0.005) * (1 - u * u) * (1 - v * v);
    }
    scene_begin(deck, "cushion", 1e-3, 0.9);
    scene_write_part(deck, 1, 1, 1, "upper");
    scene_write_part(deck, 2, 1, 1, "lower");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_print(deck, "*MAT_FABRIC\n1,800,4e8,4e8,,.3,.3\n1.5e8,,,1,4e7,.3,%g,.05\n0,,,,,%d\n", liner, form);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    scene_write_curve(deck, 1, 2, (const double[]){0, 5000, 1, 5000});
    scene_print(deck, "*AIRBAG_LOAD_CURVE\n1,1\n0,1\n*CONTROL_DYNAMIC_RELAXATION\n250,1e-9,.99,,,1,,%d\n", flag);
    scene_end(deck, mesh);
}

/* FORM 0; the volume at rest. */
static double relax_cushion(ScenePattern pattern, double liner, int flag, RelaxReport *report)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    SceneMesh *mesh = &scene.mesh;
    write_cushion(&scene, pattern, 0, liner, flag);
    VerifyRun run;
    Failure failure;
    assert_int_equal(verify_build(&run, deck->text, deck->length, &(VerifyOptions){0}), 0);
    int status = relax_run(&run.model, &run.model, 1, NULL, &run.state, report, &failure);
    if (status) fail_msg("%s", failure.cause);
    double *x = memory_alloc(3 * (size_t)run.model.node_count, sizeof *x);
    for (int i = 0; i < run.model.node_count; i++)
        memcpy(x + 3 * i, run.state.x + 3 * (ptrdiff_t)run.model.deck_node[i], 3 * sizeof *x);
    double volume = verify_volume(mesh, x);
    memory_free(x);
    verify_free(&run);
    scene_free(&scene);
    return volume;
}

/* Laws without an energy have a tangent that is not symmetric: its own steps reach their equilibrium (Q20 to Q22). */
static void laws_without_energy(void **state)
{
    (void)state;
    static const struct {
        ScenePattern pattern;
        double liner;
        int steps;
    } cases[] = {{SCENE_QUADS, 0.2, 40}, {SCENE_DIAGONAL, 0.2, 40}, {SCENE_DIAGONAL, 0, 300}};
    for (int i = 0; i < 3; i++) {
        RelaxReport still, damped;
        double volume = relax_cushion(cases[i].pattern, cases[i].liner, 5, &still);
        assert_true(still.residual <= 1e-8 && still.factorisations <= cases[i].steps);
        verify_close("volume by damped steps", relax_cushion(cases[i].pattern, cases[i].liner, 1, &damped), volume,
                     1e-3);
    }
}

/* What the hourglass control of one-point quadrilaterals holds at rest is part of the energy at the start. */
static void hourglass_is_handed_over(void **state)
{
    (void)state;
    for (int form = 0; form <= 2; form += 2) {
        Scene scene = {0};
        VerifyRun run;
        RelaxReport report;
        Failure failure;
        write_cushion(&scene, SCENE_QUADS, form, 0.2, 5);
        VerifyOptions options = {.every = 1, .stop = 150, .one_point = true};
        assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &options), 0);
        if (relax_run(&run.model, &run.model, 1, NULL, &run.state, &report, &failure)) fail_msg("%s", failure.cause);
        assert_true(run.state.energy->hourglass > 1e-3 * run.state.energy->internal);
        assert_int_equal(verify_loop(&run), 0);
        verify_balance(&run, 1e-8);
        verify_near("kinetic energy", run.samples[run.count - 1].kinetic, 0, 1e-12);
        verify_free(&run);
        scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits),
        cmocka_unit_test(dynamic_relaxation),
        cmocka_unit_test(flagged_bag),
        cmocka_unit_test(hand_over),
        cmocka_unit_test(hand_over_ledger),
        cmocka_unit_test(free_mechanisms),
        cmocka_unit_test(no_equilibrium),
        cmocka_unit_test(laws_without_energy),
        cmocka_unit_test(hourglass_is_handed_over),
    };
    return cmocka_run_group_tests_name("phase before the run", tests, NULL, NULL);
}
