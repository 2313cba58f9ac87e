/* A user's function in the making. */
#include "io/function_code.h"

#include <limits.h>
#include <string.h>
#include <strings.h>

#include "solver/memory.h"

enum { LONGEST_PROGRAM = 20000 }; /* instructions */

/* What an instruction leaves on the stack. */
static int results_of(FunctionOperation operation)
{
    switch (operation) {
    case OPERATION_STORE:
    case OPERATION_STORE_INTEGER:
    case OPERATION_JUMP:
    case OPERATION_JUMP_FALSE:
    case OPERATION_RETURN:
        return 0;
    default:
        return 1;
    }
}

int function_code_emit(FunctionCode *code, FunctionInstruction instruction, int operands)
{
    FunctionProgram *program = code->program;
    code->depth += results_of((FunctionOperation)instruction.operation) - operands;
    if (code->depth > BILLOW_FUNCTION_STACK) {
        code->trouble = "an expression that is too long for one piece";
        return -1;
    }
    if (program->code_count >= LONGEST_PROGRAM) {
        code->trouble = "a function that is too long";
        return -1;
    }
    if (memory_reserve((void **)&program->code, &code->capacity, (size_t)program->code_count + 1,
                       sizeof *program->code)) {
        code->trouble = "no memory left";
        return -1;
    }
    program->code[program->code_count++] = instruction;
    return 0;
}

int function_code_jump(FunctionCode *code, FunctionOperation operation, int target)
{
    int place = code->program->code_count;
    FunctionInstruction jump = {.operation = (uint8_t)operation, .operand = target};
    return function_code_emit(code, jump, operation == OPERATION_JUMP_FALSE ? 1 : 0) ? -1 : place;
}

void function_code_land(FunctionCode *code, int place)
{
    code->program->code[place].operand = code->program->code_count;
}

int function_code_find(const FunctionCode *code, const char *name, size_t length)
{
    for (int i = 0; i < code->program->register_count; i++) {
        const char *known = code->variable[i].name;
        if (strlen(known) == length && strncasecmp(known, name, length) == 0) return i;
    }
    return -1;
}

int function_code_declare(FunctionCode *code, const char *name, size_t length, bool is_integer)
{
    int number = code->program->register_count;
    if (length > 0 && function_code_find(code, name, length) >= 0) {
        code->trouble = "a variable declared twice";
        return -1;
    }
    if (length >= BILLOW_VARIABLE_LENGTH || number == BILLOW_FUNCTION_REGISTERS) {
        code->trouble = length >= BILLOW_VARIABLE_LENGTH ? "a name of more than 31 letters" : "more than 64 variables";
        return -1;
    }
    memcpy(code->variable[number].name, name, length);
    code->variable[number].name[length] = '\0';
    code->variable[number].is_integer = is_integer;
    code->program->register_count++;
    return number;
}

/* Pushes an input, listed once. */
static int push_input(FunctionCode *code, ExpressionParser *p, FunctionInput input, ExpressionValue *value)
{
    FunctionProgram *program = code->program;
    int number = 0;
    for (; number < program->input_count; number++) {
        const FunctionInput *known = &program->input[number];
        if (known->kind == input.kind && known->component == input.component && known->id[0] == input.id[0] &&
            known->id[1] == input.id[1])
            break;
    }
    if (number == BILLOW_FUNCTION_INPUTS) return expression_fail(p, "more than 32 quantities of the solution");
    if (number == program->input_count) {
        input.index[0] = input.index[1] = -1;
        program->input[program->input_count++] = input;
    }
    *value = (ExpressionValue){0};
    FunctionInstruction push = {.operation = OPERATION_INPUT, .operand = number};
    return function_code_emit(code, push, 0) ? expression_fail(p, code->trouble) : 0;
}

/* An id in an argument list: a whole number written out or a parameter. */
static int parse_id(ExpressionParser *p, int *id)
{
    struct FunctionCode *code = p->code;
    bool all_real = p->all_real;
    ExpressionValue value;
    p->code = NULL;
    p->all_real = false;
    int status = expression_parse(p, &value);
    p->code = code;
    p->all_real = all_real;
    if (status) return -1;
    if (!value.is_integer || value.value < 0 || value.value > INT_MAX)
        return expression_fail(p, "an id that is no whole number");
    *id = (int)value.value;
    return 0;
}

