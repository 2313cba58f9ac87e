/* *SET_NODE, *SET_PART, *SET_SHELL, *SET_SEGMENT in all their forms. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "io/keyword_table.h"

/* The first card, the same for all. */
typedef struct SetCard {
    int id;
    double da[4];
    char solver[11];
    int its;
} SetCard;

#define AT(member) offsetof(SetCard, member)
static const FieldSpec head_fields[] = {
    CARD_INT("SID", id, USED, ID_SET),     CARD_REAL("DA1", da[0], LISTED, NONE), CARD_REAL("DA2", da[1], LISTED, NONE),
    CARD_REAL("DA3", da[2], LISTED, NONE), CARD_REAL("DA4", da[3], LISTED, NONE), CARD_TEXT("SOLVER", solver, 10, USED),
    CARD_INT("ITS", its, LISTED, NONE),
};
#undef AT

/* Ids, eight on a card: members, pairs of a range, or one range with its increment. */
typedef struct IdsCard {
    int e[8];
} IdsCard;

#define AT(member) offsetof(IdsCard, member)
#define MEMBER_FIELDS(prefix, scale)                                                                                   \
    {                                                                                                                  \
        CARD_INT(prefix "1", e[0], USED, scale), CARD_INT(prefix "2", e[1], USED, scale),                              \
            CARD_INT(prefix "3", e[2], USED, scale), CARD_INT(prefix "4", e[3], USED, scale),                          \
            CARD_INT(prefix "5", e[4], USED, scale), CARD_INT(prefix "6", e[5], USED, scale),                          \
            CARD_INT(prefix "7", e[6], USED, scale), CARD_INT(prefix "8", e[7], USED, scale),                          \
    }
#define RANGE_FIELDS(scale)                                                                                            \
    {                                                                                                                  \
        CARD_INT("B1BEG", e[0], USED, scale), CARD_INT("B1END", e[1], USED, scale),                                    \
            CARD_INT("B2BEG", e[2], USED, scale), CARD_INT("B2END", e[3], USED, scale),                                \
            CARD_INT("B3BEG", e[4], USED, scale), CARD_INT("B3END", e[5], USED, scale),                                \
            CARD_INT("B4BEG", e[6], USED, scale), CARD_INT("B4END", e[7], USED, scale),                                \
    }
#define STEP_FIELDS(scale)                                                                                             \
    {                                                                                                                  \
        CARD_INT("BBEG", e[0], USED, scale), CARD_INT("BEND", e[1], USED, scale), CARD_INT("INCR", e[2], USED, NONE),  \
    }
static const FieldSpec node_member_fields[] = MEMBER_FIELDS("NID", ID_NODE);
static const FieldSpec part_member_fields[] = MEMBER_FIELDS("PID", ID_PART);
static const FieldSpec shell_member_fields[] = MEMBER_FIELDS("EID", ID_ELEMENT);
static const FieldSpec node_range_fields[] = RANGE_FIELDS(ID_NODE);
static const FieldSpec part_range_fields[] = RANGE_FIELDS(ID_PART);
static const FieldSpec shell_range_fields[] = RANGE_FIELDS(ID_ELEMENT);
static const FieldSpec node_step_fields[] = STEP_FIELDS(ID_NODE);
static const FieldSpec part_step_fields[] = STEP_FIELDS(ID_PART);
static const FieldSpec shell_step_fields[] = STEP_FIELDS(ID_ELEMENT);
#undef AT

/* One member with attributes (_COLUMN), and a segment with its attributes. */
typedef struct MemberCard {
    int node[4];
    double a[4];
} MemberCard;

#define AT(member) offsetof(MemberCard, member)
#define COLUMN_FIELDS(name, scale)                                                                                     \
    {                                                                                                                  \
        CARD_INT(name, node[0], USED, scale), CARD_REAL("A1", a[0], LISTED, NONE),                                     \
            CARD_REAL("A2", a[1], LISTED, NONE), CARD_REAL("A3", a[2], LISTED, NONE),                                  \
            CARD_REAL("A4", a[3], LISTED, NONE),                                                                       \
    }
