/* Scenes: a driver bag for folding, and what it is blown up by. SI units. */
#include "examples/scene.h"

static const double radius = 0.35;

void scene_folding_mesh(SceneMesh *mesh, int n)
{
    scene_add_disc(mesh, 1, SCENE_DIAGONAL, n > 0 ? n : 20, radius);
    scene_sew_copy(mesh, 2, scene_select_radius, &radius);
}

void scene_folding_deck(Scene *scene, double pressure)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "driver bag to be folded", pressure > 0.0 ? 0.2 : 0.3, 0.9);
    scene_write_output(deck, 1e-3, 1e-3, 5e-3);
    SceneFabric fabric = {.form = 2,
                          .cse = true,
                          .density = 800,
                          .ea = 3e8,
                          .eb = 3e8,
                          .gab = 3e8 / 2.6,
                          .prba = 0.3,
                          .prab = 0.3,
                          .damp = 0.05,
                          .tension_factor = 0.001};
    scene_write_part(deck, 1, 1, 1, "upper panel");
    scene_write_part(deck, 2, 1, 1, "lower panel");
    scene_write_section(deck, 1, 9, 3.5e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    scene_print(deck, "$ brings the bag to rest\n");
    scene_write_damping(deck, 0, pressure > 0.0 ? 300 : 100);
    if (pressure > 0.0) {
        scene_write_curve(deck, 1, 2, (const double[]){0, pressure, 1, pressure});
        scene_print(deck, "*AIRBAG_LOAD_CURVE\n");
        SCENE_CARD(deck, 1, 1);
        SCENE_CARD(deck, 0, 1);
        return;
    }
    scene_print(deck, "$ nitrogen from the inflator: 0.030 kg in 50 ms at 700 K\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.010, 1.0, 0.025, 0.8, 0.050, 0, 0.3, 0});
    SceneGas gas = {.gamma = 1.4,
                    .molar_mass = 0.0280134,
                    .pressure = 101325,
                    .temperature = 296.15,
                    .inflow_temperature = 700,
                    .inflow_curve = 1};
    scene_write_wang_nefske(deck, 1, &gas);
}

void scene_folding_bag(Scene *scene, int n, double pressure)
{
    scene_folding_mesh(&scene->mesh, n);
    scene_folding_deck(scene, pressure);
    scene_end(&scene->deck, &scene->mesh);
}
