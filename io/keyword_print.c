/* docs/keywords.md, printed from the keyword table. */
#include "io/keyword_table.h"

static const char introduction[] =
    "# Keywords\n"
    "\n"
    "What billow " BILLOW_VERSION
    " reads of LS-DYNA's keyword format. This page is printed from the reader's own table\n"
    "(`io/keyword_*.c`); a test compares the two.\n"
    "\n"
    "Each field is in one of three states:\n"
    "\n"
    "- **used**: it has its effect;\n"
    "- *listed*: it is read and has no effect; a value other than the default is listed as \"read but not used\";\n"
    "- ~~refused~~: a value other than the default is an error, because billow does not have what it asks for.\n"
    "\n"
    "Fields are 10 columns wide unless another width is given; the format `LONG=Y` or a `+` after the keyword makes "
    "them\n"
    "20. `=` gives the default of a blank field, `=!` of a blank or zero one; without it the default is 0. Options may "
    "be\n"
    "written in any order after the keyword. A keyword or an option that is not on this page is an error, since "
    "leaving it\n"
    "out would change the result.\n";

/* Text in which a star or a bracket is meant as such. */
static void print_escaped(const char *text, FILE *stream)
{
    for (; *text; text++) {
        if (*text == '*' || *text == '<') fputc('\\', stream);
        fputc(*text, stream);
    }
}

static void print_field(const FieldSpec *field, FILE *stream)
{
    static const char *const marks[] = {[FIELD_USED] = "**", [FIELD_LISTED] = "*", [FIELD_REFUSED] = "~~"};
    if (field->type == '-') {
        fputs("–", stream);
        return;
    }
    fprintf(stream, "%s%s%s", marks[field->use], field->name, marks[field->use]);
    if (field->columns != 10) fprintf(stream, " [%d]", field->columns);
    if (field->fallback != 0.0) fprintf(stream, " =%s%g", field->zero_is_default ? "!" : "", field->fallback);
}

static void print_card(const CardSpec *card, FILE *stream)
{
    fprintf(stream, "| %s%s%s%s |", card->name, card->when[0] ? " (" : "", card->when, card->when[0] ? ")" : "");
    for (int i = 0; i < card->count; i++) {
        fputs(i ? ", " : " ", stream);
        print_field(&card->fields[i], stream);
    }
    fputs(" |\n", stream);
}

static void print_keyword(const KeywordSpec *spec, FILE *stream)
{
    fprintf(stream, "\n### \\%s\n\n", spec->name);
    for (int i = 0; i < KEYWORD_MAX_ALIASES && spec->aliases[i]; i++)
        fprintf(stream, "%s\\%s%s", i ? ", " : "Also ", spec->aliases[i],
                i + 1 == KEYWORD_MAX_ALIASES || !spec->aliases[i + 1] ? ".\n\n" : "");
    if (spec->options[0]) {
        fputs("Options:", stream);
        for (int i = 0; i < KEYWORD_MAX_OPTIONS && spec->options[i]; i++)
            fprintf(stream, "%s _%s", i ? "," : "", spec->options[i]);
        fputs(".\n\n", stream);
    }
    if (spec->remark[0]) {
        print_escaped(spec->remark, stream);
        fputs("\n\n", stream);
    }
    fputs("| card | fields |\n|---|---|\n", stream);
    for (int i = 0; i < spec->card_count; i++) print_card(&spec->cards[i], stream);
}

/* Keywords without cards of their own: one table for a family. */
static void print_plain(const KeywordFamily *family, KeywordState state, const char *heading, FILE *stream)
{
    bool first = true;
    for (int i = 0; i < family->count; i++) {
        const KeywordSpec *spec = &family->specs[i];
        if (spec->state != state) continue;
        if (first) fprintf(stream, "\n| keyword | %s |\n|---|---|\n", heading);
        first = false;
        fprintf(stream, "| \\%s%s | ", spec->name, spec->prefix ? "..." : "");
        print_escaped(spec->remark, stream);
        fputs(" |\n", stream);
    }
}

void keyword_print_documentation(FILE *stream)
{
    fputs(introduction, stream);
    for (int f = 0; f < keyword_family_count(); f++) {
        const KeywordFamily *family = keyword_family(f);
        fprintf(stream, "\n## %s\n", family->title);
        print_plain(family, KEYWORD_LOADED, "used by the loader", stream);
        print_plain(family, KEYWORD_IGNORED, "why it is skipped, with a note", stream);
        print_plain(family, KEYWORD_REFUSED, "why it is an error, and what to use in its place", stream);
        for (int i = 0; i < family->count; i++)
            if (family->specs[i].state == KEYWORD_READ) print_keyword(&family->specs[i], stream);
    }
}
