/* *LOAD_NODE, *LOAD_SEGMENT, *LOAD_BODY, *LOAD_GRAVITY_PART. */
#include <math.h>
#include <string.h>

#include "io/keyword_table.h"

#define AT(member) offsetof(NodeLoadDefinition, member)
#define NODE_LOAD_FIELDS(name, scale)                                                                                  \
    {                                                                                                                  \
        CARD_INT(name, id, USED, scale), CARD_INT("DOF", dof, USED, NONE), CARD_INT("LCID", lcid, USED, ID_FUNCTION),  \
            CARD_REAL_OR("SF", sf, 1.0, USED, NONE), CARD_INT("CID", cid, USED, ID_DEFINE),                            \
            CARD_INT("M1", m1, USED, ID_NODE), CARD_INT("M2", m2, USED, ID_NODE), CARD_INT("M3", m3, USED, ID_NODE),   \
    }
static const FieldSpec node_load_fields[] = NODE_LOAD_FIELDS("NODE", ID_NODE);
static const FieldSpec node_set_load_fields[] = NODE_LOAD_FIELDS("NSID", ID_SET);
#undef AT

static const CardSpec node_load_cards[] = {{"card 1", "one for each load", CARD_FIELDS(node_load_fields)}};
static const CardSpec node_set_load_cards[] = {{"card 1", "one for each load", CARD_FIELDS(node_set_load_fields)}};

static void read_node_load(KeywordRead *read, bool is_set)
{
    while (keyword_more(read)) {
        NodeLoadDefinition card = {.is_set = is_set};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, read->spec->cards[0].fields[0].name, card.source)) continue;
        NodeLoadDefinition *load = KEYWORD_APPEND(read, read->definitions->node_loads);
        if (!load) return;
        *load = card;
    }
}

static void read_load_node_point(KeywordRead *read)
{
    read_node_load(read, false);
}

static void read_load_node_set(KeywordRead *read)
{
    read_node_load(read, true);
}

#define AT(member) offsetof(RigidLoadDefinition, member)
static const FieldSpec rigid_load_fields[] = {
    CARD_INT("PID", pid, USED, ID_PART),       CARD_INT("DOF", dof, USED, NONE),
    CARD_INT("LCID", lcid, USED, ID_FUNCTION), CARD_REAL_OR("SF", sf, 1.0, USED, NONE),
    CARD_INT("CID", cid, USED, ID_DEFINE),     CARD_INT("M1", m1, USED, ID_NODE),
    CARD_INT("M2", m2, USED, ID_NODE),         CARD_INT("M3", m3, USED, ID_NODE),
};
#undef AT
static const CardSpec rigid_load_cards[] = {{"card 1", "one for each load", CARD_FIELDS(rigid_load_fields)}};

static void read_load_rigid_body(KeywordRead *read)
{
    while (keyword_more(read)) {
        RigidLoadDefinition card = {0};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.pid, "PID", card.source)) continue;
        RigidLoadDefinition *load = KEYWORD_APPEND(read, read->definitions->rigid_loads);
        if (!load) return;
        *load = card;
    }
}

/* A pressure on one segment; N5 to N8 are those of quadratic segments. */
typedef struct SegmentCard {
    SegmentLoadDefinition load;
    int n5, id;
    char heading[71];
} SegmentCard;

#define AT(member) offsetof(SegmentCard, member)
static const FieldSpec segment_fields[] = {
    CARD_INT("LCID", load.lcid, USED, ID_FUNCTION), CARD_REAL_OR("SF", load.sf, 1.0, USED, NONE),
    CARD_REAL("AT", load.at, USED, TIME),           CARD_INT("N1", load.node[0], USED, ID_NODE),
    CARD_INT("N2", load.node[1], USED, ID_NODE),    CARD_INT("N3", load.node[2], USED, ID_NODE),
    CARD_INT("N4", load.node[3], USED, ID_NODE),    CARD_INT("N5", n5, REFUSED, ID_NODE),
};
static const FieldSpec segment_set_fields[] = {
    CARD_INT("SSID", load.id, USED, ID_SET),
    CARD_INT("LCID", load.lcid, USED, ID_FUNCTION),
    CARD_REAL_OR("SF", load.sf, 1.0, USED, NONE),
    CARD_REAL("AT", load.at, USED, TIME),
};
static const FieldSpec id_fields[] = {CARD_INT("ID", id, LISTED, NONE), CARD_TEXT("HEADING", heading, 70, LISTED)};
#undef AT

