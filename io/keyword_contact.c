/* *CONTACT: surfaces that meet, and *CONTROL_CONTACT. */
#include <string.h>

#include "io/keyword_table.h"

/* One contact as its cards are read; what billow does not use goes to unused. */
typedef struct ContactCard {
    ContactDefinition contact;
    UnusedCard unused;
    int penchk, spr, mpr;
} ContactCard;

#define AT(member) offsetof(ContactCard, member)
#define CONTACT_UNUSED_INT(name, k, fallback)                                                                          \
    {                                                                                                                  \
        name, 'I', 10, offsetof(ContactCard, unused.i[k]), fallback, true, FIELD_LISTED, SCALE_NONE                    \
    }
#define CONTACT_UNUSED_REAL(name, k, fallback)                                                                         \
    {                                                                                                                  \
        name, 'F', 10, offsetof(ContactCard, unused.f[k]), fallback, true, FIELD_LISTED, SCALE_NONE                    \
    }
static const FieldSpec card1_fields[] = {
    CARD_INT("SSID", contact.ssid, USED, NONE),
    CARD_INT("MSID", contact.msid, USED, NONE),
    CARD_INT("SSTYP", contact.sstyp, USED, NONE),
    CARD_INT("MSTYP", contact.mstyp, USED, NONE),
    CARD_INT("SBOXID", contact.sboxid, USED, ID_DEFINE),
    CARD_INT("MBOXID", contact.mboxid, USED, ID_DEFINE),
    CARD_INT("SPR", spr, LISTED, NONE),
    CARD_INT("MPR", mpr, LISTED, NONE),
};
static const FieldSpec card2_fields[] = {
    CARD_REAL("FS", contact.fs, USED, NONE),    CARD_REAL("FD", contact.fd, USED, NONE),
    CARD_REAL("DC", contact.dc, USED, NONE),    CARD_REAL("VC", contact.vc, REFUSED, PRESSURE),
    CARD_REAL("VDC", contact.vdc, USED, NONE),  CARD_INT("PENCHK", penchk, LISTED, NONE),
    CARD_REAL("BT", contact.birth, USED, TIME), CARD_REAL_OR("DT", contact.death, 1e20, USED, TIME),
};
static const FieldSpec card3_fields[] = {
    CARD_REAL_OR("SFS", contact.sfs, 1.0, USED, NONE),   CARD_REAL_OR("SFM", contact.sfm, 1.0, USED, NONE),
    CARD_REAL("SST", contact.sst, USED, LENGTH),         CARD_REAL("MST", contact.mst, USED, LENGTH),
    CARD_REAL_OR("SFST", contact.sfst, 1.0, USED, NONE), CARD_REAL_OR("SFMT", contact.sfmt, 1.0, USED, NONE),
    CARD_REAL_OR("FSF", contact.fsf, 1.0, USED, NONE),   CARD_REAL_OR("VSF", contact.vsf, 1.0, LISTED, NONE),
};
static const FieldSpec card_a_fields[] = {
    CARD_INT("SOFT", contact.soft, USED, NONE),
    CARD_REAL_OR("SOFSCL", contact.sofscl, 0.1, USED, NONE),
    CARD_INT("LCIDAB", contact.lcidab, USED, ID_FUNCTION),
    CONTACT_UNUSED_REAL("MAXPAR", 0, 1.025),
    CONTACT_UNUSED_INT("SBOPT", 0, 2),
    CONTACT_UNUSED_INT("DEPTH", 1, 2),
    CONTACT_UNUSED_INT("BSORT", 2, 0),
    CONTACT_UNUSED_INT("FRCFRQ", 3, 1),
};
static const FieldSpec card_b_fields[] = {
    CONTACT_UNUSED_REAL("PENMAX", 2, 0),
    CARD_INT("THKOPT", contact.thkopt, USED, NONE),
    CARD_INT("SHLTHK", contact.shlthk, USED, NONE),
    CONTACT_UNUSED_INT("SNLOG", 0, 0),
    CONTACT_UNUSED_INT("ISYM", 1, 0),
    CONTACT_UNUSED_INT("I2D3D", 2, 0),
    CONTACT_UNUSED_REAL("SLDTHK", 0, 0),
    CONTACT_UNUSED_REAL("SLDSTF", 1, 0),
};
static const FieldSpec card_c_fields[] = {
    CONTACT_UNUSED_INT("IGAP", 0, 1),    CARD_INT("IGNORE", contact.ignore, USED, NONE),
    CONTACT_UNUSED_REAL("DPRFAC", 0, 0), CONTACT_UNUSED_REAL("DTSTIF", 1, 0),
    CONTACT_UNUSED_REAL("EDGEK", 2, 0),  CARD_GAP,
    CONTACT_UNUSED_REAL("FLANGL", 3, 0), CONTACT_UNUSED_INT("CID_RCF", 1, 0),
};
static const FieldSpec card_d_fields[] = {
    CONTACT_UNUSED_INT("Q2TRI", 0, 0),   CONTACT_UNUSED_REAL("DTPCHK", 0, 0), CONTACT_UNUSED_REAL("SFNBR", 1, 0),
    CONTACT_UNUSED_REAL("FNLSCL", 2, 0), CONTACT_UNUSED_REAL("DNLSCL", 3, 0), CONTACT_UNUSED_INT("TCSO", 1, 0),
    CONTACT_UNUSED_INT("TIEDID", 2, 0),  CONTACT_UNUSED_INT("SHLEDG", 3, 0),
};
static const FieldSpec card_e_fields[] = {
    CONTACT_UNUSED_INT("SHAREC", 0, 0), CONTACT_UNUSED_INT("CPARM8", 1, 0),  CONTACT_UNUSED_INT("IPBACK", 2, 0),
    CONTACT_UNUSED_INT("SRNDE", 3, 0),  CONTACT_UNUSED_REAL("FRICSF", 0, 1), CONTACT_UNUSED_INT("ICOR", 4, 0),
    CONTACT_UNUSED_INT("FTORQ", 5, 0),  CONTACT_UNUSED_INT("REGION", 6, 0),
};
static const FieldSpec card_f_fields[] = {
    CONTACT_UNUSED_INT("PSTIFF", 0, 0), CONTACT_UNUSED_INT("IGNROFF", 1, 0), CARD_GAP,
    CONTACT_UNUSED_REAL("FSTOL", 0, 2), CONTACT_UNUSED_INT("2DBINR", 2, 0),  CONTACT_UNUSED_INT("SSFTYP", 3, 0),
    CONTACT_UNUSED_INT("SWTPR", 4, 0),  CONTACT_UNUSED_REAL("TETFAC", 1, 0),
};
static const FieldSpec mpp1_fields[] = {
    CONTACT_UNUSED_INT("IGNORE", 0, 0),
    CONTACT_UNUSED_INT("BCKT", 1, 200),
    CONTACT_UNUSED_INT("LCBCKT", 2, 0),
    CONTACT_UNUSED_INT("NS2TRK", 3, 3),
    CONTACT_UNUSED_INT("INITITR", 4, 2),
    CONTACT_UNUSED_REAL("PARMAX", 0, 1.0005),
    CARD_GAP,
    CONTACT_UNUSED_INT("CPARM8", 5, 0),
};
static const FieldSpec card4_fields[] = {
    CONTACT_UNUSED_INT("ISYM", 0, 0),
    CONTACT_UNUSED_INT("EROSOP", 1, 0),
    CONTACT_UNUSED_INT("IADJ", 2, 0),
};
static const FieldSpec id_fields[] = {CARD_INT("CID", contact.id, USED, NONE),
                                      CARD_TEXT("HEADING", contact.title, 70, USED)};
