/* *INCLUDE_TRANSFORM and *DEFINE_TRANSFORMATION: ids, units and places of included nodes. */
#include "tests/deck_folder.h"

#include <math.h>

#include "io/include_transform.h"
#include "solver/memory.h"

static const char transform_cards[] = "       100       200       300       400       500       600       700\n"
                                      "       800\n"
                                      "       2.0       0.5      10.0      FtoC\n";

static void ids_and_units_are_transformed(void **state)
{
    (void)state;
    char text[500];
    snprintf(text, sizeof text, "*KEYWORD\n*INCLUDE_TRANSFORM\nunits.k\n%s\n*A\n", transform_cards);
    write_file("transform.k", text);
    write_file("units.k", "*A\n        -5         7        50\n");
    DeckCase c = load_file("transform.k");
    assert_no_messages(&c);
    static const struct {
        FieldScale scale;
        double value, expected;
    } cases[] = {
        {SCALE_NONE, 5, 5},
        {SCALE_ID_NODE, 5, 105},
        {SCALE_ID_ELEMENT, 5, 205},
        {SCALE_ID_PART, 5, 305},
        {SCALE_ID_MATERIAL, 5, 405},
        {SCALE_ID_SET, 5, 505},
        {SCALE_ID_FUNCTION, 5, 605},
        {SCALE_ID_DEFINE, 5, 705},
        {SCALE_ID_OTHER, 5, 805},
        {SCALE_ID_NODE, 0, 0},
        {SCALE_ID_FUNCTION, -5, -605},
        {SCALE_LENGTH, 1, 10},
        {SCALE_TIME, 1, 0.5},
        {SCALE_MASS, 1, 2},
        {SCALE_DENSITY, 1, 2e-3},
        {SCALE_PRESSURE, 1, 0.8},
        {SCALE_VELOCITY, 1, 20},
        {SCALE_ACCELERATION, 1, 40},
        {SCALE_FORCE, 1, 80},
        {SCALE_AREA, 1, 100},
        {SCALE_VOLUME, 1, 1000},
        {SCALE_RATE, 1, 2},
        {SCALE_TEMPERATURE, 212, 100},
        {SCALE_MASS_FLOW, 1, 4},
    };
    const IncludeTransform *transform = c.deck.blocks.items[0].transform;
    assert_non_null(transform);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = include_transform_scale(transform, cases[i].scale, cases[i].value);
        assert_true(fabs(value - cases[i].expected) <= 1e-12 * fabs(cases[i].expected));
        assert_true(include_transform_scale(NULL, cases[i].scale, cases[i].value) == cases[i].value);
    }
    /* and through the card reader, defaults excepted */
    static const FieldSpec fields[] = {
        {.name = "LC", .type = 'I', .columns = 10, .offset = offsetof(Record, id), .scale = SCALE_ID_FUNCTION},
        {.name = "L", .type = 'F', .columns = 10, .offset = offsetof(Record, a), .scale = SCALE_LENGTH},
        {.name = "T", .type = 'F', .columns = 10, .offset = offsetof(Record, b), .scale = SCALE_TEMPERATURE},
        {.name = "D", .type = 'F', .columns = 10, .offset = offsetof(Record, c), .scale = SCALE_TIME, .fallback = 1e20},
    };
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_true(r.id == -605 && r.a == 70 && fabs(r.b - 10) < 1e-12 && r.c == 1e20);
    assert_null(c.deck.blocks.items[1].transform);
    close_case(&c);
}

static void offsets_beyond_int_are_errors(void **state)
{
    (void)state;
    write_file("offset.k", "*KEYWORD\n*INCLUDE_TRANSFORM\noffset1.k\n2147483000\n\n\n\n");
    write_file("offset1.k", "*INCLUDE_TRANSFORM\noffset2.k\n2147483000\n\n\n\n*A\n      1000\n");
    write_file("offset2.k", "*A\n         1\n");
    DeckCase c = load_file("offset.k");
    assert_no_messages(&c);
    static const FieldSpec field = {
        .name = "N", .type = 'I', .columns = 10, .offset = offsetof(Record, id), .scale = SCALE_ID_NODE};
    for (size_t i = 0; i < 2; i++) {
        CardReader reader = open_block(&c, i);
        Record r;
        assert_int_equal(card_read(&reader, &field, 1, &r, true, "card 1", NULL), -1);
    }
    assert_int_equal(c.diagnostics.errors, 2);
    assert_non_null(strstr(c.diagnostics.messages[0].text, "offset of *INCLUDE_TRANSFORM"));
    close_case(&c);
}

/* Where the transformation of these rows takes (x, y, z). */
static void transform_point(const char *rows, double x[3])
{
    char text[1500];
    snprintf(
        text, sizeof text,
        "*KEYWORD\n*NODE\n      11             1.0             0.0             0.0\n      12,0.,3.,0.\n13,0.,0.,2.\n"
        "21,5.,5.,5.\n22,5.,6.,5.\n23,4.,5.,5.\n*DEFINE_TRANSFORMATION\n         7\n%s\n"
        "*INCLUDE_TRANSFORM\nleaf.k\n\n\n\n         7\n",
        rows);
    write_file("rows.k", text);
    write_file("leaf.k", "*LEAF\n");
    DeckCase c = load_file("rows.k");
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 2);
    include_transform_point(c.deck.blocks.items[1].transform, x);
    close_case(&c);
}

