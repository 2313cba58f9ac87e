/* *AIRBAG_SIMPLE_AIRBAG_MODEL and *AIRBAG_WANG_NEFSKE. */
#include <string.h>

#include "io/keyword_airbag.h"
#include "io/keyword_airbag_jet.h"

typedef struct BagIdCard {
    int id;
    char heading[71];
} BagIdCard;

#define AT(member) offsetof(BagIdCard, member)
const FieldSpec airbag_id_fields[AIRBAG_ID_FIELDS] = {CARD_INT("ABID", id, USED, ID_OTHER),
                                                      CARD_TEXT("HEADING", heading, 70, USED)};
#undef AT

#define AT(member) offsetof(AirbagDefinition, member)
const FieldSpec airbag_core_fields[AIRBAG_CORE_FIELDS] = {
    CARD_INT("SID", sid, USED, ID_SET),          CARD_INT("SIDTYP", sidtyp, USED, NONE),
    CARD_INT("RBID", rbid, USED, NONE),          CARD_REAL_OR("VSCA", vsca, 1.0, USED, NONE),
    CARD_REAL_OR("PSCA", psca, 1.0, USED, NONE), CARD_REAL("VINI", vini, USED, VOLUME),
    CARD_REAL("MWD", mwd, USED, RATE),           CARD_REAL("SPSF", spsf, USED, NONE),
};
static const FieldSpec simple3_fields[] = {
    CARD_REAL("CV", cv, USED, NONE),           CARD_REAL("CP", cp, USED, NONE),    CARD_REAL("T", t, USED, TEMPERATURE),
    CARD_INT("LCID", lcid, USED, ID_FUNCTION), CARD_REAL("MU", mu, USED, NONE),    CARD_REAL("AREA", area, USED, NONE),
    CARD_REAL("PE", pe, USED, PRESSURE),       CARD_REAL("RO", ro, USED, DENSITY),
};
static const FieldSpec simple4a_fields[] = {
    CARD_INT("LOU", lou, USED, ID_FUNCTION), CARD_REAL("T_EXT", text, USED, TEMPERATURE),
    CARD_REAL("A", a, USED, NONE),           CARD_REAL("B", b, USED, NONE),
    CARD_REAL("MW", mw, USED, NONE),         CARD_REAL("GASC", gasc, USED, NONE),
};
/* With CV given only LOU counts; preprocessors fill the rest with zeros. */
static const FieldSpec simple4b_fields[] = {
    CARD_INT("LOU", lou, USED, ID_FUNCTION), CARD_REAL("T_EXT", text, LISTED, TEMPERATURE),
    CARD_REAL("A", a, LISTED, NONE),         CARD_REAL("B", b, LISTED, NONE),
    CARD_REAL("MW", mw, LISTED, NONE),       CARD_REAL("GASC", gasc, LISTED, NONE),
};
static const FieldSpec wang3_fields[] = {
    CARD_REAL("CV", cv, USED, NONE),           CARD_REAL("CP", cp, USED, NONE),
    CARD_REAL("T", t, USED, TEMPERATURE),      CARD_INT("LCT", lct, USED, ID_FUNCTION),
    CARD_INT("LCMT", lcmt, USED, ID_FUNCTION), CARD_REAL("TVOL", tvol, USED, VOLUME),
    CARD_INT("LCDT", lcdt, USED, ID_FUNCTION), CARD_REAL("IABT", iabt, USED, TEMPERATURE),
};
static const FieldSpec wang4_fields[] = {
    CARD_REAL("C23", c23, USED, NONE),   CARD_INT("LCC23", lcc23, USED, ID_FUNCTION),
    CARD_REAL("A23", a23, USED, NONE),   CARD_INT("LCA23", lca23, USED, ID_FUNCTION),
    CARD_REAL("CP23", cp23, USED, NONE), CARD_INT("LCCP23", lccp23, USED, ID_FUNCTION),
    CARD_REAL("AP23", ap23, USED, AREA), CARD_INT("LCAP23", lcap23, USED, ID_FUNCTION),
};
static const FieldSpec wang5_fields[] = {
    CARD_REAL("PE", pe, USED, PRESSURE),       CARD_REAL("RO", ro, USED, DENSITY),
    CARD_REAL("GC", gc, USED, NONE),           CARD_INT("LCEFR", lcefr, USED, ID_FUNCTION),
    CARD_REAL("POVER", pover, USED, PRESSURE), CARD_REAL("PPOP", ppop, USED, PRESSURE),
    CARD_REAL("OPT", opt, USED, NONE),         CARD_INT("KNKDN", knkdn, USED, ID_FUNCTION),
};
static const FieldSpec wang6_fields[] = {
    CARD_REAL("IOC", ioc, USED, NONE),      CARD_REAL("IOA", ioa, USED, AREA),
    CARD_REAL("IVOL", ivol, USED, VOLUME),  CARD_REAL("IRO", iro, USED, DENSITY),
    CARD_REAL("IT", it, USED, TEMPERATURE), CARD_INT("LCBF", lcbf, USED, ID_FUNCTION),
};
static const FieldSpec wang6_spare_fields[] = {
    CARD_REAL("IOC", ioc, LISTED, NONE),      CARD_REAL("IOA", ioa, LISTED, AREA),
    CARD_REAL("IVOL", ivol, LISTED, VOLUME),  CARD_REAL("IRO", iro, LISTED, DENSITY),
    CARD_REAL("IT", it, LISTED, TEMPERATURE), CARD_INT("LCBF", lcbf, LISTED, ID_FUNCTION),
};
static const FieldSpec wang7_fields[] = {
    CARD_REAL("TEXT", text, USED, TEMPERATURE),
    CARD_REAL("A", a, USED, NONE),
    CARD_REAL("B", b, USED, NONE),
    CARD_REAL("MW", mw, USED, NONE),
    CARD_REAL("GASC", gasc, USED, NONE),
    CARD_REAL("HCONV", hconv, USED, NONE),
};
static const FieldSpec wang8_fields[] = {
    CARD_REAL("TDP", tdp, USED, TIME),
    CARD_REAL("AXP", axp, USED, ACCELERATION),
    CARD_REAL("AYP", ayp, USED, ACCELERATION),
    CARD_REAL("AZP", azp, USED, ACCELERATION),
    CARD_REAL("AMAGP", amagp, USED, ACCELERATION),
    CARD_REAL("TDURP", tdurp, USED, TIME),
    CARD_REAL("TDA", tda, USED, TIME),
    CARD_INT("RBIDP", rbidp, USED, ID_PART),
};
#undef AT

