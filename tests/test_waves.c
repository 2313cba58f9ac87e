/* Waves, frequencies and stable steps against closed forms: breathing sphere (A7), strip wave (A8), critical step of
 * single elements (A9) of the reference collection. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "solver/memory.h"

/* ---- breathing sphere ------------------------------------------------------------------------------------------ */

enum { HISTORY_LIMIT = 20000 };

typedef struct RadiusHistory {
    int count;
    double time[HISTORY_LIMIT], radius[HISTORY_LIMIT];
} RadiusHistory;

static void record_radius(void *user, const Model *model, const State *state, const StepView *view)
{
    RadiusHistory *history = user;
    if (history->count == HISTORY_LIMIT) return;
    double sum = 0;
    for (int i = 0; i < model->node_count; i++) {
        const double *x = view->x + 3 * i;
        sum += sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    }
    history->time[history->count] = state->clock->time;
    history->radius[history->count++] = sum / model->node_count;
}

/* Mean frequency from the first to the last upward crossing of the middle between the extremes, from a time on. */
static double history_frequency(const RadiusHistory *history, double from)
{
    double low = INFINITY, high = -INFINITY, first = NAN, last = NAN;
    int periods = -1;
    for (int i = 0; i < history->count; i++) {
        if (history->time[i] < from) continue;
        low = fmin(low, history->radius[i]);
        high = fmax(high, history->radius[i]);
    }
    double middle = 0.5 * (low + high);
    for (int i = 1; i < history->count; i++) {
        double a = history->radius[i - 1] - middle, b = history->radius[i] - middle;
        if (history->time[i - 1] < from || a >= 0 || b < 0) continue;
        last = history->time[i - 1] + (history->time[i] - history->time[i - 1]) * a / (a - b);
        if (periods < 0) first = last;
        periods++;
    }
    return periods / (last - first);
}

static const double sphere_radius = 0.3;

static void begin_sphere(Scene *scene, ScenePattern pattern, int n, double end)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_sphere(&scene->mesh, 1, pattern, n, sphere_radius);
    scene_begin(deck, "breathing sphere", end, 0.8);
    scene_write_part(deck, 1, 1, 1, "sphere");
    scene_write_section(deck, 1, 9, 3.5e-4);
    SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 1, (const int[]){1});
}

static void write_radial_velocity(Scene *scene, double velocity)
{
    for (int i = 0; i < scene->mesh.node_count; i++) {
        const double *x = scene->mesh.x + 3 * i;
        scene_print(&scene->deck, "*INITIAL_VELOCITY_NODE\n");
        SCENE_CARD(&scene->deck, i + 1, velocity * x[0] / sphere_radius, velocity * x[1] / sphere_radius,
                   velocity * x[2] / sphere_radius);
    }
}

static RadiusHistory *run_sphere(Scene *scene, double *peak, double *peak_time)
{
    RadiusHistory *history = memory_alloc(1, sizeof *history);
    assert_non_null(history);
    scene_end(&scene->deck, &scene->mesh);
    VerifyRun run;
    verify_scene(&run, scene, &(VerifyOptions){.every = 1, .probe = record_radius, .user = history});
    verify_free(&run);
    int best = 1;
    for (int i = 1; i + 1 < history->count; i++)
        if (history->radius[i] > history->radius[best]) best = i;
    double a = history->radius[best - 1], b = history->radius[best], c = history->radius[best + 1];
    double shift = 0.5 * (a - c) / (a - 2 * b + c), dt = history->time[best + 1] - history->time[best];
    if (peak) *peak = b - 0.25 * (a - c) * shift;
    if (peak_time) *peak_time = history->time[best] + shift * dt;
    return history;
}

static void breathing_in_vacuum(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_DIAGONAL, SCENE_QUADS};
    for (int i = 0; i < 2; i++) {
        Scene scene = {0};
        begin_sphere(&scene, patterns[i], i == 0 ? 16 : 28, 0.0075);
        write_radial_velocity(&scene, 0.01);
        RadiusHistory *history = run_sphere(&scene, NULL, NULL);
        verify_close("A7 frequency [Hz]", history_frequency(history, 0), 448.3683, 3e-3);
        memory_free(history);
    }
}

