/* Supports, prescribed motion, hanging nodes and rigid parts as built from the deck's cards. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/motion_deck.h"

static void spc_cards_and_codes_become_supports(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    const int edge[] = {10, 60}, all_fixed[] = {50};
    deck_add_set(&deck, SET_NODE, 1, 2, edge);
    deck_add_set(&deck, SET_NODE, 2, 1, all_fixed);
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){.kind = COORDINATE_SYSTEM, .id = 4, .x_point = {1, 1, 0}, .xy_point = {0, 1, 0}});
    DECK_ADD(deck.d.spcs,
             (SpcDefinition){.is_set = true, .id = 1, .dof = {1, 0, 1, 1, 1, 1}, .death = 1e20, .source = {0, 21}});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 60, .dof = {0, 1, 0, 0, 0, 0}, .death = 1e20, .source = {0, 22}});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.is_set = true, .id = 2, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 30, .cid = 4, .dof = {1, 0, 0, 0, 0, 0}, .birth = 1, .death = 2});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 90, .dof = {1, 1, 1, 0, 0, 0}, .death = 5}); /* not for ever */
    deck.d.nodes.items[3].tc = 5;
    deck.d.nodes.items[6].tc = 7;
    deck.d.nodes.items[6].source = (Source){0, 7};
    assert_int_equal(deck_build(&deck), 0);
    const Constraints *c = &deck.motion.constraints;
    /* 60 has x and z by the set, y by itself: fixed; 50 and 70 too. Left: 10, 30, 40, 90. */
    const unsigned char fixed[10] = {0, 0, 0, 0, 1, 1, 1, 0, 0, 0};
    assert_memory_equal(deck.motion.fixed, fixed, sizeof fixed);
    assert_int_equal(c->support_count, 4);
    assert_int_equal(c->supports[0].node, 0);
    assert_true(c->supports[0].fixed[0] && !c->supports[0].fixed[1] && c->supports[0].fixed[2] &&
                !c->supports[0].local);
    assert_int_equal(c->supports[1].node, 2);
    assert_true(c->supports[1].local && c->supports[1].birth == 1 && c->supports[1].death == 2);
    assert_near(c->supports[1].axes[0], sqrt(0.5), 1e-15);
    assert_int_equal(c->supports[2].node, 3);
    assert_true(!c->supports[2].fixed[0] && c->supports[2].fixed[1] && c->supports[2].fixed[2]);
    assert_int_equal(deck_messages(&deck, SEVERITY_NOTE, 21, "no rotations", NULL), 1);
    unsigned char special[10] = {0};
    const unsigned char expected[10] = {1, 0, 1, 1, 0, 0, 0, 0, 1, 0};
    motion_mark_special(&deck.motion, special);
    assert_memory_equal(special, expected, sizeof expected);
    deck_end(&deck);
}

static const double RAMP[2][2] = {{0, 0}, {1, 1}}, STEP[2][2] = {{0, 5}, {1, 6}};

static PrescribedMotionDefinition motion_card(int kind, int id, int dof, int vad)
{
    PrescribedMotionDefinition card = {
        .id = id, .dof = dof, .vad = vad, .lcid = 1, .sf = 2, .death = 1e28, .source = {0, 30}};
    card.kind = kind == 0 ? MOTION_NODE : kind == 1 ? MOTION_SET : MOTION_RIGID;
    return card;
}

