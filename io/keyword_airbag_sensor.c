/* The sensor's cards behind card 1 of every *AIRBAG keyword. */
#include "io/keyword_airbag_sensor.h"

#define AT(member) offsetof(SensorCards, member)
const FieldSpec airbag_sensor_count_fields[1] = {CARD_INT("N", n, USED, NONE)};
const FieldSpec airbag_sensor_constant_fields[5] = {
    CARD_REAL("C1", c[0], USED, NONE), CARD_REAL("C2", c[1], USED, NONE), CARD_REAL("C3", c[2], USED, NONE),
    CARD_REAL("C4", c[3], USED, NONE), CARD_REAL("C5", c[4], USED, NONE),
};
const FieldSpec airbag_sensor_acceleration_fields[5] = {
    CARD_REAL("AX", a[0], USED, ACCELERATION), CARD_REAL("AY", a[1], USED, ACCELERATION),
    CARD_REAL("AZ", a[2], USED, ACCELERATION), CARD_REAL("AMAG", a[3], USED, ACCELERATION),
    CARD_REAL("TDUR", tdur, USED, TIME),
};
const FieldSpec airbag_sensor_velocity_fields[4] = {
    CARD_REAL("DVX", dv[0], USED, VELOCITY),
    CARD_REAL("DVY", dv[1], USED, VELOCITY),
    CARD_REAL("DVZ", dv[2], USED, VELOCITY),
    CARD_REAL("DVMAG", dv[3], USED, VELOCITY),
};
const FieldSpec airbag_sensor_displacement_fields[4] = {
    CARD_REAL("UX", u[0], USED, LENGTH),
    CARD_REAL("UY", u[1], USED, LENGTH),
    CARD_REAL("UZ", u[2], USED, LENGTH),
    CARD_REAL("UMAG", u[3], USED, LENGTH),
};
#undef AT

enum { COUNT_CARD, CONSTANT_CARD, ACCELERATION_CARD, VELOCITY_CARD, DISPLACEMENT_CARD };

static int read_constants(KeywordRead *read, int first, SensorCards *sensor)
{
    Source source;
    if (keyword_card(read, first + COUNT_CARD, sensor, true, &source)) return -1;
    if (sensor->n < 0 || sensor->n > BILLOW_SENSOR_CONSTANTS) {
        keyword_error(read, source, "N is %d, but a sensor has 0 to %d constants", sensor->n, BILLOW_SENSOR_CONSTANTS);
        return -1;
    }
    for (int i = 0; i < sensor->n; i += 5) {
        SensorCards card = {0};
        if (keyword_card(read, first + CONSTANT_CARD, &card, true, &source)) return -1;
        for (int k = 0; k < 5 && i + k < BILLOW_SENSOR_CONSTANTS; k++) sensor->c[i + k] = card.c[k];
    }
    return 0;
}

static int read_levels(KeywordRead *read, int first, AirbagDefinition *bag)
{
    SensorCards *sensor = &bag->sensor;
    if (keyword_card(read, first + ACCELERATION_CARD, sensor, true, NULL) ||
        keyword_card(read, first + VELOCITY_CARD, sensor, true, NULL) ||
        keyword_card(read, first + DISPLACEMENT_CARD, sensor, true, NULL))
        return -1;
    bool any = false;
    for (int i = 0; i < 4; i++) {
        if (sensor->a[i] < 0.0 || sensor->dv[i] < 0.0 || sensor->u[i] < 0.0) {
            keyword_error(read, bag->card1, "a level of the sensor is negative; levels are absolute values");
            return -1;
        }
        any |= sensor->a[i] > 0.0 || sensor->dv[i] > 0.0 || sensor->u[i] > 0.0;
    }
    if (!any)
        keyword_warning(read, bag->card1,
                        "RBID = %d: all levels of the sensor are 0, so that it never fires and no gas flows in",
                        bag->rbid);
    return 0;
}

int airbag_read_sensor(KeywordRead *read, int first, AirbagDefinition *bag)
{
    if (bag->rbid == 0) return 0;
    double id = bag->rbid;
    if (!keyword_real_id(read, &id, SCALE_ID_PART, "RBID", bag->card1)) return -1;
    bag->rbid = (int)id;
    return bag->rbid > 0 ? read_constants(read, first, &bag->sensor) : read_levels(read, first, bag);
}
