/* The file of folds: one statement a line, # starts a comment. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "fold/fold.h"
#include "io/deck_file.h"
#include "solver/memory.h"

enum { WORDS = 40 };

typedef struct Statement {
    int count;
    char *word[WORDS];
    Source source;
    Diagnostics *diagnostics;
} Statement;

#define COMPLAIN(s, ...) diagnostics_add((s)->diagnostics, SEVERITY_ERROR, (s)->source, NULL, __VA_ARGS__)

static int read_number(const Statement *s, int k, const char *name, double *value)
{
    char *end;
    errno = 0;
    *value = strtod(s->word[k], &end);
    if (end != s->word[k] && !*end && !errno && isfinite(*value)) return 0;
    COMPLAIN(s, "%s: %s is '%s', which is not a number", s->word[0], name, s->word[k]);
    return -1;
}

static int read_positive(const Statement *s, int k, const char *name, double *value)
{
    if (read_number(s, k, name, value)) return -1;
    if (*value > 0.0) return 0;
    COMPLAIN(s, "%s: %s is %s; it must be above 0", s->word[0], name, s->word[k]);
    return -1;
}

static int read_count(const Statement *s, int k, int *value)
{
    double number;
    if (read_number(s, k, "COUNT", &number)) return -1;
    *value = (int)number;
    if (number == floor(number) && number >= 1.0 && number <= FOLD_LARGEST_COUNT) return 0;
    COMPLAIN(s, "%s: COUNT is %s; give a whole number of folds from 1 to %d", s->word[0], s->word[k],
             (int)FOLD_LARGEST_COUNT);
    return -1;
}

static void read_length(const Statement *s, double *value)
{
    if (s->count != 2)
        COMPLAIN(s, "%s takes one number", s->word[0]);
    else if (*value > 0.0)
        COMPLAIN(s, "%s is given a second time; keep one", s->word[0]);
    else
        read_positive(s, 1, "the value", value);
}

/* upper and lower: ids of parts. */
static int read_parts(const Statement *s, int **items, size_t *count, size_t *capacity)
{
    if (s->count < 2) COMPLAIN(s, "%s names no part; write: %s PART ...", s->word[0], s->word[0]);
    for (int k = 1; k < s->count; k++) {
        double id;
        if (read_positive(s, k, "the id of a part", &id)) continue;
        if (id != floor(id) || id > 2147483647.0) {
            COMPLAIN(s, "%s: '%s' is not the id of a part", s->word[0], s->word[k]);
            continue;
        }
        if (memory_reserve((void **)items, capacity, *count + 1, sizeof **items)) return -1;
        (*items)[(*count)++] = (int)id;
    }
    return 0;
}

/* X Y DX DY and, but for tucks, up or down. */
static int read_line(const Statement *s, Fold *fold)
{
    static const char *names[] = {"X", "Y", "DX", "DY"};
    double value[4];
    for (int k = 0; k < 4; k++)
        if (read_number(s, 1 + k, names[k], &value[k])) return -1;
    const double length = sqrt(value[2] * value[2] + value[3] * value[3]);
    if (!(length > 0.0)) {
        COMPLAIN(s, "%s: the direction DX DY is zero; it points across the line to the side that moves", s->word[0]);
        return -1;
    }
    for (int k = 0; k < 2; k++) {
        fold->point[k] = value[k];
        fold->direction[k] = value[2 + k] / length;
    }
    fold->sense = 1;
    if (fold->kind == FOLD_TUCK) return 0;
    if (strcasecmp(s->word[5], "down") == 0) fold->sense = -1;
    if (fold->sense < 0 || strcasecmp(s->word[5], "up") == 0) return 0;
    COMPLAIN(s, "%s: after DX DY comes up or down, not '%s'", s->word[0], s->word[5]);
    return -1;
}

static int read_angle(const Statement *s, Fold *fold)
{
    double degrees = 180.0;
    if (s->count == 7 && read_positive(s, 6, "ANGLE", &degrees)) return -1;
    fold->angle = acos(-1.0) * (degrees / 180.0);
    if (degrees <= 180.0) return 0;
    COMPLAIN(s, "thin: ANGLE is %s; give degrees above 0, at most 180", s->word[6]);
    return -1;
}