static void motion_cards_are_read(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2; /* a free rigid body */
    const int nodes[] = {60, 10};
    deck_add_set(&deck, SET_NODE, 1, 2, nodes);
    deck_add_curve(&deck, 1, 0, 2, RAMP);
    DECK_ADD(deck.d.vectors, (VectorDefinition){.id = 9, .head = {0, 3, 4}});
    PrescribedMotionDefinition vector = motion_card(0, 20, -4, 0);
    vector.vid = 9;
    DECK_ADD(deck.d.motions, motion_card(2, 200, 7, 2));
    DECK_ADD(deck.d.motions, motion_card(1, 1, 3, 2));
    DECK_ADD(deck.d.motions, vector);
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 10, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20});
    assert_int_equal(deck_build(&deck), 0);
    const Constraints *c = &deck.motion.constraints;
    assert_int_equal(c->motion_count, 4);
    assert_int_equal(c->node_motion_count, 3);
    assert_int_equal(c->motions[0].node, 0);
    assert_int_equal(c->motions[1].node, 1);
    assert_true(c->motions[1].only_direction);
    assert_near(c->motions[1].direction[2], 0.8, 1e-15);
    assert_int_equal(c->motions[2].node, 5);
    assert_true(c->motions[2].vad == 2 && c->motions[2].scale == 2 && c->motions[2].direction[2] == 1);
    assert_true(c->motions[3].node == -1 && c->motions[3].rigid_body == 0 && c->motions[3].rotation &&
                c->motions[3].direction[2] == 1);
    /* node 10 is held and driven: not fixed, and said */
    assert_int_equal(deck.motion.fixed[0], 0);
    assert_int_equal(c->support_count, 1);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 0, "both held and driven", "10"), 1);
    deck_end(&deck);
}

/* Each change to a sound card, and the words expected of the one error. */
static void bad_motion_cards_are_refused(void **unused)
{
    (void)unused;
    static const struct {
        int kind, id, dof, vad, lcid;
        const char *a, *b;
    } cases[] = {
        {0, 20, 9, 2, 1, "DOF = 9", "_NODE"},
        {0, 20, 5, 2, 1, "rotation", NULL},
        {0, 20, 0, 2, 1, "DOF = 0", NULL},
        {2, 200, -4, 2, 1, "rigid bodies", "_RIGID"},
        {0, 20, 1, 3, 1, "VAD = 3", NULL},
        {0, 20, 1, 4, 1, "VAD = 4", NULL},
        {0, 21, 1, 2, 1, "no node", "21"},
        {1, 77, 1, 2, 1, "no set 77", "_SET"},
        {2, 100, 1, 2, 1, "no rigid part", "100"},
        {2, 300, 1, 2, 1, "no part", "300"},
        {0, 20, 1, 2, 8, "LCID = 8", NULL},
        {0, 20, 4, 2, 1, "no vector", NULL},
        {0, 40, 1, 2, 1, "belongs to a rigid part", "40"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        MotionDeck deck;
        deck_begin_strip(&deck, 4);
        deck.d.parts.items[1].material = 2;
        deck_add_curve(&deck, 1, 0, 2, RAMP);
        PrescribedMotionDefinition card = motion_card(cases[k].kind, cases[k].id, cases[k].dof, cases[k].vad);
        card.lcid = cases[k].lcid;
        DECK_ADD(deck.d.motions, card);
        assert_int_equal(deck_build(&deck), -1);
        deck_expect_error(&deck, 30, cases[k].a, cases[k].b);
        deck_end(&deck);
    }
}

static void doubtful_motion_is_pointed_out(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck_add_curve(&deck, 1, 0, 2, STEP); /* 5 at time 0 */
    DECK_ADD(deck.d.motions, motion_card(0, 20, 1, 2));
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 30, "10 at time 0", NULL), 1);
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    deck_add_curve(&deck, 1, 1, 2, RAMP); /* dynamic relaxation only */
    DECK_ADD(deck.d.motions, motion_card(0, 20, 1, 2));
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck.motion.constraints.motion_count, 0);
    assert_int_equal(deck_messages(&deck, SEVERITY_NOTE, 30, "SIDR = 1", NULL), 1);
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    deck_add_curve(&deck, 1, 0, 2, RAMP);
    DECK_ADD(deck.d.motions, motion_card(0, 20, 1, 2));
    DECK_ADD(deck.d.motions, motion_card(0, 20, 1, 0));
    assert_int_equal(deck_build(&deck), -1);
    deck_expect_error(&deck, 30, "two motions", "node 20");
    deck_end(&deck);
}