enum { SIMPLE_CARD3 = AIRBAG_CARD_MODEL, SIMPLE_CARD4A, SIMPLE_CARD4B };
static const CardSpec simple_cards[] = {
    AIRBAG_CARDS,
    {"card 3", "", CARD_FIELDS(simple3_fields)},
    {"card 4a", "if CV = 0", CARD_FIELDS(simple4a_fields)},
    {"card 4b", "if CV is not 0; may be left out", CARD_FIELDS(simple4b_fields)},
};
enum {
    WANG_CARD3 = AIRBAG_CARD_MODEL,
    WANG_CARD4,
    WANG_CARD5,
    WANG_CARD6,
    WANG_CARD6_SPARE,
    WANG_CARD7,
    WANG_CARD8,
    WANG_CARD9A,
    WANG_CARD9B,
    WANG_CARD10,
    WANG_CARD11
};
enum { WANG_POP = AIRBAG_OPTION_ID + 1, WANG_JETTING, WANG_MULTIPLE_JETTING, WANG_CM };
static const CardSpec wang_cards[] = {
    AIRBAG_CARDS,
    {"card 3", "", CARD_FIELDS(wang3_fields)},
    {"card 4", "", CARD_FIELDS(wang4_fields)},
    {"card 5", "", CARD_FIELDS(wang5_fields)},
    {"card 6", "if LCMT = 0", CARD_FIELDS(wang6_fields)},
    {"card 6", "if LCMT is not 0; to be left blank", CARD_FIELDS(wang6_spare_fields)},
    {"card 7", "if CV = 0", CARD_FIELDS(wang7_fields)},
    {"card 8", "with POP", CARD_FIELDS(wang8_fields)},
    AIRBAG_JET_CARDS,
};

int airbag_read_core(KeywordRead *read, AirbagDefinition *bag)
{
    int status = 0;
    bag->source = read->cards->block->source;
    if (keyword_option(read, AIRBAG_OPTION_ID)) {
        BagIdCard card = {0};
        Source source;
        if (keyword_card(read, AIRBAG_CARD_ID, &card, true, &source)) return -1;
        if (!keyword_check_id(read, card.id, "ABID", source)) status = -1;
        bag->id = card.id;
        memcpy(bag->heading, card.heading, sizeof card.heading);
    }
    if (keyword_card(read, AIRBAG_CARD_CORE, bag, true, &bag->card1)) return -1;
    if (!keyword_check_id(read, bag->sid, "SID", bag->card1)) status = -1;
    if (airbag_read_sensor(read, AIRBAG_CARD_SENSOR, bag)) status = -1;
    return status;
}

