/* The command line: both spellings, every option, refusals, folder and thread defaults. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "solver/options.h"

enum { MOST_WORDS = 24 };

/* Splits line at blanks (no quoting) and parses it as the words behind "billow". */
static int parse(const char *line, Options *options)
{
    static char text[512];
    char *words[MOST_WORDS + 1] = {"billow"};
    int count = 1;
    snprintf(text, sizeof text, "%s", line);
    for (char *word = strtok(text, " "); word && count < MOST_WORDS; word = strtok(NULL, " ")) words[count++] = word;
    return options_parse(count, words, options);
}

static void test_run_spelling(void **state)
{
    (void)state;
    Options options;
    assert_int_equal(parse("run a/b.k", &options), 0);
    assert_int_equal(options.command, COMMAND_RUN);
    assert_string_equal(options.deck, "a/b.k");
    assert_null(options.directory);
    assert_null(options.restart);
    assert_int_equal(options.threads, 0);
    assert_false(options.quiet);
    assert_true(options.build.end_time == 0.0);

    assert_int_equal(
        parse("run -o out -j 4 b.k --end-time 2.5e-2 --restart out/r --quiet --one-point-quads "
              "--caps-push-rim --walls-block --all-explicit --energy-error-limit 0.3 --sensor-library ./s.so",
              &options),
        0);
    assert_string_equal(options.build.sensor_library, "./s.so");
    assert_string_equal(options.directory, "out");
    assert_int_equal(options.threads, 4);
    assert_string_equal(options.deck, "b.k");
    assert_true(options.build.end_time == 2.5e-2);
    assert_string_equal(options.restart, "out/r");
    assert_true(options.quiet);
    assert_true(options.build.one_point_quads);
    assert_true(options.build.caps_push_rim);
    assert_true(options.build.walls_block);
    assert_true(options.build.all_explicit);
    assert_true(options.build.energy_error_limit == 0.3);

    assert_int_equal(parse("run -j3 -oout --end-time=7 -q -- -odd.k", &options), 0);
    assert_int_equal(options.threads, 3);
    assert_string_equal(options.directory, "out");
    assert_true(options.build.end_time == 7.0);
    assert_true(options.quiet);
    assert_string_equal(options.deck, "-odd.k");
}

static void test_dyna_spelling(void **state)
{
    (void)state;
    Options options;
    assert_int_equal(parse("i=deck.k ncpu=2 endtime=0.5 jobid=job7 r=old/restart.billow memory=200m", &options), 0);
    assert_int_equal(options.command, COMMAND_RUN);
    assert_string_equal(options.deck, "deck.k");
    assert_int_equal(options.threads, 2);
    assert_true(options.build.end_time == 0.5);
    assert_string_equal(options.job, "job7");
    assert_string_equal(options.restart, "old/restart.billow");
    assert_int_equal(options.note_count, 1);
    assert_non_null(strstr(options.notes[0], "memory=200m"));

    assert_int_equal(parse("I=deck=2.k NCPU=-4", &options), 0);
    assert_string_equal(options.deck, "deck=2.k");
    assert_int_equal(options.threads, 4);
    assert_int_equal(options.note_count, 0);
}

static void test_other_commands(void **state)
{
    (void)state;
    Options options;
    assert_int_equal(parse("--version", &options), 0);
    assert_int_equal(options.command, COMMAND_VERSION);
    assert_int_equal(parse("--help", &options), 0);
    assert_int_equal(options.command, COMMAND_HELP);
    assert_int_equal(parse("run --help", &options), 0);
    assert_int_equal(options.command, COMMAND_RUN_HELP);
    assert_int_equal(parse("run x.k --help", &options), 0);
    assert_int_equal(options.command, COMMAND_RUN_HELP);
    assert_int_equal(parse("check --help", &options), 0);
    assert_int_equal(options.command, COMMAND_CHECK_HELP);
    assert_int_equal(parse("check x.k --one-point-quads", &options), 0);
    assert_int_equal(options.command, COMMAND_CHECK);
    assert_string_equal(options.deck, "x.k");
    assert_true(options.build.one_point_quads);
}

