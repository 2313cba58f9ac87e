/* *BOUNDARY_SPC and *BOUNDARY_PRESCRIBED_MOTION. */
#include "io/keyword_table.h"

#define AT(member) offsetof(SpcDefinition, member)
#define SPC_FIELDS(name, scale)                                                                                        \
    {                                                                                                                  \
        CARD_INT(name, id, USED, scale), CARD_INT("CID", cid, USED, ID_DEFINE), CARD_INT("DOFX", dof[0], USED, NONE),  \
            CARD_INT("DOFY", dof[1], USED, NONE), CARD_INT("DOFZ", dof[2], USED, NONE),                                \
            CARD_INT("DOFRX", dof[3], LISTED, NONE), CARD_INT("DOFRY", dof[4], LISTED, NONE),                          \
            CARD_INT("DOFRZ", dof[5], LISTED, NONE),                                                                   \
    }
static const FieldSpec spc_node_fields[] = SPC_FIELDS("NID", ID_NODE);
static const FieldSpec spc_set_fields[] = SPC_FIELDS("NSID", ID_SET);
static const FieldSpec spc_time_fields[] = {
    CARD_REAL("BIRTH", birth, USED, TIME),
    CARD_REAL_OR("DEATH", death, 1e20, USED, TIME),
};
#undef AT

/* The ID card that precedes each set of cards; the readers' common code reads it. */
typedef struct IdCard {
    int id;
    char heading[71];
} IdCard;
#define AT(member) offsetof(IdCard, member)
static const FieldSpec id_fields[] = {CARD_INT("ID", id, LISTED, NONE), CARD_TEXT("HEADING", heading, 70, LISTED)};
#undef AT

enum { SPC_ID, SPC_BIRTH_DEATH };
static const CardSpec spc_node_cards[] = {
    {"card 1", "one for each support", CARD_FIELDS(spc_node_fields)},
    {"card 2", "after each card 1 with BIRTH_DEATH", CARD_FIELDS(spc_time_fields)},
    {"ID card", "before each card 1 with ID", CARD_FIELDS(id_fields)},
};
static const CardSpec spc_set_cards[] = {
    {"card 1", "one for each support", CARD_FIELDS(spc_set_fields)},
    {"card 2", "after each card 1 with BIRTH_DEATH", CARD_FIELDS(spc_time_fields)},
    {"ID card", "before each card 1 with ID", CARD_FIELDS(id_fields)},
};

