/* *LOAD_RIGID_BODY into the loads of moving rigid bodies. */
#include <stddef.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/motion_input.h"

static const char KEYWORD[] = "*LOAD_RIGID_BODY";

/* DOF, CID and the follower's nodes. */
static int read_direction(const MotionInput *input, const RigidLoadDefinition *card, RigidLoad *load,
                          Diagnostics *diagnostics)
{
    static const char *const fields[] = {"M1", "M2", "M3"};
    const int ids[3] = {card->m1, card->m2, card->m3};
    if (card->dof < 1 || card->dof > 8) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
                        "DOF = %d is no degree of freedom; use 1, 2, 3 for a force along x, y, z, 5, 6, 7 for a "
                        "moment, 4 or 8 for a force or moment that follows the plane of M1, M2, M3",
                        card->dof);
        return -1;
    }
    load->moment = card->dof > 4;
    load->follower = card->dof % 4 == 0;
    if (load->follower) {
        int status = 0;
        for (int k = 0; k < 3; k++) {
            load->m[k] = motion_find_node(input, ids[k], fields[k], card->source, KEYWORD, diagnostics);
            if (load->m[k] < 0) status = -1;
        }
        return status;
    }
    double axes[9];
    if (motion_find_axes(input, card->cid, card->source, KEYWORD, axes, diagnostics)) return -1;
    memcpy(load->direction, axes + 3 * (ptrdiff_t)((card->dof - 1) % 4), sizeof load->direction);
    return 0;
}

/* The body, or why there is none: -1 after an error, -2 if the part never moves, which is warned of. */
static int find_body(const MotionInput *input, const Motion *motion, const RigidLoadDefinition *card,
                     Diagnostics *diagnostics)
{
    int body = motion_find_body(input, motion, card->pid);
    if (body >= 0) return body;
    if (body == MOTION_FIXED) {
        diagnostics_add(diagnostics, SEVERITY_WARNING, card->source, KEYWORD,
                        "part %d is fixed by CON1 and CON2 of its *MAT_RIGID; the load has no effect", card->pid);
        return -2;
    }
    diagnostics_add(diagnostics, SEVERITY_ERROR, card->source, KEYWORD,
                    body == -3 ? "PID = %d: there is no part of this id; define it or correct the card"
                               : "PID = %d is no rigid part with elements; give it *MAT_RIGID or use *LOAD_NODE_SET",
                    card->pid);
    return -1;
}

static int add_load(const MotionInput *input, Motion *motion, const RigidLoadDefinition *card, Diagnostics *diagnostics)
{
    RigidLoad load = {.scale = card->sf};
    load.body = find_body(input, motion, card, diagnostics);
    int status = read_direction(input, card, &load, diagnostics);
    load.curve = motion_find_curve(input, card->lcid, "LCID", card->source, KEYWORD, diagnostics);
    if (status || load.body == -1 || load.curve == -1) return -1;
    if (load.body >= 0 && load.curve >= 0) motion->loads.rigid_loads[motion->loads.rigid_load_count++] = load;
    return 0;
}

int build_rigid_loads(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    const Definitions *d = input->index->definitions;
    int status = 0;
    if (d->rigid_loads.count == 0) return 0;
    motion->loads.rigid_loads = memory_alloc(d->rigid_loads.count, sizeof *motion->loads.rigid_loads);
    if (!motion->loads.rigid_loads) return motion_no_memory(KEYWORD, diagnostics);
    for (size_t k = 0; k < d->rigid_loads.count; k++)
        if (add_load(input, motion, &d->rigid_loads.items[k], diagnostics)) status = -1;
    return status;
}
