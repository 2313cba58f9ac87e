/* The deck's parameters: *PARAMETER(_EXPRESSION)(_LOCAL)(_MUTABLE), *PARAMETER_DUPLICATION, and their use as &name. */
#ifndef BILLOW_PARAMETERS_H
#define BILLOW_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "io/card.h"
#include "io/expression.h"

enum { BILLOW_PARAMETER_NAME_LENGTH = 32 }; /* terminating zero included */

/* One definition of a parameter. A later definition does not erase an earlier one, which stays valid for the blocks
 * between the two. */
typedef struct Parameter {
    char name[BILLOW_PARAMETER_NAME_LENGTH]; /* lower case */
    char type;                               /* 'R', 'I' or 'C'; '?': its definition had an error, already reported */
    double value;                            /* of R and I */
    char *text;                              /* of C; owned by the table */
    bool local;                              /* seen only in its own file and what that includes */
    bool changeable;                         /* _MUTABLE: may be redefined without a warning */
    size_t order;                            /* of the defining block */
    int scope;                               /* inclusion that defines it */
    Source source;
    size_t previous; /* 1 + index of the definition before this one in its hash bucket, 0 if none */
} Parameter;

/* What becomes of a second definition (*PARAMETER_DUPLICATION's DFLAG). */
typedef enum DuplicateRule {
    DUPLICATE_WARN_KEEP = 1, /* the first definition stays: the default */
    DUPLICATE_WARN_REPLACE = 2,
    DUPLICATE_ERROR = 3,
    DUPLICATE_REPLACE = 4,
    DUPLICATE_KEEP = 5,
} DuplicateRule;

typedef struct Parameters {
    LIST(Parameter) definitions;
    size_t *buckets; /* heads of chains by name: 1 + index, 0 if empty (bucket_count) */
    size_t bucket_count;
    LIST(int) scope_parents; /* inclusion that contains each inclusion; -1 for the main deck */
    DuplicateRule rule;
    size_t noted_order;       /* block to which noted belongs */
    LIST(const void *) noted; /* fields of that block already listed as unused: one note each */
} Parameters;

/* An empty table with scope 0, the main deck; NULL without memory. */
Parameters *parameters_create(void);
void parameters_free(Parameters *parameters);

/* A new inclusion within parent; its number, or -1 without memory. */
int parameters_add_scope(Parameters *parameters, int parent);

/* Adds a definition (copied; the table takes over its text), or warns of or refuses a duplicate by the rule in effect.
 * Returns 0, or -1 if an error was reported. */
int parameters_define(Parameters *parameters, Parameter definition, const char *keyword, Diagnostics *diagnostics);

/* The definition of name[0 .. length) (any case) that holds in a block of this order and scope; NULL if there is none.
 * A local definition hides a global one, that of an inner file hides that of an outer. */
const Parameter *parameters_find(const Parameters *parameters, const char *name, size_t length, size_t order,
                                 int scope);

/* Any definition of the name, wherever it holds: so that a message can say that it comes too late or is local. */
const Parameter *parameters_find_anywhere(const Parameters *parameters, const char *name, size_t length);

/* The value of a field's text[0 .. length) that starts with & or -& or is <expression>, as seen from the block.
 * Returns 0, or -1 with the reason in message, which is empty where a parameter's definition had an error: that was
 * reported, and its uses are no errors of their own. C parameters are an error here. */
int parameters_evaluate(const Parameters *parameters, const DeckBlock *block, const char *text, size_t length,
                        ExpressionValue *value, char *message, size_t message_length);

/* The value of an expression without <>, in which parameters need no &. */
int parameters_evaluate_text(const Parameters *parameters, const DeckBlock *block, const char *text, size_t length,
                             ExpressionValue *value, char *message, size_t message_length);

/* True if the table defines or rules parameters with this keyword ("*PARAMETER...") and has dealt with the block;
 * errors are reported. */
bool parameters_read_block(Parameters *parameters, const DeckBlock *block, Diagnostics *diagnostics);

/* True the first time it is called for this field of this block: listing it again would only repeat. */
bool parameters_note_field(Parameters *parameters, const DeckBlock *block, const void *field);

#endif
