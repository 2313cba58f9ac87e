/* What the builders of motion share: nodes and curves by the ids of a card, with their messages. */
#ifndef BILLOW_MOTION_INPUT_H
#define BILLOW_MOTION_INPUT_H

#include "solver/build_motion.h"

/* Death times from here on mean "never" (LS-DYNA's default is 1e20 or 1e28). */
#define BILLOW_NEVER 1e19

/* Whether build_rigid_bodies had the memory for its arrays; without them the other builders do nothing. */
static inline bool motion_ready(const Motion *motion)
{
    return motion->part_body && motion->node_body && motion->fixed && motion->velocity && motion->rigid_bodies;
}

/* Reports that memory is short; returns -1. */
int motion_no_memory(const char *keyword, Diagnostics *diagnostics);

/* The material of a part (deck index) if it is rigid, else NULL. */
const MaterialDefinition *rigid_material(const MotionInput *input, int32_t part);

/* lead[p]: the part whose body part p belongs to after *CONSTRAINED_RIGID_BODIES (solver/build_merges.c). 0, or -1
 * after an error. */
int rigid_merges_resolve(const MotionInput *input, int32_t *lead, Diagnostics *diagnostics);

/* Puts the mass, centre, inertia and initial motion of the body's card, if it has one, in place of those of its nodes;
 * offset must be allocated (solver/build_inertia.c). 1 if it had one, 0 if not, -1 after an error. */
int rigid_inertia_apply(const MotionInput *input, RigidBody *body, Diagnostics *diagnostics);

/* Warns where the card of a body gives less mass or inertia than deformable shells put on its nodes: their bound of the
 * stable step does not hold then. number: of the body (solver/build_inertia.c). */
void rigid_inertia_check(const MotionInput *input, const Motion *motion, int number, Diagnostics *diagnostics);

/* Body of a rigid part or nodal rigid body by the user's id: its index, MOTION_FIXED, MOTION_DEFORMABLE, or -3 if there
 * is neither a part nor a body of this id. */
int motion_find_body(const MotionInput *input, const Motion *motion, int id);

/* Index of node id, or -1 after an error naming the field. */
int32_t motion_find_node(const MotionInput *input, int id, const char *field, Source source, const char *keyword,
                         Diagnostics *diagnostics);

/* One node, or the nodes of a set, into out. Returns 0, or -1 after an error. */
int motion_find_nodes(const MotionInput *input, bool is_set, int id, Source source, const char *keyword, IndexList *out,
                      Diagnostics *diagnostics);

/* One part, or the parts of a set, into out. Returns 0, or -1 after an error. */
int motion_find_parts(const MotionInput *input, bool is_set, int id, Source source, const char *keyword, IndexList *out,
                      Diagnostics *diagnostics);

/* The curve's index; -1 after an error; -2 if it acts in dynamic relaxation only (SIDR = 1), with a note that the card
 * then has no effect. */
int motion_find_curve(const MotionInput *input, int id, const char *field, Source source, const char *keyword,
                      Diagnostics *diagnostics);

/* Local axes of CID (rows; identity for 0): -1 after an error, also if the system moves with the model. */
int motion_find_axes(const MotionInput *input, int cid, Source source, const char *keyword, double axes[9],
                     Diagnostics *diagnostics);

/* Orders for qsort: supports by node, time and frame; motions of nodes by node, then of bodies, each in deck order. */
int motion_compare_supports(const void *a, const void *b);
int motion_compare_motions(const void *a, const void *b);

/* *CONSTRAINED_ADAPTIVITY; called by build_constraints when supports and motions are there, drops those of hanging
 * nodes (solver/build_hanging.c). */
int build_hanging_nodes(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* *BOUNDARY_PRESCRIBED_MOTION into motion->constraints (solver/build_prescribed.c). */
int build_prescribed_motions(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* *LOAD_RIGID_BODY into motion->loads (solver/build_rigid_loads.c). */
int build_rigid_loads(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* *BOUNDARY_SPC and TC codes into motion->constraints (solver/build_supports.c). */
int build_supports(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

/* Gravity and damping into motion->loads.classes and ->node_class (solver/build_classes.c). */
int build_body_classes(const MotionInput *input, Motion *motion, Diagnostics *diagnostics);

#endif