static void adaptivity_cards_become_hanging_nodes(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 8); /* nodes 10 .. 90 lower, 100 .. 180 upper */
    /* 30 in the middle of 10-50; 20 in the middle of 10-30: must come after; 70 between fixed nodes: fixed itself */
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){20, 10, 30, {0, 61}});
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){30, 50, 10, {0, 62}});
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){30, 10, 50, {0, 63}}); /* the same again */
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){70, 60, 80, {0, 64}});
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){110, 100, 130, {0, 65}}); /* not in the middle */
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 60, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 80, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 30, .dof = {0, 0, 1, 0, 0, 0}, .death = 1e20});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 110, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20}); /* its edge is free */
    deck_add_curve(&deck, 1, 0, 2, RAMP);
    const int driven[] = {10, 20, 50}; /* the hanging 20 follows 10 and 30 */
    deck_add_set(&deck, SET_NODE, 1, 3, driven);
    DECK_ADD(deck.d.motions, motion_card(1, 1, 1, 2));
    double total = 0;
    assert_int_equal(deck_build(&deck), 0);
    const Constraints *c = &deck.motion.constraints;
    assert_int_equal(c->motion_count, 2);
    assert_int_equal(c->node_motion_count, 2);
    assert_int_equal(deck.motion.fixed[10], 0);
    assert_int_equal(c->hanging_count, 3);
    assert_int_equal(c->hanging[0].node, 2);
    assert_int_equal(c->hanging[1].node, 10);
    assert_int_equal(c->hanging[2].node, 1);
    assert_int_equal(c->support_count, 0); /* 30 follows its edge, which is not held: said */
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 0, "node 30 hangs", NULL), 1);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 65, "away from the middle", NULL), 1);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 0, "node 20 hangs", NULL), 1);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 0, "node 110 hangs", NULL), 1);
    assert_int_equal(deck.messages.warnings, 4);
    assert_true(deck.motion.fixed[6]);
    assert_true(deck.mass[1] == 0 && deck.mass[2] == 0);
    for (int n = 0; n < 18; n++) total += deck.mass[n];
    assert_near(total, 32, 1e-13);
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){20, 10, 30, {0, 61}});
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){30, 20, 40, {0, 62}});
    assert_int_equal(deck_build(&deck), -1);
    assert_int_equal(deck_messages(&deck, SEVERITY_ERROR, 61, "circle", "node 20"), 1);
    deck_end(&deck);
}

static void rigid_parts_are_sorted_out(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    RigidCard *card = &deck.d.materials.items[1].rigid;
    card->cmo = 1, card->con1 = 7, card->con2 = 7;
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 50, .dof = {1, 0, 0, 0, 0, 0}, .death = 1e20}); /* held anyway */
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck.motion.rigid_body_count, 0);
    assert_int_equal(deck.motion.part_body[0], MOTION_DEFORMABLE);
    assert_int_equal(deck.motion.part_body[1], MOTION_FIXED);
    const unsigned char fixed[10] = {0, 0, 1, 1, 1, 0, 0, 1, 1, 1};
    assert_memory_equal(deck.motion.fixed, fixed, sizeof fixed);
    assert_int_equal(deck.motion.constraints.support_count, 0);
    deck_end(&deck);

    deck_begin_strip(&deck, 4); /* held in place, free to turn: moves */
    deck.d.parts.items[1].material = 2;
    card = &deck.d.materials.items[1].rigid;
    card->cmo = 1, card->con1 = 7;
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck.motion.rigid_body_count, 1);
    deck_end(&deck);

    deck_begin_strip(&deck, 4); /* CON2 with digits in a local frame */
    deck.d.parts.items[1].material = 2;
    card = &deck.d.materials.items[1].rigid;
    card->cmo = -1, card->con1 = 4, card->con2 = 110111;
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){.kind = COORDINATE_SYSTEM, .id = 4, .x_point = {0, 1, 0}, .xy_point = {0, 0, 1}});
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck.motion.rigid_body_count, 1);
    const RigidBody *body = &deck.motion.rigid_bodies[0];
    assert_true(body->fix_translation[0] && body->fix_translation[1] && !body->fix_translation[2]);
    assert_true(body->fix_rotation[0] && body->fix_rotation[1] && body->fix_rotation[2]);
    assert_near(body->constraint_axes[1], 1, 1e-15);
    assert_int_equal(body->node_count, 6);
    /* 8 of its own shells, 1 + 1 of the neighbour's share of the common nodes */
    assert_near(body->mass, 10, 1e-14);
    assert_int_equal(deck.motion.node_body[2], 0);
    deck_end(&deck);
}

