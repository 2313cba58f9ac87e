/* Jets in the step (docs/theory.md, J10 to J13): their pressure is added to the corner sums of the stress forces, so
 * that the node pass needs to know nothing of them. */
#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "solver/memory.h"
#include "solver/vector3.h"
#include "solver/workspace.h"

enum { LONGEST_VIEW = 100 };           /* steps after which the line of sight is looked at again in any case */
static const double VIEW_MOTION = 1.0; /* or when a node may have moved by this many sizes of a facet */

int step_jets_allocate(Workspace *w)
{
    const Model *m = w->model;
    if (m->jet_count == 0) return 0;
    w->jet_kernels = w->kernels->level >= 4   ? &jet_kernels_v4
                     : w->kernels->level == 3 ? &jet_kernels_v3
                                              : &jet_kernels_v2;
    w->jets = memory_alloc((size_t)m->jet_count, sizeof *w->jets);
    for (int i = 0; w->jets && i < m->jet_count; i++) {
        w->jets[i].first_chunk = w->jet_chunk_count;
        w->jet_chunk_count += m->jets[i].chunk_count;
        if (ray_tree_create(&w->jets[i].tree, m->jets[i].facet_count, m->jets[i].node)) return -1;
        if (!m->has_erosion) continue;
        w->jets[i].side = memory_alloc((size_t)m->jets[i].facet_count + 1, 1);
        if (!w->jets[i].side) return -1;
    }
    w->jet_sums = memory_alloc((size_t)w->jet_chunk_count + 1, sizeof *w->jet_sums);
    w->jet_area = memory_alloc((size_t)m->jet_row_count + 1, sizeof *w->jet_area);
    return w->jets && w->jet_sums && w->jet_area ? 0 : -1;
}

void step_jets_release(Workspace *w)
{
    for (int i = 0; w->jets && i < w->model->jet_count; i++) {
        ray_tree_free(&w->jets[i].tree);
        memory_free(w->jets[i].side);
    }
    memory_free(w->jets);
    memory_free(w->jet_sums);
    memory_free(w->jet_area);
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

/* What has eroded is not seen. */
static const int8_t *present_sides(const Workspace *w, const Jet *jet, JetWork *work)
{
    if (!work->side) return jet->side;
    for (int f = 0; f < jet->facet_count; f++) work->side[f] = w->state->eroded[jet->facet[f].slot] ? 0 : jet->side[f];
    return work->side;
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
        double end[3];
        for (int k = 0; k < 3; k++) end[k] = work->frame.focus[k] + work->frame.distance * work->frame.across[k];
        ray_tree_sides(&work->tree, present_sides(w, jet, work), work->frame.focus, end);
        w->state->jet[i].next_view = next_view(w, jet);
        w->state->jet[i].looks++;
    }
}

/* (J12): the rows of a chunk and what acts on them in this cycle. */
static JetRows rows_of(const Workspace *w, int number, int chunk)
{
    const Jet *jet = &w->model->jets[number];
    const JetFrame *frame = &w->jets[number].frame;
    int first = jet->chunk_weight[chunk], sign = jet->chunk_sign[chunk];
    return (JetRows){
        .weight = w->state->jet_weight + jet->first_weight + first,
        .node = jet->row_node + first,
        .count = jet->chunk_weight[chunk + 1] - first,
        .row = w->rows + ROW_SIZE * (ptrdiff_t)jet->chunk_row[chunk],
        .v = w->state->v,
        .strength = sign * frame->strength,
        .knock = sign * (frame->knock - 1.0) * w->state->gas[jet->airbag].applied,
    };
}

static void push_chunk(Workspace *w, int number, int chunk)
{
    const JetWork *work = &w->jets[number];
    JetSums *sums = &w->jet_sums[work->first_chunk + chunk];
    *sums = (JetSums){0};
    if (!work->frame.active) return;
    if (work->view) step_jets_look(w, number, chunk);
    JetRows rows = rows_of(w, number, chunk);
    w->jet_kernels->push(&rows, sums);
}

typedef void ChunkWork(Workspace *w, int jet, int chunk);

/* The chunks of a jet that a thread has: those of the elements that it has. */
static void do_own_chunks(Workspace *w, int number, int thread, int threads, ChunkWork *work)
{
    const Model *m = w->model;
    for (int i = 0; i < m->segment_count; i++) {
        int segment = m->segment_order[i], chunk = m->jets[number].segment_chunk[segment];
        if (chunk >= 0 && step_segment_owner(w, i, threads) == thread) work(w, number, chunk);
    }
}

/* Boxes at the present positions, before the line of sight is looked at. */
static void fit_tree(Workspace *w, int number, int thread, Team *team)
{
    RayTree *tree = &w->jets[number].tree;
    ray_tree_fit_leaves(tree, w->state->x, thread, team_size(team));
    team_barrier(team);
    if (thread == 0) ray_tree_finish(tree, w->state->x);
    team_barrier(team);
}

/* One jet after the other: two bags may share a wall. */
void step_jets_push(Workspace *w, int thread, Team *team)
{
    for (int i = 0; i < w->model->jet_count; i++) {
        if (w->jets[i].view) fit_tree(w, i, thread, team);
        do_own_chunks(w, i, thread, team_size(team), push_chunk);
        team_barrier(team);
    }
}

static void count_chunk(Workspace *w, int number, int chunk)
{
    const JetWork *work = &w->jets[number];
    if (!work->frame.active) return;
    JetRows rows = rows_of(w, number, chunk);
    w->jet_sums[work->first_chunk + chunk].after = w->jet_kernels->count(&rows);
}

void step_jets_count(Workspace *w, int thread, Team *team)
{
    for (int i = 0; i < w->model->jet_count; i++) do_own_chunks(w, i, thread, team_size(team), count_chunk);
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
