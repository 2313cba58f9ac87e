/* Airbags whose pressure follows a law of volume and time: *AIRBAG_SIMPLE_PRESSURE_VOLUME, *AIRBAG_ADIABATIC_GAS_MODEL,
 * *AIRBAG_LOAD_CURVE and *AIRBAG_LINEAR_FLUID. */
#include "io/keyword_airbag.h"

#define AT(member) offsetof(AirbagDefinition, member)
static const FieldSpec volume3_fields[] = {
    CARD_REAL("CN", cn, USED, NONE),
    CARD_REAL("BETA", beta, USED, NONE),
    CARD_INT("LCID", lcid, USED, ID_FUNCTION),
    CARD_INT("LCIDDR", lciddr, USED, ID_FUNCTION),
};
static const FieldSpec adiabatic3_fields[] = {
    CARD_REAL_OR("PSF", psf, 1.0, USED, NONE), CARD_INT("LCID", lcid, USED, ID_FUNCTION),
    CARD_REAL("GAMMA", gamma, USED, NONE),     CARD_REAL("P0", p0, USED, PRESSURE),
    CARD_REAL("PE", pe, USED, PRESSURE),       CARD_REAL("R0", ro, USED, DENSITY),
};
static const FieldSpec curve3_fields[] = {
    CARD_REAL("STIME", stime, USED, TIME),  CARD_INT("LCID", lcid, USED, ID_FUNCTION),
    CARD_REAL("R0", ro, USED, DENSITY),     CARD_REAL("PE", pe, USED, PRESSURE),
    CARD_REAL("P0", p0, USED, PRESSURE),    CARD_REAL("T", t, USED, TEMPERATURE),
    CARD_REAL("T0", t0, USED, TEMPERATURE),
};
static const FieldSpec fluid3_fields[] = {
    CARD_REAL("BULK", bulk, USED, PRESSURE),       CARD_REAL("RO", ro, USED, DENSITY),
    CARD_INT("LCINT", lcint, USED, ID_FUNCTION),   CARD_INT("LCOUTT", lcoutt, USED, ID_FUNCTION),
    CARD_INT("LCOUTP", lcoutp, USED, ID_FUNCTION), CARD_INT("LCFIT", lcfit, USED, ID_FUNCTION),
    CARD_INT("LCBULK", lcbulk, USED, ID_FUNCTION), CARD_INT("LCID", lcid, USED, ID_FUNCTION),
};
static const FieldSpec fluid4_fields[] = {
    CARD_REAL("P_LIMIT", p_limit, USED, PRESSURE),
    CARD_INT("P_LIMLC", p_limlc, USED, ID_FUNCTION),
    CARD_INT("NONULL", nonull, USED, NONE),
};
static const FieldSpec level3_fields[] = {
    CARD_REAL("XWINI", xwini, USED, LENGTH),   CARD_REAL("XWADD", xwadd, USED, LENGTH),
    CARD_REAL("XW", xw, USED, LENGTH),         CARD_REAL("P", p, USED, PRESSURE),
    CARD_REAL("TEND", tend, USED, TIME),       CARD_REAL("RHO", ro, USED, DENSITY),
    CARD_INT("LCXW", lcxw, USED, ID_FUNCTION), CARD_INT("LCP", lcp, USED, ID_FUNCTION),
};
static const FieldSpec level4_fields[] = {
    CARD_REAL("GDIR", gdir, USED, NONE),           CARD_INT_OR("NPROJ", nproj, 3, LISTED, NONE),
    CARD_INT("IDIR", idir, LISTED, NONE),          CARD_INT("IIDIR", iidir, LISTED, NONE),
    CARD_REAL_OR("KAPPA", kappa, 1.0, USED, NONE), CARD_REAL("KBM", kbm, USED, PRESSURE),
};
#undef AT

static const CardSpec level_cards[] = {
    AIRBAG_CARDS, {"card 3", "", CARD_FIELDS(level3_fields)}, {"card 4", "", CARD_FIELDS(level4_fields)}};
static const CardSpec volume_cards[] = {AIRBAG_CARDS, {"card 3", "", CARD_FIELDS(volume3_fields)}};
static const CardSpec adiabatic_cards[] = {AIRBAG_CARDS, {"card 3", "", CARD_FIELDS(adiabatic3_fields)}};
static const CardSpec curve_cards[] = {AIRBAG_CARDS, {"card 3", "", CARD_FIELDS(curve3_fields)}};
static const CardSpec fluid_cards[] = {AIRBAG_CARDS,
                                       {"card 3", "", CARD_FIELDS(fluid3_fields)},
                                       {"card 4", "may be left out", CARD_FIELDS(fluid4_fields)}};

static void read_pressure_volume(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_PRESSURE_VOLUME};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, AIRBAG_CARD_MODEL, &bag, true, &bag.card3)) return;
    keyword_finish(read);
    if (bag.cn < 0.0 && !keyword_real_id(read, &bag.cn, SCALE_ID_FUNCTION, "CN", bag.card3)) return;
    if (bag.cn > 0.0) bag.cn = keyword_scale(read, bag.cn, SCALE_PRESSURE);
    if (bag.lcid == 0 && (bag.cn == 0.0 || bag.beta == 0.0))
        keyword_warning(read, bag.card3, "%s is 0 and there is no LCID: the bag has no pressure",
                        bag.cn == 0.0 ? "CN" : "BETA");
    airbag_store(read, &bag);
}

