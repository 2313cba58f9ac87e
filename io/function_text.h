/* Texts of *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION -> programs (solver/function.h). The language is in
 * docs/functions.md. */
#ifndef BILLOW_FUNCTION_TEXT_H
#define BILLOW_FUNCTION_TEXT_H

#include "io/expression.h"
#include "io/function_code.h"

/* Where and why a text was refused. */
typedef struct FunctionTrouble {
    char message[200];
    int line; /* from 0 */
} FunctionTrouble;

/* Compiles lines separated by \n. is_curve: one expression of solution quantities; else a function of arguments in C or
 * Fortran spelling, or name(a, b) = expression. lookup gives the deck's parameters (&name). On success the caller owns
 * program->code (memory_free). Returns 0, or -1 with trouble. */
int function_compile(const char *text, size_t length, bool is_curve, ExpressionLookup *lookup, const void *context,
                     FunctionProgram *program, FunctionTrouble *trouble);

/* --- for io/function_statements_*.c --- */

/* Reads a name; its length, 0 if there is none. */
size_t function_read_name(ExpressionParser *p, const char **name);

/* An expression whose value goes to a register. */
int function_store(ExpressionParser *p, int variable);
int function_assign(ExpressionParser *p, int variable); /* emits the store of the value on the stack */

/* A condition, then a jump taken if it is false; its place or -1. */
int function_jump_unless(ExpressionParser *p);

int function_emit(ExpressionParser *p, FunctionInstruction instruction, int operands);
int function_jump(ExpressionParser *p, FunctionOperation operation, int target); /* its place or -1 */

/* Statements after the head of a function: up to and including the closing '}' or end. */
int function_parse_c_body(ExpressionParser *p);
int function_parse_fortran_body(ExpressionParser *p, int result);

#endif
