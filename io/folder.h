/* The folder of results: made, taken over from an earlier run, or refused. */
#ifndef BILLOW_FOLDER_H
#define BILLOW_FOLDER_H

#include <stdbool.h>

#include "solver/diagnostics.h"

/* What stands at the folder's path before a run. */
typedef enum FolderState {
    FOLDER_MISSING, /* nothing: it will be made */
    FOLDER_EMPTY,   /* an empty folder */
    FOLDER_OURS,    /* results of an earlier run of billow: its log.txt says so */
    FOLDER_FOREIGN, /* something else: nothing in it may be touched */
} FolderState;

FolderState folder_inspect(const char *directory);

/* True if file lies directly in directory. */
bool folder_contains(const char *directory, const char *file);

/* Makes the folder ready: makes it (its parent must exist) or, with keep false, removes checkpoint, summary and log of
 * an earlier run of billow (the results themselves are removed by results_open). Files that billow does not write are
 * left. Returns 0, or -1 with an error in diagnostics: a foreign folder is an input error, the rest environment errors.
 */
int folder_claim(const char *directory, bool keep, Diagnostics *diagnostics);

#endif
