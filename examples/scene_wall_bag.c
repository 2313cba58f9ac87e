/* Scene: a driver bag, to be folded, that deploys against a wall and against itself. SI units. */
#include "examples/scene.h"

#include <math.h>
#include <stdlib.h>

static const double hub = 0.06, wall = 0.16;

/* The middle of the lower panel is held, as by the ring of its inflator. */
static void write_hub(SceneText *deck, const SceneMesh *mesh)
{
    unsigned char *lower = calloc((size_t)mesh->node_count + 1, 1);
    if (!lower) {
        deck->failed = true;
        return;
    }
    for (int e = 0; e < mesh->shell_count; e++)
        for (int k = 0; k < 4 && mesh->part[e] == 2; k++) lower[mesh->shell[e][k]] = 1;
    scene_print(deck, "*SET_NODE_LIST\n");
    SCENE_CARD(deck, 2);
    for (int i = 0; i < mesh->node_count; i++)
        if (lower[i] && hypot(mesh->x[3 * i], mesh->x[3 * i + 1]) < hub) SCENE_CARD(deck, i + 1);
    scene_write_spc(deck, 2, true, true, true);
    free(lower);
}

void scene_wall_bag(Scene *scene, int n)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    scene_folding_mesh(mesh, n);
    deck->exact = true;
    scene_begin(deck, "driver bag to be folded, deploys against a wall", 0.06, 0.9);
    scene_write_output(deck, 2e-4, 2e-4, 1e-3);
    scene_print(deck, "*DATABASE_RWFORC\n");
    SCENE_CARD(deck, 2e-4);
    SceneFabric fabric = scene_isotropic(2, true, 800, 3e8, 0.3);
    fabric.damp = 0.05;
    fabric.tension_factor = 0.001;
    scene_write_part(deck, 1, 1, 1, "upper panel");
    scene_write_part(deck, 2, 1, 1, "lower panel");
    scene_write_section(deck, 1, 9, 3.5e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    write_hub(deck, mesh);
    scene_print(deck, "$ nitrogen at 700 K from the inflator, two vents of 20 mm\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.005, 1.2, 0.020, 1.0, 0.040, 0, 1, 0});
    SceneGas gas = {.gamma = 1.4,
                    .molar_mass = 0.0280134,
                    .pressure = 101325,
                    .temperature = 296.15,
                    .inflow_temperature = 700,
                    .inflow_curve = 1,
                    .vent_coefficient = 0.7,
                    .vent_area = 6.3e-4};
    scene_write_wang_nefske(deck, 1, &gas);
    scene_print(deck, "*CONTACT_AIRBAG_SINGLE_SURFACE\n");
    SCENE_CARD(deck, 1, 0, 2);
    SCENE_CARD(deck, 0.2, 0.2);
    SCENE_CARD(deck, 1, 1);
    scene_print(deck, "*RIGIDWALL_PLANAR_ID\n         1wall\n         0\n");
    SCENE_CARD(deck, 0, 0, wall, 0, 0, 0, 0.2);
    scene_end(deck, mesh);
}
