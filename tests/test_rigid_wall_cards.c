/* Cards of rigid walls: what they select and what is refused, all in one list with its lines. */
#include "tests/wall_case.h"

#include <stdio.h>
#include <string.h>

#include "solver/memory.h"
#include "tests/program.h"

/* A deck of one square of masses with these wall cards, which begin at line 5. */
static void build(VerifyRun *run, const char *cards, int expected)
{
    Scene scene = {0};
    scene_print(&scene.deck, "*KEYWORD\n*CONTROL_TERMINATION\n1\n$\n%s", cards);
    scene_write_part(&scene.deck, 1, 1, 1, "masses");
    scene_write_section(&scene.deck, 1, 9, 1);
    scene_write_null(&scene.deck, 1, 4);
    scene_print(&scene.deck, "*SET_NODE_LIST\n1\n1,2,3\n*SET_NODE_LIST\n2\n3\n*DEFINE_BOX\n3,-.5,.5,-.5,2,-9,9\n");
    wall_add_square(&scene, 0, 0, 1);
    scene_end(&scene.deck, &scene.mesh);
    assert_true(scene_ok(&scene));
    int status = verify_build(run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
    scene_free(&scene);
    if ((status != 0) != (expected != 0) || run->diagnostics.errors != expected)
        diagnostics_print(&run->diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(run->diagnostics.errors, expected);
    assert_int_equal(status != 0, expected != 0);
}

static void expect_error(const VerifyRun *run, int line, const char *keyword, const char *text)
{
    for (size_t i = 0; i < run->diagnostics.count; i++) {
        const Message *m = &run->diagnostics.messages[i];
        if (m->severity == SEVERITY_ERROR && m->source.line == line && strstr(m->keyword, keyword) &&
            strstr(m->text, text))
            return;
    }
    diagnostics_print(&run->diagnostics, SEVERITY_NOTE, stderr);
    fail_msg("no error in line %d of %s with '%s'", line, keyword, text);
}

static int tracked(const RigidWall *wall, const Model *model)
{
    int count = 0;
    for (int i = 0; i < model->moving_count; i++) count += wall->tracked[i];
    return count;
}

static void nodes_are_selected(void **state)
{
    (void)state;
    static const struct {
        const char *card;
        int nodes;
    } cases[] = {{"0,0,0", 4}, {"1,0,0", 3}, {"1,2,0", 2}, {"0,2,3", 2}, {"0,0,3", 2}, {"0,0,0,.5", 0}, {"0,0,0,2", 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        VerifyRun run;
        char cards[200];
        snprintf(cards, sizeof cards, "*RIGIDWALL_PLANAR_ID\n         9table\n%s\n0,0,0,0,0,1\n", cases[i].card);
        build(&run, cards, 0);
        assert_int_equal(run.model.wall_count, 1);
        assert_int_equal(run.model.walls[0].id, 9);
        assert_string_equal(run.model.walls[0].title, "table");
        assert_int_equal(run.model.walls[0].node_count, cases[i].nodes);
        assert_int_equal(tracked(&run.model.walls[0], &run.model), cases[i].nodes);
        if (cases[i].nodes == 0) assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "no nodes to act on"));
        verify_free(&run);
    }
}

/* A wall that ends before it begins is warned of with its line. */
static void times_are_in_order(void **state)
{
    (void)state;
    VerifyRun run;
    build(&run, "*RIGIDWALL_PLANAR\n0,0,0,0,2,1\n0,0,0,0,0,1\n*RIGIDWALL_PLANAR\n0,0,0,0,2\n0,0,0,0,0,1\n", 0);
    assert_int_equal(verify_message(&run.diagnostics, SEVERITY_WARNING, "DEATH = 1 is not after BIRTH = 2"), 1);
    assert_int_equal(run.diagnostics.warnings, 1);
    verify_free(&run);
}

static void options_come_in_any_order(void **state)
{
    (void)state;
    VerifyRun run;
    build(&run,
          "*RIGIDWALL_PLANAR_MOVING_FINITE_FORCES_ID\n         4lid\n0\n0,0,0,0,0,2,.5\n3,0,7,2,5\n10,-3\n2,0\n"
          "*RIGIDWALL_GEOMETRIC_CYLINDER_ID_DISPLAY\n         5bar\n0,0,0,.1,.2\n0,0,0,0,3,0,.25\n.5,6\n1\n",
          0);
    const RigidWall *lid = &run.model.walls[0], *bar = &run.model.walls[1];
    assert_int_equal(run.model.wall_count, 2);
    assert_true(run.model.has_moving_walls);
    assert_true(lid->shape == WALL_PLANE && lid->mass == 10 && lid->speed == -3 && lid->friction == 0.5);
    assert_true(lid->axes[0] == 1 && lid->axes[4] == 1 && lid->axes[8] == 1);
    assert_true(lid->length[0] == 2 && lid->length[1] == 5);
    assert_true(bar->id == 5 && bar->shape == WALL_CYLINDER && bar->radius == 0.5 && bar->length[2] == 6);
    assert_true(bar->axes[7] == 1 && bar->birth == 0.1 && bar->death == 0.2);
    verify_free(&run);
}

static void bad_cards_are_told_together(void **state)
{
    (void)state;
    VerifyRun run;
    build(&run,
          "*RIGIDWALL_PLANAR\n77,78,79\n0,0,0,0,0,0,5\n"                           /* lines 6, 7 */
          "*RIGIDWALL_PLANAR_FINITE_MOVING\n0\n0,0,0,0,0,1\n0,0,5,1,1\n0\n"        /* lines 9 to 12 */
          "*RIGIDWALL_GEOMETRIC_SPHERE\n0\n0,0,0,0,0,1\n0\n"                       /* line 16 */
          "*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n0\n0,0,0,0,0,1,-1\n0,0,0,-1\n55,3\n", /* lines 19 to 21 */
          13);
    expect_error(&run, 6, "*RIGIDWALL_PLANAR", "77");
    expect_error(&run, 6, "*RIGIDWALL_PLANAR", "78");
    expect_error(&run, 6, "*RIGIDWALL_PLANAR", "79");
    expect_error(&run, 7, "*RIGIDWALL_PLANAR", "normal of the wall is zero");
    expect_error(&run, 7, "*RIGIDWALL_PLANAR", "FRIC = 5");
    expect_error(&run, 11, "*RIGIDWALL_PLANAR", "no direction across the normal");
    expect_error(&run, 12, "*RIGIDWALL_PLANAR", "MASS = 0");
    expect_error(&run, 16, "*RIGIDWALL_GEOMETRIC_SPHERE", "RADSPH = 0");
    expect_error(&run, 19, "*RIGIDWALL_GEOMETRIC_FLAT", "FRIC = -1");
    expect_error(&run, 20, "*RIGIDWALL_GEOMETRIC_FLAT", "LENL = -1");
    expect_error(&run, 21, "*RIGIDWALL_GEOMETRIC_FLAT", "LCID");
    expect_error(&run, 21, "*RIGIDWALL_GEOMETRIC_FLAT", "OPT = 3");
    expect_error(&run, 21, "*RIGIDWALL_GEOMETRIC_FLAT", "direction of the motion");
    verify_free(&run);
    build(&run, "*RIGIDWALL_PLANAR_ID\n1\n0\n0,0,0,0,0,1\n*RIGIDWALL_PLANAR_ID\n1\n0\n0,0,0,0,0,1\n", 1);
    verify_free(&run);
    build(&run, "*RIGIDWALL_PLANAR_ORTHO\n0\n0,0,0,0,0,1\n", 1);
    assert_true(verify_message(&run.diagnostics, SEVERITY_ERROR, "ORTHO"));
    verify_free(&run);
    build(&run, "*RIGIDWALL_GEOMETRIC_CYLINDER\n0\n0,0,0,0,0,1\n1,2,3\n", 1);
    assert_true(verify_message(&run.diagnostics, SEVERITY_ERROR, "NSEGS"));
    verify_free(&run);
}

/* rwforc.csv and rwforc of a resting square: its weight on wall 9, nothing on the wall above. */
static void forces_are_written(void **state)
{
    (void)state;
    static Program program;
    static char text[PROGRAM_TEXT];
    Scene scene = {0};
    double time, normal, force[3];
    int wall, rows = 0;
    program_open(&program);
    wall_begin(&scene, 1);
    wall_add_square(&scene, 0, 0, 0);
    wall_write_gravity(&scene.deck, 10);
    scene_print(&scene.deck, "*DATABASE_RWFORC\n.1\n*RIGIDWALL_PLANAR_ID\n9\n0\n0,0,0,0,0,1\n"
                             "*RIGIDWALL_PLANAR\n0\n0,0,2,0,0,1\n");
    scene_end(&scene.deck, &scene.mesh);
    program_write(&program, "rest.k", scene.deck.text, scene.deck.length);
    scene_free(&scene);
    assert_int_equal(program_run(&program, "run rest.k"), 0);
    assert_true(program_read(&program, "rest.results/rwforc.csv", text, sizeof text));
    const char *header = "time,wall,normal_force,fx,fy,fz\n";
    assert_int_equal(strncmp(text, header, strlen(header)), 0);
    for (char *line = text + strlen(header); *line; line = strchr(line, '\n') + 1, rows++) {
        assert_int_equal(sscanf(line, "%lf,%d,%lf,%lf,%lf,%lf", &time, &wall, &normal, force, force + 1, force + 2), 6);
        assert_int_equal(wall, rows % 2 ? 2 : 9);
        if (wall == 9 && time > 0.05) verify_close("weight", normal, 40, 1e-9);
        if (wall == 9 && time > 0.05) verify_close("weight", force[2], 40, 1e-9);
    }
    assert_int_equal(rows, 22);
    assert_true(program_read(&program, "rest.results/rwforc", text, sizeof text));
    assert_non_null(strstr(text, "normal-force"));
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_are_selected),        cmocka_unit_test(times_are_in_order),
        cmocka_unit_test(options_come_in_any_order), cmocka_unit_test(bad_cards_are_told_together),
        cmocka_unit_test(forces_are_written),
    };
    return cmocka_run_group_tests_name("rigid wall cards", tests, NULL, NULL);
}
