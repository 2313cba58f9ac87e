/* *MAT_ORTHOTROPIC_ELASTIC and *MAT_FABRIC_MAP: membranes that are read into the card of a fabric. */
#include "io/keyword_table.h"

/* Fields that have a place in the deck only. */
typedef struct MapCard {
    MaterialDefinition material; /* first: fields of the fabric's card */
    double th, isrefg, cse, bulkc, jacc, dt, xp, yp, zp, d1, d2, d3, macf, ihis, ref;
    double ec, prca, prcb, gbc, gca, g, sigf;
    int fxx, fyy, srfac;
} MapCard;

#define AT(member) offsetof(MapCard, member)
static const FieldSpec elastic1_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_REAL("RO", material.ro, USED, DENSITY),
    CARD_REAL("EA", material.fabric.ea, USED, PRESSURE),
    CARD_REAL("EB", material.fabric.eb, USED, PRESSURE),
    CARD_REAL("EC", ec, LISTED, PRESSURE),
    CARD_REAL("PRBA", material.fabric.prba, USED, NONE),
    CARD_REAL("PRCA", prca, LISTED, NONE),
    CARD_REAL("PRCB", prcb, LISTED, NONE),
};
static const FieldSpec elastic2_fields[] = {
    CARD_REAL("GAB", material.fabric.gab, USED, PRESSURE),
    CARD_REAL("GBC", gbc, LISTED, PRESSURE),
    CARD_REAL("GCA", gca, LISTED, PRESSURE),
    CARD_REAL("AOPT", material.fabric.aopt, USED, NONE),
    CARD_REAL("G", g, REFUSED, PRESSURE),
    CARD_REAL("SIGF", sigf, REFUSED, PRESSURE),
};
static const FieldSpec elastic3_fields[] = {
    CARD_REAL("XP", xp, LISTED, LENGTH),
    CARD_REAL("YP", yp, LISTED, LENGTH),
    CARD_REAL("ZP", zp, LISTED, LENGTH),
    CARD_REAL("A1", material.fabric.a1, USED, NONE),
    CARD_REAL("A2", material.fabric.a2, USED, NONE),
    CARD_REAL("A3", material.fabric.a3, USED, NONE),
    CARD_REAL("MACF", macf, LISTED, NONE),
    CARD_REAL("IHIS", ihis, REFUSED, NONE),
};
static const FieldSpec elastic4_fields[] = {
    CARD_REAL("V1", material.fabric.v1, USED, NONE),
    CARD_REAL("V2", material.fabric.v2, USED, NONE),
    CARD_REAL("V3", material.fabric.v3, USED, NONE),
    CARD_REAL("D1", d1, LISTED, NONE),
    CARD_REAL("D2", d2, LISTED, NONE),
    CARD_REAL("D3", d3, LISTED, NONE),
    CARD_REAL("BETA", material.fabric.beta, USED, NONE),
    CARD_REAL("REF", ref, REFUSED, NONE),
};
static const FieldSpec map1_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL),
    CARD_REAL("RO", material.ro, USED, DENSITY),
    CARD_INT("PXX", material.fabric.lca, USED, ID_FUNCTION),
    CARD_INT("PYY", material.fabric.lcb, USED, ID_FUNCTION),
    CARD_INT("SXY", material.fabric.lcab, USED, ID_FUNCTION),
    CARD_REAL("DAMP", material.fabric.damp, USED, NONE),
    CARD_REAL("TH", th, USED, NONE),
};
static const FieldSpec map2_fields[] = {
    CARD_REAL("FVOPT", material.fabric.fvopt, USED, NONE), CARD_REAL("X0", material.fabric.x0, USED, NONE),
    CARD_REAL("X1", material.fabric.x1, USED, NONE),       CARD_REAL("FLC/X2", material.fabric.flc, USED, NONE),
    CARD_REAL("FAC/X3", material.fabric.fac, USED, NONE),
};
static const FieldSpec map3_fields[] = {
    CARD_REAL("ISREFG", isrefg, USED, NONE),     CARD_REAL("CSE", cse, USED, NONE),
    CARD_INT("SRFAC", srfac, USED, ID_FUNCTION), CARD_REAL("BULKC", bulkc, REFUSED, PRESSURE),
    CARD_REAL("JACC", jacc, LISTED, NONE),       CARD_INT("FXX", fxx, REFUSED, ID_FUNCTION),
    CARD_INT("FYY", fyy, REFUSED, ID_FUNCTION),  CARD_REAL("DT", dt, LISTED, TIME),
};
static const FieldSpec map4_fields[] = {
    CARD_REAL("AOPT", material.fabric.aopt, USED, NONE),
    CARD_REAL("ECOAT", material.fabric.ecoat, LISTED, PRESSURE),
    CARD_REAL("SCOAT", material.fabric.scoat, LISTED, PRESSURE),
    CARD_REAL("TCOAT", material.fabric.tcoat, LISTED, LENGTH),
};
static const FieldSpec map5_fields[] = {
    CARD_REAL("XP", xp, LISTED, LENGTH),
    CARD_REAL("YP", yp, LISTED, LENGTH),
    CARD_REAL("ZP", zp, LISTED, LENGTH),
    CARD_REAL("A1", material.fabric.a1, USED, NONE),
    CARD_REAL("A2", material.fabric.a2, USED, NONE),
    CARD_REAL("A3", material.fabric.a3, USED, NONE),
};
static const FieldSpec map6_fields[] = {
    CARD_REAL("V1", material.fabric.v1, USED, NONE),
    CARD_REAL("V2", material.fabric.v2, USED, NONE),
    CARD_REAL("V3", material.fabric.v3, USED, NONE),
    CARD_REAL("D1", d1, LISTED, NONE),
    CARD_REAL("D2", d2, LISTED, NONE),
    CARD_REAL("D3", d3, LISTED, NONE),
    CARD_REAL("BETA", material.fabric.beta, USED, NONE),
};
#undef AT

