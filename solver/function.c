/* The stack machine of the user's functions. */
#include "solver/function.h"

#include <math.h>

#include "solver/function_builtin.h"

static double apply_binary(FunctionOperation operation, double a, double b)
{
    switch (operation) {
    case OPERATION_ADD:
        return a + b;
    case OPERATION_SUBTRACT:
        return a - b;
    case OPERATION_MULTIPLY:
        return a * b;
    case OPERATION_DIVIDE:
        return a / b;
    case OPERATION_DIVIDE_INTEGERS:
        return trunc(a / b);
    case OPERATION_LESS:
        return a < b;
    case OPERATION_LESS_EQUAL:
        return a <= b;
    case OPERATION_GREATER:
        return a > b;
    case OPERATION_GREATER_EQUAL:
        return a >= b;
    case OPERATION_EQUAL:
        return a == b;
    case OPERATION_NOT_EQUAL:
        return a != b;
    case OPERATION_AND:
        return a != 0 && b != 0;
    default:
        return a != 0 || b != 0;
    }
}

/* Runs one instruction that stays in line; top is the index behind the last operand. */
static int run_operation(const FunctionInstruction *at, const double *inputs, double *registers, double *stack, int top)
{
    switch ((FunctionOperation)at->operation) {
    case OPERATION_CONSTANT:
        stack[top] = at->constant;
        return top + 1;
    case OPERATION_INPUT:
        stack[top] = inputs[at->operand];
        return top + 1;
    case OPERATION_LOAD:
        stack[top] = registers[at->operand];
        return top + 1;
    case OPERATION_STORE:
        registers[at->operand] = stack[top - 1];
        return top - 1;
    case OPERATION_STORE_INTEGER:
        registers[at->operand] = trunc(stack[top - 1]);
        return top - 1;
    case OPERATION_NEGATE:
        stack[top - 1] = -stack[top - 1];
        return top;
    case OPERATION_NOT:
        stack[top - 1] = stack[top - 1] == 0;
        return top;
    case OPERATION_TRUNCATE:
        stack[top - 1] = trunc(stack[top - 1]);
        return top;
    case OPERATION_SELECT:
        stack[top - 3] = stack[top - 3] != 0 ? stack[top - 2] : stack[top - 1];
        return top - 2;
    case OPERATION_CALL:
        top -= at->count;
        stack[top] = function_builtin(at->operand)->value(stack + top, at->count);
        return top + 1;
    case OPERATION_POWER:
        stack[top - 2] = function_builtin_power(stack[top - 2], stack[top - 1]);
        return top - 1;
    default:
        stack[top - 2] = apply_binary((FunctionOperation)at->operation, stack[top - 2], stack[top - 1]);
        return top - 1;
    }
}

int function_evaluate(const FunctionProgram *program, const double *inputs, double *value, const char **why)
{
    double stack[BILLOW_FUNCTION_STACK], registers[BILLOW_FUNCTION_REGISTERS] = {0};
    int top = 0, at = 0;
    for (int work = 0; work < BILLOW_FUNCTION_OPERATIONS; work++) {
        const FunctionInstruction *instruction = &program->code[at++];
        if (instruction->operation == OPERATION_JUMP) {
            at = instruction->operand;
        } else if (instruction->operation == OPERATION_JUMP_FALSE) {
            if (stack[--top] == 0) at = instruction->operand;
        } else if (instruction->operation == OPERATION_RETURN) {
            *value = stack[top - 1];
            if (isfinite(*value)) return 0;
            *why = "its value is not a finite number";
            return -1;
        } else {
            top = run_operation(instruction, inputs, registers, stack, top);
        }
    }
    *why = "it takes more than 100000 operations: a loop in it does not end";
    return -1;
}
