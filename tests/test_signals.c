/* Requests from outside: sense switches in d3kil, the stop flag of signals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "solver/signals.h"

static void test_switch_names(void **state)
{
    (void)state;
    assert_int_equal(signals_parse_switch("sw1"), SENSE_STOP);
    assert_int_equal(signals_parse_switch("SW2.\n"), SENSE_PRINT);
    assert_int_equal(signals_parse_switch("  sw3 \r\n"), SENSE_CHECKPOINT);
    assert_int_equal(signals_parse_switch("Sw4\nsw1\n"), SENSE_STATE);
    assert_int_equal(signals_parse_switch("stop"), SENSE_STOP);
    assert_int_equal(signals_parse_switch(""), SENSE_NONE);
    assert_int_equal(signals_parse_switch(" \n"), SENSE_NONE);
    assert_int_equal(signals_parse_switch("sw5"), SENSE_UNKNOWN);
    assert_int_equal(signals_parse_switch("sw12"), SENSE_UNKNOWN);
    assert_int_equal(signals_parse_switch("."), SENSE_UNKNOWN);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void test_switch_file(void **state)
{
    (void)state;
    char path[] = "billow-d3kil-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_int_equal(signals_read_switch(path), SENSE_NONE); /* empty: still being written, stays */
    assert_int_equal(access(path, F_OK), 0);
    write_file(path, "sw3\n");
    assert_int_equal(signals_read_switch(path), SENSE_CHECKPOINT);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(signals_read_switch(path), SENSE_NONE);
    write_file(path, "hello");
    assert_int_equal(signals_read_switch(path), SENSE_UNKNOWN);
    assert_int_not_equal(access(path, F_OK), 0);
}

/* The first signal raises the flag and gives the next one its usual effect back. */
static void test_first_signal(void **state)
{
    (void)state;
    signals_install();
    assert_false(signals_stop_requested());
    raise(SIGTERM);
    assert_true(signals_stop_requested());
    struct sigaction action;
    const int numbers[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(sigaction(numbers[i], NULL, &action), 0);
        assert_true(action.sa_handler == SIG_DFL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_switch_names),
        cmocka_unit_test(test_switch_file),
        cmocka_unit_test(test_first_signal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
