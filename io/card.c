/* Cards read field by field into records: numbers, texts, parameters, defaults, offsets and unused fields. */
#include "io/card.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/card_layout.h"
#include "io/field.h"
#include "io/include_transform.h"
#include "io/number.h"
#include "io/parameters.h"

enum {
    LONGEST_QUOTE = 40,   /* characters of a field quoted in a message */
    MESSAGE_LENGTH = 240, /* of an expression's complaint */
};

/* One card being read. */
typedef struct CardReading {
    CardReader *reader;
    const DeckLine *line;
    const char *card_name;
    bool free;
    bool failed; /* an error was reported; further ones of the same line would be its echo */
} CardReading;

bool card_left(const CardReader *reader)
{
    return reader->next < reader->block->line_count;
}

const DeckLine *card_peek(const CardReader *reader)
{
    return card_left(reader) ? &reader->block->lines[reader->next] : NULL;
}

bool card_skip(CardReader *reader)
{
    if (!card_left(reader)) return false;
    reader->next++;
    return true;
}

bool card_text(CardReader *reader, char *text, size_t length)
{
    if (length > 0) text[0] = '\0';
    const DeckLine *line = card_peek(reader);
    if (!line) return false;
    reader->next++;
    size_t used = strlen(line->text);
    if (used >= length) used = length > 0 ? length - 1 : 0;
    while (used > 0 && line->text[used - 1] == ' ') used--;
    if (length > 0) {
        memcpy(text, line->text, used);
        text[used] = '\0';
    }
    return true;
}

/* "card 2: X (columns 11-20)" into place. */
static void describe_place(const CardReading *card, const char *name, Field field, char *place, size_t length)
{
    const char *card_name = card->card_name ? card->card_name : "";
    const char *colon = card_name[0] ? ": " : "";
    if (card->free) {
        snprintf(place, length, "%s%s%s (value %zu)", card_name, colon, name, field.first);
    } else {
        snprintf(place, length, "%s%s%s (columns %zu-%zu)", card_name, colon, name, field.first, field.last);
    }
}

/* Reports what is wrong with a field, once a card: format takes the quoted field's length and text. */
static void report_field(CardReading *card, const char *name, Field field, const char *what)
{
    if (!card->failed) {
        char place[120];
        describe_place(card, name, field, place, sizeof place);
        bool cut = field.length > LONGEST_QUOTE;
        diagnostics_add(card->reader->diagnostics, SEVERITY_ERROR, card->line->source, card->reader->block->keyword,
                        "%s: '%.*s%s' %s", place, cut ? LONGEST_QUOTE : (int)field.length, field.text, cut ? "..." : "",
                        what);
    }
    card->failed = true;
}

/* An expression that divides integers with a remainder: as Fortran does it, but seldom as meant. */
static void warn_of_truncation(CardReading *card, const FieldSpec *spec, Field field)
{
    CardReader *reader = card->reader;
    if (!parameters_note_field(reader->parameters, reader->block, &spec->name)) return;
    char place[120];
    describe_place(card, spec->name, field, place, sizeof place);
    int length = field.length > LONGEST_QUOTE ? LONGEST_QUOTE : (int)field.length;
    diagnostics_add(reader->diagnostics, SEVERITY_WARNING, card->line->source, reader->block->keyword,
                    "%s: '%.*s' divides integers and loses a remainder; write 7./2 for 3.5", place, length, field.text);
}

