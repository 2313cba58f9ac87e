/* Airbags of mixed gases: *AIRBAG_HYBRID and *AIRBAG_HYBRID_CHEMKIN. */
#include "io/keyword_airbag.h"
#include "io/keyword_airbag_jet.h"

#define AT(member) offsetof(AirbagDefinition, member)
static const FieldSpec hybrid3_fields[] = {
    CARD_REAL("ATMOST", atmost, USED, TEMPERATURE), CARD_REAL("ATMOSP", atmosp, USED, PRESSURE),
    CARD_REAL("ATMOSD", atmosd, USED, DENSITY),     CARD_REAL("GC", gc, USED, NONE),
    CARD_REAL_OR("CC", cc, 1.0, USED, NONE),        CARD_REAL("HCONV", hconv, USED, NONE),
};
static const FieldSpec hybrid4_fields[] = {
    CARD_REAL("C23", c23, USED, NONE),   CARD_INT("LCC23", lcc23, USED, ID_FUNCTION),
    CARD_REAL("A23", a23, USED, NONE),   CARD_INT("LCA23", lca23, USED, ID_FUNCTION),
    CARD_REAL("CP23", cp23, USED, NONE), CARD_INT("LCCP23", lccp23, USED, ID_FUNCTION),
    CARD_REAL("AP23", ap23, USED, AREA), CARD_INT("LCAP23", lcap23, USED, ID_FUNCTION),
};
static const FieldSpec hybrid5_fields[] = {
    CARD_REAL("OPT", opt, USED, NONE),
    CARD_REAL("PVENT", ppop, USED, PRESSURE),
    CARD_INT("NGAS", ngas, USED, NONE),
    CARD_INT("LCEFR", lcefr, USED, ID_FUNCTION),
    CARD_INT("LCIDM0", lcidm0, USED, ID_FUNCTION),
    CARD_INT("VNTOPT", vntopt, USED, NONE),
};
static const FieldSpec chemkin3_fields[] = {
    CARD_INT("LCIDM", lcidm, USED, ID_FUNCTION),
    CARD_INT("LCIDT", lcidt, USED, ID_FUNCTION),
    CARD_INT("NGAS", ngas, USED, NONE),
    CARD_INT("DATA", data, USED, NONE),
    CARD_REAL("ATMT", atmost, USED, TEMPERATURE),
    CARD_REAL("ATMP", atmosp, USED, PRESSURE),
    CARD_REAL("RG", gc, USED, NONE),
};
static const FieldSpec chemkin4_fields[] = {CARD_REAL("HCONV", hconv, USED, NONE)};
static const FieldSpec chemkin5_fields[] = {CARD_REAL("C23", c23, USED, NONE), CARD_REAL("A23", a23, USED, AREA)};
#undef AT

#define AT(member) offsetof(AirbagGasDefinition, member)
static const FieldSpec hybrid51_fields[] = {
    CARD_INT("LCIDM", lcidm, USED, ID_FUNCTION),
    CARD_INT("LCIDT", lcidt, USED, ID_FUNCTION),
    CARD_GAP,
    CARD_REAL("MW", mw, USED, NONE),
    CARD_REAL("INITM", initm, USED, NONE),
    CARD_REAL("A", a, USED, NONE),
    CARD_REAL("B", b, USED, NONE),
    CARD_REAL("C", c, USED, NONE),
};
static const FieldSpec hybrid52_fields[] = {CARD_REAL("FMASS", fmass, USED, NONE)};
static const FieldSpec chemkin6_fields[] = {
    CARD_TEXT("CHNAME", chname, 10, USED),       CARD_REAL("MW", mw, USED, NONE),
    CARD_INT("LCIDN", lcidn, USED, ID_FUNCTION), CARD_REAL("FMOLE", fmole, USED, NONE),
    CARD_REAL("FMOLET", fmolet, USED, NONE),
};
static const FieldSpec nist1_fields[] = {
    CARD_REAL("TLOW", tlow, USED, TEMPERATURE),
    CARD_REAL("TMID", tmid, USED, TEMPERATURE),
    CARD_REAL("THIGH", thigh, USED, TEMPERATURE),
};
static const FieldSpec nist2_fields[] = {
    CARD_REAL("ALOW", low[0], USED, NONE),   CARD_REAL("BLOW", low[1], USED, NONE),
    CARD_REAL("CLOW", low[2], USED, NONE),   CARD_REAL("DLOW", low[3], USED, NONE),
    CARD_REAL("ELOW", low[4], USED, NONE),   CARD_REAL("FLOW", low[5], LISTED, NONE),
    CARD_REAL("HLOW", low[6], LISTED, NONE),
};
static const FieldSpec nist3_fields[] = {
    CARD_REAL("AHIGH", high[0], USED, NONE),   CARD_REAL("BHIGH", high[1], USED, NONE),
    CARD_REAL("CHIGH", high[2], USED, NONE),   CARD_REAL("DHIGH", high[3], USED, NONE),
    CARD_REAL("EHIGH", high[4], USED, NONE),   CARD_REAL("FHIGH", high[5], LISTED, NONE),
    CARD_REAL("HHIGH", high[6], LISTED, NONE),
};
static const FieldSpec polynomial_fields[] = {
    CARD_REAL("A", a, USED, NONE), CARD_REAL("B", b, USED, NONE), CARD_REAL("C", c, USED, NONE),
    CARD_REAL("D", d, USED, NONE), CARD_REAL("E", e, USED, NONE),
};
#undef AT

