/* A real deck of others with contact against LS-DYNA's own result: landing-pad-wang-nefske, two one-way contacts,
 * gravity, rigid shells, hanging nodes. Up to LS-DYNA's first two states, and its first 192,000 cycles with
 * all elements explicit; the whole run is benchmarks/landing_pad.py. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/real_deck.h"

#define FOLDER BILLOW_SHARED_DIR "/decks/landing-pad-wang-nefske/"

/* LS-DYNA's state closest to a time: volume, pressure, mass. */
static bool read_state(double at, double state[3])
{
    FILE *file = fopen(FOLDER "abstat.ls-dyna", "r");
    char line[400];
    bool found = false;
    if (!file) return false;
    while (!found && fgets(line, sizeof line, file)) {
        double time, volume, pressure, energy, flow, density, out, mass;
        int bag;
        if (sscanf(line, "%lf %d %lf %lf %lf %lf %lf %lf %lf", &time, &bag, &volume, &pressure, &energy, &flow,
                   &density, &out, &mass) != 9)
            continue;
        found = fabs(time - at) < 1e-3;
        state[0] = volume;
        state[1] = pressure;
        state[2] = mass;
    }
    fclose(file);
    return found;
}

/* Runs the deck up to a time; skips the test without it. */
static void run_deck(VerifyRun *run, const VerifyOptions *options)
{
    size_t length = 0;
    char *text = real_deck_read(FOLDER "deck.k", &length);
    if (!text) {
        print_message("skipped: the decks of others are not beside this checkout\n");
        skip();
    }
    assert_int_equal(verify_build(run, text, length, options), 0);
    if (verify_loop(run)) fail_msg("%s", run->failure.cause);
    print_message("    %ld cycles, %.0f us each\n", (long)run->cycles, 1e6 * run->times.total / (double)run->cycles);
    verify_balance(run, 1e-3);
    assert_int_equal(run->state.contact->lost, 0);
    free(text);
}

static void is_like_ls_dyna(const VerifyRun *run, double time)
{
    double state[3] = {0};
    assert_true(read_state(time, state));
    verify_close("volume", verify_at(run, time, offsetof(VerifySample, volume)), state[0], 0.02);
    verify_close("pressure", verify_at(run, time, offsetof(VerifySample, pressure)), state[1], 0.03);
    verify_close("mass", verify_at(run, time, offsetof(VerifySample, mass)), state[2], 1e-3);
}

/* 156 of 4,200 elements are implicit, and the others set a step 17 times as long: nothing else changes. */
static void begins_like_ls_dyna(void **unused)
{
    (void)unused;
    VerifyRun explicit_run, run;
    run_deck(&run, &(VerifyOptions){.every = 50, .stop_time = 1.0 + 2e-3});
    assert_int_equal(run.model.implicit.element_count, 156);
    verify_between("cycles", (double)run.cycles, 18e3, 28e3);
    run_deck(&explicit_run, &(VerifyOptions){.every = 500, .stop_time = 0.5 + 1e-3, .all_explicit = true});
    verify_between("cycles", (double)explicit_run.cycles, 185e3, 200e3);
    is_like_ls_dyna(&run, 0.5);
    is_like_ls_dyna(&run, 1.0);
    is_like_ls_dyna(&explicit_run, 0.5);
    verify_close("volume, implicit to explicit", verify_at(&run, 0.5, offsetof(VerifySample, volume)),
                 verify_at(&explicit_run, 0.5, offsetof(VerifySample, volume)), 2e-3);
    verify_free(&explicit_run);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(begins_like_ls_dyna)};
    return cmocka_run_group_tests_name("landing pad with contact", tests, NULL, NULL);
}
