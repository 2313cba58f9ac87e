/* Point loads, pressure on segments, gravity and mass damping, and their build from the deck. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/motion_deck.h"

static double ramp_x[2] = {0, 1}, ramp_y[2] = {0, 3}, ramp_area[2] = {0, 1.5};
static const Curve RAMP = {.count = 2, .x = ramp_x, .y = ramp_y, .area = ramp_area};

static const double POINTS[2][2] = {{0, 1}, {1, 1}};

static void classes_sum_their_terms(void **unused)
{
    (void)unused;
    BodyClass c = {.gravity_count = 3, .damping_count = 2, .airbag = -1};
    c.gravity[0].axis = 2, c.gravity[0].curve = -1, c.gravity[0].scale = -9.81;
    c.gravity[1].axis = 0, c.gravity[1].curve = 0, c.gravity[1].scale = 2;
    c.gravity[2].axis = 2, c.gravity[2].curve = 0, c.gravity[2].scale = 1;
    c.damping[0].curve = 0, c.damping[0].scale = 10;
    c.damping[1].curve = -1, c.damping[1].scale = 0.5;
    for (int i = 0; i < 6; i++) c.damping[0].factor[i] = 1, c.damping[1].factor[i] = i;
    double g[3], d[3], all[6];
    loads_class_at(&c, &RAMP, 0.5, g, d);
    assert_near(g[0], 3, 1e-15);
    assert_true(g[1] == 0);
    assert_near(g[2], -9.81 + 1.5, 1e-15);
    for (int i = 0; i < 3; i++) assert_near(d[i], 15 + 0.5 * i, 1e-15);
    loads_body_at(&c, &RAMP, 0.5, g, all);
    for (int i = 0; i < 6; i++) assert_near(all[i], 15 + 0.5 * i, 1e-15);
}

static void point_loads_push_and_follow(void **unused)
{
    (void)unused;
    NodeLoad list[2] = {{.node = 1, .curve = 0, .scale = 2, .direction = {0, 1, 0}},
                        {.node = 2, .curve = 0, .scale = 4, .follower = true, .m = {0, 1, 2}}};
    const Loads loads = {.node_load_count = 2, .node_loads = list};
    double x[9] = {0, 0, 0, 2, 0, 0, 0, 3, 0}, f[9] = {0}, before[9], v[9];
    loads_apply_points(&loads, &RAMP, 0.5, x, f);
    const double expected[9] = {0, 0, 0, 0, 3, 0, 0, 0, 6};
    for (int i = 0; i < 9; i++) assert_near(f[i], expected[i], 1e-15);
    x[5] = 2; /* the plane now leans: normal (-1, 0, 1)/sqrt 2 */
    memset(f, 0, sizeof f);
    loads_apply_points(&loads, &RAMP, 0.5, x, f);
    assert_near(f[6], -6 * sqrt(0.5), 1e-14);
    assert_near(f[8], 6 * sqrt(0.5), 1e-14);
    for (int i = 0; i < 9; i++) before[i] = i, v[i] = 2 * i;
    double expected_work = 0;
    for (int i = 0; i < 9; i++) expected_work += f[i] * 1.5 * i * 0.01;
    assert_near(loads_points_work(&loads, &RAMP, 0.5, x, before, v, 0.01), expected_work, 1e-15);
    memset(x, 0, sizeof x); /* collapsed: no direction, no force */
    memset(f, 0, sizeof f);
    loads_apply_points(&loads, &RAMP, 0.5, x, f);
    assert_true(f[6] == 0 && f[7] == 0 && f[8] == 0);
}

static void segment_pressure_waits_for_its_arrival(void **unused)
{
    (void)unused;
    const SegmentLoad load = {.curve = 0, .scale = 10, .arrival = 0.25};
    double level_x[1] = {0}, level_y[1] = {4}, level_area[1] = {0};
    const Curve level = {.count = 1, .x = level_x, .y = level_y, .area = level_area};
    assert_true(loads_segment_pressure(&load, &level, 0.2) == 0);
    assert_near(loads_segment_pressure(&load, &level, 0.3), 40, 0);
    assert_near(loads_segment_pressure(&load, &RAMP, 0.75), 15, 1e-14);
    assert_near(loads_segment_pressure(&load, &RAMP, 9), 30, 1e-14);
}

/* g and D of a node at time 0.5 with all curves 1. */
static void node_field(const MotionDeck *deck, int node, double g[3], double d[3])
{
    static double x[2] = {0, 1}, y[2] = {1, 1}, area[2] = {0, 1};
    const Curve curves[2] = {{.count = 2, .x = x, .y = y, .area = area}, {.count = 2, .x = x, .y = y, .area = area}};
    loads_class_at(&deck->motion.loads.classes[deck->motion.node_class[node]], curves, 0.5, g, d);
}

