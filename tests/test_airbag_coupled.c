/* Gas and walls together: rigid boxes (B1, B2, B3), piston on a gas column (C1), pressure as the gradient of the volume
 * (C2), bounce and energy balance (C4) of the reference collection. The boxes take
 * the step that billow finds. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#define PRESSURE offsetof(VerifySample, pressure)
#define VOLUME offsetof(VerifySample, volume)
#define TEMPERATURE offsetof(VerifySample, temperature)
#define MASS offsetof(VerifySample, mass)
#define LID_Z (offsetof(VerifySample, x) + 2 * sizeof(double))
#define LID_SPEED (offsetof(VerifySample, v) + 2 * sizeof(double))

/* ---- rigid boxes ---------------------------------------------------------------------------------------------------
 */

static void adiabatic_stroke(void **state)
{
    (void)state;
    const double size[3] = {0.2, 0.3, 1};
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    verify_begin_box(&scene, size, 1, 4, 0.2);
    SceneGas air = scene_air(101325, 300);
    air.inflow_curve = 1;
    scene_write_simple_airbag(deck, 1, &air);
    scene_write_curve(deck, 2, 3, (const double[]){0, 0, 0.1, -0.5, 0.2, 0});
    scene_write_rigid_motion(deck, 2, 3, 2, 2, 1);
    scene_end(deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = 4});
    double worst = 0;
    for (size_t i = 0; i < run.count; i++) {
        const VerifySample *s = &run.samples[i];
        worst = fmax(worst, fabs(s->pressure / (101325 * pow(0.06 / s->volume, 1.4)) - 1));
        worst = fmax(worst, fabs(s->volume / (0.06 * s->x[2]) - 1));
    }
    print_message("    %ld cycles\n", (long)run.cycles);
    verify_near("B1 p V^gamma over the stroke", worst, 0, 1e-6);
    double least = verify_smallest(&run, 0, VOLUME); /* of the cycle next to the corner of the curve */
    verify_close("B1 least volume [m3]", least, 0.03, 1e-3);
    verify_close("B1 p at half the volume [Pa]", verify_largest(&run, 0, PRESSURE) * pow(least / 0.03, 1.4), 267398.278,
                 1e-6);
    verify_close("B1 T at half the volume [K]", verify_largest(&run, 0, TEMPERATURE) * pow(least / 0.03, 0.4),
                 395.852373, 1e-6);
    verify_close("B1 p at the end [Pa]", run.samples[run.count - 1].pressure, 101325, 1e-6);
    verify_free(&run);
}

static void blowdown(void **state)
{
    (void)state;
    const double table[][4] = {
        {0.005, 288096.388, 395.399532, 0.152292062}, {0.01, 276729.518, 390.877976, 0.147975525},
        {0.02, 255499.221, 382.064473, 0.139774687},  {0.03, 236110.074, 373.545734, 0.132113239},
        {0.05, 202163.314, 357.341257, 0.118248269},  {0.06, 187305.216, 349.631879, 0.111973293},
        {0.08, 161375.644, 335.059484, 0.100668055},  {0.1, 140331.287, 321.946552, 0.0911058648},
        {0.15, 107892.949, 298.652546, 0.0755096478}};
    Scene scene = {0};
    verify_begin_box(&scene, (const double[3]){0.2, 0.3, 1}, 1, 7, 0.2);
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.overpressure = 300000 - 101325;
    air.initial_temperature = 400;
    air.vent_coefficient = 0.6;
    air.vent_area = 1.5e-3 / 0.6;
    scene_write_wang_nefske(&scene.deck, 1, &air);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    print_message("    %ld cycles\n", (long)run.cycles);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        verify_close("B2 p [Pa]", verify_at(&run, table[i][0], PRESSURE), table[i][1], 1e-4);
        verify_close("B2 T [K]", verify_at(&run, table[i][0], TEMPERATURE), table[i][2], 1e-4);
        verify_close("B2 m [kg]", verify_at(&run, table[i][0], MASS), table[i][3], 1e-4);
    }
    const VerifySample *last = &run.samples[run.count - 1];
    verify_close("B2 p at rest [Pa]", last->pressure, 101325, 1e-4);
    verify_close("B2 T at rest [K]", last->temperature, 293.34112, 1e-4);
    verify_close("B2 m at rest [kg]", last->mass, 0.07219702, 1e-4);
    verify_free(&run);
}

