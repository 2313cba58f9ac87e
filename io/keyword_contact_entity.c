/* *CONTACT_ENTITY: a smooth shape that goes with a rigid part, met by nodes. */
#include "io/keyword_table.h"

/* The card as it is read; what billow does not use goes to unused. */
typedef struct EntityCard {
    EntityDefinition entity;
    UnusedCard unused;
} EntityCard;

#define AT(member) offsetof(EntityCard, entity.member)
static const FieldSpec card1_fields[] = {
    CARD_INT("PID", pid, USED, ID_PART),     CARD_INT_OR("GEOTYP", geotyp, 1, USED, NONE),
    CARD_INT("SSID", ssid, USED, NONE),      CARD_INT("SSTYP", sstyp, USED, NONE),
    CARD_REAL_OR("SF", sf, 1.0, USED, NONE), CARD_REAL("DF", df, USED, NONE),
    CARD_REAL("CF", cf, USED, NONE),         CARD_INT("INTORD", intord, USED, NONE),
};
#define ENTITY_UNUSED_INT(name, k)                                                                                     \
    {                                                                                                                  \
        name, 'I', 10, offsetof(EntityCard, unused.i[k]), 0, true, FIELD_LISTED, SCALE_NONE                            \
    }
static const FieldSpec card2_fields[] = {
    CARD_REAL("BT", birth, USED, TIME), CARD_REAL_OR("DT", death, 1e20, USED, TIME), CARD_INT("SO", so, USED, NONE),
    ENTITY_UNUSED_INT("GO", 0),         CARD_INT("ITHK", ithk, USED, NONE),          ENTITY_UNUSED_INT("SPR", 1),
};
static const FieldSpec card3_fields[] = {
    CARD_REAL("XC", centre[0], USED, LENGTH), CARD_REAL("YC", centre[1], USED, LENGTH),
    CARD_REAL("ZC", centre[2], USED, LENGTH), CARD_REAL("AX", a[0], USED, NONE),
    CARD_REAL("AY", a[1], USED, NONE),        CARD_REAL("AZ", a[2], USED, NONE),
};
static const FieldSpec card4_fields[] = {
    CARD_REAL("BX", b[0], USED, NONE),
    CARD_REAL("BY", b[1], USED, NONE),
    CARD_REAL("BZ", b[2], USED, NONE),
};
static const FieldSpec card5_fields[] = {
    CARD_INT("INOUT", inout, USED, NONE), CARD_REAL("G1", g[0], USED, NONE), CARD_REAL("G2", g[1], USED, NONE),
    CARD_REAL("G3", g[2], USED, NONE),    CARD_REAL("G4", g[3], USED, NONE), CARD_REAL("G5", g[4], USED, NONE),
    CARD_REAL("G6", g[5], USED, NONE),    CARD_REAL("G7", g[6], USED, NONE),
};
#undef AT
static const CardSpec entity_cards[] = {
    {"card 1", "", CARD_FIELDS(card1_fields)}, {"card 2", "", CARD_FIELDS(card2_fields)},
    {"card 3", "", CARD_FIELDS(card3_fields)}, {"card 4", "", CARD_FIELDS(card4_fields)},
    {"card 5", "", CARD_FIELDS(card5_fields)},
};

/* What the coefficients of each shape are: L a length, N a number, C the id of a curve, blank nothing. The rest is for
 * the mesh or the thickness that LS-DYNA makes of the shape. */
static const char *coefficients_of(int geotyp)
{
    static const char *const coefficients[] = {[1] = "LLLNNN ", [2] = "LLLL   ", [3] = "LLLNNNL",  [4] = "LLLLLLN",
                                               [5] = "LLLLL  ", [9] = "       ", [10] = "LL     ", [11] = "C      "};
    const int known = (int)(sizeof coefficients / sizeof *coefficients);
    return geotyp >= 1 && geotyp < known ? coefficients[geotyp] : NULL;
}

