/* One square under an imposed plane deformation that follows a path: for laws of materials given as deck text. */
#ifndef BILLOW_TESTS_AFFINE_PATCH_H
#define BILLOW_TESTS_AFFINE_PATCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "tests/verify.h"

typedef struct Plane {
    double xx, yy, xy;
} Plane;

/* Deformation gradient F11 F12 F21 F22 at a share of the run, 0 to 1. */
typedef void AffinePath(const void *user, double share, double f[4]);

typedef struct AffinePatch {
    ScenePattern pattern;
    bool one_point;
    const char *material; /* keywords that define material 1 and its curves (numbers from 100 on are free) */
    AffinePath *path;
    const void *user;
    int points;        /* of the path: straight between them; the last tenth of the run stays at the end */
    double last_share; /* of the path that is followed; 0: all */
    double step_scale; /* TSSFAC, 0: 0.8 */
} AffinePatch;

static const double affine_size = 0.1, affine_thickness = 3.5e-4, affine_end = 0.02;

typedef struct AffineKind {
    ScenePattern pattern;
    bool one_point;
} AffineKind;

static const AffineKind affine_kinds[] = {
    {SCENE_DIAGONAL, false}, {SCENE_ACROSS, false}, {SCENE_QUADS, false}, {SCENE_QUADS, true}};
enum { AFFINE_KINDS = 4 };

static inline void affine_write_node(SceneText *deck, const AffinePatch *patch, int node, const double *x)
{
    enum { MOST = 1024 };
    double pairs[2][2 * MOST];
    assert_true(patch->points + 2 <= MOST);
    double all = patch->last_share > 0 ? patch->last_share : 1;
    for (int i = 0; i <= patch->points; i++) {
        double share = (double)i / patch->points, f[4];
        patch->path(patch->user, all * share, f);
        for (int c = 0; c < 2; c++) {
            pairs[c][2 * i] = 0.9 * affine_end * share;
            pairs[c][2 * i + 1] = f[2 * c] * x[0] + f[2 * c + 1] * x[1] - x[c];
        }
    }
    for (int c = 0; c < 2; c++) {
        pairs[c][2 * patch->points + 2] = 2 * affine_end;
        pairs[c][2 * patch->points + 3] = pairs[c][2 * patch->points + 1];
        scene_write_curve(deck, 1000 + 2 * node + c, patch->points + 2, pairs[c]);
        scene_write_motion(deck, node, c + 1, 2, 1000 + 2 * node + c, 1);
    }
}

/* Runs it; the caller frees run. */
static inline void affine_run(const AffinePatch *patch, VerifyRun *run)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_add_rectangle(&scene.mesh, 1, patch->pattern, 1, 1, affine_size, affine_size);
    scene_begin(deck, "affine patch", affine_end, patch->step_scale > 0 ? patch->step_scale : 0.8);
    scene_write_part(deck, 1, 1, 1, "patch");
    scene_write_section(deck, 1, 9, affine_thickness);
    scene_print(deck, "%s", patch->material);
    scene_write_node_set(deck, 1, &scene.mesh, scene_select_all, NULL);
    scene_write_spc(deck, 1, false, false, true);
    for (int i = 0; i < scene.mesh.node_count; i++) affine_write_node(deck, patch, i + 1, scene.mesh.x + 3 * i);
    scene_end(deck, &scene.mesh);
    verify_scene(run, &scene, &(VerifyOptions){.one_point = patch->one_point});
}

/* Second Piola-Kirchhoff stress in global axes of the run's first element, whose Cauchy stress is over the reference
 * thickness (thins: over the current one). All elements must agree. */
static inline Plane affine_stress(const VerifyRun *run, const double f[4], bool thins)
{
    double det = f[0] * f[3] - f[1] * f[2], j = thins ? 1 : det;
    const double a = f[3] / det, b = -f[1] / det, c = -f[2] / det, d = f[0] / det;
    Plane first = {0};
    for (int e = 0; e < run->model.element_count; e++) {
        ElementResult r = verify_element(run, e);
        double xx = j * r.stress[0], yy = j * r.stress[1], xy = j * r.stress[3];
        Plane s = {a * a * xx + 2 * a * b * xy + b * b * yy, c * c * xx + 2 * c * d * xy + d * d * yy,
                   a * c * xx + (a * d + b * c) * xy + b * d * yy};
        if (e == 0) first = s;
        double size = fabs(first.xx) + fabs(first.yy) + fabs(first.xy);
        assert_true(fabs(s.xx - first.xx) + fabs(s.yy - first.yy) + fabs(s.xy - first.xy) <= 1e-11 * size);
    }
    return first;
}

static inline void affine_check(const char *name, Plane s, Plane expected, double tolerance)
{
    double size = fabs(expected.xx) + fabs(expected.yy) + fabs(expected.xy);
    double error = fmax(fabs(s.xx - expected.xx), fmax(fabs(s.yy - expected.yy), fabs(s.xy - expected.xy)));
    if (!(error <= tolerance * size))
        fail_msg("%s: stress %.15g %.15g %.15g, expected %.15g %.15g %.15g, off by %.2g", name, s.xx, s.yy, s.xy,
                 expected.xx, expected.yy, expected.xy, error / size);
}

/* A straight way from the unit tensor to F (user: double[4]). */
static inline void affine_straight(const void *user, double share, double f[4])
{
    const double *end = user, one[4] = {1, 0, 0, 1};
    for (int i = 0; i < 4; i++) f[i] = one[i] + share * (end[i] - one[i]);
}

/* The same in the first tenth, then ten turns about z on chords of 1/72 turn: 800 points. */
static inline void affine_spinning(const void *user, double share, double f[4])
{
    double s[4], angle = fmax(share - 0.1, 0) / 0.9 * 20 * 3.14159265358979323846, c = cos(angle), n = sin(angle);
    affine_straight(user, fmin(10 * share, 1), s);
    f[0] = c * s[0] - n * s[2];
    f[1] = c * s[1] - n * s[3];
    f[2] = n * s[0] + c * s[2];
    f[3] = n * s[1] + c * s[3];
}

#endif
