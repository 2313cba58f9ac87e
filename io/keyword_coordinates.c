/* *DEFINE_COORDINATE_NODES, _SYSTEM, _VECTOR, *DEFINE_VECTOR, *DEFINE_BOX. */
#include <ctype.h>

#include "io/keyword_table.h"

enum { DEFINE_TITLE }; /* the only option of all of them */

typedef struct NodesCard {
    CoordinateDefinition system;
    char dir[11];
} NodesCard;

#define AT(member) offsetof(NodesCard, member)
static const FieldSpec nodes_fields[] = {
    CARD_INT("CID", system.id, USED, ID_DEFINE),   CARD_INT("N1", system.node[0], USED, ID_NODE),
    CARD_INT("N2", system.node[1], USED, ID_NODE), CARD_INT("N3", system.node[2], USED, ID_NODE),
    CARD_INT("FLAG", system.flag, USED, NONE),     CARD_TEXT("DIR", dir, 10, USED),
};
#undef AT

static const CardSpec nodes_cards[] = {{"card 1", "one for each system", CARD_FIELDS(nodes_fields)}};

static void store_system(KeywordRead *read, const CoordinateDefinition *card)
{
    if (!keyword_check_id(read, card->id, "CID", card->source)) return;
    CoordinateDefinition *system = KEYWORD_APPEND(read, read->definitions->coordinates);
    if (system) *system = *card;
}

static void read_nodes(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        NodesCard card = {.system = {.kind = COORDINATE_NODES}};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, DEFINE_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.system.source)) continue;
        const char dir = (char)toupper((unsigned char)card.dir[0]);
        card.system.dir = dir == '\0' || dir == '0' ? 'X' : dir;
        if (card.system.dir < 'X' || card.system.dir > 'Z') {
            keyword_error(read, card.system.source, "DIR is '%s', but must be X, Y or Z", card.dir);
            continue;
        }
        store_system(read, &card.system);
    }
}

#define AT(member) offsetof(CoordinateDefinition, member)
static const FieldSpec system1_fields[] = {
    CARD_INT("CID", id, USED, ID_DEFINE),      CARD_REAL("XO", origin[0], USED, LENGTH),
    CARD_REAL("YO", origin[1], USED, LENGTH),  CARD_REAL("ZO", origin[2], USED, LENGTH),
    CARD_REAL("XL", x_point[0], USED, LENGTH), CARD_REAL("YL", x_point[1], USED, LENGTH),
    CARD_REAL("ZL", x_point[2], USED, LENGTH), CARD_INT("CIDL", cidl, USED, ID_DEFINE),
};
static const FieldSpec system2_fields[] = {
    CARD_REAL("XP", xy_point[0], USED, LENGTH),
    CARD_REAL("YP", xy_point[1], USED, LENGTH),
    CARD_REAL("ZP", xy_point[2], USED, LENGTH),
};
static const FieldSpec vector_system_fields[] = {
    CARD_INT("CID", id, USED, ID_DEFINE),     CARD_REAL("XX", x_point[0], USED, NONE),
    CARD_REAL("YX", x_point[1], USED, NONE),  CARD_REAL("ZX", x_point[2], USED, NONE),
    CARD_REAL("XV", xy_point[0], USED, NONE), CARD_REAL("YV", xy_point[1], USED, NONE),
    CARD_REAL("ZV", xy_point[2], USED, NONE), CARD_INT("NID", nid, USED, ID_NODE),
};
#undef AT

static const CardSpec system_cards[] = {
    {"card 1", "one for each system", CARD_FIELDS(system1_fields)},
    {"card 2", "one for each system", CARD_FIELDS(system2_fields)},
};
static const CardSpec vector_system_cards[] = {{"card 1", "one for each system", CARD_FIELDS(vector_system_fields)}};

static void read_system(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        CoordinateDefinition card = {.kind = COORDINATE_SYSTEM};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, DEFINE_TITLE, title);
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (keyword_card(read, 1, &card, status == 0, NULL) || status) continue;
        if (card.cidl == 0) { /* points given in another system follow that system */
            keyword_transform_point(read, card.origin);
            keyword_transform_point(read, card.x_point);
            keyword_transform_point(read, card.xy_point);
        }
        store_system(read, &card);
    }
}

static void read_vector_system(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        CoordinateDefinition card = {.kind = COORDINATE_VECTOR};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, DEFINE_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        keyword_transform_vector(read, card.x_point);
        keyword_transform_vector(read, card.xy_point);
        store_system(read, &card);
    }
}