/* The number of a field that is not blank: written out, a parameter or an expression. False after an error. */
static bool parse_number(CardReading *card, const FieldSpec *spec, Field field, double *value)
{
    char first = field.text[0];
    char second = field.length > 1 ? field.text[1] : '\0';
    bool is_signed = first == '-' || first == '+';
    if (first == '&' || first == '<' || (is_signed && (second == '&' || second == '<'))) {
        ExpressionValue result;
        char message[MESSAGE_LENGTH], what[MESSAGE_LENGTH + 40];
        if (parameters_evaluate(card->reader->parameters, card->reader->block, field.text, field.length, &result,
                                message, sizeof message)) {
            snprintf(what, sizeof what, "cannot be evaluated: %s", message);
            if (message[0]) report_field(card, spec->name, field, what);
            card->failed = true;
            return false;
        }
        if (result.truncated) warn_of_truncation(card, spec, field);
        *value = result.value;
        return true;
    }
    switch (number_parse(field.text, field.length, value)) {
    case NUMBER_FINE:
        return true;
    case NUMBER_TOO_LARGE:
        report_field(card, spec->name, field, "is too large for any number; the largest is about 1.7e308");
        return false;
    case NUMBER_MALFORMED:
        break;
    }
    if (first == '*') {
        report_field(card, spec->name, field, "is not a number; a keyword's star must stand in column 1");
    } else if (memchr(field.text, ' ', field.length)) {
        report_field(card, spec->name, field, "is more than one value; are the numbers in the wrong columns?");
    } else {
        report_field(card, spec->name, field, "is not a number; is it in the wrong columns?");
    }
    return false;
}

/* Whole and within int, or an error. */
static bool check_integer(CardReading *card, const FieldSpec *spec, Field field, double value)
{
    if (value != floor(value)) {
        report_field(card, spec->name, field, "is not a whole number; is it in the wrong columns?");
        return false;
    }
    if (fabs(value) > INT_MAX) {
        report_field(card, spec->name, field, "is beyond the largest whole number, 2147483647");
        return false;
    }
    return true;
}

/* Lists or refuses a field that has no effect and is not at its default. */
static void judge_unused(CardReading *card, const FieldSpec *spec, Field field, bool is_default)
{
    if (spec->use == FIELD_USED || is_default) return;
    CardReader *reader = card->reader;
    /* one message for a card and for a field of a block: more would repeat it for every line of a long list */
    const bool told = spec->use == FIELD_REFUSED && card->failed;
    if (spec->use == FIELD_REFUSED) card->failed = true;
    if (told || !parameters_note_field(reader->parameters, reader->block, spec)) return;
    char place[120];
    describe_place(card, spec->name, field, place, sizeof place);
    int length = field.length > LONGEST_QUOTE ? LONGEST_QUOTE : (int)field.length;
    if (spec->use == FIELD_LISTED) {
        diagnostics_add(reader->diagnostics, SEVERITY_NOTE, card->line->source, reader->block->keyword,
                        "%s = %.*s is read but not used", place, length, field.text);
        return;
    }
    diagnostics_add(reader->diagnostics, SEVERITY_ERROR, card->line->source, reader->block->keyword,
                    "%s = %.*s asks for what billow does not have; leave the field blank or %g", place, length,
                    field.text, spec->fallback);
}

static void read_number(CardReading *card, const FieldSpec *spec, Field field, void *record)
{
    double value = spec->fallback;
    if (field.length > 0) {
        if (!parse_number(card, spec, field, &value)) value = spec->fallback;
        if (spec->type == 'I' && !check_integer(card, spec, field, value)) value = spec->fallback;
        bool is_default = value == spec->fallback || (spec->zero_is_default && value == 0);
        if (is_default) {
            value = spec->fallback;
        } else {
            double scaled = include_transform_scale(card->reader->block->transform, spec->scale, value);
            if (spec->type == 'I' && fabs(scaled) > INT_MAX) {
                report_field(card, spec->name, field, "with the offset of *INCLUDE_TRANSFORM is beyond 2147483647");
            } else {
                value = scaled;
            }
        }
        judge_unused(card, spec, field, is_default);
    }
    void *target = (char *)record + spec->offset;
    if (spec->type == 'I') {
        int number = (int)value;
        memcpy(target, &number, sizeof number);
    } else {
        memcpy(target, &value, sizeof value);
    }
}

/* True for 0, 0.0 and the like, which preprocessors write into every column they do not use. */
static bool is_zero(Field field)
{
    double value = 1;
    return number_parse(field.text, field.length, &value) == NUMBER_FINE && value == 0;
}

static void read_text(CardReading *card, const FieldSpec *spec, Field field, void *record)
{
    const DeckBlock *block = card->reader->block;
    Field value = field;
    if (field.length > 1 && field.text[0] == '&') {
        const Parameter *parameter =
            parameters_find(card->reader->parameters, field.text + 1, field.length - 1, block->order, block->scope);
        if (parameter && parameter->type == 'C') {
            value.text = parameter->text;
            value.length = strlen(parameter->text);
        }
    }
    char *target = (char *)record + spec->offset;
    size_t room = (size_t)spec->columns;
    size_t length = value.length < room ? value.length : room;
    memcpy(target, value.text, length);
    target[length] = '\0';
    judge_unused(card, spec, field, field.length == 0 || is_zero(field));
}

