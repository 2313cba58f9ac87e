/* Solids of rigid parts show, touch and enclose by their outer faces, which become shells without mass. */
#ifndef BILLOW_SOLID_FACES_H
#define BILLOW_SOLID_FACES_H

#include "solver/definitions.h"

/* Adds the faces that only one solid of a part has to the definitions' shells, outward normals, in the order of the
 * solids. 0, or -1 without memory (reported). */
int solid_faces_add(Definitions *definitions, Diagnostics *diagnostics);

#endif