#define SHAPES                                                                                                         \
    "use 1 (plane), 2 (sphere), 3 (infinite cylinder), 4 (ellipsoid), 5 (torus), 9 (convex mesh of the part), 10 "     \
    "(finite plane) or 11 (body of revolution by a curve)"

/* The shapes of LS-DYNA that are not there. */
static bool check_shape(const KeywordRead *read, const EntityDefinition *e)
{
    static const char *const others[] = {"CAL3D or MADYMO plane", "CAL3D or MADYMO ellipsoid", "VDA surface"};
    if (coefficients_of(e->geotyp)) return true;
    if (e->geotyp >= 6 && e->geotyp <= 8)
        keyword_error(read, e->card1, "GEOTYP = %d (%s) is not there in billow " BILLOW_VERSION "; " SHAPES, e->geotyp,
                      others[e->geotyp - 6]);
    else
        keyword_error(read, e->card1, "GEOTYP = %d is no shape; " SHAPES, e->geotyp);
    return false;
}

/* Coefficients by the include's factors and offsets; those without effect are listed. */
static bool take_coefficients(KeywordRead *read, EntityDefinition *e)
{
    const char *kinds = coefficients_of(e->geotyp);
    if (e->geotyp == 11 && !keyword_real_id(read, &e->g[0], SCALE_ID_FUNCTION, "G1", e->card5)) return false;
    if (e->geotyp == 11 && !(e->g[0] > 0.0)) {
        keyword_error(
            read, e->card5,
            "G1 = %g: with GEOTYP = 11 name the *DEFINE_CURVE of the profile, the radius over the place on the "
            "third axis",
            e->g[0]);
        return false;
    }
    for (int k = 0; k < 7; k++) {
        if (kinds[k] == 'L') e->g[k] = keyword_scale(read, e->g[k], SCALE_LENGTH);
        if (kinds[k] == ' ' && e->g[k] != 0.0)
            keyword_note(read, e->card5, "G%d = %g is read but not used with GEOTYP = %d", k + 1, e->g[k], e->geotyp);
    }
    return true;
}

static bool check_options(const KeywordRead *read, const EntityDefinition *e)
{
    const int errors = read->cards->diagnostics->errors;
    if (e->sstyp < 0 || e->sstyp > 2)
        keyword_error(read, e->card1, "SSTYP = %d: use 0 (node set), 1 (part) or 2 (part set)", e->sstyp);
    if (!(e->sf > 0.0 && e->sf <= 10.0))
        keyword_error(read, e->card1, "SF = %g must lie between 0 and 10: it scales a penalty that is stable by itself",
                      e->sf);
    if (!(e->df >= 0.0 && e->df <= 200.0))
        keyword_error(read, e->card1,
                      "DF = %g: give viscous damping in percent of critical, 0 to 200; a curve of it (DF < 0) is not "
                      "read by billow " BILLOW_VERSION,
                      e->df);
    if (!(e->cf >= 0.0)) keyword_error(read, e->card1, "CF = %g: a coefficient of friction is not negative", e->cf);
    if (e->intord < 0 || e->intord > 5)
        keyword_error(read, e->card1, "INTORD = %d: use 0 (nodes only) to 5 (5 x 5 points in each segment)", e->intord);
    if (e->intord > 0 && e->sstyp == 0)
        keyword_error(read, e->card1,
                      "INTORD = %d needs segments, but SSTYP = 0 names nodes: use SSTYP = 1 or 2, or INTORD = 0",
                      e->intord);
    if (e->so < 0)
        keyword_error(read, e->card2,
                      "SO = %d: a curve of force over penetration is not read by billow " BILLOW_VERSION "; use 0 or 1",
                      e->so);
    if (e->inout != 0 && e->inout != 1)
        keyword_error(read, e->card5, "INOUT = %d: use 0 (nodes outside the shape) or 1 (inside)", e->inout);
    return read->cards->diagnostics->errors == errors;
}

