/* Messages about the cards of MAT_FABRIC: moduli, forms and curves, all in one list with file and line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "solver/billow.h"
#include "tests/program.h"
#include "tests/verify.h"

/* A square of two triangles; the material's cards follow. Line 1 of the material is line 18. */
static const char square[] =
    "*KEYWORD\n*CONTROL_TERMINATION\n1e-4\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n"
    "*ELEMENT_SHELL\n1,1,1,2,3,3\n2,1,1,3,4,4\n*PART\nsquare\n1,1,1\n*SECTION_SHELL\n1,9\n.001\n";

static void build(VerifyRun *run, const char *material)
{
    char deck[4000];
    int length = snprintf(deck, sizeof deck, "%s%s*END\n", square, material);
    verify_build(run, deck, (size_t)length, &(VerifyOptions){0});
}

/* Exactly these messages of that severity, in any order. */
static void expect(const char *material, Severity severity, int count, const char *const *texts)
{
    VerifyRun run;
    build(&run, material);
    const Diagnostics *d = &run.diagnostics;
    int found = severity == SEVERITY_ERROR ? d->errors : d->warnings;
    if (found != count) {
        diagnostics_print(d, SEVERITY_WARNING, stderr);
        fail_msg("%d messages instead of %d", found, count);
    }
    for (int i = 0; i < count; i++) {
        bool there = false;
        for (size_t m = 0; m < d->count; m++) {
            char line[40];
            snprintf(line, sizeof line, "%d: ", d->messages[m].source.line);
            size_t digits = strlen(line) - 2;
            there = there || (d->messages[m].severity == severity && strncmp(texts[i], line, digits) == 0 &&
                              strstr(d->messages[m].text, texts[i] + digits + 2));
        }
        if (!there) {
            diagnostics_print(d, SEVERITY_WARNING, stderr);
            fail_msg("no message '%s'", texts[i]);
        }
    }
    verify_free(&run);
}

#define EXPECT(material, severity, ...)                                                                                \
    expect(material, severity, (int)(sizeof((const char *[]){__VA_ARGS__}) / sizeof(char *)),                          \
           (const char *[]){__VA_ARGS__})

static void test_moduli(void **unused)
{
    (void)unused;
    EXPECT("*MAT_FABRIC\n1,1.,-3e8,-2e8\n-1e7,,,0,-5e7,.3,1.5\n0\n", SEVERITY_ERROR, "19: EA = -3e+08",
           "19: EB = -2e+08", "19: GAB = -1e+07", "19: EL = -5e+07", "19: LRATIO = 1.5");
    EXPECT("*MAT_FABRIC\n1,1.,3e8\n0,,,0,5e7,1.3,.5\n0\n", SEVERITY_ERROR, "19: PRL = 1.3");
    EXPECT("*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,5\n", SEVERITY_ERROR, "21: FORM = 5");
    EXPECT("*MAT_FABRIC\n1,1.,0.\n0\n0,,,,,14\n0\n0\n0,7\n*DEFINE_CURVE\n7\n0.,0.\n.1,1e7\n", SEVERITY_ERROR,
           "19: LCA = 0: without this curve the modulus", "19: LCAB = 0: without this curve GAB");
}

static void test_bad_curves(void **unused)
{
    (void)unused;
    EXPECT("*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,14\n0\n0\n1,2,3,4,5,6\n"
           "*DEFINE_CURVE\n1\n0.,0.\n.1,1e7\n.2,.9e7\n"
           "*DEFINE_CURVE\n2\n0.,1e5\n.1,1e7\n"
           "*DEFINE_CURVE\n3\n-.1,-1e6\n0.,0.\n.1,2e6\n"
           "*DEFINE_CURVE\n6\n0.,0.\n",
           SEVERITY_ERROR, "29: LCA = 1: the stress falls", "32: LCB = 2: the curve does not go through the origin",
           "36: LCAB = 3: shear of both senses");
    EXPECT("*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,14\n0\n0\n1,0,0,4,5\n"
           "*DEFINE_CURVE\n5\n0.,0.\n",
           SEVERITY_ERROR, "19: LCA = 1: the deck has no *DEFINE_CURVE", "27: LCUB = 5: a curve of stress");
    EXPECT("*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,24\n0\n0\n1,2\n"
           "*DEFINE_CURVE\n1\n.01,0.\n.1,1e7\n*DEFINE_CURVE\n2\n0.,0.\n.1,0.\n",
           SEVERITY_ERROR, "27: LCA = 1: the curve does not go through the origin",
           "31: LCB = 2: the curve has no stress");
}

