/* The built program from outside: exit codes, last line, messages, folder of results, summary, threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "solver/billow.h"
#include "tests/program.h"

static const char normal[] = "N o r m a l    t e r m i n a t i o n";
static const char error[] = "E r r o r   t e r m i n a t i o n";

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
    program_close(*state);
    free(*state);
    return 0;
}

static void expect_contains(const char *text, const char *word)
{
    if (!strstr(text, word)) fail_msg("no '%s' in: %s", word, text);
}

static void expect_code(const Program *program, int code)
{
    if (program->code != code) fail_msg("exit %d instead of %d: %s", program->code, code, program->err);
}

static void test_help(void **state)
{
    Program *program = *state;
    assert_int_equal(program_run(program, "--version"), BILLOW_EXIT_NORMAL);
    assert_string_equal(program->out, "billow " BILLOW_VERSION "\n");
    assert_int_equal(program_run(program, "--help"), BILLOW_EXIT_NORMAL);
    expect_contains(program->out, "billow check DECK");
    assert_int_equal(program_run(program, "run --help"), BILLOW_EXIT_NORMAL);
    expect_contains(program->out, "--end-time T");
    expect_contains(program->out, "d3kil");
    assert_int_equal(program_run(program, "check --help"), BILLOW_EXIT_NORMAL);
    assert_int_equal(program_run(program, ""), BILLOW_EXIT_INPUT);
    assert_int_equal(program_run(program, "rum deck.k"), BILLOW_EXIT_INPUT);
    expect_contains(program->err, "billow: unknown command 'rum'");
    assert_int_equal(program_count(program), 0);
}

static void test_normal_run(void **state)
{
    Program *program = *state;
    char text[1 << 16];
    program_write_bag(program, "bag.v1.k", 6, NULL);
    program_run(program, "run bag.v1.k -j 1 --end-time 0.004");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_string_equal(program_last_line(program->out), normal);
    /* Not a terminal: plain lines, about every 5 % of the run. */
    assert_null(strchr(program->out, '\r'));
    int lines = 0;
    for (const char *c = program->out; *c; c++) lines += *c == '\n';
    assert_in_range(lines, 10, 40);
    const char *files[] = {"results.vtkhdf", "results.xdmf", "glstat.csv",    "abstat.csv",
                           "summary.json",   "log.txt",      "restart.billow"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char name[64];
        snprintf(name, sizeof name, "bag.v1.results/%s", files[i]);
        if (!program_exists(program, name)) fail_msg("%s is missing", name);
    }
    assert_int_equal(program_count(program), 2);

    assert_string_equal(program_summary(program, "bag.v1.results", "status"), "\"normal\"");
    assert_string_equal(program_summary(program, "bag.v1.results", "deck"), "\"bag.v1.k\"");
    assert_string_equal(program_summary(program, "bag.v1.results", "version"), "\"" BILLOW_VERSION "\"");
    assert_string_equal(program_summary(program, "bag.v1.results", "threads"), "1");
    assert_true(strtod(program_summary(program, "bag.v1.results", "end_time"), NULL) == 0.004);
    const double cycles = strtod(program_summary(program, "bag.v1.results", "cycles"), NULL);
    const double elements = strtod(program_summary(program, "bag.v1.results", "elements"), NULL);
    const double loop = strtod(program_summary(program, "bag.v1.results", "loop_seconds"), NULL);
    const double speed = strtod(program_summary(program, "bag.v1.results", "ns_per_element_cycle"), NULL);
    assert_true(cycles > 10 && elements > 0 && loop > 0.0);
    const double expected = 1e9 * loop / (cycles * elements);
    assert_true(speed > 0.999999 * expected && speed < 1.000001 * expected);
    assert_true(strtod(program_summary(program, "bag.v1.results", "wall_seconds"), NULL) >= loop);
    const char *others[] = {"nodes", "energy_ratio_min", "energy_ratio_max", "timing", "warnings", "output"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_true(strlen(program_summary(program, "bag.v1.results", others[i])) > 0);
    assert_int_equal(strlen(program_summary(program, "bag.v1.results", "state_hash")), 18);

    assert_true(program_read(program, "bag.v1.results/log.txt", text, sizeof text));
    expect_contains(text, "billow " BILLOW_VERSION);
    expect_contains(text, "sphere of fabric");
    expect_contains(text, "Airbags");
    expect_contains(text, "Stable time steps");
    expect_contains(text, "Timing");
    expect_contains(text, "Memory");
    assert_string_equal(program_last_line(text), normal);
}

