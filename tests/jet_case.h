/* Jets in a duct with rigid walls: the force on them. */
#ifndef BILLOW_TESTS_JET_CASE_H
#define BILLOW_TESTS_JET_CASE_H

#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

static const double OUTLET = 539.320861; /* m/s: nitrogen of 700 K */

/* The walls of the duct 0 <= x <= a, 0 <= y <= b, 0 <= z <= c on grids, normals outwards, welded: floor part 1, roof
 * (z = c) part 2, sides part 3. */
typedef struct Wall {
    double origin[3], s[3], t[3];
} Wall;

static inline void map_wall(const void *user, double s, double t, double x[3])
{
    const Wall *wall = user;
    for (int k = 0; k < 3; k++) x[k] = wall->origin[k] + s * wall->s[k] + t * wall->t[k];
}

static inline void add_duct(SceneMesh *mesh, const double size[3], const int count[3])
{
    double a = size[0], b = size[1], c = size[2];
    const Wall walls[6] = {{{0, 0, 0}, {0, b, 0}, {a, 0, 0}}, {{0, 0, c}, {a, 0, 0}, {0, b, 0}},
                           {{0, 0, 0}, {a, 0, 0}, {0, 0, c}}, {{0, b, 0}, {0, 0, c}, {a, 0, 0}},
                           {{0, 0, 0}, {0, 0, c}, {0, b, 0}}, {{a, 0, 0}, {0, b, 0}, {0, 0, c}}};
    const int grid[6][2] = {{1, 0}, {0, 1}, {0, 2}, {2, 0}, {2, 1}, {1, 2}}, part[6] = {1, 2, 3, 3, 3, 3};
    for (int i = 0; i < 6; i++)
        scene_add_grid(mesh, part[i], SCENE_QUADS, count[grid[i][0]], count[grid[i][1]], map_wall, &walls[i]);
    scene_weld(mesh, 0, 1e-7);
}

/* Bag of nitrogen at rest with 1 kg/s of 700 K flowing in; options of the keyword and its jet cards. */
static inline void write_bag(SceneText *deck, const char *options, const char *knkdn, const char *cards)
{
    double r = 8.314462618 / 0.0280134;
    scene_print(deck, "*AIRBAG_WANG_NEFSKE%s\n", options);
    SCENE_CARD(deck, 1, 1, 0, 1, 1, 0, 0, 0);
    SCENE_CARD(deck, 2.5 * r, 3.5 * r, 700, 0, 31, 0, 0, 300);
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0, 0, 0);
    scene_print(deck, "101325.,1.2,1.,0,0,0,0,%s\n", knkdn);
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0);
    scene_print(deck, "%s", cards);
    scene_write_curve(deck, 31, 2, (const double[]){0, 1, 1, 1});
}

static inline void write_rigid_parts(SceneText *deck, double end)
{
    scene_begin(deck, "jet", end, 0.9);
    scene_write_section(deck, 1, 9, 1e-3);
    for (int p = 1; p <= 3; p++) {
        scene_write_part(deck, p, 1, p, "wall");
        scene_write_rigid(deck, p, 1000, 7, 7);
    }
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
}

static inline void keep_state(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)model;
    (void)view;
    memcpy(user, state->jet[0].force, sizeof state->jet[0].force);
}

/* Force of the jet on the duct's walls: bag is the text of the *AIRBAG keyword with its curves. */
static inline void run_bag(VerifyRun *run, double force[3], const char *bag, int n)
{
    Scene scene = {0};
    add_duct(&scene.mesh, (const double[3]){0.36, 0.36, 0.35}, (const int[3]){n, n, 8});
    write_rigid_parts(&scene.deck, 1e-3);
    scene_print(&scene.deck, "%s", bag);
    scene_end(&scene.deck, &scene.mesh);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1, .probe = keep_state, .user = force});
}

static inline void run_duct(VerifyRun *run, double force[3], const char *options, const char *cards, const char *more,
                            int n)
{
    SceneText text = {0};
    write_bag(&text, options, "0", cards);
    scene_print(&text, "%s", more);
    run_bag(run, force, text.text, n);
    scene_text_free(&text);
}

#endif
