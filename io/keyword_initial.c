/* *INITIAL_VELOCITY, _NODE, _GENERATION, _RIGID_BODY. */
#include "io/keyword_table.h"

#define AT(member) offsetof(InitialVelocityDefinition, member)
static const FieldSpec all1_fields[] = {
    CARD_INT("NSID", id, USED, ID_SET),        CARD_INT("NSIDEX", nsidex, USED, ID_SET),
    CARD_INT("BOXID", boxid, USED, ID_DEFINE), CARD_INT("IRIGID", irigid, USED, NONE),
    CARD_INT("ICID", icid, USED, ID_DEFINE),
};
static const FieldSpec all2_fields[] = {
    CARD_REAL("VX", v[0], USED, VELOCITY), CARD_REAL("VY", v[1], USED, VELOCITY), CARD_REAL("VZ", v[2], USED, VELOCITY),
    CARD_REAL("VXR", w[0], USED, RATE),    CARD_REAL("VYR", w[1], USED, RATE),    CARD_REAL("VZR", w[2], USED, RATE),
};
static const FieldSpec all3_fields[] = {
    CARD_REAL("VXE", vx_exempt[0], USED, VELOCITY), CARD_REAL("VYE", vx_exempt[1], USED, VELOCITY),
    CARD_REAL("VZE", vx_exempt[2], USED, VELOCITY), CARD_REAL("VXRE", vx_exempt[3], LISTED, RATE),
    CARD_REAL("VYRE", vx_exempt[4], LISTED, RATE),  CARD_REAL("VZRE", vx_exempt[5], LISTED, RATE),
};
#define VELOCITY_FIELDS(name, scale, turning)                                                                          \
    {                                                                                                                  \
        CARD_INT(name, id, USED, scale), CARD_REAL("VX", v[0], USED, VELOCITY), CARD_REAL("VY", v[1], USED, VELOCITY), \
            CARD_REAL("VZ", v[2], USED, VELOCITY), CARD_REAL("VXR", w[0], turning, RATE),                              \
            CARD_REAL("VYR", w[1], turning, RATE), CARD_REAL("VZR", w[2], turning, RATE),                              \
            CARD_INT("ICID", icid, USED, ID_DEFINE),                                                                   \
    }
static const FieldSpec node_fields[] = VELOCITY_FIELDS("NID", ID_NODE, LISTED);
static const FieldSpec rigid_fields[] = VELOCITY_FIELDS("PID", ID_PART, USED);
static const FieldSpec generation1_fields[] = {
    CARD_INT("ID", id, USED, NONE),         CARD_INT_OR("STYP", styp, 1, USED, NONE),
    CARD_REAL("OMEGA", omega, USED, RATE),  CARD_REAL("VX", v[0], USED, VELOCITY),
    CARD_REAL("VY", v[1], USED, VELOCITY),  CARD_REAL("VZ", v[2], USED, VELOCITY),
    CARD_INT("IVATN", ivatn, LISTED, NONE), CARD_INT("ICID", icid, USED, ID_DEFINE),
};
static const FieldSpec generation2_fields[] = {
    CARD_REAL("XC", centre[0], USED, LENGTH), CARD_REAL("YC", centre[1], USED, LENGTH),
    CARD_REAL("ZC", centre[2], USED, LENGTH), CARD_REAL("NX", axis[0], USED, NONE),
    CARD_REAL("NY", axis[1], USED, NONE),     CARD_REAL("NZ", axis[2], USED, NONE),
    CARD_INT("PHASE", phase, LISTED, NONE),   CARD_INT("IRIGID", irigid, USED, NONE),
};
#undef AT

static const CardSpec all_cards[] = {
    {"card 1", "", CARD_FIELDS(all1_fields)},
    {"card 2", "", CARD_FIELDS(all2_fields)},
    {"card 3", "if NSIDEX > 0", CARD_FIELDS(all3_fields)},
};
static const CardSpec node_cards[] = {{"card 1", "one for each node", CARD_FIELDS(node_fields)}};
static const CardSpec rigid_cards[] = {{"card 1", "one for each part", CARD_FIELDS(rigid_fields)}};
static const CardSpec generation_cards[] = {
    {"card 1", "one for each", CARD_FIELDS(generation1_fields)},
    {"card 2", "one for each", CARD_FIELDS(generation2_fields)},
};

