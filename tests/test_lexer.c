/* The lexical rules of decks: lines, blocks, formats, fields and numbers. */
#include "tests/deck_case.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "io/number.h"
#include "solver/memory.h"

static double parsed(const char *text)
{
    double value = 12345.678;
    if (number_parse(text, strlen(text), &value) != NUMBER_FINE) print_error("'%s'\n", text);
    assert_int_equal(number_parse(text, strlen(text), &value), NUMBER_FINE);
    return value;
}

static void numbers_in_every_spelling(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"0", 0},           {"1", 1},          {"+1", 1},          {"-7", -7},       {"5.", 5},
        {".5", 0.5},        {"-.5", -0.5},     {"1.5-3", 1.5e-3},  {"1.5+3", 1500},  {"1.5D-3", 1.5e-3},
        {"1.5d3", 1500},    {"1e5", 1e5},      {"1E+05", 1e5},     {"17.86000E-7", 17.86e-7},
        {"1.00000E20", 1e20}, {"-1-1", -0.1},  {"00012", 12},      {"1e-400", 0},    {"0e99999999999", 0},
        {"123456789012345678", 123456789012345678.0}, {"0.1", 0.1},
        {"-2.2250738585072014E-308", -DBL_MIN}, {"1.7976931348623157E308", DBL_MAX},
        {"3.14159265358979323846264338327950288", 3.14159265358979323846},
        {"1000000000000000000000000000000", 1e30}, {"9007199254740993", 9007199254740992.0},
        {"10.00000000000000000", 10}, {"0.000000000000000000000000000001", 1e-30},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = parsed(cases[i].text);
        if (value != cases[i].value) print_error("'%s' gives %.17g\n", cases[i].text, value);
        assert_true(value == cases[i].value);
    }
}

static void what_is_no_number(void **state)
{
    (void)state;
    static const char *const cases[] = {"",    "-",   "+",    ".",    "e5",  "1e",   "1e+",  "1.2.3", "1 2",  "0x10", "nan",
                                        "inf", "1-",  "1+-2", "--1",  "1,2", "1e5.", "12a",  "1e5e5", "MECH", "&a",   "1..",
                                        "- 1", "1d ", "\x80"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value;
        NumberStatus status = number_parse(cases[i], strlen(cases[i]), &value);
        if (status != NUMBER_MALFORMED) print_error("'%s' is accepted\n", cases[i]);
        assert_int_equal(status, NUMBER_MALFORMED);
    }
    double value;
    assert_int_equal(number_parse("1e400", 5, &value), NUMBER_TOO_LARGE);
    assert_int_equal(number_parse("-9.9+9999", 9, &value), NUMBER_TOO_LARGE);
    char digits[2000];
    memset(digits, '1', sizeof digits);
    assert_int_equal(number_parse(digits, sizeof digits, &value), NUMBER_MALFORMED);
    assert_int_equal(number_parse(digits, 350, &value), NUMBER_TOO_LARGE);
}

/* The fast path must round as strtod does. */
static void numbers_are_rounded_correctly(void **state)
{
    (void)state;
    srand(7);
    for (int i = 0; i < 20000; i++) {
        char text[64];
        double value = ((double)rand() / RAND_MAX - 0.5) * pow(10, rand() % 40 - 20);
        snprintf(text, sizeof text, "%.*e", rand() % 18, value);
        assert_true(parsed(text) == strtod(text, NULL));
        snprintf(text, sizeof text, "%.*f", rand() % 12, value);
        assert_true(parsed(text) == strtod(text, NULL));
    }
}

