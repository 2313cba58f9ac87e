/* Runs the built program in a folder of its own and shows tests what it did. */
#ifndef BILLOW_TESTS_PROGRAM_H
#define BILLOW_TESTS_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "examples/scene.h"

enum { PROGRAM_TEXT = 1 << 16 };

/* One folder, in which every run takes place, and the outcome of the last run. */
typedef struct Program {
    char folder[64];
    pid_t process;          /* of a run in progress, else 0 */
    int code;               /* exit code, -1 if a signal killed it */
    char out[PROGRAM_TEXT]; /* standard output (cut off) */
    char err[PROGRAM_TEXT]; /* standard error (cut off) */
} Program;

/* Makes the folder, below the working directory. */
void program_open(Program *program);
/* Removes the folder with all that is in it. */
void program_close(Program *program);

/* Runs the program with the words of line (split at blanks, no quoting) and waits. Returns the exit code. */
int program_run(Program *program, const char *line);

/* Starts it, and waits for it. */
void program_start(Program *program, const char *line);
int program_wait(Program *program);

/* Sleeps until name exists in the folder (or the run ends); false after 20 s. */
bool program_wait_for(Program *program, const char *name);

/* Writes a file into the folder. */
void program_write(const Program *program, const char *name, const void *data, size_t size);
/* Reads at most size - 1 bytes of a file of the folder, zero-terminated; false if it is not there. */
bool program_read(const Program *program, const char *name, char *text, size_t size);
bool program_exists(const Program *program, const char *name);
/* Entries of the folder. */
int program_count(const Program *program);

/* A closed bag for these tests: a sphere of 6 n^2 quads of fabric, full of air, that is blown up for 0.1 s. */
void program_make_bag(Scene *scene, int n);

/* Writes that bag's deck as name; add is put before *END (NULL: nothing). */
void program_write_bag(const Program *program, const char *name, int n, const char *add);

/* The last line of text, without its newline, in a buffer of its own. */
const char *program_last_line(const char *text);

/* The value of a member of DIR/summary.json as it is written there (quotes included), in a buffer of its own. */
const char *program_summary(const Program *program, const char *directory, const char *member);

#endif
