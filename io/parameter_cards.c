/* The cards of *PARAMETER, *PARAMETER_EXPRESSION and *PARAMETER_DUPLICATION. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/field.h"
#include "io/number.h"
#include "io/parameters.h"
#include "solver/memory.h"

enum {
    LONGEST_EXPRESSION = 20000, /* characters, continuation lines included */
    NAME_COLUMNS = 10,
    LONG_FORMAT_COLUMNS = 20,
    MESSAGE_LENGTH = 240,
};

/* One block of parameter cards being read. */
typedef struct ParameterReading {
    Parameters *parameters;
    const DeckBlock *block;
    Diagnostics *diagnostics;
    bool local, changeable;
    size_t columns; /* of a field */
} ParameterReading;

static void report(const ParameterReading *r, Source source, const char *what, const char *text, size_t length)
{
    int shown = length < 60 ? (int)length : 60;
    diagnostics_add(r->diagnostics, SEVERITY_ERROR, source, r->block->keyword, "'%.*s' %s", shown, text, what);
}

static char upper_case(char c)
{
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

static bool is_name(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        char c = upper_case(text[i]);
        bool digit = c >= '0' && c <= '9';
        if (!(c >= 'A' && c <= 'Z') && c != '_' && !(digit && i > 0)) return false;
    }
    return length > 0;
}

/* Takes "Rname" or "R name" apart; false after an error. */
static bool read_name(const ParameterReading *r, Source source, Field field, Parameter *parameter)
{
    *parameter = (Parameter){.local = r->local,
                             .changeable = r->changeable,
                             .order = r->block->order,
                             .scope = r->block->scope,
                             .source = source,
                             .type = upper_case(field.text[0])};
    if (parameter->type != 'R' && parameter->type != 'I' && parameter->type != 'C') {
        report(r, source, "must begin with R, I or C, the parameter's type, and then its name", field.text,
               field.length);
        return false;
    }
    const char *name = field.text + 1;
    size_t length = field.length - 1;
    while (length > 0 && *name == ' ') {
        name++;
        length--;
    }
    if (!is_name(name, length) || length >= BILLOW_PARAMETER_NAME_LENGTH) {
        report(r, source, "holds no name of letters, digits and _ behind the type's letter", field.text, field.length);
        return false;
    }
    memcpy(parameter->name, name, length);
    return true;
}

/* Stores a number in a parameter of type R or I; false after an error. */
static bool set_number(const ParameterReading *r, Parameter *parameter, double value, Field field, bool round_off)
{
    if (parameter->type == 'I' && value != floor(value)) {
        if (!round_off) {
            report(r, parameter->source, "is no whole number, but the parameter's type is I", field.text, field.length);
            return false;
        }
        value = trunc(value); /* as Fortran assigns a real result to an integer */
    }
    parameter->value = value;
    return true;
}

static bool set_text(const ParameterReading *r, Parameter *parameter, Field field)
{
    parameter->text = memory_alloc(field.length + 1, 1);
    if (!parameter->text) {
        diagnostics_add(r->diagnostics, SEVERITY_ENVIRONMENT, parameter->source, r->block->keyword, "no memory left");
        return false;
    }
    memcpy(parameter->text, field.text, field.length);
    return true;
}

static void warn_of_truncation(const ParameterReading *r, Source source, const char *text, size_t length)
{
    int shown = length < 60 ? (int)length : 60;
    diagnostics_add(r->diagnostics, SEVERITY_WARNING, source, r->block->keyword,
                    "'%.*s' divides integers and loses a remainder; write 7./2 for 3.5", shown, text);
}

/* A definition with an error still defines its name, lest every use of it be reported as well. */
static void define_failed(const ParameterReading *r, Parameter *parameter)
{
    parameter->type = '?';
    parameters_define(r->parameters, *parameter, r->block->keyword, r->diagnostics);
}

/* A value of *PARAMETER: a number, a text, another parameter or <expression>. False after an error. */
static bool read_value(const ParameterReading *r, Parameter *parameter, Field field)
{
    if (parameter->type == 'C') return set_text(r, parameter, field);
    if (field.length == 0) return true; /* a blank value is 0 */
    double number = 0;
    NumberStatus status = number_parse(field.text, field.length, &number);
    if (status == NUMBER_FINE) return set_number(r, parameter, number, field, false);
    if (status == NUMBER_TOO_LARGE || !memchr("&<-+", field.text[0], 4)) {
        report(r, parameter->source, "is not a number; is it in the wrong columns?", field.text, field.length);
        return false;
    }
    ExpressionValue value;
    char message[MESSAGE_LENGTH], what[MESSAGE_LENGTH + 40];
    if (parameters_evaluate(r->parameters, r->block, field.text, field.length, &value, message, sizeof message)) {
        snprintf(what, sizeof what, "cannot be evaluated: %s", message);
        if (message[0]) report(r, parameter->source, what, field.text, field.length);
        return false;
    }
    if (value.truncated) warn_of_truncation(r, parameter->source, field.text, field.length);
    return set_number(r, parameter, value.value, field, false);
}

/* *PARAMETER: pairs of name and value. */
static void read_values(ParameterReading *r)
{
    for (size_t i = 0; i < r->block->line_count; i++) {
        const DeckLine *line = &r->block->lines[i];
        FieldCursor cursor = field_start(line->text, BILLOW_WHOLE_LINE);
        while (cursor.at < cursor.length) {
            Field name = field_next(&cursor, r->columns);
            Field value = field_next(&cursor, r->columns);
            Parameter parameter;
            if (name.length == 0 && value.length == 0) continue;
            if (name.length == 0) {
                report(r, line->source, "has no parameter's name before it", value.text, value.length);
                break;
            }
            if (!read_name(r, line->source, name, &parameter)) break;
            if (!read_value(r, &parameter, value)) {
                define_failed(r, &parameter);
                break;
            }
            parameters_define(r->parameters, parameter, r->block->keyword, r->diagnostics);
        }
    }
}