static void test_unloading_curves(void **unused)
{
    (void)unused;
    const char curve[] = "*DEFINE_CURVE\n1\n0.,0.\n.1,1e7\n.2,3e7\n";
    char text[1000];
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,14\n0\n0\n1,0,0,2\n%s%s", curve,
             "*DEFINE_CURVE\n2\n0.,0.\n.02,4e6\n.2,3e7\n");
    EXPECT(text, SEVERITY_ERROR, "19: LCUA = 2: the unloading curve lies above");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,14\n0\n0\n1,0,0,2\n%s%s", curve,
             "*DEFINE_CURVE\n2\n0.,0.\n.1,1e6\n.2,2e7\n");
    EXPECT(text, SEVERITY_WARNING, "19: LCUA = 2: the unloading curve does not end on the loading curve");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,14\n0\n0\n1,0,0,2,0,0,1.5\n%s%s", curve,
             "*DEFINE_CURVE\n2\n0.,0.\n.1,1e6\n.2,3e7\n");
    EXPECT(text, SEVERITY_ERROR, "19: RL must lie");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,-14\n0\n0\n1,0,0,2\n0,0,.5\n%s%s", curve,
             "*DEFINE_CURVE\n2\n0.,0.\n.1,1e6\n.2,3e7\n");
    EXPECT(text, SEVERITY_ERROR, "19: give either unloading curves or a hysteresis");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8,,,.2\n0\n0,,,,,-14\n0\n0\n1\n0,0,1.\n%s", curve);
    EXPECT(text, SEVERITY_ERROR, "19: the hysteresis must lie");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8,,,.2\n0\n0,,,,,-14\n0\n0\n1\n3,0,.1\n%s", curve);
    EXPECT(text, SEVERITY_ERROR, "25: LCAA", "14: part 1 names material");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8,,,.2\n0\n0,,,,,24\n0\n0\n1\n%s", curve);
    EXPECT(text, SEVERITY_WARNING, "19: PRBA and PRAB have no effect");
}

/* MAT_FABRIC_MAP as its manual's cards are: ISREFG, CSE and SRFAC begin card 3, before BULKC. */
static void test_map_cards(void **unused)
{
    (void)unused;
    const char curve[] = "*DEFINE_CURVE\n1\n0.,0.\n.1,1e7\n";
    char text[1000];
    snprintf(text, sizeof text, "*MAT_FABRIC_MAP\n1,1.,1,1,1\n\n0,1,0,1e6,0,3,4\n0\n\n\n%s", curve);
    EXPECT(text, SEVERITY_ERROR, "21: card 3: BULKC (value 4)", "14: part 1 names material");
    snprintf(text, sizeof text, "*MAT_FABRIC_MAP\n1,1.,1,1,1\n\n2,1\n0\n\n\n%s%s", curve,
             "*AIRBAG_REFERENCE_GEOMETRY\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n");
    EXPECT(text, SEVERITY_ERROR, "19: ISREFG = 2");
    snprintf(text, sizeof text, "*MAT_FABRIC\n1,1.,3e8\n0\n0,,,,,2\n0\n,,,,,,,1\n%s",
             "*AIRBAG_REFERENCE_GEOMETRY\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n");
    EXPECT(text, SEVERITY_WARNING, "19: ISREFG = 1 acts with FORM = 12 only, here FORM = 2");
    snprintf(text, sizeof text, "*MAT_FABRIC_MAP\n1,1.,1,1,1\n\n1,1,1\n0\n\n\n%s%s", curve,
             "*AIRBAG_REFERENCE_GEOMETRY\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n");
    EXPECT(text, SEVERITY_WARNING, "19: SRFAC = 1 has no effect beside ISREFG = 1");
}

/* From outside: exit code 2, and every message with file and line. */
static void test_exit_code(void **unused)
{
    (void)unused;
    static Program program;
    char deck[4000];
    int length =
        snprintf(deck, sizeof deck, "%s%s*END\n", square,
                 "*MAT_FABRIC\n1,1.,3e8\n-1.\n0,,,,,14\n0\n0\n1,9\n*DEFINE_CURVE\n1\n0.,0.\n.1,1e7\n.2,.9e7\n");
    program_open(&program);
    program_write(&program, "deck.k", deck, (size_t)length);
    assert_int_equal(program_run(&program, "run deck.k"), BILLOW_EXIT_INPUT);
    assert_non_null(strstr(program.err, "deck.k:29: error: *DEFINE_CURVE"));
    assert_non_null(strstr(program.err, "deck.k:19: error: *MAT_FABRIC: GAB = -1"));
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_moduli),    cmocka_unit_test(test_bad_curves), cmocka_unit_test(test_unloading_curves),
        cmocka_unit_test(test_map_cards), cmocka_unit_test(test_exit_code),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
