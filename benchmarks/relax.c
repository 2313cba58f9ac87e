/* relax: static equilibria by Newton's method (CHOLMOD) and by dynamic relaxation, error against wall time, as CSV on
 * standard output. One thread.
 *
 * Square cushion A11 of the reference collection, a whole bag of 20,000 triangles from flat, and the clamped disc A1b.
 * The residual is the force left over, as a share of the loads. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/relax.h"
#include "solver/relax_system.h"
#include "tests/verify.h"

typedef struct Problem {
    const char *name;
    double pressure, height, volume; /* references */
} Problem;

static bool select_rim(const void *half, const double x[3])
{
    double a = *(const double *)half, small = 1e-9 * a;
    return fabs(fabs(x[0]) - a) < small || fabs(fabs(x[1]) - a) < small;
}

static bool select_middle(const void *half, const double x[3])
{
    double a = *(const double *)half, small = 1e-9 * a;
    return fabs(x[0]) < small && fabs(x[1]) < small;
}

/* Two panels of n x n squares in four triangles each, sewn at the rim, which stays in its plane. */
static void make_cushion(Scene *scene, int n)
{
    const double half = 0.5 * 0.848528137423857;
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_rectangle(&scene->mesh, 1, SCENE_CROSS, n, n, 2 * half, 2 * half);
    scene_transform(&scene->mesh, 0, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[]){-half, -half, 0});
    scene_sew_copy(&scene->mesh, 2, select_rim, &half);
    scene_begin(deck, "square cushion", 1, 0.9);
    scene_write_part(deck, 1, 1, 1, "upper panel");
    scene_write_part(deck, 2, 1, 1, "lower panel");
    scene_write_section(deck, 1, 9, 6e-4);
    SceneFabric fabric = scene_isotropic(2, true, 800, 5.88e8, 0.4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_pressure(deck, 1, &scene->mesh, 0, 1, 5000);
    scene_write_node_set(deck, 2, &scene->mesh, select_rim, &half);
    scene_write_spc(deck, 2, false, false, true);
    scene_write_node_set(deck, 3, &scene->mesh, select_middle, &half);
    scene_write_spc(deck, 3, true, true, false);
    scene_end(deck, &scene->mesh);
}

static void make_disc(Scene *scene, int n)
{
    SceneStatic setup = {.pattern = SCENE_DIAGONAL,
                         .elform = 9,
                         .n = n,
                         .fabric = scene_isotropic(2, false, 800, 2e8, 0.3),
                         .thickness = 3.5e-4,
                         .pressure = 20000,
                         .rise = 0,
                         .end = 1,
                         .size = 0.3};
    scene_static_disc(scene, &setup);
}

/* Force left over at x as a share of the loads. */
static double residual_at(const Model *m, const double *x)
{
    double pressure = loads_segment_pressure(&m->segment_loads[0], m->curves, 1.0);
    RelaxSystem s;
    double load = 0, square = 0;
    if (relax_system_create(m, 1.0, &s)) exit(3);
    for (int set = 0; set < m->pressure_set_count; set++)
        for (int k = 0; k < m->pressure_sets[set].count; k++)
            s.pressure[set] += m->pressure_sets[set].push[k] * pressure;
    double *r = memory_alloc((size_t)s.unknown_count + 1, sizeof *r);
    if (!r) exit(3);
    relax_system_assemble(&s, x, false, r, &load);
    for (int i = 0; i < s.unknown_count; i++) square += r[i] * r[i];
    memory_free(r);
    relax_system_free(&s);
    return sqrt(square) / load;
}

static int run(const Problem *problem, void (*make)(Scene *, int), int n, const char *method, RelaxControl relax)
{
    Scene scene = {0};
    VerifyRun run;
    RelaxReport report;
    Failure failure;
    make(&scene, n);
    if (verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0})) return -1;
    Model *m = &run.model;
    m->relax = relax;
    if (relax_run(m, m, 1, NULL, &run.state, &report, &failure)) {
        fprintf(stderr, "%s: %s\n", method, failure.cause);
        return -1;
    }
    double *x = memory_alloc(3 * (size_t)m->node_count, sizeof *x), height = 0;
    for (int i = 0; i < m->node_count; i++) {
        memcpy(x + 3 * i, run.state.x + 3 * (ptrdiff_t)m->deck_node[i], 3 * sizeof *x);
        if (hypot(scene.mesh.x[3 * i], scene.mesh.x[3 * i + 1]) < 1e-9 && x[3 * i + 2] > height) height = x[3 * i + 2];
    }
    double volume = verify_volume(&scene.mesh, x);
    printf("%s,%d,%s,%g,%d,%ld,%.3f,%.2e,%.8f,%.2e,%.8f,%.2e,%.6f\n", problem->name, scene.mesh.shell_count, method,
           relax.tolerance, report.factorisations, report.cycles, report.seconds, residual_at(m, run.state.x), height,
           fabs(height / problem->height - 1), volume, fabs(volume / problem->volume - 1),
           report.energy - problem->pressure * volume);
    fflush(stdout);
    memory_free(x);
    verify_free(&run);
    scene_free(&scene);
    return 0;
}

int main(int argc, char **argv)
{
    const Problem cushion = {"cushion A11", 5000, 0.217, 0.1250}, disc = {"disc A1b", 20000, 0.08802596, 0.01345663};
    int least = argc > 1 ? atoi(argv[1]) : 10; /* smallest DRTOL: 10 to this power with a minus */
    const RelaxControl newton = {.kind = RELAX_STATIC, .time = 1, .tolerance = 1e-8};
    RelaxControl damped = {.kind = RELAX_DYNAMIC, .check_cycles = 250, .factor = 0.995, .step_scale = 0.9};
    damped.automatic_tolerance = 0.04;
    printf("problem,elements,method,tolerance,factorisations,cycles,wall_seconds,residual,height,height_error,volume,"
           "volume_error,potential\n");
    for (int p = 0; p < 2; p++) {
        const Problem *problem = p == 0 ? &cushion : &disc;
        void (*make)(Scene *, int) = p == 0 ? make_cushion : make_disc;
        int n = p == 0 ? 50 : 58;
        if (run(problem, make, n, "Newton", newton)) return 1;
        for (int automatic = 0; automatic < 2; automatic++)
            for (int power = 2; power <= least; power += 2) {
                damped.automatic = automatic;
                damped.tolerance = pow(10, -power);
                if (run(problem, make, n, automatic ? "relaxation IRELAL 1" : "relaxation DRFCTR 0.995", damped))
                    return 1;
            }
    }
    return 0;
}