enum {
    HYBRID_CARD3 = AIRBAG_CARD_MODEL,
    HYBRID_CARD4,
    HYBRID_CARD5,
    HYBRID_CARD51,
    HYBRID_CARD52,
    HYBRID_CARD6,
    HYBRID_CARD7,
    HYBRID_CARD8
};
enum { HYBRID_JETTING = AIRBAG_OPTION_ID + 1, HYBRID_CM };
static const CardSpec hybrid_cards[] = {
    AIRBAG_CARDS,
    {"card 3", "", CARD_FIELDS(hybrid3_fields)},
    {"card 4", "", CARD_FIELDS(hybrid4_fields)},
    {"card 5", "", CARD_FIELDS(hybrid5_fields)},
    {"card 5.1", "one for each gas", CARD_FIELDS(hybrid51_fields)},
    {"card 5.2", "after each card 5.1", CARD_FIELDS(hybrid52_fields)},
    AIRBAG_HYBRID_JET_CARDS,
};
enum {
    CHEMKIN_CARD3 = AIRBAG_CARD_MODEL,
    CHEMKIN_CARD4,
    CHEMKIN_CARD5,
    CHEMKIN_CARD6,
    CHEMKIN_CARD7A1,
    CHEMKIN_CARD7A2,
    CHEMKIN_CARD7A3,
    CHEMKIN_CARD7B
};
static const CardSpec chemkin_cards[] = {
    AIRBAG_CARDS,
    {"card 3", "", CARD_FIELDS(chemkin3_fields)},
    {"card 4", "", CARD_FIELDS(chemkin4_fields)},
    {"card 5", "", CARD_FIELDS(chemkin5_fields)},
    {"card 6", "one for each gas", CARD_FIELDS(chemkin6_fields)},
    {"card 7a.1", "after each card 6 with DATA = 1", CARD_FIELDS(nist1_fields)},
    {"card 7a.2", "likewise", CARD_FIELDS(nist2_fields)},
    {"card 7a.3", "likewise", CARD_FIELDS(nist3_fields)},
    {"card 7b", "after each card 6 with DATA = 3", CARD_FIELDS(polynomial_fields)},
};

/* HCONV: a curve if negative, else in the units of the main deck. */
static int convert_heat_transfer(KeywordRead *read, AirbagDefinition *bag, Source source)
{
    const IncludeTransform *t = read->cards->block->transform;
    if (bag->hconv < 0.0) return keyword_real_id(read, &bag->hconv, SCALE_ID_FUNCTION, "HCONV", source) ? 0 : -1;
    if (t) bag->hconv *= t->fctmas / (t->fcttim * t->fcttim * t->fcttim * t->fcttem);
    return 0;
}

/* The gas constant and the coefficients of one gas in the units of the main deck; a mole is the same everywhere. */
static void convert_gas(const KeywordRead *read, AirbagGasDefinition *gas)
{
    const IncludeTransform *t = read->cards->block->transform;
    if (!t) return;
    const double molar = t->fctmas * t->fctlen * t->fctlen / (t->fcttim * t->fcttim * t->fcttem);
    double *terms[] = {&gas->a, &gas->b, &gas->c, &gas->d, &gas->e}, factor = molar;
    for (int i = 0; i < 5; i++, factor /= t->fcttem) {
        *terms[i] *= factor;
        if (i == 4) break;
        gas->low[i] *= factor;
        gas->high[i] *= factor;
    }
    gas->low[4] *= molar * t->fcttem * t->fcttem;
    gas->high[4] *= molar * t->fcttem * t->fcttem;
    gas->mw *= t->fctmas;
}

static void convert_constant(const KeywordRead *read, AirbagDefinition *bag)
{
    const IncludeTransform *t = read->cards->block->transform;
    if (t) bag->gc *= t->fctmas * t->fctlen * t->fctlen / (t->fcttim * t->fcttim * t->fcttem);
}

static int check_count(const KeywordRead *read, const AirbagDefinition *bag, Source source)
{
    if (bag->ngas >= 1 && bag->ngas <= BILLOW_AIRBAG_GASES) return 0;
    keyword_error(read, source, "NGAS is %d, but must be 1 to %d", bag->ngas, BILLOW_AIRBAG_GASES);
    return -1;
}

