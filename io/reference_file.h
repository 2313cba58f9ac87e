/* Reference coordinates as a keyword file: IOUT = 1 of *AIRBAG_REFERENCE_GEOMETRY and _SHELL_REFERENCE_GEOMETRY. */
#ifndef BILLOW_REFERENCE_FILE_H
#define BILLOW_REFERENCE_FILE_H

#include "solver/definitions.h"

#define BILLOW_REFERENCE_NAME "AIRBAG_REFERENCE_GEOMETRY.TRANSFORMED"

/* Writes the coordinates after SX, SY, SZ of all blocks with IOUT = 1 into the folder, a block for each; without such a
 * block removes what an earlier run left. 0, or -1 with an environment error. */
int reference_file_write(const char *directory, const Definitions *definitions, Diagnostics *diagnostics);

#endif
