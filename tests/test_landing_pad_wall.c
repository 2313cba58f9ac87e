/* A real deck of others with a rigid wall against LS-DYNA's own result: landing-pad-ring-wall. All nodes start behind
 * the wall. LS-DYNA's result scatters from state to state after t = 17, which is shown and not judged. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/program.h"
#include "tests/real_deck.h"

#define FOLDER BILLOW_SHARED_DIR "/decks/landing-pad-ring-wall/"

/* Largest relative difference of volume and pressure over the states from time from to time until. */
static int compare(const VerifyRun *run, double from, double until, double off[2])
{
    FILE *file = fopen(FOLDER "abstat.ls-dyna", "r");
    char line[400];
    int states = 0;
    off[0] = off[1] = 0;
    if (!file) return 0;
    while (fgets(line, sizeof line, file)) {
        double time, volume, pressure;
        int bag;
        if (sscanf(line, "%lf %d %lf %lf", &time, &bag, &volume, &pressure) != 4 || time < from || time > until)
            continue;
        states++;
        off[0] = fmax(off[0], fabs(verify_at(run, time, offsetof(VerifySample, volume)) / volume - 1));
        off[1] = fmax(off[1], fabs(verify_at(run, time, offsetof(VerifySample, pressure)) / pressure - 1));
    }
    fclose(file);
    return states;
}

static void agrees_with_ls_dyna(void **state)
{
    (void)state;
    size_t length = 0;
    char *text = real_deck_read(FOLDER "deck.k", &length);
    if (!text) {
        print_message("skipped: the decks of others are not beside this checkout\n");
        skip();
    }
    VerifyRun run;
    double off[2];
    assert_int_equal(verify_build(&run, text, length, &(VerifyOptions){.threads = 2, .every = 5}), 0);
    assert_int_equal(run.model.walls[0].behind_count, 3145);
    assert_int_equal(verify_loop(&run), 0);
    assert_int_equal(compare(&run, 0, 17, off), 35);
    verify_near("volume for t <= 17, largest relative difference", off[0], 0, 0.015);
    verify_near("pressure for t <= 17", off[1], 0, 0.02);
    compare(&run, 17, 40, off);
    print_message("    after t = 17, not judged: volume off by up to %.1f %%, pressure by %.1f %%\n", 100 * off[0],
                  100 * off[1]);
    verify_balance(&run, 0.002);
    verify_free(&run);
    free(text);
}

static void check_counts_the_nodes_behind(void **state)
{
    (void)state;
    static Program program;
    FILE *file = fopen(FOLDER "deck.k", "rb");
    if (!file) skip();
    fclose(file);
    program_open(&program);
    assert_int_equal(program_run(&program, "check " FOLDER "deck.k"), 0);
    assert_non_null(strstr(program.out, "3145 nodes, 3145 of them start behind the wall"));
    assert_non_null(strstr(program.out, "all 3145 of the 3145 nodes of rigid wall 1 start behind it"));
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_ls_dyna),
        cmocka_unit_test(check_counts_the_nodes_behind),
    };
    return cmocka_run_group_tests_name("landing pad with a wall", tests, NULL, NULL);
}
