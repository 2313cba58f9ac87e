/* *ELEMENT_MASS, _NODE_SET, _PART, _PART_SET. */
#include "io/keyword_table.h"

#define AT(member) offsetof(MassDefinition, member)
static const FieldSpec node_fields[] = {
    {"EID", 'I', 8, AT(id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"NID", 'I', 8, AT(target), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"MASS", 'F', 16, AT(mass), 0.0, false, FIELD_USED, SCALE_MASS},
    {"PID", 'I', 8, AT(part), 0.0, false, FIELD_USED, SCALE_ID_PART},
};
static const FieldSpec set_fields[] = {
    {"EID", 'I', 8, AT(id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"NSID", 'I', 8, AT(target), 0.0, false, FIELD_USED, SCALE_ID_SET},
    {"MASS", 'F', 16, AT(mass), 0.0, false, FIELD_USED, SCALE_MASS},
    {"PID", 'I', 8, AT(part), 0.0, false, FIELD_USED, SCALE_ID_PART},
};
#undef AT

/* LCID would make the mass a function of time. */
#define AT(member) offsetof(PartMassDefinition, member)
static const FieldSpec part_fields[] = {
    {"PID", 'I', 8, AT(target), 0.0, false, FIELD_USED, SCALE_ID_PART},
    {"ADDMASS", 'F', 16, AT(addmass), 0.0, false, FIELD_USED, SCALE_MASS},
    {"FINMASS", 'F', 16, AT(finmass), 0.0, false, FIELD_USED, SCALE_MASS},
    {"LCID", 'I', 8, AT(lcid), 0.0, false, FIELD_REFUSED, SCALE_ID_FUNCTION},
    {"MWD", 'I', 8, AT(mwd), 0.0, false, FIELD_LISTED, SCALE_NONE},
};
static const FieldSpec part_set_fields[] = {
    {"PSID", 'I', 8, AT(target), 0.0, false, FIELD_USED, SCALE_ID_SET},
    {"ADDMASS", 'F', 16, AT(addmass), 0.0, false, FIELD_USED, SCALE_MASS},
    {"FINMASS", 'F', 16, AT(finmass), 0.0, false, FIELD_USED, SCALE_MASS},
    {"LCID", 'I', 8, AT(lcid), 0.0, false, FIELD_REFUSED, SCALE_ID_FUNCTION},
    {"MWD", 'I', 8, AT(mwd), 0.0, false, FIELD_USED, SCALE_NONE},
};
#undef AT

static const CardSpec node_cards[] = {{"card 1", "one for each mass", CARD_FIELDS(node_fields)}};
static const CardSpec set_cards[] = {{"card 1", "one for each mass", CARD_FIELDS(set_fields)}};
static const CardSpec part_cards[] = {{"card 1", "one for each part", CARD_FIELDS(part_fields)}};
static const CardSpec part_set_cards[] = {{"card 1", "one for each part set", CARD_FIELDS(part_set_fields)}};

static void read_masses(KeywordRead *read, bool is_set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        MassDefinition card = {.is_set = is_set};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.target, is_set ? "NSID" : "NID", card.source)) continue;
        if (card.mass < 0.0)
            keyword_error(read, card.source, "MASS = %g of mass element %d is negative", card.mass, card.id);
        if (card.mass == 0.0)
            keyword_warning(read, card.source, "mass element %d has no effect: its MASS is 0", card.id);
        if (!(card.mass > 0.0)) continue;
        MassDefinition *mass = KEYWORD_APPEND(read, read->definitions->masses);
        if (mass) *mass = card;
    }
}

static void read_node_mass(KeywordRead *read)
{
    read_masses(read, false);
}

static void read_set_mass(KeywordRead *read)
{
    read_masses(read, true);
}

/* Exactly one of ADDMASS and FINMASS, positive. */
static bool check_part_mass(const KeywordRead *read, const PartMassDefinition *card)
{
    const char *field = card->addmass < 0.0 ? "ADDMASS" : card->finmass < 0.0 ? "FINMASS" : NULL;
    if (field)
        keyword_error(read, card->source, "%s = %g must not be negative", field,
                      card->addmass < 0.0 ? card->addmass : card->finmass);
    else if (card->addmass > 0.0 && card->finmass > 0.0)
        keyword_error(read, card->source, "ADDMASS = %g and FINMASS = %g are both given; leave one of them at 0",
                      card->addmass, card->finmass);
    else if (!(card->addmass > 0.0) && !(card->finmass > 0.0))
        keyword_error(read, card->source,
                      "neither ADDMASS nor FINMASS is given; give one of them, or leave the card out");
    else
        return true;
    return false;
}

static void read_part_masses(KeywordRead *read, bool is_set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        PartMassDefinition card = {.is_set = is_set};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.target, is_set ? "PSID" : "PID", card.source)) continue;
        if (!check_part_mass(read, &card)) continue;
        if (is_set && card.mwd != 0 && card.mwd != 1) {
            keyword_error(read, card.source, "MWD = %d is none of 0 (by area) and 1 (by mass)", card.mwd);
            continue;
        }
        PartMassDefinition *mass = KEYWORD_APPEND(read, read->definitions->part_masses);
        if (mass) *mass = card;
    }
}

static void read_part_mass(KeywordRead *read)
{
    read_part_masses(read, false);
}

static void read_part_set_mass(KeywordRead *read)
{
    read_part_masses(read, true);
}

static const KeywordSpec specs[] = {
    {.name = "*ELEMENT_MASS",
     .cards = node_cards,
     .card_count = 1,
     .read = read_node_mass,
     .remark =
         "A mass on any node, also on one that has no other element: it then moves on its own. On a rigid part or "
         "a nodal rigid body it counts for the body, unless that has the option INERTIA. PID: the part whose "
         "gravity and damping it feels, and for which it counts in matsum. EID names the mass in messages."},
    {.name = "*ELEMENT_MASS_NODE_SET",
     .cards = set_cards,
     .card_count = 1,
     .read = read_set_mass,
     .remark = "As *ELEMENT_MASS; the nodes of the set share MASS equally."},
    {.name = "*ELEMENT_MASS_PART",
     .cards = part_cards,
     .card_count = 1,
     .read = read_part_mass,
     .remark = "Raises the mass per area of the part's shells (per volume of rigid solids) alike. FINMASS is the mass "
               "that the part then has. The stable step becomes longer by it. Card by card in the order of the deck."},
    {.name = "*ELEMENT_MASS_PART_SET",
     .cards = part_set_cards,
     .card_count = 1,
     .read = read_part_set_mass,
     .remark = "As *ELEMENT_MASS_PART for all parts of the set together; MWD = 1 shares by mass in place of area."},
};

const KeywordFamily keyword_family_masses = {"Masses", specs, (int)(sizeof specs / sizeof *specs)};
