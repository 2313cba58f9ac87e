/* The list of messages and the allocator behind everything. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "solver/billow.h"
#include "solver/diagnostics.h"
#include "solver/memory.h"

/* What diagnostics_print writes, in a static buffer. */
static const char *printed(const Diagnostics *diagnostics, Severity least)
{
    static char text[100000];
    FILE *stream = tmpfile();
    assert_non_null(stream);
    diagnostics_print(diagnostics, least, stream);
    rewind(stream);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    fclose(stream);
    return text;
}

static void messages_read_like_a_compilers(void **state)
{
    (void)state;
    Diagnostics d = {0};
    assert_int_equal(diagnostics_add_file(&d, "a.k"), 0);
    assert_int_equal(diagnostics_add_file(&d, "dir/b.k"), 1);
    diagnostics_add(&d, SEVERITY_NOTE, (Source){0, 9}, "*PART", "note %d", 1);
    diagnostics_add(&d, SEVERITY_WARNING, (Source){1, 5}, "*NODE", "later");
    diagnostics_add(&d, SEVERITY_WARNING, (Source){0, 8}, NULL, "between");
    diagnostics_add(&d, SEVERITY_ERROR, (Source){0, 12}, "*NODE", "x is %s", "bad");
    diagnostics_add(&d, SEVERITY_WARNING, (Source){0, 7}, NULL, "earlier");
    diagnostics_add(&d, SEVERITY_WARNING, (Source){0, 7}, NULL, "earlier, said second");
    diagnostics_add(&d, SEVERITY_ERROR, (Source){1, 0}, NULL, "whole file");
    diagnostics_add(&d, SEVERITY_ERROR, BILLOW_NO_SOURCE, "*END", "no place");
    assert_string_equal(printed(&d, SEVERITY_NOTE), "a.k:12: error: *NODE: x is bad\n"
                                                    "dir/b.k: error: whole file\n"
                                                    "error: *END: no place\n"
                                                    "a.k:7: warning: earlier\n"
                                                    "a.k:7: warning: earlier, said second\n"
                                                    "a.k:8: warning: between\n"
                                                    "dir/b.k:5: warning: *NODE: later\n"
                                                    "a.k:9: note: *PART: note 1\n");
    assert_string_equal(printed(&d, SEVERITY_ERROR), "a.k:12: error: *NODE: x is bad\n"
                                                     "dir/b.k: error: whole file\n"
                                                     "error: *END: no place\n");
    assert_true(d.errors == 3 && d.warnings == 4 && d.notes == 1 && d.environment == 0);
    diagnostics_free(&d);
    assert_int_equal(d.count, 0);
}