static const FieldSpec node_column_fields[] = COLUMN_FIELDS("NID", ID_NODE);
static const FieldSpec part_column_fields[] = COLUMN_FIELDS("PID", ID_PART);
static const FieldSpec shell_column_fields[] = COLUMN_FIELDS("EID", ID_ELEMENT);
static const FieldSpec segment_fields[] = {
    CARD_INT("N1", node[0], USED, ID_NODE), CARD_INT("N2", node[1], USED, ID_NODE),
    CARD_INT("N3", node[2], USED, ID_NODE), CARD_INT("N4", node[3], USED, ID_NODE),
    CARD_REAL("A1", a[0], LISTED, NONE),    CARD_REAL("A2", a[1], LISTED, NONE),
    CARD_REAL("A3", a[2], LISTED, NONE),    CARD_REAL("A4", a[3], LISTED, NONE),
};
#undef AT

typedef struct GeneralCard {
    char option[11];
    int e[7];
} GeneralCard;

#define AT(member) offsetof(GeneralCard, member)
static const FieldSpec general_fields[] = {
    CARD_TEXT("OPTION", option, 10, USED), CARD_INT("E1", e[0], USED, NONE), CARD_INT("E2", e[1], USED, NONE),
    CARD_INT("E3", e[2], USED, NONE),      CARD_INT("E4", e[3], USED, NONE), CARD_INT("E5", e[4], USED, NONE),
    CARD_INT("E6", e[5], USED, NONE),      CARD_INT("E7", e[6], USED, NONE),
};
#undef AT