/* Both models fill the tank alike. */
static void tank_filling(void **state)
{
    (void)state;
    const double table[][4] = {{0.005, 0.03874997089, 384.388776, 150998.8193},
                               {0.01, 0.04374997089, 452.4586754, 200672.6385},
                               {0.02, 0.05374997089, 550.6059518, 300020.2771},
                               {0.03, 0.06374997089, 617.9619116, 399367.9156},
                               {0.05, 0.08374997089, 704.4187986, 598063.1927}};
    for (int model = 0; model < 2; model++) {
        Scene scene = {0};
        verify_begin_box(&scene, (const double[3]){0.283168, 0.1, 1}, 1, 7, 0.05);
        scene_write_curve(&scene.deck, 2, 2, (const double[]){0, 1, 1, 1});
        SceneGas air = scene_air(101325, 296.15);
        air.inflow_curve = 2;
        air.inflow_temperature = 700;
        (model ? scene_write_wang_nefske : scene_write_simple_airbag)(&scene.deck, 1, &air);
        scene_write_output(&scene.deck, 0, 0.005, 0);
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        print_message("    %ld cycles\n", (long)run.cycles);
        for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
            verify_close("B3 m [kg]", verify_at(&run, table[i][0], MASS), table[i][1], 1e-8);
            verify_close("B3 T [K]", verify_at(&run, table[i][0], TEMPERATURE), table[i][2], 1e-8);
            verify_close("B3 p [Pa]", verify_at(&run, table[i][0], PRESSURE), table[i][3], 1e-8);
        }
        verify_free(&run);
    }
}

/* ---- piston
 * ---------------------------------------------------------------------------------------------------------- */

static void make_piston(Scene *scene, double vent_area, double end)
{
    SceneText *deck = &scene->deck;
    verify_begin_box(scene, (const double[3]){0.2, 0.2, 0.3}, 5, 4, end);
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.vent_coefficient = vent_area > 0 ? 1 : 0;
    air.vent_area = vent_area;
    scene_write_simple_airbag(deck, 1, &air);
    scene_write_curve(deck, 2, 2, (const double[]){0, 1, 1, 1});
    scene_write_gravity(deck, 2, 9.81);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, 2, 0, 0, -4);
    scene_end(deck, &scene->mesh);
}

static void check_piston(const VerifyRun *run, const double (*table)[4], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double t = table[i][0];
        verify_close("C1 x [m]", 0.3 - verify_at(run, t, LID_Z), table[i][1], 1e-3);
        verify_near("C1 v [m/s]", -verify_at(run, t, LID_SPEED), table[i][2], 4e-3);
        verify_close("C1 p [Pa]", verify_at(run, t, PRESSURE), table[i][3], 1e-3);
    }
}

static void closed_piston(void **state)
{
    (void)state;
    const double table[][4] = {{0.01, 0.03779036322, 3.275545208, 122342.7563},
                               {0.02, 0.06003615393, 0.9536570334, 138510.3508},
                               {0.03, 0.05495026912, -1.916029407, 134502.528},
                               {0.04, 0.02540015789, -3.725539718, 114684.8293}};
    Scene scene = {0};
    make_piston(&scene, 0, 0.06);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = 4});
    print_message("    %ld cycles\n", (long)run.cycles);
    check_piston(&run, table, sizeof table / sizeof table[0]);
    double lowest = verify_smallest(&run, 0, LID_Z), back = 0.04;
    for (int i = 0; i < 60; i++) { /* the return to the start by Newton's method */
        double gap = 0.3 - verify_at(&run, back, LID_Z);
        back += gap / verify_at(&run, back, LID_SPEED);
    }
    verify_close("C1 largest x [m]", 0.3 - lowest, 0.061589618997, 1e-3);
    verify_close("C1 largest p [Pa]", verify_largest(&run, 0, PRESSURE), 139775.5283, 1e-3);
    verify_close("C1 time of return [s]", back, 0.046478601, 1e-3);
    verify_close("C4 speed of return [m/s]", verify_at(&run, back, LID_SPEED), 4, 1e-3);
    verify_balance(&run, 1e-6);
    verify_free(&run);
}

