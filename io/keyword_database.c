/* *DATABASE: output intervals and the nodes of nodout. */
#include <stdio.h>
#include <string.h>

#include "io/keyword_table.h"

/* A card of any of them: what counts and what is only listed. */
typedef struct DatabaseCard {
    DatabaseDefinition record;
    int binary, ioopt, option[4], beam, psetid, nr;
} DatabaseCard;

#define AT(member) offsetof(DatabaseCard, member)
static const FieldSpec ascii_fields[] = {
    CARD_REAL("DT", record.dt, USED, TIME),
    CARD_INT("BINARY", binary, LISTED, NONE),
    CARD_INT("LCUR", record.lcur, LISTED, ID_FUNCTION),
    CARD_INT_OR("IOOPT", ioopt, 1, LISTED, NONE),
    CARD_INT("OPTION1", option[0], LISTED, NONE),
    CARD_INT("OPTION2", option[1], LISTED, NONE),
    CARD_INT("OPTION3", option[2], LISTED, NONE),
    CARD_INT("OPTION4", option[3], LISTED, NONE),
};
static const FieldSpec d3plot_fields[] = {
    CARD_REAL("DT", record.dt, USED, TIME),     CARD_INT("LCDT", record.lcur, LISTED, ID_FUNCTION),
    CARD_INT("BEAM", beam, LISTED, NONE),       CARD_INT("NPLTC", record.npltc, USED, NONE),
    CARD_INT("PSETID", psetid, LISTED, ID_SET),
};
static const FieldSpec dump_fields[] = {
    CARD_REAL("CYCL", record.dt, USED, NONE),   CARD_INT("NR", nr, LISTED, NONE),
    CARD_INT("BEAM", beam, LISTED, NONE),       CARD_INT("NPLTC", record.npltc, LISTED, NONE),
    CARD_INT("PSETID", psetid, LISTED, ID_SET),
};
static const FieldSpec runrsf_fields[] = {
    CARD_REAL("CYCL", record.dt, LISTED, NONE), CARD_INT("NR", nr, LISTED, NONE),
    CARD_INT("BEAM", beam, LISTED, NONE),       CARD_INT("NPLTC", record.npltc, LISTED, NONE),
    CARD_INT("PSETID", psetid, LISTED, ID_SET),
};
#undef AT
static const FieldSpec d3plot2_fields[] = {
    UNUSED_INT("IOOPT", 0, 0),   UNUSED_REAL("RATE", 1, 0), UNUSED_REAL("CUTOFF", 2, 0),
    UNUSED_REAL("WINDOW", 3, 0), UNUSED_INT("TYPE", 4, 0),  UNUSED_INT("PSET", 5, 0),
};

static const CardSpec ascii_cards[] = {{"card 1", "", CARD_FIELDS(ascii_fields)}};
static const CardSpec d3plot_cards[] = {
    {"card 1", "", CARD_FIELDS(d3plot_fields)},
    {"card 2", "optional", CARD_FIELDS(d3plot2_fields)},
};
static const CardSpec dump_cards[] = {{"card 1", "", CARD_FIELDS(dump_fields)}};
static const CardSpec runrsf_cards[] = {{"card 1", "", CARD_FIELDS(runrsf_fields)}};

static void read_database(KeywordRead *read)
{
    DatabaseCard card = {0};
    if (keyword_card(read, 0, &card, true, &card.record.source)) return;
    if (read->spec->card_count > 1) {
        UnusedCard unused;
        if (keyword_card(read, 1, &unused, false, NULL) && card_left(read->cards)) return;
    }
    keyword_finish(read);
    if (card.record.dt < 0.0 || card.record.npltc < 0) {
        keyword_error(read, card.record.source, "the interval %s is negative; write a positive one or 0 for none",
                      card.record.dt < 0.0 ? read->spec->cards[0].fields[0].name : "NPLTC");
        return;
    }
    DatabaseDefinition *database = KEYWORD_APPEND(read, read->definitions->databases);
    if (!database) return;
    *database = card.record;
    snprintf(database->name, sizeof database->name, "%s", read->spec->name + strlen("*DATABASE_"));
}

typedef struct HistoryCard {
    int id[8];
    char heading[71];
} HistoryCard;

