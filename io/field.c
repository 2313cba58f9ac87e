/* One line cut into its fields, by columns or by commas. */
#include "io/field.h"

#include <string.h>

/* Place of the first comma outside <...> in text[at .. end), or end. */
static size_t find_comma(const char *text, size_t at, size_t end)
{
    bool quoted = false; /* within an expression */
    for (; at < end; at++) {
        if (text[at] == '<') quoted = true;
        if (text[at] == '>') quoted = false;
        if (text[at] == ',' && !quoted) return at;
    }
    return end;
}

FieldCursor field_start(const char *line, size_t columns)
{
    FieldCursor cursor = {.line = line, .length = strlen(line)};
    size_t end = columns < cursor.length ? columns : cursor.length;
    /* the quick look first: most lines have no comma at all */
    cursor.free = memchr(line, ',', end) && find_comma(line, 0, end) < end;
    return cursor;
}

static Field trim_field(const char *line, size_t begin, size_t end)
{
    while (begin < end && (line[begin] == ' ' || line[begin] == '\t')) begin++;
    while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\t')) end--;
    return (Field){.text = line + begin, .length = end - begin};
}

Field field_next(FieldCursor *cursor, size_t columns)
{
    size_t begin = cursor->at < cursor->length ? cursor->at : cursor->length;
    cursor->taken++;
    if (cursor->free) {
        size_t end = find_comma(cursor->line, begin, cursor->length);
        Field field = trim_field(cursor->line, begin, end);
        field.first = field.last = (size_t)cursor->taken;
        cursor->at = end + 1;
        return field;
    }
    size_t end = cursor->length - begin < columns ? cursor->length : begin + columns;
    Field field = trim_field(cursor->line, begin, end);
    field.first = cursor->at + 1;
    field.last = cursor->at + columns;
    cursor->at += columns;
    return field;
}

Field field_rest(FieldCursor *cursor)
{
    size_t begin = cursor->at < cursor->length ? cursor->at : cursor->length;
    cursor->taken++;
    Field field = trim_field(cursor->line, begin, cursor->length);
    field.first = cursor->free ? (size_t)cursor->taken : cursor->at + 1;
    field.last = cursor->free ? field.first : field.first + (cursor->length - begin);
    cursor->at = cursor->length + 1;
    return field;
}
