/* Broken decks: one message each, of the right line and keyword. Real decks: only what billow does not have. */
#include <stdlib.h>

#include "tests/keyword_case.h"

static void test_cards(void **state)
{
    (void)state;
    assert_one_error("*MAT_FABRIC\n         1    1.0E-4    2.0E+6\n", 2, "*MAT_FABRIC", "card 2 is missing");
    assert_one_error("*PART\nname\n", 2, "*PART", "card 1 is missing");
    assert_one_error("*AIRBAG_WANG_NEFSKE\n"
                     "         1         1\n"
                     "     896.0    1204.0    3600.0         0         1\n",
                     3, "*AIRBAG_WANG_NEFSKE", "card 4 is missing");
    assert_one_error("*NODE\n       1             1.0             abc             0.0\n", 2, "*NODE",
                     "Y (columns 25-40)");
    assert_one_error("*SECTION_SHELL\n         1       1.5\n       0.4\n", 2, "*SECTION_SHELL", "ELFORM");
    assert_one_error("*MAT_ELASTIC\n         1    1.2E-6       5.0       0.3\n         2       1.0\n", 3,
                     "*MAT_ELASTIC", "beyond the last card");
    assert_one_error("*CONTROL_TERMINATION\n      10.0\n      20.0\n", 3, "*CONTROL_TERMINATION",
                     "beyond the last card");
}

static void test_ids(void **state)
{
    (void)state;
    assert_one_error("*NODE\n       0             1.0             1.0             0.0\n", 2, "*NODE", "NID is 0");
    assert_one_error("*SET_PART\n\n         1\n", 2, "*SET_PART", "SID is 0");
    assert_one_error("*NODE\n"
                     "       1             1.0             1.0             0.0\n"
                     "       3             1.0             1.0             0.0\n"
                     "       1             2.0             1.0             0.0\n",
                     4, "*NODE", "node 1 is defined a second time (first in line 2)");
    assert_one_error("*ELEMENT_SHELL\n"
                     "       5       1       1       2       3       4\n"
                     "       5       1       1       2       3       4\n",
                     3, "*ELEMENT_SHELL", "shell 5 is defined a second time (first in line 2)");
    assert_one_error("*MAT_NULL\n         1     1.0\n*MAT_ELASTIC\n         1     1.0       1.0\n", 4, "*MAT",
                     "material 1 is defined a second time (first in line 2)");
    assert_one_error("*DEFINE_CURVE\n         1\n0.,0.\n*DEFINE_CURVE\n         1\n0.,1.\n", 5, "*DEFINE_CURVE",
                     "curve 1 is defined a second time (first in line 2)");
    assert_one_error("*PART\na\n         1\n\n         1\n", 5, "*PART", "part 1 is defined a second time");
    assert_one_error(
        "*SET_NODE\n         1\n         5\n*SET_PART\n         1\n         6\n*SET_NODE\n         1\n         7\n", 8,
        "*SET_NODE", "node set 1 is defined a second time (first in line 2)");
}

static void test_repeated_ids_leave_one(void **state)
{
    (void)state;
    KeywordCase c = read_case("*SET_NODE\n         2\n         5\n*SET_NODE\n         1\n         6\n"
                              "*SET_NODE\n         2\n         7\n*SET_NODE\n         2\n         8\n"
                              "*SET_NODE\n         3\n         9\n");
    assert_int_equal(c.g.errors, 2);
    assert_false(c.d.incomplete); /* every id is still there */
    assert_int_equal(c.d.sets.count, 3);
    assert_int_equal(c.d.sets.items[0].members.items[0], 5);
    assert_int_equal(c.d.sets.items[2].members.items[0], 9);
    close_case(&c);
}

static void test_elements(void **state)
{
    (void)state;
    assert_one_error("*ELEMENT_SHELL\n       5       1       1       1       3       3\n", 2, "*ELEMENT_SHELL",
                     "shell 5 has no area");
    assert_one_error("*ELEMENT_SHELL\n       5       1       1       2       1       3\n", 2, "*ELEMENT_SHELL",
                     "shell 5 has no area");
    assert_one_error("*ELEMENT_SHELL\n       5       1       1       2       0       3\n", 2, "*ELEMENT_SHELL",
                     "N3 is 0");
    assert_one_error(
        "*ELEMENT_SHELL\n       5       1       1       2       3       4       5       6       7       8\n", 2,
        "*ELEMENT_SHELL", "N5");
}

