/* *MAT_FABRIC. */
#include "io/keyword_table.h"

#define AT(member) offsetof(MaterialDefinition, member)
static const FieldSpec card1_fields[] = {
    CARD_INT("MID", id, USED, ID_MATERIAL),
    CARD_REAL("RO", ro, USED, DENSITY),
    CARD_REAL("EA", fabric.ea, USED, PRESSURE),
    CARD_REAL("EB", fabric.eb, USED, PRESSURE),
    CARD_GAP,
    CARD_REAL("PRBA", fabric.prba, USED, NONE),
    CARD_REAL("PRAB", fabric.prab, USED, NONE),
};
static const FieldSpec card2_fields[] = {
    CARD_REAL("GAB", fabric.gab, USED, PRESSURE),
    CARD_GAP,
    CARD_GAP,
    CARD_REAL("CSE", fabric.cse, USED, NONE),
    CARD_REAL("EL", fabric.el, USED, PRESSURE),
    CARD_REAL("PRL", fabric.prl, USED, NONE),
    CARD_REAL("LRATIO", fabric.lratio, USED, NONE),
    CARD_REAL("DAMP", fabric.damp, USED, NONE),
};
static const FieldSpec card3_fields[] = {
    CARD_REAL("AOPT", fabric.aopt, USED, NONE),   CARD_REAL("FLC", fabric.flc, USED, NONE),
    CARD_REAL("FAC", fabric.fac, USED, NONE),     CARD_REAL("ELA", fabric.ela, USED, NONE),
    CARD_REAL("LNRC", fabric.lnrc, USED, NONE),   CARD_INT("FORM", fabric.form, USED, NONE),
    CARD_REAL("FVOPT", fabric.fvopt, USED, NONE), CARD_REAL("TSRFAC", fabric.tsrfac, USED, NONE),
};
static const FieldSpec card4_fields[] = {
    CARD_GAP,
    CARD_REAL("RGBRTH", fabric.rgbrth, USED, TIME),
    CARD_REAL("A0REF", fabric.a0ref, USED, NONE),
    CARD_REAL("A1", fabric.a1, USED, NONE),
    CARD_REAL("A2", fabric.a2, USED, NONE),
    CARD_REAL("A3", fabric.a3, USED, NONE),
    CARD_REAL("X0", fabric.x0, USED, NONE),
    CARD_REAL("X1", fabric.x1, USED, NONE),
};
static const FieldSpec card5_fields[] = {
    CARD_REAL("V1", fabric.v1, USED, NONE),
    CARD_REAL("V2", fabric.v2, USED, NONE),
    CARD_REAL("V3", fabric.v3, USED, NONE),
    CARD_GAP,
    CARD_GAP,
    CARD_GAP,
    CARD_REAL("BETA", fabric.beta, USED, NONE),
    CARD_REAL("ISREFG", fabric.isrefg, USED, NONE),
};
static const FieldSpec card6_fields[] = {
    CARD_INT("LCA", fabric.lca, USED, ID_FUNCTION),   CARD_INT("LCB", fabric.lcb, USED, ID_FUNCTION),
    CARD_INT("LCAB", fabric.lcab, USED, ID_FUNCTION), CARD_INT("LCUA", fabric.lcua, USED, ID_FUNCTION),
    CARD_INT("LCUB", fabric.lcub, USED, ID_FUNCTION), CARD_INT("LCUAB", fabric.lcuab, USED, ID_FUNCTION),
    CARD_REAL("RL", fabric.rl, USED, NONE),
};
static const FieldSpec card7_fields[] = {
    CARD_INT("LCAA", fabric.lcaa, REFUSED, ID_FUNCTION),
    CARD_INT("LCBB", fabric.lcbb, REFUSED, ID_FUNCTION),
    CARD_REAL("H", fabric.h, USED, NONE),
    CARD_REAL("DT", fabric.dt, LISTED, TIME),
    CARD_GAP,
    CARD_REAL("ECOAT", fabric.ecoat, LISTED, PRESSURE),
    CARD_REAL("SCOAT", fabric.scoat, LISTED, PRESSURE),
    CARD_REAL("TCOAT", fabric.tcoat, LISTED, LENGTH),
};
#undef AT

enum { FABRIC_TITLE };
static const CardSpec cards[] = {
    {"card 1", "", CARD_FIELDS(card1_fields)},
    {"card 2", "", CARD_FIELDS(card2_fields)},
    {"card 3", "", CARD_FIELDS(card3_fields)},
    {"card 4", "may be left out if AOPT = 0", CARD_FIELDS(card4_fields)},
    {"card 5", "may be left out if AOPT = 0", CARD_FIELDS(card5_fields)},
    {"card 6", "if FORM is 4, 14, -14 or 24", CARD_FIELDS(card6_fields)},
    {"card 7", "if FORM = -14; may follow with FORM = 24", CARD_FIELDS(card7_fields)},
};

