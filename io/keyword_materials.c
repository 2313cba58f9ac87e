/* *MAT_ELASTIC, *MAT_NULL, *MAT_RIGID. */
#include "io/keyword_table.h"

#define AT(member) offsetof(MaterialDefinition, member)
static const FieldSpec elastic_fields[] = {
    CARD_INT("MID", id, USED, ID_MATERIAL), CARD_REAL("RO", ro, USED, DENSITY), CARD_REAL("E", e, USED, PRESSURE),
    CARD_REAL("PR", pr, USED, NONE),        CARD_REAL("DA", da, LISTED, NONE),  CARD_REAL("DB", db, LISTED, NONE),
    CARD_REAL("K", k, LISTED, NONE),
};
static const FieldSpec null_fields[] = {
    CARD_INT("MID", id, USED, ID_MATERIAL),  CARD_REAL("RO", ro, USED, DENSITY),
    CARD_REAL("PC", pc, LISTED, PRESSURE),   CARD_REAL("MU", mu, LISTED, NONE),
    CARD_REAL("TEROD", terod, LISTED, NONE), CARD_REAL("CEROD", cerod, LISTED, NONE),
    CARD_REAL("YM", e, LISTED, PRESSURE),    CARD_REAL("PR", pr, LISTED, NONE),
};
static const FieldSpec rigid_fields[] = {
    CARD_INT("MID", id, USED, ID_MATERIAL),    CARD_REAL("RO", ro, USED, DENSITY),
    CARD_REAL("E", rigid.e, LISTED, PRESSURE), CARD_REAL("PR", rigid.pr, LISTED, NONE),
    CARD_REAL("N", rigid.n, REFUSED, NONE),    CARD_REAL("COUPLE", rigid.couple, REFUSED, NONE),
    CARD_REAL("M", rigid.m, REFUSED, NONE),    CARD_TEXT("ALIAS", rigid.alias, 10, REFUSED),
};
static const FieldSpec rigid_constraint_fields[] = {
    CARD_REAL("CMO", rigid.cmo, USED, NONE),
    CARD_REAL("CON1", rigid.con1, USED, NONE),
    CARD_REAL("CON2", rigid.con2, USED, NONE),
};
static const FieldSpec rigid_output_fields[] = {
    CARD_REAL("LCO/A1", rigid.lco_or_a1, USED, NONE),
    CARD_REAL("A2", rigid.a2, USED, NONE),
    CARD_REAL("A3", rigid.a3, USED, NONE),
    CARD_REAL("V1", rigid.v1, USED, NONE),
    CARD_REAL("V2", rigid.v2, USED, NONE),
    CARD_REAL("V3", rigid.v3, USED, NONE),
};
#undef AT

enum { MATERIAL_TITLE }; /* place of TITLE among the options */
static const CardSpec elastic_cards[] = {{"card 1", "", CARD_FIELDS(elastic_fields)}};
static const CardSpec null_cards[] = {{"card 1", "", CARD_FIELDS(null_fields)}};
static const CardSpec rigid_cards[] = {
    {"card 1", "", CARD_FIELDS(rigid_fields)},
    {"card 2", "", CARD_FIELDS(rigid_constraint_fields)},
    {"card 3", "may be left out", CARD_FIELDS(rigid_output_fields)},
};

static void store_material(KeywordRead *read, const MaterialDefinition *card)
{
    if (!keyword_check_id(read, card->id, "MID", card->source)) return;
    MaterialDefinition *material = KEYWORD_APPEND(read, read->definitions->materials);
    if (material) *material = *card;
}

static void read_one_card_material(KeywordRead *read, MaterialKind kind)
{
    MaterialDefinition card = {.kind = kind};
    keyword_title(read, MATERIAL_TITLE, card.title);
    if (keyword_card(read, 0, &card, true, &card.source)) return;
    keyword_finish(read);
    store_material(read, &card);
}

static void read_elastic(KeywordRead *read)
{
    read_one_card_material(read, MATERIAL_ELASTIC);
}

static void read_null(KeywordRead *read)
{
    read_one_card_material(read, MATERIAL_NULL);
}

static void read_rigid(KeywordRead *read)
{
    MaterialDefinition card = {.kind = MATERIAL_RIGID};
    keyword_title(read, MATERIAL_TITLE, card.title);
    int status = keyword_card(read, 0, &card, true, &card.source);
    if (keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
    if (keyword_card(read, 2, &card, false, NULL) && keyword_more(read)) status = -1;
    if (status) return;
    keyword_finish(read);
    card.rigid.alias[0] = '\0'; /* blank or a zero, else it was refused */
    /* with CMO = -1 CON1 names a local system */
    if (card.rigid.cmo < 0.0 && !keyword_real_id(read, &card.rigid.con1, SCALE_ID_DEFINE, "CON1", card.source)) return;
    store_material(read, &card);
}

static const KeywordSpec specs[] = {
    {.name = "*MAT_ELASTIC",
     .aliases = {"*MAT_001", "*MAT_1"},
     .options = {"TITLE"},
     .cards = elastic_cards,
     .card_count = 1,
     .read = read_elastic,
     .remark = "Membranes only. The option FLUID is refused."},
    {.name = "*MAT_NULL",
     .aliases = {"*MAT_009", "*MAT_9"},
     .options = {"TITLE"},
     .cards = null_cards,
     .card_count = 1,
     .read = read_null,
     .remark = "Mass and a place in the bag's surface, no stress."},
    {.name = "*MAT_RIGID",
     .aliases = {"*MAT_020", "*MAT_20"},
     .options = {"TITLE"},
     .cards = rigid_cards,
     .card_count = 3,
     .read = read_rigid,
     .remark =
         "E and PR serve contact only. Parts of one material are one body each. Card 3 is the frame of *AIRBAG's "
         "sensors: "
         "LCO a coordinate system at time 0, or x along A and y in the plane of A and V; blank: the principal axes."},
};

const KeywordFamily keyword_family_materials = {"Materials", specs, (int)(sizeof specs / sizeof *specs)};
