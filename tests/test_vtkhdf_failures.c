/* results.vtkhdf and results.xdmf: restart, killed and live runs, damaged files and full disks. */
#include "tests/vtkhdf_case.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

static void test_restart(void **unused)
{
    (void)unused;
    const double first[4] = {0, 0.25, 0.5, 0.75}, later[3] = {0.25, 0.6, 0.7}, all[4] = {0, 0.25, 0.6, 0.7};
    write_run(false, 0, first, 4);
    write_run(true, 0.25, later, 3);
    check_states(all, 4);
    write_run(true, 0.6, three, 0);
    check_states(all, 3);
    write_run(true, -1, three, 3);
    check_states(three, 3);
}

/* A run killed without any clean-up: the file opens, read by a program that locks it or not, with all its states. */
static void test_killed_run(void **unused)
{
    (void)unused;
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        Results *results = NULL;
        if (results_open(folder, &small.model, false, 0, &results, &diagnostics)) _exit(1);
        for (int i = 0; i < 3; i++)
            if (write_state(results, three[i])) _exit(1);
        raise(SIGKILL);
    }
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    check_states(three, 3);
    check_xdmf(3);
    write_run(true, 0.3, three, 3);
    check_states(three, 3);
}

/* The file of a live run opens for others at any time between two states. */
static void test_live_run(void **unused)
{
    (void)unused;
    int status = 0;
    Results *results = open_results(false, 0);
    assert_int_equal(write_state(results, three[0]), 0);
    assert_int_equal(write_state(results, three[1]), 0);
    pid_t child = fork();
    if (child == 0) {
        char command[256];
        snprintf(command, sizeof command, "h5dump -a /VTKHDF/Steps/NSteps %s | grep -q '(0): 2'", grid_path);
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    if (system("command -v h5dump >/dev/null"))
        print_message("skipped: no h5dump\n");
    else
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_int_equal(write_state(results, three[2]), 0);
    assert_int_equal(results_close(results), 0);
    check_states(three, 3);
}

static void test_restart_of_another_model(void **unused)
{
    (void)unused;
    Results *results = NULL;
    write_run(false, 0, three, 3);
    small.model.node_count--;
    assert_int_equal(results_open(folder, &small.model, true, 1, &results, &diagnostics), -1);
    small.model.node_count++;
    assert_int_equal(diagnostics.environment, 1);
    assert_non_null(strstr(diagnostics.messages[0].text, "another model"));
    check_states(three, 3);
}

/* What cannot be read is kept, with a warning, and the run goes on in a new file. */
static void test_restart_of_damaged_file(void **unused)
{
    (void)unused;
    write_run(false, 0, three, 3);
    assert_int_equal(truncate(grid_path, 3000), 0);
    write_run(true, 0.25, three + 2, 1);
    assert_int_equal(diagnostics.warnings, 1);
    assert_non_null(strstr(diagnostics.messages[0].text, "results.vtkhdf.damaged"));
    check_states(three + 2, 1);
    check_xdmf(1);
}

/* Writes a state that does not fit; nothing may change on the disk. */
static void write_beyond_limit(Results *results, double time)
{
    struct rlimit before, tight;
    struct stat file, after;
    assert_int_equal(stat(grid_path, &file), 0);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    tight = before;
    tight.rlim_cur = (rlim_t)file.st_size + 200;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
    int first = write_state(results, time), second = write_state(results, time);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, handler);
    assert_int_equal(first, -1);
    assert_int_equal(second, -1);
    assert_int_equal(stat(grid_path, &after), 0);
    assert_int_equal(after.st_size, file.st_size);
}

/* The disk runs full: the earlier states stay readable, and the run can go on when there is room again. */
static void test_full_disk(void **unused)
{
    (void)unused;
    const double written[2] = {three[0], three[2]};
    Results *results = open_results(false, 0);
    assert_int_equal(write_state(results, three[0]), 0);
    write_beyond_limit(results, three[1]);
    assert_int_equal(diagnostics.environment, 1);
    assert_non_null(strstr(diagnostics.messages[0].text, "results.vtkhdf: File too large"));
    check_xdmf(1);
    assert_int_equal(write_state(results, three[2]), 0);
    write_beyond_limit(results, 1);
    assert_int_equal(results_close(results), 0);
    check_states(written, 2);
    check_xdmf(2);
}

/* A folder that cannot take the file at all. */
static void test_no_file(void **unused)
{
    (void)unused;
    Results *results = open_results(false, 0);
    assert_int_equal(mkdir(grid_path, 0777), 0);
    assert_int_equal(write_state(results, 0), -1);
    assert_int_equal(diagnostics.environment, 1);
    assert_int_equal(results_close(results), 0);
    assert_int_equal(rmdir(grid_path), 0);
}

int main(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_restart, setup, teardown),
        cmocka_unit_test_setup_teardown(test_killed_run, setup, teardown),
        cmocka_unit_test_setup_teardown(test_live_run, setup, teardown),
        cmocka_unit_test_setup_teardown(test_restart_of_another_model, setup, teardown),
        cmocka_unit_test_setup_teardown(test_restart_of_damaged_file, setup, teardown),
        cmocka_unit_test_setup_teardown(test_full_disk, setup, teardown),
        cmocka_unit_test_setup_teardown(test_no_file, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
