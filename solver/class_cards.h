/* What the cards of gravity and mass damping ask for (solver/build_class_cards.c). */
#ifndef BILLOW_CLASS_CARDS_H
#define BILLOW_CLASS_CARDS_H

#include "solver/class_table.h"
#include "solver/motion_input.h"

/* What acts on each part by itself, and what acts on all. */
typedef struct ClassCards {
    BodyClass *of_part; /* (part count) */
    BodyClass everywhere;
} ClassCards;

/* Adds the deck's cards to cleared ones. 0, or -1 with diagnostics. */
int class_cards_read(const MotionInput *input, ClassCards *cards, Diagnostics *diagnostics);

/* A class with more terms than it has room for; false. */
bool class_report_full(const char *keyword, Source source, Diagnostics *diagnostics);

#endif
