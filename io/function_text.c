/* Texts of user's functions: comments, heads, arguments; statements are in io/function_statements_*.c. */
#include "io/function_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "solver/memory.h"

size_t function_read_name(ExpressionParser *p, const char **name)
{
    if (!expression_is_letter(expression_peek(p))) return 0;
    size_t start = p->at;
    while (p->at < p->length && (expression_is_letter(p->text[p->at]) || expression_is_digit(p->text[p->at]))) p->at++;
    *name = p->text + start;
    return p->at - start;
}

int function_emit(ExpressionParser *p, FunctionInstruction instruction, int operands)
{
    return function_code_emit(p->code, instruction, operands) ? expression_fail(p, p->code->trouble) : 0;
}

int function_jump(ExpressionParser *p, FunctionOperation operation, int target)
{
    int place = function_code_jump(p->code, operation, target);
    return place < 0 ? expression_fail(p, p->code->trouble) : place;
}

int function_assign(ExpressionParser *p, int variable)
{
    bool is_integer = p->code->variable[variable].is_integer;
    FunctionInstruction store = {.operation = is_integer ? OPERATION_STORE_INTEGER : OPERATION_STORE,
                                 .operand = variable};
    return function_emit(p, store, 1);
}

int function_store(ExpressionParser *p, int variable)
{
    ExpressionValue value;
    return expression_parse(p, &value) ? -1 : function_assign(p, variable);
}

int function_jump_unless(ExpressionParser *p)
{
    ExpressionValue value;
    if (expression_parse(p, &value)) return -1;
    return function_jump(p, OPERATION_JUMP_FALSE, 0);
}

/* Blanks over the comments of C, and of Fortran (! but not !=) if asked; lines stay where they are. */
static void blank_comments(char *text, size_t length, bool fortran)
{
    for (size_t i = 0; i + 1 < length; i++) {
        bool line = (text[i] == '/' && text[i + 1] == '/') || (fortran && text[i] == '!' && text[i + 1] != '=');
        bool block = text[i] == '/' && text[i + 1] == '*';
        if (!line && !block) continue;
        size_t end = i;
        while (end < length && !(line && text[end] == '\n') &&
               !(block && end > i + 2 && text[end] == '/' && text[end - 1] == '*'))
            end++;
        if (block && end < length) end++;
        for (; i < end; i++)
            if (text[i] != '\n') text[i] = ' ';
        i--;
    }
}

/* An & before a line's end continues the line. */
static void join_continued(char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        size_t end = i + 1;
        if (text[i] != '&') continue;
        while (end < length && (text[end] == ' ' || text[end] == '\t')) end++;
        if (end < length && text[end] == '\n') text[i] = text[end] = ' ';
    }
}

static bool take_type(ExpressionParser *p, bool *is_integer)
{
    static const char *const reals[] = {"float", "double", "real"};
    static const char *const integers[] = {"int", "long", "integer"};
    bool found = false;
    *is_integer = false;
    while (expression_take_word(p, "const") || expression_take_word(p, "static")) continue;
    for (size_t i = 0; i < 3; i++) {
        if (expression_take_word(p, reals[i])) found = true;
        if (expression_take_word(p, integers[i])) found = *is_integer = true;
    }
    expression_take_word(p, "precision");
    return found;
}

/* Fortran's rule for names without a type: i to n are integers. */
static bool implied_integer(const char *name)
{
    return strchr("ijklmnIJKLMN", name[0]) != NULL;
}

/* (type a, type b): arguments are variables that start with the inputs. */
static int parse_arguments(ExpressionParser *p, bool fortran)
{
    FunctionProgram *program = p->code->program;
    if (!expression_take(p, "(")) return expression_fail(p, "a missing '('");
    if (expression_take(p, ")")) return 0;
    do {
        const char *name;
        bool is_integer = false;
        bool typed = take_type(p, &is_integer);
        size_t length = function_read_name(p, &name);
        if (length == 0) return expression_fail(p, "a missing name of an argument");
        if (fortran && !typed) is_integer = implied_integer(name);
        int variable = function_code_declare(p->code, name, length, is_integer);
        if (variable < 0) return expression_fail(p, p->code->trouble);
        int number = program->input_count;
        if (number == BILLOW_FUNCTION_INPUTS) return expression_fail(p, "more than 32 arguments");
        program->input[number] = (FunctionInput){.kind = INPUT_ARGUMENT, .component = number, .index = {-1, -1}};
        program->argument_count = ++program->input_count;
        if (function_emit(p, (FunctionInstruction){.operation = OPERATION_INPUT, .operand = number}, 0)) return -1;
        if (function_assign(p, variable)) return -1;
    } while (expression_take(p, ","));
    return expression_take(p, ")") ? 0 : expression_fail(p, "a missing ')'");
}