/* *LOAD_BODY and *LOAD_GRAVITY_PART both accelerate against their axis. */
static void gravity_acts_against_its_axis(void **unused)
{
    (void)unused;
    MotionDeck deck;
    double g[3], d[3];
    deck_begin_strip(&deck, 4);
    DECK_ADD(deck.d.nodes, (NodeDefinition){.id = 999}); /* of no shell: nothing acts on it */
    deck_add_curve(&deck, 1, 0, 2, POINTS);
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){.kind = COORDINATE_SYSTEM, .id = 4, .x_point = {0, 3, 4}, .xy_point = {1, 0, 0}});
    DECK_ADD(deck.d.body_loads, (BodyLoadDefinition){.axis = 2, .lcid = 1, .sf = 9.81});
    DECK_ADD(deck.d.body_loads, (BodyLoadDefinition){.axis = 0, .lcid = 1, .sf = 10, .cid = 4});
    DECK_ADD(deck.d.gravity_parts, (GravityPartDefinition){.id = 100, .dof = 1, .accel = 2});
    assert_int_equal(deck_build(&deck), 0);
    node_field(&deck, 0, g, d);
    assert_near(g[0], -2, 1e-15);
    assert_near(g[1], -6, 1e-14);
    assert_near(g[2], -9.81 - 8, 1e-14);
    node_field(&deck, 4, g, d); /* the other part */
    assert_near(g[0], 0, 0);
    assert_near(g[2], -9.81 - 8, 1e-14);
    assert_int_equal(deck.motion.node_class[10], 0);
    /* part 100's, part 200's, the border's and the empty class */
    assert_int_equal(deck.motion.loads.class_count, 4);
    deck_end(&deck);
}

/* A node on the border of two parts feels the mean by mass, hanging nodes' shares included. */
static void border_nodes_weigh_by_mass(void **unused)
{
    (void)unused;
    MotionDeck deck;
    double g[3], d[3];
    deck_begin_strip(&deck, 4);
    deck.shell_mass[1] = 4, deck.shell_mass[2] = 12; /* either side of the border: nodes 2 and 7 */
    deck_add_curve(&deck, 1, 0, 2, POINTS);
    DECK_ADD(deck.d.gravity_parts, (GravityPartDefinition){.id = 100, .dof = 3, .accel = 8});
    DECK_ADD(deck.d.dampings, (DampingDefinition){.id = 200, .lcid = 1, .sf = 4, .st = {1, 0, 0, 0, 0, 0}});
    DECK_ADD(deck.d.dampings, (DampingDefinition){.is_global = true, .sf = 0.5});
    assert_int_equal(deck_build(&deck), 0);
    node_field(&deck, 0, g, d);
    assert_near(g[2], -8, 1e-15);
    assert_near(d[0], 0.5, 1e-15);
    node_field(&deck, 4, g, d);
    assert_true(g[2] == 0);
    assert_near(d[0], 4.5, 1e-15);
    assert_near(d[1], 0.5, 1e-15);
    node_field(&deck, 2, g, d);
    assert_near(g[2], -2, 1e-15);
    assert_near(d[0], 0.5 + 3, 1e-15);
    node_field(&deck, 7, g, d);
    assert_near(g[2], -2, 1e-15);
    deck_end(&deck);

    deck_begin_strip(&deck, 4);
    DECK_ADD(deck.d.gravity_parts, (GravityPartDefinition){.id = 100, .dof = 3, .accel = 8});
    DECK_ADD(deck.d.adaptivities, (AdaptivityDefinition){30, 20, 40, {0, 61}});
    assert_int_equal(deck_build(&deck), 0);
    node_field(&deck, 3, g, d); /* 2 of its own part, half of the hanging node's 1 of each part */
    assert_near(g[2], -8 * 0.5 / 3, 1e-14);
    node_field(&deck, 1, g, d);
    assert_near(g[2], -8 * 2.5 / 3, 1e-14);
    deck_end(&deck);
}

/* VALDMP counts without a curve only; with one the curve is the rate. */
static void global_damping_by_curve(void **unused)
{
    (void)unused;
    MotionDeck deck;
    double g[3], d[3];
    deck_begin_strip(&deck, 4);
    deck_add_curve(&deck, 1, 0, 2, POINTS);
    DECK_ADD(deck.d.dampings, (DampingDefinition){.is_global = true, .lcid = 1, .sf = 0});
    assert_int_equal(deck_build(&deck), 0);
    node_field(&deck, 0, g, d);
    for (int i = 0; i < 3; i++) assert_near(d[i], 1, 0);
    deck_end(&deck);
}

