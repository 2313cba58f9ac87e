/* *MAT_ADD_EROSION. */
#include "io/keyword_table.h"

#define AT(member) offsetof(ErosionDefinition, member)
static const FieldSpec first_fields[] = {
    CARD_INT("MID", mid, USED, ID_MATERIAL),         CARD_REAL("EXCL", excl, USED, NONE),
    CARD_REAL("MXPRES", mxpres, USED, PRESSURE),     CARD_REAL("MNEPS", mneps, USED, NONE),
    CARD_REAL("EFFEPS", effeps, USED, NONE),         CARD_REAL("VOLEPS", voleps, USED, NONE),
    CARD_REAL_OR("NUMFIP", numfip, 1.0, USED, NONE), CARD_REAL_OR("NCS", ncs, 1.0, USED, NONE),
};
static const FieldSpec second_fields[] = {
    CARD_REAL("MNPRES", mnpres, USED, PRESSURE), CARD_REAL("SIGP1", sigp1, USED, PRESSURE),
    CARD_REAL("SIGVM", sigvm, USED, PRESSURE),   CARD_REAL("MXEPS", mxeps, USED, NONE),
    CARD_REAL("EPSSH", epssh, USED, NONE),       CARD_REAL("SIGTH", sigth, USED, PRESSURE),
    CARD_REAL("IMPULSE", impulse, USED, NONE),   CARD_REAL("FAILTM", failtm, USED, TIME),
};
static const FieldSpec damage_fields[] = {
    CARD_INT("IDAM", idam, REFUSED, NONE),
    CARD_GAP,
    CARD_GAP,
    CARD_GAP,
    CARD_GAP,
    CARD_GAP,
    CARD_GAP,
    CARD_INT("LCREGD", lcregd, REFUSED, ID_FUNCTION),
};
static const FieldSpec further_fields[] = {
    CARD_INT("LCFLD", lcfld, REFUSED, ID_FUNCTION),     CARD_INT("NSFF", nsff, LISTED, NONE),
    CARD_REAL("EPSTHIN", epsthin, REFUSED, NONE),       CARD_REAL("ENGCRT", engcrt, REFUSED, NONE),
    CARD_REAL("RADCRT", radcrt, REFUSED, LENGTH),       CARD_INT("LCEPS12", lceps12, REFUSED, ID_FUNCTION),
    CARD_INT("LCEPS13", lceps13, REFUSED, ID_FUNCTION), CARD_INT("LCEPSMX", lcepsmx, REFUSED, ID_FUNCTION),
};
static const FieldSpec filter_fields[] = {
    CARD_REAL("DTEFLT", dteflt, LISTED, TIME),
    CARD_REAL("VOLFRAC", volfrac, LISTED, NONE),
    CARD_REAL("MXTMP", mxtmp, REFUSED, NONE),
    CARD_REAL("DTMIN", dtmin, REFUSED, TIME),
};
#undef AT

enum { EROSION_TITLE };
static const CardSpec cards[] = {
    {"card 1", "", CARD_FIELDS(first_fields)},
    {"card 2", "", CARD_FIELDS(second_fields)},
    {"card 3", "may be left out", CARD_FIELDS(damage_fields)},
    {"card 4", "may be left out", CARD_FIELDS(further_fields)},
    {"card 5", "may be left out", CARD_FIELDS(filter_fields)},
};

/* One criterion of the cards. */
typedef struct Criterion {
    const char *name;
    double value;
    bool first_card; /* 0 counts as none whatever EXCL is */
    bool negative;   /* the value must be below 0, else above */
    bool known;
} Criterion;

static bool is_active(const ErosionDefinition *card, const Criterion *c)
{
    return c->value != card->excl && !(c->first_card && c->value == 0.0);
}