static void read_adiabatic(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_ADIABATIC};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, AIRBAG_CARD_MODEL, &bag, true, &bag.card3)) return;
    keyword_finish(read);
    airbag_store(read, &bag);
}

static void read_load_curve(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_LOAD_CURVE};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, AIRBAG_CARD_MODEL, &bag, true, &bag.card3)) return;
    keyword_finish(read);
    airbag_store(read, &bag);
}

static void read_linear_fluid(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_LINEAR_FLUID};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, AIRBAG_CARD_MODEL, &bag, true, &bag.card3)) return;
    bag.card4 = bag.card3;
    if (card_left(read->cards) && keyword_card(read, AIRBAG_CARD_MODEL + 1, &bag, true, &bag.card4)) return;
    keyword_finish(read);
    airbag_store(read, &bag);
}

static void read_fluid_and_gas(KeywordRead *read)
{
    AirbagDefinition bag = {.model = AIRBAG_FLUID_AND_GAS};
    if (airbag_read_core(read, &bag)) return;
    if (keyword_card(read, AIRBAG_CARD_MODEL, &bag, true, &bag.card3)) return;
    if (keyword_card(read, AIRBAG_CARD_MODEL + 1, &bag, true, &bag.card4)) return;
    keyword_finish(read);
    const double axis = bag.gdir < 0.0 ? -bag.gdir : bag.gdir;
    if (axis != 1.0 && axis != 2.0 && axis != 3.0) {
        keyword_error(read, bag.card4, "GDIR is %g, but must be 1, 2 or 3, or -1, -2 or -3", bag.gdir);
        return;
    }
    if (bag.lcxw == 0 && bag.xwadd != 0.0 && (bag.xw - bag.xwini) * bag.xwadd < 0.0) {
        keyword_error(read, bag.card3, "XWADD = %g leads from XWINI = %g away from XW = %g", bag.xwadd, bag.xwini,
                      bag.xw);
        return;
    }
    airbag_store(read, &bag);
}

static const KeywordSpec specs[] = {
    {.name = "*AIRBAG_SIMPLE_PRESSURE_VOLUME",
     .options = {"ID"},
     .cards = volume_cards,
     .card_count = sizeof volume_cards / sizeof *volume_cards,
     .read = read_pressure_volume,
     .remark =
         "Pressure BETA CN/(V/V0), or LCID over V/V0. CN < 0 names a curve over time. LCIDDR gives CN over "
         "time in dynamic relaxation. The pressure acts as it is; there is none outside. With RBID the bag begins "
         "when the sensor fires: no pressure before, then V0 is the volume and time counts from there."},
    {.name = "*AIRBAG_ADIABATIC_GAS_MODEL",
     .options = {"ID"},
     .cards = adiabatic_cards,
     .card_count = sizeof adiabatic_cards / sizeof *adiabatic_cards,
     .read = read_adiabatic,
     .remark = "While LCID is zero the walls feel PSF P0; from its first value that is not zero the gas is closed. "
               "Then its mass is R0 times the volume at that time. With RBID the bag begins when the sensor fires."},
    {.name = "*AIRBAG_LOAD_CURVE",
     .options = {"ID"},
     .cards = curve_cards,
     .card_count = sizeof curve_cards / sizeof *curve_cards,
     .read = read_load_curve,
     .remark = "LCID is read at the time since STIME. With LCID = 0 the pressure is C rho (T - T0) with C from R0, P0, "
               "PE and T at the start, less PE. With RBID the bag begins, and time counts, when the sensor fires."},
    {.name = "*AIRBAG_LINEAR_FLUID",
     .options = {"ID"},
     .cards = fluid_cards,
     .card_count = sizeof fluid_cards / sizeof *fluid_cards,
     .read = read_linear_fluid,
     .remark = "NONULL other than 0 keeps the pressure off parts of *MAT_NULL, which still bound the volume. LCOUTP "
               "is read at the pressure that acts. Flows by LCINT, LCOUTT and LCOUTP are given positive. With RBID "
               "the bag begins, and time counts, when the sensor fires: its mass is then RO times the volume."},
    {.name = "*AIRBAG_FLUID_AND_GAS",
     .options = {"ID"},
     .cards = level_cards,
     .card_count = sizeof level_cards / sizeof *level_cards,
     .read = read_fluid_and_gas,
     .remark =
         "XWINI, XW and LCXW are coordinates on the axis |GDIR|. Gravity is that of *LOAD_BODY on this axis. NPROJ, "
         "IDIR and IIDIR have no say: the volumes are exact, holes are capped. KBM counts when the fluid fills the "
         "bag. With RBID the bag begins, and time counts, when the sensor fires."},
};

const KeywordFamily keyword_family_airbag_laws = {"Airbags by a law of pressure", specs,
                                                  (int)(sizeof specs / sizeof *specs)};
