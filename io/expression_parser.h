/* The one grammar of expressions, with two uses: *PARAMETER_EXPRESSION evaluates while it reads, the user's functions
 * are turned into programs (io/function_code.h). Private to io/expression*.c and io/function*.c. */
#ifndef BILLOW_EXPRESSION_PARSER_H
#define BILLOW_EXPRESSION_PARSER_H

#include "io/expression.h"
#include "solver/function.h"
#include "solver/function_builtin.h"

struct FunctionCode;

typedef struct ExpressionParser {
    const char *text;
    size_t length, at;
    int depth;
    bool truncated; /* an integer division had a remainder */
    ExpressionLookup *lookup;
    const void *context;
    char *message;
    size_t message_length;
    struct FunctionCode *code; /* NULL: evaluate at once; else emit instructions, values are types only */
    bool all_real;             /* numbers without a point are real as well */
    bool line_ends;            /* a line's end is no blank (Fortran) */
} ExpressionParser;

/* Reads a sum, or with code a whole logical expression with comparisons, && || ! and ?:. */
int expression_parse(ExpressionParser *p, ExpressionValue *value);

/* The next character that is no blank, without taking it; 0 at the end. */
char expression_peek(ExpressionParser *p);

/* Takes the word if it is next, in any case; a letter or digit after it would make it another word. */
bool expression_take_word(ExpressionParser *p, const char *word);

/* Takes the characters if they are next. */
bool expression_take(ExpressionParser *p, const char *characters);

bool expression_is_letter(char c);
bool expression_is_digit(char c);

/* Reports what is wrong at the current place; always -1. */
int expression_fail(ExpressionParser *p, const char *what);

/* --- operations, evaluated or emitted (io/expression_operations.c) --- */
int expression_apply_number(ExpressionParser *p, double number, bool is_integer, ExpressionValue *value);
int expression_apply_unary(ExpressionParser *p, FunctionOperation operation, ExpressionValue *value);
/* left becomes left operation right */
int expression_apply_binary(ExpressionParser *p, FunctionOperation operation, ExpressionValue *left,
                            ExpressionValue right);
int expression_apply_select(ExpressionParser *p, ExpressionValue first, ExpressionValue second, ExpressionValue *value);
int expression_apply_builtin(ExpressionParser *p, int builtin, const ExpressionValue *arguments, int count,
                             ExpressionValue *value);

#endif
