/* Stopping and restarting the built program: signals, d3kil, checkpoints. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solver/billow.h"
#include "tests/program.h"

static const char normal[] = "N o r m a l    t e r m i n a t i o n";

static int open_program(void **state)
{
    Program *program = malloc(sizeof *program);
    assert_non_null(program);
    program_open(program);
    *state = program;
    return 0;
}

static int close_program(void **state)
{
    Program *program = *state;
    if (program->process > 0) {
        kill(program->process, SIGKILL);
        program_wait(program);
    }
    program_close(program);
    free(program);
    return 0;
}

static void expect_code(const Program *program, int code)
{
    if (program->code != code) fail_msg("exit %d instead of %d: %s", program->code, code, program->err);
}

static double summary_number(const Program *program, const char *directory, const char *member)
{
    return strtod(program_summary(program, directory, member), NULL);
}

static void expect_stopped(const Program *program, const char *directory)
{
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_string_equal(program_last_line(program->out), normal);
    assert_string_equal(program_summary(program, directory, "status"), "\"stopped_by_user\"");
    char name[64];
    snprintf(name, sizeof name, "%s/restart.billow", directory);
    assert_true(program_exists(program, name));
}

/* A run stopped at some cycle and restarted ends with the bits of a run that never stopped. */
static void test_signal_and_restart(void **state)
{
    Program *program = *state;
    char hash[32], line[128];
    program_write_bag(program, "bag.k", 8, NULL);
    program_start(program, "run bag.k -j 1 --end-time 50 -o parts");
    assert_true(program_wait_for(program, "parts/results.xdmf"));
    kill(program->process, SIGINT);
    program_wait(program);
    expect_stopped(program, "parts");
    const double time = summary_number(program, "parts", "end_time");
    const double cycles = summary_number(program, "parts", "cycles");
    assert_true(time < 50.0);

    const double end = 1.1 * time + 0.01;
    snprintf(line, sizeof line, "run bag.k -j 2 --end-time %.17g -o parts --restart parts/restart.billow", end);
    program_run(program, line);
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_string_equal(program_summary(program, "parts", "status"), "\"normal\"");
    snprintf(hash, sizeof hash, "%s", program_summary(program, "parts", "state_hash"));
    const double rest = summary_number(program, "parts", "cycles");

    snprintf(line, sizeof line, "run bag.k -j 1 --end-time %.17g -o whole", end);
    program_run(program, line);
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_string_equal(program_summary(program, "whole", "state_hash"), hash);
    assert_true(summary_number(program, "whole", "end_time") == end);
    assert_true(summary_number(program, "whole", "cycles") == cycles + rest);
    assert_true(summary_number(program, "parts", "last_cycle") == cycles + rest);
}

static void test_sigterm(void **state)
{
    Program *program = *state;
    program_write_bag(program, "bag.k", 8, NULL);
    program_start(program, "run bag.k -j 1 --end-time 50");
    assert_true(program_wait_for(program, "bag.results/glstat.csv"));
    kill(program->process, SIGTERM);
    program_wait(program);
    expect_stopped(program, "bag.results");
}

static void test_switches(void **state)
{
    Program *program = *state;
    static char text[1 << 16];
    const char *const switches[] = {"sw2\n", "sw3\n", "sw4\n"};
    program_write_bag(program, "bag.k", 8, NULL);
    program_start(program, "i=bag.k ncpu=1 endtime=50.0");
    assert_true(program_wait_for(program, "bag.results/glstat.csv"));
    for (int i = 0; i < 3; i++) {
        program_write(program, "d3kil", switches[i], 4);
        for (int k = 0; k < 1000 && program_exists(program, "d3kil"); k++) program_wait_for(program, "bag.results");
        if (i == 1) assert_true(program_wait_for(program, "bag.results/restart.billow"));
    }
    program_write(program, "d3kil", "SW1.", 4);
    program_wait(program);
    expect_stopped(program, "bag.results");
    assert_false(program_exists(program, "d3kil"));
    assert_true(program_read(program, "bag.results/log.txt", text, sizeof text));
    assert_non_null(strstr(text, "sense switch"));
    assert_non_null(strstr(text, "checkpoint"));
}

static void test_restart_refusals(void **state)
{
    Program *program = *state;
    program_write_bag(program, "bag.k", 6, NULL);
    program_write_bag(program, "other.k", 8, NULL);
    program_run(program, "run bag.k -j 1 --end-time 0.002");
    expect_code(program, BILLOW_EXIT_NORMAL);
    const int before = program_count(program);
    const struct {
        const char *line, *word;
    } cases[] = {
        {"run other.k -j 1 --restart bag.results/restart.billow", "another deck"},
        {"run bag.k -j 1 --one-point-quads --restart missing.billow -o new", "missing.billow"},
        {"run bag.k -j 1 --restart bag.k -o new", "not a checkpoint"},
        {"run bag.k -j 1 --end-time 0.002 --restart bag.results/restart.billow", "end time"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        program_run(program, cases[i].line);
        expect_code(program, BILLOW_EXIT_INPUT);
        if (!strstr(program->err, cases[i].word)) fail_msg("%s: %s", cases[i].line, program->err);
        assert_int_equal(program_count(program), before);
    }
    assert_true(summary_number(program, "bag.results", "end_time") == 0.002);
    /* A later end: goes on in the same folder. */
    program_run(program, "run bag.k -j 1 --end-time 0.004 --restart bag.results/restart.billow");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_true(summary_number(program, "bag.results", "end_time") == 0.004);
    assert_true(summary_number(program, "bag.results", "cycles") <
                summary_number(program, "bag.results", "last_cycle"));
}

/* Times of a CSV history in the folder: they grow, from 0 to the end; returns how many rows there are. */
static int count_rows(const Program *program, const char *name, double end)
{
    static char text[1 << 20];
    assert_true(program_read(program, name, text, sizeof text));
    int rows = 0;
    double last = -1.0;
    for (char *line = strchr(text, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
        const double time = strtod(line + 1, NULL);
        if (!(time > last)) fail_msg("%s: time %.17g after %.17g", name, time, last);
        if (rows == 0) assert_true(time == 0.0);
        last = time;
        rows++;
    }
    assert_true(last == end);
    return rows;
}

/* Histories of a prolonged run have no gap, no double row; elsewhere they begin at the restart. */
static void test_appended_histories(void **state)
{
    Program *program = *state;
    program_write_bag(program, "bag.k", 6, "*DATABASE_BINARY_D3DUMP\n        50\n");
    program_run(program, "run bag.k -j 1 --end-time 0.008 -o whole");
    expect_code(program, BILLOW_EXIT_NORMAL);
    const int rows = count_rows(program, "whole/glstat.csv", 0.008);
    program_run(program, "run bag.k -j 1 --end-time 0.004 -o parts");
    expect_code(program, BILLOW_EXIT_NORMAL);
    program_run(program, "run bag.k -j 1 --end-time 0.008 -o parts --restart parts/restart.billow");
    expect_code(program, BILLOW_EXIT_NORMAL);
    const int joined = count_rows(program, "parts/glstat.csv", 0.008);
    assert_in_range(joined, rows, rows + 2);
}

int main(void)
{
#define TEST(function) cmocka_unit_test_setup_teardown(function, open_program, close_program)
    const struct CMUnitTest tests[] = {
        TEST(test_signal_and_restart), TEST(test_sigterm), TEST(test_switches), TEST(test_restart_refusals),
        TEST(test_appended_histories),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
