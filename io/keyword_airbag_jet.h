/* The jetting cards of *AIRBAG_WANG_NEFSKE and *AIRBAG_HYBRID. */
#ifndef BILLOW_KEYWORD_AIRBAG_JET_H
#define BILLOW_KEYWORD_AIRBAG_JET_H

#include "io/keyword_table.h"

enum { AIRBAG_JET_CARD_COUNT = 4 };
extern const FieldSpec airbag_jet_cone_fields[8], airbag_jet_multiple_fields[8], airbag_jet_focus_fields[8],
    airbag_jet_react_fields[1];

/* To stand in the list of cards, in this order. HYBRID has the same cards under other numbers. */
#define AIRBAG_JET_CARDS                                                                                               \
    {"card 9a", "with JETTING", CARD_FIELDS(airbag_jet_cone_fields)},                                                  \
        {"card 9b", "with MULTIPLE_JETTING", CARD_FIELDS(airbag_jet_multiple_fields)},                                 \
        {"card 10", "with JETTING or MULTIPLE_JETTING", CARD_FIELDS(airbag_jet_focus_fields)},                         \
    {                                                                                                                  \
        "card 11", "with CM", CARD_FIELDS(airbag_jet_react_fields)                                                     \
    }

/* Reads the cards of the options given into bag->jet; first: the number of card 9a in the keyword's list. Returns 0, or
 * -1 after reporting. */
int airbag_read_jet(KeywordRead *read, int first, bool jetting, bool multiple, bool cm, AirbagDefinition *bag);

#endif
