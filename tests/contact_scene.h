/* Sheets of fabric that meet: scenes for the tests of contact. */
#ifndef BILLOW_TESTS_CONTACT_SCENE_H
#define BILLOW_TESTS_CONTACT_SCENE_H

#include "examples/scene.h"

/* A *CONTACT card; zero members mean the card's default. */
typedef struct SceneContact {
    const char *keyword; /* without *CONTACT_ */
    int a, b, a_type, b_type;
    double fs, fd, dc, vdc, birth, death;
    double sst, mst;
    double soft, sofscl; /* card A is written if soft or sofscl is given */
} SceneContact;

static inline void scene_write_contact(SceneText *deck, const SceneContact *c)
{
    scene_print(deck, "*CONTACT_%s\n", c->keyword);
    SCENE_CARD(deck, c->a, c->b, c->a_type, c->b_type);
    SCENE_CARD(deck, c->fs, c->fd, c->dc, 0, c->vdc, 0, c->birth, c->death);
    SCENE_CARD(deck, 0, 0, c->sst, c->mst);
    if (c->soft > 0 || c->sofscl > 0) SCENE_CARD(deck, c->soft, c->sofscl);
}

/* A *CONTACT_ENTITY; a and b zero: along the global axes. */
typedef struct SceneEntity {
    int part, shape, set, set_type;
    double scale, damping, friction, g[7];
    int order, thick, inside;
    double centre[3], a[3], b[3];
} SceneEntity;

static inline void scene_write_entity(SceneText *deck, const SceneEntity *e)
{
    scene_print(deck, "*CONTACT_ENTITY\n");
    SCENE_CARD(deck, e->part, e->shape, e->set, e->set_type, e->scale, e->damping, e->friction, e->order);
    SCENE_CARD(deck, 0, 0, 0, 0, e->thick);
    SCENE_CARD(deck, e->centre[0], e->centre[1], e->centre[2], e->a[0], e->a[1], e->a[2]);
    SCENE_CARD(deck, e->b[0], e->b[1], e->b[2]);
    SCENE_CARD(deck, e->inside, e->g[0], e->g[1], e->g[2], e->g[3], e->g[4], e->g[5], e->g[6]);
}

/* Initial velocity of all nodes [first, end). */
static inline void scene_write_speed(SceneText *deck, int first, int end, double vx, double vy, double vz)
{
    scene_print(deck, "*INITIAL_VELOCITY_NODE\n");
    for (int i = first; i < end; i++) SCENE_CARD(deck, i + 1, vx, vy, vz);
}

/* A rectangle nx x ny, lx x ly with its first corner at (x, y, z). Returns its first node. */
static inline int scene_add_sheet(SceneMesh *mesh, int part, ScenePattern pattern, int nx, int ny, double lx, double ly,
                                  double x, double y, double z)
{
    const double same[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, shift[3] = {x, y, z};
    int first = mesh->node_count;
    scene_add_rectangle(mesh, part, pattern, nx, ny, lx, ly);
    scene_transform(mesh, first, same, shift);
    return first;
}

/* Sheets that crumple on a plate: self-contact with friction and damping, many searches. */
static inline void scene_crumple(Scene *scene)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    for (int i = 0; i < 3; i++)
        scene_add_sheet(mesh, 1, i == 1 ? SCENE_QUADS : SCENE_DIAGONAL, 9, 8, 0.09, 0.08, 0.003 * i, 0.001 * i,
                        0.004 * i);
    const int sheets = mesh->node_count;
    scene_add_sheet(mesh, 2, SCENE_QUADS, 3, 3, 0.2, 0.2, -0.05, -0.05, -0.002);
    scene_begin(deck, "contact", 1, 0.9);
    scene_write_part(deck, 1, 1, 1, "sheets");
    scene_write_part(deck, 2, 1, 2, "plate");
    scene_write_rigid(deck, 2, 7800, 7, 7);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_gravity(deck, 1, 5000);
    scene_write_section(deck, 1, 9, 3e-4);
    SceneFabric fabric = scene_isotropic(0, true, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_print(deck, "*INITIAL_VELOCITY_NODE\n");
    for (int i = 0; i < sheets; i++) {
        const double *x = mesh->x + 3 * i;
        SCENE_CARD(deck, i + 1, -30 * x[0], 20 * (0.04 - x[1]), 2.0 * (i % 7 - 3) - 200 * x[2]);
    }
    scene_write_contact(
        deck, &(SceneContact){
                  .keyword = "AUTOMATIC_SINGLE_SURFACE", .a_type = 5, .fs = 0.3, .fd = 0.1, .dc = 0.1, .vdc = 10});
    scene_end(deck, mesh);
}

/* A patch that falls on a spinning body of smooth shapes, rubs on it and folds over it: contact entities with points
 * within the elements, beside self-contact if wanted. */
static inline void scene_drape(Scene *scene, bool self)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_sphere(mesh, 2, SCENE_QUADS, 3, 0.02);
    int patch = scene_add_sheet(mesh, 1, SCENE_DIAGONAL, 20, 20, 0.1, 0.1, -0.047, -0.052, 0.031);
    scene_begin(deck, "drape", 1, 0.9);
    scene_write_part(deck, 1, 1, 1, "patch");
    scene_write_part(deck, 2, 1, 2, "body");
    scene_write_section(deck, 1, 9, 3e-4);
    SceneFabric fabric = scene_isotropic(2, true, 800, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, 400, 0, 0);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, 2, 0, 0, 0, 500, -700, 900);
    scene_write_speed(deck, patch, mesh->node_count, 1, 0, -20);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_print(deck, "*LOAD_GRAVITY_PART\n1,3,1,1e5\n");
    scene_write_entity(deck, &(SceneEntity){.part = 2,
                                            .shape = 4,
                                            .set = 1,
                                            .set_type = 1,
                                            .friction = 0.3,
                                            .damping = 80,
                                            .order = 2,
                                            .thick = 1,
                                            .g = {0, 0, 0, 0.02, 0.03, 0.03}});
    scene_write_entity(deck, &(SceneEntity){.part = 2, .shape = 2, .set = 1, .set_type = 1, .g = {0.03, 0, 0, 0.015}});
    if (self)
        scene_write_contact(
            deck, &(SceneContact){.keyword = "AUTOMATIC_SINGLE_SURFACE", .a = 1, .a_type = 3, .fs = 0.2, .fd = 0.2});
    scene_end(deck, mesh);
}

/* Mean velocity of the nodes [first, end). */
static inline double mean_speed(const VerifyRun *run, int first, int end, int axis)
{
    double sum = 0, mass = 0;
    for (int i = first; i < end; i++) {
        double m = run->model.mass[run->model.deck_node[i]];
        sum += m * run->v[3 * i + axis];
        mass += m;
    }
    return sum / mass;
}

#endif