/* DX(n1, n2), VM(n1) and so on. */
static int parse_motion(FunctionCode *code, ExpressionParser *p, FunctionInput input, ExpressionValue *value)
{
    if (!expression_take(p, "(") || parse_id(p, &input.id[0])) return expression_fail(p, "a missing node in (..)");
    if (expression_take(p, ",") && parse_id(p, &input.id[1])) return -1;
    if (expression_peek(p) == ',')
        return expression_fail(p, "a third node, a local system, which billow does not have here,");
    if (!expression_take(p, ")")) return expression_fail(p, "a missing ')'");
    if (input.id[0] == 0) return expression_fail(p, "the node 0");
    return push_input(code, p, input, value);
}

static int parse_quantity(FunctionCode *code, ExpressionParser *p, const char *name, size_t length,
                          ExpressionValue *value)
{
    static const struct {
        const char *name;
        FunctionInputKind kind;
        int component;
    } quantities[] = {
        {"time", INPUT_TIME, 0},       {"timestep", INPUT_TIME_STEP, 0}, {"ncycle", INPUT_CYCLE, 0},
        {"dx", INPUT_DISPLACEMENT, 0}, {"dy", INPUT_DISPLACEMENT, 1},    {"dz", INPUT_DISPLACEMENT, 2},
        {"dm", INPUT_DISPLACEMENT, 3}, {"vx", INPUT_VELOCITY, 0},        {"vy", INPUT_VELOCITY, 1},
        {"vz", INPUT_VELOCITY, 2},     {"vm", INPUT_VELOCITY, 3},
    };
    for (size_t i = 0; i < sizeof quantities / sizeof *quantities; i++) {
        if (strlen(quantities[i].name) != length || strncasecmp(quantities[i].name, name, length) != 0) continue;
        FunctionInput input = {.kind = quantities[i].kind, .component = quantities[i].component};
        if (input.kind < INPUT_DISPLACEMENT) return push_input(code, p, input, value);
        return parse_motion(code, p, input, value);
    }
    if (length > 2 && length < 12 && strncasecmp(name, "lc", 2) == 0) {
        int id = 0;
        for (size_t i = 2; i < length; i++) {
            if (!expression_is_digit(name[i]) || id > INT_MAX / 10 - 9) return 1;
            id = 10 * id + (name[i] - '0');
        }
        return push_input(code, p, (FunctionInput){.kind = INPUT_CURVE, .id = {id, 0}}, value);
    }
    double factor = length != 4                         ? 0.0
                    : strncasecmp(name, "dtor", 4) == 0 ? 0.017453292519943295
                    : strncasecmp(name, "rtod", 4) == 0 ? 57.295779513082321
                                                        : 0.0;
    return factor > 0.0 ? expression_apply_number(p, factor, false, value) : 1;
}

int function_code_name(FunctionCode *code, ExpressionParser *p, const char *name, size_t length, ExpressionValue *value)
{
    if (code->quantities) return parse_quantity(code, p, name, length, value);
    int number = function_code_find(code, name, length);
    if (number < 0) return 1;
    *value = (ExpressionValue){.is_integer = code->variable[number].is_integer};
    FunctionInstruction load = {.operation = OPERATION_LOAD, .operand = number};
    return function_code_emit(code, load, 0) ? expression_fail(p, code->trouble) : 0;
}

int function_code_leave(FunctionCode *code, bool next)
{
    if (code->loop_depth == 0 || code->leave_count == BILLOW_MOST_LEAVES) {
        code->trouble =
            code->loop_depth == 0 ? "a jump out of a loop that is not there" : "too many jumps out of loops";
        return -1;
    }
    int place = function_code_jump(code, OPERATION_JUMP, 0);
    if (place < 0) return -1;
    code->leave[code->leave_count] = place;
    code->leave_next[code->leave_count++] = next;
    return 0;
}

FunctionLoop function_code_open_loop(FunctionCode *code)
{
    return (FunctionLoop){code->leave_count, ++code->loop_depth};
}

void function_code_land_leaves(FunctionCode *code, FunctionLoop loop, bool next)
{
    for (int i = loop.outside; i < code->leave_count; i++)
        if (code->leave_next[i] == next) function_code_land(code, code->leave[i]);
}

void function_code_close_loop(FunctionCode *code, FunctionLoop loop)
{
    function_code_land_leaves(code, loop, false);
    code->leave_count = loop.outside;
    code->loop_depth--;
}
