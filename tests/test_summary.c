/* summary.json: escapes, numbers that are not finite, replacement of an older file, folders that cannot be written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "io/summary.h"

static void read_back(char *text, size_t size)
{
    FILE *file = fopen(BILLOW_SUMMARY_NAME, "r");
    assert_non_null(file);
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

static void expect_line(const char *text, const char *line)
{
    if (!strstr(text, line)) fail_msg("no '%s' in %s", line, text);
}

static void test_members(void **state)
{
    (void)state;
    char text[4096];
    Diagnostics diagnostics = {0};
    const Summary summary = {.status = "failed",
                             .deck = "a \"b\"\\c\td.k",
                             .threads = 3,
                             .cycles = 5000000000,
                             .last_cycle = 5000000001,
                             .elements = 7,
                             .nodes = 9,
                             .end_time = 0.1,
                             .energy_ratio_min = NAN,
                             .energy_ratio_max = INFINITY,
                             .timing = {.gas = 0.5, .output = 0.25},
                             .warnings = 2,
                             .state_hash = 0xabc,
                             .cause = "it broke",
                             .advice = "mend it"};
    assert_int_equal(summary_write(".", &summary, &diagnostics), 0);
    read_back(text, sizeof text);
    const char *lines[] = {"\"status\": \"failed\",",
                           "\"deck\": \"a \\\"b\\\"\\\\c\\u0009d.k\",",
                           "\"threads\": 3,",
                           "\"cycles\": 5000000000,",
                           "\"elements\": 7,",
                           "\"nodes\": 9,",
                           "\"end_time\": 0.10000000000000001,",
                           "\"energy_ratio_min\": null,",
                           "\"energy_ratio_max\": null,",
                           "\"gas\": 0.5,",
                           "\"output\": 0.25,",
                           "\"warnings\": 2,",
                           "\"cause\": \"it broke\",",
                           "\"advice\": \"mend it\",",
                           "\"state_hash\": \"0000000000000abc\"\n}"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) expect_line(text, lines[i]);

    const Summary next = {.status = "normal", .deck = "d.k"};
    assert_int_equal(summary_write(".", &next, &diagnostics), 0);
    read_back(text, sizeof text);
    expect_line(text, "\"status\": \"normal\",");
    assert_null(strstr(text, "cause"));
    assert_int_equal(diagnostics.count, 0);
    unlink(BILLOW_SUMMARY_NAME);
}

static void test_no_folder(void **state)
{
    (void)state;
    Diagnostics diagnostics = {0};
    const Summary summary = {.status = "normal", .deck = "d.k"};
    assert_int_equal(summary_write("no-such-folder", &summary, &diagnostics), -1);
    assert_int_equal(diagnostics_exit_code(&diagnostics), BILLOW_EXIT_ENVIRONMENT);
    diagnostics_free(&diagnostics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_members), cmocka_unit_test(test_no_folder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