#undef AT

enum { CONTACT_ID, CONTACT_TITLE, CONTACT_MPP };
enum { CARD_1, CARD_2, CARD_3, CARD_A, CARD_F = CARD_A + 5, CARD_ID, CARD_MPP, CARD_4 };

#define CONTACT_CARDS                                                                                                  \
    {"card 1", "", CARD_FIELDS(card1_fields)}, {"card 2", "", CARD_FIELDS(card2_fields)},                              \
        {"card 3", "", CARD_FIELDS(card3_fields)}, {"card A", "optional", CARD_FIELDS(card_a_fields)},                 \
        {"card B", "optional", CARD_FIELDS(card_b_fields)}, {"card C", "optional", CARD_FIELDS(card_c_fields)},        \
        {"card D", "optional", CARD_FIELDS(card_d_fields)}, {"card E", "optional", CARD_FIELDS(card_e_fields)},        \
        {"card F", "optional", CARD_FIELDS(card_f_fields)},                                                            \
        {"ID card", "before card 1 with ID or TITLE", CARD_FIELDS(id_fields)},                                         \
    {                                                                                                                  \
        "MPP card", "after the ID card with MPP; a second one that begins with & is skipped", CARD_FIELDS(mpp1_fields) \
    }

static const CardSpec contact_cards[] = {CONTACT_CARDS};
static const CardSpec eroding_cards[] = {CONTACT_CARDS, {"card 4", "after card 3", CARD_FIELDS(card4_fields)}};