/* Appends a continuation to the expression; false if that grows too long. */
static bool append_text(char *expression, size_t *length, Field part)
{
    if (*length + part.length + 2 > LONGEST_EXPRESSION) return false;
    if (*length > 0) expression[(*length)++] = ' ';
    memcpy(expression + *length, part.text, part.length);
    *length += part.length;
    return true;
}

static void define_expression(const ParameterReading *r, Parameter *parameter, const char *text, size_t length)
{
    Field field = {.text = text, .length = length};
    if (parameter->type == 'C') {
        if (set_text(r, parameter, field)) {
            parameters_define(r->parameters, *parameter, r->block->keyword, r->diagnostics);
        }
        return;
    }
    ExpressionValue value;
    char message[MESSAGE_LENGTH], what[MESSAGE_LENGTH + 40];
    if (parameters_evaluate_text(r->parameters, r->block, text, length, &value, message, sizeof message)) {
        snprintf(what, sizeof what, "cannot be evaluated: %s", message);
        if (message[0]) report(r, parameter->source, what, text, length);
        define_failed(r, parameter);
        return;
    }
    if (value.truncated) warn_of_truncation(r, parameter->source, text, length);
    if (set_number(r, parameter, value.value, field, true)) {
        parameters_define(r->parameters, *parameter, r->block->keyword, r->diagnostics);
    }
}

/* Name and first part of an expression: by columns, or a comma behind the name. */
static Field split_expression(const ParameterReading *r, const char *line, Field *name)
{
    FieldCursor cursor = field_start(line, r->columns + 1);
    *name = field_next(&cursor, r->columns);
    return field_rest(&cursor);
}

/* *PARAMETER_EXPRESSION: one a line; a line with a blank name goes on with the expression before. */
static void read_expressions(ParameterReading *r)
{
    char *expression = memory_alloc(LONGEST_EXPRESSION, 1);
    if (!expression) {
        diagnostics_add(r->diagnostics, SEVERITY_ENVIRONMENT, r->block->source, r->block->keyword, "no memory left");
        return;
    }
    const DeckBlock *block = r->block;
    for (size_t i = 0; i < block->line_count;) {
        const DeckLine *line = &block->lines[i];
        Field name, part = split_expression(r, line->text, &name);
        Parameter parameter;
        i++;
        if (name.length == 0 && part.length == 0) continue;
        if (name.length == 0) report(r, line->source, "has no parameter's name before it", part.text, part.length);
        bool fine = name.length > 0 && read_name(r, line->source, name, &parameter);
        size_t length = 0;
        bool fits = append_text(expression, &length, part);
        for (; i < block->line_count; i++) {
            part = split_expression(r, block->lines[i].text, &name);
            if (name.length > 0) break;
            fits = fits && append_text(expression, &length, part);
        }
        if (!fits) report(r, line->source, "begins an expression that is too long", line->text, strlen(line->text));
        if (fine && fits) define_expression(r, &parameter, expression, length);
    }
    memory_free(expression);
}

static void read_duplication(ParameterReading *r)
{
    if (r->block->line_count == 0) return;
    const DeckLine *line = &r->block->lines[0];
    FieldCursor cursor = field_start(line->text, BILLOW_WHOLE_LINE);
    Field field = field_next(&cursor, r->columns);
    double rule = DUPLICATE_WARN_KEEP;
    bool fine = field.length == 0 || number_parse(field.text, field.length, &rule) == NUMBER_FINE;
    if (rule == 0) rule = DUPLICATE_WARN_KEEP;
    if (!fine || rule != floor(rule) || rule < DUPLICATE_WARN_KEEP || rule > DUPLICATE_KEEP) {
        report(r, line->source, "is no DFLAG; it must be 1 to 5", field.text, field.length);
        return;
    }
    r->parameters->rule = (DuplicateRule)rule;
}

/* True if the keyword's text at *at goes on with _option; moves behind it. */
static bool take_option(const char **at, const char *option)
{
    size_t length = strlen(option);
    if (**at != '_' || strncmp(*at + 1, option, length) != 0) return false;
    char next = (*at)[1 + length];
    if (next != '\0' && next != '_') return false;
    *at += 1 + length;
    return true;
}

bool parameters_read_block(Parameters *parameters, const DeckBlock *block, Diagnostics *diagnostics)
{
    static const char stem[] = "*PARAMETER";
    if (strncmp(block->keyword, stem, sizeof stem - 1) != 0) return false;
    ParameterReading r = {.parameters = parameters,
                          .block = block,
                          .diagnostics = diagnostics,
                          .columns = block->wide ? LONG_FORMAT_COLUMNS : NAME_COLUMNS};
    const char *at = block->keyword + sizeof stem - 1;
    if (strcmp(at, "_DUPLICATION") == 0) {
        read_duplication(&r);
        return true;
    }
    bool expressions = false;
    while (*at) {
        if (take_option(&at, "EXPRESSION")) {
            expressions = true;
        } else if (take_option(&at, "LOCAL")) {
            r.local = true;
        } else if (take_option(&at, "MUTABLE")) {
            r.changeable = true;
        } else if (!take_option(&at, "NOECHO")) {
            return false;
        }
    }
    if (expressions) {
        read_expressions(&r);
    } else {
        read_values(&r);
    }
    return true;
}
