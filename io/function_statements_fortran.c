/* Statements of *DEFINE_FUNCTION in Fortran's spelling: one a line. */
#include <string.h>
#include <strings.h>

#include "io/function_text.h"

enum { DEEPEST_BLOCK = 50 };

/* What ended a list of statements. */
typedef enum BlockEnd { END_FUNCTION, END_IF, END_DO, END_ELSE, END_ELSE_IF } BlockEnd;

static int parse_block(ExpressionParser *p, int result, int level, BlockEnd *end);
static int parse_simple(ExpressionParser *p, int result);

static void skip_lines(ExpressionParser *p)
{
    while (expression_peek(p) == '\n' || expression_peek(p) == ';') p->at++;
}

static int end_line(ExpressionParser *p)
{
    char c = expression_peek(p);
    return c == '\n' || c == ';' || c == '\0' ? 0 : expression_fail(p, "something after the end of a statement");
}

/* An assigned name without a declaration gets the type of its first letter. */
static int variable_of(ExpressionParser *p)
{
    const char *name;
    size_t length = function_read_name(p, &name);
    if (length == 0) return expression_fail(p, "a missing statement");
    int variable = function_code_find(p->code, name, length);
    if (variable < 0) variable = function_code_declare(p->code, name, length, strchr("ijklmnIJKLMN", name[0]) != NULL);
    return variable < 0 ? expression_fail(p, p->code->trouble) : variable;
}

static int return_value(ExpressionParser *p, int result)
{
    FunctionInstruction load = {.operation = OPERATION_LOAD, .operand = result};
    if (function_emit(p, load, 0)) return -1;
    return function_emit(p, (FunctionInstruction){.operation = OPERATION_RETURN}, 1);
}

/* real x, y: a name already known (an argument, the function) gets the type. */
static int parse_declaration(ExpressionParser *p, bool is_integer)
{
    if (expression_take(p, "*")) {
        while (expression_is_digit(expression_peek(p))) p->at++;
    }
    expression_take(p, "::");
    do {
        const char *name;
        size_t length = function_read_name(p, &name);
        if (length == 0) return expression_fail(p, "a missing name of a variable");
        int variable = function_code_find(p->code, name, length);
        if (variable < 0) variable = function_code_declare(p->code, name, length, is_integer);
        if (variable < 0) return expression_fail(p, p->code->trouble);
        p->code->variable[variable].is_integer = is_integer;
        if (expression_take(p, "=") && function_store(p, variable)) return -1;
    } while (expression_take(p, ","));
    return 0;
}

/* after if: (condition) then ... or (condition) statement */
static int parse_if(ExpressionParser *p, int result, int level)
{
    if (!expression_take(p, "(")) return expression_fail(p, "a missing '('");
    int skip = function_jump_unless(p);
    if (skip < 0) return -1;
    if (!expression_take(p, ")")) return expression_fail(p, "a missing ')'");
    if (!expression_take_word(p, "then")) {
        if (parse_simple(p, result)) return -1;
        function_code_land(p->code, skip);
        return 0;
    }
    BlockEnd end;
    if (parse_block(p, result, level + 1, &end)) return -1;
    if (end == END_IF) {
        function_code_land(p->code, skip);
        return 0;
    }
    if (end != END_ELSE && end != END_ELSE_IF) return expression_fail(p, "a missing 'end if'");
    int jump = function_jump(p, OPERATION_JUMP, 0);
    if (jump < 0) return -1;
    function_code_land(p->code, skip);
    if (level >= DEEPEST_BLOCK) return expression_fail(p, "more than 50 levels of blocks");
    if (end == END_ELSE_IF) {
        if (parse_if(p, result, level + 1)) return -1;
    } else if (parse_block(p, result, level + 1, &end)) {
        return -1;
    } else if (end != END_IF) {
        return expression_fail(p, "a missing 'end if'");
    }
    function_code_land(p->code, jump);
    return 0;
}

/* Pushes (variable - last) * step <= 0: the round is due. */
static int emit_due(ExpressionParser *p, int variable, int last, int step)
{
    const FunctionInstruction code[] = {{.operation = OPERATION_LOAD, .operand = variable},
                                        {.operation = OPERATION_LOAD, .operand = last},
                                        {.operation = OPERATION_SUBTRACT},
                                        {.operation = OPERATION_LOAD, .operand = step},
                                        {.operation = OPERATION_MULTIPLY},
                                        {.operation = OPERATION_CONSTANT, .constant = 0},
                                        {.operation = OPERATION_LESS_EQUAL}};
    static const int operands[] = {0, 0, 2, 0, 2, 0, 2};
    for (int i = 0; i < 7; i++)
        if (function_emit(p, code[i], operands[i])) return -1;
    return 0;
}

static int emit_step(ExpressionParser *p, int variable, int step)
{
    if (function_emit(p, (FunctionInstruction){.operation = OPERATION_LOAD, .operand = variable}, 0) ||
        function_emit(p, (FunctionInstruction){.operation = OPERATION_LOAD, .operand = step}, 0) ||
        function_emit(p, (FunctionInstruction){.operation = OPERATION_ADD}, 2))
        return -1;
    return function_assign(p, variable);
}

