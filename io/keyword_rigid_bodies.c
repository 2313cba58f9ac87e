/* *CONSTRAINED_RIGID_BODIES, *CONSTRAINED_EXTRA_NODES, *CONSTRAINED_NODAL_RIGID_BODY, and the cards of a body's
 * inertia. */
#include "io/keyword_table.h"

#define AT(member) offsetof(InertiaCard, member)
const FieldSpec keyword_inertia_centre[6] = {
    CARD_REAL("XC", centre[0], USED, LENGTH), CARD_REAL("YC", centre[1], USED, LENGTH),
    CARD_REAL("ZC", centre[2], USED, LENGTH), CARD_REAL("TM", tm, USED, MASS),
    CARD_INT("IRCS", ircs, USED, NONE),       CARD_INT("NODEID", nodeid, USED, ID_NODE),
};
const FieldSpec keyword_inertia_tensor[6] = {
    CARD_REAL("IXX", i[0], USED, NONE), CARD_REAL("IXY", i[1], USED, NONE), CARD_REAL("IXZ", i[2], USED, NONE),
    CARD_REAL("IYY", i[3], USED, NONE), CARD_REAL("IYZ", i[4], USED, NONE), CARD_REAL("IZZ", i[5], USED, NONE),
};
const FieldSpec keyword_inertia_rates[6] = {
    CARD_REAL("VTX", v[0], USED, VELOCITY), CARD_REAL("VTY", v[1], USED, VELOCITY),
    CARD_REAL("VTZ", v[2], USED, VELOCITY), CARD_REAL("VRX", w[0], USED, RATE),
    CARD_REAL("VRY", w[1], USED, RATE),     CARD_REAL("VRZ", w[2], USED, RATE),
};
const FieldSpec keyword_inertia_axes[7] = {
    CARD_REAL("XL", x_axis[0], USED, NONE),     CARD_REAL("YL", x_axis[1], USED, NONE),
    CARD_REAL("ZL", x_axis[2], USED, NONE),     CARD_REAL("XLIP", in_plane[0], USED, NONE),
    CARD_REAL("YLIP", in_plane[1], USED, NONE), CARD_REAL("ZLIP", in_plane[2], USED, NONE),
    CARD_INT("CID", cid, USED, ID_DEFINE),
};
#undef AT

static const CardSpec inertia_cards[] = {KEYWORD_INERTIA_CARDS};

int keyword_read_inertia(KeywordRead *read, InertiaCard *inertia)
{
    const CardSpec *cards = inertia_cards;
    Source *sources[] = {&inertia->source, &inertia->tensor_source, NULL, &inertia->axes_source};
    int count = 3, status = 0;
    for (int i = 0; i < count; i++) {
        if (card_read(read->cards, cards[i].fields, cards[i].count, inertia, true, cards[i].name, sources[i]))
            status = -1;
        if (i == 0 && inertia->ircs == 1) count = 4;
    }
    if (status == 0 && inertia->ircs != 0 && inertia->ircs != 1) {
        keyword_error(read, inertia->source, "IRCS = %d is neither 0 (global axes) nor 1 (local axes)", inertia->ircs);
        status = -1;
    }
    if (status) return -1;
    /* moments are mass times length squared; a turned include turns vectors, but a tensor only by local axes */
    for (int i = 0; i < 6; i++)
        inertia->i[i] = keyword_scale(
            read, keyword_scale(read, keyword_scale(read, inertia->i[i], SCALE_MASS), SCALE_LENGTH), SCALE_LENGTH);
    if (keyword_transform_turns(read) && inertia->ircs == 0) {
        keyword_error(read, inertia->tensor_source,
                      "the inertia is given in global axes (IRCS = 0), but the include is turned; give local axes "
                      "(IRCS = 1)");
        return -1;
    }
    keyword_transform_point(read, inertia->centre);
    keyword_transform_vector(read, inertia->v);
    keyword_transform_vector(read, inertia->w);
    keyword_transform_vector(read, inertia->x_axis);
    keyword_transform_vector(read, inertia->in_plane);
    return 0;
}

#define AT(member) offsetof(RigidMergeDefinition, member)
static const FieldSpec merge_fields[] = {
    CARD_INT("PIDL", lead, USED, ID_PART),
    CARD_INT("PIDC", other, USED, ID_PART),
    CARD_INT("IFLAG", iflag, USED, NONE),
};
#undef AT
static const CardSpec merge_cards[] = {{"card 1", "one for each pair of parts", CARD_FIELDS(merge_fields)}};

static void read_merges(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        RigidMergeDefinition card = {0};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.lead, "PIDL", card.source)) continue;
        if (!keyword_check_id(read, card.other, "PIDC", card.source)) continue;
        RigidMergeDefinition *merge = KEYWORD_APPEND(read, read->definitions->merges);
        if (merge) *merge = card;
    }
}

