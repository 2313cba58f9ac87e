/* Sets of nodes, parts, shells and segments, id tables, coordinate systems, vectors and boxes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "solver/coordinates.h"
#include "tests/motion_deck.h"

static const Source USER = {0, 999};

static void add_clause(SetDefinition *set, const char *option, int count, const double *e)
{
    SetClause clause = {.source = {0, 300 + (int)set->clauses.count}};
    snprintf(clause.option, sizeof clause.option, "%s", option);
    for (int i = 0; i < count; i++) clause.e[i] = e[i];
    DECK_ADD(set->clauses, clause);
}

#define CLAUSE(SET, OPTION, ...)                                                                                       \
    do {                                                                                                               \
        const double values[] = {__VA_ARGS__};                                                                         \
        add_clause(SET, OPTION, (int)(sizeof values / sizeof *values), values);                                        \
    } while (0)

static void expect(const IndexList *list, int count, const int *items)
{
    assert_int_equal(list->count, count);
    for (int i = 0; i < count; i++) assert_int_equal(list->items[i], items[i]);
}

#define EXPECT(LIST, ...)                                                                                              \
    do {                                                                                                               \
        const int items[] = {__VA_ARGS__};                                                                             \
        expect(&(LIST), (int)(sizeof items / sizeof *items), items);                                                   \
    } while (0)

static void id_map_finds_ids(void **unused)
{
    (void)unused;
    const int dense[] = {5, 6, 7, 8}, mixed[] = {900, 3, -4, 77, 3, 12};
    IdMap map;
    int32_t duplicate;
    assert_int_equal(id_map_build(&map, dense, 4, sizeof *dense, &duplicate), 0);
    for (int i = 0; i < 4; i++) assert_int_equal(id_map_find(&map, 5 + i), i);
    assert_int_equal(id_map_find(&map, 4), -1);
    assert_int_equal(id_map_find(&map, 9), -1);
    assert_int_equal(duplicate, -1);
    id_map_free(&map);
    assert_int_equal(id_map_build(&map, mixed, 6, sizeof *mixed, &duplicate), 0);
    assert_int_equal(map.count, 5);
    assert_int_equal(duplicate, 4);
    assert_int_equal(id_map_find(&map, 3), 1); /* the first of the two */
    assert_int_equal(id_map_find(&map, 900), 0);
    assert_int_equal(id_map_find(&map, -4), 2);
    assert_int_equal(id_map_find(&map, 13), -1);
    assert_int_equal(id_map_lower(&map, 13), 3);
    assert_int_equal(id_map_lower(&map, 2147483647), 5);
    id_map_free(&map);
    assert_int_equal(id_map_build(&map, NULL, 0, 4, &duplicate), 0);
    assert_int_equal(id_map_find(&map, 1), -1);
}

static void repeated_ids_are_errors(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    DECK_ADD(deck.d.nodes, (NodeDefinition){.id = 30, .source = {0, 44}});
    assert_int_equal(deck_index(&deck), -1);
    deck_expect_error(&deck, 44, "*NODE", "first in line 3");
    deck_end(&deck);
    deck_begin_strip(&deck, 4);
    deck_add_set(&deck, SET_NODE, 5, 0, NULL);
    deck_add_set(&deck, SET_PART, 5, 0, NULL); /* another kind may use the number */
    deck_add_set(&deck, SET_NODE, 5, 0, NULL);
    assert_int_equal(deck_index(&deck), -1);
    deck_expect_error(&deck, 105, "*SET_NODE", "node set 5");
    deck_end(&deck);
}

