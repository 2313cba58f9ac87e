/* Jets in the step (docs/theory.md, J10 to J13): their pressure is added to the corner sums of the stress forces, so
 * that the node pass needs to know nothing of them. */
#include <math.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/vector3.h"
#include "solver/workspace.h"

enum {
    SHARE_SIZE = 12,    /* doubles of a facet's area vectors: of each corner, a triangle's repeated */
    LONGEST_VIEW = 100, /* steps after which the line of sight is looked at again in any case */
};
static const double VIEW_MOTION = 1.0;  /* or when a node may have moved by this many sizes of a facet */
static const double VIEW_MARGIN = 0.01; /* layers nearer than this share of a facet's size do not hide each other */

int step_jets_allocate(Workspace *w)
{
    const Model *m = w->model;
    if (m->jet_count == 0) return 0;
    w->jets = memory_alloc((size_t)m->jet_count, sizeof *w->jets);
    for (int i = 0; w->jets && i < m->jet_count; i++) {
        w->jets[i].first_chunk = w->jet_chunk_count;
        w->jet_chunk_count += m->jets[i].chunk_count;
        if (ray_tree_create(&w->jets[i].tree, m->jets[i].facet_count, m->jets[i].node)) return -1;
    }
    w->jet_sums = memory_alloc((size_t)w->jet_chunk_count + 1, sizeof *w->jet_sums);
    w->jet_share = memory_alloc(SHARE_SIZE * (size_t)m->jet_facet_count + 1, sizeof *w->jet_share);
    return w->jets && w->jet_sums && w->jet_share ? 0 : -1;
}

void step_jets_release(Workspace *w)
{
    for (int i = 0; w->jets && i < w->model->jet_count; i++) ray_tree_free(&w->jets[i].tree);
    memory_free(w->jets);
    memory_free(w->jet_sums);
    memory_free(w->jet_share);
}

/* (J11): until then no node moves by more than the share of a facet's size. */
static double next_view(const Workspace *w, const Jet *jet)
{
    const Airbag *bag = &w->model->airbags[jet->airbag];
    double fastest = 0.0, longest = LONGEST_VIEW * w->plan.dt_next;
    for (int i = 0; i < bag->node_count; i++) {
        const double *v = w->state->v + 3 * (ptrdiff_t)bag->node[i];
        double speed = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        fastest = speed > fastest ? speed : fastest;
    }
    fastest = sqrt(fastest);
    if (jet->moving) fastest += vector3_norm(w->state->v + 3 * (ptrdiff_t)jet->focus_node);
    double way = VIEW_MOTION * sqrt(w->state->gas[jet->airbag].area / jet->facet_count);
    return w->plan.time + (fastest * longest > way ? way / fastest : longest);
}

void step_jets_prepare(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; i < m->jet_count; i++) {
        const Jet *jet = &m->jets[i];
        const GasState *state = &w->state->gas[jet->airbag];
        GasJet gas = gas_jet(&m->airbags[jet->airbag].gas, m->curves, state, w->plan.time);
        JetWork *work = &w->jets[i];
        work->frame = jet_frame(jet, m->curves, w->state->x, &gas, w->plan.time - state->inflow_start);
        work->view = work->frame.active && w->plan.time >= w->state->jet[i].next_view;
        if (!work->view) continue;
        ray_tree_refit(&work->tree, w->state->x);
        w->state->jet[i].next_view = next_view(w, jet);
        w->state->jet[i].looks++;
    }
}

/* Centroid, area and inner side of a facet. */
static void facet_geometry(const Jet *jet, int f, const double *x, double middle[3], double outward[3])
{
    const int32_t *node = jet->node + 4 * (ptrdiff_t)f;
    const double *a = x + 3 * (ptrdiff_t)node[0], *b = x + 3 * (ptrdiff_t)node[1], *c = x + 3 * (ptrdiff_t)node[2],
                 *d = x + 3 * (ptrdiff_t)node[3];
    double u[3], v[3];
    int corners = jet->facet[f].corner_count;
    vector3_subtract(c, a, u);
    vector3_subtract(d, b, v);
    vector3_cross(u, v, outward);
    for (int k = 0; k < 3; k++) {
        outward[k] *= 0.5 * jet->facet[f].outward;
        middle[k] = (a[k] + b[k] + c[k] + (corners == 4 ? d[k] : 0.0)) / corners;
    }
}

/* (J10): shape where the jet sees the facet's inner side, -1 where it does not, 0 out of its reach. A ray is cast at
 * every second look, and where the facet comes into the jet. */