static void breathing_with_gas(void **state)
{
    (void)state;
    Scene scene = {0};
    begin_sphere(&scene, SCENE_DIAGONAL, 16, 0.0075);
    SceneGas air = scene_air(101325, 293.15);
    scene_write_simple_airbag(&scene.deck, 1, &air);
    write_radial_velocity(&scene, 0.01);
    RadiusHistory *history = run_sphere(&scene, NULL, NULL);
    verify_close("A7 frequency with gas [Hz]", history_frequency(history, 0), 573.9022, 3e-3);
    memory_free(history);
}

static void breathing_under_pressure(void **state)
{
    (void)state;
    const double pressure[] = {1000, 20000}, frequency[] = {448.7049, 455.2458};
    for (int i = 0; i < 2; i++) {
        Scene scene = {0};
        begin_sphere(&scene, SCENE_DIAGONAL, 16, 0.0185);
        scene_write_curve(&scene.deck, 1, 5,
                          (const double[]){0, 0, 0.002, pressure[i], 0.01, pressure[i], 0.0102, 1.01 * pressure[i], 1,
                                           1.01 * pressure[i]});
        scene_write_pressure(&scene.deck, 2, &scene.mesh, 0, 1, 1);
        scene_write_curve(&scene.deck, 2, 4, (const double[]){0, 4000, 0.0095, 4000, 0.01, 0, 1, 0});
        scene_write_damping(&scene.deck, 2, 0);
        RadiusHistory *history = run_sphere(&scene, NULL, NULL);
        verify_close("A7 frequency under pressure [Hz]", history_frequency(history, 0.0105), frequency[i], 3e-3);
        memory_free(history);
    }
}

static void pressure_step(void **state)
{
    (void)state;
    Scene scene = {0};
    begin_sphere(&scene, SCENE_DIAGONAL, 16, 0.0015);
    scene_write_ramp(&scene.deck, 1, 0, 1);
    scene_write_pressure(&scene.deck, 2, &scene.mesh, 0, 1, 20000);
    double peak, time;
    RadiusHistory *history = run_sphere(&scene, &peak, &time);
    verify_close("A7 first peak [m]", peak - sphere_radius, 0.018005093, 3e-3);
    verify_close("A7 time of the first peak [s]", time, 0.0010990193, 3e-3);
    memory_free(history);
}

/* ---- strip wave -------------------------------------------------------------------------------------------------- */

enum { STRIP_VALUES = 3 * 1000 };

typedef struct StripEnergy {
    double kinetic, internal;
    double x[STRIP_VALUES], f[STRIP_VALUES];
} StripEnergy;

/* The energies that central differences keep to rounding for any force law: m v_{n-1/2} . v_{n+1/2} / 2, and the work
 * of the stress forces by the trapezoidal rule. Those of the ledger, full-step velocities and stress times strain,
 * differ by m (a dt)^2 / 8 at the front and by a share of the strain's size. */
static void record_strip_energy(void *user, const Model *model, const State *state, const StepView *view)
{
    StripEnergy *energy = user;
    double half = 0.5 * state->clock->step;
    energy->kinetic = 0;
    for (int i = 0; i < 3 * model->node_count && i < STRIP_VALUES; i++) {
        double v = view->v[i], change = half * view->a[i];
        energy->kinetic += 0.5 * model->mass[i / 3] * (v + change) * (v - change);
        if (state->clock->cycle > 0)
            energy->internal -= 0.5 * (energy->f[i] + view->f[i]) * (view->x[i] - energy->x[i]);
        energy->x[i] = view->x[i];
        energy->f[i] = view->f[i];
    }
}