/* Ids get the offset of what they name. */
static int scale_side(const KeywordRead *read, int id, int type)
{
    FieldScale scale = type == 3 ? SCALE_ID_PART : SCALE_ID_SET;
    return type == 5 ? 0 : (int)keyword_scale(read, id, scale);
}

static bool check_side(const KeywordRead *read, const ContactDefinition *c, bool first)
{
    int type = first ? c->sstyp : c->mstyp, id = first ? c->ssid : c->msid;
    const char *field = first ? "SSTYP" : "MSTYP", *name = first ? "SSID" : "MSID";
    bool nodes = first && c->kind == CONTACT_NODES_TO_SURFACE;
    if (type < 0 || type > 6 || (type == 4 && !nodes)) {
        keyword_error(
            read, c->card1,
            "%s = %d: this contact knows 0 (segment set), 1 (shell set), 2 (part set), 3 (part)%s, 5 (all) and 6 "
            "(all but a part set)",
            field, type, nodes ? ", 4 (node set)" : "");
        return false;
    }
    if (type == 5 || (id == 0 && first && c->kind == CONTACT_SELF)) return true;
    return keyword_check_id(read, id, name, c->card1);
}

static bool check_values(const KeywordRead *read, const ContactDefinition *c)
{
    const int errors = read->cards->diagnostics->errors;
    if (c->fs < 0.0 || c->fd < 0.0 || c->dc < 0.0 || c->fsf < 0.0)
        keyword_error(
            read, c->card2,
            "FS = %g, FD = %g, DC = %g: friction by part or by table (FS < 0) is not read by billow " BILLOW_VERSION
            "; give numbers that are not negative",
            c->fs, c->fd, c->dc);
    if (!(c->vdc >= 0.0 && c->vdc <= 200.0))
        keyword_error(read, c->card2, "VDC = %g: viscous damping is given in percent of critical, 0 to 200", c->vdc);
    if (c->birth < 0.0 || c->death < 0.0)
        keyword_error(read, c->card2,
                      "BT = %g, DT = %g: times below 0 have meanings of their own in LS-DYNA (curves, dynamic "
                      "relaxation) that billow does not have; give times from 0 on, or leave them blank",
                      c->birth, c->death);
    else
        keyword_check_times(read, "contact", "BT", c->birth, "DT", c->death, c->card2);
    if (c->sst < 0.0 || c->mst < 0.0 || c->sfst < 0.0 || c->sfmt < 0.0 || c->sfs < 0.0 || c->sfm < 0.0)
        keyword_error(read, c->card3, "a factor or a thickness of card 3 is negative");
    if (c->soft != 0 && c->soft != 1 && c->soft != 2)
        keyword_error(read, c->card_a, "SOFT = %d is not known here; use 0, 1 or 2", c->soft);
    if (!(c->sofscl > 0.0 && c->sofscl <= 1.0))
        keyword_error(read, c->card_a, "SOFSCL = %g must lie between 0 and 1", c->sofscl);
    if (c->ignore < 0 || c->ignore > 2)
        keyword_error(read, c->card_a, "IGNORE = %d (card C) is known for mortar contacts only; use 0, 1 or 2",
                      c->ignore);
    return read->cards->diagnostics->errors == errors;
}

