/* The jetting cards of *AIRBAG_WANG_NEFSKE and *AIRBAG_HYBRID. */
#include "io/keyword_airbag_jet.h"

#define AT(member) offsetof(JetCards, member)
#define JET_POINTS                                                                                                     \
    CARD_REAL("XJFP", focus[0], USED, LENGTH), CARD_REAL("YJFP", focus[1], USED, LENGTH),                              \
        CARD_REAL("ZJFP", focus[2], USED, LENGTH), CARD_REAL("XJVH", head[0], USED, LENGTH),                           \
        CARD_REAL("YJVH", head[1], USED, LENGTH), CARD_REAL("ZJVH", head[2], USED, LENGTH)
const FieldSpec airbag_jet_cone_fields[8] = {
    JET_POINTS,
    CARD_REAL("CA", ca, USED, NONE),
    CARD_REAL_OR("BETA", beta, 1.0, USED, NONE),
};
const FieldSpec airbag_jet_multiple_fields[8] = {
    JET_POINTS,
    CARD_REAL("LCJRV", ca, USED, NONE),
    CARD_REAL_OR("BETA", beta, 1.0, USED, NONE),
};
const FieldSpec airbag_jet_focus_fields[8] = {
    CARD_REAL("XSJFP", second[0], USED, LENGTH), CARD_REAL("YSJFP", second[1], USED, LENGTH),
    CARD_REAL("ZSJFP", second[2], USED, LENGTH), CARD_INT("PSID", psid, USED, ID_SET),
    CARD_REAL("ANGLE", angle, USED, NONE),       CARD_INT("NODE1", node[0], USED, ID_NODE),
    CARD_INT("NODE2", node[1], USED, ID_NODE),   CARD_INT("NODE3", node[2], USED, ID_NODE),
};
/* HYBRID_JETTING: the fifth field is a dummy. */
const FieldSpec airbag_jet_spare_focus_fields[8] = {
    CARD_REAL("XSJFP", second[0], USED, LENGTH), CARD_REAL("YSJFP", second[1], USED, LENGTH),
    CARD_REAL("ZSJFP", second[2], USED, LENGTH), CARD_INT("PSID", psid, USED, ID_SET),
    CARD_REAL("IDUM", angle, LISTED, NONE),      CARD_INT("NODE1", node[0], USED, ID_NODE),
    CARD_INT("NODE2", node[1], USED, ID_NODE),   CARD_INT("NODE3", node[2], USED, ID_NODE),
};
const FieldSpec airbag_jet_react_fields[1] = {CARD_INT("NREACT", nreact, USED, ID_NODE)};
#undef AT

static int check_fields(KeywordRead *read, JetCards *jet)
{
    if (jet->multiple && !(jet->ca > 0.0)) {
        keyword_error(read, jet->card9, "LCJRV is %g, but must name the curve of the jet's velocity over the angle",
                      jet->ca);
        return -1;
    }
    bool is_curve = jet->multiple || jet->ca < 0.0;
    if (is_curve && !keyword_real_id(read, &jet->ca, SCALE_ID_FUNCTION, jet->multiple ? "LCJRV" : "CA", jet->card9))
        return -1;
    if (jet->beta < 0.0 && !keyword_real_id(read, &jet->beta, SCALE_ID_FUNCTION, "BETA", jet->card9)) return -1;
    if (!jet->multiple && jet->angle != 0.0)
        keyword_note(read, jet->card10, "ANGLE = %g is read but not used: it cuts off the jet of MULTIPLE_JETTING only",
                     jet->angle);
    return 0;
}

int airbag_read_jet(KeywordRead *read, const JetOptions *options, AirbagDefinition *bag)
{
    JetCards *jet = &bag->jet;
    if (options->jetting && options->multiple) {
        keyword_error(read, bag->source, "JETTING and MULTIPLE_JETTING exclude each other; leave one out");
        return -1;
    }
    if (!options->jetting && !options->multiple) {
        if (!options->cm) return 0;
        keyword_error(read, bag->source, "CM belongs to JETTING or MULTIPLE_JETTING, which is missing");
        return -1;
    }
    jet->given = true;
    jet->multiple = options->multiple;
    jet->cm = options->cm;
    if (keyword_card(read, options->shape_card, jet, true, &jet->card9)) return -1;
    if (keyword_card(read, options->focus_card, jet, true, &jet->card10)) return -1;
    jet->card11 = jet->card10;
    if (jet->cm && keyword_card(read, options->react_card, jet, true, &jet->card11)) return -1;
    bool second = jet->second[0] != 0.0 || jet->second[1] != 0.0 || jet->second[2] != 0.0;
    keyword_transform_point(read, jet->focus);
    keyword_transform_point(read, jet->head);
    if (second) keyword_transform_point(read, jet->second); /* zeros mean none */
    return check_fields(read, jet);
}