static void blocks_and_their_lines(void **state)
{
    (void)state;
    DeckCase c = load_string("$ comment first\n"
                             "*KEYWORD 123456 NCPU=2\n"
                             "*Node   trailing text\n"
                             "$ a comment\n"
                             "one\n"
                             "\n"
                             " $ not a comment\n"
                             "*mat_Fabric_TITLE\n"
                             "*END\n"
                             "*NODE\n"
                             "after the end\n");
    assert_int_equal(c.status, 0);
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 2);
    const DeckBlock *node = &c.deck.blocks.items[0];
    assert_string_equal(node->keyword, "*NODE");
    assert_int_equal(node->source.line, 3);
    assert_int_equal(node->line_count, 3);
    assert_string_equal(node->lines[0].text, "one");
    assert_int_equal(node->lines[0].source.line, 5);
    assert_string_equal(node->lines[1].text, "");
    assert_string_equal(node->lines[2].text, " $ not a comment");
    assert_string_equal(c.deck.blocks.items[1].keyword, "*MAT_FABRIC_TITLE");
    assert_int_equal(c.deck.blocks.items[1].line_count, 0);
    assert_true(c.deck.blocks.items[0].order < c.deck.blocks.items[1].order);
    close_case(&c);
}

static void line_ends_of_all_systems(void **state)
{
    (void)state;
    static const char *const decks[] = {"*KEYWORD\n*A\nx\n\ny", "*KEYWORD\r\n*A\r\nx\r\n\r\ny\r\n", "*KEYWORD\r*A\rx\r\ry\r",
                                        "\xef\xbb\xbf*KEYWORD\n*A\r\nx\r\r\ny\x1a", "*KEYWORD\n*A\nx\n\ny\n*END"};
    for (size_t i = 0; i < sizeof decks / sizeof *decks; i++) {
        DeckCase c = load_string(decks[i]);
        assert_no_messages(&c);
        assert_int_equal(c.deck.blocks.count, 1);
        const DeckBlock *block = &c.deck.blocks.items[0];
        assert_string_equal(block->keyword, "*A");
        assert_int_equal(block->line_count, 3);
        assert_string_equal(block->lines[0].text, "x");
        assert_string_equal(block->lines[1].text, "");
        assert_string_equal(block->lines[2].text, "y");
        assert_int_equal(block->lines[2].source.line, 5);
        close_case(&c);
    }
}

static void tabs_go_to_multiples_of_eight(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*A\n1\t2\n\t\tx\n12345678\ty\n");
    const DeckBlock *block = &c.deck.blocks.items[0];
    assert_string_equal(block->lines[0].text, "1       2");
    assert_string_equal(block->lines[1].text, "                x");
    assert_string_equal(block->lines[2].text, "12345678        y");
    close_case(&c);
}

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
        {.name = "B", .type = 'F', .columns = 10, .offset = offsetof(Record, b), .fallback = 7, .zero_is_default = true},
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

/* A card of 8, 16, 10 columns and a long text, in every format. */
static void assert_layout(const char *head, const char *keyword, const char *line)
{
    static const FieldSpec fields[] = {RECORD_FIELD("ID", 'I', 8, id), RECORD_FIELD("A", 'F', 16, a),
                                       RECORD_FIELD("B", 'F', 10, b), RECORD_FIELD("T", 'A', 30, text)};
    char deck[600];
    snprintf(deck, sizeof deck, "%s\n%s\n%s\n", head, keyword, line);
    DeckCase c = load_string(deck);
    CardReader reader = open_block(&c, 0);
    Record r;
    assert_string_equal(reader.block->keyword, "*NODE");
    assert_int_equal(card_read(&reader, fields, 4, &r, true, "card 1", NULL), 0);
    assert_no_messages(&c);
    assert_true(r.id == 1234 && r.a == -1.5 && r.b == 2.5);
    assert_string_equal(r.text, "text");
    close_case(&c);
}

