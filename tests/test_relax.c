/* The static equilibrium by Newton's method: the static references A1, A6(d), A10, A11, A14. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/relax.h"
#include "tests/verify.h"

typedef struct Relaxed {
    VerifyRun run;
    SceneMesh mesh;
    RelaxReport report;
    double volume, height, rim, energy, potential, resultant;
    double *x; /* deck order */
} Relaxed;

/* Threads of this process: CHOLMOD's own would wake up for every supernode, and cost a third of the time. */
static int count_threads(void)
{
    int count = 0;
    char line[128];
    FILE *status = fopen("/proc/self/status", "r");
    assert_non_null(status);
    while (fgets(line, sizeof line, status)) sscanf(line, "Threads: %d", &count);
    fclose(status);
    return count;
}

/* Builds and relaxes at a time far beyond the ramp of the pressure. */
static void relax_scene(Relaxed *r, Scene *scene, bool one_point, double pressure)
{
    assert_true(scene_ok(scene));
    VerifyOptions options = {.one_point = one_point};
    memset(r, 0, sizeof *r);
    if (verify_build(&r->run, scene->deck.text, scene->deck.length, &options)) {
        diagnostics_print(&r->run.diagnostics, SEVERITY_ERROR, stderr);
        fail();
    }
    Model *m = &r->run.model;
    if (m->relax.kind == RELAX_NONE) m->relax = (RelaxControl){.kind = RELAX_STATIC, .time = 1e3, .tolerance = 1e-8};
    Failure failure;
    if (relax_run(m, m, 1, NULL, &r->run.state, &r->report, &failure)) {
        print_error("%s\n%s\n", failure.cause, failure.advice);
        fail();
    }
    r->mesh = scene->mesh;
    scene->mesh = (SceneMesh){0};
    scene_free(scene);
    r->x = memory_alloc(3 * (size_t)m->node_count, sizeof *r->x);
    for (int i = 0; i < m->node_count; i++)
        memcpy(r->x + 3 * i, r->run.state.x + 3 * m->deck_node[i], 3 * sizeof *r->x);
    r->volume = verify_volume(&r->mesh, r->x);
    for (int i = 0; i < m->node_count; i++)
        if (r->x[3 * i + 2] > r->height) r->height = r->x[3 * i + 2];
    r->energy = r->report.energy;
    r->potential = r->energy - pressure * r->volume;
    print_message("    %d steps, %d factorisations, residual %.1e, %.2f s\n", r->report.steps, r->report.factorisations,
                  r->report.residual, r->report.seconds);
    assert_true(r->report.residual <= 1e-8);
    assert_int_equal(count_threads(), 1);
}

/* Mean principal stress of the elements at the node nearest to the axis. */
static double middle_stress(const Relaxed *r)
{
    int middle = 0, count = 0;
    double sum = 0;
    for (int i = 0; i < r->mesh.node_count; i++)
        if (hypot(r->mesh.x[3 * i], r->mesh.x[3 * i + 1]) < hypot(r->mesh.x[3 * middle], r->mesh.x[3 * middle + 1]))
            middle = i;
    for (int e = 0; e < r->mesh.shell_count; e++)
        for (int a = 0; a < 3; a++) {
            if (r->mesh.shell[e][a] != middle) continue;
            ElementResult result;
            double principal[2];
            membrane_result(&r->run.model, &r->run.state, r->run.state.x, e, &result);
            verify_principal(result.stress, principal);
            sum += 0.5 * (principal[0] + principal[1]);
            count++;
        }
    return count > 0 ? sum / count : 0;
}

static void free_relaxed(Relaxed *r)
{
    memory_free(r->x);
    verify_free(&r->run);
    scene_mesh_free(&r->mesh);
}

static SceneStatic make_setup(int form, bool cse, double e, double nu, double thickness, double pressure, double size,
                              ScenePattern pattern, int n)
{
    return (SceneStatic){.pattern = pattern,
                         .elform = 9,
                         .n = n,
                         .fabric = scene_isotropic(form, cse, 800, e, nu),
                         .thickness = thickness,
                         .pressure = pressure,
                         .rise = 0,
                         .end = 0.1,
                         .damping = 0,
                         .size = size};
}

