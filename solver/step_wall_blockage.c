/* Nodes that lie on rigid walls count as covered, with --walls-block (docs/theory.md, Leakage). */
#include "solver/workspace.h"

/* Whether a wall holds the node where it is at t_{n+1}. In cycles that write results positions are still those of t_n.
 */
static bool lies_on_wall(const Workspace *w, int node)
{
    const Model *m = w->model;
    const double *x = w->state->x + 3 * (ptrdiff_t)node, *v = w->state->v + 3 * (ptrdiff_t)node;
    const double ahead = w->plan.emit ? w->plan.dt_next : 0.0;
    for (int i = 0; node < m->moving_count && i < m->wall_count; i++) {
        const RigidWall *wall = &m->walls[i];
        const unsigned char side = w->state->wall_side[(ptrdiff_t)i * m->moving_count + node];
        if (!w->walls[i].acts || !wall->tracked[node] || side == WALL_SIDE_BEHIND || side == WALL_SIDE_PASSED) continue;
        double r[3];
        for (int k = 0; k < 3; k++) r[k] = x[k] + ahead * v[k] - w->walls[i].origin[k];
        WallGap gap = rigid_wall_gap(wall, r);
        if (gap.over && gap.distance <= wall->tolerance) return true;
    }
    return false;
}

void step_walls_block(Workspace *w, int thread, int threads)
{
    const Model *m = w->model;
    const int64_t count = m->element_count;
    const unsigned char *covered = w->contact ? w->contact->covered : NULL;
    for (int e = (int)(count * thread / threads), end = (int)(count * (thread + 1) / threads); e < end; e++) {
        const int32_t *node = m->element_node + 4 * (ptrdiff_t)e;
        int corners = node[3] == node[2] ? 3 : 4, touching = 0;
        if (m->has_erosion && w->state->eroded[m->element_slot[e]]) corners = 0;
        for (int k = 0; k < corners; k++) touching += (covered && covered[node[k]]) || lies_on_wall(w, node[k]) ? 1 : 0;
        w->state->contact_share[e] = corners ? (double)touching / corners : 0.0;
    }
}