static void rigid_bodies_take_their_parts_class(void **unused)
{
    (void)unused;
    MotionDeck deck;
    double g[3], d[6];
    deck_begin_strip(&deck, 4);
    deck.d.parts.items[1].material = 2;
    DECK_ADD(deck.d.gravity_parts, (GravityPartDefinition){.id = 200, .dof = 3, .accel = 8});
    DECK_ADD(deck.d.dampings, (DampingDefinition){.is_global = true, .sf = 2, .st = {0, 0, 0, 0, 0, 3}});
    assert_int_equal(deck_build(&deck), 0);
    const RigidBody *body = &deck.motion.rigid_bodies[0];
    loads_body_at(&deck.motion.loads.classes[body->body_class], NULL, 0, g, d);
    assert_near(g[2], -8, 0);
    assert_near(d[5], 6, 0);
    assert_near(d[0], 0, 0);
    assert_int_equal(deck.motion.node_class[2], 0); /* its nodes move with it */
    deck_end(&deck);
}

static void airbags_damp_against_their_mean(void **unused)
{
    (void)unused;
    MotionDeck deck;
    const int32_t first[3] = {0, 1, 2}, second[2] = {2, 3};
    deck_begin_strip(&deck, 4);
    deck.d.gravity_parts.count = 0;
    DECK_ADD(deck.d.gravity_parts, (GravityPartDefinition){.id = 100, .dof = 3, .accel = 8});
    DECK_ADD(deck.d.spcs, (SpcDefinition){.id = 20, .dof = {1, 1, 1, 0, 0, 0}, .death = 1e20});
    deck.input.airbag_count = 2;
    deck.bags[0] = (AirbagNodes){3, first, 5};
    deck.bags[1] = (AirbagNodes){2, second, 7};
    assert_int_equal(deck_build(&deck), 0);
    const BodyClass *class[4];
    for (int n = 0; n < 4; n++) class[n] = &deck.motion.loads.classes[deck.motion.node_class[n]];
    assert_true(class[0] -> airbag == 0 && class[0] -> airbag_damping == 5 && class[0] -> gravity_count == 1);
    assert_true(class[1] -> airbag == -1 && class[1] -> gravity_count == 0); /* fixed: nothing acts on it */
    assert_true(class[2] -> airbag == 0);
    assert_true(class[3] -> airbag == 1 && class[3] -> airbag_damping == 7);
    assert_int_equal(deck_messages(&deck, SEVERITY_WARNING, 0, "1 node(s) are on two bags", NULL), 1);
    deck_end(&deck);
}

static void a_plain_scene_has_no_classes(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    assert_int_equal(deck_build(&deck), 0);
    assert_null(deck.motion.node_class);
    assert_int_equal(deck.motion.loads.class_count, 1);
    deck_end(&deck);
}

static void load_cards_are_read(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    deck_add_curve(&deck, 1, 0, 2, POINTS);
    const int nodes[] = {40, 20};
    deck_add_set(&deck, SET_NODE, 1, 2, nodes);
    SetDefinition set = {.kind = SET_SEGMENT, .id = 6};
    DECK_ADD(set.segments, (SegmentDefinition){{10, 20, 70, 60}, {0, 200}});
    DECK_ADD(set.segments, (SegmentDefinition){{20, 30, 70, 70}, {0, 201}});
    DECK_ADD(deck.d.sets, set);
    DECK_ADD(deck.d.coordinates,
             (CoordinateDefinition){.kind = COORDINATE_SYSTEM, .id = 4, .x_point = {0, 1, 0}, .xy_point = {0, 0, 1}});
    DECK_ADD(deck.d.node_loads, (NodeLoadDefinition){.is_set = true, .id = 1, .dof = 3, .lcid = 1, .sf = 3, .cid = 4});
    DECK_ADD(deck.d.segment_loads,
             (SegmentLoadDefinition){.is_set = true, .id = 6, .lcid = 1, .sf = 5, .at = 0.5, .source = {0, 41}});
    DECK_ADD(deck.d.segment_loads,
             (SegmentLoadDefinition){.lcid = 1, .sf = 7, .node = {30, 40, 80, 0}, .source = {0, 42}});
    assert_int_equal(deck_build(&deck), 0);
    const Motion *m = &deck.motion;
    assert_int_equal(m->loads.node_load_count, 2);
    assert_true(m->loads.node_loads[0].node == 1 && m->loads.node_loads[1].node == 3);
    assert_near(m->loads.node_loads[0].direction[0], 1, 1e-15); /* local z */
    assert_true(m->loads.node_loads[0].scale == 3);
    assert_int_equal(m->segment_load_count, 2);
    assert_int_equal(m->segment_count, 3);
    const int32_t expected[12] = {0, 1, 6, 5, 1, 2, 6, 6, 2, 3, 7, 7};
    assert_memory_equal(m->segment_node, expected, sizeof expected);
    assert_true(m->segment_load[0] == 0 && m->segment_load[1] == 0 && m->segment_load[2] == 1);
    assert_true(m->segment_loads[0].scale == 5 && m->segment_loads[0].arrival == 0.5);
    assert_int_equal(m->segment_source[2].line, 42);
    deck_end(&deck);
}

