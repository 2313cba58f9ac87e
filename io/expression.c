/* The grammar of expressions: recursive descent with bounded depth. */
#include "io/expression.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "io/expression_parser.h"
#include "io/function_code.h"
#include "io/number.h"

enum {
    DEEPEST = 100,      /* nesting of parentheses, signs and powers */
    LONGEST_QUOTE = 20, /* characters of the text quoted in messages */
};

int expression_fail(ExpressionParser *p, const char *what)
{
    size_t left = p->length - p->at;
    int quoted = left < LONGEST_QUOTE ? (int)left : LONGEST_QUOTE;
    for (int i = 0; i < quoted; i++)
        if (p->text[p->at + (size_t)i] == '\n') quoted = i;
    if (left == 0) {
        snprintf(p->message, p->message_length, "%s at its end", what);
    } else {
        snprintf(p->message, p->message_length, "%s at '%.*s'", what, quoted, p->text + p->at);
    }
    return -1;
}

char expression_peek(ExpressionParser *p)
{
    while (p->at < p->length) {
        char c = p->text[p->at];
        if (c != ' ' && c != '\t' && (c != '\n' || p->line_ends)) return c;
        p->at++;
    }
    return '\0';
}

bool expression_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool expression_is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool expression_take(ExpressionParser *p, const char *characters)
{
    size_t count = strlen(characters);
    expression_peek(p);
    if (p->length - p->at < count || strncasecmp(p->text + p->at, characters, count) != 0) return false;
    p->at += count;
    return true;
}

bool expression_take_word(ExpressionParser *p, const char *word)
{
    size_t start = p->at;
    if (!expression_take(p, word)) return false;
    char next = p->at < p->length ? p->text[p->at] : ' ';
    if (!expression_is_letter(next) && !expression_is_digit(next)) return true;
    p->at = start;
    return false;
}

/* Whether the point at p->at begins an operator like .eq. and so ends the number before it. */
static bool at_dotted_operator(const ExpressionParser *p)
{
    size_t end = p->at + 1;
    while (end < p->length && expression_is_letter(p->text[end])) end++;
    return p->code && end > p->at + 1 && end < p->length && p->text[end] == '.';
}

static int parse_number(ExpressionParser *p, ExpressionValue *value)
{
    size_t start = p->at;
    bool is_integer = true;
    while (p->at < p->length && (expression_is_digit(p->text[p->at]) || p->text[p->at] == '.')) {
        if (p->text[p->at] == '.' && at_dotted_operator(p)) break;
        if (p->text[p->at] == '.') is_integer = false;
        p->at++;
    }
    /* Only a letter starts an exponent here: 1.5-3 is a difference. */
    char letter = p->at < p->length ? p->text[p->at] : ' ';
    if (letter == 'e' || letter == 'E' || letter == 'd' || letter == 'D') {
        size_t after = p->at + 1;
        if (after < p->length && (p->text[after] == '+' || p->text[after] == '-')) after++;
        if (after < p->length && expression_is_digit(p->text[after])) {
            while (after < p->length && expression_is_digit(p->text[after])) after++;
            p->at = after;
            is_integer = false;
        }
    }
    double number = 0;
    if (number_parse(p->text + start, p->at - start, &number) != NUMBER_FINE) {
        p->at = start;
        return expression_fail(p, "a malformed number");
    }
    if (p->code && p->at < p->length && (p->text[p->at] == 'f' || p->text[p->at] == 'F')) p->at++; /* C's 1.5f */
    return expression_apply_number(p, number, is_integer, value);
}

/* The arguments and the value of a function, p->at on the opening parenthesis. */
static int parse_call(ExpressionParser *p, int builtin, ExpressionValue *value)
{
    const FunctionBuiltin *entry = function_builtin(builtin);
    ExpressionValue arguments[BILLOW_MOST_ARGUMENTS];
    int count = 0;
    do {
        p->at++;
        if (count == entry->most) return expression_fail(p, "too many arguments of a function");
        if (expression_parse(p, &arguments[count])) return -1;
        count++;
    } while (expression_peek(p) == ',');
    if (expression_peek(p) != ')') return expression_fail(p, "a missing ')'");
    if (count < entry->least) return expression_fail(p, "too few arguments of a function");
    p->at++;
    return expression_apply_builtin(p, builtin, arguments, count, value);
}

static int parse_parameter(ExpressionParser *p, const char *name, size_t length, ExpressionValue *value)
{
    if (p->lookup(p->context, name, length, value, p->message, p->message_length)) return -1;
    return p->code ? expression_apply_number(p, value->value, value->is_integer, value) : 0;
}