/* The ID card, MPP card and cards 1 to 3, then as many optional cards as there are. */
static int read_cards(KeywordRead *read, ContactCard *card)
{
    ContactDefinition *c = &card->contact;
    int status = 0;
    if (keyword_option(read, CONTACT_ID) || keyword_option(read, CONTACT_TITLE))
        status |= keyword_card(read, CARD_ID, card, true, NULL);
    if (keyword_option(read, CONTACT_MPP)) {
        status |= keyword_card(read, CARD_MPP, card, true, NULL);
        const DeckLine *next = card_peek(read->cards);
        if (next && next->text[strspn(next->text, " ")] == '&') card_skip(read->cards);
    }
    status |= keyword_card(read, CARD_1, card, true, &c->card1);
    status |= keyword_card(read, CARD_2, card, true, &c->card2);
    status |= keyword_card(read, CARD_3, card, true, &c->card3);
    if (read->spec->cards == eroding_cards) status |= keyword_card(read, CARD_4, card, true, NULL);
    for (int i = CARD_A; i <= CARD_F && !status; i++) {
        Source *place = i == CARD_A ? &c->card_a : NULL;
        if (keyword_card(read, i, card, false, place) && card_left(read->cards)) status = -1;
    }
    return status;
}

static void read_contact(KeywordRead *read, ContactKind kind, bool automatic)
{
    ContactCard card = {.contact = {.kind = kind, .automatic = automatic, .source = read->cards->block->source}};
    ContactDefinition *c = &card.contact;
    if (read_cards(read, &card)) return;
    keyword_finish(read);
    if (c->card_a.line == 0) c->card_a = c->card3;
    bool good = check_side(read, c, true);
    if (kind != CONTACT_SELF) good = check_side(read, c, false) && good;
    if (!check_values(read, c) || !good) return;
    c->ssid = scale_side(read, c->ssid, c->sstyp);
    c->msid = scale_side(read, c->msid, c->mstyp);
    ContactDefinition *contact = KEYWORD_APPEND(read, read->definitions->contacts);
    if (contact) *contact = *c;
}

static void read_self(KeywordRead *read)
{
    read_contact(read, CONTACT_SELF, true);
}
static void read_automatic_two_way(KeywordRead *read)
{
    read_contact(read, CONTACT_TWO_WAY, true);
}
static void read_automatic_one_way(KeywordRead *read)
{
    read_contact(read, CONTACT_ONE_WAY, true);
}
static void read_automatic_nodes(KeywordRead *read)
{
    read_contact(read, CONTACT_NODES_TO_SURFACE, true);
}
static void read_nodes(KeywordRead *read)
{
    read_contact(read, CONTACT_NODES_TO_SURFACE, false);
}
static void read_one_way(KeywordRead *read)
{
    read_contact(read, CONTACT_ONE_WAY, false);
}
static void read_two_way(KeywordRead *read)
{
    read_contact(read, CONTACT_TWO_WAY, false);
}

