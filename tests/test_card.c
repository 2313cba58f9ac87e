/* Cards read through their tables: fields, defaults, formats, and the messages about what is wrong. */
#include "tests/deck_case.h"

static void fields_may_touch(void **state)
{
    (void)state;
    Record r;
    DeckCase c = load_string("*KEYWORD\n*A\n       0.1         17.86000E-7\n");
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_no_messages(&c);
    assert_true(r.a == 0.1 && r.id == 1 && r.b == 7.86e-7);
    close_case(&c);
    c = load_string("*KEYWORD\n*A\n-1.0000+04-123456789-1.500E-03\n");
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_no_messages(&c);
    assert_true(r.a == -1e4 && r.id == -123456789 && r.b == -1.5e-3);
    close_case(&c);
}

static void blank_fields_take_their_defaults(void **state)
{
    (void)state;
    static const FieldSpec fields[] = {
        {.name = "A", .type = 'F', .columns = 10, .offset = offsetof(Record, a), .fallback = 2.5},
        {.name = "B",
         .type = 'F',
         .columns = 10,
         .offset = offsetof(Record, b),
         .fallback = 7,
         .zero_is_default = true},
        {.name = "ID", .type = 'I', .columns = 10, .offset = offsetof(Record, id), .fallback = 3},
        {.name = "T", .type = 'A', .columns = 10, .offset = offsetof(Record, text)},
    };
    DeckCase c = load_string("*KEYWORD\n*A\n\n       0.0       0.0         0 some\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_true(r.a == 2.5 && r.b == 7 && r.id == 3);
    assert_string_equal(r.text, "");
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 2", NULL), 0);
    assert_true(r.a == 0 && r.b == 7 && r.id == 0);
    assert_string_equal(r.text, "some");
    assert_false(card_left(&reader));
    assert_int_equal(card_read(&reader, fields, 4, &r, false, "card 3", NULL), -1);
    assert_true(r.a == 2.5 && r.b == 7 && r.id == 3);
    assert_no_messages(&c);
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 3", NULL), -1);
    assert_only_message(&c, SEVERITY_ERROR, 4, "card 3 is missing; a line with A, B, ID, T must follow here");
    close_case(&c);
}

static void comma_format(void **state)
{
    (void)state;
    static const FieldSpec fields[] = {
        RECORD_FIELD("A", 'F', 10, a),
        RECORD_FIELD("ID", 'I', 8, id),
        {.name = "B", .type = 'F', .columns = 10, .offset = offsetof(Record, b), .fallback = 9},
        RECORD_FIELD("C", 'F', 16, c),
        RECORD_FIELD("T", 'A', 70, text),
    };
    DeckCase c = load_string("*KEYWORD\n*A\n1.25, 1234567890,,1.5-3,a title, with a comma \n2,3\n"
                             "       1.0       2       3.0             4.0 a title, with a comma\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, fields, 5, &r, true, "card 1", NULL), 0);
    assert_true(r.a == 1.25 && r.id == 1234567890 && r.b == 9 && r.c == 1.5e-3);
    assert_string_equal(r.text, "a title, with a comma");
    assert_int_equal(card_read(&reader, fields, 5, &r, true, "card 1", NULL), 0);
    assert_true(r.a == 2 && r.id == 3 && r.b == 9 && r.c == 0);
    assert_string_equal(r.text, "");
    assert_int_equal(card_read(&reader, fields, 5, &r, true, "card 1", NULL), 0);
    assert_true(r.a == 1 && r.id == 2 && r.b == 3 && r.c == 4);
    assert_string_equal(r.text, "a title, with a comma");
    assert_no_messages(&c);
    close_case(&c);
}

/* One bad line gives one message with place, field, columns and what was read. */
static void assert_bad_card(const char *line, const char *part)
{
    char deck[400];
    snprintf(deck, sizeof deck, "*KEYWORD\n*A\n$\n%s\n", line);
    DeckCase c = load_string(deck);
    Record r;
    assert_int_equal(read_mixed(&c, &r), -1);
    assert_only_message(&c, SEVERITY_ERROR, 4, part);
    assert_string_equal(c.diagnostics.messages[0].keyword, "*A");
    close_case(&c);
}

static void wrong_values_are_reported(void **state)
{
    (void)state;
    assert_bad_card("       1.0       1.5       2.0", "card 1: ID (columns 11-20): '1.5' is not a whole number");
    assert_bad_card("       1.0       1e5      2..0", "B (columns 21-30): '2..0' is not a number");
    assert_bad_card("   1.0 2.0         1       2.0", "A (columns 1-10): '1.0 2.0' is more than one value");
    assert_bad_card("       1.0      MECH       2.0", "'MECH' is not a number");
    assert_bad_card("     1e999         1       2.0", "'1e999' is too large");
    assert_bad_card("       1.02147483648       2.0", "ID (columns 11-20): '2147483648' is beyond the largest");
    assert_bad_card("1.0,x,2.0", "ID (value 2): 'x' is not a number");
    assert_bad_card("     *NODE         1       2.0", "a keyword's star must stand in column 1");
    assert_bad_card("       inf         1       2.0", "'inf' is not a number");
    assert_bad_card("       1.0       &no       2.0", "'&no' cannot be evaluated");
    /* one message a line: the rest is its echo */
    assert_bad_card("         a         b         c", "A (columns 1-10): 'a' is not a number");
}

static void whole_reals_are_integers(void **state)
{
    (void)state;
    static const char *const lines[] = {"       1.0     100.0", "1,1e2,", "         1      +100",
                                        "         1  1000.-1"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char deck[100];
        snprintf(deck, sizeof deck, "*KEYWORD\n*A\n%s\n", lines[i]);
        DeckCase c = load_string(deck);
        Record r;
        assert_int_equal(read_mixed(&c, &r), 0);
        assert_true(r.a == 1 && r.id == 100);
        close_case(&c);
    }
}

static void numbers_across_two_fields(void **state)
{
    (void)state;
    assert_bad_card("       1.0       123456       2.0", "'123456");
    assert_bad_card("         12.5", "card 1: A (columns 10-13): '12.5' reaches across the border of two fields");
    assert_bad_card("                   12", "ID (columns 20-21): '12' reaches across");
    assert_bad_card("                           1.2345", "B (columns 28-33): '1.2345' reaches across");
    /* flush left throughout, a full field, or a sign: no slip */
    static const char *const fine[] = {"       1.02         3.0       ", "         17.86000E-7", "         1-2.5",
                                       "1.0000000012345678903.0", "1.23456789 "};
    for (size_t i = 0; i < sizeof fine / sizeof *fine; i++) {
        char deck[100];
        snprintf(deck, sizeof deck, "*KEYWORD\n*A\n%s\n", fine[i]);
        DeckCase c = load_string(deck);
        CardReader reader = open_block(&c, 0);
        static const FieldSpec reals[] = {RECORD_FIELD("A", 'F', 10, a), RECORD_FIELD("B", 'F', 10, b),
                                          RECORD_FIELD("C", 'F', 10, c)};
        Record r;
        assert_int_equal(card_read(&reader, reals, 3, &r, true, "card 1", NULL), 0);
        assert_no_messages(&c);
        close_case(&c);
    }
}

static void unused_fields_are_listed_once(void **state)
{
    (void)state;
    static const FieldSpec fields[] = {
        RECORD_FIELD("ID", 'I', 10, id),
        {.name = "L", .type = 'F', .columns = 10, .offset = offsetof(Record, a), .use = FIELD_LISTED},
        {.name = "T", .type = 'A', .columns = 10, .offset = offsetof(Record, text), .use = FIELD_LISTED},
        {.name = "R",
         .type = 'F',
         .columns = 10,
         .offset = offsetof(Record, b),
         .use = FIELD_REFUSED,
         .fallback = 1,
         .zero_is_default = true},
    };
    DeckCase c =
        load_string("*KEYWORD\n*A\n         1       0.0         0       0.0\n         1       2.0\n"
                    "         1       3.0\n*B\n         1       4.0\n         1                           2.5\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_no_messages(&c);
    assert_true(r.b == 1);
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_only_message(&c, SEVERITY_NOTE, 4, "card 1: L (columns 11-20) = 2.0 is read but not used");
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_int_equal(c.diagnostics.count, 1);
    reader = open_block(&c, 1);
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_int_equal(c.diagnostics.count, 2);
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), -1);
    assert_int_equal(c.diagnostics.errors, 1);
    assert_non_null(
        strstr(c.diagnostics.messages[2].text, "R (columns 31-40) = 2.5 asks for what billow does not have"));
    close_case(&c);
}

static void surplus_text_is_mentioned(void **state)
{
    (void)state;
    Record r;
    DeckCase c = load_string("*KEYWORD\n*A\n         1         2       3.0         0       0.0      four\n");
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_only_message(&c, SEVERITY_NOTE, 3, "the text (columns 51-60) 'four' belongs to no field");
    close_case(&c);
    c = load_string("*KEYWORD\n*A\n         1         2       3.0                                                  x\n"
                    "1,2,3,,0\n");
    assert_int_equal(read_mixed(&c, &r), 0);
    assert_no_messages(&c);
    close_case(&c);
}

static void texts_are_cut_to_their_room(void **state)
{
    (void)state;
    static const FieldSpec fields[] = {RECORD_FIELD("ID", 'I', 10, id), RECORD_FIELD("T", 'A', 4, text),
                                       RECORD_FIELD("OTHER", 'I', 6, other)};
    DeckCase c = load_string("*KEYWORD\n*A+\n                   1            longtext                   7\n");
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_int_equal(card_read(&reader, fields, 3, &r, true, "card 1", NULL), 0);
    assert_string_equal(r.text, "long");
    assert_int_equal(r.other, 7);
    close_case(&c);
}

static void title_cards(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*TITLE\n  a title, with 3.0 things   \nsecond\n");
    CardReader reader = open_block(&c, 0);
    char title[10];
    assert_string_equal(card_peek(&reader)->text, "  a title, with 3.0 things   ");
    assert_true(card_text(&reader, title, sizeof title));
    assert_string_equal(title, "  a title");
    assert_true(card_skip(&reader));
    assert_false(card_skip(&reader));
    assert_false(card_text(&reader, title, sizeof title));
    assert_string_equal(title, "");
    assert_null(card_peek(&reader));
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_may_touch),
        cmocka_unit_test(blank_fields_take_their_defaults),
        cmocka_unit_test(comma_format),
        cmocka_unit_test(wrong_values_are_reported),
        cmocka_unit_test(whole_reals_are_integers),
        cmocka_unit_test(numbers_across_two_fields),
        cmocka_unit_test(unused_fields_are_listed_once),
        cmocka_unit_test(surplus_text_is_mentioned),
        cmocka_unit_test(texts_are_cut_to_their_room),
        cmocka_unit_test(title_cards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
