/* *NODE, *ELEMENT_SHELL, *CONSTRAINED_ADAPTIVITY. */
#include <math.h>

#include "io/keyword_table.h"

#define AT(member) offsetof(NodeDefinition, member)
static const FieldSpec node_fields[] = {
    {"NID", 'I', 8, AT(id), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"X", 'F', 16, AT(x[0]), 0.0, false, FIELD_USED, SCALE_LENGTH},
    {"Y", 'F', 16, AT(x[1]), 0.0, false, FIELD_USED, SCALE_LENGTH},
    {"Z", 'F', 16, AT(x[2]), 0.0, false, FIELD_USED, SCALE_LENGTH},
    {"TC", 'I', 8, AT(tc), 0.0, false, FIELD_USED, SCALE_NONE},
    {"RC", 'I', 8, AT(rc), 0.0, false, FIELD_LISTED, SCALE_NONE},
};
#undef AT

static const CardSpec node_cards[] = {{"card 1", "one for each node", CARD_FIELDS(node_fields)}};

static void read_node(KeywordRead *read)
{
    while (keyword_more(read)) {
        NodeDefinition card = {0};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, "NID", card.source)) continue;
        keyword_transform_point(read, card.x);
        NodeDefinition *node = KEYWORD_APPEND(read, read->definitions->nodes);
        if (!node) return;
        *node = card;
    }
}

/* A shell's cards; the definition keeps four nodes at most. */
typedef struct ShellCard {
    int id, part, node[8];
    double thickness[4], beta;
    int mcid;
} ShellCard;