static int parse_name(ExpressionParser *p, ExpressionValue *value)
{
    bool marked = p->text[p->at] == '&';
    if (marked) p->at++;
    size_t start = p->at;
    while (p->at < p->length && (expression_is_letter(p->text[p->at]) || expression_is_digit(p->text[p->at]))) p->at++;
    const char *name = p->text + start;
    size_t length = p->at - start;
    if (length == 0) return expression_fail(p, "a parameter's name missing");
    if (!marked && p->code) {
        int status = function_code_name(p->code, p, name, length, value);
        if (status <= 0) return status;
    }
    if (!marked && expression_peek(p) == '(') {
        int builtin = function_builtin_find(name, length);
        if (builtin >= 0 && (p->code || function_builtin(builtin)->scope == BUILTIN_EVERYWHERE))
            return parse_call(p, builtin, value);
        p->at = start;
        return expression_fail(p, "an unknown function");
    }
    if (p->lookup && (marked || !p->code)) {
        if (parse_parameter(p, name, length, value) == 0) return 0;
        if (marked || length != 2 || strncasecmp(name, "pi", 2) != 0) return -1;
    }
    if (!marked && length == 2 && strncasecmp(name, "pi", 2) == 0) {
        bool all_real = p->all_real;
        p->all_real = true;
        int status = expression_apply_number(p, 3.14159265358979323846, false, value);
        p->all_real = all_real;
        return status;
    }
    p->at = start;
    return expression_fail(p, "an unknown name");
}

/* (int) or (float) before a factor, as C casts. */
static bool take_cast(ExpressionParser *p, bool *to_integer)
{
    size_t start = p->at;
    if (p->code && expression_take(p, "(")) {
        *to_integer = expression_take_word(p, "int");
        if ((*to_integer || expression_take_word(p, "float") || expression_take_word(p, "double")) &&
            expression_take(p, ")"))
            return true;
    }
    p->at = start;
    return false;
}

static int parse_factor(ExpressionParser *p, ExpressionValue *value);

static int parse_primary(ExpressionParser *p, ExpressionValue *value)
{
    char c = expression_peek(p);
    bool to_integer = false;
    if (take_cast(p, &to_integer)) {
        if (parse_factor(p, value)) return -1;
        if (to_integer) return expression_apply_unary(p, OPERATION_TRUNCATE, value);
        value->is_integer = false;
        return 0;
    }
    if (c == '(') {
        p->at++;
        if (expression_parse(p, value)) return -1;
        if (expression_peek(p) != ')') return expression_fail(p, "a missing ')'");
        p->at++;
        return 0;
    }
    if (expression_is_digit(c) || c == '.') return parse_number(p, value);
    if (expression_is_letter(c) || c == '&') return parse_name(p, value);
    return expression_fail(p, "a missing number, name or '('");
}

/* A sign binds weaker than a power: -2**2 is -4, and 2**-1 is allowed. C's ! binds like a sign. */
static int parse_factor(ExpressionParser *p, ExpressionValue *value)
{
    if (++p->depth > DEEPEST) return expression_fail(p, "more than 100 levels of nesting");
    int status;
    char c = expression_peek(p);
    if (c == '-' || c == '+' || (p->code && c == '!')) {
        p->at++;
        status = parse_factor(p, value);
        if (status == 0 && c != '+')
            status = expression_apply_unary(p, c == '-' ? OPERATION_NEGATE : OPERATION_NOT, value);
    } else {
        status = parse_primary(p, value);
        c = status == 0 ? expression_peek(p) : '\0';
        bool stars = c == '*' && p->at + 1 < p->length && p->text[p->at + 1] == '*';
        if (c == '^' || stars) {
            p->at += stars ? 2 : 1;
            ExpressionValue exponent;
            status = parse_factor(p, &exponent);
            if (status == 0) status = expression_apply_binary(p, OPERATION_POWER, value, exponent);
        }
    }
    p->depth--;
    return status;
}

static int parse_product(ExpressionParser *p, ExpressionValue *value)
{
    if (parse_factor(p, value)) return -1;
    for (char c = expression_peek(p); c == '*' || c == '/' || (p->code && c == '%'); c = expression_peek(p)) {
        if (p->code && p->at + 1 < p->length && p->text[p->at + 1] == '=') return 0; /* Fortran's /= */
        p->at++;
        ExpressionValue right;
        if (parse_factor(p, &right)) return -1;
        ExpressionValue pair[2] = {*value, right};
        int status = c == '%'
                         ? expression_apply_builtin(p, function_builtin_find("mod", 3), pair, 2, value)
                         : expression_apply_binary(p, c == '*' ? OPERATION_MULTIPLY : OPERATION_DIVIDE, value, right);
        if (status) return -1;
    }
    return 0;
}

