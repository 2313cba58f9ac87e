/* *CONTACT cards: fields, optional cards, and everything that is wrong, all in one list. */
#include "tests/keyword_case.h"

#include "contact/contact_check.h"
#include "tests/program.h"
#include "tests/verify.h"

static void test_cards(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*CONTACT_AIRBAG_SINGLE_SURFACE_ID\n"
                              "        12folded bag\n"
                              "         7         0         2         0\n"
                              "       0.3       0.2      1e-3                  20         0      0.01       0.5\n"
                              "       2.0       0.5     4e-04                 0.9                 1.5\n"
                              "         2       0.2         0     1.025         3         5       100         1\n"
                              "                   1         2\n"
                              "         1         2\n"
                              "         0\n"
                              "         0\n"
                              "*CONTACT_AUTOMATIC_NODES_TO_SURFACE_MPP\n"
                              "         0       200\n"
                              "&        1\n"
                              "         3         4         4         0\n"
                              "\n"
                              "\n"
                              "*CONTROL_CONTACT\n"
                              "      0.05\n"
                              "\n"
                              "\n"
                              "         1         0         1\n");
    assert_int_equal(c.d.contacts.count, 2);
    const ContactDefinition *k = c.d.contacts.items;
    assert_int_equal(k->kind, CONTACT_SELF);
    assert_true(k->automatic);
    assert_int_equal(k->id, 12);
    assert_string_equal(k->title, "folded bag");
    assert_int_equal(k->ssid, 7);
    assert_int_equal(k->sstyp, 2);
    assert_true(k->fs == 0.3 && k->fd == 0.2 && k->dc == 1e-3 && k->vdc == 20 && k->birth == 0.01 && k->death == 0.5);
    assert_true(k->sfs == 2 && k->sfm == 0.5 && k->sst == 4e-4 && k->mst == 0 && k->sfst == 0.9 && k->fsf == 1.5);
    assert_int_equal(k->soft, 2);
    assert_true(k->sofscl == 0.2);
    assert_int_equal(k->thkopt, 1);
    assert_int_equal(k->shlthk, 2);
    assert_int_equal(k->ignore, 2);
    assert_int_equal(k[1].kind, CONTACT_NODES_TO_SURFACE);
    assert_int_equal(k[1].sstyp, 4);
    assert_true(k[1].death == 1e20 && k[1].sfs == 1 && k[1].sofscl == 0.1);
    assert_true(c.d.control.contact.slsfac == 0.05);
    assert_int_equal(c.d.control.contact.ignore, 1);
    assert_int_equal(count_notes(&c, "SBOPT"), 1);
    assert_int_equal(count_notes(&c, "SKIPRWG"), 1);
    close_case(&c);
}

