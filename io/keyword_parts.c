/* *PART, *SECTION_SHELL, *HOURGLASS. */
#include "io/keyword_table.h"

#define AT(member) offsetof(PartDefinition, member)
static const FieldSpec part_heading_fields[] = {CARD_TEXT("HEADING", title, 70, USED)};
static const FieldSpec part_fields[] = {
    CARD_INT("PID", id, USED, ID_PART),           CARD_INT("SECID", section, USED, ID_OTHER),
    CARD_INT("MID", material, USED, ID_MATERIAL), CARD_INT("EOSID", eosid, LISTED, ID_MATERIAL),
    CARD_INT("HGID", hourglass, USED, ID_OTHER),  CARD_INT("GRAV", grav, LISTED, NONE),
    CARD_INT("ADPOPT", adpopt, LISTED, NONE),     CARD_INT("TMID", tmid, LISTED, ID_MATERIAL),
};
#undef AT

static const CardSpec part_cards[] = {
    {"heading", "one for each part", CARD_FIELDS(part_heading_fields)},
    {"card 1", "one for each part", CARD_FIELDS(part_fields)},
    KEYWORD_INERTIA_CARDS,
};
enum { PART_INERTIA };

static void read_part(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        PartDefinition card = {0};
        card_text(read->cards, card.title, sizeof card.title);
        int status = keyword_card(read, 1, &card, true, &card.source);
        card.has_inertia = keyword_option(read, PART_INERTIA);
        if (card.has_inertia && keyword_read_inertia(read, &card.inertia)) status = -1;
        if (status || !keyword_check_id(read, card.id, "PID", card.source)) continue;
        PartDefinition *part = KEYWORD_APPEND(read, read->definitions->parts);
        if (!part) return;
        *part = card;
    }
}

#define AT(member) offsetof(SectionShellDefinition, member)
static const FieldSpec section_fields[] = {
    CARD_INT("SECID", id, USED, ID_OTHER),         CARD_INT_OR("ELFORM", elform, 2, USED, NONE),
    CARD_REAL_OR("SHRF", shrf, 1.0, LISTED, NONE), CARD_REAL_OR("NIP", nip, 2.0, LISTED, NONE),
    CARD_INT_OR("PROPT", propt, 1, LISTED, NONE),  CARD_INT("QR/IRID", qr_irid, LISTED, NONE),
    CARD_INT("ICOMP", icomp, USED, NONE),          CARD_INT_OR("SETYP", setyp, 1, LISTED, NONE),
};
static const FieldSpec section_thickness_fields[] = {
    CARD_REAL("T1", t[0], USED, LENGTH),   CARD_REAL("T2", t[1], USED, LENGTH),
    CARD_REAL("T3", t[2], USED, LENGTH),   CARD_REAL("T4", t[3], USED, LENGTH),
    CARD_REAL("NLOC", nloc, LISTED, NONE), CARD_REAL("MAREA", marea, USED, NONE),
    CARD_REAL("IDOF", idof, LISTED, NONE), CARD_INT("EDGSET", edgset, LISTED, ID_SET),
};
static const FieldSpec section_angle_fields[] = {
    CARD_REAL("B1", beta[0], USED, NONE),   CARD_REAL("B2", beta[1], LISTED, NONE),
    CARD_REAL("B3", beta[2], LISTED, NONE), CARD_REAL("B4", beta[3], LISTED, NONE),
    CARD_REAL("B5", beta[4], LISTED, NONE), CARD_REAL("B6", beta[5], LISTED, NONE),
    CARD_REAL("B7", beta[6], LISTED, NONE), CARD_REAL("B8", beta[7], LISTED, NONE),
};
#undef AT

enum { SECTION_TITLE };
static const CardSpec section_cards[] = {
    {"card 1", "one for each section", CARD_FIELDS(section_fields)},
    {"card 2", "one for each section", CARD_FIELDS(section_thickness_fields)},
    {"card 3", "if ICOMP = 1, one for every eight of NIP", CARD_FIELDS(section_angle_fields)},
};