static int parse_rounds(ExpressionParser *p, int result, int level, FunctionLoop loop)
{
    BlockEnd end;
    if (parse_block(p, result, level + 1, &end)) return -1;
    if (end != END_DO) return expression_fail(p, "a missing 'end do'");
    function_code_land_leaves(p->code, loop, true);
    return 0;
}

/* do i = first, last[, step], or do while (condition) */
static int parse_do(ExpressionParser *p, int result, int level)
{
    FunctionLoop loop = function_code_open_loop(p->code);
    int variable = -1, step = -1, last = -1, start, skip;
    if (expression_take_word(p, "while")) {
        start = p->code->program->code_count;
        if ((skip = function_jump_unless(p)) < 0) return -1;
    } else {
        ExpressionValue one;
        if ((variable = variable_of(p)) < 0) return -1;
        bool is_integer = p->code->variable[variable].is_integer;
        if (!expression_take(p, "=") || function_store(p, variable)) return expression_fail(p, "a missing '='");
        if ((last = function_code_declare(p->code, "", 0, is_integer)) < 0 ||
            (step = function_code_declare(p->code, "", 0, is_integer)) < 0)
            return expression_fail(p, p->code->trouble);
        if (!expression_take(p, ",")) return expression_fail(p, "a missing ','");
        if (function_store(p, last)) return -1;
        if (expression_take(p, ",")) {
            if (function_store(p, step)) return -1;
        } else if (expression_apply_number(p, 1, true, &one) || function_assign(p, step)) {
            return -1;
        }
        start = p->code->program->code_count;
        if (emit_due(p, variable, last, step) || (skip = function_jump(p, OPERATION_JUMP_FALSE, 0)) < 0) return -1;
    }
    if (parse_rounds(p, result, level, loop)) return -1;
    if (variable >= 0 && emit_step(p, variable, step)) return -1;
    if (function_jump(p, OPERATION_JUMP, start) < 0) return -1;
    function_code_land(p->code, skip);
    function_code_close_loop(p->code, loop);
    return 0;
}

static int parse_simple(ExpressionParser *p, int result)
{
    bool is_integer = expression_take_word(p, "integer");
    if (is_integer || expression_take_word(p, "real")) return parse_declaration(p, is_integer);
    if (expression_take_word(p, "double"))
        return expression_take_word(p, "precision") ? parse_declaration(p, false)
                                                    : expression_fail(p, "a missing 'precision'");
    if (expression_take_word(p, "implicit"))
        return expression_take_word(p, "none") ? 0 : expression_fail(p, "implicit without none");
    if (expression_take_word(p, "return")) return return_value(p, result);
    bool next = expression_take_word(p, "cycle");
    if (next || expression_take_word(p, "exit"))
        return function_code_leave(p->code, next) ? expression_fail(p, p->code->trouble) : 0;
    if (expression_take_word(p, "continue")) return 0;
    int variable = variable_of(p);
    if (variable < 0) return -1;
    if (!expression_take(p, "=")) return expression_fail(p, "a missing '='");
    return function_store(p, variable);
}

/* end, end if, enddo, else, else if, ... if it is next. */
static bool take_end(ExpressionParser *p, BlockEnd *end)
{
    *end = END_FUNCTION;
    if (expression_take_word(p, "elseif")) {
        *end = END_ELSE_IF;
    } else if (expression_take_word(p, "else")) {
        *end = expression_take_word(p, "if") ? END_ELSE_IF : END_ELSE;
    } else if (expression_take_word(p, "endif")) {
        *end = END_IF;
    } else if (expression_take_word(p, "enddo")) {
        *end = END_DO;
    } else if (expression_take_word(p, "end")) {
        const char *name;
        if (expression_take_word(p, "if")) *end = END_IF;
        if (expression_take_word(p, "do")) *end = END_DO;
        if (expression_take_word(p, "function")) function_read_name(p, &name);
    } else {
        return false;
    }
    return true;
}

static int parse_block(ExpressionParser *p, int result, int level, BlockEnd *end)
{
    if (level > DEEPEST_BLOCK) return expression_fail(p, "more than 50 levels of blocks");
    for (;;) {
        skip_lines(p);
        if (expression_peek(p) == '\0') return expression_fail(p, "a missing 'end'");
        if (take_end(p, end)) return *end == END_ELSE_IF ? 0 : end_line(p);
        int status = expression_take_word(p, "if")   ? parse_if(p, result, level)
                     : expression_take_word(p, "do") ? parse_do(p, result, level)
                                                     : parse_simple(p, result);
        if (status || end_line(p)) return -1;
    }
}

int function_parse_fortran_body(ExpressionParser *p, int result)
{
    BlockEnd end;
    if (parse_block(p, result, 0, &end)) return -1;
    if (end != END_FUNCTION) return expression_fail(p, "an end without its beginning");
    return return_value(p, result);
}
