/* *ELEMENT_BEAM, *SECTION_BEAM, *MAT_CABLE_DISCRETE_BEAM. */
#include "io/keyword_table.h"

/* A beam's card: releases and orientation have no effect on what billow makes of it. */
typedef struct BeamCard {
    BeamDefinition beam;
    int release[4], local;
} BeamCard;

#define AT(member) offsetof(BeamCard, member)
static const FieldSpec beam_fields[] = {
    {"EID", 'I', 8, AT(beam.id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"PID", 'I', 8, AT(beam.part), 0.0, false, FIELD_USED, SCALE_ID_PART},
    {"N1", 'I', 8, AT(beam.node[0]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N2", 'I', 8, AT(beam.node[1]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N3", 'I', 8, AT(beam.node[2]), 0.0, false, FIELD_LISTED, SCALE_ID_NODE},
    {"RT1", 'I', 8, AT(release[0]), 0.0, false, FIELD_REFUSED, SCALE_NONE},
    {"RR1", 'I', 8, AT(release[1]), 0.0, false, FIELD_LISTED, SCALE_NONE},
    {"RT2", 'I', 8, AT(release[2]), 0.0, false, FIELD_REFUSED, SCALE_NONE},
    {"RR2", 'I', 8, AT(release[3]), 0.0, false, FIELD_LISTED, SCALE_NONE},
    {"LOCAL", 'I', 8, AT(local), 2.0, true, FIELD_LISTED, SCALE_NONE},
};
#undef AT
static const CardSpec beam_cards[] = {{"card 1", "one for each beam", CARD_FIELDS(beam_fields)}};

static void read_beam(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        BeamCard card = {0};
        if (keyword_card(read, 0, &card, true, &card.beam.source)) continue;
        if (!keyword_check_id(read, card.beam.id, "EID", card.beam.source)) continue;
        if (!keyword_check_id(read, card.beam.node[0], "N1", card.beam.source)) continue;
        if (!keyword_check_id(read, card.beam.node[1], "N2", card.beam.source)) continue;
        BeamDefinition *beam = KEYWORD_APPEND(read, read->definitions->beams);
        if (beam) *beam = card.beam;
    }
}

typedef struct SectionBeamCard {
    SectionBeamDefinition section;
    double shrf, qr, scoor, nsm, loc[2], moment[5], rampt, iner, resist[3];
    int naupd, cid;
} SectionBeamCard;

#define AT(member) offsetof(SectionBeamCard, member)
static const FieldSpec section_fields[] = {
    CARD_INT("SECID", section.id, USED, ID_OTHER), CARD_INT_OR("ELFORM", section.elform, 1, USED, NONE),
    CARD_REAL_OR("SHRF", shrf, 1.0, LISTED, NONE), CARD_REAL_OR("QR/IRID", qr, 2.0, LISTED, NONE),
    CARD_REAL("CST", section.cst, USED, NONE),     CARD_REAL("SCOOR", scoor, LISTED, NONE),
    CARD_REAL("NSM", nsm, REFUSED, NONE),          CARD_INT("NAUPD", naupd, LISTED, NONE),
};
static const FieldSpec thickness_fields[] = {
    CARD_REAL("TS1", section.ts[0], USED, LENGTH), CARD_REAL("TS2", section.ts[1], USED, LENGTH),
    CARD_REAL("TT1", section.tt[0], USED, LENGTH), CARD_REAL("TT2", section.tt[1], USED, LENGTH),
    CARD_REAL("NSLOC", loc[0], LISTED, NONE),      CARD_REAL("NTLOC", loc[1], LISTED, NONE),
};
static const FieldSpec area_fields[] = {
    CARD_REAL("A", section.a, USED, AREA),     CARD_REAL("ISS", moment[0], LISTED, NONE),
    CARD_REAL("ITT", moment[1], LISTED, NONE), CARD_REAL("J", moment[2], LISTED, NONE),
    CARD_REAL("SA", moment[3], LISTED, NONE),  CARD_REAL("IST", moment[4], LISTED, NONE),
};
static const FieldSpec truss_fields[] = {
    CARD_REAL("A", section.a, USED, AREA),
    CARD_REAL("RAMPT", rampt, REFUSED, TIME),
    CARD_REAL("STRESS", section.stress, REFUSED, PRESSURE),
};
static const FieldSpec discrete_beam_fields[] = {
    CARD_REAL("VOL", section.vol, USED, VOLUME),       CARD_REAL("INER", iner, LISTED, NONE),
    CARD_INT("CID", cid, LISTED, ID_DEFINE),           CARD_REAL("CA", section.ca, USED, AREA),
    CARD_REAL("OFFSET", section.offset, USED, LENGTH), CARD_REAL("RRCON", resist[0], LISTED, NONE),
    CARD_REAL("SRCON", resist[1], LISTED, NONE),       CARD_REAL("TRCON", resist[2], LISTED, NONE),
};
#undef AT

enum { SECTION_TITLE };
enum { SECTION_CARD, SECTION_THICKNESS, SECTION_AREA, SECTION_TRUSS, SECTION_DISCRETE_BEAM };
static const CardSpec section_beam_cards[] = {
    {"card 1", "one for each section", CARD_FIELDS(section_fields)},
    {"card 2", "for ELFORM 1, 9, 11", CARD_FIELDS(thickness_fields)},
    {"card 2", "for ELFORM 2, 12, 13", CARD_FIELDS(area_fields)},
    {"card 2", "for ELFORM 3", CARD_FIELDS(truss_fields)},
    {"card 2", "for ELFORM 6", CARD_FIELDS(discrete_beam_fields)},
};

/* The second card of an element formulation; 0 for those that are not known. */
static int second_card(int elform)
{
    switch (elform) {
    case 1:
    case 9:
    case 11:
        return SECTION_THICKNESS;
    case 2:
    case 12:
    case 13:
        return SECTION_AREA;
    case 3:
        return SECTION_TRUSS;
    case 6:
        return SECTION_DISCRETE_BEAM;
    default:
        return 0;
    }
}

static void read_section_beam(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        SectionBeamCard card = {0};
        SectionBeamDefinition *section = &card.section;
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, SECTION_TITLE, title);
        int status = keyword_card(read, SECTION_CARD, &card, true, &section->source),
            second = second_card(section->elform);
        if (status) return;
        if (second == 0) {
            keyword_error(
                read, section->source,
                "ELFORM = %d is none that billow knows; use 3 (truss), 6 (cable), or for rigid parts 1, 2, 9, "
                "11, 12, 13",
                section->elform);
            return;
        }
        if (keyword_card(read, second, &card, true, &section->card2)) status = -1;
        if (status || !keyword_check_id(read, section->id, "SECID", section->source)) continue;
        for (int i = 0; i < 2; i++) {
            double *pair = i == 0 ? section->ts : section->tt;
            if (pair[1] == 0.0) pair[1] = pair[0];
        }
        SectionBeamDefinition *record = KEYWORD_APPEND(read, read->definitions->beam_sections);
        if (record) *record = *section;
    }
}

