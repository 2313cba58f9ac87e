/* Nodes of *DATABASE_HISTORY_NODE and _SET from the deck to the plan of outputs. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void cards_name_the_nodes_of_nodout(void **state)
{
    (void)state;
    Scene scene = {0};
    VerifyRun run;
    scene_begin(&scene.deck, "history", 1, 0);
    scene_write_part(&scene.deck, 1, 1, 1, "sheet");
    scene_write_section(&scene.deck, 1, 9, 1);
    scene_write_null(&scene.deck, 1, 1);
    scene_print(&scene.deck, "*DATABASE_NODOUT\n.1\n*DATABASE_HISTORY_NODE\n7,2\n*DATABASE_HISTORY_NODE_SET\n5\n"
                             "*SET_NODE_LIST\n5\n9,2\n");
    scene_add_rectangle(&scene.mesh, 1, SCENE_QUADS, 2, 2, 1, 1);
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), 0);
    scene_free(&scene);
    static const int expected[3] = {2, 7, 9};
    assert_int_equal(run.model.output.history_count, 3);
    for (int i = 0; i < 3; i++) assert_int_equal(run.model.node_id[run.model.output.history_node[i]], expected[i]);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cards_name_the_nodes_of_nodout)};
    return cmocka_run_group_tests_name("history nodes", tests, NULL, NULL);
}