#define AT(member) offsetof(HistoryCard, member)
static const FieldSpec history_fields[] = {
    CARD_INT("ID1", id[0], USED, ID_NODE), CARD_INT("ID2", id[1], USED, ID_NODE), CARD_INT("ID3", id[2], USED, ID_NODE),
    CARD_INT("ID4", id[3], USED, ID_NODE), CARD_INT("ID5", id[4], USED, ID_NODE), CARD_INT("ID6", id[5], USED, ID_NODE),
    CARD_INT("ID7", id[6], USED, ID_NODE), CARD_INT("ID8", id[7], USED, ID_NODE),
};
static const FieldSpec history_id_fields[] = {
    CARD_INT("ID1", id[0], USED, ID_NODE),
    CARD_TEXT("HEADING", heading, 70, LISTED),
};
static const FieldSpec history_set_fields[] = {
    CARD_INT("ID1", id[0], USED, ID_SET), CARD_INT("ID2", id[1], USED, ID_SET), CARD_INT("ID3", id[2], USED, ID_SET),
    CARD_INT("ID4", id[3], USED, ID_SET), CARD_INT("ID5", id[4], USED, ID_SET), CARD_INT("ID6", id[5], USED, ID_SET),
    CARD_INT("ID7", id[6], USED, ID_SET), CARD_INT("ID8", id[7], USED, ID_SET),
};
static const FieldSpec history_set_id_fields[] = {
    CARD_INT("ID1", id[0], USED, ID_SET),
    CARD_TEXT("HEADING", heading, 70, LISTED),
};
#undef AT

enum { HISTORY_ID }; /* place of ID among the options */
static const CardSpec history_cards[] = {
    {"card 1", "as many as needed", CARD_FIELDS(history_fields)},
    {"card 1", "with ID, one for each node", CARD_FIELDS(history_id_fields)},
};
static const CardSpec history_set_cards[] = {
    {"card 1", "as many as needed", CARD_FIELDS(history_set_fields)},
    {"card 1", "with ID, one for each set", CARD_FIELDS(history_set_id_fields)},
};

static void read_history_entries(KeywordRead *read, bool is_set)
{
    while (keyword_more(read)) {
        HistoryCard card = {0};
        Source source;
        if (keyword_card(read, keyword_option(read, HISTORY_ID) ? 1 : 0, &card, true, &source)) continue;
        for (int i = 0; i < 8; i++) {
            if (card.id[i] == 0) continue;
            HistoryDefinition *history = KEYWORD_APPEND(read, read->definitions->histories);
            if (!history) return;
            *history = (HistoryDefinition){is_set, card.id[i], source};
        }
    }
}

static void read_history_nodes(KeywordRead *read)
{
    read_history_entries(read, false);
}

static void read_history_sets(KeywordRead *read)
{
    read_history_entries(read, true);
}

#define ASCII_RESULT(result)                                                                                           \
    {                                                                                                                  \
        .name = "*DATABASE_" result, .cards = ascii_cards, .card_count = 1, .read = read_database, .remark = ""        \
    }
static const KeywordSpec specs[] = {
    ASCII_RESULT("ABSTAT"),
    ASCII_RESULT("GCEOUT"),
    ASCII_RESULT("GLSTAT"),
    ASCII_RESULT("MATSUM"),
    ASCII_RESULT("NODOUT"),
    ASCII_RESULT("RBDOUT"),
    ASCII_RESULT("RCFORC"),
    ASCII_RESULT("RWFORC"),
    {.name = "*DATABASE_BINARY_D3PLOT",
     .cards = d3plot_cards,
     .card_count = 2,
     .read = read_database,
     .remark = "Interval of the states in results.vtkhdf. NPLTC > 0 gives DT = ENDTIM / NPLTC."},
    {.name = "*DATABASE_BINARY_D3DUMP",
     .cards = dump_cards,
     .card_count = 1,
     .read = read_database,
     .remark = "Interval of the checkpoints, in cycles."},
    {.name = "*DATABASE_BINARY_RUNRSF",
     .cards = runrsf_cards,
     .card_count = 1,
     .read = read_database,
     .remark = "The checkpoints follow BINARY_D3DUMP; the last one serves for both."},
    {.name = "*DATABASE_HISTORY_NODE",
     .options = {"ID"},
     .cards = history_cards,
     .card_count = 2,
     .read = read_history_nodes,
     .remark = "Nodes written to nodout."},
    {.name = "*DATABASE_HISTORY_NODE_SET",
     .options = {"ID"},
     .cards = history_set_cards,
     .card_count = 2,
     .read = read_history_sets,
     .remark = ""},
};

const KeywordFamily keyword_family_database = {"Database", specs, (int)(sizeof specs / sizeof *specs)};