#define AT(member) offsetof(ControlDefinitions, contact.member)
static const FieldSpec control1_fields[] = {
    CARD_REAL_OR("SLSFAC", slsfac, 0.1, USED, NONE), CARD_REAL("RWPNAL", rwpnal, USED, NONE),
    CARD_INT_OR("ISLCHK", islchk, 1, LISTED, NONE),  CARD_INT("SHLTHK", shlthk, USED, NONE),
    CARD_INT_OR("PENOPT", penopt, 1, LISTED, NONE),  CARD_INT("THKCHG", thkchg, LISTED, NONE),
    CARD_INT_OR("ORIEN", orien, 1, LISTED, NONE),    CARD_INT("ENMASS", enmass, USED, NONE),
};
#undef AT
static const FieldSpec control2_fields[] = {
    UNUSED_INT("USRSTR", 0, 0), UNUSED_INT("USRFRC", 1, 0), UNUSED_INT("NSBCS", 2, 0), UNUSED_INT("INTERM", 3, 0),
    UNUSED_REAL("XPENE", 0, 4), UNUSED_INT("SSTHK", 4, 0),  UNUSED_INT("ECDT", 5, 0),  UNUSED_INT("TIEDPRJ", 6, 0),
};
static const FieldSpec control3_fields[] = {
    UNUSED_REAL("SFRIC", 0, 0), UNUSED_REAL("DFRIC", 1, 0), UNUSED_REAL("EDC", 2, 0),    UNUSED_REAL("VFC", 3, 0),
    UNUSED_REAL("TH", 4, 0),    UNUSED_REAL("TH_SF", 5, 0), UNUSED_REAL("PEN_SF", 6, 0), UNUSED_REAL("PTSCL", 7, 1),
};
/* Card 4 with the one field that has an effect. */
typedef struct ControlCard4 {
    int ignore;
    UnusedCard unused;
} ControlCard4;
#define AT(member) offsetof(ControlCard4, member)
#define CONTROL4_INT(name, k)                                                                                          \
    {                                                                                                                  \
        name, 'I', 10, AT(unused.i[k]), 0, true, FIELD_LISTED, SCALE_NONE                                              \
    }
static const FieldSpec control4_fields[] = {
    CARD_INT("IGNORE", ignore, USED, NONE),
    CONTROL4_INT("FRCENG", 0),
    CONTROL4_INT("SKIPRWG", 1),
    CONTROL4_INT("OUTSEG", 2),
    CONTROL4_INT("SPOTSTP", 3),
    CONTROL4_INT("SPOTDEL", 4),
    CARD_REAL("SPOTHIN", unused.f[0], LISTED, NONE),
};
#undef AT
static const FieldSpec control5_fields[] = {
    UNUSED_INT("ISYM", 0, 0),   UNUSED_INT("NSEROD", 1, 0), UNUSED_INT("RWGAPS", 2, 1),  UNUSED_REAL("RWGDTH", 0, 0),
    UNUSED_REAL("RWKSF", 1, 1), UNUSED_INT("ICOV", 3, 0),   UNUSED_REAL("SWRADF", 2, 0), UNUSED_INT("ITHOFF", 4, 0),
};
static const FieldSpec control6_fields[] = {
    UNUSED_INT("SHLEDG", 0, 0),  UNUSED_INT("PSTIFF", 1, 0), UNUSED_INT("ITHCNT", 2, 0),
    UNUSED_INT("TDCNOF", 3, 0),  UNUSED_INT("FTALL", 4, 0),  CARD_GAP,
    UNUSED_REAL("SHLTRW", 0, 0), UNUSED_INT("IGACTC", 5, 0),
};

static const CardSpec control_cards[] = {
    {"card 1", "", CARD_FIELDS(control1_fields)},         {"card 2", "optional", CARD_FIELDS(control2_fields)},
    {"card 3", "optional", CARD_FIELDS(control3_fields)}, {"card 4", "optional", CARD_FIELDS(control4_fields)},
    {"card 5", "optional", CARD_FIELDS(control5_fields)}, {"card 6", "optional", CARD_FIELDS(control6_fields)},
};

static void read_control_contact(KeywordRead *read)
{
    ControlDefinitions *control = &read->definitions->control;
    UnusedCard unused;
    ControlCard4 card4 = {0};
    void *records[] = {control, &unused, &unused, &card4, &unused, &unused};
    if (control->contact.given)
        keyword_warning(read, read->cards->block->source,
                        "this keyword is given again; the one before (line %d) no longer counts",
                        control->contact.source.line);
    int status = keyword_card(read, 0, control, true, &control->contact.source);
    for (int i = 1; i < read->spec->card_count && status == 0; i++)
        if (keyword_card(read, i, records[i], false, NULL) && card_left(read->cards)) status = -1;
    control->contact.given = true;
    control->contact.ignore = card4.ignore;
    if (status == 0) keyword_finish(read);
    if (control->contact.slsfac < 0.0)
        keyword_error(read, control->contact.source, "SLSFAC = %g must not be negative", control->contact.slsfac);
    if (control->contact.rwpnal < 0.0)
        keyword_error(read, control->contact.source,
                      "RWPNAL = %g (a penalty on the nodes of fabric too) is not read by billow " BILLOW_VERSION
                      "; fabric stops at rigid walls without one: write %g for rigid parts",
                      control->contact.rwpnal, -control->contact.rwpnal);
    if (card4.ignore < 0 || card4.ignore > 2)
        keyword_error(read, control->contact.source, "IGNORE = %d (card 4) is not known; use 0, 1 or 2", card4.ignore);
}

