/* Arithmetic expressions of *PARAMETER_EXPRESSION and of <...> in data fields. */
#ifndef BILLOW_EXPRESSION_H
#define BILLOW_EXPRESSION_H

#include <stdbool.h>
#include <stddef.h>

/* An integer is held as a double of whole value not beyond 2^53. */
typedef struct ExpressionValue {
    double value;
    bool is_integer;
    bool truncated; /* an integer division in it had a remainder, which is lost: worth a warning */
} ExpressionValue;

/* Finds the value of a name (without the ampersand, not zero-terminated). Returns 0, or -1 after writing why not into
 * message. */
typedef int ExpressionLookup(const void *context, const char *name, size_t length, ExpressionValue *value,
                             char *message, size_t message_length);

/* Evaluates text[0 .. length). Operators + - * / and ** or ^ (right-associative, binding tighter than the sign),
 * parentheses, the functions of Fortran and C named in expression.c (angles in radians), the constant pi, numbers, and
 * names with or without & through lookup. As in Fortran an operation on two integers gives an integer: 7/2 is 3. An
 * integer to a negative power is real: 2**-1 is 0.5.
 * Returns 0, or -1 with what is wrong in message. The work is linear in length; nesting beyond 100 is refused. */
int expression_evaluate(const char *text, size_t length, ExpressionLookup *lookup, const void *context,
                        ExpressionValue *value, char *message, size_t message_length);

#endif
