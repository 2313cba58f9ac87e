/* *DAMPING_GLOBAL and *DAMPING_PART_MASS. */
#include "io/keyword_table.h"

#define AT(member) offsetof(DampingDefinition, member)
static const FieldSpec global_fields[] = {
    CARD_INT("LCID", lcid, USED, ID_FUNCTION), CARD_REAL("VALDMP", sf, USED, RATE),
    CARD_REAL("STX", st[0], USED, NONE),       CARD_REAL("STY", st[1], USED, NONE),
    CARD_REAL("STZ", st[2], USED, NONE),       CARD_REAL("SRX", st[3], LISTED, NONE),
    CARD_REAL("SRY", st[4], LISTED, NONE),     CARD_REAL("SRZ", st[5], LISTED, NONE),
};
#define PART_MASS_FIELDS(name, scale)                                                                                  \
    {                                                                                                                  \
        CARD_INT(name, id, USED, scale), CARD_INT("LCID", lcid, USED, ID_FUNCTION),                                    \
            CARD_REAL_OR("SF", sf, 1.0, USED, NONE), CARD_INT("FLAG", flag, USED, NONE),                               \
    }
static const FieldSpec part_fields[] = PART_MASS_FIELDS("PID", ID_PART);
static const FieldSpec set_fields[] = PART_MASS_FIELDS("PSID", ID_SET);
static const FieldSpec factor_fields[] = {
    CARD_REAL("STX", st[0], USED, NONE),   CARD_REAL("STY", st[1], USED, NONE),   CARD_REAL("STZ", st[2], USED, NONE),
    CARD_REAL("SRX", st[3], LISTED, NONE), CARD_REAL("SRY", st[4], LISTED, NONE), CARD_REAL("SRZ", st[5], LISTED, NONE),
};
#undef AT

static const CardSpec global_cards[] = {{"card 1", "", CARD_FIELDS(global_fields)}};
static const CardSpec part_cards[] = {
    {"card 1", "one for each part", CARD_FIELDS(part_fields)},
    {"card 2", "after each card 1 with FLAG = 1", CARD_FIELDS(factor_fields)},
};
static const CardSpec set_cards[] = {
    {"card 1", "one for each part set", CARD_FIELDS(set_fields)},
    {"card 2", "after each card 1 with FLAG = 1", CARD_FIELDS(factor_fields)},
};

static void read_global(KeywordRead *read)
{
    DampingDefinition card = {.is_global = true};
    if (keyword_card(read, 0, &card, true, &card.source)) return;
    keyword_finish(read);
    if (card.lcid != 0) card.sf = 1.0; /* the curve is the damping itself, VALDMP does not count */
    DampingDefinition *damping = KEYWORD_APPEND(read, read->definitions->dampings);
    if (damping) *damping = card;
}

static void read_part_mass(KeywordRead *read, bool is_set)
{
    while (keyword_more(read)) {
        DampingDefinition card = {.is_set = is_set};
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (card.flag == 1 && keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
        if (status || !keyword_check_id(read, card.id, is_set ? "PSID" : "PID", card.source)) continue;
        DampingDefinition *damping = KEYWORD_APPEND(read, read->definitions->dampings);
        if (!damping) return;
        *damping = card;
    }
}

static void read_part(KeywordRead *read)
{
    read_part_mass(read, false);
}

static void read_part_set(KeywordRead *read)
{
    read_part_mass(read, true);
}

static const KeywordSpec specs[] = {
    {.name = "*DAMPING_GLOBAL",
     .cards = global_cards,
     .card_count = 1,
     .read = read_global,
     .remark = "VALDMP counts if LCID = 0. STX, STY, STZ all zero means 1."},
    {.name = "*DAMPING_PART_MASS",
     .cards = part_cards,
     .card_count = 2,
     .read = read_part,
     .remark = "STX, STY, STZ all zero means 1."},
    {.name = "*DAMPING_PART_MASS_SET",
     .cards = set_cards,
     .card_count = 2,
     .read = read_part_set,
     .remark = "STX, STY, STZ all zero means 1."},
};

const KeywordFamily keyword_family_damping = {"Damping", specs, (int)(sizeof specs / sizeof *specs)};