enum { SEGMENT_ID };
static const CardSpec segment_cards[] = {
    {"card 1", "one for each segment", CARD_FIELDS(segment_fields)},
    {"ID card", "before each card 1 with ID", CARD_FIELDS(id_fields)},
};
static const CardSpec segment_set_cards[] = {
    {"card 1", "one for each set", CARD_FIELDS(segment_set_fields)},
    {"ID card", "before each card 1 with ID", CARD_FIELDS(id_fields)},
};

static void read_segment_load(KeywordRead *read, bool is_set)
{
    while (keyword_more(read)) {
        SegmentCard card = {.load = {.is_set = is_set}};
        SegmentLoadDefinition *load = &card.load;
        keyword_id_card(read, SEGMENT_ID, NULL, NULL);
        if (keyword_card(read, 0, &card, true, &load->source)) continue;
        if (is_set && !keyword_check_id(read, load->id, "SSID", load->source)) continue;
        if (load->node[3] == 0) load->node[3] = load->node[2];
        const int *n = load->node;
        if (!is_set && (n[0] < 1 || n[1] < 1 || n[2] < 1 || n[3] < 1)) {
            keyword_error(read, load->source, "the segment %d, %d, %d, %d lacks a node", n[0], n[1], n[2], n[3]);
            continue;
        }
        SegmentLoadDefinition *record = KEYWORD_APPEND(read, read->definitions->segment_loads);
        if (!record) return;
        *record = *load;
    }
}

static void read_load_segment(KeywordRead *read)
{
    read_segment_load(read, false);
}

static void read_load_segment_set(KeywordRead *read)
{
    read_segment_load(read, true);
}

#define AT(member) offsetof(BodyLoadDefinition, member)
static const FieldSpec body_fields[] = {
    CARD_INT("LCID", lcid, USED, ID_FUNCTION),     CARD_REAL_OR("SF", sf, 1.0, USED, NONE),
    CARD_INT("LCIDDR", lciddr, USED, ID_FUNCTION), CARD_REAL("XC", xc, LISTED, LENGTH),
    CARD_REAL("YC", yc, LISTED, LENGTH),           CARD_REAL("ZC", zc, LISTED, LENGTH),
    CARD_INT("CID", cid, USED, ID_DEFINE),
};
static const FieldSpec vector_fields[] = {
    CARD_REAL("V1", vector[0], USED, NONE),
    CARD_REAL("V2", vector[1], USED, NONE),
    CARD_REAL("V3", vector[2], USED, NONE),
};
#undef AT

static const CardSpec body_cards[] = {{"card 1", "", CARD_FIELDS(body_fields)}};
static const CardSpec body_vector_cards[] = {{"card 1", "", CARD_FIELDS(body_fields)},
                                             {"card 2", "", CARD_FIELDS(vector_fields)}};

/* The manual does not say whether V is made one of length 1 or its length counts: only then both are the same. */
static bool check_vector(const KeywordRead *read, BodyLoadDefinition *card, Source source)
{
    double *v = card->vector, square = 0.0;
    for (int k = 0; k < 3; k++) square += v[k] * v[k];
    if (!(fabs(square - 1.0) < 2e-3)) {
        keyword_error(read, source,
                      "V = (%g, %g, %g) has the length %g; give a vector of length 1 and the size of the load by SF",
                      v[0], v[1], v[2], sqrt(square));
        return false;
    }
    for (int k = 0; k < 3; k++) v[k] /= sqrt(square);
    keyword_transform_vector(read, v);
    return true;
}

static void read_load_body(KeywordRead *read)
{
    const bool along_vector = read->spec->card_count == 2;
    BodyLoadDefinition card = {.axis = along_vector ? 3 : read->spec->name[strlen("*LOAD_BODY_")] - 'X'};
    Source source;
    if (keyword_card(read, 0, &card, true, &card.source)) return;
    if (along_vector && keyword_card(read, 1, &card, true, &source)) return;
    keyword_finish(read);
    if (along_vector && !check_vector(read, &card, source)) return;
    for (size_t k = 0; k < read->definitions->body_loads.count; k++)
        if (!along_vector && read->definitions->body_loads.items[k].axis == card.axis)
            keyword_warning(read, card.source, "this keyword is given again (before in line %d): both act together",
                            read->definitions->body_loads.items[k].source.line);
    BodyLoadDefinition *load = KEYWORD_APPEND(read, read->definitions->body_loads);
    if (load) *load = card;
}

