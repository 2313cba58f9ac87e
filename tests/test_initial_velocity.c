/* Initial velocities from the deck. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/motion_deck.h"

static void expect_velocity(const MotionDeck *deck, int node, double x, double y, double z)
{
    const double *v = deck->motion.velocity + (ptrdiff_t)3 * node;
    assert_near(v[0], x, 1e-14);
    assert_near(v[1], y, 1e-14);
    assert_near(v[2], z, 1e-14);
}

static void sets_boxes_and_exemptions(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    const int lower[] = {10, 20, 30, 40, 50}, exempt[] = {20, 100};
    deck_add_set(&deck, SET_NODE, 1, 5, lower);
    deck_add_set(&deck, SET_NODE, 2, 2, exempt);
    DECK_ADD(deck.d.boxes, (BoxDefinition){.id = 7, .low = {0.5, -1, -1}, .high = {2.5, 1, 1}});
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){.kind = COORDINATE_SYSTEM, .id = 4, .x_point = {0, 1, 0}, .xy_point = {0, 0, 1}});
    DECK_ADD(deck.d.velocities,
             (InitialVelocityDefinition){.kind = VELOCITY_NODE, .id = 40, .v = {0, 0, 9}}); /* comes last */
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_ALL, .v = {1, 1, 1}});
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_ALL,
                                                            .id = 1,
                                                            .nsidex = 2,
                                                            .boxid = 7,
                                                            .icid = 4,
                                                            .v = {5, 0, 0},
                                                            .vx_exempt = {0, 6, 0, 0, 0, 0}});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 60, .dof = {1, 0, 0, 0, 0, 0}, .death = 1e20});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 70, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20});
    assert_int_equal(deck_build(&deck), 0);
    expect_velocity(&deck, 0, 1, 1, 1); /* outside the box */
    expect_velocity(&deck, 1, 0, 0, 6); /* exempt: local y is global z */
    expect_velocity(&deck, 2, 0, 5, 0); /* local x is global y */
    expect_velocity(&deck, 3, 0, 0, 9);
    expect_velocity(&deck, 5, 0, 1, 1); /* held in x */
    expect_velocity(&deck, 6, 0, 0, 0); /* fixed */
    expect_velocity(&deck, 9, 0, 0, 6); /* exempt wherever it is */
    deck_end(&deck);
}

static void generation_turns_about_an_axis(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    const int part[] = {200}, node[] = {10};
    deck_add_set(&deck, SET_PART, 1, 1, part);
    deck_add_set(&deck, SET_NODE, 1, 1, node);
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_GENERATION,
                                                            .id = 1,
                                                            .styp = 1,
                                                            .omega = 10,
                                                            .v = {0, 0, 1},
                                                            .centre = {2, 0, 0},
                                                            .axis = {0, 0, 2}});
    DECK_ADD(deck.d.velocities,
             (InitialVelocityDefinition){.kind = VELOCITY_GENERATION, .id = 100, .styp = 2, .v = {3, 0, 0}});
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_GENERATION,
                                                            .id = 1,
                                                            .styp = 3,
                                                            .omega = 2,
                                                            .axis = {-999, 20, 70}}); /* from (1,0,0) along y */
    assert_int_equal(deck_build(&deck), 0);
    expect_velocity(&deck, 4, 0, 20, 1);
    expect_velocity(&deck, 8, -10, 10, 1);
    expect_velocity(&deck, 2, 3, 0, 0); /* on the border: the later card */
    expect_velocity(&deck, 0, 0, 0, 2);
    deck_end(&deck);
}