static void formats_of_deck_and_keyword(void **state)
{
    (void)state;
    char standard[200], wide[200], ten[200];
    snprintf(standard, sizeof standard, "%8d%16.3f%10.3f text", 1234, -1.5, 2.5);
    snprintf(wide, sizeof wide, "%20d%20.3f%20.3f text", 1234, -1.5, 2.5);
    snprintf(ten, sizeof ten, "%10d%16.3f%10.3f text", 1234, -1.5, 2.5);
    assert_layout("*KEYWORD", "*NODE", standard);
    assert_layout("*KEYWORD LONG=S", "*NODE", standard);
    assert_layout("*KEYWORD LONG=Y", "*NODE", wide);
    assert_layout("*keyword  long=k", "*NODE", wide);
    assert_layout("*KEYWORD", "*NODE+", wide);
    assert_layout("*KEYWORD", "*NODE +", wide);
    assert_layout("*KEYWORD LONG=Y", "*NODE-", standard);
    assert_layout("*KEYWORD LONG=Y", "*NODE -  text", standard);
    assert_layout("*KEYWORD", "*NODE%", ten);
    assert_layout("*KEYWORD", "*NODE %", ten);
    assert_layout("*KEYWORD LONG=Y", "*NODE%", ten);
    assert_layout("*KEYWORD I10=Y", "*NODE", ten);
    assert_layout("*KEYWORD I10=Y", "*NODE-", standard);
    DeckCase c = load_string("*KEYWORD LONG=X\n*NODE\n");
    assert_only_message(&c, SEVERITY_ERROR, 1, "LONG=");
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
    static const char *const lines[] = {"       1.0     100.0", "1,1e2,", "         1      +100", "         1  1000.-1"};
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
        {.name = "R", .type = 'F', .columns = 10, .offset = offsetof(Record, b), .use = FIELD_REFUSED, .fallback = 1,
         .zero_is_default = true},
    };
    DeckCase c = load_string("*KEYWORD\n*A\n         1       0.0         0       0.0\n         1       2.0\n"
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
    assert_non_null(strstr(c.diagnostics.messages[2].text, "R (columns 31-40) = 2.5 asks for what billow does not have"));
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

/* What is no deck gives one message and no blocks. */
static void assert_no_deck(const char *text, size_t length, int line, const char *part)
{
    DeckCase c = load_bytes(text, length);
    assert_int_equal(c.status, -1);
    assert_only_message(&c, SEVERITY_ERROR, line, part);
    assert_int_equal(c.deck.blocks.count, 0);
    close_case(&c);
}

static void files_that_are_no_decks(void **state)
{
    (void)state;
    assert_no_deck("", 0, 1, "the file is empty");
    assert_no_deck("\n\n", 2, 1, "no keyword in the file");
    assert_no_deck("$ only a comment\n", 17, 1, "no keyword in the file");
    assert_no_deck("\nhello\nworld\n", 13, 2, "data before the first keyword");
    assert_no_deck("*KEYWORD\n*NODE\n1,2\0,3\n", 22, 3, "zero byte");
    assert_no_deck("*KEYWORD\n*NODE\n1,2\x01,3\n", 22, 3, "control characters");
    assert_no_deck("\xff\xfe*\0K\0", 6, 1, "UTF-16");
    srand(3);
    char noise[5000];
    for (int round = 0; round < 20; round++) {
        for (size_t i = 0; i < sizeof noise; i++) noise[i] = (char)rand();
        noise[100] = '\0';
        assert_no_deck(noise, sizeof noise, ANY_LINE, "zero byte");
    }
}

static void odd_keywords(void **state)
{
    (void)state;
    DeckCase c = load_string("*KEYWORD\n*\n1,2\n*NODE\n");
    assert_only_message(&c, SEVERITY_ERROR, 2, "the keyword's name is missing");
    assert_int_equal(c.deck.blocks.count, 1);
    close_case(&c);
    char deck[300] = "*KEYWORD\n*";
    memset(deck + strlen(deck), 'A', 200);
    c = load_string(deck);
    assert_only_message(&c, SEVERITY_ERROR, 2, "longer than any");
    close_case(&c);
    c = load_string("data\n*KEYWORD\n*NODE\n");
    assert_only_message(&c, SEVERITY_ERROR, 1, "data before the first keyword");
    close_case(&c);
    c = load_string("*KEYWORD\n*COMMENT\nany text\n*NODE\n*COMMENT\n");
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 1);
    close_case(&c);
}

static void huge_lines_are_refused(void **state)
{
    (void)state;
    size_t length = 3000000;
    char *deck = memory_alloc(length + 1, 1);
    assert_non_null(deck);
    memset(deck, '1', length);
    memcpy(deck, "*KEYWORD\n*A\n", 12);
    DeckCase c = load_bytes(deck, length);
    assert_only_message(&c, SEVERITY_ERROR, 3, "characters, more than the 10000");
    close_case(&c);
    memset(deck + 12, '\t', length - 12);
    c = load_bytes(deck, length);
    assert_only_message(&c, SEVERITY_ERROR, 3, "characters, more than the 10000");
    close_case(&c);
    memory_free(deck);
}

