/* *DEFINE_CURVE. */
#include <string.h>

#include "io/keyword_table.h"
#include "solver/memory.h"

#define AT(member) offsetof(CurveDefinition, member)
static const FieldSpec head_fields[] = {
    CARD_INT("LCID", id, USED, ID_FUNCTION),   CARD_INT("SIDR", sidr, USED, NONE),
    CARD_REAL_OR("SFA", sfa, 1.0, USED, NONE), CARD_REAL_OR("SFO", sfo, 1.0, USED, NONE),
    CARD_REAL("OFFA", offa, USED, NONE),       CARD_REAL("OFFO", offo, USED, NONE),
    CARD_INT("DATTYP", dattyp, USED, NONE),    CARD_INT("LCINT", lcint, LISTED, NONE),
};
#undef AT

typedef struct PointCard {
    double a, o;
} PointCard;

#define AT(member) offsetof(PointCard, member)
static const FieldSpec point_fields[] = {
    {"A1", 'F', 20, AT(a), 0.0, false, FIELD_USED, SCALE_NONE},
    {"O1", 'F', 20, AT(o), 0.0, false, FIELD_USED, SCALE_NONE},
};
#undef AT

enum { CURVE_TITLE };
static const CardSpec cards[] = {
    {"card 1", "", CARD_FIELDS(head_fields)},
    {"card 2", "one for each point", CARD_FIELDS(point_fields)},
};

static int read_points(KeywordRead *read, CurveDefinition *curve)
{
    int status = 0;
    while (keyword_more(read)) {
        PointCard card;
        Source source;
        if (keyword_card(read, 1, &card, true, &source)) {
            status = -1;
            continue;
        }
        double *x = KEYWORD_APPEND(read, curve->x), *y = KEYWORD_APPEND(read, curve->y);
        int *line = KEYWORD_APPEND(read, curve->lines);
        if (!x || !y || !line) return -1;
        *x = card.a;
        *y = card.o;
        *line = source.line;
    }
    return status;
}

/* Abscissae must rise; a point that repeats its predecessor altogether is dropped. Reports the first fault only; the
 * curve is kept without the points at fault, so that the rest of the deck can be checked. */
static int check_points(KeywordRead *read, CurveDefinition *curve)
{
    size_t kept = 0;
    bool told = false;
    if (curve->x.count == 0) {
        keyword_error(read, curve->source, "curve %d has no points; write them on the lines after this one", curve->id);
        return -1;
    }
    for (size_t i = 0; i < curve->x.count; i++) {
        const double x = curve->x.items[i], y = curve->y.items[i];
        if (kept > 0 && x == curve->x.items[kept - 1] && y == curve->y.items[kept - 1]) continue;
        if (kept > 0 && x <= curve->x.items[kept - 1]) {
            const Source source = {curve->source.file, curve->lines.items[i]};
            const bool equal = x == curve->x.items[kept - 1];
            if (!told)
                keyword_error(read, source, "curve %d: the abscissa %g %s %g before it; %s", curve->id, x,
                              equal ? "repeats the" : "is less than the", curve->x.items[kept - 1],
                              equal ? "give a jump a small width" : "the points must be in rising order");
            told = read->kept = true;
            continue;
        }
        curve->x.items[kept] = x;
        curve->y.items[kept] = y;
        curve->lines.items[kept++] = curve->lines.items[i];
    }
    curve->x.count = curve->y.count = curve->lines.count = kept;
    return 0;
}

static bool rises(const CurveDefinition *curve)
{
    for (size_t i = 1; i < curve->x.count; i++)
        if (curve->x.items[i] <= curve->x.items[i - 1]) return false;
    return true;
}

/* Whether the include's unit factors could have to act on a curve, which does not know its own units. */
static bool units_change(const KeywordRead *read)
{
    const IncludeTransform *transform = read->cards->block->transform;
    return transform && (transform->fctmas != 1.0 || transform->fcttim != 1.0 || transform->fctlen != 1.0 ||
                         transform->fcttem != 1.0 || transform->temperature_offset != 0.0);
}

static void free_points(CurveDefinition *curve)
{
    memory_free(curve->x.items);
    memory_free(curve->y.items);
    memory_free(curve->lines.items);
}

static void read_curve(KeywordRead *read)
{
    CurveDefinition card = {0};
    keyword_title(read, CURVE_TITLE, card.title);
    int status = keyword_card(read, 0, &card, true, &card.source);
    if (status == 0 && !keyword_check_id(read, card.id, "LCID", card.source)) status = -1;
    if (status == 0) status = read_points(read, &card);
    if (status == 0 && card.sfa < 0.0) {
        keyword_error(read, card.source, "SFA is %g; write the abscissae in rising order with a positive factor",
                      card.sfa);
        status = -1;
    }
    const bool outline = status == 0 && card.dattyp == 1 && !rises(&card);
    if (status == 0 && !outline) status = check_points(read, &card);
    CurveDefinition *curve = NULL;
    if (status == 0 && outline) curve = KEYWORD_APPEND(read, read->definitions->outlines);
    if (status == 0 && !outline) curve = KEYWORD_APPEND(read, read->definitions->curves);
    if (!curve) {
        free_points(&card);
        return;
    }
    *curve = card;
    if (units_change(read))
        keyword_warning(read, card.source,
                        "curve %d is not converted by *INCLUDE_TRANSFORM's unit factors; set SFA and SFO "
                        "for the units of the main deck",
                        card.id);
}

static const KeywordSpec specs[] = {
    {.name = "*DEFINE_CURVE",
     .options = {"TITLE"},
     .cards = cards,
     .card_count = 2,
     .read = read_curve,
     .remark =
         "Points stand in columns of 20. The value is SFO (O1 + OFFO) at SFA (A1 + OFFA), constant beyond the ends. "
         "Abscissae that do not rise are an error unless DATTYP = 1; then only a profile of *CONTACT_ENTITY can use "
         "the "
         "curve. Unit factors of *INCLUDE_TRANSFORM do not act on "
         "curves, which is warned of."},
};

const KeywordFamily keyword_family_curves = {"Curves", specs, (int)(sizeof specs / sizeof *specs)};
