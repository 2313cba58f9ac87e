/* The effect of *INCLUDE_TRANSFORM on values: id offsets, unit factors, and the composition of nested transforms. */
#ifndef BILLOW_INCLUDE_TRANSFORM_H
#define BILLOW_INCLUDE_TRANSFORM_H

#include "io/card.h"

/* Offsets 0, factors 1, identity. */
IncludeTransform include_transform_identity(void);

/* The value in the units and numbering of the including deck. Ids: 0 stays 0, a negative id keeps its sign. transform
 * may be NULL. */
double include_transform_scale(const IncludeTransform *transform, FieldScale scale, double value);

/* The transform of a file included with inner by a file that is itself included with outer (NULL: the main deck). */
IncludeTransform include_transform_compose(const IncludeTransform *outer, const IncludeTransform *inner);

/* x becomes matrix * (FCTLEN already applied) x: a point of the included file. transform may be NULL. */
void include_transform_point(const IncludeTransform *transform, double x[3]);

/* The same for a direction: no translation. */
void include_transform_direction(const IncludeTransform *transform, double x[3]);

#endif