/* A million lines within a few seconds even on a busy machine, and old Macintosh line ends no slower. */
static void a_million_lines_load_quickly(void **state)
{
    (void)state;
    static const char card[] = "       1  1.00000000E+00  2.00000000E+00  3.00000000E+00";
    enum { LINES = 1000000 };
    size_t width = sizeof card;
    char *deck = memory_alloc(LINES * width + 100, 1);
    assert_non_null(deck);
    for (int mac = 0; mac < 2; mac++) {
        size_t length = (size_t)sprintf(deck, "*KEYWORD%c*NODE%c", mac ? '\r' : '\n', mac ? '\r' : '\n');
        for (int i = 0; i < LINES; i++, length += width) {
            memcpy(deck + length, card, width);
            deck[length + width - 1] = mac ? '\r' : '\n';
        }
        struct timespec start, end;
        clock_gettime(CLOCK_MONOTONIC, &start);
        DeckCase c = load_bytes(deck, length);
        CardReader reader = open_block(&c, 0);
        static const FieldSpec fields[] = {RECORD_FIELD("ID", 'I', 8, id), RECORD_FIELD("A", 'F', 16, a),
                                           RECORD_FIELD("B", 'F', 16, b), RECORD_FIELD("C", 'F', 16, c)};
        Record r;
        int count = 0;
        while (card_left(&reader)) count += card_read(&reader, fields, 4, &r, true, "card 1", NULL) == 0;
        clock_gettime(CLOCK_MONOTONIC, &end);
        assert_int_equal(count, LINES);
        assert_true(end.tv_sec - start.tv_sec < 20);
        close_case(&c);
    }
    memory_free(deck);
}

/* Every allocation that can fail does: an environment message or a lesser deck, never a crash or a leak. */
static void loading_survives_lack_of_memory(void **state)
{
    (void)state;
    static const char deck[] = "*KEYWORD\n*PARAMETER\nR a 1.0 C b text\n*PARAMETER_EXPRESSION\nR c a+1\n"
                               "*DEFINE_TRANSFORMATION\n1\nPOINT,1,0.,0.,0.\nTRANSL,1.,2.,3.\n*A\n1,2,\t3\n*B\n";
    size_t before = memory_in_use();
    for (long k = 1; k < 60; k++) {
        memory_fail_after(k);
        DeckCase c = load_string(deck);
        memory_fail_after(0);
        close_case(&c);
        assert_int_equal(memory_in_use(), before);
    }
    memory_fail_after(3);
    DeckCase c = load_string(deck);
    memory_fail_after(0);
    assert_int_equal(c.status, -1);
    assert_int_equal(diagnostics_exit_code(&c.diagnostics), 3);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_in_every_spelling),
        cmocka_unit_test(what_is_no_number),
        cmocka_unit_test(numbers_are_rounded_correctly),
        cmocka_unit_test(blocks_and_their_lines),
        cmocka_unit_test(line_ends_of_all_systems),
        cmocka_unit_test(tabs_go_to_multiples_of_eight),
        cmocka_unit_test(fields_may_touch),
        cmocka_unit_test(blank_fields_take_their_defaults),
        cmocka_unit_test(comma_format),
        cmocka_unit_test(formats_of_deck_and_keyword),
        cmocka_unit_test(wrong_values_are_reported),
        cmocka_unit_test(whole_reals_are_integers),
        cmocka_unit_test(numbers_across_two_fields),
        cmocka_unit_test(unused_fields_are_listed_once),
        cmocka_unit_test(surplus_text_is_mentioned),
        cmocka_unit_test(texts_are_cut_to_their_room),
        cmocka_unit_test(title_cards),
        cmocka_unit_test(files_that_are_no_decks),
        cmocka_unit_test(odd_keywords),
        cmocka_unit_test(huge_lines_are_refused),
        cmocka_unit_test(a_million_lines_load_quickly),
        cmocka_unit_test(loading_survives_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
