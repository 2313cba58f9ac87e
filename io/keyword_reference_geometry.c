/* *AIRBAG_REFERENCE_GEOMETRY and *AIRBAG_SHELL_REFERENCE_GEOMETRY. */
#include "io/keyword_table.h"

#define AT(member) offsetof(ReferenceBlockDefinition, member)
#define ID_FIELDS(origin)                                                                                              \
    {                                                                                                                  \
        CARD_INT("ID", id, USED, NONE), CARD_REAL_OR("SX", sx, 1.0, USED, NONE),                                       \
            CARD_REAL_OR("SY", sy, 1.0, USED, NONE), CARD_REAL_OR("SZ", sz, 1.0, USED, NONE),                          \
            CARD_INT(origin, nid, USED, ID_NODE), CARD_INT("IOUT", iout, USED, NONE),                                  \
    }
static const FieldSpec node_id_fields[] = ID_FIELDS("NIDO");
static const FieldSpec shell_id_fields[] = ID_FIELDS("NID");
static const FieldSpec birth_fields[] = {CARD_REAL("BIRTH", birth, USED, TIME)};
#undef AT

#define AT(member) offsetof(ReferenceNodeDefinition, member)
static const FieldSpec node_fields[] = {
    {"NID", 'I', 8, AT(id), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"X", 'F', 16, AT(x[0]), 0.0, false, FIELD_USED, SCALE_LENGTH},
    {"Y", 'F', 16, AT(x[1]), 0.0, false, FIELD_USED, SCALE_LENGTH},
    {"Z", 'F', 16, AT(x[2]), 0.0, false, FIELD_USED, SCALE_LENGTH},
};
#undef AT

#define AT(member) offsetof(ReferenceShellDefinition, member)
static const FieldSpec shell_fields[] = {
    {"EID", 'I', 8, AT(id), 0.0, false, FIELD_USED, SCALE_ID_ELEMENT},
    {"PID", 'I', 8, AT(part), 0.0, false, FIELD_USED, SCALE_ID_PART},
    {"N1", 'I', 8, AT(node[0]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N2", 'I', 8, AT(node[1]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N3", 'I', 8, AT(node[2]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
    {"N4", 'I', 8, AT(node[3]), 0.0, false, FIELD_USED, SCALE_ID_NODE},
};
#undef AT

enum { OPTION_ID, OPTION_RDT, OPTION_BIRTH };

static const CardSpec node_cards[] = {
    {"ID card", "with ID", CARD_FIELDS(node_id_fields)},
    {"card 1", "with BIRTH", CARD_FIELDS(birth_fields)},
    {"card 2", "one for each node", CARD_FIELDS(node_fields)},
};
static const CardSpec shell_cards[] = {
    {"ID card", "with ID", CARD_FIELDS(shell_id_fields)},
    {"card 2", "one for each shell", CARD_FIELDS(shell_fields)},
};

/* The cards before the records; -1 after an error. */
static int read_head(KeywordRead *read, ReferenceBlockDefinition *block)
{
    int status = 0;
    block->source = block->id_source = read->cards->block->source;
    block->rdt = keyword_option(read, OPTION_RDT);
    block->sx = block->sy = block->sz = 1.0;
    if (keyword_option(read, OPTION_ID)) status = keyword_card(read, 0, block, true, &block->id_source);
    if (!status && block->iout != 0 && block->iout != 1) {
        keyword_error(read, block->id_source, "IOUT is %d, but must be 0 or 1", block->iout);
        status = -1;
    }
    Source source;
    block->has_birth = !block->is_shell && keyword_option(read, OPTION_BIRTH);
    if (block->has_birth && keyword_card(read, 1, block, true, &source)) return -1;
    if (block->birth < 0.0) {
        keyword_error(read, source, "BIRTH is %g, but must not be negative", block->birth);
        status = -1;
    }
    return status;
}

static void store_block(KeywordRead *read, const ReferenceBlockDefinition *block, const char *records)
{
    if (block->count == 0) {
        keyword_warning(read, block->source, "names no %s: it has no effect", records);
        return;
    }
    ReferenceBlockDefinition *kept = KEYWORD_APPEND(read, read->definitions->reference_blocks);
    if (kept) *kept = *block;
}

static void read_nodes(KeywordRead *read)
{
    ReferenceBlockDefinition block = {.first = read->definitions->reference_nodes.count};
    read->kept = true; /* nothing else names these records */
    const int head = read_head(read, &block), errors = read->cards->diagnostics->errors;
    while (keyword_more(read) && !read->out_of_memory) {
        ReferenceNodeDefinition card = {0};
        if (keyword_card(read, 2, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, "NID", card.source)) continue;
        keyword_transform_point(read, card.x);
        ReferenceNodeDefinition *node = KEYWORD_APPEND(read, read->definitions->reference_nodes);
        if (!node) return;
        *node = card;
        block.count++;
    }
    if (!head && (block.count > 0 || read->cards->diagnostics->errors == errors)) store_block(read, &block, "node");
}

static void read_shells(KeywordRead *read)
{
    ReferenceBlockDefinition block = {.is_shell = true, .first = read->definitions->reference_shells.count};
    read->kept = true; /* nothing else names these records */
    const int head = read_head(read, &block), errors = read->cards->diagnostics->errors;
    while (keyword_more(read) && !read->out_of_memory) {
        ReferenceShellDefinition card = {0};
        if (keyword_card(read, 1, &card, true, &card.source)) continue;
        if (!keyword_check_id(read, card.id, "EID", card.source)) continue;
        ReferenceShellDefinition *shell = KEYWORD_APPEND(read, read->definitions->reference_shells);
        if (!shell) return;
        *shell = card;
        block.count++;
    }
    if (!head && (block.count > 0 || read->cards->diagnostics->errors == errors)) store_block(read, &block, "shell");
}

static const KeywordSpec specs[] = {
    {.name = "*AIRBAG_REFERENCE_GEOMETRY",
     .options = {"ID", "RDT", "BIRTH"},
     .cards = node_cards,
     .card_count = 3,
     .read = read_nodes,
     .remark = "For shells of *MAT_FABRIC. Nodes that are not named keep their place under *NODE. One birth time, the "
               "last BIRTH read, holds for all blocks with BIRTH; RGBRTH of *MAT_FABRIC goes before it. IOUT = 1 "
               "writes the coordinates after SX, SY, SZ to AIRBAG_REFERENCE_GEOMETRY.TRANSFORMED in the folder "
               "of the results."},
    {.name = "*AIRBAG_SHELL_REFERENCE_GEOMETRY",
     .options = {"ID", "RDT"},
     .cards = shell_cards,
     .card_count = 2,
     .read = read_shells,
     .remark = "For shells of *MAT_FABRIC; they go before *AIRBAG_REFERENCE_GEOMETRY, which may place their nodes. "
               "PID is not used. The birth time is RGBRTH of *MAT_FABRIC. IOUT as there."},
};

const KeywordFamily keyword_family_reference_geometry = {"Reference geometry", specs,
                                                         (int)(sizeof specs / sizeof *specs)};
