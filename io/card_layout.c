/* Where the fields of a card stand: widths by format, and numbers that lie across two fields. */
#include "io/card_layout.h"

#include <string.h>

enum {
    LONG_FORMAT_WIDTH = 20, /* of every field that is narrower in the standard format */
    I10_WIDTH = 10,         /* of every narrower field with '%' */
};

bool card_is_long_text(const FieldSpec *spec)
{
    return spec->type == 'A' && spec->columns > LONG_FORMAT_WIDTH;
}

size_t card_field_width(const DeckBlock *block, const FieldSpec *spec)
{
    size_t columns = (size_t)spec->columns;
    if (block->wide) return columns < LONG_FORMAT_WIDTH ? LONG_FORMAT_WIDTH : 2 * columns;
    if (block->i10 && columns < I10_WIDTH) return I10_WIDTH;
    return columns;
}

size_t card_comma_columns(const DeckBlock *block, const FieldSpec *fields, int count)
{
    if (count == 0 || !card_is_long_text(&fields[count - 1])) return BILLOW_WHOLE_LINE;
    size_t columns = 0;
    for (int i = 0; i < count - 1; i++) columns += card_field_width(block, &fields[i]);
    return columns;
}

static bool is_numeric(const FieldSpec *spec)
{
    return spec->type == 'I' || spec->type == 'F';
}

static bool is_number_part(char c)
{
    return (c >= '0' && c <= '9') || c == '.';
}

/* A look at columns [begin, end) of a line, cut at its end. */
typedef struct Span {
    size_t begin, end;           /* columns from 0 */
    size_t text_begin, text_end; /* what is not blank; equal if all is */
} Span;

static Span measure_span(const char *line, size_t length, size_t begin, size_t columns)
{
    Span span = {begin, begin + columns, begin < length ? begin : length, 0};
    span.text_end = span.end < length ? span.end : length;
    while (span.text_begin < span.text_end && line[span.text_begin] == ' ') span.text_begin++;
    while (span.text_end > span.text_begin && line[span.text_end - 1] == ' ') span.text_end--;
    return span;
}

/* True if any field but the one that begins at column except is set flush left after a blank. */
static bool is_flush_left(const DeckBlock *block, const char *line, const FieldSpec *fields, int count, size_t except)
{
    size_t length = strlen(line), begin = 0;
    for (int i = 0; i < count; i++) {
        Span span = measure_span(line, length, begin, card_field_width(block, &fields[i]));
        bool filled = span.text_end > span.text_begin;
        bool after_blank = begin == 0 || (begin < length && line[begin - 1] == ' ');
        if (begin != except && filled && after_blank && span.text_begin == begin && span.text_end < span.end)
            return true;
        begin = span.end;
    }
    return false;
}

int card_find_split_number(const DeckBlock *block, const char *line, const FieldSpec *fields, int count)
{
    size_t length = strlen(line), begin = 0;
    for (int i = 0; i < count && begin < length; i++) {
        size_t width = card_field_width(block, &fields[i]);
        size_t border = begin + width;
        if (border >= length) break;
        size_t start = begin;
        begin = border;
        if (line[start] != ' ' || !is_number_part(line[border]) || line[border - 1] == ' ') continue;
        const FieldSpec *next = i + 1 < count ? &fields[i + 1] : &fields[i];
        if (!is_numeric(&fields[i]) || !is_numeric(next)) continue;
        Span right = measure_span(line, length, border, card_field_width(block, next));
        if (!is_number_part(line[border - 1]) || right.text_end == right.end) continue;
        if (memchr(line + right.text_begin, ' ', right.text_end - right.text_begin)) continue;
        if (!is_flush_left(block, line, fields, count, border)) return i;
    }
    return -1;
}

Field card_split_number(const DeckBlock *block, const char *line, const FieldSpec *fields, int split)
{
    size_t border = 0;
    for (int i = 0; i <= split; i++) border += card_field_width(block, &fields[i]);
    size_t first = border, last = border;
    while (first > 0 && line[first - 1] != ' ') first--;
    while (line[last] != '\0' && line[last] != ' ') last++;
    return (Field){.text = line + first, .length = last - first, .first = first + 1, .last = last};
}
