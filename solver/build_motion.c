/* Builds all motion in order, renumbers it, marks its nodes, releases it. */
#include "solver/build_motion.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/motion_input.h"

/* Mass and inertia of the moving bodies. */
static int weigh_bodies(const MotionInput *input, const double *mass, Motion *motion, Diagnostics *diagnostics)
{
    int status = 0;
    for (int b = 0; b < motion->rigid_body_count; b++) {
        RigidBody *body = &motion->rigid_bodies[b];
        int result = rigid_body_build(body, input->x, mass);
        if (result < 0) return motion_no_memory("*MAT_RIGID", diagnostics);
        int given = rigid_inertia_apply(input, body, diagnostics);
        if (given < 0) status = -1;
        if (given > 0) rigid_inertia_check(input, motion, b, diagnostics);
        if (result == 0 || given != 0) continue;
        int32_t part = id_map_find(&input->index->parts, body->part_id);
        Source source = BILLOW_NO_SOURCE;
        if (part >= 0) source = input->index->definitions->parts.items[part].source;
        diagnostics_add(diagnostics, SEVERITY_ERROR, source, part >= 0 ? "*PART" : "*CONSTRAINED_NODAL_RIGID_BODY",
                        "rigid %s %d has no mass and cannot move; give its material a density RO and its section a "
                        "thickness, or use the option INERTIA",
                        part >= 0 ? "part" : "body", body->part_id);
        status = -1;
    }
    return status;
}

int build_motion(const MotionInput *input, double *mass, Motion *motion, Diagnostics *diagnostics)
{
    MotionInput weighed = *input;
    weighed.node_mass = mass;
    int status = build_rigid_bodies(input, motion, diagnostics);
    if (build_constraints(input, motion, diagnostics)) status = -1;
    /* Velocities need sound bodies; loads need sound constraints for the shares of hanging nodes. */
    if (status == 0) {
        constraints_fold_mass(&motion->constraints, mass);
        status = weigh_bodies(input, mass, motion, diagnostics);
    }
    if (build_velocities(input, mass, motion, diagnostics)) status = -1;
    if (build_loads(&weighed, motion, diagnostics)) status = -1;
    return status;
}

void motion_mark_special(const Motion *motion, unsigned char *special)
{
    const Constraints *constraints = &motion->constraints;
    for (int s = 0; s < constraints->support_count; s++) special[constraints->supports[s].node] = 1;
    for (int m = 0; m < constraints->node_motion_count; m++) special[constraints->motions[m].node] = 1;
    for (int h = 0; h < constraints->hanging_count; h++) {
        special[constraints->hanging[h].node] = 1;
        special[constraints->hanging[h].end[0]] = special[constraints->hanging[h].end[1]] = 1;
    }
    for (int b = 0; b < motion->rigid_body_count; b++) {
        for (int k = 0; k < motion->rigid_bodies[b].node_count; k++) special[motion->rigid_bodies[b].node[k]] = 1;
    }
    for (int k = 0; k < motion->loads.node_load_count; k++) special[motion->loads.node_loads[k].node] = 1;
}

static void renumber_constraints(Constraints *constraints, const int32_t *new_index)
{
    for (int s = 0; s < constraints->support_count; s++)
        constraints->supports[s].node = new_index[constraints->supports[s].node];
    if (constraints->support_count > 1)
        qsort(constraints->supports, (size_t)constraints->support_count, sizeof *constraints->supports,
              motion_compare_supports);
    for (int m = 0; m < constraints->node_motion_count; m++)
        constraints->motions[m].node = new_index[constraints->motions[m].node];
    if (constraints->motion_count > 1)
        qsort(constraints->motions, (size_t)constraints->motion_count, sizeof *constraints->motions,
              motion_compare_motions);
    for (int h = 0; h < constraints->hanging_count; h++) {
        HangingNode *hanging = &constraints->hanging[h];
        hanging->node = new_index[hanging->node];
        for (int e = 0; e < 2; e++) hanging->end[e] = new_index[hanging->end[e]];
    }
}

typedef struct BodyNode {
    int32_t node;
    double offset[3];
} BodyNode;

