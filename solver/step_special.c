/* Special nodes: supports, prescribed motion, hanging nodes, rigid bodies, point loads, several pressures. */
#include <math.h>
#include <string.h>

#include "contact/entity_loop.h"
#include "solver/step_dampers.h"
#include "solver/step_links.h"
#include "solver/step_seams.h"
#include "solver/step_ties.h"
#include "solver/vector3.h"
#include "solver/workspace.h"

/* Forces of the special nodes; stress, bag and load pressure on the velocities before the step for the ledger. */
static void gather_special(Workspace *w, NodeSums *t, bool after)
{
    const Model *m = w->model;
    const double *v = w->state->v;
    for (int node = m->free_count; node < m->moving_count; node++) {
        double *f = w->force + 3 * (ptrdiff_t)node;
        const double *vn = v + 3 * (ptrdiff_t)node;
        double stress[3] = {0}, bag_force[3] = {0}, load_force[3] = {0}, area[3] = {0};
        for (int32_t k = m->node_row_start[node]; k < m->node_row_start[node + 1]; k++) {
            const double *force = w->rows + ROW_SIZE * (ptrdiff_t)m->node_row[k], *share = force + ROW_AREA;
            int set = m->row_set[m->node_row[k]];
            double bag = set < 0 ? 0.0 : w->bag_pressure[set], load = set < 0 ? 0.0 : w->load_pressure[set];
            if (m->has_fluid && set >= 0) bag += step_hydrostatic(w, set, w->state->x + 3 * (ptrdiff_t)node);
            for (int i = 0; i < 3; i++) {
                double s = share[i];
                stress[i] += force[i];
                bag_force[i] += bag * s;
                load_force[i] += load * s;
                area[i] += set < 0 ? 0.0 : s;
            }
        }
        for (int i = 0; i < 3; i++) {
            if (after) {
                t->bag_after += bag_force[i] * vn[i];
                t->load_after += load_force[i] * vn[i];
                continue;
            }
            f[i] = stress[i] + (bag_force[i] + load_force[i]);
            t->bag_before += bag_force[i] * vn[i];
            t->load_before += load_force[i] * vn[i];
        }
        if (after || !(vector3_dot(area, area) > 0.0)) continue;
        RateRows held = {0}; /* what does not give way opens no volume */
        if (m->constraints.support_count > 0) constraints_held(&m->constraints, node, w->plan.time, &held);
        rate_rows_apply(&held, area);
        t->compliance += vector3_dot(area, area) * m->inverse_mass[node];
    }
}

/* The caps' pressure on their rims, with --caps-push-rim: the gradient of the cap's volume. */
static void push_rims(Workspace *w)
{
    const Model *m = w->model;
    for (int i = 0; m->caps_push_rim && i < m->airbag_count; i++)
        surface_cap_force(&m->airbags[i].closure, w->state->x, w->state->gas[i].applied, w->force);
}

/* Newton's law for the special nodes with their class's gravity and damping; supports and rigid bodies correct it
 * after. The drag is kept: its work goes with the velocity that comes of it all. */
static void accelerate(Workspace *w)
{
    const Model *m = w->model;
    double dt = w->plan.dt_mean;
    for (int node = m->free_count; node < m->moving_count; node++) {
        int class = m->node_class ? m->node_class[node] : 0;
        double *v = w->state->v + 3 * (ptrdiff_t)node;
        const double *f = w->force + 3 * (ptrdiff_t)node;
        for (int k = 0; k < 3; k++) {
            double old = v[k], d = w->class_damping[3 * class + k] * dt, reference = w->class_velocity[3 * class + k];
            double force = f[k] * m->inverse_mass[node] + w->class_gravity[3 * class + k];
            v[k] = (old * (1.0 - 0.5 * d) + d * reference + force * dt) / (1.0 + 0.5 * d);
            w->drag[3 * (node - m->free_count) + k] =
                m->mass[node] * w->class_damping[3 * class + k] * (0.5 * (old + v[k]) - reference);
        }
    }
}

/* The loads of *LOAD_RIGID_BODY on one body. */
static void push_body(const Workspace *w, int body, RigidWrench *pushed, RigidField *field)
{
    const Model *m = w->model;
    rigid_loads_at(m->loads.rigid_loads, m->loads.rigid_load_count, body, m->curves, w->plan.time, w->state->x, pushed);
    for (int i = 0; i < 3; i++) {
        field->force[i] += pushed->force[i];
        field->moment[i] += pushed->moment[i];
    }
}

static void move_rigid_bodies(Workspace *w, NodeSums *t)
{
    const Model *m = w->model;
    State *state = w->state;
    const CyclePlan *plan = &w->plan;
    for (int i = 0; i < m->rigid_body_count; i++) {
        const RigidBody *body = &m->rigid_bodies[i];
        RigidField field = {0};
        RigidPrescription prescription = {0};
        RigidWork work = {0};
        RigidWrench pushed = {0};
        double v_before[3], spin_before[3];
        if (m->loads.class_count) /* class 0 is empty */
            loads_body_at(&m->loads.classes[body->body_class], m->curves, plan->time, field.gravity, field.damping);
        if (m->entity_count > 0) entities_add_wrench(w->contact, i, field.force, field.moment);
        if (m->loads.rigid_load_count > 0) push_body(w, i, &pushed, &field);
        memcpy(v_before, state->rigid[i].v, sizeof v_before);
        memcpy(spin_before, state->rigid[i].spin, sizeof spin_before);
        rigid_body_prescribe(&m->constraints, i, body, &state->rigid[i], m->curves, plan->time, plan->dt_mean,
                             plan->dt_next, &prescription);
        rigid_body_step(body, &state->rigid[i], state->x, w->force, &field, &prescription, plan->dt_mean, plan->dt_next,
                        state->v, &work);
        const RigidState *after = &state->rigid[i];
        const bool at_start = !(plan->dt_before > 0.0);
        if (m->loads.rigid_load_count > 0)
            t->reaction += rigid_loads_work(&pushed, at_start ? after->v : v_before, after->v,
                                            at_start ? after->spin : spin_before, after->spin, plan->dt_mean);
        t->reaction += work.reaction + work.gravity;
        t->damping += work.damping;
        t->kinetic += state->rigid[i].kinetic;
        t->kinetic_steps += state->rigid[i].kinetic;
    }
}

