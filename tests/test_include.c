/* *INCLUDE and *INCLUDE_PATH: where files are sought, what ends badly, and whose parameters are seen. */
#include "tests/deck_folder.h"

#include <sys/stat.h>
#include <unistd.h>

static void included_blocks_stand_in_order(void **state)
{
    (void)state;
    assert_int_equal(mkdir(path_of("sub"), 0777), 0);
    write_file("main.k", "*KEYWORD\n*A\n*INCLUDE\nsub/one.k\n\n  two.k  \n*B\n1\n*END\n");
    write_file("sub/one.k", "*ONE\n1\n*INCLUDE\nbeside.k\n*END\n*GONE\n");
    write_file("sub/beside.k", "$ found beside one.k\n*BESIDE\n1");
    write_file("two.k", "*KEYWORD LONG=Y\n*TWO\n1\n");
    DeckCase c = load_file("main.k");
    assert_no_messages(&c);
    static const char *const keywords[] = {"*A", "*ONE", "*BESIDE", "*TWO", "*B"};
    assert_int_equal(c.deck.blocks.count, 5);
    for (size_t i = 0; i < 5; i++) {
        const DeckBlock *block = &c.deck.blocks.items[i];
        assert_string_equal(block->keyword, keywords[i]);
        assert_int_equal(block->wide, i == 3); /* LONG=Y holds for its file */
        assert_null(block->transform);
    }
    assert_string_equal(c.diagnostics.files[0], path_of("main.k"));
    assert_string_equal(c.diagnostics.files[c.deck.blocks.items[2].source.file], path_of("sub/beside.k"));
    assert_int_equal(c.deck.blocks.items[2].source.line, 2);
    close_case(&c);
}

static void paths_are_searched(void **state)
{
    (void)state;
    assert_int_equal(mkdir(path_of("library"), 0777), 0);
    assert_int_equal(mkdir(path_of("library/deep"), 0777), 0);
    write_file("library/far.k", "*FAR\n");
    write_file("library/deep/a_name_that_is_continued.k", "*DEEP\n");
    write_file("paths.k", "*KEYWORD\n*INCLUDE_PATH_RELATIVE\nlibrary\n*INCLUDE\nfar.k\n"
                          "*INCLUDE\n  deep\\a_name +\n_that_is_ +\ncontinued.k\n");
    DeckCase c = load_file("paths.k");
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 2);
    assert_string_equal(c.deck.blocks.items[1].keyword, "*DEEP");
    close_case(&c);
    char deck[300];
    snprintf(deck, sizeof deck, "*KEYWORD\n*INCLUDE_PATH\n%s\n*PARAMETER\nC name,far.k\n*INCLUDE\n&name\n",
             path_of("library"));
    c = load_string(deck);
    assert_no_messages(&c);
    assert_int_equal(c.deck.blocks.count, 1);
    close_case(&c);
}

static void includes_that_cannot_be(void **state)
{
    (void)state;
    assert_bad_include("*KEYWORD\n*INCLUDE\n*A\n", 2, "the name of the file is missing");
    assert_bad_include("*KEYWORD\n*INCLUDE\nnowhere.k\n", 3, "cannot find the file 'nowhere.k'");
    assert_bad_include("*KEYWORD\n*INCLUDE\n$\n.\n", 4, "this is a directory");
    assert_bad_include("*KEYWORD\n*INCLUDE\n/dev/null\n", 3, "no regular file");
    assert_bad_include("*KEYWORD\n*INCLUDE\n/dev/zero\n", 3, "no regular file");
    assert_bad_include("*KEYWORD\n*INCLUDE\nbad.k\n", 3, "includes itself");
    assert_int_equal(mkfifo(path_of("pipe"), 0600), 0);
    assert_bad_include("*KEYWORD\n*INCLUDE\npipe\n", 3, "no regular file");
    if (geteuid() != 0) {
        write_file("secret.k", "*A\n");
        assert_int_equal(chmod(path_of("secret.k"), 0), 0);
        assert_bad_include("*KEYWORD\n*INCLUDE\nsecret.k\n", 3, "may not be read");
    }
    write_file("circle.k", "*INCLUDE\ncircle2.k\n");
    write_file("circle2.k", "*INCLUDE\ncircle.k\n");
    DeckCase c = load_file("circle.k");
    assert_only_message(&c, SEVERITY_ERROR, 2, "includes itself through other files");
    close_case(&c);
}