/* Every refused line with a word that the message must contain. */
static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *line, *word;
    } cases[] = {
        {"", "billow run DECK"},
        {"deck.k", "deck.k"},
        {"run", "no deck"},
        {"check", "no deck"},
        {"run a.k b.k", "b.k"},
        {"run a.k --outptu x", "--outptu"},
        {"run a.k -x", "-x"},
        {"run a.k -j", "-j"},
        {"run a.k -j 0", "'0'"},
        {"run a.k -j two", "two"},
        {"run a.k -j 257", "257"},
        {"run a.k -j 2x", "2x"},
        {"run a.k --end-time -1", "-1"},
        {"run a.k --end-time nan", "nan"},
        {"run a.k --end-time inf", "inf"},
        {"run a.k --energy-error-limit 0", "'0'"},
        {"run a.k --quiet=1", "--quiet=1"},
        {"run a.k --restart", "--restart"},
        {"run a.k --restart=", "--restart="},
        {"check a.k -o out", "check"},
        {"i=a.k ncpus=2", "ncpus=2"},
        {"i=a.k endtime=", "endtime="},
        {"i=a.k -j 2", "-j"},
        {"i=a.k i=b.k", "b.k"},
        {"ncpu=2", "i=DECK"},
        {"i=a.k ncpu=0", "'0'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Options options;
        if (parse(cases[i].line, &options) != -1) fail_msg("accepted: billow %s", cases[i].line);
        if (!strstr(options.error, cases[i].word)) fail_msg("billow %s: %s", cases[i].line, options.error);
    }
}

static void test_long_words(void **state)
{
    (void)state;
    static char word[5000];
    memset(word, 'x', sizeof word - 1);
    char *words[] = {"billow", "run", "a.k", word};
    Options options;
    assert_int_equal(options_parse(4, words, &options), -1);
    assert_true(strlen(options.error) < sizeof options.error);
    word[0] = '-';
    assert_int_equal(options_parse(4, words, &options), -1);
}

static void expect_directory(const char *line, const char *expected)
{
    Options options;
    char directory[64];
    assert_int_equal(parse(line, &options), 0);
    assert_int_equal(options_directory(&options, directory, sizeof directory), 0);
    assert_string_equal(directory, expected);
}

static void test_directory(void **state)
{
    (void)state;
    expect_directory("run deck.k", "deck.results");
    expect_directory("run ../some.where/deck.key", "deck.results");
    expect_directory("run some.where/deck", "deck.results");
    expect_directory("run bag.v2.k", "bag.v2.results");
    expect_directory("run .k", ".k.results");
    expect_directory("run deck.k -o here/out", "here/out");
    expect_directory("i=deck.k jobid=case3", "case3.results");
    Options options;
    char small[8];
    assert_int_equal(parse("run deck.k", &options), 0);
    assert_int_equal(options_directory(&options, small, sizeof small), -1);
}

static void test_threads(void **state)
{
    (void)state;
    Options options = {.threads = 3};
    assert_int_equal(options_threads(&options, "8", 2), 3);
    options.threads = 0;
    assert_int_equal(options_threads(&options, "8", 2), 8);
    assert_int_equal(options_threads(&options, "4,2", 2), 4);
    assert_int_equal(options_threads(&options, "many", 2), 2);
    assert_int_equal(options_threads(&options, "-3", 2), 2);
    assert_int_equal(options_threads(&options, NULL, 6), 6);
    assert_int_equal(options_threads(&options, "100000", 2), BILLOW_MAX_THREADS);
    assert_true(options_processors() >= 1);
}

static void test_fold(void **state)
{
    (void)state;
    Options options;
    assert_int_equal(parse("fold a.k folds.txt -o b.k", &options), 0);
    assert_int_equal(options.command, COMMAND_FOLD);
    assert_string_equal(options.deck, "a.k");
    assert_string_equal(options.folds, "folds.txt");
    assert_string_equal(options.directory, "b.k");
    assert_int_equal(parse("fold --help", &options), 0);
    assert_int_equal(options.command, COMMAND_FOLD_HELP);
    assert_int_equal(parse("fold a.k", &options), -1);
    assert_int_equal(parse("fold a.k b.txt c.txt", &options), -1);
    assert_int_equal(parse("fold a.k b.txt -o", &options), -1);
    assert_int_equal(parse("fold a.k b.txt --quiet", &options), -1);
    assert_non_null(strstr(options.error, "no meaning for billow fold"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_run_spelling),   cmocka_unit_test(test_dyna_spelling),
        cmocka_unit_test(test_other_commands), cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_long_words),     cmocka_unit_test(test_directory),
        cmocka_unit_test(test_threads),        cmocka_unit_test(test_fold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