/* Kinetic energy at t_n of the special nodes, gravity's work on them. */
static void count_energy(Workspace *w, NodeSums *t)
{
    const Model *m = w->model;
    double share = w->plan.dt_mean > 0.0 ? 0.5 * w->plan.dt_before / w->plan.dt_mean : 0.0;
    const bool at_start = !(w->plan.dt_before > 0.0);
    for (int node = m->free_count; node < m->moving_count; node++) {
        int kind = w->special_kind[node - m->free_count];
        int class = m->node_class ? m->node_class[node] : 0;
        const double *v = w->state->v + 3 * (ptrdiff_t)node, *old = w->before + 3 * (ptrdiff_t)node;
        double a[3], full[3];
        for (int k = 0; k < 3; k++) {
            double change = v[k] - old[k];
            a[k] = w->plan.dt_mean > 0.0 ? change / w->plan.dt_mean : 0.0;
            full[k] = old[k] + share * change;
            if (kind) continue;
            t->kinetic += 0.5 * m->mass[node] * full[k] * full[k];
            t->kinetic_steps += 0.5 * m->mass[node] * old[k] * v[k];
            double impulse = m->mass[node] * (v[k] - w->newton[3 * (node - m->free_count) + k]);
            t->support_before += impulse * old[k];
            /* at the start a prescribed velocity is a jump from rest: its work goes with the mean */
            t->support_after += impulse * (w->plan.dt_before > 0.0 ? v[k] : 0.5 * (old[k] + v[k]));
            if (at_start && impulse != 0.0) { /* what it holds against is counted with v+ (eq. L4a) */
                double held = w->force[3 * node + k] + m->mass[node] * w->class_gravity[3 * class + k];
                t->support_after -= held * w->plan.dt_mean * 0.5 * change;
            }
            t->damping += w->drag[3 * (node - m->free_count) + k] * 0.5 * (old[k] + v[k]) * w->plan.dt_mean;
            t->load_before += m->mass[node] * w->class_gravity[3 * class + k] * old[k];
            t->load_after += m->mass[node] * w->class_gravity[3 * class + k] * v[k];
        }
        if (!w->plan.emit) continue;
        for (int k = 0; k < 3; k++) {
            w->acceleration[3 * node + k] = a[k];
            w->velocity[3 * node + k] = full[k];
        }
    }
}

void step_special(Workspace *w)
{
    const Model *m = w->model;
    State *state = w->state;
    const CyclePlan *plan = &w->plan;
    NodeSums *t = &w->node_sums[w->node_chunk_count];
    ptrdiff_t first = 3 * (ptrdiff_t)m->free_count, count = 3 * (ptrdiff_t)(m->moving_count - m->free_count);
    *t = (NodeSums){0};
    if (w->jets) step_jets_sum(w);
    if (count == 0) {
        if (m->has_moving_walls) step_walls_special(w, t);
        return;
    }
    memcpy(w->before + first, state->v + first, (size_t)count * sizeof *state->v);
    gather_special(w, t, false);
    push_rims(w);
    links_act(m, state, w->force);
    dampers_act(m, state->x, state->v, w->force);
    if (w->jets) step_jets_react(w, t);
    loads_apply_points(&m->loads, m->curves, plan->time, state->x, w->force);
    if (m->walls_push_bodies) step_wall_bodies_push(w);
    constraints_fold_forces(&m->constraints, w->force);
    accelerate(w);
    memcpy(w->newton, state->v + first, (size_t)count * sizeof *w->newton);
    if (m->seam_count > 0) seams_act(m, state, plan->dt_mean);
    if (m->ties.count > 0) step_ties_act(w);
    constraints_apply(&m->constraints, m->curves, plan->time, plan->dt_mean, plan->dt_next, state->x, m->initial,
                      m->mass, w->before, state->v, NULL);
    if (m->wall_count > 0) step_walls_special(w, t);
    move_rigid_bodies(w, t);
    if (m->walls_push_bodies) step_wall_bodies_count(w, t);
    constraints_place_hanging(&m->constraints, state->v);
    t->reaction += loads_points_work(&m->loads, m->curves, plan->time, state->x,
                                     plan->dt_before > 0.0 ? w->before : state->v, state->v, plan->dt_mean);
    t->damping += dampers_work(m, state->x, w->before, state->v, plan->dt_mean);
    gather_special(w, t, true);
    if (w->jets) step_jets_count_reaction(w, t);
    count_energy(w, t);
    if (plan->emit) return;
    for (ptrdiff_t i = first; i < first + count; i++) state->x[i] += plan->dt_next * state->v[i];
}
