/* Scene: an impactor drops onto a vented cushion that lies on the floor. SI units. */
#include "examples/scene.h"

#include <math.h>
#include <stdio.h>

#include "solver/elementary.h"

#define PI 3.14159265358979323846

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

static const double radius = 0.0825, capsule_radius = 0.06, capsule_half = 0.04;

static bool is_box(SceneStriker striker)
{
    return striker == SCENE_BOX || striker == SCENE_BOX_MESH;
}

static bool is_capsule(SceneStriker striker)
{
    return striker == SCENE_CAPSULE || striker == SCENE_CAPSULE_PROFILE;
}

/* From the lowest point of a round impactor to its middle. */
static double middle_height(SceneStriker striker)
{
    return is_capsule(striker) ? capsule_radius : radius;
}

/* A sphere of 0.165 m, a box of a head's size, or a lying capsule as long as the box, above the cushion's middle. */
static void add_impactor(SceneMesh *mesh, SceneStriker striker, int facets, double middle, double bottom)
{
    const double size[3] = {0.20, 0.15, 0.12};
    const int first = mesh->node_count;
    const bool box = is_box(striker);
    if (box)
        scene_add_box(mesh, PART_IMPACTOR, PART_IMPACTOR, PART_IMPACTOR, size[0], size[1], size[2]);
    else
        scene_add_sphere(mesh, PART_IMPACTOR, SCENE_QUADS, facets, middle_height(striker));
    for (int i = first; i < mesh->node_count && is_capsule(striker); i++) {
        double *x = mesh->x + 3 * i;
        if (fabs(x[0]) > 1e-9) x[0] += x[0] > 0 ? capsule_half : -capsule_half;
    }
    const double shift[3] = {middle - (box ? 0.5 * size[0] : 0.0), middle - (box ? 0.5 * size[1] : 0.0),
                             bottom + (box ? 0.0 : middle_height(striker))};
    scene_transform(mesh, first, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, shift);
}

/* A shape on the impactor that meets nodes and 2 x 2 points in each shell of both panels; its third axis along z or, if
 * it lies, along x. g: the coefficients' count and values. */
static void write_entity(SceneText *deck, int shape, const double centre[3], bool lies, int count, const double *g)
{
    scene_print(deck, "*CONTACT_ENTITY\n");
    SCENE_CARD(deck, PART_IMPACTOR, shape, 1, 2, 1, 0, 0.3, 2);
    SCENE_CARD(deck, 0, 1e20, 0, 0, 1);
    SCENE_CARD(deck, centre[0], centre[1], centre[2], lies ? 0 : 1, lies ? 1 : 0, 0);
    SCENE_CARD(deck, 0, lies ? 0 : 1, lies ? 1 : 0);
    double fields[8] = {0};
    for (int k = 0; k < count; k++) fields[k + 1] = g[k];
    scene_card(deck, count + 1, fields);
}

/* The outline of the capsule: the tube alone, or with its round ends by many points. */
static void write_outline(SceneText *deck, bool ends)
{
    enum { ROUND = 60 };
    double points[2 * (2 * ROUND + 2)];
    int count = 0;
    for (int end = 0; end < 2; end++)
        for (int i = 0; i <= (ends ? ROUND : 0); i++) {
            double angle = 0.5 * PI * (ends ? (double)(end == 0 ? ROUND - i : i) / ROUND : 0.0);
            bool tip = ends && i == (end == 0 ? 0 : ROUND);
            points[count++] = (end == 0 ? -1 : 1) * (capsule_half + capsule_radius * elementary_sin(angle));
            points[count++] = tip ? 0.0 : capsule_radius * elementary_cos(angle);
        }
    scene_write_curve(deck, 3, count / 2, points);
}

static void write_capsule(SceneText *deck, SceneStriker striker, const double centre[3])
{
    write_outline(deck, striker == SCENE_CAPSULE_PROFILE);
    scene_print(deck, "$ a %s meets nodes and 2 x 2 points in each shell of both panels\n",
                striker == SCENE_CAPSULE ? "tube with a sphere on each end" : "capsule by its outline");
    write_entity(deck, 11, centre, true, 1, (const double[]){3});
    for (int end = -1; end <= 1 && striker == SCENE_CAPSULE; end += 2)
        write_entity(deck, 2, centre, true, 4, (const double[]){0, 0, end * capsule_half, capsule_radius});
}

/* What the cushion meets: smooth shapes, the mesh as one convex body, or the faces of the impactor's shells. */
static void write_contact(SceneText *deck, SceneStriker striker, double middle, double bottom)
{
    const double centre[3] = {middle, middle, bottom + middle_height(striker)}, none[3] = {0, 0, 0};
    if (is_capsule(striker)) {
        write_capsule(deck, striker, centre);
    } else if (striker == SCENE_BOX_MESH) {
        write_entity(deck, 9, none, false, 0, none);
    } else if (striker == SCENE_SPHERE) {
        scene_print(deck, "$ a sphere on the impactor meets nodes and 2 x 2 points in each shell of both panels\n");
        write_entity(deck, 2, none, false, 4, (const double[]){centre[0], centre[1], centre[2], radius});
    } else {
        scene_print(deck, "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n");
        SCENE_CARD(deck, 1, PART_IMPACTOR, 2, 3);
        SCENE_CARD(deck, 0.3, 0.3);
        SCENE_CARD(deck, 1, 1, 0, striker == SCENE_BOX ? 0 : 1e-6);
    }
}

void scene_impactor(Scene *scene, int n, SceneStriker striker, int facets)
{
    const double side = 0.6, height = 0.16, bottom = 2.0 * height + 0.24, mass = 6.8, speed = 4.0;
    static const char *const titles[] = {"box of a head's size", "sphere", "sphere", "capsule", "capsule",
                                         "box of a head's size"};
    char title[80];
    snprintf(title, sizeof title, "%s drops on a vented cushion", titles[striker]);
    SceneText *deck = &scene->deck;
    if (n <= 0) n = 24;
    if (facets <= 0) facets = 6;
    scene_add_rectangle(&scene->mesh, PART_TOP, SCENE_QUADS, n, n, side, side);
    scene_transform(&scene->mesh, 0, (const double[]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[]){0, 0, height});
    scene_sew_copy(&scene->mesh, PART_BOTTOM, select_edge, &side);
    add_impactor(&scene->mesh, striker, facets, 0.5 * side, bottom);

    scene_begin(deck, title, 0.200, 0.9);
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
