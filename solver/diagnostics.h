/* Messages about the user's input and the run, collected in one list, each with file, line and keyword. */
#ifndef BILLOW_DIAGNOSTICS_H
#define BILLOW_DIAGNOSTICS_H

#include <stdbool.h>
#include <stdio.h>

/* Where a value of the deck was written. file indexes Diagnostics.files; line counts from 1; {-1, 0} = no place. */
typedef struct Source {
    int file;
    int line;
} Source;

#define BILLOW_NO_SOURCE ((Source){-1, 0})

typedef enum Severity {
    SEVERITY_NOTE,        /* what was read but has no effect, what billow chose */
    SEVERITY_WARNING,     /* the run goes on, the user should look */
    SEVERITY_ERROR,       /* the deck is wrong: exit 2 */
    SEVERITY_ENVIRONMENT, /* file system or memory: exit 3 */
} Severity;

typedef struct Message {
    Severity severity;
    Source source;
    char keyword[64]; /* "*NODE", or "" */
    char *text;       /* what is wrong and what to do */
} Message;

typedef struct Diagnostics {
    Message *messages;
    size_t count, capacity;
    char **files; /* names of the deck's files as the user knows them */
    size_t file_count, file_capacity;
    int errors, warnings, notes, environment; /* counts by severity, stored or not */
    int suppressed; /* errors beyond the 200th, counted and not stored; likewise warnings and notes beyond the 1000th */
} Diagnostics;

void diagnostics_free(Diagnostics *diagnostics);

/* Registers a deck file and returns its index for Source.file, -1 without memory. */
int diagnostics_add_file(Diagnostics *diagnostics, const char *name);

/* Adds one message; keyword may be NULL. Text in printf form, one or two sentences, no final newline. */
void diagnostics_add(Diagnostics *diagnostics, Severity severity, Source source, const char *keyword,
                     const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Prints one message as compilers do: `FILE:LINE: error: *KEYWORD: text`. */
void diagnostics_print_message(const Diagnostics *diagnostics, const Message *message, FILE *stream);

/* Prints all messages of at least the given severity, in deck order within equal severity. */
void diagnostics_print(const Diagnostics *diagnostics, Severity least, FILE *stream);

/* BILLOW_EXIT_NORMAL, BILLOW_EXIT_INPUT or BILLOW_EXIT_ENVIRONMENT by what was collected. */
int diagnostics_exit_code(const Diagnostics *diagnostics);

#endif