/* The material angles of ICOMP = 1: eight on a card, NIP in all. */
static int read_section_angles(KeywordRead *read, SectionShellDefinition *section)
{
    int count = section->nip >= 1.0 && section->nip < 1000.0 ? (int)section->nip : 1;
    section->beta_count = count < 8 ? count : 8;
    for (int first = 0; first < count; first += 8) {
        SectionShellDefinition later = {0};
        if (keyword_card(read, 2, first == 0 ? section : &later, true, NULL)) return -1;
    }
    return 0;
}

static void read_section_shell(KeywordRead *read)
{
    while (keyword_more(read)) {
        SectionShellDefinition card = {0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, SECTION_TITLE, title);
        int status = keyword_card(read, 0, &card, true, &card.source);
        if (keyword_card(read, 1, &card, status == 0, NULL)) status = -1;
        if (status) continue;
        if (card.elform >= 101 && card.elform <= 105) {
            keyword_error(read, card.source,
                          "ELFORM = %d is a user-defined element, which billow does not have; choose 5 or 9",
                          card.elform);
            return;
        }
        if (card.icomp == 1 && read_section_angles(read, &card)) continue;
        if (!keyword_check_id(read, card.id, "SECID", card.source)) continue;
        for (int i = 1; i < 4; i++)
            if (card.t[i] == 0.0) card.t[i] = card.t[0];
        /* mass over area: a density times a length */
        card.marea = keyword_scale(read, keyword_scale(read, card.marea, SCALE_DENSITY), SCALE_LENGTH);
        SectionShellDefinition *section = KEYWORD_APPEND(read, read->definitions->sections);
        if (!section) return;
        *section = card;
    }
}

#define AT(member) offsetof(HourglassDefinition, member)
static const FieldSpec hourglass_fields[] = {
    CARD_INT("HGID", id, USED, ID_OTHER),      CARD_INT("IHQ", ihq, LISTED, NONE),
    CARD_REAL_OR("QM", qm, 0.1, USED, NONE),   CARD_INT("IBQ", ibq, LISTED, NONE),
    CARD_REAL_OR("Q1", q1, 1.5, LISTED, NONE), CARD_REAL_OR("Q2", q2, 0.06, LISTED, NONE),
    CARD_REAL("QB/VDC", qb_vdc, LISTED, NONE), CARD_REAL("QW", qw, LISTED, NONE),
};
#undef AT

enum { HOURGLASS_TITLE };
static const CardSpec hourglass_cards[] = {{"card 1", "one for each HGID", CARD_FIELDS(hourglass_fields)}};

static void read_hourglass(KeywordRead *read)
{
    while (keyword_more(read)) {
        HourglassDefinition card = {0};
        char title[BILLOW_TITLE_LENGTH] = "";
        keyword_title(read, HOURGLASS_TITLE, title);
        if (keyword_card(read, 0, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, "HGID", card.source)) continue;
        HourglassDefinition *hourglass = KEYWORD_APPEND(read, read->definitions->hourglasses);
        if (!hourglass) return;
        *hourglass = card;
    }
}

static const KeywordSpec specs[] = {
    {.name = "*PART",
     .options = {"INERTIA"},
     .cards = part_cards,
     .card_count = 6,
     .read = read_part,
     .remark = "INERTIA is for rigid parts. The options CONTACT, REPOSITION and others are refused."},
    {.name = "*SECTION_SHELL",
     .options = {"TITLE"},
     .cards = section_cards,
     .card_count = 3,
     .read = read_section_shell,
     .remark = "T2 to T4 are T1 where they are 0. Membranes have one point through the thickness, so only B1 counts."},
    {.name = "*HOURGLASS",
     .options = {"TITLE"},
     .cards = hourglass_cards,
     .card_count = 1,
     .read = read_hourglass,
     .remark = "For one-point quadrilaterals; fully integrated ones and triangles need none."},
};

const KeywordFamily keyword_family_parts = {"Parts and sections", specs, (int)(sizeof specs / sizeof *specs)};
