/* *AIRBAG_INTERACTION. */
#include <stdlib.h>

#include "io/keyword_table.h"

#define AT(member) offsetof(InteractionDefinition, member)
static const FieldSpec fields[] = {
    CARD_INT("AB1", ab1, USED, ID_OTHER), CARD_INT("AB2", ab2, USED, ID_OTHER),
    CARD_REAL("AREA", area, USED, NONE),  CARD_REAL("SF", sf, USED, NONE),
    CARD_INT("PID", pid, USED, ID_PART),  CARD_INT("LCID", lcid, USED, ID_FUNCTION),
    CARD_INT("IFLOW", iflow, USED, NONE), CARD_INT("EXCP", excp, USED, NONE),
};
#undef AT

static const CardSpec cards[] = {{"card 1", "one for each pair of bags", CARD_FIELDS(fields)}};

static void read_one(KeywordRead *read)
{
    InteractionDefinition card = {0};
    if (keyword_card(read, 0, &card, true, &card.source)) return;
    if (!keyword_check_id(read, card.ab1, "AB1", card.source) || !keyword_check_id(read, card.ab2, "AB2", card.source))
        return;
    if (card.ab1 == card.ab2) {
        keyword_error(read, card.source, "AB1 and AB2 are both %d, but must name two bags", card.ab1);
        return;
    }
    if (card.lcid < 0) {
        keyword_error(read, card.source, "LCID is %d, but must name the curve of mass flow over pressure difference",
                      card.lcid);
        return;
    }
    if (card.lcid == 0 && card.area == 0.0 && card.pid == 0) {
        keyword_error(read, card.source, "AREA, PID and LCID are all 0: give the opening between the bags");
        return;
    }
    if (card.lcid == 0 && card.sf == 0.0)
        keyword_warning(read, card.source, "SF is 0: no gas passes between airbags %d and %d", card.ab1, card.ab2);
    if (card.excp != 0 && card.pid == 0)
        keyword_warning(read, card.source, "EXCP has no effect without PID, the part that feels no pressure");
    if (card.area < 0.0 && !keyword_real_id(read, &card.area, SCALE_ID_FUNCTION, "AREA", card.source)) return;
    if (card.area > 0.0) card.area = keyword_scale(read, card.area, SCALE_AREA);
    if (card.sf < 0.0 && !keyword_real_id(read, &card.sf, SCALE_ID_FUNCTION, "SF", card.source)) return;
    InteractionDefinition *item = KEYWORD_APPEND(read, read->definitions->interactions);
    if (item) *item = card;
}

static void read_interaction(KeywordRead *read)
{
    do read_one(read);
    while (keyword_more(read) && !read->out_of_memory);
}

static const KeywordSpec specs[] = {
    {.name = "*AIRBAG_INTERACTION",
     .cards = cards,
     .card_count = 1,
     .read = read_interaction,
     .remark =
         "AB1 and AB2 need the option _ID. AREA < 0 names a curve over the absolute pressure of the bag that the gas "
         "leaves; AREA = 0 takes the area of PID, with PID < 0 less what contact blocks. SF < 0 names a curve over "
         "time. LCID, the mass flow over the pressure difference, overrides AREA, SF and PID; LOAD_CURVE and "
         "LINEAR_FLUID take nothing else, and only with each other. IFLOW < 0: only AB1 to AB2, > 0: only back. By "
         "AREA and SF both bags must have the same heat capacities, or both be of HYBRID. EXCP = 1 keeps the "
         "pressure of both bags off PID."},
};

const KeywordFamily keyword_family_airbag_connection = {"Connected airbags", specs,
                                                        (int)(sizeof specs / sizeof *specs)};
