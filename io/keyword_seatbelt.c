/* *ELEMENT_SEATBELT, *SECTION_SEATBELT, *MAT_SEATBELT: straps, kept with the discrete elements. */
#include "io/keyword_table.h"

typedef struct BeltCard {
    DiscreteDefinition belt;
    int sbrid, node[2];
} BeltCard;
#define AT(member) offsetof(BeltCard, member)
static const FieldSpec belt_fields[] = {
    {"EID", 'I', 8, AT(belt.id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"PID", 'I', 8, AT(belt.part), 0.0, false, FIELD_USED, SCALE_ID_PART},
    {"N1", 'I', 8, AT(belt.node[0]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N2", 'I', 8, AT(belt.node[1]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"SBRID", 'I', 8, AT(sbrid), 0.0, false, FIELD_REFUSED, SCALE_ID_ELEMENT},
    {"SLEN", 'F', 16, AT(belt.slack), 0.0, false, FIELD_USED, SCALE_LENGTH},
    {"N3", 'I', 8, AT(node[0]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
    {"N4", 'I', 8, AT(node[1]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
};
#undef AT
static const CardSpec belt_cards[] = {{"card 1", "one for each element", CARD_FIELDS(belt_fields)}};

static void read_belt(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        BeltCard card = {.belt = {.is_belt = true}};
        DiscreteDefinition *belt = &card.belt;
        if (keyword_card(read, 0, &card, true, &belt->source)) continue;
        belt->is_belt = true;
        if (!keyword_check_id(read, belt->id, "EID", belt->source)) continue;
        if (!keyword_check_id(read, belt->node[0], "N1", belt->source)) continue;
        if (!keyword_check_id(read, belt->node[1], "N2", belt->source)) continue;
        if (belt->slack < 0.0) {
            keyword_error(read, belt->source, "element %d: SLEN = %g must not be negative", belt->id, belt->slack);
            continue;
        }
        DiscreteDefinition *record = KEYWORD_APPEND(read, read->definitions->discretes);
        if (record) *record = *belt;
    }
}

typedef struct BeltSectionCard {
    SectionDiscreteDefinition section;
    double area, thick;
    int edgset;
} BeltSectionCard;
#define AT(member) offsetof(BeltSectionCard, member)
static const FieldSpec section_fields[] = {
    CARD_INT("SECID", section.id, USED, ID_OTHER),
    CARD_REAL("AREA", area, LISTED, AREA),
    CARD_REAL("THICK", thick, LISTED, LENGTH),
    CARD_INT("EDGSET", edgset, REFUSED, ID_SET),
};
#undef AT
static const CardSpec section_cards[] = {{"card 1", "", CARD_FIELDS(section_fields)}};

enum { BELT_TITLE };

static void read_section(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        BeltSectionCard card = {.area = 0.0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, BELT_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.section.source)) continue;
        if (!keyword_check_id(read, card.section.id, "SECID", card.section.source)) continue;
        SectionDiscreteDefinition *section = KEYWORD_APPEND(read, read->definitions->discrete_sections);
        if (section) *section = card.section;
    }
}

typedef struct BeltMaterialCard {
    MaterialDefinition material;
    double lmin, cse, damp, e;
} BeltMaterialCard;
#define AT(member) offsetof(BeltMaterialCard, member)
static const FieldSpec material_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_REAL("MPUL", material.ro, USED, NONE),
    CARD_INT("LLCID", material.llcid, USED, ID_FUNCTION),
    CARD_INT("ULCID", material.ulcid, USED, ID_FUNCTION),
    CARD_REAL("LMIN", lmin, LISTED, LENGTH),
    CARD_REAL("CSE", cse, LISTED, NONE),
    CARD_REAL("DAMP", damp, LISTED, NONE),
    CARD_REAL("E", e, REFUSED, PRESSURE),
};
#undef AT
static const CardSpec material_cards[] = {{"card 1", "", CARD_FIELDS(material_fields)}};

static void read_material(KeywordRead *read)
{
    BeltMaterialCard card = {.material = {.kind = MATERIAL_BELT, .keyword = "*MAT_SEATBELT"}};
    MaterialDefinition *material = &card.material;
    keyword_title(read, BELT_TITLE, material->title);
    if (keyword_card(read, 0, &card, true, &material->source)) return;
    material->kind = MATERIAL_BELT;
    material->keyword = "*MAT_SEATBELT";
    keyword_finish(read);
    if (!keyword_check_id(read, material->id, "MID", material->source)) return;
    material->ro = keyword_scale(read, keyword_scale(read, material->ro, SCALE_DENSITY), SCALE_AREA); /* per length */
    MaterialDefinition *record = KEYWORD_APPEND(read, read->definitions->materials);
    if (record) *record = *material;
}

static const KeywordSpec specs[] = {
    {.name = "*ELEMENT_SEATBELT",
     .cards = belt_cards,
     .card_count = 1,
     .read = read_belt,
     .remark =
         "Straps that pull only. SLEN is length to spare at the start. Retractors (SBRID), belts of shells (N3, N4) "
         "and the keywords of sliprings and pretensioners are refused."},
    {.name = "*SECTION_SEATBELT",
     .options = {"TITLE"},
     .cards = section_cards,
     .card_count = 1,
     .read = read_section,
     .remark = "Names the part's elements as straps."},
    {.name = "*MAT_SEATBELT",
     .aliases = {"*MAT_B01"},
     .options = {"TITLE"},
     .cards = material_cards,
     .card_count = 1,
     .read = read_material,
     .remark =
         "Force LLCID over the engineering strain L/(L0 + SLEN) - 1, none below 0; mass MPUL per length. Beyond the "
         "first point after the origin a strap comes back along ULCID, shifted to where it turns, which must be "
         "steeper "
         "than LLCID (docs/theory.md, K7). Bending (E) is refused. LMIN serves sliprings; CSE and DAMP belts of "
         "shells."},
};

const KeywordFamily keyword_family_seatbelt = {"Straps", specs, (int)(sizeof specs / sizeof *specs)};