static void vented_piston(void **state)
{
    (void)state;
    const double table[][4] = {
        {0.01, 0.0384249797, 3.49863878, 115352.36},    {0.02, 0.0670837744, 2.1436434, 121980.905},
        {0.03, 0.080945608, 0.683719106, 117947.037},   {0.04, 0.082901845, -0.157364859, 107982.707},
        {0.05, 0.0802856734, -0.274694059, 101296.939}, {0.06, 0.0782483311, -0.115300254, 99996.4063},
        {0.08, 0.0800876247, 0.266982776, 101169.246},  {0.1, 0.0869703933, 0.406887526, 101892.56}};
    const double mass[] = {0.0138206562, 0.0128075053, 0.0117593889, 0.0109422928,
                           0.0105799475, 0.0105799475, 0.0105799475, 0.0103011042};
    Scene scene = {0};
    make_piston(&scene, 5e-4, 0.11);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = 4});
    print_message("    %ld cycles\n", (long)run.cycles);
    check_piston(&run, table, sizeof table / sizeof table[0]);
    for (size_t i = 0; i < 8; i++) verify_close("C1 m [kg]", verify_at(&run, table[i][0], MASS), mass[i], 1e-3);
    verify_close("C1 largest p [Pa]", verify_largest(&run, 0, PRESSURE), 122058.5805, 1e-3);
    verify_free(&run);
}

/* ---- the gradient of the volume
 * ---------------------------------------------------------------------------------------- */

/* A closed lumpy body far from the origin, no symmetry. hole: shells of one corner of space are left out. */
static void add_lump(SceneMesh *mesh, ScenePattern pattern, bool hole)
{
    static const ScenePlane low = {2, -0.8, 0.25};
    scene_add_sphere(mesh, 1, pattern, 4, 1);
    for (int i = 0; i < mesh->node_count; i++) {
        double *x = mesh->x + 3 * i, lump = 1 + 0.2 * x[0] * x[1] - 0.3 * x[2] * x[2] * x[0];
        for (int c = 0; c < 3; c++) x[c] *= lump;
        x[0] += 0.1 * x[1] * x[1];
    }
    if (hole) {
        scene_retag(mesh, 1, 9, scene_select_plane, &low);
        scene_drop_part(mesh, 9);
    }
    scene_transform(mesh, 0, (const double[9]){1, 0.1, 0, 0, 0.7, 0.2, 0.1, 0, 1.2}, (const double[3]){3, -2, 1});
}

static void run_lump(ScenePattern pattern, bool hole, bool push, SceneMesh *mesh, VerifyRun *run)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    add_lump(&scene.mesh, pattern, hole);
    scene_begin(deck, "lump", 1, 0);
    scene_write_part(deck, 1, 1, 1, "skin");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_write_null(deck, 1, 1e6);
    scene_write_part_set(deck, 1, 1, (const int[]){1});
    scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1, 0});
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.overpressure = 50000;
    scene_write_wang_nefske(deck, 1, &air);
    scene_end(deck, &scene.mesh);
    *mesh = scene.mesh;
    scene.mesh = (SceneMesh){0};
    verify_scene(run, &scene, &(VerifyOptions){.every = 1, .stop = 2, .caps_push_rim = push});
}