static double view_facet(const Workspace *w, const Jet *jet, const JetWork *work, int f, double before)
{
    double middle[3], outward[3], origin[3], sight[3];
    facet_geometry(jet, f, w->state->x, middle, outward);
    double area = vector3_norm(outward);
    double shape = jet_shape(jet, w->model->curves, &work->frame, middle, area, origin);
    if (!jet->facet[f].target) shape = 0.0;
    if (!(shape > 0.0) && jet->knock_curve < 0) return 0.0;
    vector3_subtract(middle, origin, sight);
    if (!(vector3_dot(sight, outward) > 0.0)) return -1.0;
    if (before != 0.0 && (f + w->state->jet[work - w->jets].looks) % 2 != 0) return before < 0.0 ? -1.0 : shape;
    return ray_tree_blocked(&work->tree, w->state->x, origin, middle, f, VIEW_MARGIN * sqrt(area)) ? -1.0 : shape;
}

/* Pressure beyond the bag's own on a facet. */
static double extra_pressure(const JetWork *work, double shape, double bag)
{
    return shape >= 0.0 ? work->frame.strength * shape : (work->frame.knock - 1.0) * bag;
}

/* Area vectors of the corners (S5, S6), out of the bag; all as they are summed for the bag's pressure. */
static void facet_shares(const JetFacet *facet, const int32_t *node, const double *x, double share[SHARE_SIZE])
{
    const double *p[4];
    for (int c = 0; c < 4; c++) p[c] = x + 3 * (ptrdiff_t)node[c];
    if (facet->corner_count == 3) {
        double u[3], v[3], area[3];
        vector3_subtract(p[1], p[0], u);
        vector3_subtract(p[2], p[0], v);
        vector3_cross(u, v, area);
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 3; k++) share[3 * c + k] = c < 3 ? facet->outward * area[k] / 6.0 : 0.0;
        return;
    }
    double a[3], b[3], h[3], normal[3], na[3], nb[3];
    for (int k = 0; k < 3; k++) {
        a[k] = 0.25 * (p[1][k] + p[2][k] - p[0][k] - p[3][k]);
        b[k] = 0.25 * (p[2][k] + p[3][k] - p[0][k] - p[1][k]);
        h[k] = 0.25 * (p[0][k] - p[1][k] + p[2][k] - p[3][k]);
    }
    vector3_cross(a, b, normal);
    vector3_cross(a, h, na);
    vector3_cross(h, b, nb);
    for (int k = 0; k < 3; k++) {
        double n = facet->outward * normal[k], i = facet->outward * na[k] / 3.0, j = facet->outward * nb[k] / 3.0;
        share[k] = n - (i + j);
        share[3 + k] = n + (i - j);
        share[6 + k] = n + (i + j);
        share[9 + k] = n - (i - j);
    }
}

/* Power of unit pressure on the facet: sum of A_i . v_i. */
static double facet_power(const double share[SHARE_SIZE], const int32_t *node, const double *v)
{
    double power = 0.0;
    for (int c = 0; c < 4; c++) {
        const double *vc = v + 3 * (ptrdiff_t)node[c];
        for (int k = 0; k < 3; k++) power += share[3 * c + k] * vc[k];
    }
    return power;
}

/* (J12): forces p A_i onto the corners' rows; their sum into force if it is asked for. */
static void push_facet(const JetFacet *facet, const double share[SHARE_SIZE], double pressure, double *rows,
                       double *force)
{
    for (int c = 0; c < facet->corner_count; c++) {
        double *row = rows + ROW_SIZE * (ptrdiff_t)facet->row[c];
        for (int k = 0; k < 3; k++) {
            double f = pressure * share[3 * c + k];
            row[k] += f;
            if (force) force[k] += f;
        }
    }
}

/* Whether a facet of this shape has a pressure beyond the bag's. */
static bool is_pushed(const Jet *jet, double shape)
{
    return shape > 0.0 || (shape < 0.0 && jet->knock_curve >= 0);
}