typedef struct CableCard {
    MaterialDefinition material;
    int lcid, iread;
    double tmaxf0, tramp;
} CableCard;
#define AT(member) offsetof(CableCard, member)
static const FieldSpec cable_fields[] = {
    CARD_INT("MID", material.id, USED, ID_MATERIAL), CARD_REAL("RO", material.ro, USED, DENSITY),
    CARD_REAL("E", material.e, USED, NONE),          CARD_INT("LCID", lcid, REFUSED, ID_FUNCTION),
    CARD_REAL("F0", material.f0, USED, FORCE),       CARD_REAL("TMAXF0", tmaxf0, REFUSED, TIME),
    CARD_REAL("TRAMP", tramp, REFUSED, TIME),        CARD_INT("IREAD", iread, REFUSED, NONE),
};
#undef AT
static const CardSpec cable_cards[] = {{"card 1", "", CARD_FIELDS(cable_fields)}};

static void read_cable(KeywordRead *read)
{
    CableCard card = {.material = {.kind = MATERIAL_CABLE}};
    MaterialDefinition *material = &card.material;
    keyword_title(read, SECTION_TITLE, material->title);
    if (keyword_card(read, 0, &card, true, &material->source)) return;
    keyword_finish(read);
    if (!keyword_check_id(read, material->id, "MID", material->source)) return;
    material->e = keyword_scale(read, material->e, SCALE_PRESSURE);
    if (material->e < 0.0) material->e = keyword_scale(read, material->e, SCALE_LENGTH); /* force per length */
    MaterialDefinition *record = KEYWORD_APPEND(read, read->definitions->materials);
    if (record) *record = *material;
}

static const KeywordSpec specs[] = {
    {.name = "*ELEMENT_BEAM",
     .cards = beam_cards,
     .card_count = 1,
     .read = read_beam,
     .remark = "Cables (ELFORM 6), trusses (ELFORM 3) and beams of rigid parts. The options OFFSET, ORIENTATION, PID, "
               "SCALAR, SECTION, THICKNESS and others are refused."},
    {.name = "*SECTION_BEAM",
     .options = {"TITLE"},
     .cards = section_beam_cards,
     .card_count = 5,
     .read = read_section_beam,
     .remark =
         "ELFORM 3 with *MAT_ELASTIC, 6 with *MAT_CABLE_DISCRETE_BEAM; 1, 2, 9, 11, 12, 13 with *MAT_RIGID, whose "
         "mass they give."},
    {.name = "*MAT_CABLE_DISCRETE_BEAM",
     .aliases = {"*MAT_071", "*MAT_71"},
     .options = {"TITLE"},
     .cards = cable_cards,
     .card_count = 1,
     .read = read_cable,
     .remark =
         "Pulls only: F = max(F0 + K dL, 0), K = E CA/(L0 - OFFSET), or -E if E < 0; dL from L0 - OFFSET. A negative "
         "OFFSET is slack."},
};

const KeywordFamily keyword_family_links = {"Beams and cables", specs, (int)(sizeof specs / sizeof *specs)};
