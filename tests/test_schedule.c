/* Output times: LS-DYNA's rule, exact multiples over many rows, short intervals, defaults, checkpoints. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "solver/schedule.h"

static void assert_close(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-9 * fabs(expected))) fail_msg("%.17g instead of %.17g", value, expected);
}

/* Runs a clock of constant step to the end (last step shortened) and collects the times at which states are due. */
static int collect(double interval, double step, double end, double *times, int capacity)
{
    const OutputPlan plan = {.states = interval};
    Clock clock = {.step_next = step};
    int count = 0;
    while (clock.time < end) {
        if (clock.time + clock.step_next > end) clock.step_next = end - clock.time;
        const unsigned due = schedule_due(&plan, &clock);
        if (due && count < capacity) times[count] = clock.time;
        if (due) count++;
        schedule_advance(&plan, &clock, due);
        clock.time += clock.step_next;
        clock.cycle++;
    }
    return count;
}

static void test_last_cycle_before(void **state)
{
    (void)state;
    double times[16];
    /* Cycles at multiples of 0.3: before 1 lies 0.9, before 2 lies 1.8, 3.0 is met (to rounding). */
    const int count = collect(1.0, 0.3, 3.7, times, 16);
    assert_int_equal(count, 4);
    assert_true(times[0] == 0.0);
    assert_close(times[1], 0.9);
    assert_close(times[2], 1.8);
    assert_close(times[3], 3.0);
}

static void test_met_exactly(void **state)
{
    (void)state;
    static double times[2000];
    /* The step divides the interval: rounding of time sums must not make a row early, double or lost. */
    const int count = collect(0.01, 0.001, 10.0, times, 2000);
    assert_int_equal(count, 1000);
    for (int i = 0; i < count; i++) assert_close(times[i], 0.01 * i);
}

static void test_interval_below_step(void **state)
{
    (void)state;
    double times[128];
    assert_int_equal(collect(0.01, 0.125, 1.0, times, 128), 8);
    assert_int_equal(collect(1e-300, 0.125, 1.0, times, 128), 8);
}

static void test_next_is_a_multiple(void **state)
{
    (void)state;
    const OutputPlan plan = {.glstat = 0.1, .abstat = 0.3};
    Clock clock = {.time = 0.25, .step_next = 0.1};
    const unsigned due = schedule_due(&plan, &clock);
    assert_int_equal(due, SCHEDULE_GLSTAT | SCHEDULE_ABSTAT);
    schedule_advance(&plan, &clock, due);
    assert_true(clock.next_glstat == 4.0 * 0.1);
    assert_true(clock.next_abstat == 2.0 * 0.3);
    assert_true(clock.next_states == 0.0);
    assert_int_equal(schedule_due(&plan, &clock), 0);
}

/* At time 0 everything is due even if the first step is not known yet. */
static void test_start(void **state)
{
    (void)state;
    const OutputPlan plan = {.states = 1.0,
                             .glstat = 1.0,
                             .abstat = 1.0,
                             .nodout = 1.0,
                             .rbdout = 1.0,
                             .rcforc = 1.0,
                             .rwforc = 1.0,
                             .gceout = 1.0,
                             .matsum = 1.0};
    const Clock clock = {0};
    assert_int_equal(schedule_due(&plan, &clock), SCHEDULE_ALL);
    assert_int_equal(schedule_kinds(&plan), SCHEDULE_ALL);
}

static void test_defaults(void **state)
{
    (void)state;
    Diagnostics diagnostics = {0};
    OutputPlan bare = {.restart = 100.0};
    schedule_fill_plan(&bare, 10.0, &diagnostics);
    assert_close(bare.states, 0.5);
    assert_close(bare.glstat, 0.05);
    assert_close(bare.matsum, 0.05);
    assert_int_equal(diagnostics.count, 1);

    OutputPlan some = {.abstat = 0.25};
    schedule_fill_plan(&some, 10.0, &diagnostics);
    assert_close(some.states, 0.5);
    assert_true(some.abstat == 0.25);
    assert_true(some.matsum == 0.0);
    assert_int_equal(diagnostics.count, 2);

    OutputPlan whole = {.states = 1.0, .glstat = 2.0, .abstat = 3.0};
    const OutputPlan before = whole;
    schedule_fill_plan(&whole, 10.0, &diagnostics);
    assert_memory_equal(&whole, &before, sizeof whole);
    assert_int_equal(diagnostics.count, 2);
    assert_int_equal(diagnostics_exit_code(&diagnostics), BILLOW_EXIT_NORMAL);
    diagnostics_free(&diagnostics);
}

static void test_checkpoints(void **state)
{
    (void)state;
    const OutputPlan plan = {.restart = 10.0}, none = {0};
    Clock clock = {0};
    assert_false(schedule_checkpoint_due(&plan, &clock));
    int count = 0;
    for (clock.cycle = 1; clock.cycle <= 35; clock.cycle++) {
        count += schedule_checkpoint_due(&plan, &clock);
        assert_false(schedule_checkpoint_due(&none, &clock));
    }
    assert_int_equal(count, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_last_cycle_before),
        cmocka_unit_test(test_met_exactly),
        cmocka_unit_test(test_interval_below_step),
        cmocka_unit_test(test_next_is_a_multiple),
        cmocka_unit_test(test_start),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_checkpoints),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
