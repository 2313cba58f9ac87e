/* Reads an LS-DYNA keyword deck into Definitions. */
#ifndef BILLOW_READ_H
#define BILLOW_READ_H

#include <stddef.h>

#include "solver/definitions.h"

/* Reads the file and everything it includes. Every error, warning and note goes to diagnostics; returns 0 when none of
 * them is an error, -1 otherwise (what could be read is then still in definitions, so that the build can look for more
 * errors and all surface together). The path as given becomes file 0. */
int deck_read(const char *path, Definitions *definitions, Diagnostics *diagnostics);

/* The same from memory (tests, fuzzing): name stands for the file; *INCLUDE is looked up relative to name's folder. */
int deck_read_text(const char *name, const char *text, size_t length, Definitions *definitions,
                   Diagnostics *diagnostics);

#endif
