/* Reference geometry in a run: the constants that hold now, the step by the current geometry, and the energy that a
 * change of the reference brings (docs/theory.md, Reference geometry). */
#ifndef BILLOW_REFERENCE_H
#define BILLOW_REFERENCE_H

#include "elements/kernels.h"
#include "solver/model.h"
#include "solver/state.h"

/* A lane's constants, at stride BILLOW_LANES, fit in so many doubles. */
enum { REFERENCE_LANE_SIZE = (4 * GEOMETRY_POINT_SIZE + GEOMETRY_TAIL_SIZE + GEOMETRY_HOURGLASS_SIZE) * BILLOW_LANES };

/* Constants of an element by the state (stride BILLOW_LANES): the model's, or in own (REFERENCE_LANE_SIZE). number: of
 * the group; place: in the group. */
const double *reference_lane(const Model *model, const State *state, int number, int64_t place, double *own);

/* Constants of a lane after birth into out (stride BILLOW_LANES): share of the initial stretch that is left out (eq.
 * R5, R6); an element that has not been taut and whose liner waits has no weight. */
void reference_constants(const ElementGroup *group, double share, bool reached, int64_t place, double *out);

/* Has the group constants of its own in a run, other than those of the model? */
bool reference_changes_lanes(const ElementGroup *group);

/* Largest squared frequency that the rule of the step asks for, of the blocks [first, end): by the current geometry,
 * but not less than the element's in the mesh (eq. R7), or with RDT by the reference (eq. R8). geometry: the group's
 * constants in use; lane_rate (of these blocks, may be NULL) receives or is raised to each element's. */
double reference_rate(const ElementGroup *group, const double *geometry, int first, int end, const double *x,
                      double *lane_rate);

/* Does (R8) stand in place of the kernels' bound? Else the larger of the two counts. */
bool reference_replaces_rate(const ElementGroup *group);

/* Smallest squared stretch of an element's points at positions x. geometry: the lane's constants. */
double reference_least_square(const ElementGroup *group, const double *geometry, const double *x, int64_t place);

/* Is the fabric of an element in tension at some point? geometry: the lane's constants. */
bool reference_is_taut(const ElementGroup *group, const double *geometry, const double *x, int64_t place);

/* Work of an element's stress at x on the way v dt that led there, exact for forces that act at x (eq. R10a), hourglass
 * control included. geometry: the lane's constants; memory: what its law remembers (stride BILLOW_LANES, unchanged),
 * NULL: untouched material; damped: with the stress of DAMP. */
double reference_work(const ElementGroup *group, const double *geometry, const double *x, const double *v, double dt,
                      const double *memory, bool damped, int64_t place);

/* Work of the stress on the straight way of U from the reference to the element's present stretch (eq. R9). */
double reference_energy(const ElementGroup *group, const double *geometry, const double *x, int64_t place);

#endif