static void rigid_bodies_take_momentum_or_their_own_card(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    const int part[] = {200};
    deck_add_set(&deck, SET_PART, 1, 1, part);
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_GENERATION,
                                                            .id = 1,
                                                            .styp = 1,
                                                            .omega = 10,
                                                            .v = {0, 0, 1},
                                                            .centre = {2, 0, 0},
                                                            .axis = {0, 0, 1}});
    assert_int_equal(deck_build(&deck), 0);
    const RigidBody *body = &deck.motion.rigid_bodies[0];
    for (int i = 0; i < 3; i++) assert_near(body->spin[i], i == 2 ? 10 : 0, 1e-13);
    assert_near(body->velocity[0], -10 * (body->centre[1] - 0), 1e-13);
    assert_near(body->velocity[1], 10 * (body->centre[0] - 2), 1e-13);
    assert_near(body->velocity[2], 1, 1e-14);
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    deck.d.materials.items[1].rigid.cmo = 1;
    deck.d.materials.items[1].rigid.con1 = 1; /* x held */
    DECK_ADD(deck.d.velocities,
             (InitialVelocityDefinition){.kind = VELOCITY_RIGID_BODY, .id = 200, .v = {5, 6, 7}, .w = {0, 0, 2}});
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_ALL, .v = {1, 1, 1}});
    assert_int_equal(deck_build(&deck), 0);
    body = &deck.motion.rigid_bodies[0];
    assert_near(body->velocity[1], 6, 0);
    const double *c = body->centre;
    expect_velocity(&deck, 4, -2 * (0 - c[1]), 6 + 2 * (4 - c[0]), 7);
    expect_velocity(&deck, 0, 1, 1, 1);
    deck_end(&deck);
}

static void hanging_nodes_start_with_their_edge(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){20, 10, 30, {0, 61}});
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_NODE, .id = 10, .v = {2, 0, 4}});
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_NODE, .id = 20, .v = {9, 9, 9}});
    assert_int_equal(deck_build(&deck), 0);
    expect_velocity(&deck, 1, 1, 0, 2);
    deck_end(&deck);
}

/* A translation given to all nodes leaves a body without spin, not with the rounding of its sums. */
static void translation_has_no_spin(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 8);
    deck.d.parts.items[1].material = 2;
    for (size_t n = 0; n < deck.d.nodes.count; n++) {
        deck.d.nodes.items[n].x[0] *= 0.137;
        deck.d.nodes.items[n].x[1] *= 0.71;
    }
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_ALL, .v = {1.1, -2.3, 0.7}});
    assert_int_equal(deck_build(&deck), 0);
    for (int i = 0; i < 3; i++) assert_true(deck.motion.rigid_bodies[0].spin[i] == 0);
    deck_end(&deck);
}

static void bad_cards_are_refused(void **unused)
{
    (void)unused;
    static const char *const words[][2] = {{"STYP = 4", NULL},       {"needs an axis", NULL},
                                           {"no rigid part", "100"}, {"no node", "77"},
                                           {"no box 3", NULL},       {"no set 5", "*INITIAL_VELOCITY"}};
    for (int k = 0; k < 6; k++) {
        MotionDeck deck;
        InitialVelocityDefinition card = {.kind = VELOCITY_GENERATION, .id = 100, .styp = 2, .source = {0, 40}};
        if (k == 0) card.styp = 4;
        if (k == 1) card.omega = 1;
        if (k == 2) card.kind = VELOCITY_RIGID_BODY;
        if (k == 3) card.kind = VELOCITY_NODE, card.id = 77;
        if (k == 4) card.kind = VELOCITY_ALL, card.id = 0, card.boxid = 3;
        if (k == 5) card.kind = VELOCITY_ALL, card.id = 5;
        deck_begin_strip(&deck, 4);
        DECK_ADD(deck.d.velocities, card);
        assert_int_equal(deck_build(&deck), -1);
        deck_expect_error(&deck, 40, words[k][0], words[k][1]);
        deck_end(&deck);
    }
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    deck.d.materials.items[1].rigid = (RigidCard){.cmo = 1, .con1 = 7, .con2 = 7};
    DECK_ADD(deck.d.velocities,
             (InitialVelocityDefinition){.kind = VELOCITY_RIGID_BODY, .id = 200, .v = {5, 6, 7}, .source = {0, 40}});
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 40, "stays zero", NULL), 1);
    expect_velocity(&deck, 4, 0, 0, 0);
    deck_end(&deck);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sets_boxes_and_exemptions),
        cmocka_unit_test(generation_turns_about_an_axis),
        cmocka_unit_test(rigid_bodies_take_momentum_or_their_own_card),
        cmocka_unit_test(hanging_nodes_start_with_their_edge),
        cmocka_unit_test(translation_has_no_spin),
        cmocka_unit_test(bad_cards_are_refused),
    };
    return cmocka_run_group_tests_name("initial velocity", tests, NULL, NULL);
}