/* At 1/100 of the collection's end velocity, so that finite strain has no part in it. */
static void check_strip_wave(ScenePattern pattern, double nu, bool sides, double speed, double courant, double stress)
{
    const int cells = 150;
    const double length = 1.5, h = length / cells, time = 1 / speed, velocity = 1e-2;
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_add_rectangle(&scene.mesh, 1, pattern, cells, 1, length, h);
    scene_begin(deck, "wave in a strip", 2 * time, 0);
    scene_print(deck, "*CONTROL_TIMESTEP\n"); /* a constant step, a little below the critical one: LCTM */
    SCENE_CARD(deck, 0, 1, 0, 0, 0, 2);
    scene_write_curve(deck, 2, 2, (const double[]){0, courant * h / speed, 1, courant * h / speed});
    scene_write_part(deck, 1, 1, 1, "strip");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_write_elastic(deck, 1, 800, 2e8, nu);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_node_set(deck, 1, &scene.mesh, scene_select_all, NULL);
    scene_write_spc(deck, 1, false, sides, true);
    ScenePlane end = {0, 0, 1e-9};
    for (int i = 0; i < scene.mesh.node_count; i++)
        if (scene_select_plane(&end, scene.mesh.x + 3 * i)) scene_write_motion(deck, i + 1, 1, 0, 1, -velocity);
    scene_end(deck, &scene.mesh);
    SceneMesh mesh = scene.mesh;
    scene.mesh = (SceneMesh){0};
    VerifyRun run;
    StripEnergy energy = {0};
    verify_scene(&run, &scene,
                 &(VerifyOptions){.every = 1, .stop_time = time, .probe = record_strip_energy, .user = &energy});

    double front = 0, plateau = 0, count = 0;
    for (int i = 0; i < mesh.node_count; i++)
        if (run.v[3 * i] < -0.5 * velocity) front = fmax(front, mesh.x[3 * i]);
    for (int e = 0; e < mesh.shell_count; e++) {
        double x = mesh.x[3 * mesh.shell[e][0]];
        if (x < 0.1 || x > 0.85) continue;
        plateau += verify_element(&run, e).stress[0];
        count += 1;
    }
    const VerifySample *last = &run.samples[run.count - 1];
    print_message("    step %.4g, cell / speed %.4g; energy kinetic %.6g internal %.6g external %.6g\n", last->step,
                  h / speed, last->kinetic, last->internal, last->external);
    verify_near("A8 front [m]", front + 0.5 * h, speed * last->time, h);
    verify_close("A8 plateau [Pa]", plateau / count, stress * velocity, 5e-3);
    verify_close("A8 energy balance", energy.kinetic + energy.internal, last->external, 1e-10);
    verify_close("A8 internal energy of the ledger", last->internal, energy.internal, 1e-4);
    verify_free(&run);
    scene_mesh_free(&mesh);
}

static void strip_wave(void **state)
{
    (void)state;
    check_strip_wave(SCENE_QUADS, 0, false, 500, 0.9999, 400000);
    check_strip_wave(SCENE_QUADS, 0.3, true, 524.1424, 0.87, 419313.9);
    check_strip_wave(SCENE_CROSS, 0, false, 500, 0.47, 400000);
}

/* ---- critical step -------------------------------------------------------------------------------------------------
 */

typedef struct CriticalCase {
    const char *name;
    double nu;
    int corners;
    double x[8];
    bool one_point;
    double height, step; /* both of the table: step in units of height / c_p */
} CriticalCase;

static void make_critical(Scene *scene, const CriticalCase *c)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    for (int i = 0; i < c->corners; i++) scene_add_node(&scene->mesh, c->x[2 * i], c->x[2 * i + 1], 0);
    scene_add_shell(&scene->mesh, 1, 0, 1, 2, c->corners - 1);
    scene_begin(deck, "critical step", 1e-5, 0.9);
    scene_write_part(deck, 1, 1, 1, "element");
    scene_write_section(deck, 1, 9, 1e-3);
    SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, c->nu);
    scene_write_fabric(deck, 1, &fabric);
    scene_end(deck, &scene->mesh);
}

