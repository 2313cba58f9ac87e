/* Decks of others that tests run as they are, where the shared folder is there. */
#ifndef BILLOW_TESTS_REAL_DECK_H
#define BILLOW_TESTS_REAL_DECK_H

#include <stdio.h>
#include <stdlib.h>

/* The text of a file (*length, to be freed); NULL where there is none. */
static inline char *real_deck_read(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    char *text = malloc(*length + 1);
    if (text && fread(text, 1, *length, file) != *length) *length = 0;
    fclose(file);
    return text;
}

#endif
