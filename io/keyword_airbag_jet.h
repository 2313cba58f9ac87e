/* The jetting cards of *AIRBAG_WANG_NEFSKE and *AIRBAG_HYBRID. */
#ifndef BILLOW_KEYWORD_AIRBAG_JET_H
#define BILLOW_KEYWORD_AIRBAG_JET_H

#include "io/keyword_table.h"

extern const FieldSpec airbag_jet_cone_fields[8], airbag_jet_multiple_fields[8], airbag_jet_focus_fields[8],
    airbag_jet_spare_focus_fields[8], airbag_jet_react_fields[1];

/* To stand in the lists of cards, in this order. */
#define AIRBAG_JET_CARDS                                                                                               \
    {"card 9a", "with JETTING", CARD_FIELDS(airbag_jet_cone_fields)},                                                  \
        {"card 9b", "with MULTIPLE_JETTING", CARD_FIELDS(airbag_jet_multiple_fields)},                                 \
        {"card 10", "with JETTING or MULTIPLE_JETTING", CARD_FIELDS(airbag_jet_focus_fields)},                         \
    {                                                                                                                  \
        "card 11", "with CM", CARD_FIELDS(airbag_jet_react_fields)                                                     \
    }
#define AIRBAG_HYBRID_JET_CARDS                                                                                        \
    {"card 6", "with JETTING", CARD_FIELDS(airbag_jet_cone_fields)},                                                   \
        {"card 7", "with JETTING", CARD_FIELDS(airbag_jet_spare_focus_fields)},                                        \
    {                                                                                                                  \
        "card 8", "with CM", CARD_FIELDS(airbag_jet_react_fields)                                                      \
    }

/* Options of the keyword, and the numbers of its cards in its list. */
typedef struct JetOptions {
    bool jetting, multiple, cm;
    int shape_card, focus_card, react_card; /* shape: that of the option given */
} JetOptions;

/* Reads the cards of the options given into bag->jet. Returns 0, or -1 after reporting. */
int airbag_read_jet(KeywordRead *read, const JetOptions *options, AirbagDefinition *bag);

#endif