static void bad_rigid_parts_are_refused(void **unused)
{
    (void)unused;
    for (int k = 0; k < 6; k++) {
        MotionDeck deck;
        deck_begin_strip(&deck, 4);
        deck.d.parts.items[1].material = 2;
        RigidCard *card = &deck.d.materials.items[1].rigid;
        if (k == 0) card->couple = 1;
        if (k == 1) card->alias[0] = 'a';
        if (k == 2) card->cmo = 1, card->con1 = 9;
        if (k == 3) card->cmo = -1, card->con2 = 200000;
        if (k == 4) deck.d.parts.items[0].material = 2; /* shares nodes */
        if (k == 5)
            DECK_ADD(deck.d.spcs,
                     (SpcDefinition){.id = 50, .dof = {1, 0, 0, 0, 0, 0}, .death = 1e20, .source = {0, 90}});
        static const char *const words[] = {"COUPLE", "ALIAS", "CON1 = 9", "CON2 = 200000", "share node 30", "node 50"};
        const int lines[] = {81, 81, 81, 81, 72, 90};
        assert_int_equal(deck_build(&deck), -1);
        deck_expect_error(&deck, lines[k], words[k], k == 4 ? "rigid bodies 100 and 200" : NULL);
        deck_end(&deck);
    }
}

/* A prescribed motion sets a part free that its material fixes. */
static void driven_rigid_part_moves(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    RigidCard *card = &deck.d.materials.items[1].rigid;
    card->cmo = 1, card->con1 = 7, card->con2 = 7;
    deck_add_curve(&deck, 1, 0, 2, RAMP);
    DECK_ADD(deck.d.motions, motion_card(2, 200, 3, 2));
    assert_int_equal(deck_build(&deck), 0);
    assert_int_equal(deck.motion.rigid_body_count, 1);
    assert_int_equal(deck.motion.part_body[1], 0);
    assert_int_equal(deck.motion.fixed[3], 0);
    deck_end(&deck);
}

