/* Cards of reference geometries: options in any order, scale, births, masses, the written file, and what is refused,
 * all in one list with its lines. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/memory.h"
#include "tests/program.h"

/* Shells 1 and 2, quads of side 1 on x from 0 to 2, and shell 3, a triangle on top of 2; panel nodes 11 to 16 twice as
 * large. The cards begin at line 33; the density times the thickness is 3. */
static const char mesh[] = "*KEYWORD\n*CONTROL_TERMINATION\n1\n*PART\ncloth\n1,1,1\n*SECTION_SHELL\n1,9\n.5\n"
                           "*MAT_FABRIC\n%s*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,0\n4,0,1,0\n5,1,1,0\n6,2,1,0\n7,2,2,0\n"
                           "11,0,0,0\n12,2,0,0\n13,4,0,0\n14,0,2,0\n15,2,2,0\n16,4,2,0\n17,4,4,0\n";
static const char shells[] = "*ELEMENT_SHELL\n1,1,1,2,5,4\n2,1,2,3,6,5\n3,1,5,6,7,7\n";
static const char fabric[] = "1,6,1e6,1e6,,.3,.3\n,,,1\n0,,,,,2\n";
enum { FIRST_LINE = 32 };

static int build_with(VerifyRun *run, const char *material, const char *cards)
{
    char deck[8192];
    int length = snprintf(deck, sizeof deck, mesh, material);
    length += snprintf(deck + length, sizeof deck - (size_t)length, "%s%s*END\n", shells, cards);
    return verify_build(run, deck, (size_t)length, &(VerifyOptions){0});
}