static void assert_moved(const char *rows, double x, double y, double z, double tx, double ty, double tz)
{
    double p[3] = {x, y, z};
    transform_point(rows, p);
    bool fine = fabs(p[0] - tx) < 1e-14 && fabs(p[1] - ty) < 1e-14 && fabs(p[2] - tz) < 1e-14;
    if (!fine) print_error("%s\ngives %.17g %.17g %.17g\n", rows, p[0], p[1], p[2]);
    assert_true(fine);
}

static void rows_of_transformations(void **state)
{
    (void)state;
    assert_moved("TRANSL           1.0       2.0       3.0", 1, 1, 1, 2, 3, 4);
    assert_moved("transl,1.,2.,3.", 1, 1, 1, 2, 3, 4);
    assert_moved("SCALE            2.0       0.0       3.0", 1, 1, 1, 2, 1, 3);
    /* the rows act one after the other on what the rows before have made */
    assert_moved("SCALE,2.,2.,2.\nTRANSL,1.,0.,0.", 1, 1, 1, 3, 2, 2);
    assert_moved("TRANSL,1.,0.,0.\nSCALE,2.,2.,2.", 1, 1, 1, 4, 2, 2);
    assert_moved("ROTATE,0.,0.,1.,0.,0.,0.,90.", 1, 0, 5, 0, 1, 5);
    assert_moved("ROTATE,0.,0.,5.,1.,0.,0.,90.", 2, 0, 0, 1, 1, 0);
    assert_moved("ROTATE,0.,0.,1.,0.,0.,0.,-450.", 1, 0, 0, 0, -1, 0);
    assert_moved("ROTATE,0.,0.,1.,0.,0.,0.,30.", 1, 0, 0, sqrt(0.75), 0.5, 0);
    assert_moved("ROTATE,1.,1.,1.,0.,0.,0.,120.", 1, 2, 3, 3, 1, 2);
    assert_moved("ROTATE,0.,0.,1.", 1, 2, 3, 1, 2, 3);
    assert_moved("POINT,1,1.,0.,0.\nPOINT,2,1.,0.,4.\nROTATE,1,2,90.", 2, 0, 0, 1, 1, 0);
    assert_moved("MIRROR,1.,0.,0.,2.,0.,0.", 3, 4, 5, -1, 4, 5);
    assert_moved("POINT,1,1.,0.,0.\nPOINT,2,2.,0.,0.\nPOINT,3,1.,1.,0.\nPOINT,4,5.,5.,5.\nPOINT,5,5.,9.,5.\n"
                 "POINT,6,3.,5.,5.\nPOS6P,1,2,3,4,5,6",
                 2, 3, 4, 2, 6, 9);
    assert_moved("POS6N,11,12,13,11,12,13", 1, 2, 3, 1, 2, 3);
    assert_moved("TRANSL2ND,21,22,3.5", 1, 1, 1, 1, 4.5, 1);
    assert_moved("ROTATE3NA,21,22,21,90.", 6, 5, 5, 5, 5, 4);
}

static void assert_bad_rows(const char *rows, const char *part)
{
    char text[500];
    snprintf(text, sizeof text, "*KEYWORD\n*DEFINE_TRANSFORMATION\n         7\n%s\n*A\n", rows);
    DeckCase c = load_string(text);
    assert_only_message(&c, SEVERITY_ERROR, ANY_LINE, part);
    close_case(&c);
}

static void wrong_transformations_are_reported(void **state)
{
    (void)state;
    assert_bad_rows("TWIST,1.", "TWIST: unknown option");
    assert_bad_rows("ROTATE,0.,0.,0.,0.,0.,0.,90.", "the axis has no direction");
    assert_bad_rows("POINT,1,0.,0.,0.\nROTATE,1,2,90.", "must be POINTs defined above");
    assert_bad_rows("MIRROR,1.,1.,1.,1.,1.,1.", "normal");
    assert_bad_rows("POINT,1,0.,0.,0.\nPOS6P,1,1,1,1,1,1", "lie on one line");
    assert_bad_rows("POS6P,1,2,3,4,5,6", "must be POINTs defined above");
    assert_bad_rows("TRANSL2ND,1,2,5.", "there is no node 1 yet");
    assert_bad_rows("POINT,0,1.,1.,1.", "A1 must be the point's id");
    assert_bad_rows("TRANSL,x", "'x' is not a number");
    DeckCase c = load_string("*KEYWORD\n*DEFINE_TRANSFORMATION\n         0\n");
    assert_only_message(&c, SEVERITY_ERROR, 3, "TRANID must be positive");
    close_case(&c);
    c = load_string("*KEYWORD\n*DEFINE_TRANSFORMATION_TITLE\ntitle\n7\n*DEFINE_TRANSFORMATION\n7\n");
    assert_only_message(&c, SEVERITY_ERROR, 6, "defined on line 4 already");
    close_case(&c);
    write_file("leaf.k", "*LEAF\n");
    assert_bad_include("*KEYWORD\n*INCLUDE_TRANSFORM\nleaf.k\n\n\n\n9\n", 7, "TRANID 9 is not defined");
    assert_bad_include("*KEYWORD\n*INCLUDE_TRANSFORM\nleaf.k\n\n\n-1.0\n\n", 6, "must be positive");
    assert_bad_include("*KEYWORD\n*INCLUDE_TRANSFORM\nleaf.k\n\n\n,,,CtoX\n\n", 6, "must be one of FtoC");
}