static void lists_are_sorted_and_unique(void **unused)
{
    (void)unused;
    MotionDeck deck;
    IndexList list = {0};
    deck_begin_strip(&deck, 4);
    const int nodes[] = {90, 10, 50, 10, 90}, parts[] = {200, 100}, shells[] = {4, 2};
    deck_add_set(&deck, SET_NODE, 1, 5, nodes);
    deck_add_set(&deck, SET_PART, 1, 2, parts);
    deck_add_set(&deck, SET_SHELL, 1, 2, shells);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_nodes(&deck.index, 1, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 0, 4, 8);
    assert_int_equal(sets_resolve_parts(&deck.index, 1, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 0, 1);
    assert_int_equal(sets_resolve_shells(&deck.index, 1, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 1, 3);
    const int32_t second[] = {1};
    assert_int_equal(sets_part_nodes(&deck.index, second, 1, &list), 0);
    EXPECT(list, 2, 3, 4, 7, 8, 9);
    index_list_free(&list);
    deck_end(&deck);
}

static void ranges_and_general_options(void **unused)
{
    (void)unused;
    MotionDeck deck;
    IndexList list = {0};
    deck_begin_strip(&deck, 4);
    DECK_ADD(deck.d.boxes, (BoxDefinition){.id = 7, .low = {-0.5, -0.5, -1}, .high = {1.5, 2, 1}});
    const int shells[] = {4};
    deck_add_set(&deck, SET_SHELL, 3, 1, shells);
    SetDefinition range = {.kind = SET_NODE, .id = 20}, boxed = {.kind = SET_NODE, .id = 21};
    SetDefinition cut = {.kind = SET_NODE, .id = 22}, outer = {.kind = SET_NODE, .id = 23};
    SetDefinition inside = {.kind = SET_SHELL, .id = 24}, most = {.kind = SET_PART, .id = 25};
    CLAUSE(&range, "RANGE", 15, 60, 20); /* 15, 35, 55: none; next steps of 5 */
    CLAUSE(&range, "RANGE", 20, 60, 20);
    CLAUSE(&range, "RANGE", 95, 1000000, 0);
    CLAUSE(&boxed, "BOX", 7);
    CLAUSE(&cut, "ALL", 0);
    CLAUSE(&cut, "DPART", 100);
    CLAUSE(&cut, "DNODE", 50, 100);
    CLAUSE(&outer, "SET_NODE", 22);
    CLAUSE(&outer, "SET_SHELL", 3);
    CLAUSE(&outer, "SHELL", 1);
    CLAUSE(&inside, "BOX", 7);
    CLAUSE(&inside, "ELEM", 3);
    CLAUSE(&inside, "PART", 200);
    CLAUSE(&inside, "DELEM", 4);
    CLAUSE(&most, "ALL", 0);
    CLAUSE(&most, "DPART", 200);
    DECK_ADD(deck.d.sets, range);
    DECK_ADD(deck.d.sets, boxed);
    DECK_ADD(deck.d.sets, cut);
    DECK_ADD(deck.d.sets, outer);
    DECK_ADD(deck.d.sets, inside);
    DECK_ADD(deck.d.sets, most);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_nodes(&deck.index, 20, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 1, 3, 5, 9);
    assert_int_equal(sets_resolve_nodes(&deck.index, 21, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 0, 1, 5, 6);
    assert_int_equal(sets_resolve_nodes(&deck.index, 22, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 3, 8);
    assert_int_equal(sets_resolve_nodes(&deck.index, 23, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 0, 1, 3, 4, 5, 6, 8, 9);
    assert_int_equal(sets_resolve_shells(&deck.index, 24, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 0, 2);
    assert_int_equal(sets_resolve_parts(&deck.index, 25, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 0);
    assert_int_equal(deck.messages.errors, 0);
    index_list_free(&list);
    deck_end(&deck);
}

static void segments_keep_deck_order_and_winding(void **unused)
{
    (void)unused;
    MotionDeck deck;
    IndexList list = {0};
    deck_begin_strip(&deck, 4);
    SetDefinition set = {.kind = SET_SEGMENT, .id = 6, .source = {0, 106}};
    DECK_ADD(set.segments, (SegmentDefinition){{40, 30, 20, 20}, {0, 200}});
    DECK_ADD(set.segments, (SegmentDefinition){{10, 20, 70, 60}, {0, 201}});
    DECK_ADD(set.segments, (SegmentDefinition){{20, 30, 40, 40}, {0, 202}}); /* the first again, turned */
    SetDefinition general = {.kind = SET_SEGMENT, .id = 7};
    CLAUSE(&general, "PART", 100);
    CLAUSE(&general, "SEG", 10, 20, 30, 0);
    CLAUSE(&general, "DSHELL", 1);
    DECK_ADD(deck.d.sets, set);
    DECK_ADD(deck.d.sets, general);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_segments(&deck.index, 6, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 3, 2, 1, 1, 0, 1, 6, 5);
    assert_int_equal(sets_resolve_segments(&deck.index, 7, USER, "*X", &list, &deck.messages), 0);
    EXPECT(list, 1, 2, 7, 6, 0, 1, 2, 2);
    index_list_free(&list);
    deck_end(&deck);
}

static void missing_things_are_named(void **unused)
{
    (void)unused;
    MotionDeck deck;
    IndexList list = {0};
    deck_begin_strip(&deck, 4);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_nodes(&deck.index, 5, USER, "*BOUNDARY_SPC_SET", &list, &deck.messages), -1);
    deck_expect_error(&deck, 999, "*BOUNDARY_SPC_SET", "no set 5");
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    const int nodes[] = {10, 11, 20};
    deck_add_set(&deck, SET_NODE, 5, 3, nodes);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_nodes(&deck.index, 5, USER, "*X", &list, &deck.messages), -1);
    EXPECT(list, 0, 1);
    assert_int_equal(sets_resolve_nodes(&deck.index, 5, USER, "*Y", &list, &deck.messages), -1);
    deck_expect_error(&deck, 105, "*SET_NODE", "node 11"); /* said once though used twice */
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    SetDefinition odd = {.kind = SET_NODE, .id = 9};
    CLAUSE(&odd, "VOL", 3);
    DECK_ADD(deck.d.sets, odd);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_nodes(&deck.index, 9, USER, "*X", &list, &deck.messages), -1);
    deck_expect_error(&deck, 300, "VOL", "SET_SHELL");
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    SetDefinition self = {.kind = SET_NODE, .id = 9, .source = {0, 109}};
    CLAUSE(&self, "SET_NODE", 9);
    DECK_ADD(deck.d.sets, self);
    assert_int_equal(deck_index(&deck), 0);
    assert_int_equal(sets_resolve_nodes(&deck.index, 9, USER, "*X", &list, &deck.messages), -1);
    deck_expect_error(&deck, 109, "contains itself", NULL);
    deck_end(&deck);
    index_list_free(&list);
}

static void systems_vectors_and_boxes(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    /* 1: by nodes 20 (origin), 30 (along local y), 70 (in the local yz plane); 2: a turned system; 3: within 2 */
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){.kind = COORDINATE_NODES, .id = 1, .node = {20, 30, 70}, .dir = 'Y'});
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){
                 .kind = COORDINATE_SYSTEM, .id = 2, .origin = {1, 2, 3}, .x_point = {1, 3, 3}, .xy_point = {1, 2, 4}});
    DECK_ADD(deck.d.coordinates, (CoordinateDefinition){.kind = COORDINATE_SYSTEM,
                                                        .id = 3,
                                                        .cidl = 2,
                                                        .origin = {1, 0, 0},
                                                        .x_point = {1, 1, 0},
                                                        .xy_point = {0, 0, 0}});
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){
                 .kind = COORDINATE_VECTOR, .id = 4, .x_point = {0, 0, 2}, .xy_point = {0, 0, 1}, .source = {0, 404}});
    DECK_ADD(deck.d.vectors, (VectorDefinition){.id = 8, .cid = 2, .tail = {1, 0, 0}, .head = {4, 0, 0}});
    DECK_ADD(deck.d.vectors, (VectorDefinition){.id = 9, .source = {0, 409}});
    assert_int_equal(deck_index(&deck), 0);
    CoordinateSystem s;
    double vector[3];
    assert_int_equal(coordinates_resolve_system(&deck.index, 0, USER, "*X", &s, &deck.messages), 0);
    assert_true(s.axes[0] == 1 && s.axes[4] == 1 && s.axes[8] == 1 && s.origin[0] == 0);
    assert_int_equal(coordinates_resolve_system(&deck.index, 1, USER, "*X", &s, &deck.messages), 0);
    assert_near(s.axes[3], 1, 1e-15); /* local y = global x, local z = global y, local x = global z */
    assert_near(s.axes[7], 1, 1e-15);
    assert_near(s.axes[2], 1, 1e-15);
    assert_near(s.origin[0], 1, 0);
    assert_int_equal(coordinates_resolve_system(&deck.index, 2, USER, "*X", &s, &deck.messages), 0);
    assert_near(s.axes[1], 1, 1e-15); /* x = global y, y = global z */
    assert_near(s.axes[5], 1, 1e-15);
    assert_int_equal(coordinates_resolve_system(&deck.index, 3, USER, "*X", &s, &deck.messages), 0);
    assert_near(s.axes[2], 1, 1e-15);  /* x = y of 2 = global z */
    assert_near(s.axes[4], -1, 1e-15); /* y = minus x of 2 */
    assert_near(s.origin[1], 3, 1e-15);
    assert_int_equal(coordinates_resolve_vector(&deck.index, 8, USER, "*X", vector, &deck.messages), 0);
    assert_near(vector[1], 1, 1e-15);
    assert_int_equal(deck.messages.errors, 0);
    assert_int_equal(coordinates_resolve_system(&deck.index, 4, USER, "*X", &s, &deck.messages), -1);
    assert_int_equal(deck_messages(&deck, SEVERITY_ERROR, 404, "on one line", NULL), 1);
    assert_int_equal(coordinates_resolve_vector(&deck.index, 9, USER, "*X", vector, &deck.messages), -1);
    assert_int_equal(deck_messages(&deck, SEVERITY_ERROR, 409, "coincide", NULL), 1);
    assert_int_equal(coordinates_resolve_system(&deck.index, 77, USER, "*X", &s, &deck.messages), -1);
    assert_int_equal(coordinates_resolve_vector(&deck.index, 77, USER, "*X", vector, &deck.messages), -1);
    assert_null(coordinates_resolve_box(&deck.index, 77, USER, "*X", &deck.messages));
    assert_int_equal(deck_messages(&deck, SEVERITY_ERROR, 999, "77", NULL), 3);
    const BoxDefinition box = {.low = {0, 0, 0}, .high = {1, 1, 1}};
    const double on_face[3] = {1, 0.5, 0}, out[3] = {1, 0.5, -1e-9};
    assert_true(coordinates_in_box(&box, on_face));
    assert_false(coordinates_in_box(&box, out));
    deck_end(&deck);
}

