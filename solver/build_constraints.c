/* Supports, prescribed motion and hanging nodes together: which nodes never move, who goes before whom. */
#include <stddef.h>

#include "solver/memory.h"
#include "solver/motion_input.h"
#include "solver/rate_rows.h"

/* Bits of what holds a node. */
enum { HELD = 1, DRIVEN = 2, HANGING = 4 };

static void mark_holds(const Constraints *constraints, unsigned char *hold)
{
    for (int s = 0; s < constraints->support_count; s++) hold[constraints->supports[s].node] |= HELD;
    for (int m = 0; m < constraints->node_motion_count; m++) hold[constraints->motions[m].node] |= DRIVEN;
}

/* Nodes held in all directions for ever, and not driven, never move. */
static void find_fixed(Motion *motion, const unsigned char *hold)
{
    const Constraints *constraints = &motion->constraints;
    for (int s = 0; s < constraints->support_count;) {
        int32_t node = constraints->supports[s].node;
        RateRows rows = {0};
        for (; s < constraints->support_count && constraints->supports[s].node == node; s++) {
            const Support *support = &constraints->supports[s];
            if (support->birth > 0 || support->death < BILLOW_NEVER) continue;
            for (int i = 0; i < 3; i++) {
                if (support->fixed[i]) rate_rows_add(&rows, support->axes + 3 * i, 0);
            }
        }
        if (rows.count == 3 && !(hold[node] & DRIVEN)) motion->fixed[node] = 1;
    }
}

/* Hanging nodes follow their edge: a warning where the edge is not held as the node is. */
static void settle_hanging(const MotionInput *input, Motion *motion, unsigned char *hold, Diagnostics *diagnostics)
{
    const Constraints *constraints = &motion->constraints;
    for (int h = 0; h < constraints->hanging_count; h++) {
        const HangingNode *hanging = &constraints->hanging[h];
        unsigned char own = hold[hanging->node] & (HELD | DRIVEN);
        bool follows = true;
        for (int e = 0; e < 2; e++) {
            int32_t end = hanging->end[e];
            if (!motion->fixed[end] && (hold[end] & own) != own) follows = false;
        }
        if (own && !follows) {
            diagnostics_add(
                diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, "*CONSTRAINED_ADAPTIVITY",
                "node %d hangs on an edge and is held or driven itself, but its edge is not; it follows the "
                "edge",
                input->index->definitions->nodes.items[hanging->node].id);
        }
        hold[hanging->node] |= HANGING;
    }
}

/* Takes out supports of fixed and hanging nodes and motions of hanging ones. */
static void drop_overruled(Motion *motion, const unsigned char *hold)
{
    Constraints *constraints = &motion->constraints;
    int kept = 0;
    for (int s = 0; s < constraints->support_count; s++) {
        int32_t node = constraints->supports[s].node;
        if (motion->fixed[node] || (hold[node] & HANGING)) continue;
        constraints->supports[kept++] = constraints->supports[s];
    }
    constraints->support_count = kept;
    kept = 0;
    int kept_nodes = 0;
    for (int m = 0; m < constraints->motion_count; m++) {
        int32_t node = constraints->motions[m].node;
        if (node >= 0 && (hold[node] & HANGING)) continue;
        if (node >= 0) kept_nodes++;
        constraints->motions[kept++] = constraints->motions[m];
    }
    constraints->motion_count = kept;
    constraints->node_motion_count = kept_nodes;
}

/* A motion along a held direction goes before the support: say so once. */
static void warn_driven_supports(const MotionInput *input, const Motion *motion, Diagnostics *diagnostics)
{
    const Constraints *constraints = &motion->constraints;
    int first = -1, count = 0;
    for (int s = 0, m = 0; s < constraints->support_count; s++) {
        const Support *support = &constraints->supports[s];
        while (m < constraints->node_motion_count && constraints->motions[m].node < support->node) m++;
        bool clash = false;
        for (int k = m; k < constraints->node_motion_count && constraints->motions[k].node == support->node; k++) {
            const PrescribedMotion *driven = &constraints->motions[k];
            RateRows rows = {0};
            rate_rows_add(&rows, driven->direction, 0);
            if (!(support->birth < driven->death && driven->birth < support->death)) continue;
            for (int i = 0; i < 3; i++) {
                if (support->fixed[i] && !rate_rows_add(&rows, support->axes + 3 * i, 0)) clash = true;
            }
        }
        if (!clash) continue;
        if (count++ == 0) first = support->node;
    }
    if (count == 0) return;
    diagnostics_add(
        diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, "*BOUNDARY_PRESCRIBED_MOTION",
        "%d node(s), first %d, are both held and driven in the same direction; the prescribed motion is taken", count,
        input->index->definitions->nodes.items[first].id);
}

int build_constraints(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    if (!motion_ready(motion)) return -1;
    unsigned char *hold = memory_alloc((size_t)motion->node_count + 1, sizeof *hold);
    if (!hold) return motion_no_memory("*BOUNDARY_SPC", diagnostics);
    int status = build_supports(input, motion, diagnostics);
    if (build_prescribed_motions(input, motion, diagnostics)) status = -1;
    mark_holds(&motion->constraints, hold);
    find_fixed(motion, hold);
    if (build_hanging_nodes(input, motion, diagnostics)) status = -1;
    settle_hanging(input, motion, hold, diagnostics);
    drop_overruled(motion, hold);
    warn_driven_supports(input, motion, diagnostics);
    memory_free(hold);
    return status;
}
