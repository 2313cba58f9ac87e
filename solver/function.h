/* User's functions: *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION as programs of a small stack machine.
 *
 * A program sees numbers only: its inputs, its registers, its constants. It cannot reach memory, files or code outside
 * (docs/functions.md has the language). Made by io/function_text.c, run by function_evaluate. */
#ifndef BILLOW_FUNCTION_H
#define BILLOW_FUNCTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    BILLOW_FUNCTION_STACK = 128,         /* operands, held by the compiler */
    BILLOW_FUNCTION_REGISTERS = 64,      /* variables */
    BILLOW_FUNCTION_INPUTS = 32,         /* arguments and solution quantities */
    BILLOW_FUNCTION_OPERATIONS = 100000, /* that one evaluation may take: no loop is without bound */
};

typedef enum FunctionOperation {
    OPERATION_CONSTANT, /* push constant */
    OPERATION_INPUT,    /* push inputs[operand] */
    OPERATION_LOAD,     /* push registers[operand] */
    OPERATION_STORE,    /* pop into registers[operand] */
    OPERATION_STORE_INTEGER,
    OPERATION_ADD, /* binary: pop two, push one */
    OPERATION_SUBTRACT,
    OPERATION_MULTIPLY,
    OPERATION_DIVIDE,
    OPERATION_DIVIDE_INTEGERS,
    OPERATION_POWER,
    OPERATION_LESS,
    OPERATION_LESS_EQUAL,
    OPERATION_GREATER,
    OPERATION_GREATER_EQUAL,
    OPERATION_EQUAL,
    OPERATION_NOT_EQUAL,
    OPERATION_AND,
    OPERATION_OR,
    OPERATION_NEGATE, /* unary */
    OPERATION_NOT,
    OPERATION_TRUNCATE,
    OPERATION_SELECT,     /* pop c, b, a, push a ? b : c */
    OPERATION_CALL,       /* pop count arguments, push builtin number operand of them */
    OPERATION_JUMP,       /* to operand */
    OPERATION_JUMP_FALSE, /* pop, jump if it is 0 */
    OPERATION_RETURN,     /* pop: the value */
} FunctionOperation;

typedef struct FunctionInstruction {
    uint8_t operation, count;
    int32_t operand;
    double constant;
} FunctionInstruction;

typedef enum FunctionInputKind {
    INPUT_ARGUMENT,     /* component-th argument of a *DEFINE_FUNCTION */
    INPUT_TIME,         /* TIME */
    INPUT_TIME_STEP,    /* TIMESTEP */
    INPUT_CYCLE,        /* NCYCLE */
    INPUT_CURVE,        /* LCn: the curve of id[0] at TIME */
    INPUT_DISPLACEMENT, /* DX, DY, DZ, DM of node id[0], less those of id[1] if it is not 0 */
    INPUT_VELOCITY,     /* VX, VY, VZ, VM likewise */
} FunctionInputKind;

typedef struct FunctionInput {
    FunctionInputKind kind;
    int component; /* 0, 1, 2 for x, y, z; 3 the magnitude */
    int id[2];     /* the user's */
    int index[2];  /* the model's, -1 none; set by build_functions */
} FunctionInput;

typedef struct FunctionProgram {
    FunctionInstruction *code; /* (code_count) */
    int code_count;
    FunctionInput input[BILLOW_FUNCTION_INPUTS];
    int input_count, argument_count; /* arguments come first */
    int register_count;
} FunctionProgram;

/* Runs the program on inputs (program->input_count). Returns 0, or -1 with *why a constant text: "it takes more than
 * 100000 operations", "its value is not a finite number". */
int function_evaluate(const FunctionProgram *program, const double *inputs, double *value, const char **why);

#endif
