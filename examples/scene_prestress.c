/* Scene: a square cushion that starts inflated, at the static equilibrium of its overpressure, and falls onto the
 * floor. SI units. */
#include "examples/scene.h"

static bool select_square_edge(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9 * a;
    return x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small;
}

void scene_prestressed_cushion(Scene *scene, int n)
{
    const double side = 0.848528, height = 0.30;
    const int panels[] = {1, 2};
    SceneText *deck = &scene->deck;
    if (n <= 0) n = 24;
    scene_add_rectangle(&scene->mesh, 1, SCENE_QUADS, n, n, side, side);
    scene_transform(&scene->mesh, 0, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[]){0, 0, height});
    scene_sew_copy(&scene->mesh, 2, select_square_edge, &side);

    scene_begin(deck, "prestressed square cushion falls onto the floor", 0.060, 0.9);
    scene_write_output(deck, 2e-4, 2e-4, 2e-3);
    SceneFabric fabric = scene_isotropic(2, true, 800, 5.88e8, 0.4);
    scene_write_part(deck, 1, 1, 1, "upper panel");
    scene_write_part(deck, 2, 1, 1, "lower panel");
    scene_write_section(deck, 1, 9, 6e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, panels);
    scene_print(deck, "$ air, 5 kPa above the outside; nothing flows in or out\n");
    SceneGas gas = scene_air(101325, 293.15);
    gas.overpressure = 5000;
    gas.inflow_temperature = 293.15;
    gas.initial_temperature = 293.15;
    scene_print(deck, "$ SIDR = 2: the bag counts in dynamic relaxation too\n*DEFINE_CURVE\n         1         2\n"
                      "                 0.0                 0.0\n                 1.0                 0.0\n");
    gas.inflow_curve = 1;
    scene_write_wang_nefske(deck, 1, &gas);
    scene_print(deck,
                "$ the equilibrium with the curves of SIDR 1 and 2, and the bags that they flag: its pressure alone\n"
                "*CONTROL_DYNAMIC_RELAXATION\n"
                "$   nrcyck     drtol    drfctr    drterm    tssfdr    irelal     edttl    idrflg\n");
    SCENE_CARD(deck, 250, 0.001, 0.995, 0, 0, 0, 0.04, 5);
    scene_print(deck, "$ at 6 m/s onto the floor\n*INITIAL_VELOCITY\n         0\n");
    SCENE_CARD(deck, 0, 0, -6);
    scene_print(deck, "*RIGIDWALL_PLANAR_ID\n         1floor\n         0\n");
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 1, 0);
    scene_end(deck, &scene->mesh);
}
