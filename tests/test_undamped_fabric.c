/* Fabric of FORM 0 with CSE and without DAMP has no stored energy: a run that it feeds is warned of and ended (eq. L8).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "tests/verify.h"

/* The benchmark's pillow, long enough to go astray. */
static void test_run_ends(void **state)
{
    (void)state;
    Scene scene = {0};
    scene_speed(&scene, SCENE_QUADS, 2000, 6000);
    VerifyRun run;
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){.every = 1}), 0);
    scene_free(&scene);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "DAMP = 0.05"));
    assert_int_equal(verify_loop(&run), -1);
    assert_non_null(strstr(run.failure.cause, "the stress of the shells has given"));
    assert_non_null(strstr(run.failure.advice, "DAMP = 0.05"));
    /* long before the ratio of held to given, in which the two errors cancel, says anything */
    assert_true(run.imbalance < 0.1 * run.energy);
    double least = verify_smallest(&run, 0.0, offsetof(VerifySample, internal));
    verify_between("internal energy over the loads'", least / run.energy, -1.2, -1.0);
    verify_free(&run);
}

/* Fabric with damping has nothing to be warned of. */
static void test_damped_is_not_warned_of(void **state)
{
    (void)state;
    Scene scene = {0};
    scene_driver_bag(&scene, 8);
    VerifyRun run;
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), 0);
    scene_free(&scene);
    assert_false(verify_message(&run.diagnostics, SEVERITY_WARNING, "DAMP = 0.05"));
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_run_ends),
        cmocka_unit_test(test_damped_is_not_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
