/* Scenes: membranes under a static pressure, run to rest with mass damping (references A1, A10, A11, A14). */
#include "examples/scene.h"

void scene_free(Scene *scene)
{
    scene_text_free(&scene->deck);
    scene_mesh_free(&scene->mesh);
}

bool scene_ok(const Scene *scene)
{
    return !scene->deck.failed && !scene->mesh.failed && scene->deck.text;
}

enum { SET_PRESSURE = 1, SET_RIM, SET_CENTRE, SET_X, SET_Y, SET_SEAM_X, SET_SEAM_Y };

static void write_static(Scene *scene, const SceneStatic *setup, const char *title)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, title, setup->end, 0.9);
    scene_write_part(deck, 1, 1, 1, "membrane");
    scene_write_section(deck, 1, setup->elform, setup->thickness);
    scene_write_fabric(deck, 1, &setup->fabric);
    scene_write_ramp(deck, 1, setup->rise, 1);
    scene_write_pressure(deck, SET_PRESSURE, &scene->mesh, 0, 1, setup->pressure);
    scene_write_damping(deck, 0, setup->damping);
}

static bool select_axis(const void *radius, const double x[3])
{
    double r = *(const double *)radius * 1e-9;
    return x[0] * x[0] + x[1] * x[1] < r * r;
}

void scene_static_disc(Scene *scene, const SceneStatic *setup)
{
    scene_add_disc(&scene->mesh, 1, setup->pattern, setup->n, setup->size);
    write_static(scene, setup, "clamped disc under pressure");
    scene_write_node_set(&scene->deck, SET_RIM, &scene->mesh, scene_select_radius, &setup->size);
    scene_write_spc(&scene->deck, SET_RIM, true, true, true);
    scene_end(&scene->deck, &scene->mesh);
}

void scene_static_bag(Scene *scene, const SceneStatic *setup)
{
    scene_add_disc(&scene->mesh, 1, setup->pattern, setup->n, setup->size);
    write_static(scene, setup, "half of a bag of two discs under pressure");
    scene_write_node_set(&scene->deck, SET_RIM, &scene->mesh, scene_select_radius, &setup->size);
    scene_write_spc(&scene->deck, SET_RIM, false, false, true);
    scene_write_node_set(&scene->deck, SET_CENTRE, &scene->mesh, select_axis, &setup->size);
    scene_write_spc(&scene->deck, SET_CENTRE, true, true, false);
    scene_end(&scene->deck, &scene->mesh);
}

static void write_plane(Scene *scene, int set, int axis, double value, double size, bool fix_z)
{
    ScenePlane plane = {axis, value, 1e-9 * size};
    scene_write_node_set(&scene->deck, set, &scene->mesh, scene_select_plane, &plane);
    scene_write_spc(&scene->deck, set, axis == 0 && !fix_z, axis == 1 && !fix_z, fix_z);
}

void scene_static_square(Scene *scene, const SceneStatic *setup)
{
    double size = setup->size;
    scene_add_rectangle(&scene->mesh, 1, setup->pattern, setup->n, setup->n, size, size);
    write_static(scene, setup, "quarter of the upper half of a square cushion under pressure");
    write_plane(scene, SET_X, 0, 0, size, false);
    write_plane(scene, SET_Y, 1, 0, size, false);
    write_plane(scene, SET_SEAM_X, 0, size, size, true);
    write_plane(scene, SET_SEAM_Y, 1, size, size, true);
    scene_end(&scene->deck, &scene->mesh);
}