/* Heat capacities, molar quantities and HCONV in the units of the main deck; a mole is the same everywhere. */
static void convert_heat(const KeywordRead *read, AirbagDefinition *bag)
{
    const IncludeTransform *t = read->cards->block->transform;
    if (!t) return;
    const double specific = t->fctlen * t->fctlen / (t->fcttim * t->fcttim * t->fcttem);
    bag->cv *= specific;
    bag->cp *= specific;
    bag->a *= t->fctmas * specific;
    bag->b *= t->fctmas * specific / t->fcttem;
    bag->gasc *= t->fctmas * specific;
    bag->mw *= t->fctmas;
    if (bag->hconv > 0.0) bag->hconv *= t->fctmas / (t->fcttim * t->fcttim * t->fcttim * t->fcttem);
}

void airbag_store(KeywordRead *read, const AirbagDefinition *card)
{
    AirbagDefinition *bag = KEYWORD_APPEND(read, read->definitions->airbags);
    if (bag) *bag = *card;
}

static void read_simple(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_SIMPLE};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, SIMPLE_CARD3, &bag, true, &bag.card3)) return;
    if (bag.mu < 0.0 && !keyword_real_id(read, &bag.mu, SCALE_ID_FUNCTION, "MU", bag.card3)) return;
    if (bag.area < 0.0 && !keyword_real_id(read, &bag.area, SCALE_ID_FUNCTION, "AREA", bag.card3)) return;
    if (bag.area > 0.0) bag.area = keyword_scale(read, bag.area, SCALE_AREA);
    const bool varying = bag.cv == 0.0;
    const bool more = card_left(read->cards);
    bag.card4 = bag.card3;
    if ((varying || more) && keyword_card(read, varying ? SIMPLE_CARD4A : SIMPLE_CARD4B, &bag, true, &bag.card4))
        return;
    keyword_finish(read);
    convert_heat(read, &bag);
    airbag_store(read, &bag);
}

int airbag_check_vents(const KeywordRead *read, AirbagDefinition *bag)
{
    int status = 0;
    if (bag->opt < 0.0 || bag->opt > 8.0) {
        keyword_error(read, bag->card5, "OPT is %g, but must be 0 to 8", bag->opt);
        status = -1;
    }
    if (bag->a23 > 0.0) bag->a23 = keyword_scale(read, bag->a23, SCALE_AREA);
    const FieldScale id = bag->lca23 == -1 ? SCALE_ID_SET : SCALE_ID_PART;
    if (bag->a23 < 0.0 && !keyword_real_id(read, &bag->a23, id, "A23", bag->card4)) status = -1;
    if (bag->lca23 < 0 && !(bag->lca23 == -1 && bag->a23 < 0.0)) {
        keyword_error(read, bag->card4, "LCA23 is %d, but must name a curve, or be -1 with A23 < 0, a part set",
                      bag->lca23);
        status = -1;
    }
    return status;
}

/* Card 6 counts where LCMT = 0: all of it, or nothing. */
static int check_inflator(const KeywordRead *read, const AirbagDefinition *bag)
{
    if (bag->lcmt != 0) return 0;
    const bool all = bag->ioc > 0.0 && bag->ioa > 0.0 && bag->ivol > 0.0 && bag->iro > 0.0 && bag->it > 0.0;
    const bool none = bag->ioc == 0.0 && bag->ioa == 0.0 && bag->ivol == 0.0 && bag->iro == 0.0 && bag->it == 0.0;
    if (none && bag->lcbf == 0) {
        keyword_warning(read, bag->card3, "LCMT = 0 and no inflator on card 6: no gas flows into this bag");
        return 0;
    }
    if (all && bag->lcbf > 0) return 0;
    keyword_error(read, bag->card6,
                  "LCMT = 0 asks for the inflator: IOC, IOA, IVOL, IRO, IT must be positive and LCBF "
                  "name the curve of the burnt fraction");
    return -1;
}