static void clamped_disc(void **state)
{
    (void)state;
    const struct {
        const char *name;
        int form; /* 3: MAT_ELASTIC */
        ScenePattern pattern;
        double pressure, height, resultant, volume;
        bool one_point;
    } cases[] = {
        {"A1a, triangles, Green", 2, SCENE_DIAGONAL, 1000, 0.03191967, 804.8977, 0.004728292, false},
        {"A1b, triangles, Green", 2, SCENE_DIAGONAL, 20000, 0.08802596, 6346.754, 0.01345663, false},
        {"A1b, triangles, logarithmic", 3, SCENE_DIAGONAL, 20000, 0.090527, 6118.515, 0.01380518, false},
        {"A1b, triangles, engineering", 0, SCENE_DIAGONAL, 20000, 0.09091635, 6125.844, 0.01389122, false},
        {"A1b, quads, Green", 2, SCENE_QUADS, 20000, 0.08802596, 6346.754, 0.01345663, false},
        {"A1b, quads, logarithmic", 3, SCENE_QUADS, 20000, 0.090527, 6118.515, 0.01380518, false},
        {"A1b, quads, engineering", 0, SCENE_QUADS, 20000, 0.09091635, 6125.844, 0.01389122, false},
        {"A1b, one-point quads, Green", 2, SCENE_QUADS, 20000, 0.08802596, 6346.754, 0.01345663, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        SceneStatic setup =
            make_setup(cases[i].form % 3, false, 2e8, 0.3, 3.5e-4, cases[i].pressure, 0.3, cases[i].pattern, 26);
        if (cases[i].form == 3) setup.fabric.elastic = true, setup.fabric.prba = 0.3;
        Scene scene = {0};
        Relaxed r;
        print_message("  %s\n", cases[i].name);
        scene_static_disc(&scene, &setup);
        relax_scene(&r, &scene, cases[i].one_point, setup.pressure);
        verify_close("height [m]", r.height, cases[i].height, 5e-4);
        verify_close("volume [m3]", r.volume, cases[i].volume, 2e-3);
        verify_close("resultant [N/m]", middle_stress(&r) * 3.5e-4, cases[i].resultant, 5e-3);
        free_relaxed(&r);
    }
}

static double rim_radius(const Relaxed *r, double size)
{
    double sum = 0;
    int count = 0;
    for (int i = 0; i < r->mesh.node_count; i++) {
        if (hypot(r->mesh.x[3 * i], r->mesh.x[3 * i + 1]) < size * (1 - 1e-9)) continue;
        sum += hypot(r->x[3 * i], r->x[3 * i + 1]);
        count++;
    }
    return sum / count;
}

static void circular_bag(void **state)
{
    (void)state;
    const struct {
        const char *name;
        double e, pressure, volume, radius, height, stress;
    } cases[] = {{"A14, 1 kPa", 2e8, 1000, 0.05269956, 0.26766155, 0.16243197, 1178137.7},
                 {"A14, 5 kPa", 2e8, 5000, 0.054180355, 0.26983384, 0.16714135, 4338565.7},
                 {"A14, 20 GPa; A10", 2e10, 5000, 0.052273726, 0.26701227, 0.16030424, 10667686}};
    for (int i = 0; i < 3; i++) {
        SceneStatic setup =
            make_setup(2, true, cases[i].e, 0.3, 3.5e-4, cases[i].pressure, 0.35, SCENE_QUADS, i < 2 ? 20 : 22);
        Scene scene = {0};
        Relaxed r;
        print_message("  %s\n", cases[i].name);
        scene_static_bag(&scene, &setup);
        relax_scene(&r, &scene, false, setup.pressure);
        verify_close("volume [m3]", 2 * r.volume, cases[i].volume, 3e-3);
        verify_close("half thickness [m]", r.height, cases[i].height, i < 2 ? 3e-3 : 1e-2);
        verify_close("radius of the equator [m]", rim_radius(&r, 0.35), cases[i].radius, i < 2 ? 2e-3 : 1e-2);
        if (i < 2) verify_close("stress in the middle [Pa]", middle_stress(&r), cases[i].stress, 2e-2);
        if (i == 2) verify_close("A10 volume / a^3", 2 * r.volume / 0.042875, 1.2185242161185697, 3e-3);
        free_relaxed(&r);
    }
}

/* Potentials of the reference table's meshes: reached or undercut (crimped states are not unique). */
static void square_cushion(void **state)
{
    (void)state;
    const struct {
        const char *name;
        ScenePattern pattern;
        int n;
        double potential;
    } cases[] = {{"A11, cross, 4", SCENE_CROSS, 4, -76.2252},
                 {"A11, cross, 8", SCENE_CROSS, 8, -77.3669},
                 {"A11, cross, 16", SCENE_CROSS, 16, -77.6555},
                 {"A11, diagonal, 16", SCENE_DIAGONAL, 16, -77.5964},
                 {"A11, quads, 16", SCENE_QUADS, 16, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        SceneStatic setup =
            make_setup(2, true, 5.88e8, 0.4, 6e-4, 5000, 0.424264068711929, cases[i].pattern, cases[i].n);
        Scene scene = {0};
        Relaxed r;
        print_message("  %s\n", cases[i].name);
        scene_static_square(&scene, &setup);
        relax_scene(&r, &scene, false, setup.pressure);
        if (cases[i].potential < 0) {
            print_message("    potential %.4f J, of the table %.4f J\n", r.potential, cases[i].potential);
            assert_true(r.potential < cases[i].potential + 1e-4 * fabs(cases[i].potential));
        }
        if (cases[i].n >= 16) {
            verify_close("height of the middle [m]", r.height, 0.217, 5e-3);
            verify_close("volume [m3]", 8 * r.volume, 0.1250, 3e-3);
            verify_between("stress in the middle [Pa]", middle_stress(&r), 3.8e6 * 0.97, 3.9e6 * 1.03);
        }
        free_relaxed(&r);
    }
}

/* FORM 0 without Poisson's ratio has a stored energy with the compression cut off. */
static void engineering_cushion(void **state)
{
    (void)state;
    SceneStatic setup = make_setup(0, true, 5.88e8, 0.0, 6e-4, 5000, 0.424264068711929, SCENE_QUADS, 16);
    Scene scene = {0};
    Relaxed r;
    scene_static_square(&scene, &setup);
    relax_scene(&r, &scene, false, setup.pressure);
    verify_close("height of the middle [m]", r.height, 0.217, 1e-2);
    free_relaxed(&r);
}

/* Annulus with a turned hub: displacements of the hub's nodes by curves that are constant. */
static void turned_hub(void **state)
{
    (void)state;
    const struct {
        double inner, outer, nu, moment;
    } cases[] = {{0.1, 0.2, 0, 0.03678045},
                 {0.1, 0.25, 0, 0.03051706},
                 {0.1, 0.25, 0.3, 0.03053512},
                 {0.2, 0.3, 0.3, 0.2150735}};
    const double angle = 1e-3, e = 2e8, thickness = 3.5e-4;
    for (int i = 0; i < 4; i++) {
        Scene scene = {.deck.exact = true};
        SceneText *deck = &scene.deck;
        scene_add_ring(&scene.mesh, 1, SCENE_QUADS, 24, 120, cases[i].inner, cases[i].outer);
        scene_begin(deck, "annulus with a turned hub", 1e-3, 0.9);
        scene_write_part(deck, 1, 1, 1, "annulus");
        scene_write_section(deck, 1, 9, thickness);
        SceneFabric fabric = scene_isotropic(2, true, 800, e, cases[i].nu);
        scene_write_fabric(deck, 1, &fabric);
        scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
        scene_write_node_set(deck, 1, &scene.mesh, scene_select_radius, &cases[i].outer);
        scene_write_spc(deck, 1, true, true, true);
        scene_write_node_set(deck, 2, &scene.mesh, scene_select_all, NULL);
        scene_write_spc(deck, 2, false, false, true);
        for (int n = 0; n < scene.mesh.node_count; n++) {
            const double *x = scene.mesh.x + 3 * n;
            if (!scene_select_radius(&cases[i].inner, x)) continue;
            double c = cos(angle) - 1, s = sin(angle);
            scene_write_motion(deck, n + 1, 1, 2, 1, c * x[0] - s * x[1]);
            scene_write_motion(deck, n + 1, 2, 2, 1, s * x[0] + c * x[1]);
        }
        scene_end(deck, &scene.mesh);
        Relaxed r;
        print_message("  A6(d), %g to %g m, nu %g\n", cases[i].inner, cases[i].outer, cases[i].nu);
        VerifyOptions options = {0};
        memset(&r, 0, sizeof r);
        assert_int_equal(verify_build(&r.run, deck->text, deck->length, &options), 0);
        r.run.model.relax = (RelaxControl){.kind = RELAX_STATIC, .tolerance = 1e-8};
        Failure failure;
        if (relax_run(&r.run.model, &r.run.model, 1, NULL, &r.run.state, &r.report, &failure)) {
            print_error("%s\n", failure.cause);
            fail();
        }
        print_message("    %d steps, residual %.1e of %.3g N\n", r.report.steps, r.report.residual, r.report.load);
        assert_true(r.report.residual <= 1e-8);
        /* the energy grows with the square of the angle */
        verify_close("moment / (E t angle) [m2]", 2 * r.report.energy / (e * thickness * angle * angle),
                     cases[i].moment, 1e-2);
        scene_free(&scene);
        verify_free(&r.run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clamped_disc),   cmocka_unit_test(circular_bag),        cmocka_unit_test(turned_hub),
        cmocka_unit_test(square_cushion), cmocka_unit_test(engineering_cushion),
    };
    return cmocka_run_group_tests_name("static equilibrium", tests, NULL, NULL);
}