static void test_curves_and_sets(void **state)
{
    (void)state;
    assert_one_error("*DEFINE_CURVE\n         3\n"
                     "                 0.0                 0.0\n"
                     "                 2.0                 1.0\n"
                     "                 1.0                 2.0\n"
                     "                 0.5                 2.0\n",
                     5, "*DEFINE_CURVE", "curve 3: the abscissa 1 is less than the 2 before it");
    assert_one_error("*DEFINE_CURVE\n         3\n0.,0.\n0.,1.\n", 4, "*DEFINE_CURVE", "repeats");
    assert_one_error("*DEFINE_CURVE\n         3\n", 2, "*DEFINE_CURVE", "no points");
    assert_one_error("*DEFINE_CURVE\n         3         0      -1.0\n0.,0.\n", 2, "*DEFINE_CURVE", "SFA");
    assert_one_error("*SET_NODE_LIST\n         1\n", 2, "*SET_NODE_LIST", "no members");
    assert_one_error("*SET_NODE_GENERAL\n         1\nVOL                1\n", 3, "*SET_NODE_GENERAL", "'VOL'");
    assert_one_error("*SET_SHELL_GENERATE\n         1\n        20        10\n", 3, "*SET_SHELL_GENERATE", "20 to 10");
    assert_one_error("*DEFINE_BOX\n         1       1.0       0.0\n", 2, "*DEFINE_BOX", "XMN = 1 is above XMX = 0");
}

static void test_unknown_keywords(void **state)
{
    (void)state;
    assert_one_error("*CONTACT_RIGID_NODES_TO_RIGID_BODY\n         1\n", 1, "*CONTACT_RIGID_NODES_TO_RIGID_BODY",
                     "is not read by billow 0.1.0");
    assert_one_error("*NDOE\n         1\n", 1, "*NDOE", "did you mean *NODE?");
    assert_one_error("*PART_CONTACT\nx\n         1\n", 1, "*PART_CONTACT", "the option CONTACT of *PART is not read");
    assert_one_error("*ELEMENT_SHELL_OFFSET\n       5       1       1       2       3       4\n", 1,
                     "*ELEMENT_SHELL_OFFSET", "the option OFFSET of *ELEMENT_SHELL is not read");
    assert_one_error("*AIRBAG_HYBRID_POP_JETTING\n         1\n", 1, "*AIRBAG_HYBRID_POP_JETTING",
                     "the option POP_JETTING of *AIRBAG_HYBRID is not read");
    assert_one_error("*AIRBAG_PARTICLE\n         1\n", 1, "*AIRBAG_PARTICLE", "is not read by billow");
}