static void test_quiet_and_dyna_spelling(void **state)
{
    Program *program = *state;
    char text[1 << 16];
    program_write_bag(program, "bag.k", 4, NULL);
    program_run(program, "run bag.k -j 1 --end-time 0.001 --quiet");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_int_equal(strlen(program->out), sizeof normal);
    assert_string_equal(program_last_line(program->out), normal);
    assert_string_equal(program->err, "");
    program_run(program, "I=bag.k ncpu=1 endtime=0.002 jobid=second memory=20m");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_true(strtod(program_summary(program, "second.results", "end_time"), NULL) == 0.002);
    assert_true(program_read(program, "second.results/log.txt", text, sizeof text));
    expect_contains(text, "memory=20m");
}

/* An existing folder is replaced only if it is billow's, and nothing of the user's in it is touched. */
static void test_folder(void **state)
{
    Program *program = *state;
    char text[64];
    program_write_bag(program, "bag.k", 4, NULL);
    program_run(program, "run bag.k -j 1 --end-time 0.001 -o out");
    expect_code(program, BILLOW_EXIT_NORMAL);
    program_write(program, "out/picture.png", "mine", 4);
    program_run(program, "run bag.k -j 1 --end-time 0.0005 -o out");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_true(strtod(program_summary(program, "out", "end_time"), NULL) == 0.0005);
    assert_true(program_read(program, "out/picture.png", text, sizeof text));
    assert_string_equal(text, "mine");

    program_write(program, "out/log.txt", "my own diary\n", 13);
    program_run(program, "run bag.k -j 1 -o out");
    expect_code(program, BILLOW_EXIT_INPUT);
    expect_contains(program->err, "out exists and does not hold results of billow");
    assert_string_equal(program_last_line(program->out), error);
    assert_true(program_read(program, "out/log.txt", text, sizeof text));
    assert_string_equal(text, "my own diary\n");
    assert_true(strtod(program_summary(program, "out", "end_time"), NULL) == 0.0005);

    program_run(program, "run bag.k -j 1 -o bag.k"); /* a file, the deck itself */
    expect_code(program, BILLOW_EXIT_INPUT);
    program_run(program, "run bag.k -j 1 -o none/out");
    expect_code(program, BILLOW_EXIT_ENVIRONMENT);
    expect_contains(program->err, "none/out");
    assert_string_equal(program_last_line(program->out), error);
}

/* Decks that are none: exit 2, a message with the file's name, no crash, nothing made. */
static void test_broken_decks(void **state)
{
    Program *program = *state;
    unsigned char bytes[5000];
    uint64_t seed = 88172645463325252u;
    for (size_t i = 0; i < sizeof bytes; i++) {
        seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
        bytes[i] = (unsigned char)(seed >> 24);
    }
    program_write(program, "empty.k", "", 0);
    program_write(program, "random.k", bytes, sizeof bytes);
    program_write(program, "text.k", "Dear Sir,\nplease inflate this bag.\n", 35);
    const int before = program_count(program);
    const char *decks[] = {"missing.k", ".", "empty.k", "random.k", "text.k"};
    for (size_t i = 0; i < sizeof decks / sizeof *decks; i++) {
        const char *commands[] = {"run", "check"};
        for (int k = 0; k < 2; k++) {
            char line[64];
            snprintf(line, sizeof line, "%s %s", commands[k], decks[i]);
            if (program_run(program, line) != BILLOW_EXIT_INPUT) fail_msg("billow %s: exit %d", line, program->code);
            expect_contains(program->err, decks[i]);
            expect_contains(program->err, "error: ");
            expect_contains(program->err, "1 error");
            if (k == 0) assert_string_equal(program_last_line(program->out), error);
        }
    }
    assert_int_equal(program_count(program), before);
}