static void bad_load_cards_are_refused(void **unused)
{
    (void)unused;
    static const char *const words[][2] = {{"DOF = 5", "moment"},
                                           {"M2 = 0", "no node"},
                                           {"LCID = 9", "*LOAD_NODE_POINT"},
                                           {"N3 = 7", "no node"},
                                           {"no part", "*LOAD_GRAVITY_PART"},
                                           {"STGA = 2", NULL},
                                           {"DOF = 4", "1, 2, 3"},
                                           {"LCID is 0", "*LOAD_BODY_X"},
                                           {"LCID is 0", "*DAMPING_PART_MASS"},
                                           {"moves with the model", "*LOAD_NODE_POINT"},
                                           {"no set 8", "*DAMPING_PART_MASS_SET"}};
    for (int k = 0; k < (int)(sizeof words / sizeof *words); k++) {
        MotionDeck deck;
        NodeLoadDefinition point = {.id = 20, .dof = 1, .lcid = 1, .sf = 1, .source = {0, 40}};
        GravityPartDefinition gravity = {.id = 100, .dof = 3, .accel = 1, .source = {0, 40}};
        deck_begin_strip(&deck, 4);
        deck_add_curve(&deck, 1, 0, 2, POINTS);
        DECK_ADD(
            deck.d.coordinates,
            (CoordinateDefinition){.kind = COORDINATE_NODES, .id = 4, .node = {10, 20, 60}, .flag = 1, .dir = 'X'});
        if (k == 0) point.dof = 5;
        if (k == 1) point.dof = 4, point.m1 = 10, point.m3 = 20;
        if (k == 2) point.lcid = 9;
        if (k == 3)
            DECK_ADD(deck.d.segment_loads,
                     (SegmentLoadDefinition){.lcid = 1, .sf = 7, .node = {30, 40, 7, 80}, .source = {0, 40}});
        if (k == 4) gravity.id = 5;
        if (k == 5) gravity.stga = 2;
        if (k == 6) gravity.dof = 4;
        if (k == 7) DECK_ADD(deck.d.body_loads, (BodyLoadDefinition){.sf = 1, .source = {0, 40}});
        if (k == 8) DECK_ADD(deck.d.dampings, (DampingDefinition){.id = 100, .sf = 1, .source = {0, 40}});
        if (k == 9) point.cid = 4;
        if (k == 10)
            DECK_ADD(deck.d.dampings,
                     (DampingDefinition){.is_set = true, .id = 8, .lcid = 1, .sf = 1, .source = {0, 40}});
        DECK_ADD(deck.d.node_loads, point);
        DECK_ADD(deck.d.gravity_parts, gravity);
        assert_int_equal(deck_build(&deck), -1);
        deck_expect_error(&deck, 40, words[k][0], words[k][1]);
        deck_end(&deck);
    }
}

/* Ten gravity terms with curves of their own do not fit one part. */
static void too_many_terms_are_refused(void **unused)
{
    (void)unused;
    MotionDeck deck;
    deck_begin_strip(&deck, 4);
    for (int k = 0; k < BILLOW_GRAVITIES + 1; k++) {
        deck_add_curve(&deck, k + 1, 0, 2, POINTS);
        DECK_ADD(deck.d.gravity_parts,
                 (GravityPartDefinition){.id = 100, .dof = 3, .lc = k + 1, .accel = 1, .source = {0, 40 + k}});
    }
    assert_int_equal(deck_build(&deck), -1);
    deck_expect_error(&deck, 40 + BILLOW_GRAVITIES, "combine their curves", NULL);
    deck_end(&deck);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(classes_sum_their_terms),
        cmocka_unit_test(point_loads_push_and_follow),
        cmocka_unit_test(segment_pressure_waits_for_its_arrival),
        cmocka_unit_test(gravity_acts_against_its_axis),
        cmocka_unit_test(border_nodes_weigh_by_mass),
        cmocka_unit_test(global_damping_by_curve),
        cmocka_unit_test(rigid_bodies_take_their_parts_class),
        cmocka_unit_test(airbags_damp_against_their_mean),
        cmocka_unit_test(a_plain_scene_has_no_classes),
        cmocka_unit_test(load_cards_are_read),
        cmocka_unit_test(bad_load_cards_are_refused),
        cmocka_unit_test(too_many_terms_are_refused),
    };
    return cmocka_run_group_tests_name("loads", tests, NULL, NULL);
}