#define AT(member) offsetof(ExtraNodesDefinition, member)
static const FieldSpec extra_node_fields[] = {
    CARD_INT("PID", part, USED, ID_PART),
    CARD_INT("NID", id, USED, ID_NODE),
    CARD_INT("IFLAG", iflag, USED, NONE),
};
static const FieldSpec extra_set_fields[] = {
    CARD_INT("PID", part, USED, ID_PART),
    CARD_INT("NSID", id, USED, ID_SET),
    CARD_INT("IFLAG", iflag, USED, NONE),
};
#undef AT
static const CardSpec extra_node_cards[] = {{"card 1", "one for each node", CARD_FIELDS(extra_node_fields)}};
static const CardSpec extra_set_cards[] = {{"card 1", "one for each node set", CARD_FIELDS(extra_set_fields)}};

static void read_extra(KeywordRead *read, bool is_set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        ExtraNodesDefinition card = {.is_set = is_set};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.part, "PID", card.source)) continue;
        if (!keyword_check_id(read, card.id, is_set ? "NSID" : "NID", card.source)) continue;
        ExtraNodesDefinition *extra = KEYWORD_APPEND(read, read->definitions->extra_nodes);
        if (extra) *extra = card;
    }
}

static void read_extra_nodes(KeywordRead *read)
{
    read_extra(read, false);
}

static void read_extra_sets(KeywordRead *read)
{
    read_extra(read, true);
}

#define AT(member) offsetof(NodalRigidBodyDefinition, member)
static const FieldSpec body_fields[] = {
    CARD_INT("PID", id, USED, ID_PART),        CARD_INT("CID", cid, LISTED, ID_DEFINE),
    CARD_INT("NSID", nsid, USED, ID_SET),      CARD_INT("PNODE", pnode, LISTED, ID_NODE),
    CARD_INT("IPRT", iprt, LISTED, NONE),      CARD_INT("DRFLAG", drflag, REFUSED, NONE),
    CARD_INT("RRFLAG", rrflag, REFUSED, NONE),
};
static const FieldSpec spc_fields[] = {
    CARD_REAL("CMO", cmo, USED, NONE),
    CARD_REAL("CON1", con1, USED, NONE),
    CARD_REAL("CON2", con2, USED, NONE),
};
#undef AT

enum { BODY_TITLE, BODY_SPC, BODY_INERTIA };
static const CardSpec body_cards[] = {
    {"card 1", "", CARD_FIELDS(body_fields)},
    {"card 2", "with SPC", CARD_FIELDS(spc_fields)},
    KEYWORD_INERTIA_CARDS,
};

static void read_nodal_body(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        NodalRigidBodyDefinition card = {.has_spc = keyword_option(read, BODY_SPC),
                                         .has_inertia = keyword_option(read, BODY_INERTIA)};
        keyword_title(read, BODY_TITLE, card.title);
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (card.has_spc && keyword_card(read, 1, &card, status == 0, &card.spc_source)) status = -1;
        if (card.has_inertia && keyword_read_inertia(read, &card.inertia)) status = -1;
        if (status || !keyword_check_id(read, card.id, "PID", card.source)) continue;
        if (card.cmo < 0.0 && !keyword_real_id(read, &card.con1, SCALE_ID_DEFINE, "CON1", card.spc_source)) continue;
        if (card.nsid == 0) card.nsid = card.id;
        NodalRigidBodyDefinition *body = KEYWORD_APPEND(read, read->definitions->nodal_bodies);
        if (body) *body = card;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*CONSTRAINED_RIGID_BODIES",
     .cards = merge_cards,
     .card_count = 1,
     .read = read_merges,
     .remark =
         "PIDC moves with PIDL as one body, held as the material of PIDL says. IFLAG = 1 is refused where PIDL has "
         "*PART_INERTIA."},
    {.name = "*CONSTRAINED_EXTRA_NODES_NODE",
     .cards = extra_node_cards,
     .card_count = 1,
     .read = read_extra_nodes,
     .remark = "The node's mass counts for the body, unless that has *PART_INERTIA; IFLAG = 1 is refused there."},
    {.name = "*CONSTRAINED_EXTRA_NODES_SET",
     .cards = extra_set_cards,
     .card_count = 1,
     .read = read_extra_sets,
     .remark = "As *CONSTRAINED_EXTRA_NODES_NODE."},
    {.name = "*CONSTRAINED_NODAL_RIGID_BODY",
     .options = {"TITLE", "SPC", "INERTIA"},
     .cards = body_cards,
     .card_count = 6,
     .read = read_nodal_body,
     .remark =
         "NSID = 0 takes the node set with the number PID. CID and PNODE only steer output. DISPLAY, OVERRIDE and "
         "others are refused."},
};

const KeywordFamily keyword_family_rigid_bodies = {"Rigid bodies", specs, (int)(sizeof specs / sizeof *specs)};
