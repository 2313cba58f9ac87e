/* A real deck of others against LS-DYNA's own result: landing-pad-closed. The limits are the project's. */
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

#define FOLDER BILLOW_SHARED_DIR "/decks/landing-pad-closed/"

enum { STATES = 200 };

/* LS-DYNA's abstat: time, volume, pressure, mass, temperature, area of each state. */
typedef struct Reference {
    int count;
    double time[STATES], value[STATES][5];
} Reference;

static const char *const names[5] = {"volume", "pressure", "mass", "temperature", "area"};
static const size_t offsets[5] = {offsetof(VerifySample, volume), offsetof(VerifySample, pressure),
                                  offsetof(VerifySample, mass), offsetof(VerifySample, temperature),
                                  offsetof(VerifySample, area)};

static int read_reference(Reference *reference)
{
    FILE *file = fopen(FOLDER "abstat.ls-dyna", "r");
    char line[400];
    if (!file) return -1;
    while (reference->count < STATES && fgets(line, sizeof line, file)) {
        double t, volume, pressure, energy, inflow, density, outflow, mass, temperature, area;
        int bag;
        if (sscanf(line, "%lf %d %lf %lf %lf %lf %lf %lf %lf %lf %lf", &t, &bag, &volume, &pressure, &energy, &inflow,
                   &density, &outflow, &mass, &temperature, &area) != 11)
            continue;
        reference->time[reference->count] = t;
        memcpy(reference->value[reference->count++], (double[5]){volume, pressure, mass, temperature, area},
               sizeof reference->value[0]);
    }
    fclose(file);
    return reference->count > 80 ? 0 : -1;
}

/* Largest difference up to a time as a share of the history's peak, in percent. */
static double difference(const VerifyRun *run, const Reference *reference, int channel, double until)
{
    double worst = 0, peak = 0;
    for (int i = 0; i < reference->count; i++) {
        peak = fmax(peak, fabs(reference->value[i][channel]));
        if (reference->time[i] > until) continue;
        double value = verify_at(run, reference->time[i], offsets[channel]);
        worst = fmax(worst, fabs(value - reference->value[i][channel]));
    }
    return 100 * worst / peak;
}

/* Percent allowed up to a time by channel. */
static const struct Limit {
    double until, percent;
    int channel;
} limits[] = {{10, 0.05, 0}, {10, 0.05, 1}, {10, 0.05, 2}, {10, 0.1, 3}, {20, 0.5, 0},  {20, 0.6, 1}, {20, 0.25, 3},
              {20, 0.5, 4},  {41, 1.5, 0},  {41, 2.0, 1},  {41, 0.6, 3}, {41, 0.05, 2}, {41, 1.3, 4}};

static void agrees_with_ls_dyna(void **state)
{
    (void)state;
    Reference reference = {0};
    size_t length = 0;
    char *text = real_deck_read(FOLDER "deck.k", &length);
    if (!text || read_reference(&reference)) {
        print_message("skipped: the decks of others are not beside this checkout\n");
        free(text);
        skip();
    }
    VerifyRun run;
    assert_int_equal(verify_build(&run, text, length, &(VerifyOptions){.threads = 2, .every = 5}), 0);
    assert_int_equal(verify_loop(&run), 0);
    verify_close("volume at the start", run.samples[0].volume, 272698.2, 1e-4);
    verify_close("area at the start", run.samples[0].area, 560215, 1e-4);
    int broken = 0;
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        double off = difference(&run, &reference, limits[i].channel, limits[i].until);
        bool inside = off <= limits[i].percent;
        print_message("    %-11s t <= %2.0f: off by %.4f %% of its peak (limit %g %%)%s\n", names[limits[i].channel],
                      fmin(limits[i].until, 40), off, limits[i].percent, inside ? "" : " BROKEN");
        broken += !inside;
    }
    assert_int_equal(broken, 0);
    verify_balance(&run, 0.002);
    verify_free(&run);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(agrees_with_ls_dyna)};
    return cmocka_run_group_tests_name("landing pad", tests, NULL, NULL);
}