static void renumbering_keeps_everything_together(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    deck_add_curve(&deck, 1, 0, 2, RAMP);
    const int set[] = {10, 60};
    deck_add_set(&deck, SET_NODE, 1, 2, set);
    DECK_ADD(deck.d.spcs, (SpcDefinition){.is_set = true, .id = 1, .dof = {1, 0, 0, 0, 0, 0}, .death = 1e20});
    DECK_ADD(deck.d.motions, motion_card(1, 1, 3, 2));
    DECK_ADD(deck.d.node_loads,
             (NodeLoadDefinition){.id = 20, .dof = 4, .lcid = 1, .sf = 1, .m1 = 10, .m2 = 20, .m3 = 70});
    DECK_ADD(deck.d.segment_loads, (SegmentLoadDefinition){.lcid = 1, .sf = 1, .node = {10, 20, 70, 0}});
    DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_NODE, .id = 70, .v = {1, 2, 3}});
    assert_int_equal(deck_build(&deck), 0);
    double offset[3];
    memcpy(offset, deck.motion.rigid_bodies[0].offset, sizeof offset); /* of deck node 2 */
    int32_t new_index[10];
    for (int n = 0; n < 10; n++) new_index[n] = 9 - n;
    assert_int_equal(motion_renumber(&deck.motion, new_index), 0);
    const Motion *m = &deck.motion;
    assert_int_equal(m->constraints.supports[0].node, 4);
    assert_int_equal(m->constraints.supports[1].node, 9);
    assert_int_equal(m->constraints.motions[0].node, 4);
    assert_int_equal(m->constraints.motions[1].node, 9);
    assert_int_equal(m->loads.node_loads[0].node, 8);
    assert_int_equal(m->loads.node_loads[0].m[2], 3);
    const int32_t segment[4] = {9, 8, 3, 3};
    assert_memory_equal(m->segment_node, segment, sizeof segment);
    const int32_t body_nodes[6] = {0, 1, 2, 5, 6, 7};
    assert_memory_equal(m->rigid_bodies[0].node, body_nodes, sizeof body_nodes);
    assert_memory_equal(m->rigid_bodies[0].offset + 15, offset, sizeof offset);
    assert_near(m->velocity[3 * 3 + 1], 2, 0);
    assert_int_equal(m->node_body[7], 0);
    assert_int_equal(m->node_body[3], MOTION_DEFORMABLE);
    deck_end(&deck);
}

/* The k-th allocation fails, for every k: no crash, no leak, an error each time. */
static void short_memory_is_reported(void **unused)
{
    (void)unused;
    for (long k = 1; k < 400; k++) {
        MotionDeck deck;
        deck_begin_strip(&deck, 4);
        deck.d.parts.items[1].material = 2;
        deck_add_curve(&deck, 1, 0, 2, RAMP);
        const int set[] = {10, 60};
        deck_add_set(&deck, SET_NODE, 1, 2, set);
        DECK_ADD(deck.d.spcs, (SpcDefinition){.is_set = true, .id = 1, .dof = {1, 0, 0, 0, 0, 0}, .death = 1e20});
        DECK_ADD(deck.d.motions, motion_card(1, 1, 3, 2));
        DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){20, 10, 30, {0, 61}});
        DECK_ADD(deck.d.node_loads, (NodeLoadDefinition){.is_set = true, .id = 1, .dof = 1, .lcid = 1, .sf = 1});
        DECK_ADD(deck.d.segment_loads, (SegmentLoadDefinition){.lcid = 1, .sf = 1, .node = {10, 20, 70, 0}});
        DECK_ADD(deck.d.gravity_parts, (GravityPartDefinition){.id = 100, .dof = 3, .accel = 9.81});
        DECK_ADD(deck.d.velocities, (InitialVelocityDefinition){.kind = VELOCITY_ALL, .v = {1, 2, 3}});
        assert_int_equal(deck_index(&deck), 0);
        memory_fail_after(k);
        int status = build_motion(&deck.input, deck.mass, &deck.motion, &deck.messages);
        memory_fail_after(0);
        int environment = deck.messages.environment;
        deck_end(&deck);
        assert_int_equal(memory_in_use(), 0);
        if (status == 0) {
            assert_true(k > 20);
            return;
        }
        assert_true(environment > 0);
    }
    fail_msg("no run without a failed allocation");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spc_cards_and_codes_become_supports),   cmocka_unit_test(motion_cards_are_read),
        cmocka_unit_test(bad_motion_cards_are_refused),          cmocka_unit_test(doubtful_motion_is_pointed_out),
        cmocka_unit_test(adaptivity_cards_become_hanging_nodes), cmocka_unit_test(rigid_parts_are_sorted_out),
        cmocka_unit_test(bad_rigid_parts_are_refused),           cmocka_unit_test(driven_rigid_part_moves),
        cmocka_unit_test(renumbering_keeps_everything_together), cmocka_unit_test(short_memory_is_reported),
    };
    return cmocka_run_group_tests_name("constraint cards", tests, NULL, NULL);
}
