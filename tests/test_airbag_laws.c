/* *AIRBAG_SIMPLE_PRESSURE_VOLUME, _ADIABATIC_GAS_MODEL, _LOAD_CURVE and _LINEAR_FLUID from the deck: every field acts.
 */
#include "tests/airbag_box.h"

#include <stdio.h>
#include <string.h>

/* Curves that the cards below name. */
#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n3\n0,1e5\n0.1,4e5\n*DEFINE_CURVE\n4\n0.5,3e5\n1,1e5\n2,0\n*DEFINE_CURVE\n5\n0,0\n0.02,0\n0.021,"   \
    "1\n"                                                                                                              \
    "*DEFINE_CURVE\n6\n0,5\n0.1,5\n*DEFINE_CURVE\n7\n0,0\n1e5,20\n*DEFINE_CURVE\n8\n0,1e4\n0.1,5e4\n"

typedef struct Change {
    const char *field, *card; /* the cards after card 1 */
} Change;

/* The first change is the base of those that follow up to the next one whose field is "base". */
static void check_changes(const char *keyword, const Change *changes, int count)
{
    double base = 0;
    for (int i = 0; i < count; i++) {
        char text[1500];
        snprintf(text, sizeof text, "*AIRBAG_%s\n1,1\n%s\n" CURVES, keyword, changes[i].card);
        double result = box_signature(text, 0.05, -0.2);
        if (!strcmp(changes[i].field, "base"))
            base = result;
        else
            box_differs(changes[i].field, base, result);
    }
}

static void pressure_volume_fields(void **state)
{
    (void)state;
    static const Change changes[] = {
        {"base", "1e5,2"}, {"CN", "1.1e5,2"}, {"BETA", "1e5,2.2"}, {"CN < 0", "-3,2"}, {"LCID", "1e5,2,4"}};
    check_changes("SIMPLE_PRESSURE_VOLUME", changes, 5);
}

static void adiabatic_fields(void **state)
{
    (void)state;
    static const Change changes[] = {{"base", "1,0,1.4,2e4,1e5,1.2"}, {"PSF", "2,0,1.4,2e4,1e5,1.2"},
                                     {"LCID", "1,5,1.4,2e4,1e5,1.2"}, {"GAMMA", "1,0,1.3,2e4,1e5,1.2"},
                                     {"P0", "1,0,1.4,3e4,1e5,1.2"},   {"PE", "1,0,1.4,2e4,9e4,1.2"},
                                     {"R0", "1,0,1.4,2e4,1e5,2.4e0"}};
    check_changes("ADIABATIC_GAS_MODEL", changes, 7);
}

static void load_curve_fields(void **state)
{
    (void)state;
    static const Change changes[] = {{"base", "0.01,3"},
                                     {"STIME", "0.02,3"},
                                     {"LCID", "0.01,8"},
                                     {"base", "0.01,0,1.2,1e5,2e4,300,0"},
                                     {"STIME without LCID", "0.02,0,1.2,1e5,2e4,300,0"},
                                     {"R0", "0.01,0,2.4,1e5,2e4,300,0"},
                                     {"PE", "0.01,0,1.2,1.1e5,2e4,300,0"},
                                     {"P0", "0.01,0,1.2,1e5,3e4,300,0"},
                                     {"T", "0.01,0,1.2,1e5,2e4,1000300,0"},
                                     {"T0", "0.01,0,1.2,1e5,2e4,300,-1e6"}};
    check_changes("LOAD_CURVE", changes, 10);
}

static void linear_fluid_fields(void **state)
{
    (void)state;
    static const Change changes[] = {
        {"base", "2e6,1000,6"},         {"BULK", "3e6,1000,6"},           {"RO", "2e6,100,6"},
        {"LCINT", "2e6,1000,7"},        {"LCOUTT", "2e6,1000,6,6"},       {"LCOUTP", "2e6,1000,6,0,7"},
        {"LCFIT", "2e6,1000,6,0,0,8"},  {"LCBULK", "2e6,1000,6,0,0,0,3"}, {"LCID", "2e6,1000,6,0,0,0,0,3"},
        {"P_LIMIT", "2e6,1000,6\n2e4"}, {"P_LIMLC", "2e6,1000,6\n2e9,8"}};
    check_changes("LINEAR_FLUID", changes, 11);
}

/* NONULL: the walls of the box are null shells; they bound the volume and feel no pressure. */
static void fluid_without_null(void **state)
{
    (void)state;
    double volume[2], push[2];
    for (int k = 0; k < 2; k++) {
        char text[1500];
        snprintf(text, sizeof text, "*AIRBAG_LINEAR_FLUID_ID\n7,pad\n1,1\n2e6,1000,0\n0,0,%d\n", k);
        VerifyRun run;
        box_run(&run, text, 0.01, -0.2, 1e-4, &(VerifyOptions){.every = 1, .stop_time = 0.005});
        const VerifySample *last = &run.samples[run.count - 1];
        volume[k] = last->volume;
        push[k] = 0;
        for (int i = 4; i < 8; i++) push[k] += fabs(run.f[3 * i]) / (last->pressure * 0.3 * 1);
        assert_int_equal(run.model.airbags[0].id, 7);
        assert_string_equal(run.model.airbags[0].heading, "pad");
        verify_free(&run);
    }
    assert_true(volume[0] == volume[1]);
    verify_between("side force with NONULL = 0", push[0], 0.1, 3);
    verify_near("side force with NONULL = 1", push[1], 0, 1e-9);
}

/* The curves of B10 and B11 through the deck, with the lid at half height. */
static void values(void **state)
{
    (void)state;
    VerifyRun run;
    box_run(&run, "*AIRBAG_SIMPLE_PRESSURE_VOLUME\n1,1,0,1,2\n1.5e5,1\n", 0.05, -0.5, 0, &(VerifyOptions){.every = 1});
    for (size_t i = 0; i < run.count; i++) {
        const VerifySample *s = &run.samples[i];
        assert_true(fabs(s->applied / (2 * 1.5e5 * 0.06 / s->volume) - 1) < 1e-12);
    }
    verify_between("B11 least volume", verify_smallest(&run, 0, offsetof(VerifySample, volume)), 0.0299, 0.031);
    verify_free(&run);
    box_run(&run, "*AIRBAG_LINEAR_FLUID\n1,1\n2e6,1000\n", 0.05, -0.2, 0, &(VerifyOptions){.every = 1});
    for (size_t i = 0; i < run.count; i++)
        assert_true(fabs(run.samples[i].pressure - 2e6 * log(0.06 / run.samples[i].volume)) < 1e-5);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pressure_volume_fields), cmocka_unit_test(adiabatic_fields),
                                       cmocka_unit_test(load_curve_fields),      cmocka_unit_test(linear_fluid_fields),
                                       cmocka_unit_test(fluid_without_null),     cmocka_unit_test(values)};
    return cmocka_run_group_tests_name("airbag laws", tests, NULL, NULL);
}
