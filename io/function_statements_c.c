/* Statements of *DEFINE_FUNCTION in C's spelling. */
#include "io/function_text.h"

enum { DEEPEST_BLOCK = 50 };

static int parse_statement(ExpressionParser *p, int level);

static int expect(ExpressionParser *p, const char *what, const char *message)
{
    return expression_take(p, what) ? 0 : expression_fail(p, message);
}

/* float x = 1., y; after the type. */
static int parse_declaration(ExpressionParser *p, bool is_integer)
{
    do {
        const char *name;
        size_t length = function_read_name(p, &name);
        if (length == 0) return expression_fail(p, "a missing name of a variable");
        int variable = function_code_declare(p->code, name, length, is_integer);
        if (variable < 0) return expression_fail(p, p->code->trouble);
        if (expression_take(p, "=") && function_store(p, variable)) return -1;
    } while (expression_take(p, ","));
    return 0;
}

/* x = e, x += e, x++ and so on. */
static int parse_assignment(ExpressionParser *p)
{
    static const struct {
        const char *spelling;
        FunctionOperation operation;
    } changes[] = {
        {"+=", OPERATION_ADD}, {"-=", OPERATION_SUBTRACT}, {"*=", OPERATION_MULTIPLY}, {"/=", OPERATION_DIVIDE}};
    const char *name;
    size_t start = p->at, length = function_read_name(p, &name);
    int variable = length ? function_code_find(p->code, name, length) : -1;
    if (variable < 0) {
        p->at = start;
        expression_peek(p);
        return expression_fail(p, length ? "a variable that is not declared, or a call without use,"
                                         : "a missing statement");
    }
    ExpressionValue left = {.is_integer = p->code->variable[variable].is_integer}, right;
    FunctionInstruction load = {.operation = OPERATION_LOAD, .operand = variable};
    bool up = expression_take(p, "++");
    if (up || expression_take(p, "--")) {
        if (function_emit(p, load, 0) || expression_apply_number(p, 1, true, &right)) return -1;
        if (expression_apply_binary(p, up ? OPERATION_ADD : OPERATION_SUBTRACT, &left, right)) return -1;
        return function_assign(p, variable);
    }
    for (int i = 0; i < 4; i++) {
        if (!expression_take(p, changes[i].spelling)) continue;
        if (function_emit(p, load, 0) || expression_parse(p, &right)) return -1;
        if (expression_apply_binary(p, changes[i].operation, &left, right)) return -1;
        return function_assign(p, variable);
    }
    if (expect(p, "=", "a missing '='")) return -1;
    return function_store(p, variable);
}

/* after if or elseif */
static int parse_if(ExpressionParser *p, int level)
{
    if (expect(p, "(", "a missing '('")) return -1;
    int skip = function_jump_unless(p);
    if (skip < 0 || expect(p, ")", "a missing ')'") || parse_statement(p, level)) return -1;
    bool chain = expression_take_word(p, "elseif");
    if (!chain && !expression_take_word(p, "else")) {
        function_code_land(p->code, skip);
        return 0;
    }
    int end = function_jump(p, OPERATION_JUMP, 0);
    if (end < 0) return -1;
    function_code_land(p->code, skip);
    if (level >= DEEPEST_BLOCK) return expression_fail(p, "more than 50 levels of blocks");
    if (chain ? parse_if(p, level + 1) : parse_statement(p, level)) return -1;
    function_code_land(p->code, end);
    return 0;
}

static int parse_while(ExpressionParser *p, int level)
{
    int start = p->code->program->code_count;
    FunctionLoop loop = function_code_open_loop(p->code);
    if (expect(p, "(", "a missing '('")) return -1;
    int skip = function_jump_unless(p);
    if (skip < 0 || expect(p, ")", "a missing ')'") || parse_statement(p, level)) return -1;
    function_code_land_leaves(p->code, loop, true);
    if (function_jump(p, OPERATION_JUMP, start) < 0) return -1;
    function_code_land(p->code, skip);
    function_code_close_loop(p->code, loop);
    return 0;
}

