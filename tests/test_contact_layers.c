/* Contact of many layers: stacks at rest, crossing edges, layers that touch or penetrate at the start, order kept. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/contact_scene.h"

static const double thickness = 3e-4, density = 800;

static void begin(Scene *scene, double end)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "contact of layers", end, 0.9);
    scene_write_part(deck, 1, 1, 1, "fabric");
    scene_write_part(deck, 2, 1, 2, "plate");
    scene_write_section(deck, 1, 9, thickness);
    SceneFabric fabric = scene_isotropic(0, false, density, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, 7800, 7, 7);
}

static void write_self(SceneText *deck, double fs, double vdc)
{
    scene_write_contact(
        deck, &(SceneContact){.keyword = "AUTOMATIC_SINGLE_SURFACE", .a_type = 5, .fs = fs, .fd = fs, .vdc = vdc});
}

/* Largest speed of any node over the run. */
static void watch_speed(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)state;
    double *largest = user;
    for (int n = 0; n < model->node_count; n++) {
        const double *v = view->v + 3 * n;
        *largest = fmax(*largest, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    }
}

/* Sheets on a plate, each gap above the last, under gravity. */
static int make_stack(Scene *scene, int layers, double gap, double g, double vdc, double end)
{
    begin(scene, end);
    for (int i = 0; i < layers; i++)
        scene_add_sheet(&scene->mesh, 1, i % 2 ? SCENE_DIAGONAL : SCENE_QUADS, 3, 3, 0.03, 0.03, 0.0007 * (i % 3),
                        0.0005 * (i % 2), gap * (i + 1));
    int plate = scene_add_sheet(&scene->mesh, 2, SCENE_QUADS, 2, 2, 0.05, 0.05, -0.008, -0.009, 0);
    if (g > 0) {
        scene_print(&scene->deck, "*LOAD_BODY_Z\n1,%g\n", g);
        scene_write_curve(&scene->deck, 1, 2, (const double[]){0, 1, 1, 1});
    }
    write_self(&scene->deck, 0.2, vdc);
    scene_end(&scene->deck, &scene->mesh);
    return plate;
}

/* 100,000 with BILLOW_LONG in the environment. */
static int64_t stack_cycles(void)
{
    return getenv("BILLOW_LONG") ? 100000 : 25000;
}

/* Fifty layers at their thickness settle under gravity by far less than a thickness and then rest. */
static void stack_rests(void **state)
{
    (void)state;
    const int layers = 50, nodes = 16;
    Scene scene = {0};
    make_stack(&scene, layers, thickness, 9.81, 20, 2);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1000, .stop = stack_cycles(), .energy_limit = 1e9});
    double v = 0, slip = 0, closest = 1;
    for (int i = 0; i < layers * nodes; i++) {
        int n = run.model.deck_node[i];
        v = fmax(v, fabs(run.v[3 * i + 2]));
        for (int k = 0; k < 2; k++) slip = fmax(slip, fabs(run.x[3 * i + k] - run.model.initial[3 * n + k]));
        double below = i < nodes ? 0 : run.x[3 * (i - nodes) + 2];
        closest = fmin(closest, (run.x[3 * i + 2] - below) / thickness);
    }
    print_message("    %ld cycles, %.1f s\n", (long)run.cycles, run.times.total);
    verify_between("least distance of layers over a thickness", closest, 0.98, 1);
    verify_between("largest way sideways over a thickness", slip / thickness, 0, 1e-3);
    verify_between("speed over that of a fall of one thickness", v / sqrt(2 * 9.81 * thickness), 0, 0.05);
    verify_free(&run);
}

/* Layers nearer than their thickness, touching or in the same place get no speed from it. */
static void initial_penetration(double gap)
{
    Scene scene = {0};
    double largest = 0;
    make_stack(&scene, 8, gap, 0, 0, 1e-3);
    VerifyRun run;
    verify_scene(&run, &scene,
                 &(VerifyOptions){.every = 1, .energy_limit = 1e9, .probe = watch_speed, .user = &largest});
    verify_near("largest speed of layers that penetrate", largest, 0, 1e-9);
    verify_free(&run);
}

