/* Scenes: the bags of the examples and of the speed benchmark. SI units. */
#include "examples/scene.h"

#include <math.h>

enum { PART_TOP = 1, PART_BOTTOM, PART_RIGID, PART_DROPPED };

static bool select_within(const void *radius, const double x[3])
{
    double r = *(const double *)radius;
    return x[0] * x[0] + x[1] * x[1] < r * r;
}

static void write_bag_parts(SceneText *deck, double thickness, const SceneFabric *fabric, bool rigid)
{
    scene_write_part(deck, PART_TOP, 1, 1, "upper panel");
    scene_write_part(deck, PART_BOTTOM, 1, 1, "lower panel");
    if (rigid) scene_write_part(deck, PART_RIGID, 1, 2, "mount");
    scene_write_section(deck, 1, 9, thickness);
    scene_write_fabric(deck, 1, fabric);
    if (rigid) scene_write_rigid(deck, 2, 7800, 7, 7);
    scene_write_part_set(deck, 1, rigid ? 3 : 2, (const int[]){PART_TOP, PART_BOTTOM, PART_RIGID});
}

void scene_driver_bag(Scene *scene, int n)
{
    const double radius = 0.35, mount = 0.07;
    SceneText *deck = &scene->deck;
    scene_add_disc(&scene->mesh, PART_TOP, SCENE_DIAGONAL, n > 0 ? n : 20, radius);
    scene_sew_copy(&scene->mesh, PART_BOTTOM, scene_select_radius, &radius);
    scene_retag(&scene->mesh, PART_BOTTOM, PART_RIGID, select_within, &mount);

    scene_begin(deck, "circular driver bag inflated from flat", 0.080, 0.9);
    scene_write_output(deck, 2e-4, 2e-4, 2e-3);
    SceneFabric fabric = {.form = 0,
                          .cse = true,
                          .density = 800,
                          .ea = 3e8,
                          .eb = 2.5e8,
                          .gab = 1.5e7,
                          .prba = 0.25,
                          .prab = 0.3,
                          .damp = 0.05,
                          .aopt = 2,
                          .vector = {1, 0, 0}};
    write_bag_parts(deck, 3.5e-4, &fabric, true);
    scene_print(deck, "$ nitrogen from the inflator: 0.043 kg in 50 ms at 700 K\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.010, 1.5, 0.025, 1.2, 0.050, 0, 0.080, 0});
    SceneGas gas = {.gamma = 1.4,
                    .molar_mass = 0.0280134,
                    .pressure = 101325,
                    .temperature = 296.15,
                    .inflow_temperature = 700,
                    .inflow_curve = 1,
                    .vent_coefficient = 0.65,
                    .vent_area = 1.9e-3,
                    .pop_pressure = 5000};
    scene_write_wang_nefske(deck, 1, &gas);
    scene_end(deck, &scene->mesh);
}

static bool select_square_edge(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9 * a;
    return x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small;
}

void scene_cushion(Scene *scene, int n)
{
    const double side = 0.6;
    SceneText *deck = &scene->deck;
    if (n <= 0) n = 24;
    scene_add_rectangle(&scene->mesh, PART_TOP, SCENE_QUADS, n, n, side, side);
    scene_sew_copy(&scene->mesh, PART_BOTTOM, select_square_edge, &side);

    scene_begin(deck, "square cushion inflated from flat", 0.100, 0.9);
    scene_write_output(deck, 5e-4, 5e-4, 2.5e-3);
    SceneFabric fabric = {.form = 2,
                          .cse = true,
                          .density = 800,
                          .ea = 4e8,
                          .eb = 4e8,
                          .gab = 1.43e8,
                          .prba = 0.4,
                          .prab = 0.4,
                          .damp = 0.05};
    write_bag_parts(deck, 4e-4, &fabric, false);
    scene_print(deck, "$ cold air: 0.055 kg in 60 ms at 296 K\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.010, 1.1, 0.050, 1.1, 0.060, 0, 0.100, 0});
    SceneGas gas = scene_air(101325, 296.15);
    gas.inflow_temperature = 296.15;
    gas.inflow_curve = 1;
    scene_write_simple_airbag(deck, 1, &gas);
    scene_write_damping(deck, 0, 10);
    scene_end(deck, &scene->mesh);
}

typedef struct Patch {
    double x, y, half; /* square about a point */
} Patch;

static bool select_patch(const void *user, const double x[3])
{
    const Patch *patch = user;
    return fabs(x[0] - patch->x) < patch->half && fabs(x[1] - patch->y) < patch->half;
}

static bool select_ring_edges(const void *user, const double x[3])
{
    const double *radii = user;
    return scene_select_radius(&radii[0], x) || scene_select_radius(&radii[1], x);
}

void scene_landing_pad(Scene *scene, int n)
{
    const double radii[2] = {0.6, 1.4};
    SceneText *deck = &scene->deck;
    if (n <= 0) n = 12;
    scene_add_ring(&scene->mesh, PART_TOP, SCENE_QUADS, n, 8 * n, radii[0], radii[1]);
    scene_sew_copy(&scene->mesh, PART_BOTTOM, select_ring_edges, radii);
    Patch mount = {1.0, 0.0, 0.14}, hole = {1.0, 0.0, 0.07};
    scene_retag(&scene->mesh, PART_BOTTOM, PART_RIGID, select_patch, &mount);
    scene_retag(&scene->mesh, PART_RIGID, PART_DROPPED, select_patch, &hole);
    scene_drop_part(&scene->mesh, PART_DROPPED);

    scene_begin(deck, "ring-shaped landing pad filled through a fixed nozzle", 0.150, 0.9);
    scene_write_output(deck, 5e-4, 5e-4, 5e-3);
    SceneFabric fabric = {.form = 0,
                          .cse = true,
                          .density = 800,
                          .ea = 5e8,
                          .eb = 4e8,
                          .gab = 5e7,
                          .prba = 0.2,
                          .prab = 0.25,
                          .el = 6e7,
                          .prl = 0.35,
                          .lratio = 0.1,
                          .damp = 0.1};
    write_bag_parts(deck, 4e-4, &fabric, true);
    scene_print(deck, "$ warm gas through the nozzle: 1.14 kg in 140 ms at 500 K\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.020, 9.5, 0.120, 9.5, 0.140, 0, 0.150, 0});
    SceneGas gas = scene_air(101325, 296.15);
    gas.inflow_temperature = 500;
    gas.inflow_curve = 1;
    gas.vent_coefficient = 0.7;
    gas.vent_area = 4e-3;
    scene_write_simple_airbag(deck, 1, &gas);
    scene_end(deck, &scene->mesh);
}

void scene_speed(Scene *scene, ScenePattern pattern, int shells, int cycles)
{
    const double side = 1;
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    int per_square = pattern == SCENE_QUADS ? 1 : pattern == SCENE_CROSS ? 4 : 2;
    int n = (int)lround(sqrt(shells / 2.0 / per_square));
    scene_add_rectangle(mesh, PART_TOP, pattern, n, n, side, side);
    scene_sew_copy(mesh, PART_BOTTOM, select_square_edge, &side);
    int panel = mesh->shell_count / 2;
    for (int e = 0; e < mesh->shell_count; e++) { /* a pillow: the panels bulge */
        for (int c = 0; c < 4; c++) {
            double *x = mesh->x + 3 * mesh->shell[e][c], u = 2 * x[0] / side - 1, v = 2 * x[1] / side - 1;
            x[2] = (e < panel ? 0.1 : -0.1) * side * (1 - u * u) * (1 - v * v);
        }
    }

    scene_print(deck, "*KEYWORD\n*TITLE\nspeed: gas-filled pillow, %d shells\n*CONTROL_TERMINATION\n",
                mesh->shell_count);
    SCENE_CARD(deck, 1e3, cycles);
    SceneFabric fabric = {
        .form = 0, .cse = true, .density = 800, .ea = 3e8, .eb = 2e8, .gab = 1e7, .prba = 0.2, .prab = 0.3};
    write_bag_parts(deck, 3.5e-4, &fabric, false);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1e3, 1});
    SceneGas gas = scene_air(101325, 296.15);
    gas.inflow_temperature = 500;
    gas.inflow_curve = 1;
    scene_write_simple_airbag(deck, 1, &gas);
    scene_end(deck, mesh);
}
