/* *AIRBAG_SIMPLE_AIRBAG_MODEL and *AIRBAG_WANG_NEFSKE. */
#include <string.h>

#include "io/keyword_airbag_jet.h"
#include "io/keyword_airbag_sensor.h"

typedef struct BagIdCard {
    int id;
    char heading[71];
} BagIdCard;

#define AT(member) offsetof(BagIdCard, member)
static const FieldSpec id_fields[] = {CARD_INT("ABID", id, USED, ID_OTHER), CARD_TEXT("HEADING", heading, 70, USED)};
#undef AT

#define AT(member) offsetof(AirbagDefinition, member)
static const FieldSpec core_fields[] = {
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
    CARD_REAL("IOC", ioc, REFUSED, NONE),      CARD_REAL("IOA", ioa, REFUSED, AREA),
    CARD_REAL("IVOL", ivol, REFUSED, VOLUME),  CARD_REAL("IRO", iro, REFUSED, DENSITY),
    CARD_REAL("IT", it, REFUSED, TEMPERATURE), CARD_INT("LCBF", lcbf, REFUSED, ID_FUNCTION),
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
#undef AT

enum { BAG_ID, WANG_JETTING, WANG_MULTIPLE_JETTING, WANG_CM };
enum { BAG_ID_CARD, BAG_CORE_CARD, BAG_SENSOR_CARD, BAG_MODEL_CARD = BAG_SENSOR_CARD + AIRBAG_SENSOR_CARD_COUNT };
enum { SIMPLE_CARD3 = BAG_MODEL_CARD, SIMPLE_CARD4A, SIMPLE_CARD4B };
static const CardSpec simple_cards[] = {
    {"ID card", "with ID", CARD_FIELDS(id_fields)},
    {"card 1", "", CARD_FIELDS(core_fields)},
    AIRBAG_SENSOR_CARDS,
    {"card 3", "", CARD_FIELDS(simple3_fields)},
    {"card 4a", "if CV = 0", CARD_FIELDS(simple4a_fields)},
    {"card 4b", "if CV is not 0; may be left out", CARD_FIELDS(simple4b_fields)},
};
enum { WANG_CARD3 = BAG_MODEL_CARD, WANG_CARD4, WANG_CARD5, WANG_CARD6, WANG_CARD6_SPARE, WANG_CARD7, WANG_JET_CARD };
static const CardSpec wang_cards[] = {
    {"ID card", "with ID", CARD_FIELDS(id_fields)},
    {"card 1", "", CARD_FIELDS(core_fields)},
    AIRBAG_SENSOR_CARDS,
    {"card 3", "", CARD_FIELDS(wang3_fields)},
    {"card 4", "", CARD_FIELDS(wang4_fields)},
    {"card 5", "", CARD_FIELDS(wang5_fields)},
    {"card 6", "if LCMT = 0", CARD_FIELDS(wang6_fields)},
    {"card 6", "if LCMT is not 0; to be left blank", CARD_FIELDS(wang6_spare_fields)},
    {"card 7", "if CV = 0", CARD_FIELDS(wang7_fields)},
    AIRBAG_JET_CARDS,
};

/* ID card, card 1 and the sensor's cards. */
static int read_core(KeywordRead *read, AirbagDefinition *bag)
{
    int status = 0;
    bag->source = read->cards->block->source;
    if (keyword_option(read, BAG_ID)) {
        BagIdCard card = {0};
        Source source;
        if (keyword_card(read, BAG_ID_CARD, &card, true, &source)) return -1;
        if (!keyword_check_id(read, card.id, "ABID", source)) status = -1;
        bag->id = card.id;
        memcpy(bag->heading, card.heading, sizeof card.heading);
    }
    if (keyword_card(read, BAG_CORE_CARD, bag, true, &bag->card1)) return -1;
    if (!keyword_check_id(read, bag->sid, "SID", bag->card1)) status = -1;
    if (airbag_read_sensor(read, BAG_SENSOR_CARD, bag)) status = -1;
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

static void store_bag(KeywordRead *read, AirbagDefinition *card)
{
    convert_heat(read, card);
    AirbagDefinition *bag = KEYWORD_APPEND(read, read->definitions->airbags);
    if (bag) *bag = *card;
}

static void read_simple(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_SIMPLE};
    if (read_core(read, &bag)) return;
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
    store_bag(read, &bag);
}

/* What billow has no part for yet; one message for each. */
static int refuse_features(const KeywordRead *read, const AirbagDefinition *bag)
{
    int status = 0;
    if (bag->a23 < 0.0) {
        keyword_error(read, bag->card4,
                      "A23 = %g makes part %g a vent, which billow " BILLOW_VERSION " does not read; give "
                      "the vent's area",
                      bag->a23, -bag->a23);
        status = -1;
    }
    if (bag->opt < 0.0 || bag->opt > 8.0) {
        keyword_error(read, bag->card5, "OPT is %g, but must be 0 to 8", bag->opt);
        status = -1;
    }
    if (bag->lcmt < 0 || (bag->lcmt == 0 && bag->tvol != 0.0)) {
        keyword_error(read, bag->card3, "LCMT is %d, but must name the curve of mass flow or of tank pressure",
                      bag->lcmt);
        status = -1;
    }
    return status;
}

static void read_wang_nefske(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_WANG_NEFSKE};
    if (read_core(read, &bag)) return;
    if (keyword_card(read, WANG_CARD3, &bag, true, &bag.card3)) return;
    if (keyword_card(read, WANG_CARD4, &bag, true, &bag.card4)) return;
    if (keyword_card(read, WANG_CARD5, &bag, true, &bag.card5)) return;
    const int card6 = bag.lcmt == 0 ? WANG_CARD6 : WANG_CARD6_SPARE;
    const bool jet = keyword_option(read, WANG_JETTING) || keyword_option(read, WANG_MULTIPLE_JETTING);
    const bool needed =
        bag.lcmt == 0 || bag.cv == 0.0 || jet; /* as the last card it may be left out when it says nothing */
    if ((needed || card_left(read->cards)) && keyword_card(read, card6, &bag, true, &bag.card6)) return;
    bag.card7 = bag.card6;
    if (bag.cv == 0.0 && keyword_card(read, WANG_CARD7, &bag, true, &bag.card7)) return;
    if (airbag_read_jet(read, WANG_JET_CARD, keyword_option(read, WANG_JETTING),
                        keyword_option(read, WANG_MULTIPLE_JETTING), keyword_option(read, WANG_CM), &bag))
        return;
    if (bag.knkdn != 0 && !bag.jet.given)
        keyword_note(read, bag.card5, "KNKDN = %d is read but not used: it applies to jetting only", bag.knkdn);
    keyword_finish(read);
    if (refuse_features(read, &bag)) return;
    bag.a23 = keyword_scale(read, bag.a23, SCALE_AREA);
    if (bag.hconv < 0.0 && !keyword_real_id(read, &bag.hconv, SCALE_ID_FUNCTION, "HCONV", bag.card7)) return;
    if (bag.lcmt == 0)
        keyword_warning(read, bag.card3, "LCMT = 0 and no inflator on card 6: no gas flows into this bag");
    store_bag(read, &bag);
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
     .options = {"ID", "JETTING", "MULTIPLE_JETTING", "CM"},
     .cards = wang_cards,
     .card_count = sizeof wang_cards / sizeof *wang_cards,
     .read = read_wang_nefske,
     .remark =
         "Input is a mass flow (LCMT) or a tank pressure (LCMT with TVOL); the inflator of card 6 is refused. GC = 0 "
         "means 1. LCC23 < 0 names a curve over the pressure ratio; A23 < 0 (vent parts) is refused. OPT 1 to 8 "
         "switches CP23 and AP23 off; leakage through the fabric itself (FLC, FAC) is refused where it is not "
         "zero. HCONV < 0 names a curve over time. RBID < 0 is the built-in sensor, RBID > 0 the user's "
         "(--sensor-library); both shift LCMT, LCT and LCDT. "
         "LCJRV is over the angle in degrees, CA and BETA "
         "below 0 name curves over time; NODE1 and NODE2 place the jet in place of the coordinates. The option POP is "
         "refused."},
};

const KeywordFamily keyword_family_airbag = {"Airbags", specs, (int)(sizeof specs / sizeof *specs)};
