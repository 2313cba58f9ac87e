/* Arithmetic expressions: a recursive-descent evaluator with bounded depth. */
#include "io/expression.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "io/number.h"

enum {
    DEEPEST = 100, /* nesting of parentheses, signs and powers */
    MOST_ARGUMENTS = 16,
    LONGEST_QUOTE = 20, /* characters of the text quoted in messages */
};

static const double largest_integer = 9007199254740992.0; /* 2^53 */

typedef struct Evaluator {
    const char *text;
    size_t length, at;
    int depth;
    bool truncated; /* an integer division had a remainder */
    ExpressionLookup *lookup;
    const void *context;
    char *message;
    size_t message_length;
} Evaluator;

static int evaluate_sum(Evaluator *e, ExpressionValue *value);

/* Reports what is wrong at the current place; always -1. */
static int fail_at(Evaluator *e, const char *what)
{
    size_t left = e->length - e->at;
    int quoted = left < LONGEST_QUOTE ? (int)left : LONGEST_QUOTE;
    if (left == 0) {
        snprintf(e->message, e->message_length, "%s at its end", what);
    } else {
        snprintf(e->message, e->message_length, "%s at '%.*s'", what, quoted, e->text + e->at);
    }
    return -1;
}

static char peek(Evaluator *e)
{
    while (e->at < e->length && (e->text[e->at] == ' ' || e->text[e->at] == '\t')) e->at++;
    return e->at < e->length ? e->text[e->at] : '\0';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/* Keeps integers exact: what is too large becomes an error, not a rounded integer. */
static int set_value(Evaluator *e, double number, bool is_integer, ExpressionValue *value)
{
    if (!isfinite(number)) return fail_at(e, "a value that is not a finite number");
    if (is_integer && fabs(number) > largest_integer) return fail_at(e, "an integer beyond 2^53");
    *value = (ExpressionValue){.value = number, .is_integer = is_integer};
    return 0;
}

static int evaluate_number(Evaluator *e, ExpressionValue *value)
{
    size_t start = e->at;
    bool is_integer = true;
    while (e->at < e->length && (is_digit(e->text[e->at]) || e->text[e->at] == '.')) {
        if (e->text[e->at] == '.') is_integer = false;
        e->at++;
    }
    /* Only a letter starts an exponent here: 1.5-3 is a difference. */
    char letter = e->at < e->length ? e->text[e->at] : ' ';
    if (letter == 'e' || letter == 'E' || letter == 'd' || letter == 'D') {
        size_t after = e->at + 1;
        if (after < e->length && (e->text[after] == '+' || e->text[after] == '-')) after++;
        if (after < e->length && is_digit(e->text[after])) {
            while (after < e->length && is_digit(e->text[after])) after++;
            e->at = after;
            is_integer = false;
        }
    }
    double number = 0;
    if (number_parse(e->text + start, e->at - start, &number) != NUMBER_FINE) {
        e->at = start;
        return fail_at(e, "a malformed number");
    }
    return set_value(e, number, is_integer, value);
}

typedef enum Function {
    FUNCTION_SIN,
    FUNCTION_COS,
    FUNCTION_TAN,
    FUNCTION_CSC,
    FUNCTION_SEC,
    FUNCTION_CTN,
    FUNCTION_ASIN,
    FUNCTION_ACOS,
    FUNCTION_ATAN,
    FUNCTION_SINH,
    FUNCTION_COSH,
    FUNCTION_TANH,
    FUNCTION_ASINH,
    FUNCTION_ACOSH,
    FUNCTION_ATANH,
    FUNCTION_EXP,
    FUNCTION_LOG,
    FUNCTION_LOG10,
    FUNCTION_SQRT,
    FUNCTION_FLOAT,
    FUNCTION_ABS,
    FUNCTION_INT,
    FUNCTION_AINT,
    FUNCTION_NINT,
    FUNCTION_ANINT,
    FUNCTION_ATAN2,
    FUNCTION_MOD,
    FUNCTION_SIGN,
    FUNCTION_MIN,
    FUNCTION_MAX
} Function;

static const struct FunctionName {
    const char *name;
    Function function;
    int least, most; /* arguments */
} function_names[] = {
    {"sin", FUNCTION_SIN, 1, 1},
    {"cos", FUNCTION_COS, 1, 1},
    {"tan", FUNCTION_TAN, 1, 1},
    {"csc", FUNCTION_CSC, 1, 1},
    {"sec", FUNCTION_SEC, 1, 1},
    {"ctn", FUNCTION_CTN, 1, 1},
    {"asin", FUNCTION_ASIN, 1, 1},
    {"acos", FUNCTION_ACOS, 1, 1},
    {"atan", FUNCTION_ATAN, 1, 1},
    {"sinh", FUNCTION_SINH, 1, 1},
    {"cosh", FUNCTION_COSH, 1, 1},
    {"tanh", FUNCTION_TANH, 1, 1},
    {"asinh", FUNCTION_ASINH, 1, 1},
    {"acosh", FUNCTION_ACOSH, 1, 1},
    {"atanh", FUNCTION_ATANH, 1, 1},
    {"exp", FUNCTION_EXP, 1, 1},
    {"log", FUNCTION_LOG, 1, 1},
    {"ln", FUNCTION_LOG, 1, 1},
    {"log10", FUNCTION_LOG10, 1, 1},
    {"sqrt", FUNCTION_SQRT, 1, 1},
    {"float", FUNCTION_FLOAT, 1, 1},
    {"real", FUNCTION_FLOAT, 1, 1},
    {"ls_real", FUNCTION_FLOAT, 1, 1},
    {"ls_integer", FUNCTION_INT, 1, 1},
    {"abs", FUNCTION_ABS, 1, 1},
    {"int", FUNCTION_INT, 1, 1},
    {"aint", FUNCTION_AINT, 1, 1},
    {"nint", FUNCTION_NINT, 1, 1},
    {"anint", FUNCTION_ANINT, 1, 1},
    {"atan2", FUNCTION_ATAN2, 2, 2},
    {"mod", FUNCTION_MOD, 2, 2},
    {"sign", FUNCTION_SIGN, 2, 2},
    {"min", FUNCTION_MIN, 1, MOST_ARGUMENTS},
    {"max", FUNCTION_MAX, 1, MOST_ARGUMENTS},
};

static double apply_real_function(Function function, double x, double y)
{
    switch (function) {
    case FUNCTION_SIN:
        return sin(x);
    case FUNCTION_COS:
        return cos(x);
    case FUNCTION_TAN:
        return tan(x);
    case FUNCTION_CSC:
        return 1 / sin(x);
    case FUNCTION_SEC:
        return 1 / cos(x);
    case FUNCTION_CTN:
        return 1 / tan(x);
    case FUNCTION_ASIN:
        return asin(x);
    case FUNCTION_ACOS:
        return acos(x);
    case FUNCTION_ATAN:
        return atan(x);
    case FUNCTION_SINH:
        return sinh(x);
    case FUNCTION_COSH:
        return cosh(x);
    case FUNCTION_TANH:
        return tanh(x);
    case FUNCTION_ASINH:
        return asinh(x);
    case FUNCTION_ACOSH:
        return acosh(x);
    case FUNCTION_ATANH:
        return atanh(x);
    case FUNCTION_EXP:
        return exp(x);
    case FUNCTION_LOG:
        return log(x);
    case FUNCTION_LOG10:
        return log10(x);
    case FUNCTION_SQRT:
        return sqrt(x);
    case FUNCTION_ABS:
        return fabs(x);
    case FUNCTION_INT:
    case FUNCTION_AINT:
        return trunc(x);
    case FUNCTION_NINT:
    case FUNCTION_ANINT:
        return round(x);
    case FUNCTION_ATAN2:
        return atan2(x, y);
    case FUNCTION_MOD:
        return fmod(x, y);
    case FUNCTION_SIGN:
        return copysign(fabs(x), y == 0 ? 1.0 : y);
    default:
        return x;
    }
}

static int apply_function(Evaluator *e, Function function, const ExpressionValue *arguments, int count,
                          ExpressionValue *value)
{
    bool integers = true;
    for (int i = 0; i < count; i++) integers = integers && arguments[i].is_integer;
    double result = arguments[0].value;
    if (function == FUNCTION_MIN || function == FUNCTION_MAX) {
        for (int i = 1; i < count; i++) {
            double other = arguments[i].value;
            if (function == FUNCTION_MIN ? other < result : other > result) result = other;
        }
        return set_value(e, result, integers, value);
    }
    result = apply_real_function(function, result, count > 1 ? arguments[1].value : 0);
    bool keeps_type = function == FUNCTION_ABS || function == FUNCTION_MOD || function == FUNCTION_SIGN;
    bool makes_integer = function == FUNCTION_INT || function == FUNCTION_NINT;
    return set_value(e, result, makes_integer || (keeps_type && integers), value);
}

/* The function named text[0 .. length), in any case; NULL if there is none. */
static const struct FunctionName *find_function(const char *text, size_t length)
{
    for (size_t i = 0; i < sizeof function_names / sizeof *function_names; i++) {
        const char *name = function_names[i].name;
        if (strlen(name) == length && strncasecmp(name, text, length) == 0) return &function_names[i];
    }
    return NULL;
}

/* The arguments and the value of a function, e->at on the opening parenthesis. */
static int evaluate_call(Evaluator *e, const struct FunctionName *entry, ExpressionValue *value)
{
    ExpressionValue arguments[MOST_ARGUMENTS];
    int count = 0;
    do {
        e->at++;
        if (count == entry->most) return fail_at(e, "too many arguments of a function");
        if (evaluate_sum(e, &arguments[count])) return -1;
        count++;
    } while (peek(e) == ',');
    if (peek(e) != ')') return fail_at(e, "a missing ')'");
    if (count < entry->least) return fail_at(e, "too few arguments of a function");
    e->at++;
    return apply_function(e, entry->function, arguments, count, value);
}

static int evaluate_name(Evaluator *e, ExpressionValue *value)
{
    bool marked = e->text[e->at] == '&';
    if (marked) e->at++;
    size_t start = e->at;
    while (e->at < e->length && (is_letter(e->text[e->at]) || is_digit(e->text[e->at]))) e->at++;
    const char *name = e->text + start;
    size_t length = e->at - start;
    if (length == 0) return fail_at(e, "a parameter's name missing");
    if (!marked && peek(e) == '(') {
        const struct FunctionName *entry = find_function(name, length);
        if (entry) return evaluate_call(e, entry, value);
        e->at = start;
        return fail_at(e, "an unknown function");
    }
    if (e->lookup && e->lookup(e->context, name, length, value, e->message, e->message_length) == 0) return 0;
    if (!marked && length == 2 && strncasecmp(name, "pi", 2) == 0) {
        return set_value(e, 3.14159265358979323846, false, value);
    }
    if (e->lookup) return -1;
    e->at = start;
    return fail_at(e, "an unknown name");
}

static int evaluate_primary(Evaluator *e, ExpressionValue *value)
{
    char c = peek(e);
    if (c == '(') {
        e->at++;
        if (evaluate_sum(e, value)) return -1;
        if (peek(e) != ')') return fail_at(e, "a missing ')'");
        e->at++;
        return 0;
    }
    if (is_digit(c) || c == '.') return evaluate_number(e, value);
    if (is_letter(c) || c == '&') return evaluate_name(e, value);
    return fail_at(e, "a missing number, name or '('");
}

/* base ** exponent: an integer only if both are and the exponent is not negative; Fortran's 2 ** (-1) = 0 helps nobody.
 */
static int apply_power(Evaluator *e, ExpressionValue base, ExpressionValue exponent, ExpressionValue *value)
{
    bool integers = base.is_integer && exponent.is_integer && exponent.value >= 0;
    return set_value(e, pow(base.value, exponent.value), integers, value);
}

/* A sign binds weaker than a power: -2**2 is -4, and 2**-1 is allowed. */
static int evaluate_factor(Evaluator *e, ExpressionValue *value)
{
    if (++e->depth > DEEPEST) return fail_at(e, "more than 100 levels of nesting");
    int status;
    char c = peek(e);
    if (c == '-' || c == '+') {
        e->at++;
        status = evaluate_factor(e, value);
        if (status == 0 && c == '-') value->value = -value->value;
    } else {
        status = evaluate_primary(e, value);
        c = status == 0 ? peek(e) : '\0';
        bool stars = c == '*' && e->at + 1 < e->length && e->text[e->at + 1] == '*';
        if (c == '^' || stars) {
            e->at += stars ? 2 : 1;
            ExpressionValue exponent;
            status = evaluate_factor(e, &exponent);
            if (status == 0) status = apply_power(e, *value, exponent, value);
        }
    }
    e->depth--;
    return status;
}

static int evaluate_product(Evaluator *e, ExpressionValue *value)
{
    if (evaluate_factor(e, value)) return -1;
    for (char c = peek(e); c == '*' || c == '/'; c = peek(e)) {
        e->at++;
        ExpressionValue right;
        if (evaluate_factor(e, &right)) return -1;
        bool integers = value->is_integer && right.is_integer;
        if (c == '/' && right.value == 0) return fail_at(e, "a division by zero");
        double result = c == '*' ? value->value * right.value : value->value / right.value;
        if (integers && result != trunc(result)) e->truncated = true;
        if (set_value(e, integers ? trunc(result) : result, integers, value)) return -1;
    }
    return 0;
}

static int evaluate_sum(Evaluator *e, ExpressionValue *value)
{
    if (evaluate_product(e, value)) return -1;
    for (char c = peek(e); c == '+' || c == '-'; c = peek(e)) {
        e->at++;
        ExpressionValue right;
        if (evaluate_product(e, &right)) return -1;
        double result = c == '+' ? value->value + right.value : value->value - right.value;
        if (set_value(e, result, value->is_integer && right.is_integer, value)) return -1;
    }
    return 0;
}

int expression_evaluate(const char *text, size_t length, ExpressionLookup *lookup, const void *context,
                        ExpressionValue *value, char *message, size_t message_length)
{
    Evaluator e = {.text = text,
                   .length = length,
                   .lookup = lookup,
                   .context = context,
                   .message = message,
                   .message_length = message_length};
    if (evaluate_sum(&e, value)) return -1;
    if (peek(&e) != '\0') return fail_at(&e, "something that is no operator");
    value->truncated = e.truncated;
    return 0;
}
