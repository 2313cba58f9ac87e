/* *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION. */
#include <string.h>

#include "io/function_text.h"
#include "io/keyword_table.h"
#include "io/parameters.h"
#include "solver/memory.h"

#define AT(member) offsetof(FunctionDefinition, member)
static const FieldSpec curve_fields[] = {
    CARD_INT("LCID", id, USED, ID_FUNCTION),
    CARD_INT("SIDR", sidr, LISTED, NONE),
};
static const FieldSpec function_fields[] = {
    CARD_INT("FID", id, USED, ID_FUNCTION),
    CARD_TEXT("HEADING", title, 70, USED),
};
#undef AT

typedef struct TextCard {
    char text[81];
} TextCard;

#define AT(member) offsetof(TextCard, member)
static const FieldSpec text_fields[] = {CARD_TEXT("FUNCTION", text, 80, USED)};
#undef AT

enum { CURVE_FUNCTION_TITLE };
static const CardSpec curve_cards[] = {
    {"card 1", "", CARD_FIELDS(curve_fields)},
    {"card 2", "one for each line of the expression", CARD_FIELDS(text_fields)},
};
static const CardSpec function_cards[] = {
    {"card 1", "", CARD_FIELDS(function_fields)},
    {"card 2", "one for each line of the function", CARD_FIELDS(text_fields)},
};

static int look_up_parameter(const void *context, const char *name, size_t length, ExpressionValue *value,
                             char *message, size_t message_length)
{
    const CardReader *cards = context;
    return parameters_evaluate_text(cards->parameters, cards->block, name, length, value, message, message_length);
}

/* The lines left, joined by \n; NULL without memory. */
static char *join_lines(const CardReader *cards, size_t *length)
{
    const DeckBlock *block = cards->block;
    *length = 0;
    for (size_t i = cards->next; i < block->line_count; i++) *length += strlen(block->lines[i].text) + 1;
    char *text = memory_alloc(*length + 1, 1), *end = text;
    for (size_t i = cards->next; text && i < block->line_count; i++) {
        size_t used = strlen(block->lines[i].text);
        memcpy(end, block->lines[i].text, used);
        end += used;
        *end++ = '\n';
    }
    return text;
}

static void compile(KeywordRead *read, FunctionDefinition *function)
{
    size_t length;
    CardReader *cards = read->cards;
    FunctionTrouble trouble;
    char *text = join_lines(cards, &length);
    if (!text) {
        diagnostics_add(cards->diagnostics, SEVERITY_ENVIRONMENT, function->source, cards->block->keyword,
                        "out of memory while reading the deck");
        return;
    }
    int status =
        function_compile(text, length, function->is_curve, look_up_parameter, cards, &function->program, &trouble);
    memory_free(text);
    if (status) {
        size_t line = cards->next + (size_t)trouble.line;
        if (line >= cards->block->line_count) line = cards->block->line_count - 1;
        keyword_error(read, cards->block->lines[line].source, "function %d has %s (docs/functions.md has the language)",
                      function->id, trouble.message);
        return;
    }
    FunctionDefinition *kept = KEYWORD_APPEND(read, read->definitions->functions);
    if (kept) {
        *kept = *function;
    } else {
        memory_free(function->program.code);
    }
}

static void read_function(KeywordRead *read, bool is_curve)
{
    FunctionDefinition function = {.is_curve = is_curve};
    if (is_curve) keyword_title(read, CURVE_FUNCTION_TITLE, function.title);
    if (keyword_card(read, 0, &function, true, &function.source)) return;
    if (!keyword_check_id(read, function.id, is_curve ? "LCID" : "FID", function.source)) return;
    if (!keyword_more(read)) {
        keyword_error(read, function.source, "function %d has no text; write it on the lines after this one",
                      function.id);
        return;
    }
    compile(read, &function);
}

static void read_curve_function(KeywordRead *read)
{
    read_function(read, true);
}

static void read_defined_function(KeywordRead *read)
{
    read_function(read, false);
}

static const KeywordSpec specs[] = {
    {.name = "*DEFINE_CURVE_FUNCTION",
     .options = {"TITLE"},
     .cards = curve_cards,
     .card_count = 2,
     .read = read_curve_function,
     .remark =
         "An expression of TIME, TIMESTEP, NCYCLE, DX, DY, DZ, DM, VX, VY, VZ, VM of nodes and of curves (LCn); the "
         "language is in functions.md. For LCC23, LCA23, LCCP23 and LCAP23 of *AIRBAG; other fields refuse it."},
    {.name = "*DEFINE_FUNCTION",
     .cards = function_cards,
     .card_count = 2,
     .read = read_defined_function,
     .remark = "A function in C or Fortran spelling; the language is in functions.md. For LCC23, LCA23, LCCP23 and "
               "LCAP23 of *AIRBAG, which give it the absolute pressure, the volume and the time, in this order."},
};

const KeywordFamily keyword_family_functions = {"Functions", specs, (int)(sizeof specs / sizeof *specs)};