/* Largest |sum f| over p A and largest |sum x cross f| over p A and the size of the body. */
static void sum_forces(const VerifyRun *run, int nodes, double scale, double *force, double *moment)
{
    double f[3] = {0}, m[3] = {0};
    for (int i = 0; i < nodes; i++) {
        const double *x = run->x + 3 * i, *g = run->f + 3 * i;
        for (int c = 0; c < 3; c++) {
            f[c] += g[c];
            m[c] += x[(c + 1) % 3] * g[(c + 2) % 3] - x[(c + 2) % 3] * g[(c + 1) % 3];
        }
    }
    *force = fmax(fabs(f[0]), fmax(fabs(f[1]), fabs(f[2]))) / scale;
    *moment = fmax(fabs(m[0]), fmax(fabs(m[1]), fabs(m[2]))) / scale;
}

static void third_law(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_DIAGONAL, SCENE_QUADS};
    for (int k = 0; k < 2; k++) {
        SceneMesh mesh;
        VerifyRun run;
        run_lump(patterns[k], false, false, &mesh, &run);
        const VerifySample *last = &run.samples[run.count - 1];
        double pressure = last->pressure - 101325, force, moment, worst = 0, largest = 0;
        verify_close("C2 volume [m3]", last->volume, verify_volume(&mesh, run.x), 1e-12);
        verify_close("C2 area [m2]", last->area, verify_area(&mesh, run.x), k ? 1e-3 : 1e-12);
        sum_forces(&run, mesh.node_count, pressure * last->area, &force, &moment);
        verify_near("C2 sum of forces / (p A)", force, 0, 1e-13);
        verify_near("C2 sum of moments / (p A 1 m)", moment, 0, 1e-12);
        for (int i = 0; i < 3 * mesh.node_count; i++) {
            double saved = run.x[i], step = 1e-3;
            run.x[i] = saved + step;
            double high = verify_volume(&mesh, run.x);
            run.x[i] = saved - step;
            double low = verify_volume(&mesh, run.x);
            run.x[i] = saved;
            worst = fmax(worst, fabs((high - low) / (2 * step) - run.f[i] / pressure));
            largest = fmax(largest, fabs(run.f[i] / pressure));
        }
        verify_near("C2 dV/dx - f/p over the largest", worst / largest, 0, 1e-8);
        verify_free(&run);
        scene_mesh_free(&mesh);
    }
}

/* A bag with a hole: with the option that the cap pushes its rim, momentum closes too. */
static void third_law_with_cap(void **state)
{
    (void)state;
    for (int push = 0; push < 2; push++) {
        SceneMesh mesh;
        VerifyRun run;
        run_lump(SCENE_DIAGONAL, true, push, &mesh, &run);
        const VerifySample *last = &run.samples[run.count - 1];
        double force, moment;
        sum_forces(&run, mesh.node_count, (last->pressure - 101325) * last->area, &force, &moment);
        if (push) {
            verify_near("C2 with cap, sum of forces / (p A)", force, 0, 1e-13);
            verify_near("C2 with cap, sum of moments / (p A)", moment, 0, 1e-12);
        } else {
            verify_between("C2 without the cap's force", force, 1e-3, 1);
        }
        verify_free(&run);
        scene_mesh_free(&mesh);
    }
}

typedef struct Momentum {
    double largest, impulse; /* |sum m v|; integral of p A dt */
    double time;
} Momentum;

static void record_momentum(void *user, const Model *model, const State *state, const StepView *view)
{
    Momentum *momentum = user;
    double sum[3] = {0};
    for (int i = 0; i < model->node_count; i++)
        for (int c = 0; c < 3; c++) sum[c] += model->mass[i] * view->v[3 * i + c];
    momentum->largest = fmax(momentum->largest, fmax(fabs(sum[0]), fmax(fabs(sum[1]), fabs(sum[2]))));
    momentum->impulse += fabs(state->gas[0].applied) * state->gas[0].area * (state->clock->time - momentum->time);
    momentum->time = state->clock->time;
}