static void exit_codes_follow_the_worst(void **state)
{
    (void)state;
    Diagnostics d = {0};
    assert_int_equal(diagnostics_exit_code(&d), BILLOW_EXIT_NORMAL);
    diagnostics_add(&d, SEVERITY_WARNING, BILLOW_NO_SOURCE, NULL, "w");
    assert_int_equal(diagnostics_exit_code(&d), BILLOW_EXIT_NORMAL);
    diagnostics_add(&d, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL, "e");
    assert_int_equal(diagnostics_exit_code(&d), BILLOW_EXIT_INPUT);
    diagnostics_add(&d, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory");
    assert_int_equal(diagnostics_exit_code(&d), BILLOW_EXIT_ENVIRONMENT);
    diagnostics_free(&d);
}

static void only_so_many_messages_are_kept(void **state)
{
    (void)state;
    Diagnostics d = {0};
    for (int i = 0; i < 5000; i++) {
        diagnostics_add(&d, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL, "e%d", i);
        diagnostics_add(&d, SEVERITY_WARNING, BILLOW_NO_SOURCE, NULL, "w%d", i);
        diagnostics_add(&d, SEVERITY_NOTE, BILLOW_NO_SOURCE, NULL, "n%d", i);
    }
    assert_int_equal(d.count, 200 + 1000 + 1000);
    assert_int_equal(d.errors, 5000);
    assert_int_equal(d.suppressed, 4800);
    const char *text = printed(&d, SEVERITY_NOTE);
    assert_non_null(strstr(text, "error: e199\n"));
    assert_null(strstr(text, "error: e200\n"));
    assert_non_null(
        strstr(text, "4800 more errors not shown\n4000 more warnings not shown\n4000 more notes not shown\n"));
    diagnostics_free(&d);
}

static void terminals_are_not_upset(void **state)
{
    (void)state;
    Diagnostics d = {0};
    diagnostics_add(&d, SEVERITY_ERROR, BILLOW_NO_SOURCE, "*\x1b[A",
                    "\x1b[2J a\tb \xc3\xa9 \xe2\x82\xac \xff\xc3 \x80 \xc2\x9b \x7f");
    assert_string_equal(printed(&d, SEVERITY_ERROR), "error: *?[A: ?[2J a?b \xc3\xa9 \xe2\x82\xac ?? ? ?? ?\n");
    diagnostics_free(&d);
}

static void messages_without_memory_still_count(void **state)
{
    (void)state;
    size_t before = memory_in_use();
    for (long k = 1; k < 4; k++) {
        Diagnostics d = {0};
        memory_fail_after(k);
        diagnostics_add(&d, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL, "e");
        int file = diagnostics_add_file(&d, "a.k");
        memory_fail_after(0);
        assert_true(file == -1 || file == 0);
        assert_int_equal(diagnostics_exit_code(&d), BILLOW_EXIT_INPUT);
        printed(&d, SEVERITY_NOTE);
        diagnostics_free(&d);
        assert_int_equal(memory_in_use(), before);
    }
}

static void blocks_are_aligned_and_zero(void **state)
{
    (void)state;
    size_t before = memory_in_use();
    unsigned char *block = memory_alloc(100, 3);
    assert_non_null(block);
    assert_int_equal((uintptr_t)block % 64, 0);
    for (int i = 0; i < 300; i++) assert_int_equal(block[i], 0);
    assert_int_equal(memory_in_use(), before + 300);
    assert_true(memory_peak() >= before + 300);
    memset(block, 7, 300);
    block = memory_resize(block, 1000, 8);
    assert_non_null(block);
    assert_int_equal((uintptr_t)block % 64, 0);
    for (int i = 0; i < 300; i++) assert_int_equal(block[i], 7);
    assert_int_equal(memory_in_use(), before + 8000);
    block = memory_resize(block, 10, 1);
    assert_int_equal(memory_in_use(), before + 10);
    memory_free(block);
    memory_free(NULL);
    assert_int_equal(memory_in_use(), before);
    block = memory_alloc(0, 8);
    assert_non_null(block);
    memory_free(block);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    assert_null(memory_alloc(SIZE_MAX, 2));
    assert_null(memory_alloc(SIZE_MAX / 2, 1));
    assert_null(memory_alloc((size_t)1 << 33, (size_t)1 << 33));
    int *array = NULL;
    size_t capacity = 0;
    assert_int_equal(memory_reserve((void **)&array, &capacity, SIZE_MAX / 2, sizeof *array), -1);
    assert_null(array);
    assert_int_equal(capacity, 0);
}

static void arrays_grow(void **state)
{
    (void)state;
    int *array = NULL;
    size_t capacity = 0;
    for (size_t i = 0; i < 1000; i++) {
        assert_int_equal(memory_reserve((void **)&array, &capacity, i + 1, sizeof *array), 0);
        array[i] = (int)i;
    }
    assert_true(capacity >= 1000 && capacity < 2048);
    for (int i = 0; i < 1000; i++) assert_int_equal(array[i], i);
    memory_fail_after(1);
    assert_int_equal(memory_reserve((void **)&array, &capacity, 5000, sizeof *array), -1);
    assert_int_equal(array[999], 999);
    assert_int_equal(memory_reserve((void **)&array, &capacity, 5000, sizeof *array), 0);
    memory_free(array);
}

static void the_chosen_allocation_fails(void **state)
{
    (void)state;
    memory_fail_after(3);
    void *first = memory_alloc(1, 1), *second = memory_alloc(1, 1);
    assert_non_null(first);
    assert_non_null(second);
    assert_null(memory_alloc(1, 1));
    void *fourth = memory_alloc(1, 1);
    assert_non_null(fourth);
    memory_fail_after(1);
    assert_null(memory_resize(first, 10, 1));
    memory_fail_after(0);
    memory_free(first);
    memory_free(second);
    memory_free(fourth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_read_like_a_compilers),      cmocka_unit_test(exit_codes_follow_the_worst),
        cmocka_unit_test(only_so_many_messages_are_kept),      cmocka_unit_test(terminals_are_not_upset),
        cmocka_unit_test(messages_without_memory_still_count), cmocka_unit_test(blocks_are_aligned_and_zero),
        cmocka_unit_test(impossible_sizes_are_refused),        cmocka_unit_test(arrays_grow),
        cmocka_unit_test(the_chosen_allocation_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
