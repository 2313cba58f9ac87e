/* Reads a deck: its blocks one after the other, each by the reader that the keyword table names. */
#include "io/read.h"

#include <string.h>

#include "io/keyword_table.h"
#include "solver/solid_faces.h"

/* Keywords that others refer to by id: without them "is not defined" would be an echo. */
static bool is_referred_to(const char *keyword)
{
    static const char *const starts[] = {"*NODE", "*PART", "*MAT_", "*SET_", "*DEFINE_", "*SECTION_SHELL"};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (strncmp(keyword, starts[i], strlen(starts[i])) == 0) return true;
    return false;
}

/* A keyword that the table does not have: leaving it out would change the physics, so it is an error. */
static void report_unknown(const DeckBlock *block, const KeywordSpec *base, const char *rest, Definitions *definitions,
                           Diagnostics *diagnostics)
{
    const char *nearest = base ? NULL : keyword_nearest(block->keyword);
    if (is_referred_to(block->keyword)) definitions->incomplete = true;
    if (nearest) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, block->source, block->keyword,
                        "there is no such keyword in billow " BILLOW_VERSION "; did you mean %s?", nearest);
    } else if (base) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, block->source, block->keyword,
                        "the option %s of %s is not read by billow " BILLOW_VERSION
                        "; remove the keyword if the model can do without it, or write it without this option",
                        rest, base->name);
    } else {
        diagnostics_add(diagnostics, SEVERITY_ERROR, block->source, block->keyword,
                        "is not read by billow " BILLOW_VERSION
                        " and would change the result; remove it if the model can do without what it adds");
    }
}

/* Reads one block. Returns false when memory has run out. */
static bool read_block(const DeckText *deck, const DeckBlock *block, Definitions *definitions, Diagnostics *diagnostics)
{
    const KeywordSpec *base;
    const char *rest;
    unsigned options;
    const KeywordSpec *spec = keyword_find(block->keyword, &options, &base, &rest);
    if (!spec) {
        report_unknown(block, base, rest, definitions, diagnostics);
        return true;
    }
    if (spec->state == KEYWORD_IGNORED)
        diagnostics_add(diagnostics, SEVERITY_NOTE, block->source, block->keyword, "is not used: %s", spec->remark);
    if (spec->state == KEYWORD_REFUSED) {
        if (is_referred_to(block->keyword)) definitions->incomplete = true;
        diagnostics_add(diagnostics, SEVERITY_ERROR, block->source, block->keyword,
                        "is not read by billow " BILLOW_VERSION ": %s", spec->remark);
    }
    if (spec->state != KEYWORD_READ) return true;
    const int errors = diagnostics->errors;
    CardReader cards = {block, 0, deck->parameters, diagnostics};
    KeywordRead read = {spec, options, &cards, definitions, false, false};
    spec->read(&read);
    if (diagnostics->errors > errors && !read.kept) definitions->incomplete = true;
    return !read.out_of_memory;
}

/* Reads all blocks of a loaded deck and checks what needs all of them. */
static void read_blocks(const DeckText *deck, Definitions *definitions, Diagnostics *diagnostics)
{
    for (size_t i = 0; i < deck->blocks.count; i++)
        if (!read_block(deck, &deck->blocks.items[i], definitions, diagnostics)) return;
    keyword_check_duplicates(definitions, diagnostics);
    keyword_check_references(definitions, diagnostics);
    solid_faces_add(definitions, diagnostics);
}

static int read_deck(const char *name, const char *text, size_t length, Definitions *definitions,
                     Diagnostics *diagnostics)
{
    const int before = diagnostics->errors + diagnostics->environment;
    DeckText deck = {0};
    if (deck_text_load(name, text, length, &deck, diagnostics)) definitions->incomplete = true;
    read_blocks(&deck, definitions, diagnostics);
    if (deck.blocks.count == 0 && diagnostics->errors + diagnostics->environment == before)
        diagnostics_add(diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "%s holds no keywords; is it an LS-DYNA keyword deck?", name);
    deck_text_free(&deck);
    return diagnostics->errors + diagnostics->environment == before ? 0 : -1;
}

int deck_read(const char *path, Definitions *definitions, Diagnostics *diagnostics)
{
    return read_deck(path, NULL, 0, definitions, diagnostics);
}

int deck_read_text(const char *name, const char *text, size_t length, Definitions *definitions,
                   Diagnostics *diagnostics)
{
    return read_deck(name, text ? text : "", length, definitions, diagnostics);
}
