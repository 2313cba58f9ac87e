/* The deck as keyword blocks and cards: lexical rules only, no meaning of any keyword.
 *
 * deck text -> DeckBlock (keyword, its lines; comments dropped, includes followed) -> cards read field by field through
 * a table of FieldSpec, in fixed columns, long format or comma free format, with parameters and expressions replaced.
 */
#ifndef BILLOW_CARD_H
#define BILLOW_CARD_H

#include <stdbool.h>
#include <stddef.h>

#include "solver/definitions.h"

typedef struct DeckLine {
    const char *text; /* zero-terminated, tabs expanded to the next multiple of 8 columns, CR and LF removed */
    Source source;
} DeckLine;

/* Offsets and factors of the *INCLUDE_TRANSFORM in effect (already multiplied down nested includes). */
typedef struct IncludeTransform {
    int idnoff, ideoff, idpoff, idmoff, idsoff, idfoff, iddoff, idroff;
    double fctmas, fcttim, fctlen;
    double fcttem, temperature_offset; /* T = fcttem * T as written + temperature_offset (FtoC and the like) */
    double matrix[12]; /* row-major 3 x 4 of *DEFINE_TRANSFORMATION, identity without one; applied after fctlen */
} IncludeTransform;

typedef struct DeckBlock {
    char keyword[80]; /* upper case with the star, format mark (+, -, %) removed: "*MAT_FABRIC_TITLE" */
    bool wide;        /* long format: 20-column fields */
    bool i10;         /* '%': 10-column integer ids on 8-column element cards */
    Source source;    /* of the keyword line */
    const DeckLine *lines;
    size_t line_count;
    const IncludeTransform *transform; /* NULL outside *INCLUDE_TRANSFORM */
    size_t order;                      /* place in the sequence of all blocks: which parameters are defined before */
    int scope;                         /* the inclusion it stands in: which local parameters are seen; 0 main deck */
} DeckBlock;

/* What becomes of a value after it is read: docs/keywords.md is checked against this. */
typedef enum FieldUse {
    FIELD_USED,    /* has its effect */
    FIELD_LISTED,  /* read; a value other than the default is listed as "read but not used" */
    FIELD_REFUSED, /* a value other than the default is an error: the feature is not there yet */
} FieldUse;

/* Which id offset or unit factor of *INCLUDE_TRANSFORM acts on the field. */
typedef enum FieldScale {
    SCALE_NONE,
    SCALE_ID_NODE,
    SCALE_ID_ELEMENT,
    SCALE_ID_PART,
    SCALE_ID_MATERIAL,
    SCALE_ID_SET,
    SCALE_ID_FUNCTION,
    SCALE_ID_DEFINE,
    SCALE_ID_OTHER,
    SCALE_LENGTH,
    SCALE_TIME,
    SCALE_MASS,
    SCALE_DENSITY,
    SCALE_PRESSURE,
    SCALE_VELOCITY,
    SCALE_ACCELERATION,
    SCALE_FORCE,
    SCALE_AREA,
    SCALE_VOLUME,
    SCALE_RATE,
    SCALE_TEMPERATURE,
    SCALE_MASS_FLOW
} FieldScale;

/* One field of a card. type: 'I' int, 'F' double, 'A' text (char array of at least columns + 1), '-' unused column. */
typedef struct FieldSpec {
    const char *name; /* the manual's, upper case */
    char type;
    int columns;          /* width in the standard format; 2 x in long format for 8 and 10, 20 for 16 */
    size_t offset;        /* into the record */
    double fallback;      /* value when blank */
    bool zero_is_default; /* an explicit 0 also means fallback */
    FieldUse use;
    FieldScale scale;
} FieldSpec;

/* Reads line by line through a block. */
typedef struct CardReader {
    const DeckBlock *block;
    size_t next; /* index of the next line */
    struct Parameters *parameters;
    Diagnostics *diagnostics;
} CardReader;

/* True if another card is left. */
bool card_left(const CardReader *reader);

/* The next card's text without consuming it; NULL at the end of the block. */
const DeckLine *card_peek(const CardReader *reader);

/* Reads the next card through the table (count fields) into the record (base of the offsets), applying fallbacks, the
 * transform's offsets and factors, and listing or refusing unused fields. A missing card gives fallbacks and, if
 * required, an error that names the keyword and the card's fields. Returns 0, or -1 if the card was missing (at the
 * block's end) or had an error (already reported with file, line, keyword, field name, columns and what was read).
 * *source (may be NULL) receives the card's place. Numbers may touch without blanks (fixed columns), be written as
 * 1.5-3 or 1.5D-3, as integers in real columns, reals with zero fraction in integer columns; text in numeric columns is
 * an error unless the field's table says 'A'. A comma anywhere makes the card free format. */
int card_read(CardReader *reader, const FieldSpec *fields, int count, void *record, bool required,
              const char *card_name, Source *source);

/* Skips the next card; false at the block's end. */
bool card_skip(CardReader *reader);

/* The next card as a text of at most length - 1 characters, trimmed at the right (titles, headings). */
bool card_text(CardReader *reader, char *text, size_t length);

/* A whole deck split into blocks, includes followed, stops at *END. blocks and lines live until deck_text_free.
 * The loader itself uses up *KEYWORD, *END, *COMMENT, *PARAMETER..., *INCLUDE, *INCLUDE_PATH(_RELATIVE),
 * *INCLUDE_TRANSFORM and *DEFINE_TRANSFORMATION: they are not among the blocks. */
typedef struct DeckText {
    LIST(DeckBlock) blocks;
    struct Parameters *parameters;
    struct TextStore *store; /* owns all text and lines */
} DeckText;

/* Loads path (or text if not NULL, of length bytes). Returns 0, or -1 if something was reported as an error (what could
 * be split is still in deck). */
int deck_text_load(const char *path, const char *text, size_t length, DeckText *deck, Diagnostics *diagnostics);
void deck_text_free(DeckText *deck);

#endif