static void read_wang_nefske(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_WANG_NEFSKE};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, WANG_CARD3, &bag, true, &bag.card3)) return;
    if (keyword_card(read, WANG_CARD4, &bag, true, &bag.card4)) return;
    if (keyword_card(read, WANG_CARD5, &bag, true, &bag.card5)) return;
    const int card6 = bag.lcmt == 0 ? WANG_CARD6 : WANG_CARD6_SPARE;
    const bool pop = keyword_option(read, WANG_POP);
    const bool jet = keyword_option(read, WANG_JETTING) || keyword_option(read, WANG_MULTIPLE_JETTING);
    const bool needed =
        bag.lcmt == 0 || bag.cv == 0.0 || pop || jet; /* as the last card it may be left out when it says nothing */
    if ((needed || card_left(read->cards)) && keyword_card(read, card6, &bag, true, &bag.card6)) return;
    bag.card7 = bag.card6;
    if (bag.cv == 0.0 && keyword_card(read, WANG_CARD7, &bag, true, &bag.card7)) return;
    if (pop && keyword_card(read, WANG_CARD8, &bag, true, &bag.card8)) return;
    const bool multiple = keyword_option(read, WANG_MULTIPLE_JETTING);
    const JetOptions options = {
        .jetting = keyword_option(read, WANG_JETTING),
        .multiple = multiple,
        .cm = keyword_option(read, WANG_CM),
        .shape_card = multiple ? WANG_CARD9B : WANG_CARD9A,
        .focus_card = WANG_CARD10,
        .react_card = WANG_CARD11,
    };
    if (airbag_read_jet(read, &options, &bag)) return;
    if (bag.knkdn != 0 && !bag.jet.given)
        keyword_note(read, bag.card5, "KNKDN = %d is read but not used: it applies to jetting only", bag.knkdn);
    keyword_finish(read);
    if (airbag_check_vents(read, &bag)) return;
    if (bag.lcmt < 0 || (bag.lcmt == 0 && bag.tvol != 0.0)) {
        keyword_error(read, bag.card3, "LCMT is %d, but must name the curve of mass flow or of tank pressure",
                      bag.lcmt);
        return;
    }
    if (bag.hconv < 0.0 && !keyword_real_id(read, &bag.hconv, SCALE_ID_FUNCTION, "HCONV", bag.card7)) return;
    if (check_inflator(read, &bag)) return;
    convert_heat(read, &bag);
    airbag_store(read, &bag);
}

static const KeywordSpec specs[] = {
    {.name = "*AIRBAG_SIMPLE_AIRBAG_MODEL",
     .options = {"ID"},
     .cards = simple_cards,
     .card_count = sizeof simple_cards / sizeof *simple_cards,
     .read = read_simple,
     .remark = "SIDTYP 0: SID is a segment set, else a part set. MU < 0 and AREA < 0 name curves over the absolute "
               "pressure. RBID < 0 is the built-in sensor, RBID > 0 the user's (--sensor-library); both shift LCID."},
    {.name = "*AIRBAG_WANG_NEFSKE",
     .options = {"ID", "POP", "JETTING", "MULTIPLE_JETTING", "CM"},
     .cards = wang_cards,
     .card_count = sizeof wang_cards / sizeof *wang_cards,
     .read = read_wang_nefske,
     .remark =
         "Input is a mass flow (LCMT), a tank pressure (LCMT with TVOL) or the inflator of card 6, which releases the "
         "mass "
         "LCBF IRO IVOL at IT into its chamber. GC = 0 "
         "means 1. LCC23 < 0 names a curve over the pressure ratio. A23 < 0 makes part -A23 a vent, with LCA23 = -1 "
         "the part set -A23; "
         "it feels the pressure only if SID has it. OPT 1 to 8 switches CP23 and AP23 off and lets the materials leak "
         "by "
         "FLC and FAC. HCONV < 0 names a curve over time. With POP the exits open TDP after PPOP was reached, or TDA "
         "after "
         "the accelerations of RBIDP in its local axes were exceeded for TDURP in all. "
         "RBID < 0 is the built-in sensor, RBID > 0 the user's (--sensor-library); both shift the inflow: LCMT, LCBF, "
         "LCT and LCDT. LCJRV is over the angle in degrees, CA and BETA below 0 name curves over time; NODE1 and NODE2 "
         "place the jet in place of the coordinates. A jet of the inflator of card 6 has the temperature of its "
         "chamber."},
};

const KeywordFamily keyword_family_airbag = {"Airbags", specs, (int)(sizeof specs / sizeof *specs)};
