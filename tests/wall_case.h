/* Scenes for the tests of rigid walls: loose masses (patches of null shells), a wall, and what becomes of them. */
#ifndef BILLOW_TESTS_WALL_CASE_H
#define BILLOW_TESTS_WALL_CASE_H

#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

/* What a probe sums over the recorded cycles of one run. */
typedef struct WallRecord {
    double impulse[3], normal; /* of the first wall: sum of force x dt_m [force x time] */
    double force[3];           /* of the last cycle */
    double lowest[3];          /* smallest x, y, z of all nodes */
    double momentum[3];        /* of the nodes at the last cycle */
    double mass;
    double wall_momentum; /* of the walls with mass, along their normals */
    double before;        /* step before the present cycle */
} WallRecord;

static inline void wall_probe(void *user, const Model *model, const State *state, const StepView *view)
{
    WallRecord *record = user;
    double mean = 0.5 * (state->clock->step + state->clock->step_next);
    for (int k = 0; k < 3; k++) {
        record->momentum[k] = 0;
        record->force[k] = model->wall_count > 0 ? view->wall_force[k] : 0;
        record->impulse[k] += mean * record->force[k];
    }
    record->normal += model->wall_count > 0 ? mean * view->wall_force[3] : 0;
    record->mass = record->wall_momentum = 0;
    for (int i = 0; i < model->node_count; i++) {
        record->mass += model->mass[i];
        for (int k = 0; k < 3; k++) {
            record->momentum[k] += model->mass[i] * state->v[3 * i + k];
            record->lowest[k] = fmin(record->lowest[k], view->x[3 * i + k]);
        }
    }
    for (int i = 0; i < model->wall_count; i++) record->wall_momentum += model->walls[i].mass * state->wall[i].speed;
}

/* The deck's beginning: null shells of part 1 with the mass per area 4, so that a square of side 1 has four nodes of
 * mass 1. */
static inline void wall_begin(Scene *scene, double end_time)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "masses and walls", end_time, 0);
    scene_write_part(deck, 1, 1, 1, "masses");
    scene_write_section(deck, 1, 9, 1);
    scene_write_null(deck, 1, 4);
}

/* A square of side 1 in a plane z, its first corner at x, y. */
static inline void wall_add_square(Scene *scene, double x, double y, double z)
{
    SceneMesh *mesh = &scene->mesh;
    int a = scene_add_node(mesh, x, y, z), b = scene_add_node(mesh, x + 1, y, z);
    int c = scene_add_node(mesh, x + 1, y + 1, z), d = scene_add_node(mesh, x, y + 1, z);
    scene_add_shell(mesh, 1, a, b, c, d);
}

/* *INITIAL_VELOCITY of all nodes. */
static inline void wall_write_velocity(SceneText *deck, double x, double y, double z)
{
    scene_print(deck, "*INITIAL_VELOCITY\n");
    SCENE_CARD(deck, 0, 0, 0, 0);
    SCENE_CARD(deck, x, y, z, 0, 0, 0);
}

static inline void wall_write_gravity(SceneText *deck, double g)
{
    scene_write_curve(deck, 99, 2, (const double[]){0, 1, 1, 1});
    scene_write_gravity(deck, 99, g);
}

/* *RIGIDWALL_PLANAR<options> through a point; further cards are the caller's. */
static inline void wall_write_plane(SceneText *deck, const char *options, const double point[3], const double normal[3],
                                    double friction, double weld_speed)
{
    scene_print(deck, "*RIGIDWALL_PLANAR%s\n", options);
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0, 0);
    SCENE_CARD(deck, point[0], point[1], point[2], point[0] + normal[0], point[1] + normal[1], point[2] + normal[2],
               friction, weld_speed);
}

/* Ends the deck and runs it, all cycles recorded. */
static inline void wall_run(VerifyRun *run, Scene *scene, WallRecord *record, int threads)
{
    *record = (WallRecord){0};
    scene_end(&scene->deck, &scene->mesh);
    verify_scene(run, scene, &(VerifyOptions){.every = 1, .threads = threads, .probe = wall_probe, .user = record});
}

static inline double wall_imbalance(const VerifyRun *run)
{
    const VerifySample *last = &run->samples[run->count - 1];
    return fabs(last->held - last->given) / run->energy;
}

#endif
