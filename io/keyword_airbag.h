/* What the readers of all control-volume models share: the ID card, card 1, storing. */
#ifndef BILLOW_KEYWORD_AIRBAG_H
#define BILLOW_KEYWORD_AIRBAG_H

#include "io/keyword_airbag_sensor.h"
#include "io/keyword_table.h"

/* Every airbag keyword has _ID as its first option and these as its first cards. */
enum { AIRBAG_OPTION_ID };
enum {
    AIRBAG_CARD_ID,
    AIRBAG_CARD_CORE,
    AIRBAG_CARD_SENSOR,
    AIRBAG_CARD_MODEL = AIRBAG_CARD_SENSOR + AIRBAG_SENSOR_CARD_COUNT
};
enum { AIRBAG_ID_FIELDS = 2, AIRBAG_CORE_FIELDS = 8 };
extern const FieldSpec airbag_id_fields[AIRBAG_ID_FIELDS], airbag_core_fields[AIRBAG_CORE_FIELDS];
#define AIRBAG_CARDS                                                                                                   \
    {"ID card", "with ID", airbag_id_fields, AIRBAG_ID_FIELDS},                                                        \
        {"card 1", "", airbag_core_fields, AIRBAG_CORE_FIELDS}, AIRBAG_SENSOR_CARDS

/* Reads the ID card, card 1 and the sensor's cards. 0, or -1 after reporting. */
int airbag_read_core(KeywordRead *read, AirbagDefinition *bag);

/* Checks A23 and OPT and converts A23. 0, or -1 after reporting. */
int airbag_check_vents(const KeywordRead *read, AirbagDefinition *bag);

/* Appends the record to the definitions. */
void airbag_store(KeywordRead *read, const AirbagDefinition *card);

#endif