/* The local system by the include's transformation. */
static void transform(const KeywordRead *read, EntityDefinition *e)
{
    bool bare = true;
    for (int k = 0; k < 3; k++) bare = bare && e->a[k] == 0.0 && e->b[k] == 0.0;
    if (bare) e->a[0] = e->b[1] = 1.0;
    e->ssid = (int)keyword_scale(read, e->ssid, e->sstyp == 1 ? SCALE_ID_PART : SCALE_ID_SET);
    keyword_transform_point(read, e->centre);
    keyword_transform_vector(read, e->a);
    keyword_transform_vector(read, e->b);
}

static void read_entity(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        EntityCard card = {.entity.source = read->cards->block->source};
        EntityDefinition *e = &card.entity;
        int status = keyword_card(read, 0, &card, true, &e->card1);
        if (keyword_card(read, 1, &card, status == 0, &e->card2)) status = -1;
        if (keyword_card(read, 2, &card, status == 0, &e->card3)) status = -1;
        if (keyword_card(read, 3, &card, status == 0, &e->card4)) status = -1;
        if (keyword_card(read, 4, &card, status == 0, &e->card5)) status = -1;
        if (status) continue;
        bool good = check_shape(read, e);
        good = check_options(read, e) && good;
        good = keyword_check_id(read, e->pid, "PID", e->card1) && good;
        good = keyword_check_id(read, e->ssid, "SSID", e->card1) && good;
        if (!good || !take_coefficients(read, e)) continue;
        transform(read, e);
        keyword_check_times(read, "entity", "BT", e->birth, "DT", e->death, e->card2);
        EntityDefinition *entity = KEYWORD_APPEND(read, read->definitions->entities);
        if (entity) *entity = *e;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*CONTACT_ENTITY",
     .cards = entity_cards,
     .card_count = 5,
     .read = read_entity,
     .remark =
         "A shape that moves with the rigid part PID; nodes of SSID meet its exact surface. It is given in a local "
         "system "
         "x, y, z with its origin at XC, YC, ZC, x along A and y in the plane of A and B (blank: the global "
         "directions). "
         "GEOTYP 1, plane: point G1 to G3, normal G4 to G6. 2, sphere: centre G1 to G3, radius G4. 3, infinite "
         "cylinder: "
         "point G1 to G3, axis G4 to G6, radius G7. 4, ellipsoid: centre G1 to G3, half axes G4 to G6, order G7 = 2 "
         "(or "
         "blank). 5, torus about z: centre G1 to G3, radius G4 from the axis to the middle of the tube, radius G5 of "
         "the "
         "tube, not above G4. 9: the part's own shells or solids, a closed convex surface. 10, finite plane: sides G1 "
         "along x and G2 along y, the origin in its middle, nodes on the side to which z points. 11, body of "
         "revolution "
         "about z: G1 is a *DEFINE_CURVE of the radius over z, joined by straight lines; DATTYP = 1 allows several "
         "radii "
         "at one z, for flat ends and undercuts, and rings; an end whose radius is not 0 is open. GEOTYP 6 to 8 are "
         "refused. Finite planes and open profiles hold only nodes that come through them. INTORD = n: n x n points "
         "within each segment as well. ITHK = 1: half the shells' thickness stays clear, for all shapes and SSTYP. SO "
         "0 "
         "and 1 are one stable penalty, scaled by SF. Nodes that start inside push only when they come deeper. Each "
         "*CONTACT_ENTITY is a contact of its own, also on the same part: a node inside of two shapes is pushed by "
         "both, "
         "by each along the shortest way out of it, and a seam is that much stiffer. A body of revolution by its whole "
         "outline has no seams. Forces: *DATABASE_GCEOUT. Numbered in deck order."},
};

const KeywordFamily keyword_family_contact_entity = {"Smooth rigid shapes", specs, (int)(sizeof specs / sizeof *specs)};