static int parse_sum(ExpressionParser *p, ExpressionValue *value)
{
    if (parse_product(p, value)) return -1;
    for (char c = expression_peek(p); c == '+' || c == '-'; c = expression_peek(p)) {
        p->at++;
        ExpressionValue right;
        if (parse_product(p, &right)) return -1;
        if (expression_apply_binary(p, c == '+' ? OPERATION_ADD : OPERATION_SUBTRACT, value, right)) return -1;
    }
    return 0;
}

/* The comparison that comes next, taken; -1 if there is none. */
static int take_comparison(ExpressionParser *p)
{
    static const struct {
        const char *spelling;
        FunctionOperation operation;
    } comparisons[] = {
        {"<=", OPERATION_LESS_EQUAL}, {">=", OPERATION_GREATER_EQUAL}, {"==", OPERATION_EQUAL},
        {"!=", OPERATION_NOT_EQUAL},  {"/=", OPERATION_NOT_EQUAL},     {"<", OPERATION_LESS},
        {">", OPERATION_GREATER},     {".le.", OPERATION_LESS_EQUAL},  {".ge.", OPERATION_GREATER_EQUAL},
        {".eq.", OPERATION_EQUAL},    {".ne.", OPERATION_NOT_EQUAL},   {".lt.", OPERATION_LESS},
        {".gt.", OPERATION_GREATER},
    };
    for (size_t i = 0; i < sizeof comparisons / sizeof *comparisons; i++)
        if (expression_take(p, comparisons[i].spelling)) return (int)comparisons[i].operation;
    return -1;
}

/* A comparison, or Fortran's .not. of one. */
static int parse_comparison(ExpressionParser *p, ExpressionValue *value)
{
    if (expression_take(p, ".not.")) {
        if (++p->depth > DEEPEST) return expression_fail(p, "more than 100 levels of nesting");
        int status = parse_comparison(p, value);
        p->depth--;
        return status ? -1 : expression_apply_unary(p, OPERATION_NOT, value);
    }
    if (parse_sum(p, value)) return -1;
    for (int operation = take_comparison(p); operation >= 0; operation = take_comparison(p)) {
        ExpressionValue right;
        if (parse_sum(p, &right)) return -1;
        if (expression_apply_binary(p, (FunctionOperation)operation, value, right)) return -1;
    }
    return 0;
}

static int parse_and(ExpressionParser *p, ExpressionValue *value)
{
    if (parse_comparison(p, value)) return -1;
    while (expression_take(p, "&&") || expression_take(p, ".and.")) {
        ExpressionValue right;
        if (parse_comparison(p, &right) || expression_apply_binary(p, OPERATION_AND, value, right)) return -1;
    }
    return 0;
}

static int parse_or(ExpressionParser *p, ExpressionValue *value)
{
    if (parse_and(p, value)) return -1;
    while (expression_take(p, "||") || expression_take(p, ".or.")) {
        ExpressionValue right;
        if (parse_and(p, &right) || expression_apply_binary(p, OPERATION_OR, value, right)) return -1;
    }
    return 0;
}

int expression_parse(ExpressionParser *p, ExpressionValue *value)
{
    if (!p->code) return parse_sum(p, value);
    if (++p->depth > DEEPEST) return expression_fail(p, "more than 100 levels of nesting");
    int status = parse_or(p, value);
    if (status == 0 && expression_take(p, "?")) {
        ExpressionValue first, second;
        status = expression_parse(p, &first);
        if (status == 0 && !expression_take(p, ":")) status = expression_fail(p, "a missing ':'");
        if (status == 0) status = expression_parse(p, &second);
        if (status == 0) status = expression_apply_select(p, first, second, value);
    }
    p->depth--;
    return status;
}

int expression_evaluate(const char *text, size_t length, ExpressionLookup *lookup, const void *context,
                        ExpressionValue *value, char *message, size_t message_length)
{
    ExpressionParser p = {.text = text,
                          .length = length,
                          .lookup = lookup,
                          .context = context,
                          .message = message,
                          .message_length = message_length};
    if (expression_parse(&p, value)) return -1;
    if (expression_peek(&p) != '\0') return expression_fail(&p, "something that is no operator");
    value->truncated = p.truncated;
    return 0;
}
