/* The table of parameters: definitions chained by name, scopes, and the value of &name and <expression>. */
#include "io/parameters.h"

#include <stdio.h>
#include <string.h>

#include "solver/memory.h"

enum { FIRST_BUCKETS = 64 };

Parameters *parameters_create(void)
{
    Parameters *parameters = memory_alloc(1, sizeof *parameters);
    if (!parameters) return NULL;
    parameters->rule = DUPLICATE_WARN_KEEP;
    parameters->buckets = memory_alloc(FIRST_BUCKETS, sizeof *parameters->buckets);
    parameters->bucket_count = FIRST_BUCKETS;
    if (!parameters->buckets || parameters_add_scope(parameters, -1) != 0) {
        parameters_free(parameters);
        return NULL;
    }
    return parameters;
}

void parameters_free(Parameters *parameters)
{
    if (!parameters) return;
    for (size_t i = 0; i < parameters->definitions.count; i++) memory_free(parameters->definitions.items[i].text);
    memory_free(parameters->definitions.items);
    memory_free(parameters->buckets);
    memory_free(parameters->scope_parents.items);
    memory_free(parameters->noted.items);
    memory_free(parameters);
}

int parameters_add_scope(Parameters *parameters, int parent)
{
    size_t count = parameters->scope_parents.count;
    if (memory_reserve((void **)&parameters->scope_parents.items, &parameters->scope_parents.capacity, count + 1,
                       sizeof *parameters->scope_parents.items)) {
        return -1;
    }
    parameters->scope_parents.items[count] = parent;
    parameters->scope_parents.count++;
    return (int)count;
}

static char lower_case(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Lower-case copy; false if the name is longer than any parameter's. */
static bool normalise_name(const char *name, size_t length, char normal[BILLOW_PARAMETER_NAME_LENGTH])
{
    if (length >= BILLOW_PARAMETER_NAME_LENGTH) return false;
    for (size_t i = 0; i < length; i++) normal[i] = lower_case(name[i]);
    normal[length] = '\0';
    return true;
}

/* FNV-1a. */
static size_t hash_name(const char *name)
{
    unsigned long long hash = 14695981039346656037ULL;
    for (; *name; name++) hash = (hash ^ (unsigned char)*name) * 1099511628211ULL;
    return (size_t)hash;
}

static size_t *find_bucket(const Parameters *parameters, const char *name)
{
    return &parameters->buckets[hash_name(name) & (parameters->bucket_count - 1)];
}

/* Makes the definition the newest of its bucket. */
static void link_definition(Parameters *parameters, size_t index)
{
    size_t *bucket = find_bucket(parameters, parameters->definitions.items[index].name);
    parameters->definitions.items[index].previous = *bucket;
    *bucket = index + 1;
}

/* Twice as many buckets; without memory the old ones go on with longer chains. */
static void grow_buckets(Parameters *parameters)
{
    size_t *larger = memory_alloc(2 * parameters->bucket_count, sizeof *larger);
    if (!larger) return;
    memory_free(parameters->buckets);
    parameters->buckets = larger;
    parameters->bucket_count *= 2;
    for (size_t i = 0; i < parameters->definitions.count; i++) link_definition(parameters, i);
}

static bool scope_is_within(const Parameters *parameters, int inner, int outer)
{
    while (inner > outer) inner = parameters->scope_parents.items[inner];
    return inner == outer;
}

const Parameter *parameters_find(const Parameters *parameters, const char *name, size_t length, size_t order, int scope)
{
    char normal[BILLOW_PARAMETER_NAME_LENGTH];
    if (!parameters || !normalise_name(name, length, normal)) return NULL;
    const Parameter *best = NULL;
    for (size_t at = *find_bucket(parameters, normal); at != 0; at = parameters->definitions.items[at - 1].previous) {
        const Parameter *p = &parameters->definitions.items[at - 1];
        if (p->order > order || strcmp(p->name, normal) != 0) continue;
        if (p->local && !scope_is_within(parameters, scope, p->scope)) continue;
        /* The chain runs from the newest to the oldest. Inner files have the higher scope numbers. */
        if (!best || (p->local && (!best->local || p->scope > best->scope))) best = p;
    }
    return best;
}

const Parameter *parameters_find_anywhere(const Parameters *parameters, const char *name, size_t length)
{
    char normal[BILLOW_PARAMETER_NAME_LENGTH];
    if (!parameters || !normalise_name(name, length, normal)) return NULL;
    size_t at = *find_bucket(parameters, normal);
    while (at != 0 && strcmp(parameters->definitions.items[at - 1].name, normal) != 0) {
        at = parameters->definitions.items[at - 1].previous;
    }
    return at == 0 ? NULL : &parameters->definitions.items[at - 1];
}

/* Decides on a second definition. Returns 1 if it replaces the first, 0 if it is to be ignored, -1 if it is an error.
 */
static int judge_duplicate(const Parameters *parameters, const Parameter *first, const Parameter *second,
                           const char *keyword, Diagnostics *diagnostics)
{
    DuplicateRule rule = first->changeable && second->changeable ? DUPLICATE_REPLACE : parameters->rule;
    switch (rule) {
    case DUPLICATE_REPLACE:
        return 1;
    case DUPLICATE_KEEP:
        return 0;
    case DUPLICATE_WARN_REPLACE:
        diagnostics_add(
            diagnostics, SEVERITY_WARNING, second->source, keyword,
            "parameter '%s' was defined on line %d already; this new value replaces the old one from here on",
            second->name, first->source.line);
        return 1;
    case DUPLICATE_ERROR:
        diagnostics_add(diagnostics, SEVERITY_ERROR, second->source, keyword,
                        "parameter '%s' was defined on line %d already, and *PARAMETER_DUPLICATION forbids a second "
                        "definition",
                        second->name, first->source.line);
        return -1;
    case DUPLICATE_WARN_KEEP:
        break;
    }
    diagnostics_add(diagnostics, SEVERITY_WARNING, second->source, keyword,
                    "parameter '%s' was defined on line %d already; this second definition is ignored as in LS-DYNA "
                    "(*PARAMETER_DUPLICATION can change that)",
                    second->name, first->source.line);
    return 0;
}

/* The definition that a new one would duplicate: of the same file if it is local, the global one else. */
static const Parameter *find_duplicate(const Parameters *parameters, const Parameter *definition)
{
    size_t at = *find_bucket(parameters, definition->name);
    for (; at != 0; at = parameters->definitions.items[at - 1].previous) {
        const Parameter *p = &parameters->definitions.items[at - 1];
        if (strcmp(p->name, definition->name) != 0 || p->local != definition->local) continue;
        if (!p->local || p->scope == definition->scope) return p;
    }
    return NULL;
}

int parameters_define(Parameters *parameters, Parameter definition, const char *keyword, Diagnostics *diagnostics)
{
    for (char *c = definition.name; *c; c++) *c = lower_case(*c);
    const Parameter *first = find_duplicate(parameters, &definition);
    if (first) {
        int verdict = judge_duplicate(parameters, first, &definition, keyword, diagnostics);
        if (verdict <= 0) {
            memory_free(definition.text);
            return verdict;
        }
    }
    size_t count = parameters->definitions.count;
    if (memory_reserve((void **)&parameters->definitions.items, &parameters->definitions.capacity, count + 1,
                       sizeof *parameters->definitions.items)) {
        memory_free(definition.text);
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, definition.source, keyword, "no memory left");
        return -1;
    }
    parameters->definitions.items[count] = definition;
    parameters->definitions.count++;
    link_definition(parameters, count);
    if (parameters->definitions.count > 2 * parameters->bucket_count) grow_buckets(parameters);
    return 0;
}