static void main_decks_that_cannot_be(void **state)
{
    (void)state;
    DeckCase c = load_file("missing.k");
    assert_only_message(&c, SEVERITY_ERROR, 0, "there is no such file");
    assert_string_equal(c.diagnostics.files[0], path_of("missing.k"));
    close_case(&c);
    c = load_file(".");
    assert_only_message(&c, SEVERITY_ERROR, 0, "this is a directory");
    assert_int_equal(diagnostics_exit_code(&c.diagnostics), 2);
    close_case(&c);
    write_file("empty.k", "");
    c = load_file("empty.k");
    assert_only_message(&c, SEVERITY_ERROR, 1, "the file is empty");
    close_case(&c);
}

static void nesting_has_a_limit(void **state)
{
    (void)state;
    char name[40], text[80];
    for (int i = 0; i < 40; i++) {
        snprintf(name, sizeof name, "nest%d.k", i);
        snprintf(text, sizeof text, "*A\n*INCLUDE\nnest%d.k\n", i + 1);
        write_file(name, text);
    }
    DeckCase c = load_file("nest0.k");
    assert_only_message(&c, SEVERITY_ERROR, 3, "files may be nested 32 deep");
    assert_int_equal(c.deck.blocks.count, 32);
    close_case(&c);
    /* each level twice: 2^31 inclusions if nothing stopped them */
    for (int i = 0; i < 31; i++) {
        snprintf(name, sizeof name, "nest%d.k", i);
        snprintf(text, sizeof text, "*INCLUDE\nnest%d.k\nnest%d.k\n", i + 1, i + 1);
        write_file(name, text);
    }
    write_file("nest31.k", "*A\n");
    c = load_file("nest0.k");
    assert_int_equal(c.status, -1);
    assert_non_null(strstr(c.diagnostics.messages[0].text, "there may be 10000"));
    close_case(&c);
}

static double value_in_block(DeckCase *c, size_t index)
{
    CardReader reader = open_block(c, index);
    Record r = {0};
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), 0);
    return r.a;
}

static void local_parameters_stay_in_their_file(void **state)
{
    (void)state;
    write_file("local.k", "*KEYWORD\n*PARAMETER\nR g       1.0\n*PARAMETER_LOCAL\nR l       2.0\n*INCLUDE\nlocal1.k\n"
                          "*A\n&l\n*A\n&g\n*A\n&h\n*A\n&m\n");
    write_file("local1.k",
               "*A\n&l\n*PARAMETER_LOCAL\nR l       3.0\nR m,5.\n*PARAMETER\nR h,4.\n*A\n&l\n*INCLUDE\nlocal2.k\n");
    write_file("local2.k", "*A\n&l\n*A\n&m\n");
    DeckCase c = load_file("local.k");
    assert_no_messages(&c);
    static const double expected[] = {2, 3, 3, 5, 2, 1, 4};
    for (size_t i = 0; i < 7; i++) assert_true(value_in_block(&c, i) == expected[i]);
    CardReader reader = open_block(&c, 7);
    Record r;
    assert_int_equal(card_read(&reader, mixed_fields, 3, &r, true, "card 1", NULL), -1);
    assert_only_message(&c, SEVERITY_ERROR, 15, "local to another file");
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(included_blocks_stand_in_order),
        cmocka_unit_test(paths_are_searched),
        cmocka_unit_test(includes_that_cannot_be),
        cmocka_unit_test(main_decks_that_cannot_be),
        cmocka_unit_test(nesting_has_a_limit),
        cmocka_unit_test(local_parameters_stay_in_their_file),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
