/* *ELEMENT_DISCRETE, *SECTION_DISCRETE and the materials of springs and dampers. */
#include "io/keyword_table.h"

enum { SECTION_TITLE };

typedef struct DiscreteCard {
    DiscreteDefinition discrete;
    int print;
} DiscreteCard;
#define AT(member) offsetof(DiscreteCard, member)
static const FieldSpec discrete_fields[] = {
    {"EID", 'I', 8, AT(discrete.id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"PID", 'I', 8, AT(discrete.part), 0.0, false, FIELD_USED, SCALE_ID_PART},
    {"N1", 'I', 8, AT(discrete.node[0]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N2", 'I', 8, AT(discrete.node[1]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"VID", 'I', 8, AT(discrete.vid), 0.0, false, FIELD_REFUSED, SCALE_ID_DEFINE},
    {"S", 'F', 16, AT(discrete.s), 1.0, true, FIELD_USED, SCALE_NONE},
    {"PF", 'I', 8, AT(print), 0.0, false, FIELD_LISTED, SCALE_NONE},
    {"OFFSET", 'F', 16, AT(discrete.offset), 0.0, false, FIELD_USED, SCALE_LENGTH},
};
#undef AT
static const CardSpec discrete_cards[] = {{"card 1", "one for each element", CARD_FIELDS(discrete_fields)}};

static void read_discrete(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        DiscreteCard card = {0};
        if (keyword_card(read, 0, &card, true, &card.discrete.source)) continue;
        if (!keyword_check_id(read, card.discrete.id, "EID", card.discrete.source)) continue;
        if (!keyword_check_id(read, card.discrete.node[0], "N1", card.discrete.source)) continue;
        if (card.discrete.node[1] != 0 && !keyword_check_id(read, card.discrete.node[1], "N2", card.discrete.source))
            continue;
        DiscreteDefinition *discrete = KEYWORD_APPEND(read, read->definitions->discretes);
        if (discrete) *discrete = card.discrete;
    }
}

#define AT(member) offsetof(SectionDiscreteDefinition, member)
static const FieldSpec section_discrete_fields[] = {
    CARD_INT("SECID", id, USED, ID_OTHER), CARD_INT("DRO", dro, REFUSED, NONE),  CARD_REAL("KD", kd, REFUSED, NONE),
    CARD_REAL("V0", v0, LISTED, VELOCITY), CARD_REAL("CL", cl, REFUSED, LENGTH), CARD_REAL("FD", fd, REFUSED, LENGTH),
};
static const FieldSpec section_limit_fields[] = {
    CARD_REAL("CDL", cdl, REFUSED, LENGTH),
    CARD_REAL("TDL", tdl, REFUSED, LENGTH),
};
#undef AT
static const CardSpec section_discrete_cards[] = {
    {"card 1", "one for each section", CARD_FIELDS(section_discrete_fields)},
    {"card 2", "one for each section", CARD_FIELDS(section_limit_fields)},
};

static void read_section_discrete(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        SectionDiscreteDefinition card = {0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, SECTION_TITLE, title);
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (card_left(read->cards) && keyword_card(read, 1, &card, false, NULL)) status = -1;
        if (status || !keyword_check_id(read, card.id, "SECID", card.source)) continue;
        SectionDiscreteDefinition *section = KEYWORD_APPEND(read, read->definitions->discrete_sections);
        if (section) *section = card;
    }
}

typedef struct SpringCard {
    MaterialDefinition material;
    int lcr;
} SpringCard;
#define AT(member) offsetof(SpringCard, member)
static const FieldSpec spring_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_REAL("K", material.k, USED, NONE),
};
static const FieldSpec spring_curve_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_INT("LCD", material.lcd, USED, ID_FUNCTION),
    CARD_INT("LCR", lcr, REFUSED, ID_FUNCTION),
};
static const FieldSpec damper_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_REAL("DC", material.dc, USED, MASS_FLOW), /* force over velocity: a mass over time */
};
static const FieldSpec damper_curve_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_INT("LCDR", material.lcdr, USED, ID_FUNCTION),
};
#undef AT
static const CardSpec spring_cards[] = {{"card 1", "", CARD_FIELDS(spring_fields)}};
static const CardSpec spring_curve_cards[] = {{"card 1", "", CARD_FIELDS(spring_curve_fields)}};
static const CardSpec damper_cards[] = {{"card 1", "", CARD_FIELDS(damper_fields)}};
static const CardSpec damper_curve_cards[] = {{"card 1", "", CARD_FIELDS(damper_curve_fields)}};