static void test_check(void **state)
{
    Program *program = *state;
    program_write_bag(program, "bag.k", 6, NULL);
    program_run(program, "check bag.k");
    expect_code(program, BILLOW_EXIT_NORMAL);
    expect_contains(program->out, "sphere of fabric");
    expect_contains(program->out, "fabric");
    expect_contains(program->out, "airbag 1");
    expect_contains(program->out, "free edges");
    expect_contains(program->out, "T ");
    expect_contains(program->out, "smallest ");
    expect_contains(program->out, "bag.k: no errors");
    assert_int_equal(program_count(program), 1);

    program_write_bag(program, "bad.k", 6, "*MAT_CONCRETE\n         9\n");
    program_run(program, "check bad.k");
    expect_code(program, BILLOW_EXIT_INPUT);
    expect_contains(program->err, "bad.k:");
    expect_contains(program->err, "MAT_CONCRETE");
    assert_int_equal(program_count(program), 2);
}

static void test_failure(void **state)
{
    Program *program = *state;
    program_write_bag(program, "bag.k", 6, NULL);
    program_run(program, "run bag.k -j 1 --end-time 0.001");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_true(program_exists(program, "bag.results/restart.billow"));
    program_run(program, "run bag.k -j 1 --energy-error-limit 1e-15");
    expect_code(program, BILLOW_EXIT_FAILED);
    assert_string_equal(program_last_line(program->out), error);
    expect_contains(program->err, "error: ");
    assert_string_equal(program_summary(program, "bag.results", "status"), "\"failed\"");
    assert_true(strlen(program_summary(program, "bag.results", "cause")) > 2);
    assert_true(program_exists(program, "bag.results/results.vtkhdf"));
    assert_false(program_exists(program, "bag.results/restart.billow")); /* that of the run before is gone */
    char text[1 << 16];
    assert_true(program_read(program, "bag.results/log.txt", text, sizeof text));
    assert_string_equal(program_last_line(text), error);
}

/* Results that cannot be written: exit 3 and a message that names the file. */
static void test_full_disk(void **state)
{
    Program *program = *state;
    struct rlimit limit, small;
    program_write_bag(program, "bag.k", 8, NULL);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    small = limit;
    small.rlim_cur = 40000;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    program_run(program, "run bag.k -j 1");
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    expect_code(program, BILLOW_EXIT_ENVIRONMENT);
    expect_contains(program->err, "bag.results/results.vtkhdf");
    assert_string_equal(program_last_line(program->out), error);
    assert_string_equal(program_summary(program, "bag.results", "status"), "\"failed\"");
}

static void test_threads(void **state)
{
    Program *program = *state;
    char hash[32];
    program_write_bag(program, "bag.k", 8, NULL);
    program_run(program, "run bag.k -j 1 --end-time 0.004");
    expect_code(program, BILLOW_EXIT_NORMAL);
    snprintf(hash, sizeof hash, "%s", program_summary(program, "bag.results", "state_hash"));
    assert_int_equal(setenv("OMP_NUM_THREADS", "3", 1), 0);
    program_run(program, "run bag.k --end-time 0.004");
    assert_int_equal(unsetenv("OMP_NUM_THREADS"), 0);
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_string_equal(program_summary(program, "bag.results", "threads"), "3");
    assert_string_equal(program_summary(program, "bag.results", "state_hash"), hash);
    program_run(program, "run bag.k -j 256 --end-time 0.00001");
    expect_contains(program->err, "warning: 256 threads");
}

int main(void)
{
#define TEST(function) cmocka_unit_test_setup_teardown(function, open_program, close_program)
    const struct CMUnitTest tests[] = {
        TEST(test_help),    TEST(test_normal_run),   TEST(test_quiet_and_dyna_spelling),
        TEST(test_folder),  TEST(test_broken_decks), TEST(test_check),
        TEST(test_failure), TEST(test_full_disk),    TEST(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
