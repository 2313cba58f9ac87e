/* Histories of a run: restart, and failing folders, disks and memory. */
#include "tests/results_case.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "solver/memory.h"

static const char *const history_names[] = {"glstat.csv", "glstat",     "abstat.csv", "abstat_parts.csv",
                                            "abstat",     "nodout.csv", "nodout",     "rbdout.csv",
                                            "rbdout",     "matsum.csv", "matsum"};
enum { NAME_COUNT = sizeof history_names / sizeof history_names[0] };

/* "Run, restart, run" leaves the very bytes of an uninterrupted run, also if the killed run had written on, its last
 * row is half there, or the restarted run emits the restart's own time again. */
static void test_restart_gives_same_bytes(void **unused)
{
    (void)unused;
    const double all[5] = {0, 0.1, 0.2, 1.0 / 3, 0.7}, later[3] = {0.2, 1.0 / 3, 0.7};
    char *whole[NAME_COUNT];
    write_run(false, 0, all, 5);
    for (int i = 0; i < NAME_COUNT; i++) {
        whole[i] = read_whole(history_names[i]);
        assert_non_null(whole[i]);
        FILE *file = fopen(in_folder(history_names[i]), "a");
        assert_non_null(file);
        fprintf(file, "0.9,1");
        fclose(file);
    }
    for (int variant = 0; variant < 3; variant++) {
        const double restart = variant == 0 ? 0.2 : variant == 1 ? 0.15 : 5;
        write_run(true, restart, later, 3);
        for (int i = 0; i < NAME_COUNT; i++) {
            char *text = read_whole(history_names[i]);
            assert_string_equal(text, whole[i]);
            free(text);
        }
    }
    for (int i = 0; i < NAME_COUNT; i++) free(whole[i]);
}

/* The restart's own time belongs to what is kept. */
static void test_restart_keeps_its_time(void **unused)
{
    (void)unused;
    const double all[3] = {0, 0.1, 0.2};
    write_run(false, 0, all, 2);
    char *whole = read_whole("matsum.csv"), *whole_ascii = read_whole("matsum");
    write_run(false, 0, all, 3);
    write_run(true, 0.1, all, 0);
    char *kept = read_whole("matsum.csv"), *kept_ascii = read_whole("matsum");
    assert_string_equal(kept, whole);
    assert_string_equal(kept_ascii, whole_ascii);
    free(whole), free(whole_ascii), free(kept), free(kept_ascii);
}

static void test_restart_into_empty_folder(void **unused)
{
    (void)unused;
    const double later[1] = {0.7};
    write_run(true, 0.5, later, 1);
    char *text = read_whole("matsum.csv");
    assert_int_equal(strncmp(text, "time,part,", 10), 0);
    free(text);
}

static void test_restart_refuses_other_columns(void **unused)
{
    (void)unused;
    Results *results = NULL;
    FILE *file = fopen(in_folder("glstat.csv"), "w");
    fprintf(file, "time,kinetic_energy\n0,1\n");
    fclose(file);
    assert_int_equal(results_open(folder, &small.model, true, 1, &results, &diagnostics), -1);
    assert_null(results);
    assert_int_equal(diagnostics.environment, 1);
    assert_non_null(strstr(diagnostics.messages[0].text, "glstat.csv"));
}

/* A folder used anew keeps nothing of the run before; a model without bags, rigid parts and history nodes has no files
 * of theirs. */
static void test_old_files_go(void **unused)
{
    (void)unused;
    const double times[1] = {0};
    write_run(false, 0, times, 1);
    FILE *file = fopen(in_folder("rcforc.csv"), "w");
    fclose(file);
    small.model.airbag_count = 0;
    small.model.output.history_count = 0;
    small.parts[1].material_kind = small.parts[2].material_kind = MATERIAL_FABRIC;
    write_run(false, 0, times, 1);
    static const char *const gone[] = {"abstat.csv", "abstat_parts.csv", "abstat",     "nodout.csv",
                                       "nodout",     "rbdout.csv",       "rcforc.csv", "rwforc.csv"};
    for (size_t i = 0; i < sizeof gone / sizeof gone[0]; i++) assert_int_not_equal(access(in_folder(gone[i]), F_OK), 0);
    assert_int_equal(access(in_folder("glstat.csv"), F_OK), 0);
}

