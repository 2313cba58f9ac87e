/* A folded bag of eight layers begins to unfold against itself: no layer passes through another, energy is kept. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "contact/contact_check.h"
#include "contact/mesh_crossing.h"

enum { CELLS = 72, COARSE_CELLS = 40 }; /* 20,736 and 6,400 triangles */

static const double unfolding = 3e-3; /* the layers part, at up to 0.6 of a thickness per step */

static void report(const VerifyRun *run)
{
    const ContactClock *contact = run->state.contact;
    print_message(
        "    %ld cycles, %.1f s, %.0f ns per element and cycle; %ld meetings too fast, %ld pairs lost; contact %.2f %% "
        "of the largest energy\n",
        (long)run->cycles, run->times.total,
        1e9 * run->times.total / ((double)run->cycles * run->model.deformable_count), (long)contact->fast,
        (long)contact->lost, 100 * run->state.energy->contact / run->energy);
}

static void unfolds(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    ContactFindings findings;
    scene_folded_bag(&scene, SCENE_DIAGONAL, CELLS, 0);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 50, .stop_time = unfolding, .threads = 2});
    report(&run);
    const Energies *e = run.state.energy;
    verify_between("least energy ratio", e->ratio_min, 0.999, 1.001);
    verify_between("largest energy ratio", e->ratio_max, 0.999, 1.001);
    assert_int_equal(contact_inspect(&run.model, run.model.contacts, run.internal_x, &findings, NULL, NULL), 0);
    assert_int_equal(findings.cross_count, 0); /* of edges and triangles: layers keep their order */
    assert_int_equal(run.state.contact->fast, 0);
    assert_int_equal(run.state.contact->lost, 0);
    verify_free(&run);
}

/* Pairs of shells that go through each other: the most at a time, and their mean over the looks. */
typedef struct Crossed {
    int most, sum, looks;
} Crossed;

static void count_crossings(void *user, const Model *model, const State *state, const StepView *view)
{
    Crossed *crossed = user;
    MeshCrossings now;
    (void)view;
    assert_int_equal(mesh_find_crossings(model->element_count, model->element_node, state->x, NULL, &now), 0);
    crossed->most = now.count > crossed->most ? now.count : crossed->most;
    crossed->sum += now.count;
    crossed->looks++;
}

/* A coarser bag deploys to its full size, with up to twice the thickness in a step: in the shock a pair of wrinkles may
 * cross for some cycles, at the end no shell goes through another. With sharp edges that meet sharp ones alone 366
 * pairs cross. */
static Crossed deploy(ScenePattern pattern)
{
    Scene scene = {0};
    VerifyRun run;
    MeshCrossings crossings;
    Crossed crossed = {0};
    scene_folded_bag(&scene, pattern, COARSE_CELLS, 0);
    verify_scene(
        &run, &scene,
        &(VerifyOptions){.every = 50, .stop_time = 0.020, .threads = 2, .probe = count_crossings, .user = &crossed});
    report(&run);
    const Energies *e = run.state.energy;
    verify_between("least energy ratio", e->ratio_min, 0.99, 1.01);
    verify_between("largest energy ratio", e->ratio_max, 0.99, 1.01);
    assert_int_equal(
        mesh_find_crossings(run.model.element_count, run.model.element_node, run.internal_x, NULL, &crossings), 0);
    assert_int_equal(crossings.count, 0);
    print_message("    at most %d pairs of shells cross at a time, %.2f in the mean\n", crossed.most,
                  (double)crossed.sum / crossed.looks);
    verify_free(&run);
    return crossed;
}

static void deploys(void **state)
{
    (void)state;
    assert_true(deploy(SCENE_DIAGONAL).most <= 20);
}

/* The same of quadrilaterals. Where their diagonals are no edges, up to 47 pairs cross, 7.9 in the mean. */
static void deploys_of_quads(void **state)
{
    (void)state;
    Crossed crossed = deploy(SCENE_QUADS);
    assert_true(crossed.sum <= 2 * crossed.looks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(unfolds), cmocka_unit_test(deploys),
                                       cmocka_unit_test(deploys_of_quads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