static void read_material(KeywordRead *read, MaterialKind kind, const char *curve_field)
{
    SpringCard card = {.material = {.kind = kind, .keyword = read->spec->name}};
    MaterialDefinition *material = &card.material;
    keyword_title(read, SECTION_TITLE, material->title);
    if (keyword_card(read, 0, &card, true, &material->source)) return;
    keyword_finish(read);
    if (!keyword_check_id(read, material->id, "MID", material->source)) return;
    if (curve_field && material->lcd + material->lcdr <= 0) {
        keyword_error(read, material->source, "%s must name the curve of the force", curve_field);
        return;
    }
    /* force per length: a pressure times a length */
    material->k = keyword_scale(read, keyword_scale(read, material->k, SCALE_PRESSURE), SCALE_LENGTH);
    MaterialDefinition *record = KEYWORD_APPEND(read, read->definitions->materials);
    if (record) *record = *material;
}

static void read_spring(KeywordRead *read)
{
    read_material(read, MATERIAL_SPRING, NULL);
}

static void read_spring_curve(KeywordRead *read)
{
    read_material(read, MATERIAL_SPRING, "LCD");
}

static void read_damper(KeywordRead *read)
{
    read_material(read, MATERIAL_DAMPER, NULL);
}

static void read_damper_curve(KeywordRead *read)
{
    read_material(read, MATERIAL_DAMPER, "LCDR");
}

static const KeywordSpec specs[] = {
    {.name = "*ELEMENT_DISCRETE",
     .cards = discrete_cards,
     .card_count = 1,
     .read = read_discrete,
     .remark =
         "Springs and dampers along the line from N1 to N2; S is a factor on their forces. N2 = 0: to the ground, "
         "at the place where N1 starts. OFFSET > 0 is an elongation at the start, of springs between two nodes."},
    {.name = "*SECTION_DISCRETE",
     .options = {"TITLE"},
     .cards = section_discrete_cards,
     .card_count = 2,
     .read = read_section_discrete,
     .remark = "Translational springs and dampers without limits."},
    {.name = "*MAT_SPRING_ELASTIC",
     .aliases = {"*MAT_S01"},
     .options = {"TITLE"},
     .cards = spring_cards,
     .card_count = 1,
     .read = read_spring,
     .remark = "Force K times the elongation, pull and push."},
    {.name = "*MAT_DAMPER_VISCOUS",
     .aliases = {"*MAT_S02"},
     .options = {"TITLE"},
     .cards = damper_cards,
     .card_count = 1,
     .read = read_damper,
     .remark = "Force DC times the rate of the length. The stable step counts with it (docs/theory.md, K11); what it "
               "takes is in the damping energy."},
    {.name = "*MAT_SPRING_NONLINEAR_ELASTIC",
     .aliases = {"*MAT_S04"},
     .options = {"TITLE"},
     .cards = spring_curve_cards,
     .card_count = 1,
     .read = read_spring_curve,
     .remark = "Force by the curve LCD of the elongation: from negative abscissae (push) through the origin, nowhere "
               "falling; beyond its ends it goes on with the slope there. To the ground only pull counts. Tables are "
               "refused."},
    {.name = "*MAT_DAMPER_NONLINEAR_VISCOUS",
     .aliases = {"*MAT_S05"},
     .options = {"TITLE"},
     .cards = damper_curve_cards,
     .card_count = 1,
     .read = read_damper_curve,
     .remark = "Force by the curve LCDR of the rate of the length; for the curve as for LCD of "
               "*MAT_SPRING_NONLINEAR_ELASTIC."},
};

const KeywordFamily keyword_family_springs = {"Springs and dampers", specs, (int)(sizeof specs / sizeof *specs)};
