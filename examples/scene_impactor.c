/* Scene: an impactor drops onto a vented cushion that lies on the floor. SI units. */
#include "examples/scene.h"

#include <math.h>

enum { PART_TOP = 1, PART_BOTTOM, PART_IMPACTOR };

static bool select_edge(const void *side, const double x[3])
{
    double a = *(const double *)side, small = 1e-9 * a;
    return x[0] < small || x[0] > a - small || x[1] < small || x[1] > a - small;
}

static double part_area(const SceneMesh *mesh, int part)
{
    double area = 0.0;
    for (int e = 0; e < mesh->shell_count; e++) {
        double u[3], v[3];
        if (mesh->part[e] != part) continue;
        for (int k = 0; k < 3; k++) {
            u[k] = mesh->x[3 * mesh->shell[e][2] + k] - mesh->x[3 * mesh->shell[e][0] + k];
            v[k] = mesh->x[3 * mesh->shell[e][3] + k] - mesh->x[3 * mesh->shell[e][1] + k];
        }
        const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    return area;
}

static const double radius = 0.0825;

/* A sphere of 0.165 m, or a box of a head's size, above the cushion's middle. */
static void add_impactor(SceneMesh *mesh, bool box, int facets, double middle, double bottom)
{
    const double size[3] = {0.20, 0.15, 0.12};
    const int first = mesh->node_count;
    if (box)
        scene_add_box(mesh, PART_IMPACTOR, PART_IMPACTOR, PART_IMPACTOR, size[0], size[1], size[2]);
    else
        scene_add_sphere(mesh, PART_IMPACTOR, SCENE_QUADS, facets, radius);
    const double shift[3] = {middle - (box ? 0.5 * size[0] : 0.0), middle - (box ? 0.5 * size[1] : 0.0),
                             bottom + (box ? 0.0 : radius)};
    scene_transform(mesh, first, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, shift);
}

/* What the cushion meets: the sphere itself, or the faces of the impactor's shells. */
static void write_contact(SceneText *deck, SceneStriker striker, double middle, double bottom)
{
    if (striker != SCENE_SPHERE) {
        scene_print(deck, "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n");
        SCENE_CARD(deck, 1, PART_IMPACTOR, 2, 3);
        SCENE_CARD(deck, 0.3, 0.3);
        SCENE_CARD(deck, 1, 1, 0, striker == SCENE_BOX ? 0 : 1e-6);
        return;
    }
    scene_print(
        deck,
        "*CONTACT_ENTITY\n$ a sphere on the impactor meets nodes and 2 x 2 points in each shell of both panels\n");
    SCENE_CARD(deck, PART_IMPACTOR, 2, 1, 2, 1, 0, 0.3, 2);
    SCENE_CARD(deck, 0, 1e20, 0, 0, 1);
    SCENE_CARD(deck, 0, 0, 0, 1, 0, 0);
    SCENE_CARD(deck, 0, 1, 0);
    SCENE_CARD(deck, 0, middle, middle, bottom + radius, radius);
}

void scene_impactor(Scene *scene, int n, SceneStriker striker, int facets)
{
    const double side = 0.6, height = 0.16, bottom = 2.0 * height + 0.24, mass = 6.8, speed = 4.0;
    const bool box = striker == SCENE_BOX;
    SceneText *deck = &scene->deck;
    if (n <= 0) n = 24;
    if (facets <= 0) facets = 6;
    scene_add_rectangle(&scene->mesh, PART_TOP, SCENE_QUADS, n, n, side, side);
    scene_transform(&scene->mesh, 0, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[]){0, 0, height});
    scene_sew_copy(&scene->mesh, PART_BOTTOM, select_edge, &side);
    add_impactor(&scene->mesh, box, facets, 0.5 * side, bottom);

    scene_begin(deck, box ? "box of a head's size drops on a vented cushion" : "sphere drops on a vented cushion",
                0.200, 0.9);
    scene_write_output(deck, 5e-4, 5e-4, 5e-3);
    scene_print(deck, "*DATABASE_RBDOUT\n");
    SCENE_CARD(deck, 1e-4);
    SceneFabric fabric = scene_isotropic(2, true, 800, 3e8, 0.3);
    fabric.damp = 0.05;
    scene_write_part(deck, PART_TOP, 1, 1, "upper panel");
    scene_write_part(deck, PART_BOTTOM, 1, 1, "lower panel");
    scene_write_part(deck, PART_IMPACTOR, 2, 2, "impactor");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_section(deck, 2, 9, 2e-3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, mass / (2e-3 * part_area(&scene->mesh, PART_IMPACTOR)), 0, 0);
    scene_write_part_set(deck, 1, 2, (const int[]){PART_TOP, PART_BOTTOM});
    scene_print(deck, "$ cold air: 0.0546 kg in 33 ms; the vents open when the impactor presses\n");
    scene_write_curve(deck, 1, 5, (const double[]){0, 0, 0.005, 1.95, 0.028, 1.95, 0.033, 0, 1, 0});
    SceneGas gas = scene_air(101325, 293.15);
    gas.inflow_curve = 1;
    gas.inflow_temperature = 293.15;
    gas.vent_coefficient = 0.7;
    gas.vent_area = 2e-3;
    gas.pop_pressure = 7000;
    scene_write_wang_nefske(deck, 1, &gas);
    scene_print(deck, "$ the fabric is at rest when the impactor comes\n");
    scene_write_curve(deck, 2, 4, (const double[]){0, 150, 0.055, 150, 0.06, 0, 1, 0});
    for (int part = PART_TOP; part <= PART_BOTTOM; part++) {
        scene_print(deck, "*DAMPING_PART_MASS\n");
        SCENE_CARD(deck, part, 2, 1);
    }
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, PART_IMPACTOR, 0, 0, -speed);
    scene_print(deck, "*RIGIDWALL_PLANAR_ID\n         1floor\n         0\n");
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 1, 0.3);
    write_contact(deck, striker, 0.5 * side, bottom);
    scene_end(deck, &scene->mesh);
}