enum { ORTHOTROPIC_TITLE };
static const CardSpec elastic_cards[] = {
    {"card 1", "", CARD_FIELDS(elastic1_fields)},
    {"card 2", "", CARD_FIELDS(elastic2_fields)},
    {"card 3", "", CARD_FIELDS(elastic3_fields)},
    {"card 4", "", CARD_FIELDS(elastic4_fields)},
};
static const CardSpec map_cards[] = {
    {"card 1", "", CARD_FIELDS(map1_fields)}, {"card 2", "", CARD_FIELDS(map2_fields)},
    {"card 3", "", CARD_FIELDS(map3_fields)}, {"card 4", "", CARD_FIELDS(map4_fields)},
    {"card 5", "", CARD_FIELDS(map5_fields)}, {"card 6", "", CARD_FIELDS(map6_fields)},
};

/* All cards; the id of AOPT, the directions; 0, or -1 after an error. */
static int read_cards(KeywordRead *read, MapCard *card, int count)
{
    FabricCard *f = &card->material.fabric;
    keyword_title(read, ORTHOTROPIC_TITLE, card->material.title);
    int status = keyword_card(read, 0, card, true, &card->material.source);
    for (int i = 1; i < count; i++)
        if (keyword_card(read, i, card, status == 0, NULL)) status = -1;
    if (status) return -1;
    keyword_finish(read);
    if (!keyword_check_id(read, card->material.id, "MID", card->material.source)) return -1;
    if (f->aopt < 0.0 && !keyword_real_id(read, &f->aopt, SCALE_ID_DEFINE, "AOPT", card->material.source)) return -1;
    double a[3] = {f->a1, f->a2, f->a3}, v[3] = {f->v1, f->v2, f->v3};
    keyword_transform_vector(read, a);
    keyword_transform_vector(read, v);
    f->a1 = a[0], f->a2 = a[1], f->a3 = a[2];
    f->v1 = v[0], f->v2 = v[1], f->v3 = v[2];
    return 0;
}

static void store(KeywordRead *read, const MapCard *card)
{
    MaterialDefinition *material = KEYWORD_APPEND(read, read->definitions->materials);
    if (material) *material = card->material;
}

static void read_elastic(KeywordRead *read)
{
    MapCard card = {.material = {.kind = MATERIAL_ORTHOTROPIC, .keyword = "*MAT_ORTHOTROPIC_ELASTIC"}};
    if (read_cards(read, &card, 4)) return;
    card.material.fabric.form = 2;
    store(read, &card);
}

static void read_map(KeywordRead *read)
{
    MapCard card = {.material = {.kind = MATERIAL_FABRIC, .keyword = "*MAT_FABRIC_MAP"}};
    FabricCard *f = &card.material.fabric;
    if (read_cards(read, &card, 6)) return;
    if (card.th > 0.0) {
        keyword_error(read, card.material.source,
                      "TH = %g asks for a table of hysteresis, which billow does not have; give minus a constant share",
                      card.th);
        return;
    }
    if (!keyword_check_leakage(read, &f->flc, &f->fac, &f->ela, f->fvopt, f->x0, f->x1, card.material.source)) return;
    f->form = 24;
    f->is_map = true;
    f->cse = card.cse;
    f->isrefg = card.isrefg;
    f->tsrfac = card.srfac; /* a curve over time, as TSRFAC >= 1 */
    f->h = -card.th;
    store(read, &card);
}

static const KeywordSpec specs[] = {
    {.name = "*MAT_ORTHOTROPIC_ELASTIC",
     .aliases = {"*MAT_002", "*MAT_2"},
     .options = {"TITLE"},
     .cards = elastic_cards,
     .card_count = 4,
     .read = read_elastic,
     .remark = "Membranes only: Green strain and second Piola-Kirchhoff stress in the plane. AOPT 0, 2, 3 and minus a "
               "coordinate system. What acts across the thickness has no effect."
               " REF belongs to *INITIAL_FOAM_REFERENCE_GEOMETRY and is refused."},
    {.name = "*MAT_FABRIC_MAP",
     .aliases = {"*MAT_034M", "*MAT_34M"},
     .options = {"TITLE"},
     .cards = map_cards,
     .card_count = 6,
     .read = read_map,
     .remark =
         "PXX and PYY as curves, engineering stress over engineering strain of one fibre; tables over both strains are "
         "refused. SXY is a curve over the tensor component of Green's strain. -TH is the share of energy that a cycle "
         "dissipates. ISREFG = 1 keeps the initial tension of a reference geometry, SRFAC brings it back as TSRFAC >= "
         "1 of "
         "*MAT_FABRIC does. Fabric compaction (BULKC) and strain rates (FXX, FYY) are refused; ECOAT, SCOAT and TCOAT "
         "give bending, which a membrane has not."},
};

const KeywordFamily keyword_family_orthotropic = {"Orthotropic membranes", specs, (int)(sizeof specs / sizeof *specs)};