static void free_bag_momentum(void **state)
{
    (void)state;
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_add_sphere(&scene.mesh, 1, SCENE_DIAGONAL, 3, 0.3);
    for (int i = 0; i < scene.mesh.node_count; i++) {
        double *x = scene.mesh.x + 3 * i;
        x[0] *= 1 + 0.5 * x[2] + x[1] * x[1];
        x[1] *= 0.8;
    }
    scene_begin(deck, "free bag", 1e3, 0.9);
    scene_write_part(deck, 1, 1, 1, "bag");
    scene_write_section(deck, 1, 9, 3.5e-4);
    SceneFabric fabric = {
        .form = 0, .cse = true, .density = 800, .ea = 3e8, .eb = 2e8, .gab = 1e7, .prba = 0.2, .prab = 0.3};
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 1, (const int[]){1});
    scene_write_curve(deck, 1, 3, (const double[]){0, 0.5, 0.02, 0.5, 0.05, 0});
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 400;
    scene_write_simple_airbag(deck, 1, &air);
    scene_end(deck, &scene.mesh);
    Momentum momentum = {0};
    VerifyRun run;
    verify_scene(&run, &scene,
                 &(VerifyOptions){.every = 10, .stop = 100000, .probe = record_momentum, .user = &momentum});
    verify_near("C2 free bag, |momentum| / (p A t)", momentum.largest / momentum.impulse, 0, 1e-10);
    verify_balance(&run, 1e-3);
    verify_free(&run);
}

/* ---- bounce on an elastic bag
 * -------------------------------------------------------------------------------------------- */

static void elastic_bounce(void **state)
{
    (void)state;
    const double radius = 0.2, length = 0.3, thickness = 5e-4;
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    SceneMesh *mesh = &scene.mesh;
    deck->exact = true;
    scene_add_disc(mesh, 1, SCENE_DIAGONAL, 5, radius);
    scene_reverse(mesh, 0, mesh->shell_count);
    int lid = mesh->node_count;
    scene_add_disc(mesh, 2, SCENE_DIAGONAL, 5, radius);
    scene_transform(mesh, lid, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[3]){0, 0, length});
    scene_add_tube(mesh, 3, SCENE_DIAGONAL, 6, 30, radius, length);
    scene_weld(mesh, 0, 1e-6);
    scene_begin(deck, "rigid lid on an elastic bag", 0.0395, 0.6); /* down and back, before the wall snatches */
    scene_write_part(deck, 1, 1, 1, "bottom");
    scene_write_part(deck, 2, 1, 2, "lid");
    scene_write_part(deck, 3, 1, 3, "wall");
    scene_write_section(deck, 1, 9, thickness);
    scene_write_rigid(deck, 1, 7800, 7, 7);
    scene_write_rigid(deck, 2, 10 / (3.1 * radius * radius * thickness), 4, 7);
    SceneFabric fabric = scene_isotropic(2, true, 800, 3e8, 0.3);
    scene_write_fabric(deck, 3, &fabric);
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
    scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1, 0});
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.overpressure = 2000;
    scene_write_wang_nefske(deck, 1, &air);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, 2, 0, 0, -4);
    scene_end(deck, mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .node = lid});
    verify_between("C4 lowest lid [m]", verify_smallest(&run, 0, LID_Z), 0.1, 0.28);
    verify_between("C4 fastest return [m/s]", verify_largest(&run, 0, LID_SPEED), 3, 4.5);
    verify_balance(&run, 1e-3);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(adiabatic_stroke),   cmocka_unit_test(blowdown),          cmocka_unit_test(tank_filling),
        cmocka_unit_test(closed_piston),      cmocka_unit_test(vented_piston),     cmocka_unit_test(third_law),
        cmocka_unit_test(third_law_with_cap), cmocka_unit_test(free_bag_momentum), cmocka_unit_test(elastic_bounce)};
    return cmocka_run_group_tests_name("gas and walls", tests, NULL, NULL);
}
