/* Impactors that drop on a vented cushion, each by two descriptions of its shape that come to the same. */
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

static void drop(const char *name, SceneStriker striker, int facets, Drop *d)
{
    Scene scene = {0};
    VerifyRun run;
    scene_impactor(&scene, 0, striker, facets);
    *d = (Drop){0};
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .stop_time = 0.15, .probe = watch, .user = d});
    for (int i = 6; i < d->count; i++) d->peak = fmax(d->peak, (d->v[i] - d->v[i - 6]) / 3e-3);
    print_message("    %s: 3 ms %.2f m/s2, %.5f m at the end; energy %.4f to %.4f, %ld cycles\n", name, d->peak,
                  d->z[d->count - 1], run.state.energy->ratio_min, run.state.energy->ratio_max, (long)run.cycles);
    verify_near("energy ratio", run.state.energy->ratio_min, 1, 2e-3);
    verify_near("energy ratio", run.state.energy->ratio_max, 1, 2e-3);
    verify_free(&run);
}

static void falls_agree(const Drop *a, const Drop *b, double apart, double share)
{
    double most = 0;
    for (int i = 0; i < a->count && i < b->count; i++) most = fmax(most, fabs(a->z[i] - b->z[i]));
    verify_near("places of the impactor apart [m], of a way of 0.43 m", most, 0, apart);
    verify_close("largest mean acceleration over 3 ms", a->peak, b->peak, share);
}

static void same_as_fine_facets(void **state)
{
    (void)state;
    static Drop smooth, fine;
    drop("smooth sphere", SCENE_SPHERE, 6, &smooth);
    drop("6 x 18 x 18 shells", SCENE_FACETED_SPHERE, 18, &fine);
    falls_agree(&smooth, &fine, 1e-3, 0.02);
}

/* Two spheres with a tube between them, against one body of revolution of 120 edges. */
static void capsule_by_both(void **state)
{
    (void)state;
    static Drop parts, whole;
    drop("capsule of three entities", SCENE_CAPSULE, 0, &parts);
    drop("capsule by its outline", SCENE_CAPSULE_PROFILE, 0, &whole);
    falls_agree(&parts, &whole, 1e-3, 0.02);
}

/* The box as a convex mesh that nodes and points meet, against its faces and edges in a *CONTACT. */
static void box_by_both(void **state)
{
    (void)state;
    static Drop mesh, faces;
    drop("box as a convex mesh", SCENE_BOX_MESH, 0, &mesh);
    drop("box by its faces", SCENE_BOX, 0, &faces);
    falls_agree(&mesh, &faces, 5e-3, 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_as_fine_facets), cmocka_unit_test(capsule_by_both),
                                       cmocka_unit_test(box_by_both)};
    return cmocka_run_group_tests_name("drop of smooth and convex impactors", tests, NULL, NULL);
}