static void test_wrong_fields(void **state)
{
    (void)state;
#define CONTACT(kind, cards) "*CONTACT_" kind "\n" cards
    assert_one_error(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,7\n\n\n"), 2, "*CONTACT_AUTOMATIC_SINGLE_SURFACE",
                     "SSTYP = 7");
    assert_one_error(CONTACT("AUTOMATIC_SURFACE_TO_SURFACE", "1,2,4,3\n\n\n"), 2,
                     "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "SSTYP = 4");
    assert_one_error(CONTACT("AUTOMATIC_SURFACE_TO_SURFACE", "1,0,3,3\n\n\n"), 2,
                     "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "MSID");
    assert_one_error(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n-1.0\n\n"), 3, "*CONTACT_AUTOMATIC_SINGLE_SURFACE",
                     "FS = -1");
    assert_one_error(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n0,0,0,1e6\n\n"), 3,
                     "*CONTACT_AUTOMATIC_SINGLE_SURFACE", "VC");
    assert_one_error(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n\n\n4\n"), 5, "*CONTACT_AUTOMATIC_SINGLE_SURFACE",
                     "SOFT = 4");
    KeywordCase c = read_case(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n"));
    assert_int_equal(c.g.errors, 2); /* cards 2 and 3 are missing */
    close_case(&c);
    assert_one_error("*CONTACT_AUTOMATIC_SINGLE_SURFACE_SMOOTH\n1,0,2\n\n\n", 1,
                     "*CONTACT_AUTOMATIC_SINGLE_SURFACE_SMOOTH", "SMOOTH");
}

/* Times below 0 mean other things in LS-DYNA; a contact that ends before it begins is warned of; PENMAX has no effect.
 */
static void test_times_and_penmax(void **state)
{
    (void)state;
    assert_one_error(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n,,,,,,-0.01\n\n"), 3,
                     "*CONTACT_AUTOMATIC_SINGLE_SURFACE", "BT = -0.01");
    assert_one_error(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n,,,,,,0,-3\n\n"), 3,
                     "*CONTACT_AUTOMATIC_SINGLE_SURFACE", "DT = -3");
    KeywordCase c = read_case(CONTACT("AUTOMATIC_SINGLE_SURFACE", "1,0,2\n,,,,,,0.2,0.1\n\n\n0.4\n"));
    assert_int_equal(c.g.errors, 0);
    assert_int_equal(c.g.warnings, 1);
    for (size_t i = 0; i < c.g.count; i++) {
        if (c.g.messages[i].severity != SEVERITY_WARNING) continue;
        assert_non_null(strstr(c.g.messages[i].text, "this contact never acts"));
        assert_int_equal(c.g.messages[i].source.line, 3);
    }
    assert_int_equal(count_notes(&c, "PENMAX"), 1);
    close_case(&c);
}

/* Older names of the same contacts are read; transducers only measure; what billow does not have says what to use. */
static void test_families(void **state)
{
    (void)state;
    KeywordCase c = read_fine(CONTACT("ONE_WAY_SURFACE_TO_SURFACE", "1,2,3,3\n\n\n") CONTACT(
        "SINGLE_SURFACE_ID", "4\n1,0,2\n\n\n") CONTACT("FORCE_TRANSDUCER_PENALTY", "1,0,3\n\n\n"));
    assert_int_equal(c.d.contacts.count, 2);
    assert_int_equal(c.d.contacts.items[0].kind, CONTACT_ONE_WAY);
    assert_false(c.d.contacts.items[0].automatic);
    assert_int_equal(c.d.contacts.items[1].kind, CONTACT_SELF);
    assert_true(c.d.contacts.items[1].automatic);
    assert_int_equal(count_notes(&c, "only measures"), 1);
    close_case(&c);
    c = read_case(
        "*CONTROL_CONTACT\n.1\n*CONTROL_CONTACT\n.2\n*LOAD_BODY_Z\n1,2\n*LOAD_BODY_Z\n1,3\n*LOAD_BODY_X\n1,3\n");
    assert_int_equal(c.g.warnings, 2);
    assert_true(c.d.control.contact.slsfac == 0.2);
    close_case(&c);
    assert_one_error(CONTACT("TIED_NODES_TO_SURFACE", "1,2,3,3\n\n\n"), 1, "*CONTACT_TIED_NODES_TO_SURFACE",
                     "nothing is tied");
}

/* The forms with card 4 are the automatic ones; the optional cards come after it. */
static void test_eroding_forms(void **state)
{
    (void)state;
    KeywordCase c = read_fine(CONTACT("ERODING_SINGLE_SURFACE_ID", "4\n1,0,2\n\n\n1,1,0\n2,.2\n")
                                  CONTACT("ERODING_SURFACE_TO_SURFACE", "1,2,3,3\n.3\n\n,1,1\n")
                                      CONTACT("ERODING_NODES_TO_SURFACE", "1,2,4,3\n\n,,1e-4\n\n1,.3\n,1\n"));
    const ContactDefinition *k = c.d.contacts.items;
    assert_int_equal(c.d.contacts.count, 3);
    assert_int_equal(k[0].kind, CONTACT_SELF);
    assert_int_equal(k[0].id, 4);
    assert_int_equal(k[0].soft, 2);
    assert_true(k[0].sofscl == 0.2);
    assert_int_equal(k[1].kind, CONTACT_TWO_WAY);
    assert_true(k[1].automatic && k[1].fs == 0.3 && k[1].soft == 0);
    assert_int_equal(k[2].kind, CONTACT_NODES_TO_SURFACE);
    assert_true(k[2].automatic && k[2].sst == 1e-4 && k[2].soft == 1 && k[2].sofscl == 0.3 && k[2].thkopt == 1);
    assert_int_equal(count_notes(&c, "EROSOP"), 2);
    close_case(&c);
}

static const char model_head[] = "*CONTROL_TERMINATION\n1e-4\n"
                                 "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
                                 "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,2,5,6,7,8\n"
                                 "*PART\nlower\n1,1,1\n*PART\nupper\n2,2,2\n*PART\nempty\n3,1,1\n"
                                 "*SECTION_SHELL\n1,9\n0.01\n*SECTION_SHELL\n2,9\n0\n"
                                 "*MAT_ELASTIC\n1,800,1e6,0.3\n*MAT_NULL\n2,800\n"
                                 "*MAT_NULL\n3,800\n";

/* Builds the model with these cards; each expected text must be in one error. */
static void expect_errors(const char *cards, int count, const char *const *expected)
{
    char text[4000];
    VerifyRun run;
    snprintf(text, sizeof text, "%s%s*END\n", model_head, cards);
    int status = verify_build(&run, text, strlen(text), &(VerifyOptions){0});
    int found = 0;
    for (int i = 0; i < count; i++) found += verify_message(&run.diagnostics, SEVERITY_ERROR, expected[i]);
    if (run.diagnostics.errors != count || found != count) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(status ? 1 : 0, count > 0);
    assert_int_equal(run.diagnostics.errors, count);
    assert_int_equal(found, count);
    assert_int_equal(diagnostics_exit_code(&run.diagnostics), count ? BILLOW_EXIT_INPUT : BILLOW_EXIT_NORMAL);
    verify_free(&run);
}

/* All that is wrong comes at once. */
static void test_wrong_surfaces(void **state)
{
    (void)state;
    expect_errors("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,99,3,3\n\n\n"
                  "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n77,0,2\n\n\n"
                  "*CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE\n1,5,3,0\n\n\n"
                  "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n3,3,3,3\n\n\n"
                  "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n2,0,3\n\n\n"
                  "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n1,0,3,0,8\n\n\n"
                  "*CONTACT_AIRBAG_SINGLE_SURFACE\n1,0,3\n\n\n0,0,44\n",
                  8,
                  (const char *const[]){"MSID = 99 is not a part", "no set 77", "no segment set 5",
                                        "SSID = 3 of type 3 holds no shells", "MSID = 3 of type 3 holds no shells",
                                        "thickness of all shells of this contact is zero", "box 8 of SBOXID",
                                        "LCIDAB"});
    expect_errors("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n", 0, NULL);
    expect_errors("*CONTACT_NODES_TO_SURFACE\n2,2,3,3\n\n\n", 0, NULL);
}

/* A thickness that the mesh is too fine for is not cut in silence. */
static void test_cut_thickness(void **state)
{
    (void)state;
    static const char *const decks[] = {"*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n,,0.3,0.9\n",
                                        "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n,,0.3,0.4\n"};
    for (int i = 0; i < 2; i++) {
        char text[4000];
        VerifyRun run;
        snprintf(text, sizeof text, "%s%s*END\n", model_head, decks[i]);
        assert_int_equal(verify_build(&run, text, strlen(text), &(VerifyOptions){0}), 0);
        assert_int_equal(verify_message(&run.diagnostics, SEVERITY_WARNING, "MST = 0.9 is more than 0.4"), i == 0);
        assert_int_equal(verify_message(&run.diagnostics, SEVERITY_WARNING, "SST"), 0);
        verify_free(&run);
    }
}

/* What the reader finds and what the build finds, with the lines of the deck, in one list: a set of zero segments,
 * bodies that share a node, parts and sets that are missing, sides that are empty, a thickness of zero. */
static void test_one_list(void **state)
{
    (void)state;
    static Program program;
    static const char cards[] = "*ELEMENT_SHELL\n3,4,1,2,3,4\n4,5,2,6,7,3\n"
                                "*PART\nrigid\n4,1,4\n*PART\nrigid too\n5,1,4\n*MAT_RIGID\n4,7800,2e11,0.3\n0\n\n"
                                "*SET_SEGMENT\n9\n"
                                "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,99,3,3\n\n\n"
                                "*CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE\n1,9,3,0\n\n\n"
                                "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n3,3,3,3\n\n\n"
                                "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n2,0,3\n\n\n"
                                "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n77,0,2\n\n\n";
    static const char *const expected[] = {"rigid bodies 4 and 5 share node 2",
                                           "set 9 has no members",
                                           "MSID = 9 is a set of zero segments",
                                           "MSID = 99 is not a part",
                                           "SSID = 3 of type 3 holds no shells",
                                           "MSID = 3 of type 3 holds no shells",
                                           "thickness of all shells of this contact is zero",
                                           "there is no set 77",
                                           "wrong.k: 8 errors"};
    char text[4000];
    int length = snprintf(text, sizeof text, "%s%s*END\n", model_head, cards);
    program_open(&program);
    program_write(&program, "wrong.k", text, (size_t)length);
    assert_int_equal(program_run(&program, "run wrong.k"), BILLOW_EXIT_INPUT);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        if (!strstr(program.err, expected[i])) print_message("%s\nlacks: %s\n", program.err, expected[i]);
        assert_non_null(strstr(program.err, expected[i]));
    }
    program_close(&program);
}

/* Near, touching and crossing layers are found where they are. */
static void test_inspection(void **state)
{
    (void)state;
    static const char deck[] =
        "*CONTROL_TERMINATION\n1e-4\n"
        "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0.2,0.2,0.004\n6,0.8,0.2,0.02\n7,0.8,0.8,0.02\n"
        "8,0.2,0.8,0.02\n9,0.5,0.4,-1\n10,0.5,0.6,-1\n11,0.5,0.5,1\n"
        "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,1,5,6,7,8\n3,1,9,10,11,11\n"
        "*PART\nsheet\n1,1,1\n*SECTION_SHELL\n1,9\n0.01\n*MAT_ELASTIC\n1,800,1e6,0.3\n"
        "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0,5\n\n\n*END\n";
    VerifyRun run;
    ContactFindings f;
    assert_int_equal(verify_build(&run, deck, strlen(deck), &(VerifyOptions){0}), 0);
    assert_int_equal(contact_inspect(&run.model, run.model.contacts, run.model.initial, &f, NULL, NULL), 0);
    assert_int_equal(f.near_count, 1);
    assert_int_equal(f.touch_count, 0);
    assert_int_equal(run.model.node_id[f.nearest_node], 5);
    verify_close("nearest over the thickness", f.nearest, 0.4, 1e-12);
    /* two edges of the upright triangle through two sheets, and the sheets' diagonals through the triangle */
    assert_int_equal(f.cross_count, 6);
    verify_free(&run);
}

/* Sheets that start crossed are warned of where users look: by check, and by a run before it begins. */
static void test_crossed_sheets(void **state)
{
    (void)state;
    static Program program;
    static const char cards[] = "*NODE\n11,.5,.3,-.4\n12,.5,.7,-.4\n13,.5,.7,.4\n14,.5,.3,.4\n"
                                "*ELEMENT_SHELL\n11,1,11,12,13,14\n"
                                "*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID\n5\n1,0,3\n\n\n";
    char text[4000];
    program_open(&program);
    int length = snprintf(text, sizeof text, "%s%s*END\n", model_head, cards);
    program_write(&program, "crossed.k", text, (size_t)length);
    assert_int_equal(program_run(&program, "check crossed.k"), BILLOW_EXIT_NORMAL);
    assert_non_null(strstr(program.out, "warning: *CONTACT"));
    assert_non_null(strstr(program.out, "contact 5: "));
    assert_int_equal(program_run(&program, "run crossed.k -q"), BILLOW_EXIT_NORMAL);
    assert_non_null(strstr(program.err, "stays tangled"));
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_eroding_forms),    cmocka_unit_test(test_cards),
                                       cmocka_unit_test(test_wrong_fields),     cmocka_unit_test(test_wrong_surfaces),
                                       cmocka_unit_test(test_one_list),         cmocka_unit_test(test_inspection),
                                       cmocka_unit_test(test_times_and_penmax), cmocka_unit_test(test_families),
                                       cmocka_unit_test(test_cut_thickness),    cmocka_unit_test(test_crossed_sheets)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
