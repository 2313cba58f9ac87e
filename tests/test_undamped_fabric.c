/* Fabric of FORM 0 with CSE and without DAMP has no stored energy: accounts keep it from feeding the motion (eq. F7a).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "tests/verify.h"

/* The benchmark's pillow; without accounts its stress feeds the motion from cycle 2,000 on. */
static void begin_pillow(VerifyRun *run, int threads, int64_t stop)
{
    Scene scene = {0};
    scene_speed(&scene, SCENE_QUADS, 2000, 6000);
    assert_int_equal(verify_build(run, scene.deck.text, scene.deck.length,
                                  &(VerifyOptions){.every = 1, .threads = threads, .stop = stop}),
                     0);
    scene_free(&scene);
    assert_true(verify_message(&run->diagnostics, SEVERITY_WARNING, "DAMP = 0.05"));
}

static void test_accounts_hold_the_balance(void **state)
{
    (void)state;
    VerifyRun run;
    begin_pillow(&run, 1, 0);
    if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
    int open = 0;
    for (int c = 0; c < run.model.chunk_count; c++) open += run.state.accounts_open[c] != 0;
    assert_true(open > 0);
    verify_between("imbalance over the loads' energy", run.imbalance / run.energy, 0, 0.02);
    double least = verify_smallest(&run, 0.0, offsetof(VerifySample, internal));
    verify_between("internal energy over the loads'", least / run.energy, -0.02, 1.0);
    verify_free(&run);
}

/* Accounts and what opens them are part of the state. */
static void test_same_bits(void **state)
{
    (void)state;
    uint64_t hash[3];
    for (int i = 0; i < 3; i++) {
        VerifyRun run;
        begin_pillow(&run, i == 1 ? 2 : 1, i == 2 ? 2600 : 3500);
        if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
        run.options.stop = 3500;
        if (i == 2 && verify_loop(&run)) fail_msg("%s", run.failure.cause);
        hash[i] = state_hash(&run.state);
        verify_free(&run);
    }
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
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
        cmocka_unit_test(test_accounts_hold_the_balance),
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_damped_is_not_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