/* Counts what is active and reports what cannot be. */
static int check_criteria(KeywordRead *read, const ErosionDefinition *card, bool *good)
{
    const Criterion criteria[] = {
        {"MXPRES", card->mxpres, true, false, false},    {"MNEPS", card->mneps, true, true, true},
        {"EFFEPS", card->effeps, true, false, true},     {"VOLEPS", card->voleps, true, false, false},
        {"MNPRES", card->mnpres, false, true, false},    {"SIGP1", card->sigp1, false, false, true},
        {"SIGVM", card->sigvm, false, false, true},      {"MXEPS", card->mxeps, false, false, true},
        {"EPSSH", card->epssh, false, false, true},      {"SIGTH", card->sigth, false, false, false},
        {"IMPULSE", card->impulse, false, false, false},
    };
    int active = 0;
    for (size_t i = 0; i < sizeof criteria / sizeof *criteria; i++) {
        const Criterion *c = &criteria[i];
        if (!is_active(card, c)) continue;
        active++;
        if (c->known && (c->negative ? c->value < 0.0 : c->value > 0.0)) continue;
        *good = false;
        if (!c->known)
            keyword_error(read, card->source,
                          "%s is %g, but billow has no such criterion for membranes; take MNEPS, EFFEPS, MXEPS, EPSSH, "
                          "SIGP1, SIGVM or FAILTM, and leave %s at EXCL",
                          c->name, c->value, c->name);
        else if (c->value == 0.0)
            keyword_error(read, card->source,
                          "%s is 0 and differs from EXCL = %g, so that fabric at rest would erode; give %g where there "
                          "is no criterion",
                          c->name, card->excl, card->excl);
        else
            keyword_error(read, card->source, "%s is %g, but must be %s 0%s", c->name, c->value,
                          c->negative ? "below" : "above",
                          c->negative ? "" : "; curves over the strain rate and plastic strain are not there");
    }
    return active;
}

static void check_numbers(KeywordRead *read, const ErosionDefinition *card, int active, bool *good)
{
    if (card->numfip > 1.0 || card->numfip < -100.0) {
        keyword_error(read, card->source,
                      "NUMFIP is %g, but a membrane has one layer; give 1, or a percentage as a negative number",
                      card->numfip);
        *good = false;
    }
    if (card->ncs < 0.0 || (active > 0 && card->ncs > active)) {
        keyword_error(read, card->source, "NCS is %g, but there are %d criteria; give 1 to %d", card->ncs, active,
                      active);
        *good = false;
    }
    if (active == 0 && card->failtm == 0.0)
        keyword_warning(read, card->source, "material %d has no criterion here and does not erode", card->mid);
}

static void read_erosion(KeywordRead *read)
{
    ErosionDefinition card = {0};
    char title[BILLOW_TITLE_LENGTH];
    keyword_title(read, EROSION_TITLE, title);
    int status = keyword_card(read, 0, &card, true, &card.source);
    if (keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
    for (int i = 2; i < 5 && keyword_more(read); i++)
        if (keyword_card(read, i, &card, status == 0, NULL)) status = -1;
    if (status) return;
    keyword_finish(read);
    bool good = keyword_check_id(read, card.mid, "MID", card.source);
    const int active = check_criteria(read, &card, &good);
    check_numbers(read, &card, active, &good);
    if (!good) return;
    ErosionDefinition *erosion = KEYWORD_APPEND(read, read->definitions->erosions);
    if (erosion) *erosion = card;
}

static const KeywordSpec specs[] = {
    {.name = "*MAT_ADD_EROSION",
     .aliases = {"*MAT_000"},
     .options = {"TITLE"},
     .cards = cards,
     .card_count = 5,
     .read = read_erosion,
     .remark =
         "Shells of the material that meet NCS of the criteria at one of their points are taken out, all of them from "
         "FAILTM on (docs/theory.md, X8 to X11): logarithmic strains, Cauchy stress. A criterion whose value is EXCL "
         "is "
         "none; on card 1 neither is 0. MXPRES, VOLEPS, MNPRES, SIGTH, IMPULSE, negative SIGVM, MXEPS and EFFEPS, "
         "damage "
         "models and card 4 are refused. For *MAT_FABRIC, *MAT_ELASTIC, *MAT_ORTHOTROPIC_ELASTIC and rubber. Their "
         "mass "
         "stays at the nodes, their energy counts as internal; a hole leaks only with VNTOPT 2 or 10. "
         "Contact leaves them out, and nodes without other shells unless ENMASS = 2 in *CONTROL_CONTACT."},
};

const KeywordFamily keyword_family_erosion = {"Erosion", specs, (int)(sizeof specs / sizeof *specs)};
