/* billow: public names of the program: version, exit codes, limits.
 * Licence: GPL-3.0-or-later. */
#ifndef BILLOW_H
#define BILLOW_H

#define BILLOW_VERSION "0.1.0"

/* Exit codes of the program (docs/user-guide.md); other values are never used. */
enum BillowExit {
    BILLOW_EXIT_NORMAL = 0,      /* normal termination */
    BILLOW_EXIT_FAILED = 1,      /* numerical failure: NaN, negative volume, collapsing step, lost energy */
    BILLOW_EXIT_INPUT = 2,       /* the user's deck or command line is wrong */
    BILLOW_EXIT_ENVIRONMENT = 3, /* file system or memory */
};

enum {
    BILLOW_LANES = 8, /* elements in one block; kernels work on whole blocks */
    BILLOW_MAX_THREADS = 256,
    BILLOW_TITLE_LENGTH = 81, /* deck titles and headings, terminating zero included */
};

#endif