static int parse_value(ExpressionParser *p)
{
    ExpressionValue value;
    if (expression_parse(p, &value)) return -1;
    return function_emit(p, (FunctionInstruction){.operation = OPERATION_RETURN}, 1);
}

/* A function that ends without a value has none: the run says so when it happens. */
static int end_without_value(ExpressionParser *p)
{
    if (function_emit(p, (FunctionInstruction){.operation = OPERATION_CONSTANT, .constant = NAN}, 0)) return -1;
    return function_emit(p, (FunctionInstruction){.operation = OPERATION_RETURN}, 1);
}

static int parse_fortran(ExpressionParser *p)
{
    bool is_integer = false, typed = take_type(p, &is_integer);
    const char *name;
    if (!expression_take_word(p, "function")) return expression_fail(p, "a missing word 'function'");
    size_t length = function_read_name(p, &name);
    if (length == 0) return expression_fail(p, "a missing name of the function");
    int result = function_code_declare(p->code, name, length, typed ? is_integer : implied_integer(name));
    if (result < 0) return expression_fail(p, p->code->trouble);
    if (parse_arguments(p, true)) return -1;
    return function_parse_fortran_body(p, result);
}

/* type name(arguments) { statements }, or name(arguments) = expression. */
static int parse_c(ExpressionParser *p)
{
    bool is_integer;
    take_type(p, &is_integer);
    const char *name;
    if (function_read_name(p, &name) == 0) return expression_fail(p, "a missing name of the function");
    if (parse_arguments(p, false)) return -1;
    if (expression_take(p, "=")) return parse_value(p);
    if (!expression_take(p, "{")) return expression_fail(p, "a missing '{'");
    if (function_parse_c_body(p)) return -1;
    return end_without_value(p);
}

static bool in_word(char c)
{
    return expression_is_letter(c) || expression_is_digit(c);
}

/* The word function before the first parenthesis. */
static bool is_fortran(const char *text, size_t length)
{
    for (size_t i = 0; i + 8 < length && text[i] != '(' && text[i] != '='; i++)
        if (strncasecmp(text + i, "function", 8) == 0 && (i == 0 || !in_word(text[i - 1])) && !in_word(text[i + 8]))
            return true;
    return false;
}

static int compile(ExpressionParser *p, bool is_curve)
{
    int status = is_curve ? parse_value(p) : p->line_ends ? parse_fortran(p) : parse_c(p);
    if (status) return -1;
    p->line_ends = false;
    return expression_peek(p) == '\0' ? 0 : expression_fail(p, "something after the end of the function");
}

int function_compile(const char *text, size_t length, bool is_curve, ExpressionLookup *lookup, const void *context,
                     FunctionProgram *program, FunctionTrouble *trouble)
{
    char *copy = memory_alloc(length + 1, 1);
    FunctionCode *code = memory_alloc(1, sizeof *code);
    int status = -1;
    snprintf(trouble->message, sizeof trouble->message, "no memory left");
    trouble->line = 0;
    *program = (FunctionProgram){0};
    if (copy && code) {
        memcpy(copy, text, length);
        bool fortran = !is_curve && is_fortran(text, length);
        blank_comments(copy, length, fortran);
        if (fortran) join_continued(copy, length);
        code->program = program;
        code->quantities = is_curve;
        ExpressionParser p = {.text = copy,
                              .length = length,
                              .lookup = lookup,
                              .context = context,
                              .message = trouble->message,
                              .message_length = sizeof trouble->message,
                              .code = code,
                              .all_real = is_curve,
                              .line_ends = fortran};
        status = compile(&p, is_curve);
        for (size_t i = 0; i < p.at && i < length; i++) trouble->line += copy[i] == '\n';
    }
    memory_free(copy);
    memory_free(code);
    if (status == 0) return 0;
    memory_free(program->code);
    program->code = NULL;
    return -1;
}
