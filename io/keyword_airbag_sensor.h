/* The sensor's cards behind card 1 of every *AIRBAG keyword. */
#ifndef BILLOW_KEYWORD_AIRBAG_SENSOR_H
#define BILLOW_KEYWORD_AIRBAG_SENSOR_H

#include "io/keyword_table.h"

enum { AIRBAG_SENSOR_CARD_COUNT = 5 };
extern const FieldSpec airbag_sensor_count_fields[1], airbag_sensor_constant_fields[5],
    airbag_sensor_acceleration_fields[5], airbag_sensor_velocity_fields[4], airbag_sensor_displacement_fields[4];

/* To stand in the list of cards behind card 1. */
#define AIRBAG_SENSOR_CARDS                                                                                            \
    {"card 2a", "if RBID > 0", CARD_FIELDS(airbag_sensor_count_fields)},                                               \
        {"card 2a.1", "if RBID > 0, as many as N needs", CARD_FIELDS(airbag_sensor_constant_fields)},                  \
        {"card 2b.1", "if RBID < 0", CARD_FIELDS(airbag_sensor_acceleration_fields)},                                  \
        {"card 2b.2", "if RBID < 0", CARD_FIELDS(airbag_sensor_velocity_fields)},                                      \
    {                                                                                                                  \
        "card 2b.3", "if RBID < 0", CARD_FIELDS(airbag_sensor_displacement_fields)                                     \
    }

/* Reads the cards that bag->rbid asks for; first: the number of card 2a in the keyword's list. Converts the id RBID.
 * Returns 0, or -1 after reporting. */
int airbag_read_sensor(KeywordRead *read, int first, AirbagDefinition *bag);

#endif
