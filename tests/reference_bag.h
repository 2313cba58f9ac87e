/* Square cushions whose mesh is shrunken or folded, with the cloth as reference geometry (D5). */
#ifndef BILLOW_TESTS_REFERENCE_BAG_H
#define BILLOW_TESTS_REFERENCE_BAG_H

#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

/* Puts *AIRBAG_REFERENCE_GEOMETRY with the option and the positions x of all nodes into the deck. */
static inline void write_reference(SceneText *deck, const SceneMesh *mesh, const char *option, double birth,
                                   const double *x)
{
    scene_print(deck, "*AIRBAG_REFERENCE_GEOMETRY%s\n", option);
    if (strstr(option, "BIRTH")) SCENE_CARD(deck, birth);
    for (int i = 0; i < mesh->node_count; i++)
        scene_print(deck, "%d,%.17g,%.17g,%.17g\n", i + 1, x[3 * i], x[3 * i + 1], x[3 * i + 2]);
}

static inline bool select_square_edge(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9 * a;
    return x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small;
}

/* Where the nodes of the flat bag stand at the start; t: 0 to 1 along x. */
typedef void Fold(double x[3]);

static inline void shrink(double x[3], double s)
{
    for (int k = 0; k < 3; k++) x[k] = 0.3 + s * (x[k] - 0.3);
}

static inline void shrink_to_tenth(double x[3])
{
    shrink(x, 0.1);
}

static inline void shrink_to_hundredth(double x[3])
{
    shrink(x, 0.01);
}

/* Accordion of four folds along x, a bit narrower and shorter than the cloth. */
static inline void accordion(double x[3])
{
    double fold = 0.15, at = x[0] / fold, left = at - floor(at);
    int number = (int)floor(at);
    double along = number % 2 == 0 ? left : 1 - left;
    x[2] += 0.9 * fold * along;
    x[0] = 0.02 * x[0];
    x[1] = 0.3 + 0.95 * (x[1] - 0.3);
}

typedef struct BagSetup {
    int form, n;
    Fold *fold;         /* NULL: flat */
    const char *option; /* of the reference geometry; NULL: none */
    double birth, end;
    double push;  /* pressure in the first 20 ms; then it rises to 5000 */
    double limit; /* > 0: of the step */
} BagSetup;

/* A square cushion of two panels, run to rest. */
static inline void make_bag(Scene *scene, const BagSetup *setup)
{
    const double side = 0.6;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_rectangle(mesh, 1, SCENE_QUADS, setup->n, setup->n, side, side);
    int upper = mesh->node_count;
    scene_sew_copy(mesh, 2, select_square_edge, &side);
    for (int i = 0; i < mesh->node_count; i++) { /* not quite flat: a volume of zero has no inner side */
        double *x = mesh->x + 3 * i, u = 2 * x[0] / side - 1, v = 2 * x[1] / side - 1;
        x[2] = (i < upper ? 0.005 : -0.005) * (1 - u * u) * (1 - v * v);
    }
    scene_begin(deck, "cushion", setup->end, 0.9);
    scene_write_part(deck, 1, 1, 1, "upper");
    scene_write_part(deck, 2, 1, 1, "lower");
    scene_write_section(deck, 1, 9, 4e-4);
    SceneFabric fabric = scene_isotropic(setup->form, true, 800, 4e8, 0.4);
    fabric.damp = 0.1;
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    scene_write_curve(deck, 1, 6,
                      (const double[]){0, setup->push, 0.02, setup->push, 0.04, 300, 0.1, 400, 0.2, 5000, 1, 5000});
    scene_print(deck, "*AIRBAG_LOAD_CURVE\n1,1\n0,1\n");
    scene_write_damping(deck, 0, 150);
    if (setup->limit > 0)
        scene_print(deck, "*CONTROL_TIMESTEP\n,.9,,,,9\n*DEFINE_CURVE\n9\n0,%g\n1,%g\n", setup->limit, setup->limit);
    if (setup->option) write_reference(deck, mesh, setup->option, setup->birth, mesh->x);
    for (int i = 0; setup->fold && i < mesh->node_count; i++) setup->fold(mesh->x + 3 * i);
    scene_end(deck, mesh);
}

typedef struct BagResult {
    double volume, internal, height, reference_step, least_step, step_at[3], start_step;
} BagResult;

static inline BagResult run_bag(const BagSetup *setup)
{
    Scene scene = {0};
    VerifyRun run;
    BagResult result = {.least_step = 1};
    make_bag(&scene, setup);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    const VerifySample *last = &run.samples[run.count - 1];
    double low = 1, high = -1;
    for (int i = 0; i < run.model.node_count; i++) {
        low = fmin(low, run.x[3 * i + 2]);
        high = fmax(high, run.x[3 * i + 2]);
    }
    result.height = high - low;
    result.volume = last->volume;
    result.internal = last->internal;
    result.start_step = run.samples[0].element_step;
    int mark = 0;
    for (size_t i = 0; i < run.count; i++) {
        const VerifySample *s = &run.samples[i];
        for (; mark < 3 && s->volume >= (const double[]){0.01, 0.1, 0.5}[mark] * last->volume; mark++)
            result.step_at[mark] = s->element_step;
        if (s->time >= setup->birth && s->element_step < result.least_step) result.least_step = s->element_step;
    }
    print_message(
        "    form %d %-12s start %.4g, at 1, 10, 50 %% of V: %.4g %.4g %.4g, least %.4g; V %.8g, h %.6g, W %.8g, "
        "kinetic %.2g, off by %.2g\n",
        setup->form, setup->option ? setup->option : "flat", result.start_step, result.step_at[0], result.step_at[1],
        result.step_at[2], result.least_step, result.volume, result.height, result.internal, last->kinetic,
        run.imbalance / run.energy);
    verify_free(&run);
    return result;
}

#endif