static void build(VerifyRun *run, const char *cards)
{
    if (build_with(run, fabric, cards)) diagnostics_print(&run->diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(run->diagnostics.errors, 0);
}

/* The group of a shell, counted from 0. */
static const ElementGroup *group_of(const VerifyRun *run, int shell)
{
    int g = 0;
    while (g + 1 < run->model.group_count && run->model.groups[g + 1].first_element <= run->model.element_slot[shell])
        g++;
    return &run->model.groups[g];
}

/* Reference area x thickness of a shell by the constants. */
static double weight_of(const VerifyRun *run, int shell)
{
    const ElementGroup *group = group_of(run, shell);
    int64_t place = run->model.element_slot[shell] - group->first_element;
    const double *lane =
        group->geometry + place / BILLOW_LANES * group->geometry_size * BILLOW_LANES + place % BILLOW_LANES;
    double sum = 0;
    for (int p = 0; p < group->point_count; p++)
        sum += lane[(p * GEOMETRY_POINT_SIZE + GEOMETRY_WEIGHT) * BILLOW_LANES];
    return sum;
}

#define NODES "1,0,0,0\n2,2,0,0\n3,4,0,0\n4,0,2,0\n5,2,2,0\n6,4,2,0\n7,4,4,0\n"

static void options_come_in_any_order(void **state)
{
    (void)state;
    static const char *const names[] = {"",
                                        "_BIRTH",
                                        "_RDT",
                                        "_ID",
                                        "_BIRTH_RDT",
                                        "_RDT_BIRTH",
                                        "_BIRTH_ID",
                                        "_ID_BIRTH",
                                        "_RDT_ID",
                                        "_ID_RDT",
                                        "_BIRTH_RDT_ID",
                                        "_BIRTH_ID_RDT",
                                        "_RDT_ID_BIRTH",
                                        "_RDT_BIRTH_ID",
                                        "_ID_RDT_BIRTH",
                                        "_ID_BIRTH_RDT"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        bool id = strstr(names[i], "_ID"), birth = strstr(names[i], "_BIRTH"), rdt = strstr(names[i], "_RDT");
        char cards[400];
        snprintf(cards, sizeof cards, "*AIRBAG_REFERENCE_GEOMETRY%s\n%s%s" NODES, names[i], id ? "7,,,,,0\n" : "",
                 birth ? ".25\n" : "");
        VerifyRun run;
        build(&run, cards);
        const ElementGroup *group = group_of(&run, 0);
        assert_true(group->has_reference);
        assert_int_equal(group->rdt, rdt);
        assert_true(group->birth == (birth ? 0.25 : 0.0));
        verify_near("weight", weight_of(&run, 0), 2.0, 1e-12);
        verify_near("mass", run.model.element_mass[0], birth ? 3.0 : 12.0, 1e-12);
        assert_int_equal(run.model.parts[0].reference_count, 3);
        verify_near("mass by the reference", run.model.parts[0].reference_mass, 30.0, 1e-12);
        verify_near("mass by the mesh", run.model.parts[0].referred_mass, 7.5, 1e-12);
        verify_near("mass of the part", run.model.parts[0].mass, birth ? 7.5 : 30.0, 1e-12);
        verify_free(&run);
    }
    assert_int_equal(memory_in_use(), 0);
}

/* SX, SY, SZ about NIDO, or the first node of the block; panels likewise. Judged by the area of all three. */
static void scale_acts_about_its_origin(void **state)
{
    (void)state;
    static const struct {
        double area;
        const char *cards;
    } cases[] = {
        {5.5, "*AIRBAG_REFERENCE_GEOMETRY_ID\n1,3,.5,1\n4,0,1,0\n5,1,1,0\n6,2,1,0\n"},
        {7.5, "*AIRBAG_REFERENCE_GEOMETRY_ID\n1,1,3,1,1\n4,0,1,0\n5,1,1,0\n6,2,1,0\n7,2,2,0\n1,0,0,0\n"},
        {6.5, "*AIRBAG_REFERENCE_GEOMETRY_ID\n1,1,3,1,2\n4,0,1,0\n5,1,1,0\n6,2,1,0\n"}, /* the origin by *NODE */
        {30, "*AIRBAG_SHELL_REFERENCE_GEOMETRY_RDT_ID\n1,2,1.5,1,15\n1,1,11,12,15,14\n2,1,12,13,16,15\n"
             "3,1,15,16,17,17\n"},
        {9, "*AIRBAG_REFERENCE_GEOMETRY\n12,3,0,0\n15,3,2,0\n" /* nodes of panels placed by the other keyword */
            "*AIRBAG_SHELL_REFERENCE_GEOMETRY_RDT\n1,1,11,12,15,14\n2,1,12,13,16,15\n3,1,15,16,17,17\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        VerifyRun run;
        build(&run, cases[i].cards);
        verify_near("area", run.model.parts[0].reference_area, cases[i].area, 1e-12);
        assert_int_equal(group_of(&run, 0)->rdt, i >= 3);
        verify_free(&run);
    }
}

/* The last BIRTH is that of all blocks with the option, RGBRTH goes before it. */
static void births_follow_the_manual(void **state)
{
    (void)state;
    static const char late[] = "1,6,1e6,1e6,,.3,.3\n,,,1\n0,,,,,2\n,.75\n,,,\n";
    static const char cards[] = "*AIRBAG_REFERENCE_GEOMETRY_BIRTH\n.25\n1,0,0,0\n4,0,2,0\n"
                                "*AIRBAG_REFERENCE_GEOMETRY\n7,2,3,0\n*AIRBAG_REFERENCE_GEOMETRY_BIRTH\n.5\n3,3,0,0\n";
    VerifyRun run;
    build(&run, cards);
    assert_true(group_of(&run, 0)->birth == 0.5 && group_of(&run, 1)->birth == 0.5 && group_of(&run, 2)->birth == 0);
    verify_free(&run);
    assert_int_equal(build_with(&run, late, cards), 0);
    assert_true(group_of(&run, 0)->birth == 0.75 && group_of(&run, 2)->birth == 0.75);
    verify_free(&run);
    assert_int_equal(
        build_with(&run, late, "*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,,11,12,15,14\n2,,12,13,16,15\n3,,15,16,17,17\n"),
        0);
    assert_true(group_of(&run, 0)->birth == 0.75);
    /* panels of four times the area: the part keeps the mesh's mass, which is said */
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "part 1 weighs 7.5 for the whole run"));
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "as cut it weighs 30"));
    verify_free(&run);
}

typedef struct Expected {
    int line;
    const char *text;
} Expected;