/* One fold; -1 without memory. */
static int read_fold(const Statement *s, FoldKind kind, FoldPlan *plan)
{
    static const struct {
        int least, most;
        const char *usage;
    } forms[] = {{6, 7, "thin X Y DX DY up|down [ANGLE]"},
                 {8, 8, "zig-zag X Y DX DY up|down PITCH COUNT"},
                 {7, 7, "roll X Y DX DY up|down COUNT"},
                 {5, 5, "tuck X Y DX DY"}};
    if (s->count < forms[kind].least || s->count > forms[kind].most) {
        COMPLAIN(s, "%d words; write: %s", s->count, forms[kind].usage);
        return 0;
    }
    Fold fold = {.kind = kind, .count = 1, .angle = acos(-1.0), .source = s->source};
    if (read_line(s, &fold)) return 0;
    if (kind == FOLD_THIN && read_angle(s, &fold)) return 0;
    if (kind == FOLD_ZIG_ZAG && (read_positive(s, 6, "PITCH", &fold.pitch) || read_count(s, 7, &fold.count))) return 0;
    if (kind == FOLD_ROLL && read_count(s, 6, &fold.count)) return 0;
    if (memory_reserve((void **)&plan->folds.items, &plan->folds.capacity, plan->folds.count + 1,
                       sizeof *plan->folds.items))
        return -1;
    plan->folds.items[plan->folds.count++] = fold;
    return 0;
}

static int read_statement(const Statement *s, FoldPlan *plan)
{
    static const char *kinds[] = {"thin", "zig-zag", "roll", "tuck"};
    const char *name = s->word[0];
    for (int k = 0; k < 4; k++)
        if (strcasecmp(name, kinds[k]) == 0) return read_fold(s, (FoldKind)k, plan);
    if (strcasecmp(name, "upper") == 0)
        return read_parts(s, &plan->upper.items, &plan->upper.count, &plan->upper.capacity);
    if (strcasecmp(name, "lower") == 0)
        return read_parts(s, &plan->lower.items, &plan->lower.count, &plan->lower.capacity);
    if (strcasecmp(name, "gap") == 0)
        read_length(s, &plan->gap);
    else if (strcasecmp(name, "ramp") == 0)
        read_length(s, &plan->ramp);
    else if (strcasecmp(name, "spread") == 0)
        read_length(s, &plan->spread);
    else if (strcasecmp(name, "limit") == 0)
        read_length(s, &plan->limit);
    else
        COMPLAIN(s, "unknown word '%s'; known are gap upper lower ramp spread limit thin zig-zag roll tuck", name);
    return 0;
}

static void split_words(char *text, Statement *s)
{
    text[strcspn(text, "#")] = '\0';
    s->count = 0;
    for (char *word = strtok(text, " \t\r"); word; word = strtok(NULL, " \t\r")) {
        if (s->count == WORDS) {
            COMPLAIN(s, "more than %d words in one line", (int)WORDS);
            s->count = 0;
            return;
        }
        s->word[s->count++] = word;
    }
}

static void check_complete(const FoldPlan *plan, Statement *s)
{
    const bool complete = plan->gap > 0.0 && plan->upper.count > 0 && plan->lower.count > 0 && plan->folds.count > 0;
    if (complete || s->diagnostics->errors > 0) return;
    s->source.line = 1;
    COMPLAIN(s, "'%s' is missing",
             plan->gap > 0.0 ? plan->upper.count == 0   ? "upper PART ..."
                               : plan->lower.count == 0 ? "lower PART ..."
                                                        : "thin, zig-zag, roll or tuck"
                             : "gap LENGTH");
}

int fold_read(const char *path, FoldPlan *plan, Diagnostics *diagnostics)
{
    *plan = (FoldPlan){0};
    Statement s = {.source = {diagnostics_add_file(diagnostics, path), 0}, .diagnostics = diagnostics};
    DeckFile file = {0};
    bool no_memory = false;
    const char *wrong = deck_file_read(path, &file, &no_memory);
    if (wrong) {
        diagnostics_add(diagnostics, no_memory ? SEVERITY_ENVIRONMENT : SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "%s: %s", path, wrong);
        return -1;
    }
    int status = 0;
    for (char *line = file.text, *next; line && !status; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        s.source.line++;
        split_words(line, &s);
        if (s.count > 0) status = read_statement(&s, plan);
    }
    memory_free(file.text);
    if (status)
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "not enough memory");
    else
        check_complete(plan, &s);
    if (!(plan->limit > 0.0)) plan->limit = 0.2;
    return diagnostics->errors || diagnostics->environment ? -1 : 0;
}

void fold_plan_free(FoldPlan *plan)
{
    memory_free(plan->upper.items);
    memory_free(plan->lower.items);
    memory_free(plan->folds.items);
    *plan = (FoldPlan){0};
}