static void nested_transforms_multiply(void **state)
{
    (void)state;
    write_file("outer.k", "*KEYWORD\n*DEFINE_TRANSFORMATION\n1\nROTATE,0.,0.,1.,0.,0.,0.,90.\nTRANSL,0.,0.,7.\n"
                          "*INCLUDE_TRANSFORM\ninner.k\n1000,0,0,0,0,0,10\n\n,,1000.,CtoK\n1\n");
    write_file("inner.k",
               "*DEFINE_TRANSFORMATION\n1\nTRANSL,1.,0.,0.\n*INCLUDE_TRANSFORM\nleaf.k\n2000\n\n2.,,0.1,FtoC\n1\n");
    write_file("leaf.k", "*LEAF\n");
    DeckCase c = load_file("outer.k");
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 1);
    const IncludeTransform *t = c.deck.blocks.items[0].transform;
    assert_int_equal(t->idnoff, 3000);
    assert_true(t->fctmas == 2 && t->fctlen == 100 && t->fcttim == 1);
    /* leaf (10, 0, 0) is (1, 0, 0) for inner.k, moved to (2, 0, 0); 2000 long for outer.k, turned to y, lifted */
    double x[3] = {10 * t->fctlen, 0, 0};
    include_transform_point(t, x);
    assert_true(fabs(x[0]) < 1e-9 && fabs(x[1] - 2000) < 1e-9 && fabs(x[2] - 7) < 1e-9);
    assert_true(fabs(include_transform_scale(t, SCALE_TEMPERATURE, 50) - 283.15) < 1e-12);
    close_case(&c);
}

static void lack_of_memory_in_includes(void **state)
{
    (void)state;
    size_t before = memory_in_use();
    for (long k = 1; k < 80; k++) {
        memory_fail_after(k);
        DeckCase c = load_file("outer.k");
        memory_fail_after(0);
        close_case(&c);
        assert_int_equal(memory_in_use(), before);
    }
}

/* Rows by nodes: the main deck sees included nodes moved and renumbered, an included file its own as written. */
static void nodes_of_included_files(void **state)
{
    (void)state;
    write_file("nodes.k", "*NODE\n1,0.,0.,0.\n2,2.,0.,0.\n*DEFINE_TRANSFORMATION\n1\nTRANSL2ND,1,2,1.\n"
                          "*INCLUDE_TRANSFORM\nleaf.k\n\n\n\n1\n");
    write_file("leaf.k", "*LEAF\n");
    write_file("turned.k", "*KEYWORD\n*DEFINE_TRANSFORMATION\n9\nROTATE,0.,0.,1.,0.,0.,0.,90.\n"
                           "*INCLUDE_TRANSFORM\nnodes.k\n100,0,0,0,0,0,50\n\n,,10.\n9\n"
                           "*DEFINE_TRANSFORMATION\n2\nTRANSL2ND,101,102,1.\n"
                           "*INCLUDE_TRANSFORM\nleaf.k\n\n\n\n2\n"
                           "*DEFINE_TRANSFORMATION\n3\nTRANSL2ND,1,2,1.\n");
    DeckCase c = load_file("turned.k");
    assert_only_message(&c, SEVERITY_ERROR, 22, "there is no node 1 yet");
    assert_int_equal(c.deck.blocks.count, 3);
    double inner[3] = {0, 0, 0}, outer[3] = {0, 0, 0};
    include_transform_point(c.deck.blocks.items[1].transform, inner);
    include_transform_point(c.deck.blocks.items[2].transform, outer);
    assert_true(fabs(inner[0]) < 1e-14 && fabs(inner[1] - 10) < 1e-14); /* one unit along x of nodes.k */
    assert_true(fabs(outer[0]) < 1e-14 && fabs(outer[1] - 1) < 1e-14);  /* one unit along the turned line */
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ids_and_units_are_transformed), cmocka_unit_test(offsets_beyond_int_are_errors),
        cmocka_unit_test(rows_of_transformations),       cmocka_unit_test(wrong_transformations_are_reported),
        cmocka_unit_test(nested_transforms_multiply),    cmocka_unit_test(lack_of_memory_in_includes),
        cmocka_unit_test(nodes_of_included_files),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
