/* The functions that expressions know: one table for *PARAMETER_EXPRESSION, *DEFINE_CURVE_FUNCTION and
 * *DEFINE_FUNCTION. The same bits on every processor (solver/elementary.h). */
#ifndef BILLOW_FUNCTION_BUILTIN_H
#define BILLOW_FUNCTION_BUILTIN_H

#include <stdbool.h>
#include <stddef.h>

enum { BILLOW_MOST_ARGUMENTS = 34 }; /* POLY and the like: x, x0, a0 ... a30 */

typedef enum BuiltinType {
    BUILTIN_REAL,
    BUILTIN_INTEGER, /* makes an integer of a real */
    BUILTIN_KEEPS,   /* an integer if all arguments are */
} BuiltinType;

typedef enum BuiltinScope {
    BUILTIN_EVERYWHERE,
    BUILTIN_FUNCTIONS, /* not in *PARAMETER_EXPRESSION */
} BuiltinScope;

typedef struct FunctionBuiltin {
    const char *name; /* lower case */
    int least, most;  /* arguments */
    BuiltinType type;
    BuiltinScope scope;
    double (*value)(const double *arguments, int count);
} FunctionBuiltin;

/* Number of the function named text[0 .. length) in any case, or -1. */
int function_builtin_find(const char *text, size_t length);

const FunctionBuiltin *function_builtin(int number);

/* x^y, of negative x where y is whole. */
double function_builtin_power(double x, double y);

#endif
