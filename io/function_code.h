/* A user's function in the making: instructions, variables, jumps. Private to io/expression*.c and io/function*.c. */
#ifndef BILLOW_FUNCTION_CODE_H
#define BILLOW_FUNCTION_CODE_H

#include "io/expression_parser.h"

enum { BILLOW_VARIABLE_LENGTH = 32, BILLOW_MOST_LEAVES = 64 };

typedef struct FunctionVariable {
    char name[BILLOW_VARIABLE_LENGTH]; /* lower case; a blank one is the compiler's own */
    bool is_integer;
} FunctionVariable;

/* Jumps out of the loop around a statement (break, exit) or to its next round (continue, cycle). */
typedef struct FunctionLoop {
    int outside; /* count of leaves before this loop */
    int depth;   /* loops around, this one included */
} FunctionLoop;

typedef struct FunctionCode {
    FunctionProgram *program;
    size_t capacity;
    int depth; /* operands on the stack */
    FunctionVariable variable[BILLOW_FUNCTION_REGISTERS];
    bool quantities; /* TIME, DX(..), LCn and the like are known (*DEFINE_CURVE_FUNCTION) */
    const char *trouble;
    int leave[BILLOW_MOST_LEAVES]; /* instructions that jump to the end of their loop, or to its next round */
    bool leave_next[BILLOW_MOST_LEAVES];
    int leave_count, loop_depth;
} FunctionCode;

/* Appends an instruction that takes operands from the stack. Returns 0, or -1 with code->trouble. */
int function_code_emit(FunctionCode *code, FunctionInstruction instruction, int operands);

/* Places of jumps: emit returns the instruction's place (-1 and trouble without room), land makes it go to the end of
 * the code as it is now. */
int function_code_jump(FunctionCode *code, FunctionOperation operation, int target);
void function_code_land(FunctionCode *code, int place);

/* Register of a variable, or -1; name in any case. */
int function_code_find(const FunctionCode *code, const char *name, size_t length);

/* A new variable; -1 with trouble if there is no room or the name is taken. */
int function_code_declare(FunctionCode *code, const char *name, size_t length, bool is_integer);

/* A name in an expression: emits its value and returns 0; 1 if it is neither a variable nor a quantity; -1 after an
 * error. */
int function_code_name(FunctionCode *code, ExpressionParser *p, const char *name, size_t length,
                       ExpressionValue *value);

/* break/exit (next = false) or continue/cycle out of the loop being compiled; -1 with trouble outside of any. */
int function_code_leave(FunctionCode *code, bool next);

/* Begins a loop; the value goes to the functions below. */
FunctionLoop function_code_open_loop(FunctionCode *code);

/* Lands the loop's continues (next) or breaks here; breaks last. */
void function_code_land_leaves(FunctionCode *code, FunctionLoop loop, bool next);
void function_code_close_loop(FunctionCode *code, FunctionLoop loop);

#endif
