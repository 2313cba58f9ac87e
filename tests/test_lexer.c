/* The lexical rules of whole decks: lines, blocks, formats, and files that are no decks. */
#include "tests/deck_case.h"

#include <stdlib.h>
#include <time.h>

#include "solver/memory.h"

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
    static const char *const decks[] = {"*KEYWORD\n*A\nx\n\ny", "*KEYWORD\r\n*A\r\nx\r\n\r\ny\r\n",
                                        "*KEYWORD\r*A\rx\r\ry\r", "\xef\xbb\xbf*KEYWORD\n*A\r\nx\r\r\ny\x1a",
                                        "*KEYWORD\n*A\nx\n\ny\n*END"};
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
    assert_no_deck("*KEYWORD\n*A\n1\n*NODE\n1\x02\n", 23, 5, "control characters");
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
        cmocka_unit_test(blocks_and_their_lines),          cmocka_unit_test(line_ends_of_all_systems),
        cmocka_unit_test(tabs_go_to_multiples_of_eight),   cmocka_unit_test(formats_of_deck_and_keyword),
        cmocka_unit_test(files_that_are_no_decks),         cmocka_unit_test(odd_keywords),
        cmocka_unit_test(huge_lines_are_refused),          cmocka_unit_test(a_million_lines_load_quickly),
        cmocka_unit_test(loading_survives_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
