/* Helpers of the keyword tests: a deck text read into definitions, and its messages. */
#ifndef BILLOW_TESTS_KEYWORD_CASE_H
#define BILLOW_TESTS_KEYWORD_CASE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "io/read.h"
#include "solver/memory.h"

typedef struct KeywordCase {
    Definitions d;
    Diagnostics g;
    int status;
} KeywordCase;

static inline KeywordCase read_case(const char *text)
{
    KeywordCase c = {0};
    c.status = deck_read_text("case.k", text, strlen(text), &c.d, &c.g);
    return c;
}

static inline void close_case(KeywordCase *c)
{
    definitions_free(&c->d);
    diagnostics_free(&c->g);
    assert_int_equal(memory_in_use(), 0);
}

/* The deck is fine: no errors and no warnings. */
static inline KeywordCase read_fine(const char *text)
{
    KeywordCase c = read_case(text);
    if (c.status || c.g.warnings) diagnostics_print(&c.g, SEVERITY_NOTE, stderr);
    assert_int_equal(c.status, 0);
    assert_int_equal(c.g.errors + c.g.warnings + c.g.environment, 0);
    assert_false(c.d.incomplete);
    return c;
}

/* How many notes say that this text is read but not used. */
static inline int count_notes(const KeywordCase *c, const char *part)
{
    int count = 0;
    for (size_t i = 0; i < c->g.count; i++)
        count += c->g.messages[i].severity == SEVERITY_NOTE && strstr(c->g.messages[i].text, part) != NULL;
    return count;
}

/* Exactly one message of at least a warning, an error on that line, of that keyword, with that text in it. */
static inline void assert_one_error(const char *text, int line, const char *keyword, const char *part)
{
    KeywordCase c = read_case(text);
    int serious = 0, fine = 0;
    for (size_t i = 0; i < c.g.count; i++) {
        const Message *m = &c.g.messages[i];
        if (m->severity == SEVERITY_NOTE) continue;
        serious++;
        fine += m->severity == SEVERITY_ERROR && m->source.line == line && strcmp(m->keyword, keyword) == 0 &&
                strstr(m->text, part) != NULL;
    }
    if (serious != 1 || fine != 1) {
        print_error("expected one error of %s in line %d with '%s', but got\n", keyword, line, part);
        diagnostics_print(&c.g, SEVERITY_NOTE, stderr);
    }
    assert_int_equal(serious, 1);
    assert_int_equal(fine, 1);
    assert_int_equal(c.status, -1);
    close_case(&c);
}

#endif
