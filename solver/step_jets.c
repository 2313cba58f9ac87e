/* Jets in the step (docs/theory.md, J10 to J13): their pressure is added to the corners' stress forces, so that the
 * node pass needs to know nothing of them. */
#include <math.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/vector3.h"
#include "solver/workspace.h"

enum {
    FACET_CHUNK = 256,  /* facets in one fixed partial sum */
    LONGEST_VIEW = 100, /* steps after which the line of sight is looked at again in any case */
};
static const double VIEW_MOTION = 1.0;  /* or when a node may have moved by this many sizes of a facet */
static const double VIEW_MARGIN = 0.01; /* layers nearer than this share of a facet's size do not hide each other */

static int chunk_count(const Jet *jet)
{
    return (jet->facet_count + FACET_CHUNK - 1) / FACET_CHUNK;
}

int step_jets_allocate(Workspace *w)
{
    const Model *m = w->model;
    if (m->jet_count == 0) return 0;
    w->jets = memory_alloc((size_t)m->jet_count, sizeof *w->jets);
    for (int i = 0; w->jets && i < m->jet_count; i++) {
        w->jets[i].first_chunk = w->jet_chunk_count;
        w->jet_chunk_count += chunk_count(&m->jets[i]);
        if (ray_tree_create(&w->jets[i].tree, m->jets[i].facet_count, m->jets[i].node)) return -1;
    }
    w->jet_sums = memory_alloc((size_t)w->jet_chunk_count + 1, sizeof *w->jet_sums);
    return w->jets && w->jet_sums ? 0 : -1;
}

void step_jets_release(Workspace *w)
{
    for (int i = 0; w->jets && i < w->model->jet_count; i++) ray_tree_free(&w->jets[i].tree);
    memory_free(w->jets);
    memory_free(w->jet_sums);
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

/* Power of unit pressure on the facet: sum of A_i . v_i. */
static inline double facet_power(const JetFacet *facet, const double *record, const int32_t *node, const double *v)
{
    const double *a = v + 3 * (ptrdiff_t)node[0], *b = v + 3 * (ptrdiff_t)node[1], *c = v + 3 * (ptrdiff_t)node[2],
                 *d = v + 3 * (ptrdiff_t)node[3];
    double power = 0.0;
    if (facet->corner_count == 3) {
        const double *share = record + 9;
        for (int k = 0; k < 3; k++) power += share[k] * (a[k] + b[k] + c[k]);
        return power;
    }
    const double *share = record + 12;
    for (int k = 0; k < 3; k++)
        power += share[k] * a[k] + share[3 + k] * b[k] + share[6 + k] * c[k] + share[9 + k] * d[k];
    return power;
}

/* (J12): forces p A_i onto the corners; returns their sum in force if it is asked for. */
static inline void push_facet(const JetFacet *facet, double *record, double pressure, double *force)
{
    int corners = facet->corner_count, shares = 3 * corners;
    for (int c = 0; c < corners; c++)
        for (int k = 0; k < 3; k++) {
            double f = pressure * record[shares + (corners == 3 ? k : 3 * c + k)];
            record[3 * c + k] += f;
            if (force) force[k] += f;
        }
}

static void push_chunk(Workspace *w, int number, int chunk)
{
    const Jet *jet = &w->model->jets[number];
    const JetWork *work = &w->jets[number];
    JetSums *sums = &w->jet_sums[work->first_chunk + chunk];
    double *shape = w->state->jet_shape + jet->first_facet, bag = w->state->gas[jet->airbag].applied;
    int first = chunk * FACET_CHUNK, end = first + FACET_CHUNK;
    *sums = (JetSums){0};
    if (!work->frame.active) return;
    if (end > jet->facet_count) end = jet->facet_count;
    for (int f = first; f < end; f++) {
        if (work->view) shape[f] = view_facet(w, jet, work, f, shape[f]);
        if (shape[f] == 0.0 || (shape[f] < 0.0 && jet->knock_curve < 0)) continue;
        const JetFacet *facet = &jet->facet[f];
        double pressure = facet->push * extra_pressure(work, shape[f], bag), *record = w->corner + facet->record;
        push_facet(facet, record, pressure, shape[f] > 0.0 ? sums->force : NULL);
        sums->before += pressure * facet_power(facet, record, jet->node + 4 * (ptrdiff_t)f, w->state->v);
    }
}

/* The chunks of one jet that a thread has. */
static void own_chunks(const Jet *jet, int thread, int threads, int *first, int *end)
{
    int chunks = chunk_count(jet);
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
    double bag = w->state->gas[jet->airbag].applied, sum = 0.0;
    int first = chunk * FACET_CHUNK, end = first + FACET_CHUNK;
    if (!work->frame.active) return;
    if (end > jet->facet_count) end = jet->facet_count;
    for (int f = first; f < end; f++) {
        if (shape[f] == 0.0 || (shape[f] < 0.0 && jet->knock_curve < 0)) continue;
        const JetFacet *facet = &jet->facet[f];
        sum += facet->push * extra_pressure(work, shape[f], bag) *
               facet_power(facet, w->corner + facet->record, jet->node + 4 * (ptrdiff_t)f, w->state->v);
    }
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
        for (int c = 0; c < chunk_count(&m->jets[i]); c++)
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
