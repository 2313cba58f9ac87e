/* *ELEMENT_SOLID and *SECTION_SOLID, for rigid parts. */
#include "io/keyword_table.h"

/* A solid's cards: of the ten-node tetrahedron only the refusal is needed. */
typedef struct SolidCard {
    SolidDefinition solid;
    int middle[2];
} SolidCard;

#define NODE_FIELD(name, member)                                                                                       \
    {                                                                                                                  \
        name, 'I', 8, AT(member), 0.0, false, FIELD_USED, SCALE_ID_NODE                                                \
    }
#define NODE_FIELDS                                                                                                    \
    NODE_FIELD("N1", solid.node[0]), NODE_FIELD("N2", solid.node[1]), NODE_FIELD("N3", solid.node[2]),                 \
        NODE_FIELD("N4", solid.node[3]), NODE_FIELD("N5", solid.node[4]), NODE_FIELD("N6", solid.node[5]),             \
        NODE_FIELD("N7", solid.node[6]), NODE_FIELD("N8", solid.node[7])
#define AT(member) offsetof(SolidCard, member)
static const FieldSpec solid_fields[] = {
    {"EID", 'I', 8, AT(solid.id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"PID", 'I', 8, AT(solid.part), 0.0, false, FIELD_USED, SCALE_ID_PART},
    NODE_FIELDS,
};
static const FieldSpec solid_node_fields[] = {
    NODE_FIELDS,
    {"N9", 'I', 8, AT(middle[0]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
    {"N10", 'I', 8, AT(middle[1]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
};
#undef AT

static const CardSpec solid_cards[] = {
    {"card 1", "one for each solid", CARD_FIELDS(solid_fields)},
    {"card 2", "after each card 1 that has no nodes", CARD_FIELDS(solid_node_fields)},
};

/* Blank nodes at the end repeat the last one given, as tetrahedra and wedges are written. A tetrahedron N1 N2 N3 N4 N4
 * N4 N4 N4 becomes the hexahedron with the base N1 N2 N3 N3 and all of its top in N4, which has flat faces. */
static bool complete_nodes(KeywordRead *read, SolidDefinition *solid)
{
    for (int i = 0; i < 8; i++) {
        if (i >= 4 && solid->node[i] == 0) solid->node[i] = solid->node[i - 1];
        if (solid->node[i] > 0) continue;
        keyword_error(read, solid->source, "solid %d: N%d is %d, but must be a node's number", solid->id, i + 1,
                      solid->node[i]);
        return false;
    }
    bool tetrahedron = true;
    for (int i = 4; i < 8; i++) tetrahedron = tetrahedron && solid->node[i] == solid->node[3];
    if (tetrahedron) solid->node[3] = solid->node[2];
    return true;
}

static void read_solid(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        SolidCard card = {0};
        SolidDefinition *solid = &card.solid;
        if (keyword_card(read, 0, &card, true, &solid->source)) continue;
        bool blank = true;
        for (int i = 0; i < 8; i++) blank = blank && solid->node[i] == 0;
        if (blank && keyword_card(read, 1, &card, true, NULL)) continue;
        if (!keyword_check_id(read, solid->id, "EID", solid->source) || !complete_nodes(read, solid)) continue;
        SolidDefinition *record = KEYWORD_APPEND(read, read->definitions->solids);
        if (record) *record = *solid;
    }
}

typedef struct SectionCard {
    SectionSolidDefinition section;
    int aet;
} SectionCard;
#define AT(member) offsetof(SectionCard, member)
static const FieldSpec section_fields[] = {
    CARD_INT("SECID", section.id, USED, ID_OTHER),
    CARD_INT_OR("ELFORM", section.elform, 1, LISTED, NONE),
    CARD_INT("AET", aet, LISTED, NONE),
};
#undef AT

enum { SECTION_TITLE };
static const CardSpec section_cards[] = {{"card 1", "one for each section", CARD_FIELDS(section_fields)}};

static void read_section(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        SectionCard card = {0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, SECTION_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.section.source)) continue;
        if (!keyword_check_id(read, card.section.id, "SECID", card.section.source)) continue;
        if (card.section.elform >= 101 && card.section.elform <= 105) {
            keyword_error(read, card.section.source,
                          "ELFORM = %d is a user-defined element, which billow does not have; a rigid part needs none",
                          card.section.elform);
            return; /* its further cards are not known */
        }
        SectionSolidDefinition *section = KEYWORD_APPEND(read, read->definitions->solid_sections);
        if (section) *section = card.section;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*ELEMENT_SOLID",
     .cards = solid_cards,
     .card_count = 2,
     .read = read_solid,
     .remark = "Of rigid parts only: mass, inertia and outer faces; wedges and tetrahedra repeat nodes or leave them "
               "blank at the end."},
    {.name = "*SECTION_SOLID",
     .options = {"TITLE"},
     .cards = section_cards,
     .card_count = 1,
     .read = read_section,
     .remark = ""},
};

const KeywordFamily keyword_family_solids = {"Solids", specs, (int)(sizeof specs / sizeof *specs)};
