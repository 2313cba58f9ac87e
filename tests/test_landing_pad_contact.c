/* A real deck of others with contact against LS-DYNA's own result: landing-pad-wang-nefske, two one-way contacts,
 * gravity, rigid shells, hanging nodes. Its first 192,000 cycles, up to LS-DYNA's first state; the
 * whole run is benchmarks/landing_pad.py. */
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

static void begins_like_ls_dyna(void **unused)
{
    (void)unused;
    size_t length = 0;
    char *text = real_deck_read(FOLDER "deck.k", &length);
    double state[3] = {0};
    if (!text) {
        print_message("skipped: the decks of others are not beside this checkout\n");
        skip();
    }
    assert_true(read_state(0.5, state));
    VerifyRun run;
    assert_int_equal(verify_build(&run, text, length, &(VerifyOptions){.every = 500, .stop_time = 0.5}), 0);
    assert_int_equal(verify_loop(&run), 0);
    print_message("    %ld cycles, %.0f us each\n", (long)run.cycles, 1e6 * run.times.total / (double)run.cycles);
    verify_between("cycles", (double)run.cycles, 185e3, 200e3);
    const VerifySample *last = &run.samples[run.count - 1];
    verify_near("time", last->time, 0.5, 2e-3);
    verify_close("volume", verify_at(&run, 0.499999, offsetof(VerifySample, volume)), state[0], 0.02);
    verify_close("pressure", verify_at(&run, 0.499999, offsetof(VerifySample, pressure)), state[1], 0.03);
    verify_close("mass", verify_at(&run, 0.499999, offsetof(VerifySample, mass)), state[2], 1e-3);
    verify_balance(&run, 1e-3);
    assert_int_equal(run.state.contact->lost, 0);
    verify_free(&run);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(begins_like_ls_dyna)};
    return cmocka_run_group_tests_name("landing pad with contact", tests, NULL, NULL);
}