/* The k-th allocation fails, for every k: no crash, no leak, an error that says so. */
static void short_memory_is_reported(void **unused)
{
    (void)unused;
    MotionDeck deck;
    IndexList list = {0};
    deck_begin_strip(&deck, 4);
    SetDefinition cut = {.kind = SET_NODE, .id = 22};
    CLAUSE(&cut, "ALL", 0);
    CLAUSE(&cut, "DPART", 100);
    DECK_ADD(deck.d.sets, cut);
    for (long k = 1; k < 60; k++) {
        size_t before = memory_in_use();
        Diagnostics messages = {0};
        memory_fail_after(k);
        int status = deck_index_build(&deck.index, &deck.d, &messages);
        if (status == 0) status = sets_resolve_nodes(&deck.index, 22, USER, "*X", &list, &messages);
        memory_fail_after(0);
        index_list_free(&list);
        deck_index_free(&deck.index);
        diagnostics_free(&messages);
        assert_int_equal(memory_in_use(), before);
        if (status == 0) {
            assert_true(k > 10);
            deck_end(&deck);
            return;
        }
    }
    fail_msg("no run without a failed allocation");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(id_map_finds_ids),
        cmocka_unit_test(repeated_ids_are_errors),
        cmocka_unit_test(lists_are_sorted_and_unique),
        cmocka_unit_test(ranges_and_general_options),
        cmocka_unit_test(segments_keep_deck_order_and_winding),
        cmocka_unit_test(missing_things_are_named),
        cmocka_unit_test(systems_vectors_and_boxes),
        cmocka_unit_test(short_memory_is_reported),
    };
    return cmocka_run_group_tests_name("sets", tests, NULL, NULL);
}
