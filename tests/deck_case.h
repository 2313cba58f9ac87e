/* Helpers of the tests of the deck's text: a deck loaded from a string, and its messages. */
#ifndef BILLOW_TESTS_DECK_CASE_H
#define BILLOW_TESTS_DECK_CASE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "io/card.h"

typedef struct DeckCase {
    DeckText deck;
    Diagnostics diagnostics;
    int status;
} DeckCase;

/* Loads length bytes as the file case.k. */
static inline DeckCase load_bytes(const char *text, size_t length)
{
    DeckCase c = {0};
    c.status = deck_text_load("case.k", text, length, &c.deck, &c.diagnostics);
    return c;
}

static inline DeckCase load_string(const char *text)
{
    return load_bytes(text, strlen(text));
}

static inline void close_case(DeckCase *c)
{
    deck_text_free(&c->deck);
    diagnostics_free(&c->diagnostics);
}

/* A reader at the start of block number index. */
static inline CardReader open_block(DeckCase *c, size_t index)
{
    assert_true(index < c->deck.blocks.count);
    return (CardReader){
        .block = &c->deck.blocks.items[index], .parameters = c->deck.parameters, .diagnostics = &c->diagnostics};
}

static inline void assert_no_messages(const DeckCase *c)
{
    if (c->diagnostics.count > 0) diagnostics_print(&c->diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(c->diagnostics.count, 0);
}

enum { ANY_LINE = -1 };

/* Exactly one message, of that severity and line, whose text contains part. */
static inline void assert_only_message(const DeckCase *c, Severity severity, int line, const char *part)
{
    const Diagnostics *d = &c->diagnostics;
    bool fine = d->count == 1 && d->messages[0].severity == severity &&
                (line == ANY_LINE || d->messages[0].source.line == line) && strstr(d->messages[0].text, part);
    if (!fine) {
        print_error("expected one message of severity %d on line %d with '%s', but got\n", (int)severity, line, part);
        diagnostics_print(d, SEVERITY_NOTE, stderr);
    }
    assert_true(fine);
}

/* Four reals, an integer and a text: the record of most tests. */
typedef struct Record {
    double a, b, c, d;
    int id, other;
    char text[81];
} Record;

#define RECORD_FIELD(NAME, TYPE, COLUMNS, MEMBER)                                                                      \
    {                                                                                                                  \
        .name = NAME, .type = TYPE, .columns = COLUMNS, .offset = offsetof(Record, MEMBER)                             \
    }

/* One card of three fields of 10 columns: A (real), ID (integer), B (real). */
static const FieldSpec mixed_fields[] = {RECORD_FIELD("A", 'F', 10, a), RECORD_FIELD("ID", 'I', 10, id),
                                         RECORD_FIELD("B", 'F', 10, b)};

/* Reads the first card of the deck's last block through mixed_fields. */
static inline int read_mixed(DeckCase *c, Record *record)
{
    CardReader reader = open_block(c, c->deck.blocks.count - 1);
    return card_read(&reader, mixed_fields, 3, record, true, "card 1", NULL);
}

#endif
