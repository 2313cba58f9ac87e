/* A real folded bag with contact, rigid parts and a wall, undamped (../shared/decks/classic-deploy): it ends, and its
 * balance holds (accounts of fabric, eq. F7a). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/real_deck.h"
#include "tests/verify.h"

static void test_balance_to_the_end(void **state)
{
    (void)state;
    size_t length = 0;
    char *text = real_deck_read(BILLOW_SHARED_DIR "/decks/classic-deploy/deck.k", &length);
    if (!text) {
        print_message("../shared/decks is not there: skipped\n");
        skip();
    }
    VerifyRun run;
    assert_int_equal(verify_build(&run, text, length, &(VerifyOptions){.threads = 2}), 0);
    free(text);
    if (verify_loop(&run)) fail_msg("%s", run.failure.cause);
    verify_between("energy ratio, least", run.state.energy->ratio_min, 0.98, 1.02);
    verify_between("energy ratio, largest", run.state.energy->ratio_max, 0.98, 1.02);
    verify_between("time", run.state.clock->time, 0.03 - 1e-9, 0.03 + 3e-6); /* the step after the last is begun */
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_balance_to_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