static void refuse(const char *material, const char *cards, int count, const Expected *expected)
{
    VerifyRun run;
    int status = build_with(&run, material, cards);
    if (status == 0 || run.diagnostics.errors != count) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
    assert_int_not_equal(status, 0);
    assert_int_equal(run.diagnostics.errors, count);
    for (int i = 0; i < count; i++) {
        bool found = false;
        for (size_t k = 0; k < run.diagnostics.count; k++) {
            const Message *m = &run.diagnostics.messages[k];
            found |= m->severity == SEVERITY_ERROR && strstr(m->text, expected[i].text) &&
                     (expected[i].line == 0 || m->source.line == FIRST_LINE + expected[i].line);
        }
        if (!found) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
        if (!found) fail_msg("no error in line %d with '%s'", expected[i].line, expected[i].text);
    }
    verify_free(&run);
    assert_int_equal(memory_in_use(), 0);
}
#define REFUSE(cards, ...)                                                                                             \
    refuse(fabric, cards, (int)(sizeof((Expected[]){__VA_ARGS__}) / sizeof(Expected)), (Expected[]){__VA_ARGS__})

static void bad_references_are_refused_in_one_list(void **state)
{
    (void)state;
    REFUSE("*AIRBAG_REFERENCE_GEOMETRY_ID\n1,1,1,1,98\n1,0,0,0\n99,0,0,0\n7,2,1,0\n"
           "*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,97\n",
           {2, "NIDO = 98"}, {4, "NID = 99"}, {5, "element 3 has no area"}, {7, "node 97"});
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,14\n8,1,12,13,16,15\n2,1,12,13,16,15\n3,1,15,16,17,17\n",
           {3, "EID = 8"});
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,14\n2,1,12,13,16,15\n", {2, "have no reference"});
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,14\n2,1,12,13,16,15\n3,1,15,16,17,13\n",
           {4, "4 different corners"});
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,14,15\n2,1,12,13,16,15\n3,1,15,16,17,17\n", {2, "is inverted"});
}

/* Windings and rotations that the neighbours contradict. */
static void disordered_corners_are_refused(void **state)
{
    (void)state;
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,14\n2,1,13,16,15,12\n3,1,15,16,17,17\n",
           {3, "element 2: N1 to N4 are in another order"});
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,14\n2,1,12,13,16,15\n3,1,16,15,17,17\n",
           {4, "element 3: N1 to N4 are in another order"});
}

/* All shells of the tables alike, which no neighbour contradicts by itself. */
static void common_order_is_checked(void **state)
{
    (void)state;
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,14,15,12,11\n2,1,15,16,13,12\n3,1,17,16,15,15\n",
           {2, "go round the other way"});
    REFUSE("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,12,15,14,11\n2,1,13,16,15,12\n3,1,16,17,15,15\n",
           {2, "begin with others"});
}

static void expect_warning(const char *cards, int line, const char *text)
{
    VerifyRun run;
    build(&run, cards);
    bool found = false;
    for (size_t k = 0; k < run.diagnostics.count; k++) {
        const Message *m = &run.diagnostics.messages[k];
        found |= m->severity == SEVERITY_WARNING && strstr(m->text, text) && m->source.line == FIRST_LINE + line;
    }
    if (!found) diagnostics_print(&run.diagnostics, SEVERITY_NOTE, stderr);
    assert_true(found);
    verify_free(&run);
}

/* Lines that were forgotten or stand twice are legal, and said. */
static void doubtful_tables_are_warned_of(void **state)
{
    (void)state;
    expect_warning(
        "*AIRBAG_REFERENCE_GEOMETRY\n1,0,0,0\n2,1.2,0,0\n3,2.4,0,0\n4,0,1.2,0\n5,1.2,1.2,0\n7,2.4,2.4,0\n", 3,
        "2 elements have some of their nodes here and some not, which keep their place under *NODE: the first "
        "is element 2 with node 6");
    expect_warning("*AIRBAG_SHELL_REFERENCE_GEOMETRY\n1,1,11,12,15,14\n2,1,12,13,16,15\n3,1,15,16,17,17\n"
                   "1,1,1,2,5,4\n",
                   5, "element EID = 1 stands here again with other nodes, which count (line 34)");
}

/* A curve or a material that cannot be does not hide what is wrong with the reference. */
static void other_errors_hide_nothing(void **state)
{
    (void)state;
    refuse("1,6,-1e6,1e6,,.3,.3\n,,,1\n0,,,,,2\n", "*AIRBAG_REFERENCE_GEOMETRY_ID\n1,1,1,1,98\n1,0,0,0\n99,0,0,0\n", 3,
           (Expected[]){{0, "EA = -1e+06"}, {2, "NIDO = 98"}, {4, "NID = 99"}});
}