static bool is_known(int form)
{
    return (form >= 0 && form <= 4) || (form >= 12 && form <= 14) || form == -14 || form == 24;
}

/* Cards 4 to 7; 0, or -1 after an error. */
static int read_optional(KeywordRead *read, MaterialDefinition *card)
{
    int status = 0, form = card->fabric.form;
    const bool curves = form == 4 || form == 14 || form == -14 || form == 24;
    for (int i = 3; i < 5; i++)
        if ((curves || card_left(read->cards)) && keyword_card(read, i, card, true, NULL)) status = -1;
    if (!curves) return status;
    if (keyword_card(read, 5, card, status == 0, NULL)) status = -1;
    if ((form == -14 || (form == 24 && keyword_more(read))) && keyword_card(read, 6, card, status == 0, NULL))
        status = -1;
    return status;
}

static void read_fabric(KeywordRead *read)
{
    MaterialDefinition card = {.kind = MATERIAL_FABRIC, .keyword = "*MAT_FABRIC"};
    FabricCard *fabric = &card.fabric;
    keyword_title(read, FABRIC_TITLE, card.title);
    Source third = BILLOW_NO_SOURCE;
    int status = keyword_card(read, 0, &card, true, &card.source);
    for (int i = 1; i < 3; i++)
        if (keyword_card(read, i, &card, status == 0, &third)) status = -1;
    if (status) return;
    status = read_optional(read, &card);
    if (is_known(fabric->form)) {
        keyword_finish(read);
    } else { /* the material is kept, so that its parts do not complain that it is missing */
        keyword_error(read, third, "FORM = %d is not known; use 0 to 4, 12 to 14, -14 or 24", fabric->form);
    }
    if (status || !keyword_check_id(read, card.id, "MID", card.source)) return;
    if (fabric->aopt < 0.0 && !keyword_real_id(read, &fabric->aopt, SCALE_ID_DEFINE, "AOPT", third)) return;
    if (!keyword_check_leakage(read, &fabric->flc, &fabric->fac, &fabric->ela, fabric->fvopt, fabric->x0, fabric->x1,
                               third))
        return;
    double a[3] = {fabric->a1, fabric->a2, fabric->a3}, v[3] = {fabric->v1, fabric->v2, fabric->v3};
    keyword_transform_vector(read, a);
    keyword_transform_vector(read, v);
    fabric->a1 = a[0], fabric->a2 = a[1], fabric->a3 = a[2];
    fabric->v1 = v[0], fabric->v2 = v[1], fabric->v3 = v[2];
    MaterialDefinition *material = KEYWORD_APPEND(read, read->definitions->materials);
    if (material) *material = card;
}

static const KeywordSpec specs[] = {
    {.name = "*MAT_FABRIC",
     .aliases = {"*MAT_034", "*MAT_34"},
     .options = {"TITLE"},
     .cards = cards,
     .card_count = 7,
     .read = read_fabric,
     .remark =
         "FORM 3, 12 and 13 are FORM 2: Green strain in fibre directions that need not stay orthogonal. Curves: FORM "
         "4, 14 "
         "and -14 second Piola-Kirchhoff stress over Green strain, FORM 24 engineering stress over engineering strain, "
         "shear over twice the shear strain; stress must grow with strain, and beyond its ends a curve goes on with "
         "its "
         "last slope. Where a curve is left out EA, EB or GAB stands for it. PRBA and PRAB have no effect beside "
         "curves, "
         "which is warned of. With CSE = 1 fibres of curves carry no compression; the shear between them stays. H is "
         "the share of energy that a cycle "
         "dissipates. ECOAT, SCOAT and TCOAT give bending, which a membrane has not; DT averages strain rates, which "
         "no "
         "curve depends on. FLC, FAC, ELA, FVOPT, X0, X1 and A0REF are for leakage through the fabric, which OPT of "
         "the "
         "airbag switches on; FLC < 0, FAC < 0 and ELA < 0 name curves; where X0 is neither 0 nor 1 FLC and FAC are X2 "
         "and X3. LNRC, RGBRTH and TSRFAC act on a reference geometry (docs/theory.md): LNRC = 1 with CSE = 1 only, 0 "
         "< TSRFAC < "
         "1 and TSRFAC < 0 (minus a curve) by cycle, TSRFAC >= 1 a curve over time. ISREFG = 1 with FORM = 12 keeps "
         "the initial tension from the start on."},
};

const KeywordFamily keyword_family_fabric = {"Fabric", specs, (int)(sizeof specs / sizeof *specs)};
