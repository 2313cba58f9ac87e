/* One line cut into its fields, by columns or by commas. */
#ifndef BILLOW_FIELD_H
#define BILLOW_FIELD_H

#include <stdbool.h>
#include <stddef.h>

/* A field without the blanks around it. */
typedef struct Field {
    const char *text;
    size_t length;
    size_t first, last; /* its columns, from 1; in free format both are its number in the line, from 1 */
} Field;

typedef struct FieldCursor {
    const char *line;
    size_t length; /* of the line */
    size_t at;     /* where the next field begins */
    int taken;     /* fields taken so far */
    bool free;     /* comma format */
} FieldCursor;

enum { BILLOW_WHOLE_LINE = 1000000 }; /* more columns than a line has */

/* At the line's first field. The line is in comma format if a comma, outside <...>, stands among its first columns
 * columns (the rest being text, in which commas are nothing special). */
FieldCursor field_start(const char *line, size_t columns);

/* Takes the next field, columns wide in fixed format. Beyond the line's end fields are empty. */
Field field_next(FieldCursor *cursor, size_t columns);

/* Takes all that is left of the line, commas and all, as one field. */
Field field_rest(FieldCursor *cursor);

#endif