#define AT(member) offsetof(GravityPartDefinition, member)
#define GRAVITY_FIELDS(name, scale)                                                                                    \
    {                                                                                                                  \
        CARD_INT(name, id, USED, scale), CARD_INT("DOF", dof, USED, NONE), CARD_INT("LC", lc, USED, ID_FUNCTION),      \
            CARD_REAL("ACCEL", accel, USED, ACCELERATION), CARD_INT("LCDR", lcdr, LISTED, ID_FUNCTION),                \
            CARD_INT("STGA", stga, REFUSED, NONE), CARD_INT("STGR", stgr, REFUSED, NONE),                              \
    }
static const FieldSpec gravity_part_fields[] = GRAVITY_FIELDS("PID", ID_PART);
static const FieldSpec gravity_set_fields[] = GRAVITY_FIELDS("PSID", ID_SET);
#undef AT

static const CardSpec gravity_part_cards[] = {{"card 1", "one for each part", CARD_FIELDS(gravity_part_fields)}};
static const CardSpec gravity_set_cards[] = {{"card 1", "one for each part set", CARD_FIELDS(gravity_set_fields)}};

static void read_gravity(KeywordRead *read, bool is_set)
{
    while (keyword_more(read)) {
        GravityPartDefinition card = {.is_set = is_set};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, is_set ? "PSID" : "PID", card.source)) continue;
        GravityPartDefinition *gravity = KEYWORD_APPEND(read, read->definitions->gravity_parts);
        if (!gravity) return;
        *gravity = card;
    }
}

static void read_gravity_part(KeywordRead *read)
{
    read_gravity(read, false);
}

static void read_gravity_set(KeywordRead *read)
{
    read_gravity(read, true);
}

#define BODY_LOAD(axis)                                                                                                \
    {                                                                                                                  \
        .name = "*LOAD_BODY_" axis, .cards = body_cards, .card_count = 1, .read = read_load_body,                      \
        .remark = "A positive value accelerates the model against the axis, as LS-DYNA's base acceleration. "          \
                  "*LOAD_BODY_PARTS and the rotations RX, RY, RZ are refused."                                         \
    }
static const KeywordSpec specs[] = {
    {.name = "*LOAD_NODE_POINT",
     .cards = node_load_cards,
     .card_count = 1,
     .read = read_load_node_point,
     .remark = "DOF 1 to 4; moments are refused. DOF = 4 follows the normal of M1, M2, M3."},
    {.name = "*LOAD_NODE_SET",
     .cards = node_set_load_cards,
     .card_count = 1,
     .read = read_load_node_set,
     .remark = "DOF 1 to 4; moments are refused. DOF = 4 follows the normal of M1, M2, M3."},
    {.name = "*LOAD_RIGID_BODY",
     .cards = rigid_load_cards,
     .card_count = 1,
     .read = read_load_rigid_body,
     .remark =
         "DOF 1 to 3 are forces on the centre of mass, 5 to 7 moments about it, along x, y, z (or those of CID at "
         "time 0); 4 and 8 follow the normal of M1, M2, M3. PID may be a part joined to another, or a nodal "
         "rigid body."},
    {.name = "*LOAD_SEGMENT",
     .options = {"ID"},
     .cards = segment_cards,
     .card_count = 2,
     .read = read_load_segment,
     .remark = "A positive pressure acts against the segment's normal."},
    {.name = "*LOAD_SEGMENT_SET",
     .options = {"ID"},
     .cards = segment_set_cards,
     .card_count = 2,
     .read = read_load_segment_set,
     .remark = "A positive pressure acts against the segments' normals."},
    BODY_LOAD("X"),
    BODY_LOAD("Y"),
    BODY_LOAD("Z"),
    {.name = "*LOAD_BODY_VECTOR",
     .cards = body_vector_cards,
     .card_count = 2,
     .read = read_load_body,
     .remark = "As *LOAD_BODY_X, along the vector V (in the system CID), whose length must be 1; several act together. "
               "The weight of *AIRBAG_FLUID_AND_GAS comes from X, Y and Z alone."},
    {.name = "*LOAD_GRAVITY_PART",
     .cards = gravity_part_cards,
     .card_count = 1,
     .read = read_gravity_part,
     .remark = "A positive value accelerates the parts against the axis. LC = 0 means a constant factor of 1."},
    {.name = "*LOAD_GRAVITY_PART_SET",
     .cards = gravity_set_cards,
     .card_count = 1,
     .read = read_gravity_set,
     .remark = "A positive value accelerates the parts against the axis. LC = 0 means a constant factor of 1."},
};

const KeywordFamily keyword_family_load = {"Loads", specs, (int)(sizeof specs / sizeof *specs)};