static void touching_layers(void **state)
{
    (void)state;
    initial_penetration(0.5 * thickness);
    initial_penetration(1e-3 * thickness);
    initial_penetration(0);
    initial_penetration(0.999999 * thickness);
}

/* Height of the lowest line of the upper strip over the highest line of the lower one where they cross, seen from
 * above. */
static double crossing_height(const VerifyRun *run, int upper)
{
    double least = 1;
    for (int i = 0; i + 1 < upper; i++)
        for (int j = upper; j + 1 < run->model.node_count; j++) {
            const double *p = run->x + 3 * i, *q = run->x + 3 * j;
            const double *start_p = run->model.initial + 3 * run->model.deck_node[i];
            const double *start_q = run->model.initial + 3 * run->model.deck_node[j];
            if (fabs(start_p[2]) > 1e-9 || fabs(start_q[2] - 0.002) > 1e-9) continue;
            double u[2] = {p[3] - p[0], p[4] - p[1]}, w[2] = {q[3] - q[0], q[4] - q[1]},
                   r[2] = {q[0] - p[0], q[1] - p[1]};
            double det = w[0] * u[1] - u[0] * w[1];
            double s = (w[0] * r[1] - w[1] * r[0]) / det, t = (u[0] * r[1] - u[1] * r[0]) / det;
            if (s < 0 || s > 1 || t < 0 || t > 1) continue;
            least = fmin(least, q[2] + t * (q[5] - q[2]) - p[2] - s * (p[5] - p[2]));
        }
    return least;
}

/* Two strips cross at right angles, upright, so that only edges meet: the upper one falls at a speed in thicknesses per
 * step and must be above the lower one at the end. */
static void cross_strips(double pace, ScenePattern pattern)
{
    const double stand[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0}, across[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    const double low[3] = {-0.05, 0.0011, -0.02}, high[3] = {0.0017, -0.05, 0.002};
    Scene scene = {0};
    const double step = 1.4e-5, speed = pace * thickness / step;
    begin(&scene, 0.06 / speed);
    scene_add_rectangle(&scene.mesh, 1, pattern, 10, 2, 0.1, 0.02);
    scene_transform(&scene.mesh, 0, stand, low);
    int upper = scene.mesh.node_count;
    scene_add_rectangle(&scene.mesh, 1, pattern, 9, 2, 0.1, 0.02);
    scene_transform(&scene.mesh, upper, across, high);
    scene_write_speed(&scene.deck, upper, scene.mesh.node_count, 0, 0, -speed);
    scene_write_node_set(&scene.deck, 1, &scene.mesh, scene_select_plane, &(ScenePlane){2, -0.02, 1e-9});
    scene_write_spc(&scene.deck, 1, true, true, true);
    write_self(&scene.deck, 0, 0);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .energy_limit = 1e9});
    double above = crossing_height(&run, upper);
    double paced = speed * run.samples[run.count / 2].step / thickness;
    print_message("    %.2f thicknesses per step, %ld cycles: upper edge %.2f thicknesses above the lower one\n", paced,
                  (long)run.cycles, above / thickness);
    if (paced < 1) assert_true(above > 0);
    assert_true(paced > 1 || run.state.contact->lost == 0);
    /* a strip that is thrown back whips about and may meet the other faster than it fell */
    bool at_the_hit = run.state.contact->fast > 0 && run.state.contact->fast_time < 0.5 * run.state.clock->time;
    assert_true(at_the_hit == (paced > 1));
    verify_free(&run);
}

static void crossing_edges(void **state)
{
    (void)state;
    const double paces[] = {0.02, 0.2, 0.4, 1.5};
    for (int i = 0; i < 4; i++) {
        cross_strips(paces[i], SCENE_QUADS);
        cross_strips(paces[i], SCENE_DIAGONAL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(touching_layers), cmocka_unit_test(crossing_edges),
                                       cmocka_unit_test(stack_rests)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