static void critical_step(void **state)
{
    (void)state;
    const double s = 0.8660254037844386;
    const CriticalCase cases[] = {
        {"right isosceles, nu 0", 0, 3, {0, 0, 1, 0, 0, 1}, false, 1, 0.6666667},
        {"equilateral, nu 0", 0, 3, {0, 0, 1, 0, 0.5, s}, false, 1, 0.8164966},
        {"cross diagonal, nu 0", 0, 3, {0, 0, 1, 0, 0.5, 0.5}, false, 1, 0.4714045},
        {"square 2 x 2, nu 0", 0, 4, {0, 0, 1, 0, 1, 1, 0, 1}, false, 1, 1},
        {"square one point, nu 0", 0, 4, {0, 0, 1, 0, 1, 1, 0, 1}, true, 1, 1},
        {"rectangle 2:1 one point, nu 0", 0, 4, {0, 0, 2, 0, 2, 1, 0, 1}, true, 1, 1},
        {"sliver 0.1, nu 0", 0, 3, {0, 0, 1, 0, 0.5, 0.1}, false, 0.1, 0.942809},
        {"sliver 0.01, nu 0", 0, 3, {0, 0, 1, 0, 0.5, 0.01}, false, 0.01, 0.942809},
        {"right isosceles, nu 0.3", 0.3, 3, {0, 0, 1, 0, 0, 1}, false, 1, 0.6529943},
        {"equilateral, nu 0.3", 0.3, 3, {0, 0, 1, 0, 0.5, s}, false, 1, 0.7161149},
        {"cross diagonal, nu 0.3", 0.3, 3, {0, 0, 1, 0, 0.5, 0.5}, false, 1, 0.4617367},
        {"square 2 x 2, nu 0.3", 0.3, 4, {0, 0, 1, 0, 1, 1, 0, 1}, false, 1, 0.877058},
        {"square one point, nu 0.3", 0.3, 4, {0, 0, 1, 0, 1, 1, 0, 1}, true, 1, 0.877058},
        {"rectangle 2:1 one point, nu 0.3", 0.3, 4, {0, 0, 2, 0, 2, 1, 0, 1}, true, 1, 0.9858619},
        {"rectangle 5:1 one point, nu 0.3", 0.3, 4, {0, 0, 5, 0, 5, 1, 0, 1}, true, 1, 0.9981375},
        {"sliver 0.1, nu 0.3", 0.3, 3, {0, 0, 1, 0, 0.5, 0.1}, false, 0.1, 0.9422369},
        {"sliver 0.01, nu 0.3", 0.3, 3, {0, 0, 1, 0, 0.5, 0.01}, false, 0.01, 0.9428034},
        {"equilateral, nu 0.35", 0.35, 3, {0, 0, 1, 0, 0.5, s}, false, 1, 0.7027284},
        {"square 2 x 2, nu 0.35", 0.35, 4, {0, 0, 1, 0, 1, 1, 0, 1}, false, 1, 0.860663},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const CriticalCase *c = &cases[i];
        double speed = sqrt(2e8 / (800 * (1 - c->nu * c->nu)));
        Scene scene = {0};
        make_critical(&scene, c);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .one_point = c->one_point});
        verify_close(c->name, run.samples[0].element_step * speed / c->height, c->step, 1e-6);
        verify_free(&run);
    }
}

/* The bound is sharp: a free equilateral triangle is stable at 0.99 of it and runs away at 1.01. */
static void sharp_bound(void **state)
{
    (void)state;
    const double s = 0.8660254037844386, factors[] = {0.99, 1.01};
    double energy[2];
    for (int i = 0; i < 2; i++) {
        Scene scene = {0};
        SceneText *deck = &scene.deck;
        deck->exact = true;
        scene_add_node(&scene.mesh, 0, 0, 0);
        scene_add_node(&scene.mesh, 1, 0, 0);
        scene_add_node(&scene.mesh, 0.5, s, 0);
        scene_add_shell(&scene.mesh, 1, 0, 1, 2, 2);
        scene_begin(deck, "sharp bound", 1, factors[i]);
        scene_write_part(deck, 1, 1, 1, "element");
        scene_write_section(deck, 1, 9, 1e-3);
        SceneFabric fabric = scene_isotropic(2, false, 800, 2e8, 0.3);
        scene_write_fabric(deck, 1, &fabric);
        scene_print(deck, "*INITIAL_VELOCITY_NODE\n");
        SCENE_CARD(deck, 1, 1e-7, 2e-7, 0);
        scene_end(deck, &scene.mesh);
        VerifyRun run;
        verify_build(&run, deck->text, deck->length, &(VerifyOptions){.every = 1, .stop = 200});
        verify_loop(&run);
        energy[i] = run.count ? verify_largest(&run, 0, offsetof(VerifySample, kinetic)) / run.samples[0].kinetic : NAN;
        verify_free(&run);
        scene_free(&scene);
    }
    verify_between("A9 energy growth at 0.99 of the bound", energy[0], 0.5, 20);
    verify_between("A9 energy growth at 1.01 of the bound", energy[1], 1e3, 1e300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(breathing_in_vacuum),
                                       cmocka_unit_test(breathing_with_gas),
                                       cmocka_unit_test(breathing_under_pressure),
                                       cmocka_unit_test(pressure_step),
                                       cmocka_unit_test(strip_wave),
                                       cmocka_unit_test(critical_step),
                                       cmocka_unit_test(sharp_bound)};
    return cmocka_run_group_tests_name("waves and steps", tests, NULL, NULL);
}
