/* The phase before the run from the command line: messages, exit codes, same bits for any number of threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solver/billow.h"
#include "tests/program.h"

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

static void expect_code(const Program *program, int code)
{
    if (program->code != code) fail_msg("exit %d instead of %d: %s", program->code, code, program->err);
}

static void write_scene(const Program *program, const char *name, Scene *scene)
{
    assert_true(scene_ok(scene));
    program_write(program, name, scene->deck.text, scene->deck.length);
    scene_free(scene);
}

/* The last state's hash is the same for one and two threads, and after a restart, which skips the phase. */
static void test_same_bits(void **state)
{
    Program *program = *state;
    Scene scene = {0};
    char hash[64], log[PROGRAM_TEXT];
    scene_prestressed_cushion(&scene, 8);
    write_scene(program, "cushion.k", &scene);
    program_run(program, "run cushion.k -j 1 --end-time 0.004");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_non_null(strstr(program->out, "static equilibrium before the run:"));
    assert_true(program_read(program, "cushion.results/log.txt", log, sizeof log));
    assert_non_null(strstr(log, "static equilibrium: "));
    snprintf(hash, sizeof hash, "%s", program_summary(program, "cushion.results", "state_hash"));
    program_run(program, "run cushion.k -j 2 --end-time 0.004 -q -o two.results");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_string_equal(program_summary(program, "two.results", "state_hash"), hash);
    program_run(program, "run cushion.k -j 2 --end-time 0.006 --restart cushion.results/restart.billow -o on.results");
    expect_code(program, BILLOW_EXIT_NORMAL);
    assert_null(strstr(program->out, "static equilibrium"));
}

/* --relax takes the loads of time 0; nothing holds this sheet against gravity. */
static void test_unsupported(void **state)
{
    Program *program = *state;
    Scene scene = {.deck.exact = true};
    SceneText *deck = &scene.deck;
    scene_add_rectangle(&scene.mesh, 1, SCENE_QUADS, 2, 2, 1, 1);
    scene_begin(deck, "free sheet", 1e-3, 0.9);
    scene_write_part(deck, 1, 1, 1, "sheet");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_write_elastic(deck, 1, 800, 2e8, 0.3);
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_gravity(deck, 1, 9.81);
    scene_end(deck, &scene.mesh);
    write_scene(program, "sheet.k", &scene);
    program_run(program, "run sheet.k --relax");
    expect_code(program, BILLOW_EXIT_FAILED);
    assert_non_null(strstr(program->err, "moves the unsupported piece of node 1, 2, 3"));
    assert_non_null(strstr(program->err, "*BOUNDARY_SPC"));
    assert_string_equal(program_last_line(program->out), "E r r o r   t e r m i n a t i o n");
    assert_string_equal(program_summary(program, "sheet.results", "status"), "\"failed\"");
    program_run(program, "run sheet.k");
    expect_code(program, BILLOW_EXIT_NORMAL);
    program_run(program, "check sheet.k --relax");
    expect_code(program, BILLOW_EXIT_NORMAL);
}

/* Contact does not act in the phase: a deck that wants both is refused. */
static void test_contact(void **state)
{
    Program *program = *state;
    Scene scene = {.deck.exact = true};
    SceneText *deck = &scene.deck;
    scene_add_rectangle(&scene.mesh, 1, SCENE_QUADS, 2, 2, 1, 1);
    scene_begin(deck, "sheet that meets itself", 1e-3, 0.9);
    scene_write_part(deck, 1, 1, 1, "sheet");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_write_elastic(deck, 1, 800, 2e8, 0.3);
    scene_print(deck, "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0,5\n\n\n");
    scene_end(deck, &scene.mesh);
    write_scene(program, "layers.k", &scene);
    program_run(program, "check layers.k --relax");
    expect_code(program, BILLOW_EXIT_INPUT);
    assert_non_null(strstr(program->err, "contact takes no part in the equilibrium before the run"));
    program_run(program, "check layers.k");
    expect_code(program, BILLOW_EXIT_NORMAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_same_bits, open_program, close_program),
        cmocka_unit_test_setup_teardown(test_unsupported, open_program, close_program),
        cmocka_unit_test_setup_teardown(test_contact, open_program, close_program),
    };
    return cmocka_run_group_tests_name("relaxation from the command line", tests, NULL, NULL);
}