/* Says once a block that a line has more than the card knows. */
static void note_surplus(CardReading *card, Field field, const void *where)
{
    CardReader *reader = card->reader;
    if (field.length == 0 || is_zero(field) || card->failed) return;
    if (!parameters_note_field(reader->parameters, reader->block, where)) return;
    char place[120];
    describe_place(card, "the text", field, place, sizeof place);
    int length = field.length > LONGEST_QUOTE ? LONGEST_QUOTE : (int)field.length;
    diagnostics_add(reader->diagnostics, SEVERITY_NOTE, card->line->source, reader->block->keyword,
                    "%s '%.*s' belongs to no field and is not used", place, length, field.text);
}

/* What follows the last field, cut into fields of the same width. */
static void check_surplus(CardReading *card, const FieldSpec *fields, int count, FieldCursor *cursor)
{
    size_t width = count > 0 ? card_field_width(card->reader->block, &fields[count - 1]) : 10;
    size_t end = card->reader->block->wide ? 160 : 80; /* what stands beyond is a comment */
    while (cursor->at < cursor->length && (cursor->free || cursor->at + width <= end)) {
        note_surplus(card, field_next(cursor, width), fields);
    }
}

static void fill_fallbacks(const FieldSpec *fields, int count, void *record)
{
    CardReading nothing = {0};
    for (int i = 0; i < count; i++) {
        Field empty = {.text = ""};
        if (fields[i].type == 'A') *((char *)record + fields[i].offset) = '\0';
        if (fields[i].type == 'I' || fields[i].type == 'F') read_number(&nothing, &fields[i], empty, record);
    }
}

static void report_missing(const CardReader *reader, const FieldSpec *fields, int count, const char *card_name)
{
    const DeckBlock *block = reader->block;
    Source source = block->line_count > 0 ? block->lines[block->line_count - 1].source : block->source;
    char names[120] = "";
    size_t used = 0;
    for (int i = 0; i < count && used + 20 < sizeof names; i++) {
        if (fields[i].type == '-') continue;
        int written = snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", fields[i].name);
        if (written > 0) used += (size_t)written;
    }
    diagnostics_add(reader->diagnostics, SEVERITY_ERROR, source, block->keyword,
                    "%s is missing; a line with %s must follow here", card_name ? card_name : "a card", names);
}

int card_read(CardReader *reader, const FieldSpec *fields, int count, void *record, bool required,
              const char *card_name, Source *source)
{
    const DeckLine *line = card_peek(reader);
    const DeckBlock *block = reader->block;
    if (source) *source = line ? line->source : block->source;
    fill_fallbacks(fields, count, record);
    if (!line) {
        if (required) report_missing(reader, fields, count, card_name);
        return -1;
    }
    reader->next++;
    FieldCursor cursor = field_start(line->text, card_comma_columns(block, fields, count));
    CardReading card = {.reader = reader, .line = line, .card_name = card_name, .free = cursor.free};
    if (!cursor.free) {
        int split = card_find_split_number(block, line->text, fields, count);
        if (split >= 0) {
            Field both = card_split_number(block, line->text, fields, split);
            report_field(&card, fields[split].name, both,
                         "reaches across the border of two fields; it is in the wrong columns");
        }
    }
    for (int i = 0; i < count; i++) {
        const FieldSpec *spec = &fields[i];
        bool takes_rest = cursor.free && i == count - 1 && card_is_long_text(spec);
        Field field = takes_rest ? field_rest(&cursor) : field_next(&cursor, card_field_width(block, spec));
        if (spec->type == '-') note_surplus(&card, field, spec);
        if (spec->type == 'A') read_text(&card, spec, field, record);
        if (spec->type == 'I' || spec->type == 'F') read_number(&card, spec, field, record);
    }
    check_surplus(&card, fields, count, &cursor);
    return card.failed ? -1 : 0;
}