static void test_refused_features(void **state)
{
    (void)state;
    static const char bag[] = "*AIRBAG_WANG_NEFSKE\n"
                              "         1         1%10s\n"
                              "     896.0    1204.0    3600.0         0%10s\n"
                              "       0.0         0%10s\n"
                              "     0.1E0    1.2E-9       1.0         0       0.0       0.0%10s\n"
                              "%10s\n";
    static const struct {
        const char *values[5];
        int line;
        const char *part;
    } cases[] = {
        {{"0", "-1", "0", "0", "0"}, 3, "LCMT"},
        {{"0", "1", "-3.5", "0", "0"}, 4, "A23"},
        {{"0", "0", "0", "0", "0.5"}, 6, "IOC"},
        {{"0", "1", "0", "9", "0"}, 5, "OPT is 9"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        const char *const *v = cases[i].values;
        snprintf(text, sizeof text, bag, v[0], v[1], v[2], v[3], v[4]);
        assert_one_error(text, cases[i].line, "*AIRBAG_WANG_NEFSKE", cases[i].part);
    }
    assert_one_error(
        "*MAT_FABRIC\n         1    1.0E-4    2.0E+6\n\n                                                          15\n"
        "\n\n         1         2\n",
        4, "*MAT_FABRIC", "FORM = 15");
    assert_one_error("*SECTION_SHELL\n         1       101\n       0.1\n\n\n", 2, "*SECTION_SHELL", "ELFORM = 101");
    assert_one_error("*CONTROL_DYNAMIC_RELAXATION\n       250     0.001     0.995                           0      0.04"
                     "         2\n",
                     2, "*CONTROL_DYNAMIC_RELAXATION", "IDRFLG = 2");
    assert_one_error("*CONTROL_DYNAMIC_RELAXATION\n        -1     0.001     0.995                           0      0.04"
                     "         1\n",
                     2, "*CONTROL_DYNAMIC_RELAXATION", "NRCYCK = -1");
    assert_one_error("*CONTROL_DYNAMIC_RELAXATION\n       250       2.0     0.995                           0      0.04"
                     "         1\n",
                     2, "*CONTROL_DYNAMIC_RELAXATION", "DRTOL = 2");
}

/* Ids behind a sign in real columns must be whole numbers. */
static void test_real_ids(void **state)
{
    (void)state;
    assert_one_error("*AIRBAG_SIMPLE_AIRBAG_MODEL\n"
                     "         1         1\n"
                     "   196.168     274.6     800.0         1      -1.5       0.01.01300E-41.22500E-9\n",
                     3, "*AIRBAG_SIMPLE_AIRBAG_MODEL", "MU is -1.5");
    assert_one_error("*MAT_FABRIC\n         1    1.0E-4    2.0E+6\n\n     -1E30\n", 4, "*MAT_FABRIC", "AOPT is -1e+30");
    assert_one_error("*INITIAL_VELOCITY_GENERATION\n"
                     "         0         0      10.0\n"
                     "       0.0       0.0       0.0    -999.0       1.0       2.5\n",
                     2, "*INITIAL_VELOCITY_GENERATION", "NZ is 2.5");
}

/* FVOPT out of its range, and curve ids that are none. */
static void test_fabric_leakage(void **state)
{
    (void)state;
    static const char deck[] = "*MAT_FABRIC\n"
                               "         1    1.0E-4    2.0E+6\n"
                               "\n"
                               "       0.0%10s       1.0       0.0       0.0         0%10s\n";
    char text[500];
    snprintf(text, sizeof text, deck, "0.5", "9.0");
    assert_one_error(text, 4, "*MAT_FABRIC", "FVOPT is 9");
    snprintf(text, sizeof text, deck, "-1.5", "1.0");
    assert_one_error(text, 4, "*MAT_FABRIC", "FLC is -1.5");
    snprintf(text, sizeof text, deck, "-15", "1.0");
    KeywordCase c = read_fine(text);
    assert_float_equal(c.d.materials.items[0].fabric.flc, -15, 0);
    assert_float_equal(c.d.materials.items[0].fabric.fvopt, 1, 0);
    close_case(&c);
}

/* Lost records are told from a keyword that nothing refers to. */
static void test_incomplete(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool incomplete;
    } cases[] = {
        {"*NODE\n       1             abc\n", true},
        {"*MAT_ADD_EROSION\n         1\n", true},
        {"*CONTACT_TIED\n         1\n", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        KeywordCase c = read_case(cases[i].text);
        assert_int_equal(c.g.errors, 1);
        assert_int_equal(c.d.incomplete, cases[i].incomplete);
        close_case(&c);
    }
}

static void test_nothing(void **state)
{
    (void)state;
    KeywordCase c = read_case("");
    assert_int_equal(c.status, -1);
    assert_int_equal(c.g.errors, 1);
    close_case(&c);
    c = read_case("*KEYWORD\n*END\n");
    assert_int_equal(c.status, -1);
    assert_int_equal(c.g.errors, 1);
    close_case(&c);
}

/* The keywords of all errors, one after the other. */
static void assert_deck(const char *name, const char *expected, size_t nodes, size_t shells, int warnings)
{
    char path[600], found[400] = "";
    snprintf(path, sizeof path, "%s/decks/%s/deck.k", BILLOW_SHARED_DIR, name);
    FILE *file = fopen(path, "r");
    if (!file) {
        printf("skipped: %s is not there\n", path);
        skip();
    }
    fclose(file);
    Definitions d = {0};
    Diagnostics g = {0};
    deck_read(path, &d, &g);
    for (size_t i = 0; i < g.count; i++) {
        if (g.messages[i].severity != SEVERITY_ERROR) continue;
        snprintf(found + strlen(found), sizeof found - strlen(found), "%s ", g.messages[i].keyword);
    }
    assert_string_equal(found, expected);
    assert_int_equal(d.nodes.count, nodes);
    assert_int_equal(d.shells.count, shells);
    assert_int_equal(g.warnings, warnings);
    assert_int_equal(g.environment, 0);
    definitions_free(&d);
    diagnostics_free(&g);
}

static void test_classic_deploy(void **state)
{
    (void)state;
    assert_deck("classic-deploy", "", 3867, 3792, 0);
}

static void test_landing_pad_closed(void **state)
{
    (void)state;
    assert_deck("landing-pad-closed", "", 3990, 4056, 0);
}

static void test_landing_pad_ring_wall(void **state)
{
    (void)state;
    assert_deck("landing-pad-ring-wall", "", 3145, 3148, 0);
}

static void test_landing_pad_wang_nefske(void **state)
{
    (void)state;
    assert_deck("landing-pad-wang-nefske", "", 7440, 7408, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cards),
        cmocka_unit_test(test_ids),
        cmocka_unit_test(test_repeated_ids_leave_one),
        cmocka_unit_test(test_elements),
        cmocka_unit_test(test_curves_and_sets),
        cmocka_unit_test(test_unknown_keywords),
        cmocka_unit_test(test_refused_features),
        cmocka_unit_test(test_real_ids),
        cmocka_unit_test(test_fabric_leakage),
        cmocka_unit_test(test_incomplete),
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_classic_deploy),
        cmocka_unit_test(test_landing_pad_closed),
        cmocka_unit_test(test_landing_pad_ring_wall),
        cmocka_unit_test(test_landing_pad_wang_nefske),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
