/* How fast groups of nodes close and when a pair of them wakes, against all pairs of their nodes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "contact/motion_kernels.h"
#include "elements/kernels.h"
#include "solver/vector3.h"
#include "tests/next_number.h"

enum { GROUPS = 14, EACH = 7, NODES = GROUPS * EACH, PAIRS = GROUPS - 1, ROUNDS = 500 };

/* Groups of the nodes in their order. */
typedef struct Scene {
    double v[3 * NODES];
    int32_t node[NODES], start[GROUPS + 1];
    ContactSpeeds speeds[GROUPS];
    unsigned char watched[GROUPS];
    ContactGroups groups;
} Scene;

/* Each group has a velocity of its own that is larger than what its nodes differ by: signs and axes tell. */
static void fill_scene(Scene *scene, int round)
{
    for (int g = 0; g <= GROUPS; g++) scene->start[g] = g * EACH;
    for (int g = 0; g < GROUPS; g++) {
        double mean[3];
        for (int k = 0; k < 3; k++) mean[k] = (k == round % 3 ? 20.0 : 3.0) * next_number();
        for (int n = g * EACH; n < (g + 1) * EACH; n++) {
            scene->node[n] = n;
            for (int k = 0; k < 3; k++) scene->v[3 * n + k] = mean[k] + 0.5 * next_number();
        }
        scene->watched[g] = 1;
    }
    scene->groups = (ContactGroups){.count = GROUPS,
                                    .start = scene->start,
                                    .node = scene->node,
                                    .speeds = scene->speeds,
                                    .watched = scene->watched};
}

/* Of two groups: the largest speed of a node against another, and the length of the largest components. */
static void compare_groups(const Scene *scene, int g, int h, double *fastest, double *most)
{
    double largest[3] = {0.0, 0.0, 0.0}, best = 0.0, apart[3];
    for (int i = g * EACH; i < (g + 1) * EACH; i++)
        for (int j = h * EACH; j < (h + 1) * EACH; j++) {
            vector3_subtract(scene->v + 3 * (ptrdiff_t)i, scene->v + 3 * (ptrdiff_t)j, apart);
            for (int k = 0; k < 3; k++) largest[k] = fmax(largest[k], fabs(apart[k]));
            best = fmax(best, vector3_norm(apart));
        }
    *fastest = best;
    *most = vector3_norm(largest);
}

/* Group 0 watches the others. Returns how many are awake. */
static int check_round(const MotionKernels *kernels, Scene *scene)
{
    const ContactWatch watch = {.own = &scene->groups,
                                .others = &scene->groups,
                                .before = 0.01f,
                                .longer = 0.012f,
                                .least = 0.1f,
                                .deepest = 0.02f};
    int32_t other[CONTACT_GROUP];
    float slack[CONTACT_GROUP], given[CONTACT_GROUP];
    _Alignas(64) float speed[CONTACT_GROUP];
    for (int k = 0; k < PAIRS; k++) {
        other[k] = 1 + k;
        slack[k] = given[k] = 0.8f + 0.6f * (float)next_number();
    }
    slack[PAIRS] = 7.0f;
    kernels->follow(&scene->groups, scene->v, 0, GROUPS);
    unsigned awake = kernels->wake(&watch, other, slack, PAIRS, speed);
    assert_int_equal(awake >> PAIRS, 0);
    assert_true(slack[PAIRS] == 7.0f);
    for (int k = 0; k < PAIRS; k++) {
        double fastest, most, way;
        compare_groups(scene, 0, other[k], &fastest, &most);
        assert_true(speed[k] >= fastest && speed[k] >= most);
        assert_true(speed[k] <= most * (1.0 + 1e-4));
        assert_true(slack[k] <= given[k] - fastest * 0.01);
        assert_true(fabs(slack[k] - (given[k] - most * 0.01)) < 1e-3);
        way = contact_ahead(most * 0.012, 0.1) + 0.02;
        if (fabs(slack[k] - way) > 1e-4) assert_int_equal(awake >> k & 1, slack[k] <= way);
    }
    return __builtin_popcount(awake);
}

static void pairs_that_wake(void **state)
{
    (void)state;
    const char *name[] = {"v2", "v3", "v4"};
    const MotionKernels *kernels[] = {&motion_kernels_v2, &motion_kernels_v3, &motion_kernels_v4};
    for (int s = 0; s < 3; s++) {
        int awake = 0;
        if (!kernels_select(name[s])) continue;
        for (int round = 0; round < ROUNDS; round++) {
            Scene scene;
            memset(&scene, 0, sizeof scene);
            fill_scene(&scene, round);
            awake += check_round(kernels[s], &scene);
        }
        assert_true(awake > ROUNDS && awake < (PAIRS - 1) * ROUNDS);
    }
}

/* A group that nobody watches keeps the velocity it had. */
static void unwatched(void **state)
{
    (void)state;
    Scene scene;
    memset(&scene, 0, sizeof scene);
    fill_scene(&scene, 0);
    scene.watched[3] = 0;
    motion_kernels_v2.follow(&scene.groups, scene.v, 0, GROUPS);
    for (int k = 0; k < 3; k++) assert_true(scene.speeds[3].up[k] == 0.0f && scene.speeds[4].up[k] != 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pairs_that_wake), cmocka_unit_test(unwatched)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
