/* What the operations of an expression do: give a value, or an instruction of the user's function. */
#include <math.h>

#include "io/expression_parser.h"
#include "io/function_code.h"

static const double largest_integer = 9007199254740992.0; /* 2^53 */

/* Keeps integers exact: what is too large becomes an error, not a rounded integer. */
static int set_value(ExpressionParser *p, double number, bool is_integer, ExpressionValue *value)
{
    if (!isfinite(number)) return expression_fail(p, "a value that is not a finite number");
    if (is_integer && fabs(number) > largest_integer) return expression_fail(p, "an integer beyond 2^53");
    *value = (ExpressionValue){.value = number, .is_integer = is_integer};
    return 0;
}

static int emit(ExpressionParser *p, FunctionInstruction instruction, int operands, bool is_integer,
                ExpressionValue *value)
{
    *value = (ExpressionValue){.is_integer = is_integer};
    if (function_code_emit(p->code, instruction, operands)) return expression_fail(p, p->code->trouble);
    return 0;
}

int expression_apply_number(ExpressionParser *p, double number, bool is_integer, ExpressionValue *value)
{
    if (p->all_real) is_integer = false;
    if (set_value(p, number, is_integer, value)) return -1;
    if (!p->code) return 0;
    return emit(p, (FunctionInstruction){.operation = OPERATION_CONSTANT, .constant = number}, 0, is_integer, value);
}

int expression_apply_unary(ExpressionParser *p, FunctionOperation operation, ExpressionValue *value)
{
    bool is_integer = operation == OPERATION_NEGATE ? value->is_integer : true;
    if (p->code) return emit(p, (FunctionInstruction){.operation = (uint8_t)operation}, 1, is_integer, value);
    value->value = -value->value;
    return 0;
}

/* base ** exponent: an integer only if both are and the exponent is not negative; Fortran's 2 ** (-1) = 0 helps nobody.
 */
static int evaluate_power(ExpressionParser *p, ExpressionValue *left, ExpressionValue right)
{
    bool integers = left->is_integer && right.is_integer && right.value >= 0;
    return set_value(p, function_builtin_power(left->value, right.value), integers, left);
}

static int evaluate_binary(ExpressionParser *p, FunctionOperation operation, ExpressionValue *left,
                           ExpressionValue right)
{
    bool integers = left->is_integer && right.is_integer;
    switch (operation) {
    case OPERATION_ADD:
        return set_value(p, left->value + right.value, integers, left);
    case OPERATION_SUBTRACT:
        return set_value(p, left->value - right.value, integers, left);
    case OPERATION_MULTIPLY:
        return set_value(p, left->value * right.value, integers, left);
    case OPERATION_POWER:
        return evaluate_power(p, left, right);
    default:
        break;
    }
    if (right.value == 0) return expression_fail(p, "a division by zero");
    double result = left->value / right.value;
    if (integers && result != trunc(result)) p->truncated = true;
    return set_value(p, integers ? trunc(result) : result, integers, left);
}

int expression_apply_binary(ExpressionParser *p, FunctionOperation operation, ExpressionValue *left,
                            ExpressionValue right)
{
    if (!p->code) return evaluate_binary(p, operation, left, right);
    bool integers = left->is_integer && right.is_integer;
    if (operation == OPERATION_DIVIDE && integers) operation = OPERATION_DIVIDE_INTEGERS;
    bool logical = operation >= OPERATION_LESS && operation <= OPERATION_OR;
    return emit(p, (FunctionInstruction){.operation = (uint8_t)operation}, 2, logical || integers, left);
}

int expression_apply_select(ExpressionParser *p, ExpressionValue first, ExpressionValue second, ExpressionValue *value)
{
    bool integers = first.is_integer && second.is_integer;
    return emit(p, (FunctionInstruction){.operation = OPERATION_SELECT}, 3, integers, value);
}

int expression_apply_builtin(ExpressionParser *p, int builtin, const ExpressionValue *arguments, int count,
                             ExpressionValue *value)
{
    const FunctionBuiltin *entry = function_builtin(builtin);
    bool integers = true;
    double numbers[BILLOW_MOST_ARGUMENTS] = {0};
    for (int i = 0; i < count; i++) {
        integers = integers && arguments[i].is_integer;
        numbers[i] = arguments[i].value;
    }
    bool is_integer = entry->type == BUILTIN_INTEGER || (entry->type == BUILTIN_KEEPS && integers);
    if (!p->code) return set_value(p, entry->value(numbers, count), is_integer, value);
    FunctionInstruction call = {.operation = OPERATION_CALL, .count = (uint8_t)count, .operand = builtin};
    return emit(p, call, count, is_integer && !p->all_real, value);
}
