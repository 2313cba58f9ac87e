/* Where the fields of a card stand: widths by format, and numbers that lie across two fields. */
#ifndef BILLOW_CARD_LAYOUT_H
#define BILLOW_CARD_LAYOUT_H

#include "io/card.h"
#include "io/field.h"

/* Columns of the field in the block's format: long format makes numbers and short texts 20 wide and doubles long texts;
 * '%' makes 8 columns 10. */
size_t card_field_width(const DeckBlock *block, const FieldSpec *spec);

/* True for headings and file names, which may hold commas. */
bool card_is_long_text(const FieldSpec *spec);

/* How many columns are searched for the comma that makes a line free format: those before a long text at the end. */
size_t card_comma_columns(const DeckBlock *block, const FieldSpec *fields, int count);

/* A fixed-format line in which a number lies across the border of two numeric fields, as after a slip of a few columns:
 * the index of the first of the two, or -1. Numbers may touch legally, so the sign of a slip is a number that leaves
 * blanks both before it in the one field and behind it in the other, on a line that is not set flush left. */
int card_find_split_number(const DeckBlock *block, const char *line, const FieldSpec *fields, int count);

/* The number that lies across field number split and the next, with the columns that it occupies. */
Field card_split_number(const DeckBlock *block, const char *line, const FieldSpec *fields, int split);

#endif