#define CONTACT_OF(keyword, list, reader, text)                                                                        \
    {                                                                                                                  \
        .name = keyword, .options = {"ID", "TITLE", "MPP"}, .cards = list,                                             \
        .card_count = (int)(sizeof(list) / sizeof *(list)), .read = reader, .remark = text                             \
    }
#define CONTACT(keyword, reader, text) CONTACT_OF(keyword, contact_cards, reader, text)
#define ERODING(keyword, reader) CONTACT_OF(keyword, eroding_cards, reader, eroding_remark)
static const char self_remark[] = "All nodes of the surface meet all its segments, from both sides; its free and sharp "
                                  "edges meet all its edges. SSID "
                                  "= 0: all parts. SOFT 0, 1 and 2 are one stable penalty (theory, Contact). Initial "
                                  "penetrations are always tracked; "
                                  "IGNORE = 2 lists them. LCIDAB: thickness over time.";
static const char pair_remark[] =
    "The nodes of each surface meet the segments of the other, from both sides, and edges meet edges.";
static const char one_remark[] = "The nodes of surface A meet the segments of surface B, from both sides.";
static const char old_remark[] =
    "As its AUTOMATIC form, but without thickness unless SHLTHK (here or in *CONTROL_CONTACT) is 1 or 2.";
static const char eroding_remark[] =
    "As its AUTOMATIC form, which leaves out shells that have eroded, too. Card 4 is about solids.";
static const KeywordSpec specs[] = {
    CONTACT("*CONTACT_AIRBAG_SINGLE_SURFACE", read_self, self_remark),
    CONTACT("*CONTACT_AUTOMATIC_SINGLE_SURFACE", read_self, self_remark),
    CONTACT("*CONTACT_AUTOMATIC_GENERAL", read_self, self_remark),
    CONTACT("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", read_automatic_two_way, pair_remark),
    CONTACT("*CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", read_automatic_one_way, one_remark),
    CONTACT("*CONTACT_AUTOMATIC_NODES_TO_SURFACE", read_automatic_nodes, one_remark),
    CONTACT("*CONTACT_NODES_TO_SURFACE", read_nodes, old_remark),
    CONTACT("*CONTACT_SURFACE_TO_SURFACE", read_two_way, old_remark),
    CONTACT("*CONTACT_ONE_WAY_SURFACE_TO_SURFACE", read_one_way, old_remark),
    CONTACT("*CONTACT_SINGLE_SURFACE", read_self, self_remark),
    ERODING("*CONTACT_ERODING_SINGLE_SURFACE", read_self),
    ERODING("*CONTACT_ERODING_SURFACE_TO_SURFACE", read_automatic_two_way),
    ERODING("*CONTACT_ERODING_NODES_TO_SURFACE", read_automatic_nodes),
    {.name = "*CONTROL_CONTACT",
     .cards = control_cards,
     .card_count = (int)(sizeof control_cards / sizeof *control_cards),
     .read = read_control_contact,
     .remark = "SLSFAC scales the penalty of contacts with SOFT = 0; RWPNAL > 0 that of rigid walls on rigid parts, "
               "which pass through walls with RWPNAL = 0; SHLTHK and IGNORE are defaults of the contacts. "
               "ENMASS = 2: nodes whose shells have all eroded stay in contact."},
};

const KeywordFamily keyword_family_contact = {"Contact", specs, (int)(sizeof specs / sizeof *specs)};
