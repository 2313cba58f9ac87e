/* speed_error: error against wall time of static reference problems over four meshes, as CSV on standard output.
 *
 * Clamped disc (A1a), mylar balloon (A10) and square cushion (A11) of the reference collection, each with triangles,
 * quads of 2 x 2 points and quads of one point. Wall time is that of the time loop on one thread, best of the repeats.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/verify.h"

typedef struct ElementChoice {
    const char *name;
    ScenePattern disc, square;
    bool one_point;
} ElementChoice;

static const ElementChoice choices[] = {{"triangles", SCENE_DIAGONAL, SCENE_CROSS, false},
                                        {"quads 2x2", SCENE_QUADS, SCENE_QUADS, false},
                                        {"quads one point", SCENE_QUADS, SCENE_QUADS, true}};

typedef struct Problem {
    const char *name;
    void (*make)(Scene *scene, const SceneStatic *setup);
    SceneStatic setup;
    double height, volume; /* references of the part that is modelled */
    bool square;
} Problem;

static Problem find_problem(int index)
{
    const SceneFabric fabric = scene_isotropic(2, index > 0, 800, 2e8, 0.3);
    Problem disc = {"disc A1a",
                    scene_static_disc,
                    {.elform = 9,
                     .fabric = fabric,
                     .thickness = 3.5e-4,
                     .pressure = 1000,
                     .rise = 0.016,
                     .end = 0.08,
                     .damping = 700,
                     .size = 0.3},
                    0.03191967,
                    0.004728292,
                    false};
    if (index == 0) return disc;
    if (index == 1) {
        Problem mylar = {"mylar A10", scene_static_bag, disc.setup, 0, 0, false};
        mylar.setup.fabric = scene_isotropic(2, true, 8000, 2e10, 0.3);
        mylar.setup.pressure = 5000;
        mylar.setup.size = 0.35;
        mylar.setup.rise = 0.015;
        mylar.setup.end = 0.15;
        mylar.setup.damping = 100;
        mylar.height = 0.16030424; /* the balloon of this stiffness: A14's third row */
        mylar.volume = 0.052273726 / 2;
        return mylar;
    }
    Problem square = {"cushion A11", scene_static_square, disc.setup, 0.217, 0.1250 / 8, true};
    square.setup.fabric = scene_isotropic(2, true, 800, 5.88e8, 0.4);
    square.setup.thickness = 6e-4;
    square.setup.pressure = 5000;
    square.setup.size = 0.5 * 0.848528137423857;
    square.setup.rise = 0.02;
    square.setup.end = 0.15;
    square.setup.damping = 200;
    return square;
}

static int run_problem(const Problem *problem, const ElementChoice *choice, int n, int repeats)
{
    double best = INFINITY;
    SceneStatic setup = problem->setup;
    setup.pattern = problem->square ? choice->square : choice->disc;
    setup.n = n;
    for (int i = 0; i < repeats; i++) {
        Scene scene = {0};
        VerifyRun run;
        problem->make(&scene, &setup);
        if (!scene_ok(&scene)) return -1;
        if (verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){.one_point = choice->one_point}) ||
            verify_loop(&run)) {
            diagnostics_print(&run.diagnostics, SEVERITY_ERROR, stderr);
            fprintf(stderr, "%s, %s, n = %d: %s\n", problem->name, choice->name, n, run.failure.cause);
            return -1;
        }
        best = fmin(best, run.times.total - run.times.output);
        if (i + 1 == repeats) {
            double height = 0;
            for (int k = 0; k < scene.mesh.node_count; k++) {
                const double *x = scene.mesh.x + 3 * k;
                if (hypot(x[0], x[1]) < 1e-6 * setup.size) height = run.x[3 * k + 2];
            }
            double volume = verify_volume(&scene.mesh, run.x);
            printf("%s,%s,%d,%d,%d,%ld,%.4f,%.8f,%.3e,%.8f,%.3e\n", problem->name, choice->name, n,
                   scene.mesh.shell_count, scene.mesh.node_count, (long)run.cycles, best, height,
                   fabs(height / problem->height - 1), volume, fabs(volume / problem->volume - 1));
            fflush(stdout);
        }
        verify_free(&run);
        scene_free(&scene);
    }
    return 0;
}

int main(int argc, char **argv)
{
    static const int sizes[3][4] = {{4, 8, 16, 32}, {5, 10, 20, 40}, {4, 8, 16, 32}};
    int meshes = argc > 1 ? atoi(argv[1]) : 4; /* fewer meshes for a quick look */
    printf("problem,element,n,elements,nodes,cycles,wall_seconds,height,height_error,volume,volume_error\n");
    for (int p = 0; p < 3; p++) {
        Problem problem = find_problem(p);
        for (size_t c = 0; c < sizeof choices / sizeof choices[0]; c++)
            for (int m = 0; m < 4 && m < meshes; m++)
                if (run_problem(&problem, &choices[c], sizes[p][m], m < 3 ? 3 : 1)) return 1;
    }
    return 0;
}