#define AT(member) offsetof(VectorDefinition, member)
static const FieldSpec vector_fields[] = {
    CARD_INT("VID", id, USED, ID_DEFINE),   CARD_REAL("XT", tail[0], USED, LENGTH),
    CARD_REAL("YT", tail[1], USED, LENGTH), CARD_REAL("ZT", tail[2], USED, LENGTH),
    CARD_REAL("XH", head[0], USED, LENGTH), CARD_REAL("YH", head[1], USED, LENGTH),
    CARD_REAL("ZH", head[2], USED, LENGTH), CARD_INT("CID", cid, USED, ID_DEFINE),
};
#undef AT

static const CardSpec vector_cards[] = {{"card 1", "one for each vector", CARD_FIELDS(vector_fields)}};

static void read_vector(KeywordRead *read)
{
    while (keyword_more(read)) {
        VectorDefinition card = {0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, DEFINE_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, "VID", card.source)) continue;
        if (card.cid == 0) {
            keyword_transform_point(read, card.tail);
            keyword_transform_point(read, card.head);
        }
        VectorDefinition *vector = KEYWORD_APPEND(read, read->definitions->vectors);
        if (!vector) return;
        *vector = card;
    }
}

#define AT(member) offsetof(BoxDefinition, member)
static const FieldSpec box_fields[] = {
    CARD_INT("BOXID", id, USED, ID_DEFINE),  CARD_REAL("XMN", low[0], USED, LENGTH),
    CARD_REAL("XMX", high[0], USED, LENGTH), CARD_REAL("YMN", low[1], USED, LENGTH),
    CARD_REAL("YMX", high[1], USED, LENGTH), CARD_REAL("ZMN", low[2], USED, LENGTH),
    CARD_REAL("ZMX", high[2], USED, LENGTH),
};
#undef AT

static const CardSpec box_cards[] = {{"card 1", "one for each box", CARD_FIELDS(box_fields)}};

/* The matrix may mirror or shift the box; the corners then change places. */
static void transform_box(KeywordRead *read, BoxDefinition *box)
{
    keyword_transform_point(read, box->low);
    keyword_transform_point(read, box->high);
    for (int i = 0; i < 3; i++) {
        if (box->low[i] <= box->high[i]) continue;
        const double high = box->low[i];
        box->low[i] = box->high[i];
        box->high[i] = high;
    }
}

static void read_box(KeywordRead *read)
{
    while (keyword_more(read)) {
        BoxDefinition card = {0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, DEFINE_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, "BOXID", card.source)) continue;
        int empty = 0;
        while (empty < 3 && card.low[empty] <= card.high[empty]) empty++;
        if (empty < 3) {
            keyword_error(read, card.source, "box %d holds nothing: %cMN = %g is above %cMX = %g", card.id, 'X' + empty,
                          card.low[empty], 'X' + empty, card.high[empty]);
            continue;
        }
        if (keyword_transform_turns(read)) {
            keyword_error(read, card.source,
                          "box %d cannot be turned by *DEFINE_TRANSFORMATION, since boxes lie along the "
                          "axes; define it in the main deck",
                          card.id);
            continue;
        }
        transform_box(read, &card);
        BoxDefinition *box = KEYWORD_APPEND(read, read->definitions->boxes);
        if (!box) return;
        *box = card;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*DEFINE_COORDINATE_NODES",
     .options = {"TITLE"},
     .cards = nodes_cards,
     .card_count = 1,
     .read = read_nodes,
     .remark = ""},
    {.name = "*DEFINE_COORDINATE_SYSTEM",
     .options = {"TITLE"},
     .cards = system_cards,
     .card_count = 2,
     .read = read_system,
     .remark = ""},
    {.name = "*DEFINE_COORDINATE_VECTOR",
     .options = {"TITLE"},
     .cards = vector_system_cards,
     .card_count = 1,
     .read = read_vector_system,
     .remark = ""},
    {.name = "*DEFINE_VECTOR",
     .options = {"TITLE"},
     .cards = vector_cards,
     .card_count = 1,
     .read = read_vector,
     .remark = "The option NODES is refused."},
    {.name = "*DEFINE_BOX",
     .options = {"TITLE"},
     .cards = box_cards,
     .card_count = 1,
     .read = read_box,
     .remark = "The options ADAPTIVE, LOCAL and others are refused."},
};

const KeywordFamily keyword_family_coordinates = {"Coordinates", specs, (int)(sizeof specs / sizeof *specs)};
