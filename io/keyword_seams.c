/* *CONSTRAINED_SPOTWELD, *CONSTRAINED_TIED_NODES_FAILURE. */
#include "io/keyword_table.h"

#define AT(member) offsetof(SpotweldDefinition, member)
static const FieldSpec weld_fields[] = {
    CARD_INT("N1", node[0], USED, ID_NODE),   CARD_INT("N2", node[1], USED, ID_NODE),
    CARD_REAL("SN", sn, USED, FORCE),         CARD_REAL("SS", ss, USED, FORCE),
    CARD_REAL_OR("N", n, 2.0, USED, NONE),    CARD_REAL_OR("M", m, 2.0, USED, NONE),
    CARD_REAL_OR("TF", tf, 1e20, USED, TIME), CARD_REAL_OR("EP", ep, 1e20, LISTED, NONE),
};
#undef AT
static const CardSpec weld_cards[] = {{"card 1", "one for each pair of nodes", CARD_FIELDS(weld_fields)}};

enum { OPTION_ID };

static void read_weld(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        SpotweldDefinition card = {0};
        keyword_id_card(read, OPTION_ID, NULL, NULL);
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        bool good = keyword_check_id(read, card.node[0], "N1", card.source);
        good = keyword_check_id(read, card.node[1], "N2", card.source) && good;
        if (card.sn < 0.0 || card.ss < 0.0) {
            keyword_error(read, card.source, "%s is %g; give the force that tears the weld, or 0 for one that holds",
                          card.sn < 0.0 ? "SN" : "SS", card.sn < 0.0 ? card.sn : card.ss);
            good = false;
        }
        if (!(card.n > 0.0) || !(card.m > 0.0)) {
            keyword_error(read, card.source, "%s is %g, but must be above 0", card.n > 0.0 ? "M" : "N",
                          card.n > 0.0 ? card.m : card.n);
            good = false;
        }
        if (!good) continue;
        SpotweldDefinition *weld = KEYWORD_APPEND(read, read->definitions->spotwelds);
        if (weld) *weld = card;
    }
}

#define AT(member) offsetof(TiedNodesDefinition, member)
static const FieldSpec tied_fields[] = {
    CARD_INT("NSID", nsid, USED, ID_SET),
    CARD_REAL("EPPF", eppf, USED, NONE),
    CARD_INT("ETYPE", etype, REFUSED, NONE),
};
#undef AT
static const CardSpec tied_cards[] = {{"card 1", "one for each set", CARD_FIELDS(tied_fields)}};

static void read_tied(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        TiedNodesDefinition card = {0};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.nsid, "NSID", card.source)) continue;
        if (card.eppf < 0.0) {
            keyword_error(read, card.source,
                          "EPPF is %g; give the effective strain at which the nodes come apart, or 0 if they never do",
                          card.eppf);
            continue;
        }
        TiedNodesDefinition *tied = KEYWORD_APPEND(read, read->definitions->tied_nodes);
        if (tied) *tied = card;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*CONSTRAINED_SPOTWELD",
     .options = {"ID"},
     .cards = weld_cards,
     .card_count = 1,
     .read = read_weld,
     .remark =
         "The nodes move as one until (f_n/SN)^N + (f_s/SS)^M reaches 1 or the time reaches TF. Nodes at one place "
         "have no normal: their whole force counts against SN, or against SS if SN = 0. EP has no effect: "
         "fabric does not yield. The option FILTERED_FORCE is refused."},
    {.name = "*CONSTRAINED_TIED_NODES_FAILURE",
     .cards = tied_cards,
     .card_count = 1,
     .read = read_tied,
     .remark = "The nodes of a set that lie at one place move as one until the mean effective strain of the deformable "
               "shells around them, by volume, exceeds EPPF (docs/theory.md, X4 to X7); then all of that place come "
               "apart. Fabric does not yield: the strain is the whole one, not its plastic part. EPPF = 0 never "
               "breaks. ETYPE = 1 (solids) is refused."},
};

const KeywordFamily keyword_family_seams = {"Seams", specs, (int)(sizeof specs / sizeof *specs)};