static void read_hybrid(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_HYBRID};
    const JetOptions jet = {
        .jetting = keyword_option(read, HYBRID_JETTING),
        .cm = keyword_option(read, HYBRID_CM),
        .shape_card = HYBRID_CARD6,
        .focus_card = HYBRID_CARD7,
        .react_card = HYBRID_CARD8,
    };
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, HYBRID_CARD3, &bag, true, &bag.card3)) return;
    if (keyword_card(read, HYBRID_CARD4, &bag, true, &bag.card4)) return;
    if (keyword_card(read, HYBRID_CARD5, &bag, true, &bag.card5)) return;
    if (check_count(read, &bag, bag.card5)) return;
    for (int i = 0; i < bag.ngas; i++) {
        AirbagGasDefinition *gas = &bag.gases[i];
        if (keyword_card(read, HYBRID_CARD51, gas, true, &gas->source)) return;
        const bool needed = i + 1 < bag.ngas || jet.jetting; /* the last card may be left out */
        if (keyword_card(read, HYBRID_CARD52, gas, needed, NULL) && needed) return;
        convert_gas(read, gas);
    }
    if (airbag_read_jet(read, &jet, &bag)) return;
    keyword_finish(read);
    if (bag.vntopt != 0 && bag.vntopt != 1 && bag.vntopt != 2 && bag.vntopt != 10) {
        keyword_error(read, bag.card5, "VNTOPT is %d, but must be 0, 1, 2 or 10", bag.vntopt);
        return;
    }
    if (airbag_check_vents(read, &bag) || convert_heat_transfer(read, &bag, bag.card3)) return;
    convert_constant(read, &bag);
    airbag_store(read, &bag);
}

/* Cards 6 and 7 of one gas. */
static int read_chemkin_gas(KeywordRead *read, const AirbagDefinition *bag, AirbagGasDefinition *gas)
{
    if (keyword_card(read, CHEMKIN_CARD6, gas, true, &gas->source)) return -1;
    if (bag->data == 1)
        for (int card = CHEMKIN_CARD7A1; card <= CHEMKIN_CARD7A3; card++)
            if (keyword_card(read, card, gas, true, NULL)) return -1;
    if (bag->data == 3 && keyword_card(read, CHEMKIN_CARD7B, gas, true, NULL)) return -1;
    convert_gas(read, gas);
    return 0;
}

static void read_chemkin(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_CHEMKIN};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, CHEMKIN_CARD3, &bag, true, &bag.card3)) return;
    if (keyword_card(read, CHEMKIN_CARD4, &bag, true, &bag.card4)) return;
    if (keyword_card(read, CHEMKIN_CARD5, &bag, true, &bag.card5)) return;
    if (check_count(read, &bag, bag.card3)) return;
    if (bag.data < 1 || bag.data > 3) {
        keyword_error(read, bag.card3, "DATA is %d, but must be 1 (NIST), 2 (built-in table) or 3 (polynomials)",
                      bag.data);
        return;
    }
    if (bag.a23 < 0.0) {
        keyword_error(read, bag.card5, "A23 is %g, but must be the area of the vent", bag.a23);
        return;
    }
    for (int i = 0; i < bag.ngas; i++)
        if (read_chemkin_gas(read, &bag, &bag.gases[i])) return;
    keyword_finish(read);
    if (convert_heat_transfer(read, &bag, bag.card4)) return;
    convert_constant(read, &bag);
    airbag_store(read, &bag);
}

static const KeywordSpec specs[] = {
    {.name = "*AIRBAG_HYBRID",
     .options = {"ID", "JETTING", "CM"},
     .cards = hybrid_cards,
     .card_count = sizeof hybrid_cards / sizeof *hybrid_cards,
     .read = read_hybrid,
     .remark =
         "Up to 17 gases. Negative LCIDM, LCIDT and LCIDM0 ask for a natural cubic spline through the points. FMASS "
         "draws in that share of ambient gas (of the composition INITM, at ATMOST). CC multiplies the energy in "
         "the speed of the exit flow. PVENT opens the exits for good. Outflow has the bag's composition by mass. Vents "
         "and "
         "leakage as in WANG_NEFSKE; VNTOPT 1 and 10 count what a vent part has grown by, 2 and 10 what has eroded of "
         "the walls. The jet's "
         "fields are those of WANG_NEFSKE_JETTING; its gas is the mixture that flows in, at its mixed temperature."},
    {.name = "*AIRBAG_HYBRID_CHEMKIN",
     .options = {"ID"},
     .cards = chemkin_cards,
     .card_count = sizeof chemkin_cards / sizeof *chemkin_cards,
     .read = read_chemkin,
     .remark = "Up to 17 gases. DATA = 2 takes N2, O2, AR, HE, CO2, H2O, CO, H2, NO, NO2, N2O, NH3, CH4, HCL, SO2, OH, "
               "O, H and N from a built-in table (NASA TM-4513). DATA = 1: coefficients for T, or for T/1000 as in the "
               "NIST web book, whichever gives a gas. Constants of integration (F, H) have no say. Negative LCIDM and "
               "LCIDT ask for cubic splines."},
};

const KeywordFamily keyword_family_airbag_hybrid = {"Airbags of mixed gases", specs,
                                                    (int)(sizeof specs / sizeof *specs)};