static int parse_do(ExpressionParser *p, int level)
{
    int start = p->code->program->code_count;
    FunctionLoop loop = function_code_open_loop(p->code);
    if (parse_statement(p, level)) return -1;
    function_code_land_leaves(p->code, loop, true);
    if (!expression_take_word(p, "while")) return expression_fail(p, "a missing 'while'");
    if (expect(p, "(", "a missing '('")) return -1;
    int skip = function_jump_unless(p);
    if (skip < 0 || expect(p, ")", "a missing ')'") || expect(p, ";", "a missing ';'")) return -1;
    if (function_jump(p, OPERATION_JUMP, start) < 0) return -1;
    function_code_land(p->code, skip);
    function_code_close_loop(p->code, loop);
    return 0;
}

static bool take_declared_type(ExpressionParser *p, bool *is_integer)
{
    *is_integer = expression_take_word(p, "int") || expression_take_word(p, "long");
    return *is_integer || expression_take_word(p, "float") || expression_take_word(p, "double");
}

/* for (first; condition; change) statement: the change stands before the body in the code. */
static int parse_for(ExpressionParser *p, int level)
{
    bool is_integer;
    if (expect(p, "(", "a missing '('")) return -1;
    if (expression_peek(p) != ';') {
        bool typed = take_declared_type(p, &is_integer);
        if (typed ? parse_declaration(p, is_integer) : parse_assignment(p)) return -1;
    }
    if (expect(p, ";", "a missing ';'")) return -1;
    int test = p->code->program->code_count, skip = -1;
    if (expression_peek(p) != ';' && (skip = function_jump_unless(p)) < 0) return -1;
    if (expect(p, ";", "a missing ';'")) return -1;
    int body = function_jump(p, OPERATION_JUMP, 0), change = p->code->program->code_count;
    if (body < 0) return -1;
    if (expression_peek(p) != ')' && parse_assignment(p)) return -1;
    if (expect(p, ")", "a missing ')'") || function_jump(p, OPERATION_JUMP, test) < 0) return -1;
    function_code_land(p->code, body);
    FunctionLoop loop = function_code_open_loop(p->code);
    if (parse_statement(p, level)) return -1;
    function_code_land_leaves(p->code, loop, true);
    if (function_jump(p, OPERATION_JUMP, change) < 0) return -1;
    if (skip >= 0) function_code_land(p->code, skip);
    function_code_close_loop(p->code, loop);
    return 0;
}

static int parse_return(ExpressionParser *p)
{
    ExpressionValue value;
    if (expression_parse(p, &value)) return -1;
    return function_emit(p, (FunctionInstruction){.operation = OPERATION_RETURN}, 1);
}

static int parse_block(ExpressionParser *p, int level)
{
    while (!expression_take(p, "}")) {
        if (expression_peek(p) == '\0') return expression_fail(p, "a missing '}'");
        if (parse_statement(p, level)) return -1;
    }
    return 0;
}

static int parse_simple(ExpressionParser *p)
{
    bool is_integer;
    int status;
    while (expression_take_word(p, "const") || expression_take_word(p, "static")) continue;
    if (take_declared_type(p, &is_integer)) {
        status = parse_declaration(p, is_integer);
    } else if (expression_take_word(p, "return")) {
        status = parse_return(p);
    } else if (expression_take_word(p, "break")) {
        status = function_code_leave(p->code, false) ? expression_fail(p, p->code->trouble) : 0;
    } else if (expression_take_word(p, "continue")) {
        status = function_code_leave(p->code, true) ? expression_fail(p, p->code->trouble) : 0;
    } else {
        status = parse_assignment(p);
    }
    return status ? -1 : expect(p, ";", "a missing ';'");
}

static int parse_statement(ExpressionParser *p, int level)
{
    if (++level > DEEPEST_BLOCK) return expression_fail(p, "more than 50 levels of blocks");
    if (expression_take(p, ";")) return 0;
    if (expression_take(p, "{")) return parse_block(p, level);
    if (expression_take_word(p, "if")) return parse_if(p, level);
    if (expression_take_word(p, "while")) return parse_while(p, level);
    if (expression_take_word(p, "do")) return parse_do(p, level);
    if (expression_take_word(p, "for")) return parse_for(p, level);
    return parse_simple(p);
}

int function_parse_c_body(ExpressionParser *p)
{
    return parse_block(p, 0);
}