static void materials_say_what_becomes_of_it(void **state)
{
    (void)state;
    static const char cards[] = "*AIRBAG_REFERENCE_GEOMETRY\n" NODES;
    refuse("1,6,1e6,1e6,,.3,.3\n,,,1\n0,,,,,2,,-44\n", cards, 1, (Expected[]){{0, "TSRFAC = 44"}});
    refuse("1,6,1e6,1e6,,.3,.3\n,,,1\n0,,,,2,2\n", cards, 1, (Expected[]){{0, "LNRC = 2"}});
    refuse("1,6,1e6,1e6,,.3,.3\n,,,0,1e5,.3,.1\n0,,,,1,2\n", cards, 1, (Expected[]){{0, "LNRC = 1"}});
    VerifyRun run;
    assert_int_equal(build_with(&run, "1,6,1e6,1e6,,.3,.3\n,,,1,1e5,.3,.1\n0,,,,1,2,,.01\n", cards), 0);
    assert_true(group_of(&run, 0)->rule.liner_waits && group_of(&run, 0)->rule.restore == RESTORE_BY_CYCLE);
    verify_free(&run);
}

static void program_writes_and_refuses(void **state)
{
    (void)state;
    Program program;
    char deck[8192], text[4096];
    program_open(&program);
    int length = snprintf(deck, sizeof deck, mesh, fabric);
    int head = length += snprintf(deck + length, sizeof deck - (size_t)length, "%s", shells);
    length += snprintf(deck + length, sizeof deck - (size_t)length,
                       "*CONTROL_TIMESTEP\n1e-9\n*AIRBAG_REFERENCE_GEOMETRY_ID\n1,.5,1,1,0,1\n2,1.5,0,0\n5,-0.125,2,0\n"
                       "*AIRBAG_REFERENCE_GEOMETRY\n1,0,0,0\n*END\n");
    program_write(&program, "a.k", deck, (size_t)length);
    assert_int_equal(program_run(&program, "check a.k"), 0);
    assert_non_null(strstr(program.out, "Reference geometry"));
    assert_int_equal(program_run(&program, "run a.k --end-time 1e-7 --quiet"), 0);
    assert_true(program_read(&program, "a.results/AIRBAG_REFERENCE_GEOMETRY.TRANSFORMED", text, sizeof text));
    assert_string_equal(text, "*KEYWORD\n$ block 1 of the deck\n*AIRBAG_REFERENCE_GEOMETRY\n"
                              "       21.5000000000e+000.0000000000e+000.0000000000e+00\n"
                              "       56.8750000000e-012.0000000000e+000.0000000000e+00\n*END\n");
    length =
        head + snprintf(deck + head, sizeof deck - (size_t)head, "*INITIAL_FOAM_REFERENCE_GEOMETRY\n1,0,0,0\n*END\n");
    program_write(&program, "b.k", deck, (size_t)length);
    assert_int_equal(program_run(&program, "run b.k"), 2);
    assert_non_null(strstr(program.err, "*INITIAL_FOAM_REFERENCE_GEOMETRY"));
    length = head + snprintf(deck + head, sizeof deck - (size_t)head,
                             "*AIRBAG_REFERENCE_GEOMETRY\n1,0,0,x\n99,0,0,0\n*DEFINE_CURVE\n7\n0,0\n2,1\n1,2\n*END\n");
    program_write(&program, "c.k", deck, (size_t)length);
    assert_int_equal(program_run(&program, "run c.k"), 2);
    assert_non_null(strstr(program.err, "c.k:34: error: *AIRBAG_REFERENCE_GEOMETRY"));
    assert_non_null(strstr(program.err, "c.k:35: error: *AIRBAG_REFERENCE_GEOMETRY: node NID = 99"));
    assert_non_null(strstr(program.err, "c.k:40: error: *DEFINE_CURVE"));
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_come_in_any_order),      cmocka_unit_test(scale_acts_about_its_origin),
        cmocka_unit_test(births_follow_the_manual),       cmocka_unit_test(bad_references_are_refused_in_one_list),
        cmocka_unit_test(disordered_corners_are_refused), cmocka_unit_test(materials_say_what_becomes_of_it),
        cmocka_unit_test(program_writes_and_refuses),     cmocka_unit_test(common_order_is_checked),
        cmocka_unit_test(doubtful_tables_are_warned_of),  cmocka_unit_test(other_errors_hide_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