/* What parameters_evaluate hands to the expression evaluator. */
typedef struct LookupContext {
    const Parameters *parameters;
    const DeckBlock *block;
} LookupContext;

static int look_up_value(const void *context, const char *name, size_t length, ExpressionValue *value, char *message,
                         size_t message_length)
{
    const LookupContext *where = context;
    int shown = length < BILLOW_PARAMETER_NAME_LENGTH ? (int)length : BILLOW_PARAMETER_NAME_LENGTH;
    const Parameter *p = parameters_find(where->parameters, name, length, where->block->order, where->block->scope);
    if (p && p->type == '?') {
        if (message_length > 0) message[0] = '\0';
        return -1;
    }
    if (p && p->type != 'C') {
        *value = (ExpressionValue){.value = p->value, .is_integer = p->type == 'I'};
        return 0;
    }
    if (p) {
        snprintf(message, message_length, "the text parameter '%.*s', which is no number", shown, name);
        return -1;
    }
    p = parameters_find_anywhere(where->parameters, name, length);
    if (!p) {
        snprintf(message, message_length, "the undefined parameter '%.*s'; define it in *PARAMETER before its use",
                 shown, name);
    } else if (p->local) {
        snprintf(message, message_length, "the parameter '%.*s', which is local to another file (line %d there)", shown,
                 name, p->source.line);
    } else {
        snprintf(message, message_length,
                 "the parameter '%.*s' before its definition on line %d; move the definition up", shown, name,
                 p->source.line);
    }
    return -1;
}

int parameters_evaluate(const Parameters *parameters, const DeckBlock *block, const char *text, size_t length,
                        ExpressionValue *value, char *message, size_t message_length)
{
    LookupContext context = {parameters, block};
    bool negative = length > 0 && text[0] == '-';
    if (length > 0 && (text[0] == '-' || text[0] == '+')) {
        text++;
        length--;
    }
    int status;
    if (length > 0 && text[0] == '&') {
        status = look_up_value(&context, text + 1, length - 1, value, message, message_length);
    } else if (length > 1 && text[0] == '<' && text[length - 1] == '>') {
        status = expression_evaluate(text + 1, length - 2, look_up_value, &context, value, message, message_length);
    } else {
        snprintf(message, message_length, "an expression without its closing '>' in the same field");
        status = -1;
    }
    if (status == 0 && negative) value->value = -value->value;
    return status;
}

int parameters_evaluate_text(const Parameters *parameters, const DeckBlock *block, const char *text, size_t length,
                             ExpressionValue *value, char *message, size_t message_length)
{
    LookupContext context = {parameters, block};
    return expression_evaluate(text, length, look_up_value, &context, value, message, message_length);
}

bool parameters_note_field(Parameters *parameters, const DeckBlock *block, const void *field)
{
    if (!parameters) return true;
    if (parameters->noted_order != block->order) parameters->noted.count = 0;
    parameters->noted_order = block->order;
    for (size_t i = 0; i < parameters->noted.count; i++) {
        if (parameters->noted.items[i] == field) return false;
    }
    if (memory_reserve((void **)&parameters->noted.items, &parameters->noted.capacity, parameters->noted.count + 1,
                       sizeof *parameters->noted.items)) {
        return true;
    }
    parameters->noted.items[parameters->noted.count++] = field;
    return true;
}