#define AT(member) offsetof(ShellCard, member)
static const FieldSpec shell_fields[] = {
    {"EID", 'I', 8, AT(id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"PID", 'I', 8, AT(part), 0.0, false, FIELD_USED, SCALE_ID_PART},
    {"N1", 'I', 8, AT(node[0]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N2", 'I', 8, AT(node[1]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N3", 'I', 8, AT(node[2]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N4", 'I', 8, AT(node[3]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N5", 'I', 8, AT(node[4]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
    {"N6", 'I', 8, AT(node[5]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
    {"N7", 'I', 8, AT(node[6]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
    {"N8", 'I', 8, AT(node[7]), 0.0, false, FIELD_REFUSED, SCALE_ID_NODE},
};
#define SHELL_THICKNESS                                                                                                \
    {"THIC1", 'F', 16, AT(thickness[0]), 0.0, false, FIELD_USED, SCALE_LENGTH},                                        \
        {"THIC2", 'F', 16, AT(thickness[1]), 0.0, false, FIELD_USED, SCALE_LENGTH},                                    \
        {"THIC3", 'F', 16, AT(thickness[2]), 0.0, false, FIELD_USED, SCALE_LENGTH},                                    \
    {                                                                                                                  \
        "THIC4", 'F', 16, AT(thickness[3]), 0.0, false, FIELD_USED, SCALE_LENGTH                                       \
    }
static const FieldSpec shell_beta_fields[] = {
    SHELL_THICKNESS,
    {"BETA", 'F', 16, AT(beta), 0.0, false, FIELD_USED, SCALE_NONE},
};
static const FieldSpec shell_mcid_fields[] = {
    SHELL_THICKNESS,
    {"MCID", 'I', 16, AT(mcid), 0.0, false, FIELD_USED, SCALE_ID_DEFINE},
};
#undef AT

enum { SHELL_BETA, SHELL_THICKNESS_OPTION, SHELL_MCID };
static const CardSpec shell_cards[] = {
    {"card 1", "one for each shell", CARD_FIELDS(shell_fields)},
    {"card 2", "after each card 1 with THICKNESS or BETA", CARD_FIELDS(shell_beta_fields)},
    {"card 2", "after each card 1 with MCID", CARD_FIELDS(shell_mcid_fields)},
};

/* Drops the corner that repeats its neighbour, with its thickness, and marks a triangle by repeating the third node.
 * Returns false if fewer than three corners are left or opposite corners coincide. */
static bool reduce_corners(ShellCard *card)
{
    int corners = card->node[3] == 0 ? 3 : 4;
    for (int i = 0; i < corners; i++) {
        if (corners < 3 || card->node[i] != card->node[(i + 1) % corners]) continue;
        /* the later of the two goes; the first one goes where the last corner repeats it */
        const int drop = i + 1 < corners ? i + 1 : i;
        for (int j = drop; j + 1 < corners; j++) {
            card->node[j] = card->node[j + 1];
            card->thickness[j] = card->thickness[j + 1];
        }
        corners--;
        i--;
    }
    if (corners < 3) return false;
    if (corners == 4 && (card->node[0] == card->node[2] || card->node[1] == card->node[3])) return false;
    if (corners == 3) {
        card->node[3] = card->node[2];
        card->thickness[3] = card->thickness[2];
    }
    return true;
}

static void store_shell(KeywordRead *read, ShellCard *card, bool has_beta, Source source)
{
    if (!keyword_check_id(read, card->id, "EID", source)) return;
    for (int i = 0; i < 4; i++) {
        if (card->node[i] < 0 || (card->node[i] == 0 && i < 3)) {
            keyword_error(read, source, "shell %d: N%d is %d, but must be a node's number", card->id, i + 1,
                          card->node[i]);
            return;
        }
    }
    const int written[4] = {card->node[0], card->node[1], card->node[2], card->node[3]};
    if (!reduce_corners(card)) {
        keyword_error(read, source,
                      "shell %d has no area: its nodes are %d, %d, %d, %d; remove it or correct its nodes", card->id,
                      written[0], written[1], written[2], written[3]);
        return;
    }
    ShellDefinition *shell = KEYWORD_APPEND(read, read->definitions->shells);
    if (!shell) return;
    *shell = (ShellDefinition){.id = card->id, .part = card->part, .mcid = card->mcid, .has_beta = has_beta};
    shell->beta = card->beta;
    shell->source = source;
    for (int i = 0; i < 4; i++) {
        shell->node[i] = card->node[i];
        shell->thickness[i] = card->thickness[i];
    }
}

static void read_shell(KeywordRead *read)
{
    const bool mcid = keyword_option(read, SHELL_MCID), beta = keyword_option(read, SHELL_BETA);
    const bool second = mcid || beta || keyword_option(read, SHELL_THICKNESS_OPTION);
    if (mcid && beta) {
        keyword_error(read, read->cards->block->source,
                      "the options BETA and MCID exclude each other; keep one of them");
        return;
    }
    while (keyword_more(read) && !read->out_of_memory) {
        ShellCard card = {0};
        Source source;
        int status = keyword_card(read, 0, &card, true, &source);
        if (second && keyword_card(read, mcid ? 2 : 1, &card, true, NULL)) status = -1;
        if (status == 0) store_shell(read, &card, beta || card.beta != 0.0, source);
    }
}

#define AT(member) offsetof(AdaptivityDefinition, member)
static const FieldSpec adaptivity_fields[] = {
    CARD_INT("DNID", dnid, USED, ID_NODE),
    CARD_INT("NID1", nid1, USED, ID_NODE),
    CARD_INT("NID2", nid2, USED, ID_NODE),
};
#undef AT

static const CardSpec adaptivity_cards[] = {{"card 1", "one for each hanging node", CARD_FIELDS(adaptivity_fields)}};

static void read_adaptivity(KeywordRead *read)
{
    while (keyword_more(read)) {
        AdaptivityDefinition card = {0};
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.dnid, "DNID", card.source)) continue;
        AdaptivityDefinition *adaptivity = KEYWORD_APPEND(read, read->definitions->adaptivities);
        if (!adaptivity) return;
        *adaptivity = card;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*NODE",
     .cards = node_cards,
     .card_count = 1,
     .read = read_node,
     .remark = "RC is met by itself: membranes have no rotations, rigid bodies are held by CMO and CON2."},
    {.name = "*ELEMENT_SHELL",
     .options = {"BETA", "THICKNESS", "MCID"},
     .cards = shell_cards,
     .card_count = 3,
     .read = read_shell,
     .remark = "N4 = 0 or N4 = N3 is a triangle; any other corner that repeats its neighbour is dropped likewise. A "
               "thickness of 0 means the section's. The option OFFSET is refused."},
    {.name = "*CONSTRAINED_ADAPTIVITY",
     .cards = adaptivity_cards,
     .card_count = 1,
     .read = read_adaptivity,
     .remark = "DNID is tied to the middle of NID1 and NID2."},
};

const KeywordFamily keyword_family_nodes = {"Nodes and elements", specs, (int)(sizeof specs / sizeof *specs)};
