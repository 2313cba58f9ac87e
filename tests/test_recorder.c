/* The recorder's decisions: what a cycle asks for, sense switches, the energy warning. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "solver/recorder.h"
#include "solver/schedule.h"

static const char switch_file[] = "test_recorder.d3kil";

/* A recorder without files, at cycle 7 of a run whose next states are due at time 2. */
typedef struct Scenario {
    Model model;
    Clock clock;
    Energies energy;
    State state;
    Diagnostics diagnostics;
    Log log;
    Recorder recorder;
    RunHooks hooks;
} Scenario;

static void set_up(Scenario *s)
{
    memset(s, 0, sizeof *s);
    s->model.end_time = 10.0;
    s->clock = (Clock){.time = 1.0, .step = 0.1, .step_next = 0.1, .cycle = 7, .next_states = 2.0};
    s->energy = (Energies){.kinetic = 1.0, .internal = 1.0, .external_work = 2.0, .largest = 2.0, .ratio = 1.0};
    s->state = (State){.clock = &s->clock, .energy = &s->energy};
    s->recorder = (Recorder){.state = &s->state,
                             .diagnostics = &s->diagnostics,
                             .log = &s->log,
                             .plan = {.states = 1.0},
                             .progress = {.quiet = true, .stream = stdout},
                             .switch_file = switch_file};
    s->hooks = recorder_hooks(&s->recorder);
}

static bool ask(Scenario *s, bool last)
{
    return s->hooks.due(s->hooks.user, &s->model, &s->state, last);
}

static void write_switch(Scenario *s, const char *text)
{
    FILE *file = fopen(switch_file, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    s->recorder.next_look = 0.0;
}

static void test_asks_when_due(void **state)
{
    (void)state;
    Scenario s;
    set_up(&s);
    assert_false(ask(&s, false));
    assert_true(ask(&s, true));
    s.clock.time = 1.95;
    assert_true(ask(&s, false));
    assert_int_equal(s.recorder.due, SCHEDULE_STATES);
    s.clock.time = 1.0;
    s.recorder.plan.restart = 7.0;
    assert_true(ask(&s, false));
    assert_true(s.recorder.want_checkpoint);
}

static void test_switches(void **state)
{
    (void)state;
    Scenario s;
    set_up(&s);
    write_switch(&s, "sw3");
    assert_true(ask(&s, false));
    assert_true(s.recorder.want_checkpoint);
    assert_false(s.recorder.stop);
    assert_int_not_equal(access(switch_file, F_OK), 0);

    set_up(&s);
    write_switch(&s, "sw4");
    assert_true(ask(&s, false));
    assert_true(s.recorder.want_states);
    assert_false(s.recorder.want_checkpoint || s.recorder.stop);

    set_up(&s);
    write_switch(&s, "sw9");
    assert_false(ask(&s, false));

    set_up(&s);
    write_switch(&s, "sw1");
    assert_true(ask(&s, false));
    assert_true(s.recorder.stop && s.recorder.stopped_by_user);

    /* Not looked for again within half a second. */
    set_up(&s);
    assert_false(ask(&s, false));
    const double next = s.recorder.next_look;
    write_switch(&s, "sw1");
    s.recorder.next_look = next;
    assert_false(ask(&s, false));
    assert_int_equal(unlink(switch_file), 0);
}

static void test_energy_warning(void **state)
{
    (void)state;
    Scenario s;
    set_up(&s);
    ask(&s, false);
    assert_int_equal(s.diagnostics.warnings, 0);
    s.energy.kinetic = 1.039; /* off by 1.95 % of the largest given */
    s.energy.ratio = 2.039 / 2.0;
    ask(&s, false);
    assert_int_equal(s.diagnostics.warnings, 0);
    s.energy.kinetic = 0.959; /* 2.05 %, the other way */
    s.energy.ratio = 1.959 / 2.0;
    ask(&s, false);
    ask(&s, false);
    s.energy.kinetic = 1.0; /* two cycles: velocities that jump, nothing lost */
    ask(&s, false);
    s.energy.kinetic = 0.959;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(s.diagnostics.warnings, 0);
        ask(&s, false);
    }
    assert_int_equal(s.diagnostics.warnings, 1);
    assert_non_null(strstr(s.diagnostics.messages[0].text, "cycle 7"));
    ask(&s, false);
    assert_int_equal(s.diagnostics.warnings, 1);
    diagnostics_free(&s.diagnostics);
    assert_true(recorder_energy_error(&(Energies){0}) == 0.0);
}

static void test_fabric_warning(void **state)
{
    (void)state;
    Scenario s;
    set_up(&s);
    s.model.energy_error_limit = 0.1;
    s.energy = (Energies){.kinetic = 2.19, .internal = -0.19, .external_work = 2.0, .largest = 2.0, .ratio = 1.0};
    ask(&s, false);
    assert_int_equal(s.diagnostics.warnings, 0);
    s.energy.internal = -0.21;
    s.energy.judged_from = 20; /* not yet */
    ask(&s, false);
    assert_int_equal(s.diagnostics.warnings, 0);
    s.energy.judged_from = 0;
    ask(&s, false);
    ask(&s, false);
    assert_int_equal(s.diagnostics.warnings, 1);
    assert_non_null(strstr(s.diagnostics.messages[0].text, "10.5 % of the loads' energy"));
    diagnostics_free(&s.diagnostics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_asks_when_due),
        cmocka_unit_test(test_switches),
        cmocka_unit_test(test_energy_warning),
        cmocka_unit_test(test_fabric_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
