/* A sphere that drops on a vented cushion: its smooth shape against fine facets, which come to the same. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

enum { MOST = 400 };

/* The impactor every half millisecond. */
typedef struct Drop {
    double z[MOST], v[MOST], peak; /* peak: largest mean acceleration over 3 ms */
    int count;
} Drop;

static void watch(void *user, const Model *model, const State *state, const StepView *view)
{
    Drop *d = user;
    (void)model;
    (void)view;
    if (d->count == MOST || state->clock->time < 5e-4 * d->count) return;
    d->z[d->count] = state->rigid[0].output.x[2];
    d->v[d->count++] = state->rigid[0].output.v[2];
}

static void drop(SceneStriker striker, int facets, Drop *d)
{
    Scene scene = {0};
    VerifyRun run;
    scene_impactor(&scene, 0, striker, facets);
    *d = (Drop){0};
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .stop_time = 0.15, .probe = watch, .user = d});
    for (int i = 6; i < d->count; i++) d->peak = fmax(d->peak, (d->v[i] - d->v[i - 6]) / 3e-3);
    print_message("    6 x %d x %d shells%s: 3 ms %.2f m/s2, %.5f m at the end; energy %.4f to %.4f, %ld cycles\n",
                  facets, facets, striker == SCENE_SPHERE ? " with a smooth sphere" : "", d->peak, d->z[d->count - 1],
                  run.state.energy->ratio_min, run.state.energy->ratio_max, (long)run.cycles);
    verify_near("energy ratio", run.state.energy->ratio_min, 1, 2e-3);
    verify_near("energy ratio", run.state.energy->ratio_max, 1, 2e-3);
    verify_free(&run);
}

static double farthest(const Drop *a, const Drop *b)
{
    double most = 0;
    for (int i = 0; i < a->count && i < b->count; i++) most = fmax(most, fabs(a->z[i] - b->z[i]));
    return most;
}

static void same_as_fine_facets(void **state)
{
    (void)state;
    static Drop smooth, fine;
    drop(SCENE_SPHERE, 6, &smooth);
    drop(SCENE_FACETED_SPHERE, 18, &fine);
    verify_near("places of the impactor apart [m], of a way of 0.43 m", farthest(&smooth, &fine), 0, 1e-3);
    verify_close("largest mean acceleration over 3 ms", smooth.peak, fine.peak, 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_as_fine_facets)};
    return cmocka_run_group_tests_name("drop of a smooth sphere", tests, NULL, NULL);
}
