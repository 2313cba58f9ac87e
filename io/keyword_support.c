/* What the keyword readers share: cards, titles, lists and messages. */
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "io/include_transform.h"
#include "io/keyword_table.h"
#include "solver/memory.h"

bool keyword_option(const KeywordRead *read, int option)
{
    return (read->options & 1u << option) != 0;
}

int keyword_card(KeywordRead *read, int card, void *record, bool required, Source *source)
{
    const CardSpec *spec = &read->spec->cards[card];
    return card_read(read->cards, spec->fields, spec->count, record, required, spec->name, source);
}

bool keyword_more(const KeywordRead *read)
{
    const CardReader *cards = read->cards;
    for (size_t i = cards->next; i < cards->block->line_count; i++)
        if (cards->block->lines[i].text[strspn(cards->block->lines[i].text, " \t")]) return true;
    return false;
}

void *keyword_append(KeywordRead *read, void **items, size_t *count, size_t *capacity, size_t size)
{
    if (memory_reserve(items, capacity, *count + 1, size)) {
        if (!read->out_of_memory)
            diagnostics_add(read->cards->diagnostics, SEVERITY_ENVIRONMENT, read->cards->block->source,
                            read->cards->block->keyword, "out of memory while reading the deck");
        read->out_of_memory = true;
        return NULL;
    }
    void *record = (char *)*items + *count * size;
    memset(record, 0, size);
    (*count)++;
    return record;
}

static void report(const KeywordRead *read, Severity severity, Source source, const char *format, va_list arguments)
{
    char text[600];
    vsnprintf(text, sizeof text, format, arguments);
    diagnostics_add(read->cards->diagnostics, severity, source, read->cards->block->keyword, "%s", text);
}

void keyword_error(const KeywordRead *read, Source source, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    report(read, SEVERITY_ERROR, source, format, arguments);
    va_end(arguments);
}

void keyword_warning(const KeywordRead *read, Source source, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    report(read, SEVERITY_WARNING, source, format, arguments);
    va_end(arguments);
}

void keyword_note(const KeywordRead *read, Source source, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    report(read, SEVERITY_NOTE, source, format, arguments);
    va_end(arguments);
}

bool keyword_check_id(const KeywordRead *read, int id, const char *field, Source source)
{
    if (id > 0) return true;
    keyword_error(read, source, "%s is %d, but must be a positive number", field, id);
    return false;
}

void keyword_title(KeywordRead *read, int option, char *title)
{
    if (keyword_option(read, option)) card_text(read->cards, title, BILLOW_TITLE_LENGTH);
}

typedef struct IdCard {
    int id;
    char heading[71];
} IdCard;

#define AT(member) offsetof(IdCard, member)
static const FieldSpec id_fields[] = {
    CARD_INT("ID", id, USED, NONE),
    CARD_TEXT("HEADING", heading, 70, USED),
};
#undef AT

void keyword_id_card(KeywordRead *read, int option, int *id, char *title)
{
    if (!keyword_option(read, option)) return;
    IdCard card = {0};
    card_read(read->cards, CARD_FIELDS(id_fields), &card, true, "ID card", NULL);
    if (id) *id = card.id;
    if (title) memcpy(title, card.heading, sizeof card.heading);
}

void keyword_finish(KeywordRead *read)
{
    if (!keyword_more(read)) return;
    while (card_left(read->cards)) {
        const DeckLine *line = card_peek(read->cards);
        if (line->text[strspn(line->text, " \t")]) {
            keyword_error(read, line->source,
                          "this line is beyond the last card of the keyword; remove it or check the cards before it");
            return;
        }
        card_skip(read->cards);
    }
}

double keyword_scale(const KeywordRead *read, double value, FieldScale scale)
{
    return include_transform_scale(read->cards->block->transform, scale, value);
}

bool keyword_real_id(const KeywordRead *read, double *value, FieldScale scale, const char *field, Source source)
{
    const double id = keyword_scale(read, *value, scale);
    if (id != floor(id) || fabs(id) > INT_MAX) {
        keyword_error(read, source, "%s is %g, but must be a whole number here: it names another keyword's id", field,
                      *value);
        return false;
    }
    *value = id;
    return true;
}

void keyword_transform_point(const KeywordRead *read, double x[3])
{
    include_transform_point(read->cards->block->transform, x);
}

void keyword_transform_vector(const KeywordRead *read, double x[3])
{
    include_transform_direction(read->cards->block->transform, x);
}

bool keyword_transform_turns(const KeywordRead *read)
{
    if (!read->cards->block->transform) return false;
    const double *matrix = read->cards->block->transform->matrix;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (i != j && fabs(matrix[4 * i + j]) > 1e-12) return true;
    return false;
}

void keyword_check_times(const KeywordRead *read, const char *thing, const char *begin_field, double begin,
                         const char *end_field, double end, Source source)
{
    if (end > begin || begin >= 1e19) return;
    diagnostics_add(read->cards->diagnostics, SEVERITY_WARNING, source, read->cards->block->keyword,
                    "%s = %g is not after %s = %g: this %s never acts; correct them or remove it", end_field, end,
                    begin_field, begin, thing);
}
