/* A folder of deck files for the tests of includes: group fixtures make and remove it. */
#ifndef BILLOW_TESTS_DECK_FOLDER_H
#define BILLOW_TESTS_DECK_FOLDER_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* nftw */
#endif
#include "tests/deck_case.h"

#include <ftw.h>
#include <stdlib.h>

static char folder[] = "decks-XXXXXX";

static inline int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static inline int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status, (void)kind, (void)place;
    return remove(path);
}

static inline int remove_folder(void **state)
{
    (void)state;
    return nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

/* folder/name, in a static inline buffer of its own for each of four calls. */
static const char *path_of(const char *name)
{
    static char paths[4][200];
    static int next;
    next = (next + 1) % 4;
    snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
    return paths[next];
}

static inline void write_file(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static inline DeckCase load_file(const char *name)
{
    DeckCase c = {0};
    c.status = deck_text_load(path_of(name), NULL, 0, &c.deck, &c.diagnostics);
    return c;
}

/* Loads the text as bad.k: one error on that line of it. */
static inline void assert_bad_include(const char *text, int line, const char *part)
{
    write_file("bad.k", text);
    DeckCase c = load_file("bad.k");
    assert_int_equal(c.status, -1);
    assert_only_message(&c, SEVERITY_ERROR, line, part);
    assert_string_equal(c.diagnostics.files[c.diagnostics.messages[0].source.file], path_of("bad.k"));
    close_case(&c);
}

#endif