static int compare_body_nodes(const void *a, const void *b)
{
    const BodyNode *p = a, *q = b;
    return (p->node > q->node) - (p->node < q->node);
}

/* scratch: room for the largest body. */
static void renumber_body(RigidBody *body, const int32_t *new_index, BodyNode *scratch)
{
    for (int k = 0; k < body->node_count; k++) {
        scratch[k].node = new_index[body->node[k]];
        if (body->offset) memcpy(scratch[k].offset, body->offset + 3 * (size_t)k, sizeof scratch[k].offset);
    }
    qsort(scratch, (size_t)body->node_count, sizeof *scratch, compare_body_nodes);
    for (int k = 0; k < body->node_count; k++) {
        body->node[k] = scratch[k].node;
        if (body->offset) memcpy(body->offset + 3 * (size_t)k, scratch[k].offset, sizeof scratch[k].offset);
    }
}

/* Moves items of size bytes to their nodes' new places, through scratch. */
static void permute(void *array, size_t size, int count, const int32_t *new_index, unsigned char *scratch)
{
    if (!array) return;
    unsigned char *bytes = array;
    for (int n = 0; n < count; n++) memcpy(scratch + (size_t)new_index[n] * size, bytes + (size_t)n * size, size);
    memcpy(bytes, scratch, (size_t)count * size);
}

int motion_renumber(Motion *motion, const int32_t *new_index)
{
    size_t largest = 0, nodes = (size_t)motion->node_count;
    for (int b = 0; b < motion->rigid_body_count; b++) {
        if ((size_t)motion->rigid_bodies[b].node_count > largest) largest = (size_t)motion->rigid_bodies[b].node_count;
    }
    BodyNode *body_scratch = memory_alloc(largest + 1, sizeof *body_scratch);
    unsigned char *scratch = memory_alloc(nodes + 1, 3 * sizeof(double));
    if (!body_scratch || !scratch) {
        memory_free(body_scratch);
        memory_free(scratch);
        return -1;
    }
    renumber_constraints(&motion->constraints, new_index);
    for (int k = 0; k < motion->loads.node_load_count; k++) {
        NodeLoad *load = &motion->loads.node_loads[k];
        load->node = new_index[load->node];
        for (int i = 0; i < 3 && load->follower; i++) load->m[i] = new_index[load->m[i]];
    }
    for (int k = 0; k < motion->loads.rigid_load_count; k++) {
        RigidLoad *load = &motion->loads.rigid_loads[k];
        for (int i = 0; i < 3 && load->follower; i++) load->m[i] = new_index[load->m[i]];
    }
    for (int b = 0; b < motion->rigid_body_count; b++) renumber_body(&motion->rigid_bodies[b], new_index, body_scratch);
    for (int s = 0; s < 4 * motion->segment_count; s++) motion->segment_node[s] = new_index[motion->segment_node[s]];
    permute(motion->node_class, sizeof *motion->node_class, motion->node_count, new_index, scratch);
    permute(motion->fixed, sizeof *motion->fixed, motion->node_count, new_index, scratch);
    permute(motion->velocity, 3 * sizeof *motion->velocity, motion->node_count, new_index, scratch);
    permute(motion->node_body, sizeof *motion->node_body, motion->node_count, new_index, scratch);
    memory_free(body_scratch);
    memory_free(scratch);
    return 0;
}

void motion_free(Motion *motion)
{
    memory_free(motion->constraints.supports);
    memory_free(motion->constraints.motions);
    memory_free(motion->constraints.hanging);
    memory_free(motion->loads.node_loads);
    memory_free(motion->loads.rigid_loads);
    memory_free(motion->loads.classes);
    memory_free(motion->node_class);
    memory_free(motion->fixed);
    memory_free(motion->velocity);
    memory_free(motion->part_body);
    memory_free(motion->node_body);
    for (int b = 0; b < motion->rigid_body_count; b++) {
        memory_free(motion->rigid_bodies[b].node);
        memory_free(motion->rigid_bodies[b].offset);
    }
    memory_free(motion->rigid_bodies);
    memory_free(motion->segment_loads);
    memory_free(motion->segment_node);
    memory_free(motion->segment_load);
    memory_free(motion->segment_source);
    *motion = (Motion){0};
}
