/* *MAT_ADD_AIRBAG_POROSITY_LEAKAGE, and the fields of leakage that it shares with *MAT_FABRIC. */
#include "io/keyword_table.h"

#define AT(member) offsetof(PorosityDefinition, member)
static const FieldSpec fields[] = {
    CARD_INT("MID", mid, USED, ID_MATERIAL),
    CARD_REAL("FLC/X2", flc, USED, NONE),
    CARD_REAL_OR("FAC/X3", fac, 1.0, USED, NONE),
    CARD_REAL("ELA", ela, USED, NONE),
    CARD_REAL("FVOPT", fvopt, USED, NONE),
    CARD_REAL("X0", x0, USED, NONE),
    CARD_REAL("X1", x1, USED, NONE),
};
#undef AT

bool keyword_check_leakage(const KeywordRead *read, double *flc, double *fac, double *ela, double fvopt, double x0,
                           double x1, Source source)
{
    if (fvopt < 0.0 || fvopt > 8.0 || fvopt != (int)fvopt) {
        keyword_error(read, source, "FVOPT is %g, but must be 0 to 8", fvopt);
        return false;
    }
    const bool curves = (x0 == 0.0 && x1 == 0.0) || x0 == 1.0; /* else FLC and FAC are X2 and X3 */
    if (curves && *flc < 0.0 && !keyword_real_id(read, flc, SCALE_ID_FUNCTION, "FLC", source)) return false;
    if (curves && *fac < 0.0 && !keyword_real_id(read, fac, SCALE_ID_FUNCTION, "FAC", source)) return false;
    return *ela >= 0.0 || keyword_real_id(read, ela, SCALE_ID_FUNCTION, "ELA", source);
}

static const CardSpec cards[] = {{"card 1", "one for each material", CARD_FIELDS(fields)}};

static void read_porosity(KeywordRead *read)
{
    do {
        PorosityDefinition card = {0};
        if (keyword_card(read, 0, &card, true, &card.source)) return;
        if (!keyword_check_id(read, card.mid, "MID", card.source)) return;
        if (!keyword_check_leakage(read, &card.flc, &card.fac, &card.ela, card.fvopt, card.x0, card.x1, card.source))
            return;
        PorosityDefinition *item = KEYWORD_APPEND(read, read->definitions->porosities);
        if (item) *item = card;
    } while (keyword_more(read) && !read->out_of_memory);
}

static const KeywordSpec specs[] = {
    {.name = "*MAT_ADD_AIRBAG_POROSITY_LEAKAGE",
     .cards = cards,
     .card_count = 1,
     .read = read_porosity,
     .remark =
         "Leakage of any material, in place of that of *MAT_FABRIC. The fields are those of *MAT_FABRIC, FLC and FAC "
         "are X2 and X3 where X0 is neither 0 nor 1."},
};

const KeywordFamily keyword_family_porosity = {"Leakage of materials", specs, (int)(sizeof specs / sizeof *specs)};