static void read_spc(KeywordRead *read, bool is_set)
{
    while (keyword_more(read)) {
        SpcDefinition card = {.is_set = is_set, .death = 1e20};
        keyword_id_card(read, SPC_ID, NULL, NULL);
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (keyword_option(read, SPC_BIRTH_DEATH) && keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
        if (status) continue;
        if (!keyword_check_id(read, card.id, is_set ? "NSID" : "NID", card.source)) continue;
        SpcDefinition *spc = KEYWORD_APPEND(read, read->definitions->spcs);
        if (!spc) return;
        *spc = card;
    }
}

static void read_spc_node(KeywordRead *read)
{
    read_spc(read, false);
}

static void read_spc_set(KeywordRead *read)
{
    read_spc(read, true);
}

/* LRB and the orientation nodes belong to relative displacements (VAD = 4). */
typedef struct MotionCard {
    PrescribedMotionDefinition motion;
    int lrb, node1, node2;
} MotionCard;

#define AT(member) offsetof(MotionCard, member)
#define MOTION_FIELDS(name, scale)                                                                                     \
    {                                                                                                                  \
        CARD_INT(name, motion.id, USED, scale), CARD_INT("DOF", motion.dof, USED, NONE),                               \
            CARD_INT("VAD", motion.vad, USED, NONE), CARD_INT("LCID", motion.lcid, USED, ID_FUNCTION),                 \
            CARD_REAL_OR("SF", motion.sf, 1.0, USED, NONE), CARD_INT("VID", motion.vid, USED, ID_DEFINE),              \
            CARD_REAL_OR("DEATH", motion.death, 1e28, USED, TIME), CARD_REAL("BIRTH", motion.birth, USED, TIME),       \
    }
static const FieldSpec motion_node_fields[] = MOTION_FIELDS("NID", ID_NODE);
static const FieldSpec motion_set_fields[] = MOTION_FIELDS("NSID", ID_SET);
static const FieldSpec motion_rigid_fields[] = MOTION_FIELDS("PID", ID_PART);
static const FieldSpec motion_offset_fields[] = {
    CARD_REAL("OFFSET1", motion.offset1, REFUSED, LENGTH),
    CARD_REAL("OFFSET2", motion.offset2, REFUSED, LENGTH),
    CARD_INT("LRB", lrb, REFUSED, ID_PART),
    CARD_INT("NODE1", node1, REFUSED, ID_NODE),
    CARD_INT("NODE2", node2, REFUSED, ID_NODE),
};
#undef AT

enum { MOTION_ID };
#define MOTION_CARDS(fields)                                                                                           \
    {                                                                                                                  \
        {"card 1", "one for each motion", CARD_FIELDS(fields)},                                                        \
            {"card 2", "if |DOF| is 9, 10 or 11 or VAD = 4", CARD_FIELDS(motion_offset_fields)},                       \
            {"ID card", "before each card 1 with ID", CARD_FIELDS(id_fields)},                                         \
    }
static const CardSpec motion_node_cards[] = MOTION_CARDS(motion_node_fields);
static const CardSpec motion_set_cards[] = MOTION_CARDS(motion_set_fields);
static const CardSpec motion_rigid_cards[] = MOTION_CARDS(motion_rigid_fields);

/* DOF and VAD are judged when the model is built. */
static void read_motion(KeywordRead *read, int kind)
{
    while (keyword_more(read)) {
        MotionCard card = {0};
        if (kind == 0) card.motion.kind = MOTION_NODE;
        if (kind == 1) card.motion.kind = MOTION_SET;
        if (kind == 2) card.motion.kind = MOTION_RIGID;
        keyword_id_card(read, MOTION_ID, NULL, NULL);
        int status = keyword_card(read, 0, &card, true, &card.motion.source);
        const int dof = card.motion.dof < 0 ? -card.motion.dof : card.motion.dof;
        if ((dof >= 9 && dof <= 11) || card.motion.vad == 4) card_skip(read->cards);
        if (status) continue;
        if (!keyword_check_id(read, card.motion.id, read->spec->cards[0].fields[0].name, card.motion.source)) continue;
        PrescribedMotionDefinition *motion = KEYWORD_APPEND(read, read->definitions->motions);
        if (!motion) return;
        *motion = card.motion;
    }
}

static void read_motion_node(KeywordRead *read)
{
    read_motion(read, 0);
}

static void read_motion_set(KeywordRead *read)
{
    read_motion(read, 1);
}

static void read_motion_rigid(KeywordRead *read)
{
    read_motion(read, 2);
}

static const KeywordSpec specs[] = {
    {.name = "*BOUNDARY_SPC_NODE",
     .options = {"ID", "BIRTH_DEATH"},
     .cards = spc_node_cards,
     .card_count = 3,
     .read = read_spc_node,
     .remark = "Membranes have no rotations to hold."},
    {.name = "*BOUNDARY_SPC_SET",
     .options = {"ID", "BIRTH_DEATH"},
     .cards = spc_set_cards,
     .card_count = 3,
     .read = read_spc_set,
     .remark = "Membranes have no rotations to hold."},
    {.name = "*BOUNDARY_PRESCRIBED_MOTION_NODE",
     .options = {"ID"},
     .cards = motion_node_cards,
     .card_count = 3,
     .read = read_motion_node,
     .remark = "DOF 1 to 4 and -4, VAD 0, 1 and 2; others are refused."},
    {.name = "*BOUNDARY_PRESCRIBED_MOTION_SET",
     .options = {"ID"},
     .cards = motion_set_cards,
     .card_count = 3,
     .read = read_motion_set,
     .remark = "DOF 1 to 4 and -4, VAD 0, 1 and 2; others are refused."},
    {.name = "*BOUNDARY_PRESCRIBED_MOTION_RIGID",
     .options = {"ID"},
     .cards = motion_rigid_cards,
     .card_count = 3,
     .read = read_motion_rigid,
     .remark = "DOF 1 to 8, VAD 0, 1 and 2; others and the option LOCAL are refused."},
};

const KeywordFamily keyword_family_boundary = {"Boundary conditions", specs, (int)(sizeof specs / sizeof *specs)};