/* Velocities in global axes turn with the include; those in a local system turn with the system. */
static void store_velocity(KeywordRead *read, InitialVelocityDefinition *card)
{
    if (card->icid == 0) {
        keyword_transform_vector(read, card->v);
        keyword_transform_vector(read, card->w);
        keyword_transform_vector(read, card->vx_exempt);
        if (card->axis[0] != -999.0) keyword_transform_vector(read, card->axis);
    }
    InitialVelocityDefinition *velocity = KEYWORD_APPEND(read, read->definitions->velocities);
    if (velocity) *velocity = *card;
}

static void read_all(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        InitialVelocityDefinition card = {.kind = VELOCITY_ALL};
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
        if (card.nsidex > 0 && keyword_card(read, 2, &card, status == 0, NULL)) status = -1;
        if (status) continue;
        if (card.irigid > 0) card.irigid = (int)keyword_scale(read, card.irigid, SCALE_ID_SET);
        if (card.irigid == 0 && (card.w[0] != 0.0 || card.w[1] != 0.0 || card.w[2] != 0.0))
            diagnostics_add(read->cards->diagnostics, SEVERITY_NOTE, card.source, read->spec->name,
                            "VXR, VYR, VZR are read but not used: nodes of membranes have no rotations, and IRIGID = 0 "
                            "leaves rigid bodies alone");
        store_velocity(read, &card);
    }
}

static void read_single(KeywordRead *read, bool rigid)
{
    while (keyword_more(read) && !read->out_of_memory) {
        InitialVelocityDefinition card = {0};
        if (rigid) {
            card.kind = VELOCITY_RIGID_BODY;
        } else {
            card.kind = VELOCITY_NODE;
        }
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (keyword_check_id(read, card.id, rigid ? "PID" : "NID", card.source)) store_velocity(read, &card);
    }
}

static void read_node(KeywordRead *read)
{
    read_single(read, false);
}

static void read_rigid_body(KeywordRead *read)
{
    read_single(read, true);
}

static void read_generation(KeywordRead *read)
{
    static const FieldScale scales[] = {SCALE_NONE, SCALE_ID_SET, SCALE_ID_PART, SCALE_ID_SET};
    while (keyword_more(read) && !read->out_of_memory) {
        InitialVelocityDefinition card = {.kind = VELOCITY_GENERATION};
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
        if (status) continue;
        double id = card.id;
        if (card.styp >= 1 && card.styp <= 3 && !keyword_real_id(read, &id, scales[card.styp], "ID", card.source))
            continue;
        card.id = (int)id;
        if (card.axis[0] == -999.0) { /* the axis passes through two nodes */
            if (!keyword_real_id(read, &card.axis[1], SCALE_ID_NODE, "NY", card.source)) continue;
            if (!keyword_real_id(read, &card.axis[2], SCALE_ID_NODE, "NZ", card.source)) continue;
        }
        keyword_transform_point(read, card.centre);
        store_velocity(read, &card);
    }
}

static const KeywordSpec specs[] = {
    {.name = "*INITIAL_VELOCITY",
     .cards = all_cards,
     .card_count = 3,
     .read = read_all,
     .remark =
         "NSID = 0 means all nodes. Rigid bodies take the momentum of their nodes; those with INERTIA cards keep "
         "what these say unless IRIGID is -1 (all in the box), -2 (all) or their part set: VX to VZR are then theirs."},
    {.name = "*INITIAL_VELOCITY_NODE",
     .cards = node_cards,
     .card_count = 1,
     .read = read_node,
     .remark = "Rigid bodies take the momentum of their nodes, but for those with INERTIA cards."},
    {.name = "*INITIAL_VELOCITY_RIGID_BODY",
     .cards = rigid_cards,
     .card_count = 1,
     .read = read_rigid_body,
     .remark = "It goes before all others, INERTIA cards too."},
    {.name = "*INITIAL_VELOCITY_GENERATION",
     .cards = generation_cards,
     .card_count = 2,
     .read = read_generation,
     .remark = "ID = 0 means everything. With NX = -999 the axis passes through the nodes NY and NZ. Rigid bodies with "
               "INERTIA cards keep what these say unless IRIGID = 1 (not with STYP = 3)."},
};

const KeywordFamily keyword_family_initial = {"Initial velocities", specs, (int)(sizeof specs / sizeof *specs)};