static void push_chunk(Workspace *w, int number, int chunk)
{
    const Jet *jet = &w->model->jets[number];
    const JetWork *work = &w->jets[number];
    JetSums *sums = &w->jet_sums[work->first_chunk + chunk];
    double *shape = w->state->jet_shape + jet->first_facet, bag = w->state->gas[jet->airbag].applied;
    double *shares = w->jet_share + SHARE_SIZE * (ptrdiff_t)jet->first_facet;
    *sums = (JetSums){0};
    if (!work->frame.active) return;
    for (int f = jet->chunk_start[chunk]; f < jet->chunk_start[chunk + 1]; f++) {
        if (work->view) shape[f] = view_facet(w, jet, work, f, shape[f]);
        if (!is_pushed(jet, shape[f])) continue;
        const JetFacet *facet = &jet->facet[f];
        const int32_t *node = jet->node + 4 * (ptrdiff_t)f;
        double pressure = extra_pressure(work, shape[f], bag), *share = shares + SHARE_SIZE * (ptrdiff_t)f;
        facet_shares(facet, node, w->state->x, share);
        push_facet(facet, share, pressure, w->rows, shape[f] > 0.0 ? sums->force : NULL);
        sums->before += pressure * facet_power(share, node, w->state->v);
    }
}

/* The chunks of one jet that a thread has. */
static void own_chunks(const Jet *jet, int thread, int threads, int *first, int *end)
{
    int chunks = jet->chunk_count;
    *first = (int)((int64_t)chunks * thread / threads);
    *end = (int)((int64_t)chunks * (thread + 1) / threads);
}

/* One jet after the other: two bags may share a wall. */
void step_jets_push(Workspace *w, int thread, Team *team)
{
    for (int i = 0; i < w->model->jet_count; i++) {
        int first, end;
        own_chunks(&w->model->jets[i], thread, team_size(team), &first, &end);
        for (int c = first; c < end; c++) push_chunk(w, i, c);
        team_barrier(team);
    }
}

/* Power of the same forces on the velocities after the step. */
static void count_chunk(Workspace *w, int number, int chunk)
{
    const Jet *jet = &w->model->jets[number];
    const JetWork *work = &w->jets[number];
    const double *shape = w->state->jet_shape + jet->first_facet;
    const double *shares = w->jet_share + SHARE_SIZE * (ptrdiff_t)jet->first_facet;
    double bag = w->state->gas[jet->airbag].applied, sum = 0.0;
    if (!work->frame.active) return;
    for (int f = jet->chunk_start[chunk]; f < jet->chunk_start[chunk + 1]; f++)
        if (is_pushed(jet, shape[f]))
            sum += extra_pressure(work, shape[f], bag) *
                   facet_power(shares + SHARE_SIZE * (ptrdiff_t)f, jet->node + 4 * (ptrdiff_t)f, w->state->v);
    w->jet_sums[work->first_chunk + chunk].after = sum;
}

void step_jets_count(Workspace *w, int thread, Team *team)
{
    for (int i = 0; i < w->model->jet_count; i++) {
        int first, end;
        own_chunks(&w->model->jets[i], thread, team_size(team), &first, &end);
        for (int c = first; c < end; c++) count_chunk(w, i, c);
    }
    team_barrier(team);
}

void step_jets_sum(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; i < m->jet_count; i++) {
        double *force = w->state->jet[i].force;
        force[0] = force[1] = force[2] = 0.0;
        for (int c = 0; c < m->jets[i].chunk_count; c++)
            for (int k = 0; k < 3; k++) force[k] += w->jet_sums[w->jets[i].first_chunk + c].force[k];
        w->state->gas[m->jets[i].airbag].reaction = vector3_norm(force);
    }
}

/* A node that feels a reaction: NREACT, if it moves. */
static bool reacts(const Model *m, const Jet *jet)
{
    return jet->react_node >= m->free_count && jet->react_node < m->moving_count;
}

/* (J13): the column's share. */
void step_jets_react(Workspace *w, NodeSums *t)
{
    const Model *m = w->model;
    for (int i = 0; i < m->jet_count; i++) {
        if (!reacts(m, &m->jets[i])) continue;
        ptrdiff_t n = 3 * (ptrdiff_t)m->jets[i].react_node;
        for (int k = 0; k < 3; k++) {
            w->force[n + k] -= w->state->jet[i].force[k];
            t->bag_before -= w->state->jet[i].force[k] * w->before[n + k];
        }
    }
}

void step_jets_count_reaction(Workspace *w, NodeSums *t)
{
    const Model *m = w->model;
    for (int i = 0; i < m->jet_count; i++) {
        if (!reacts(m, &m->jets[i])) continue;
        ptrdiff_t n = 3 * (ptrdiff_t)m->jets[i].react_node;
        for (int k = 0; k < 3; k++) t->bag_after -= w->state->jet[i].force[k] * w->state->v[n + k];
    }
}