static void test_bad_folders(void **unused)
{
    (void)unused;
    Results *results = NULL;
    assert_int_equal(results_open("no/such/folder", &small.model, false, 0, &results, &diagnostics), -1);
    assert_int_equal(results_open("/dev/null", &small.model, false, 0, &results, &diagnostics), -1);
    assert_null(results);
    assert_int_equal(diagnostics.environment, 2);
    assert_non_null(strstr(diagnostics.messages[0].text, "no/such/folder"));
    assert_non_null(strstr(diagnostics.messages[1].text, "not a folder"));
}

/* A full disk is an error at once, reported once, and other histories go on. */
static void test_full_disk(void **unused)
{
    (void)unused;
    if (access("/dev/full", W_OK)) {
        print_message("skipped: no /dev/full\n");
        skip();
    }
    Results *results = open_results(false, 0);
    assert_int_equal(symlink("/dev/full", in_folder("glstat.csv")), 0);
    for (int i = 0; i < 3; i++) {
        small_set_time(&small, i);
        assert_int_equal(results_write_glstat(results, &small.model, &small.state, &small.view), -1);
        assert_int_equal(results_write_matsum(results, &small.model, &small.state, &small.view), 0);
    }
    assert_int_equal(diagnostics.environment, 1);
    assert_non_null(strstr(diagnostics.messages[0].text, "glstat.csv"));
    results_close(results);
    char *text = read_whole("matsum.csv");
    assert_non_null(strstr(text, "\n2,30,"));
    free(text);
}

/* Where a block does not fit, the files end with the block before, and writing goes on when there is room again. */
static void test_whole_blocks(void **unused)
{
    (void)unused;
    struct rlimit before, tight;
    Results *results = open_results(false, 0);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    small_set_time(&small, 0);
    assert_int_equal(results_write_nodout(results, &small.model, &small.state, &small.view), 0);
    char *first = read_whole("nodout.csv"), *first_ascii = read_whole("nodout");
    tight = before;
    tight.rlim_cur = strlen(first) + 50;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
    small_set_time(&small, 1);
    int status = results_write_nodout(results, &small.model, &small.state, &small.view);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, handler);
    assert_int_equal(status, -1);
    assert_int_equal(diagnostics.environment, 1);
    char *text = read_whole("nodout.csv"), *ascii = read_whole("nodout");
    assert_string_equal(text, first);
    assert_string_equal(ascii, first_ascii);
    assert_int_equal(results_write_nodout(results, &small.model, &small.state, &small.view), 0);
    assert_int_equal(results_close(results), 0);
    char *second = read_whole("nodout.csv");
    assert_int_equal(strncmp(second, first, strlen(first)), 0);
    assert_non_null(strstr(second, "\n1,107,"));
    free(first), free(first_ascii), free(text), free(ascii), free(second);
}

/* Every allocation may fail: an error each time, nothing lost. */
static void test_failing_allocations(void **unused)
{
    (void)unused;
    size_t held = memory_in_use();
    for (long k = 1; k < 1000; k++) {
        Results *results = NULL;
        Diagnostics messages = {0};
        memory_fail_after(k);
        int status = results_open(folder, &small.model, false, 0, &results, &messages);
        if (status == 0) {
            status = write_histories(results, 1);
            status |= results_write_state(results, &small.model, &small.state, &small.view);
        }
        memory_fail_after(0);
        results_close(results);
        diagnostics_free(&messages);
        assert_int_equal(memory_in_use(), held);
        if (status == 0) {
            assert_true(k > 10);
            return;
        }
    }
    fail_msg("never succeeded");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_restart_gives_same_bytes, setup, teardown),
        cmocka_unit_test_setup_teardown(test_restart_keeps_its_time, setup, teardown),
        cmocka_unit_test_setup_teardown(test_restart_into_empty_folder, setup, teardown),
        cmocka_unit_test_setup_teardown(test_restart_refuses_other_columns, setup, teardown),
        cmocka_unit_test_setup_teardown(test_old_files_go, setup, teardown),
        cmocka_unit_test_setup_teardown(test_bad_folders, setup, teardown),
        cmocka_unit_test_setup_teardown(test_full_disk, setup, teardown),
        cmocka_unit_test_setup_teardown(test_whole_blocks, setup, teardown),
        cmocka_unit_test_setup_teardown(test_failing_allocations, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
