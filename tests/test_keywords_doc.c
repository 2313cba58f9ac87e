/* docs/keywords.md says what the reader's table says, and the table is sound. With --print, prints the page. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* open_memstream */
#endif
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "io/keyword_table.h"

static char *read_page(void)
{
    FILE *file = fopen(BILLOW_SOURCE_DIR "/docs/keywords.md", "rb");
    assert_non_null(file);
    char *text = NULL;
    size_t length = 0;
    if (getdelim(&text, &length, '\0', file) < 0) fail_msg("docs/keywords.md is empty");
    fclose(file);
    return text;
}

static void test_page_is_the_table(void **state)
{
    (void)state;
    char *printed = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&printed, &length);
    assert_non_null(stream);
    keyword_print_documentation(stream);
    fclose(stream);
    char *page = read_page();
    size_t same = 0;
    int line = 1;
    while (page[same] && page[same] == printed[same]) line += page[same++] == '\n';
    if (page[same] != printed[same])
        fail_msg("docs/keywords.md differs from the table in line %d; write it anew: test_keywords_doc --print", line);
    free(page);
    free(printed);
}

/* Every keyword with a reader has cards; every field has a name, a type and a width; every other one says why. */
static void test_table_is_complete(void **state)
{
    (void)state;
    for (int f = 0; f < keyword_family_count(); f++) {
        const KeywordFamily *family = keyword_family(f);
        for (int i = 0; i < family->count; i++) {
            const KeywordSpec *spec = &family->specs[i];
            assert_true(spec->name[0] == '*');
            assert_non_null(spec->remark);
            assert_true((spec->state == KEYWORD_READ) == (spec->read != NULL));
            assert_true((spec->state == KEYWORD_READ) == (spec->card_count > 0));
            if (spec->state == KEYWORD_IGNORED || spec->state == KEYWORD_REFUSED) assert_true(spec->remark[0]);
            for (int c = 0; c < spec->card_count; c++) {
                int columns = 0;
                assert_true(spec->cards[c].name[0]);
                for (int k = 0; k < spec->cards[c].count; k++) {
                    const FieldSpec *field = &spec->cards[c].fields[k];
                    assert_true(field->name[0] && strchr("IFA-", field->type));
                    columns += field->columns;
                }
                assert_in_range(columns, 10, 80);
            }
        }
    }
}

/* Two fields of one card that both have an effect must not be stored in one place. */
static void test_fields_do_not_overlap(void **state)
{
    (void)state;
    for (int f = 0; f < keyword_family_count(); f++) {
        const KeywordFamily *family = keyword_family(f);
        for (int i = 0; i < family->count; i++) {
            for (int c = 0; c < family->specs[i].card_count; c++) {
                const CardSpec *card = &family->specs[i].cards[c];
                for (int a = 0; a < card->count; a++)
                    for (int b = 0; b < a; b++)
                        if (card->fields[a].type != '-' && card->fields[b].type != '-' &&
                            card->fields[a].type == card->fields[b].type)
                            assert_int_not_equal(card->fields[a].offset, card->fields[b].offset);
            }
        }
    }
}

/* Every name and alias leads back to its own entry, and options are found in any order. */
static void test_names_are_found(void **state)
{
    (void)state;
    const KeywordSpec *base;
    const char *rest;
    unsigned options;
    for (int f = 0; f < keyword_family_count(); f++) {
        const KeywordFamily *family = keyword_family(f);
        for (int i = 0; i < family->count; i++) {
            const KeywordSpec *spec = &family->specs[i];
            assert_ptr_equal(keyword_find(spec->name, &options, &base, &rest), spec);
            assert_int_equal(options, 0);
            for (int a = 0; a < KEYWORD_MAX_ALIASES && spec->aliases[a]; a++)
                assert_ptr_equal(keyword_find(spec->aliases[a], &options, &base, &rest), spec);
        }
    }
    assert_string_equal(keyword_find("*BOUNDARY_SPC_SET_BIRTH_DEATH_ID", &options, &base, &rest)->name,
                        "*BOUNDARY_SPC_SET");
    assert_int_equal(options, 3);
    assert_string_equal(keyword_find("*BOUNDARY_SPC_SET_ID_BIRTH_DEATH", &options, &base, &rest)->name,
                        "*BOUNDARY_SPC_SET");
    assert_int_equal(options, 3);
    assert_string_equal(keyword_find("*DATABASE_TPRINT", &options, &base, &rest)->name, "*DATABASE");
    assert_null(keyword_find("*ELEMENT_SHELL_OFFSET", &options, &base, &rest));
    assert_string_equal(base->name, "*ELEMENT_SHELL");
    assert_string_equal(rest, "OFFSET");
    assert_null(keyword_find("*NODES", &options, &base, &rest));
    assert_null(base);
    assert_string_equal(keyword_nearest("*NDOE"), "*NODE");
    assert_string_equal(keyword_nearest("*DEFINE_CURV"), "*DEFINE_CURVE");
    assert_null(keyword_nearest("*INTERFACE_TIED"));
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--print") == 0) {
        keyword_print_documentation(stdout);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_page_is_the_table),
        cmocka_unit_test(test_table_is_complete),
        cmocka_unit_test(test_fields_do_not_overlap),
        cmocka_unit_test(test_names_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