enum { SET_LIST, SET_GENERATE, SET_INCREMENT, SET_GENERAL, SET_COLUMN, SET_TITLE }; /* options */
enum { SET_HEAD_CARD, SET_MEMBER_CARD, SET_RANGE_CARD, SET_STEP_CARD, SET_COLUMN_CARD, SET_GENERAL_CARD };
#define SET_CARDS(kind)                                                                                                \
    {                                                                                                                  \
        {"card 1", "", CARD_FIELDS(head_fields)},                                                                      \
            {"card 2", "LIST or no option, as many as needed", CARD_FIELDS(kind##_member_fields)},                     \
            {"card 2", "GENERATE, as many as needed", CARD_FIELDS(kind##_range_fields)},                               \
            {"card 2", "GENERATE_INCREMENT, as many as needed", CARD_FIELDS(kind##_step_fields)},                      \
            {"card 2", "COLUMN, one for each member", CARD_FIELDS(kind##_column_fields)},                              \
            {"card 2", "GENERAL, as many as needed", CARD_FIELDS(general_fields)},                                     \
    }
static const CardSpec node_cards[] = SET_CARDS(node);
static const CardSpec part_cards[] = SET_CARDS(part);
static const CardSpec shell_cards[] = SET_CARDS(shell);
enum { SEGMENT_TITLE, SEGMENT_GENERAL };
static const CardSpec segment_cards[] = {
    {"card 1", "", CARD_FIELDS(head_fields)},
    {"card 2", "without GENERAL, one for each segment", CARD_FIELDS(segment_fields)},
    {"card 2", "GENERAL, as many as needed", CARD_FIELDS(general_fields)},
};

/* Reads title and first card and appends the set; NULL after an error. */
static SetDefinition *start_set(KeywordRead *read, SetKind kind, int title_option)
{
    SetCard card = {0};
    char title[BILLOW_TITLE_LENGTH] = "";
    Source source;
    keyword_title(read, title_option, title);
    if (keyword_card(read, SET_HEAD_CARD, &card, true, &source)) return NULL;
    if (!keyword_check_id(read, card.id, "SID", source)) return NULL;
    if (card.solver[0] && strcmp(card.solver, "MECH") != 0 && strcmp(card.solver, "0") != 0)
        keyword_warning(read, source, "the set is meant for the solver %s, but billow uses it as a mechanical one",
                        card.solver);
    SetDefinition *set = KEYWORD_APPEND(read, read->definitions->sets);
    if (!set) return NULL;
    set->kind = kind;
    set->id = card.id;
    set->source = source;
    memcpy(set->title, title, sizeof title);
    memcpy(set->da, card.da, sizeof card.da);
    return set;
}

static void add_member(KeywordRead *read, SetDefinition *set, int id)
{
    if (id == 0) return;
    int *member = KEYWORD_APPEND(read, set->members);
    if (member) *member = id;
}

static void add_clause(KeywordRead *read, SetDefinition *set, const char *option, const double e[7], Source source)
{
    SetClause *clause = KEYWORD_APPEND(read, set->clauses);
    if (!clause) return;
    snprintf(clause->option, sizeof clause->option, "%s", option);
    memcpy(clause->e, e, sizeof clause->e);
    clause->source = source;
}

static void add_range(KeywordRead *read, SetDefinition *set, int first, int last, int increment, Source source)
{
    if (first == 0 && last == 0) return;
    if (last < first || first < 0) {
        keyword_error(read, source, "the range from %d to %d holds nothing; the first id must not be above the last",
                      first, last);
        return;
    }
    const double e[7] = {first, last, increment};
    add_clause(read, set, "RANGE", e, source);
}

static void read_members(KeywordRead *read, SetDefinition *set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        IdsCard card;
        if (keyword_card(read, SET_MEMBER_CARD, &card, true, NULL)) continue;
        for (int i = 0; i < 8; i++) add_member(read, set, card.e[i]);
    }
}

static void read_column(KeywordRead *read, SetDefinition *set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        MemberCard card;
        if (keyword_card(read, SET_COLUMN_CARD, &card, true, NULL) == 0) add_member(read, set, card.node[0]);
    }
}

static void read_ranges(KeywordRead *read, SetDefinition *set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        IdsCard card;
        Source source;
        if (keyword_card(read, SET_RANGE_CARD, &card, true, &source)) continue;
        for (int i = 0; i < 8; i += 2) add_range(read, set, card.e[i], card.e[i + 1], 1, source);
    }
}

static void read_steps(KeywordRead *read, SetDefinition *set)
{
    while (keyword_more(read) && !read->out_of_memory) {
        IdsCard card;
        Source source;
        if (keyword_card(read, SET_STEP_CARD, &card, true, &source)) continue;
        if (card.e[2] < 1) {
            keyword_error(read, source, "INCR is %d, but must be at least 1", card.e[2]);
            continue;
        }
        add_range(read, set, card.e[0], card.e[1], card.e[2], source);
    }
}

enum {
    IN_NODES = 1u << SET_NODE,
    IN_PARTS = 1u << SET_PART,
    IN_SHELLS = 1u << SET_SHELL,
    IN_SEGMENTS = 1u << SET_SEGMENT
};

/* The words that may stand in a _GENERAL set, also with D before them to take away, and what their entities are. */
static const struct {
    const char *option;
    FieldScale scale;
    unsigned kinds;
} general_options[] = {
    {"ALL", SCALE_NONE, IN_NODES | IN_PARTS | IN_SHELLS | IN_SEGMENTS},
    {"PART", SCALE_ID_PART, IN_NODES | IN_PARTS | IN_SHELLS | IN_SEGMENTS},
    {"SET_PART", SCALE_ID_SET, IN_NODES | IN_PARTS | IN_SHELLS | IN_SEGMENTS},
    {"NODE", SCALE_ID_NODE, IN_NODES},
    {"SET_NODE", SCALE_ID_SET, IN_NODES},
    {"ELEM", SCALE_ID_ELEMENT, IN_SHELLS},
    {"SHELL", SCALE_ID_ELEMENT, IN_NODES | IN_SEGMENTS},
    {"SET_SHELL", SCALE_ID_SET, IN_NODES | IN_SHELLS | IN_SEGMENTS},
    {"SEG", SCALE_ID_NODE, IN_SEGMENTS},
    {"BOX", SCALE_ID_DEFINE, IN_NODES | IN_SHELLS | IN_SEGMENTS},
};
enum { GENERAL_OPTION_COUNT = sizeof general_options / sizeof *general_options };

/* Place of the word among the options for sets of this kind, -1 if it is not one of them. */
static int find_general_option(const char *word, SetKind kind)
{
    for (int i = 0; i < GENERAL_OPTION_COUNT; i++) {
        if (!(general_options[i].kinds & 1u << kind)) continue;
        if (strcmp(general_options[i].option, word) == 0) return i;
        if (i > 0 && word[0] == 'D' && strcmp(general_options[i].option, word + 1) == 0) return i;
    }
    return -1;
}

static void read_general(KeywordRead *read, SetDefinition *set, int card_index)
{
    while (keyword_more(read) && !read->out_of_memory) {
        GeneralCard card;
        Source source;
        if (keyword_card(read, card_index, &card, true, &source)) continue;
        for (char *c = card.option; *c; c++) *c = (char)toupper((unsigned char)*c);
        const int found = find_general_option(card.option, set->kind);
        if (found < 0) {
            keyword_error(read, source, "OPTION '%s' is not read by billow " BILLOW_VERSION " in this kind of set",
                          card.option);
            continue;
        }
        double e[7];
        bool good = true;
        for (int i = 0; i < 7 && good; i++) {
            e[i] = card.e[i];
            good = keyword_real_id(read, &e[i], general_options[found].scale, "an entity of the set", source);
        }
        if (good) add_clause(read, set, card.option, e, source);
    }
}

/* A set without anything in it is an error of its own: it would silently leave a bag or a support empty. */
static void finish_set(KeywordRead *read, const SetDefinition *set, int errors_before)
{
    if (set->members.count + set->clauses.count + set->segments.count > 0) return;
    if (read->out_of_memory || read->cards->diagnostics->errors > errors_before) return;
    read->kept = true;
    keyword_error(read, set->source, "set %d has no members; list them on the lines after this one", set->id);
}

static void read_set(KeywordRead *read, SetKind kind)
{
    const int errors = read->cards->diagnostics->errors;
    SetDefinition *set = start_set(read, kind, SET_TITLE);
    if (!set) return;
    const bool generate = keyword_option(read, SET_GENERATE), general = keyword_option(read, SET_GENERAL),
               column = keyword_option(read, SET_COLUMN), increment = keyword_option(read, SET_INCREMENT);
    if (generate + general + column > 1 || (increment && !generate)) {
        keyword_error(read, read->cards->block->source, "these options do not go together; use one form of the set");
        return;
    }
    if (increment) {
        read_steps(read, set);
    } else if (generate) {
        read_ranges(read, set);
    } else if (general) {
        read_general(read, set, SET_GENERAL_CARD);
    } else if (column) {
        read_column(read, set);
    } else {
        read_members(read, set);
    }
    finish_set(read, set, errors);
}

static void read_set_node(KeywordRead *read)
{
    read_set(read, SET_NODE);
}

static void read_set_part(KeywordRead *read)
{
    read_set(read, SET_PART);
}

static void read_set_shell(KeywordRead *read)
{
    read_set(read, SET_SHELL);
}

static void read_set_segment(KeywordRead *read)
{
    const int errors = read->cards->diagnostics->errors;
    SetDefinition *set = start_set(read, SET_SEGMENT, SEGMENT_TITLE);
    if (!set) return;
    if (keyword_option(read, SEGMENT_GENERAL)) read_general(read, set, 2);
    while (keyword_more(read) && !read->out_of_memory) {
        MemberCard card;
        Source source;
        if (keyword_card(read, 1, &card, true, &source)) continue;
        int *n = card.node;
        if (n[3] == 0) n[3] = n[2];
        if (n[0] < 1 || n[1] < 1 || n[2] < 1 || n[3] < 1) {
            keyword_error(read, source, "the segment %d, %d, %d, %d lacks a node", n[0], n[1], n[2], n[3]);
            continue;
        }
        SegmentDefinition *segment = KEYWORD_APPEND(read, set->segments);
        if (!segment) return;
        memcpy(segment->node, n, sizeof segment->node);
        segment->source = source;
    }
    finish_set(read, set, errors);
}

#define SET_OPTIONS                                                                                                    \
    {                                                                                                                  \
        "LIST", "GENERATE", "INCREMENT", "GENERAL", "COLUMN", "TITLE"                                                  \
    }
static const KeywordSpec specs[] = {
    {.name = "*SET_NODE",
     .options = SET_OPTIONS,
     .cards = node_cards,
     .card_count = 6,
     .read = read_set_node,
     .remark =
         "GENERAL takes ALL, NODE, SHELL, PART, BOX, SET_NODE, SET_SHELL and SET_PART, also with D before them to "
         "take away. ADD, INTERSECT, LIST_SMOOTH are refused."},
    {.name = "*SET_PART",
     .options = SET_OPTIONS,
     .cards = part_cards,
     .card_count = 6,
     .read = read_set_part,
     .remark = "GENERAL takes ALL, PART and SET_PART, also with D before them. ADD and TREE are refused."},
    {.name = "*SET_SHELL",
     .options = SET_OPTIONS,
     .cards = shell_cards,
     .card_count = 6,
     .read = read_set_shell,
     .remark =
         "GENERAL takes ALL, ELEM, PART, BOX, SET_SHELL and SET_PART, also with D before them. ADD and INTERSECT are "
         "refused."},
    {.name = "*SET_SEGMENT",
     .options = {"TITLE", "GENERAL"},
     .cards = segment_cards,
     .card_count = 3,
     .read = read_set_segment,
     .remark =
         "N4 = 0 or N4 = N3 is a triangle. GENERAL takes ALL, SEG, SHELL, PART, BOX, SET_SHELL and SET_PART, also "
         "with D before them. ADD and INTERSECT are refused."},
};

const KeywordFamily keyword_family_sets = {"Sets", specs, (int)(sizeof specs / sizeof *specs)};
