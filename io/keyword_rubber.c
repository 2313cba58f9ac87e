/* *MAT_MOONEY-RIVLIN_RUBBER, *MAT_OGDEN_RUBBER. */
#include "io/keyword_table.h"

#define AT(member) offsetof(MaterialDefinition, member)
static const FieldSpec mooney_fields[] = {
    CARD_INT("MID", id, USED, ID_MATERIAL),   CARD_REAL("RO", ro, USED, DENSITY),
    CARD_REAL("PR", pr, USED, NONE),          CARD_REAL("A", rubber.a, USED, PRESSURE),
    CARD_REAL("B", rubber.b, USED, PRESSURE), CARD_REAL("REF", rubber.ref, REFUSED, NONE),
};
static const FieldSpec mooney_fit_fields[] = {
    CARD_REAL("SGL", rubber.sgl, LISTED, LENGTH),
    CARD_REAL("SW", rubber.sw, LISTED, LENGTH),
    CARD_REAL("ST", rubber.st, LISTED, LENGTH),
    CARD_INT("LCID", rubber.lcid, LISTED, ID_FUNCTION),
};
static const FieldSpec ogden_fields[] = {
    CARD_INT("MID", id, USED, ID_MATERIAL),
    CARD_REAL("RO", ro, USED, DENSITY),
    CARD_REAL("PR", pr, USED, NONE),
    CARD_INT("N", rubber.n, REFUSED, NONE),
    CARD_INT("NV", rubber.nv, LISTED, NONE),
    CARD_REAL("G", rubber.g, REFUSED, PRESSURE),
    CARD_REAL("SIGF", rubber.sigf, REFUSED, PRESSURE),
    CARD_REAL("REF", rubber.ref, REFUSED, NONE),
};
static const FieldSpec mu_fields[] = {
    CARD_REAL("MU1", rubber.mu[0], USED, PRESSURE), CARD_REAL("MU2", rubber.mu[1], USED, PRESSURE),
    CARD_REAL("MU3", rubber.mu[2], USED, PRESSURE), CARD_REAL("MU4", rubber.mu[3], USED, PRESSURE),
    CARD_REAL("MU5", rubber.mu[4], USED, PRESSURE), CARD_REAL("MU6", rubber.mu[5], USED, PRESSURE),
    CARD_REAL("MU7", rubber.mu[6], USED, PRESSURE), CARD_REAL("MU8", rubber.mu[7], USED, PRESSURE),
};
static const FieldSpec alpha_fields[] = {
    CARD_REAL("ALPHA1", rubber.alpha[0], USED, NONE), CARD_REAL("ALPHA2", rubber.alpha[1], USED, NONE),
    CARD_REAL("ALPHA3", rubber.alpha[2], USED, NONE), CARD_REAL("ALPHA4", rubber.alpha[3], USED, NONE),
    CARD_REAL("ALPHA5", rubber.alpha[4], USED, NONE), CARD_REAL("ALPHA6", rubber.alpha[5], USED, NONE),
    CARD_REAL("ALPHA7", rubber.alpha[6], USED, NONE), CARD_REAL("ALPHA8", rubber.alpha[7], USED, NONE),
};
#undef AT

enum { RUBBER_TITLE };
static const CardSpec mooney_cards[] = {
    {"card 1", "", CARD_FIELDS(mooney_fields)},
    {"card 2", "may be left out", CARD_FIELDS(mooney_fit_fields)},
};
static const CardSpec ogden_cards[] = {
    {"card 1", "", CARD_FIELDS(ogden_fields)},
    {"card 2", "", CARD_FIELDS(mu_fields)},
    {"card 3", "", CARD_FIELDS(alpha_fields)},
};

static void store_rubber(KeywordRead *read, const MaterialDefinition *card)
{
    if (!keyword_check_id(read, card->id, "MID", card->source)) return;
    MaterialDefinition *material = KEYWORD_APPEND(read, read->definitions->materials);
    if (material) *material = *card;
}

static void read_mooney(KeywordRead *read)
{
    MaterialDefinition card = {.kind = MATERIAL_RUBBER, .keyword = "*MAT_MOONEY-RIVLIN_RUBBER"};
    keyword_title(read, RUBBER_TITLE, card.title);
    int status = keyword_card(read, 0, &card, true, &card.source);
    if (keyword_more(read) && keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
    if (status) return;
    keyword_finish(read);
    store_rubber(read, &card);
}

static void read_ogden(KeywordRead *read)
{
    MaterialDefinition card = {.kind = MATERIAL_RUBBER, .keyword = "*MAT_OGDEN_RUBBER"};
    keyword_title(read, RUBBER_TITLE, card.title);
    int status = keyword_card(read, 0, &card, true, &card.source);
    for (int i = 1; i < 3; i++)
        if (keyword_card(read, i, &card, status == 0, NULL)) status = -1;
    if (status) return;
    keyword_finish(read);
    card.rubber.is_ogden = true;
    store_rubber(read, &card);
}

static const KeywordSpec specs[] = {
    {.name = "*MAT_MOONEY-RIVLIN_RUBBER",
     .aliases = {"*MAT_027", "*MAT_27"},
     .options = {"TITLE"},
     .cards = mooney_cards,
     .card_count = 2,
     .read = read_mooney,
     .remark =
         "Membranes only, incompressible: PR must lie between 0.49 and 0.5 and has no other effect. A and B must be "
         "given, not negative; they are not fitted to a test (card 2)."
         " REF belongs to *INITIAL_FOAM_REFERENCE_GEOMETRY and is refused."},
    {.name = "*MAT_OGDEN_RUBBER",
     .aliases = {"*MAT_077_O", "*MAT_77_O"},
     .options = {"TITLE"},
     .cards = ogden_cards,
     .card_count = 3,
     .read = read_ogden,
     .remark =
         "Membranes only, incompressible: PR must lie between 0.49 and 0.5 and has no other effect. Terms of which "
         "both numbers are 0 are left out; MU ALPHA of the others must be positive. N > 0 (fit to a test), damping "
         "by G and SIGF and viscoelastic cards are refused."
         " REF belongs to *INITIAL_FOAM_REFERENCE_GEOMETRY and is refused."},
};

const KeywordFamily keyword_family_rubber = {"Rubber", specs, (int)(sizeof specs / sizeof *specs)};
