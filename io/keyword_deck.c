/* *TITLE, and what the loader of the deck uses up itself. */
#include <string.h>

#include "io/keyword_table.h"

#define AT(member) offsetof(Definitions, member)
static const FieldSpec title_fields[] = {CARD_TEXT("TITLE", title, 80, USED)};
#undef AT

static const CardSpec title_cards[] = {{"card 1", "", CARD_FIELDS(title_fields)}};

static void read_title(KeywordRead *read)
{
    char title[BILLOW_TITLE_LENGTH] = "";
    if (!card_text(read->cards, title, sizeof title)) return;
    memcpy(read->definitions->title, title, sizeof title);
    keyword_finish(read);
}

#define LOADED(keyword, text)                                                                                          \
    {                                                                                                                  \
        .name = keyword, .state = KEYWORD_LOADED, .remark = text                                                       \
    }
static const KeywordSpec specs[] = {
    LOADED("*KEYWORD", "LONG=Y and I10=Y set the format of all that follows."),
    {.name = "*TITLE", .cards = title_cards, .card_count = 1, .read = read_title, .remark = ""},
    LOADED("*COMMENT", "Skipped."),
    LOADED("*PARAMETER", "Also LOCAL, MUTABLE. Used as &name or -&name in any field."),
    LOADED("*PARAMETER_EXPRESSION", "Also <expression> in any field."),
    LOADED("*PARAMETER_DUPLICATION", "What a second definition of a parameter means."),
    LOADED("*INCLUDE", ""),
    LOADED("*INCLUDE_PATH", "Also RELATIVE."),
    LOADED("*INCLUDE_TRANSFORM", "Id offsets, unit factors and a transformation."),
    LOADED("*DEFINE_TRANSFORMATION", "For *INCLUDE_TRANSFORM."),
    LOADED("*END", "What follows it is not read."),
};

const KeywordFamily keyword_family_deck = {"The deck", specs, (int)(sizeof specs / sizeof *specs)};
