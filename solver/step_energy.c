/* The energy ledger at t_n (docs/theory.md, Energy) and its judgement. */
#include <math.h>

#include "solver/workspace.h"

static NodeSums sum_nodes(const Workspace *w)
{
    NodeSums t = {0};
    for (int c = 0; c <= w->node_chunk_count; c++) {
        const NodeSums *s = &w->node_sums[c];
        t.kinetic += s->kinetic;
        t.kinetic_steps += s->kinetic_steps;
        t.bag_before += s->bag_before;
        t.bag_after += s->bag_after;
        t.load_before += s->load_before;
        t.load_after += s->load_after;
        t.damping += s->damping;
        t.reaction += s->reaction;
        t.support_before += s->support_before;
        t.support_after += s->support_after;
        t.compliance += s->compliance;
        t.stopped += s->stopped;
    }
    for (int c = 0; c < w->jet_chunk_count; c++) {
        t.bag_before += w->jet_sums[c].before;
        t.bag_after += w->jet_sums[c].after;
    }
    if (w->model->implicit.element_count > 0) step_implicit_energy(w, &t);
    return t;
}

/* Fabric gives back at most what it was given: less says that its stress feeds the motion (eq. L8). Once it has given
 * more than all loads, three cycles in a row end the run; the recorder warns long before. */
static void judge_fabric(Workspace *w)
{
    Energies *e = w->state->energy;
    bool beyond = -e->internal > BILLOW_FEEDING_LIMITS * w->model->energy_error_limit * e->largest && e->largest > 0.0;
    e->feeding_cycles = beyond ? e->feeding_cycles + 1 : 0;
    if (e->feeding_cycles >= BILLOW_LOST_CYCLES)
        step_fail(w,
                  "fabric of FORM 0 or 1 with CSE = 1 has no stored energy and can do that: set DAMP = 0.05 or more, "
                  "or FORM = 2, "
                  "which cannot; --energy-error-limit raises the limit",
                  "the stress of the shells has given %.6g more energy than it received, the loads %.6g", -e->internal,
                  e->largest);
}

/* Works up to t_n: what was counted up to the half step before, and half of this cycle's (eq. L4). */
void step_close_energies(Workspace *w)
{
    const Model *m = w->model;
    Energies *e = w->state->energy;
    NodeSums t = sum_nodes(w);
    double before = 0.5 * w->plan.dt_before, after = 0.5 * w->plan.dt_next;
    double passed = before / (before + after); /* share of this cycle's mean step that lies before t_n */
    e->airbag_half += before * t.bag_before;
    e->external_half += before * t.load_before + passed * (t.reaction + t.support_before);
    e->airbag_work = e->airbag_half;
    e->external_work = e->external_half;
    e->mass_damping += passed * t.damping;
    e->damping = e->mass_damping + e->material_damping;
    e->airbag_half += after * t.bag_after;
    e->external_half += after * t.load_after + (1.0 - passed) * (t.reaction + t.support_after);
    e->mass_damping += (1.0 - passed) * t.damping;
    if (w->contact) {
        double *half = &w->state->contact->half; /* what contact forces take from the nodes is theirs */
        double power = w->contact->power, rise = w->contact->power_after - power; /* eq. C14 */
        e->contact = *half - before * (power + 0.5 * passed * rise);
        *half = e->contact - after * (power + 0.5 * (1.0 + passed) * rise);
    }
    e->kinetic = t.kinetic;
    e->internal = e->hourglass = 0.0;
    for (int p = 0; p < m->part_count; p++) {
        e->internal += w->state->part_energy[p];
        e->hourglass += w->state->part_hourglass[p];
    }
    w->state->clock->compliance = t.compliance;
    double held = e->kinetic + e->internal + e->hourglass + e->damping + e->contact;
    double given = e->initial + e->external_work + e->airbag_work;
    /* what a run was given, never what it holds: the energy of a run that blows up is no scale */
    const double given_parts[] = {fabs(e->initial), fabs(e->external_work), fabs(e->airbag_work), fabs(given),
                                  t.stopped};
    for (int i = 0; i < 5; i++) e->largest = given_parts[i] > e->largest ? given_parts[i] : e->largest;
    w->closed = true;
    if (!isfinite(held) || !isfinite(given)) {
        step_fail(w, "look at the last state written; lower TSSFAC, or check loads there", "an energy is not finite");
        return;
    }
    /* The full-step velocity is first order in the first cycles of a start from rest, and while a nearly empty bag's
     * gas is stiffer than the step resolves: nothing to judge yet. */
    int64_t cycle = w->state->clock->cycle;
    if (e->judged_from < BILLOW_UNJUDGED_CYCLES) e->judged_from = BILLOW_UNJUDGED_CYCLES;
    if (w->plan.implicit_gas && cycle + BILLOW_SETTLING_CYCLES <= BILLOW_SETTLING_LIMIT)
        e->judged_from = cycle + BILLOW_SETTLING_CYCLES;
    if (cycle < e->judged_from) return;
    /* Sudden velocity changes part the two kinetic energies for a cycle or two; a lost balance shows in both and stays
     * (eq. L7). */
    const double with_steps = held - e->kinetic + t.kinetic_steps,
                 nearer = fabs(held - given) <= fabs(with_steps - given) ? held : with_steps;
    e->ratio = given != 0.0 ? nearer / given : 1.0;
    e->ratio_min = e->ratio < e->ratio_min ? e->ratio : e->ratio_min;
    e->ratio_max = e->ratio > e->ratio_max ? e->ratio : e->ratio_max;
    double error = fabs(nearer - given);
    bool beyond = error > m->energy_error_limit * e->largest && e->largest > 0.0;
    judge_fabric(w);
    e->lost_cycles = beyond ? e->lost_cycles + 1 : 0;
    if (e->lost_cycles >= BILLOW_LOST_CYCLES && e->feeding_cycles < BILLOW_LOST_CYCLES)
        step_fail(w,
                  "the step is unstable or a load is not what was meant: lower TSSFAC, look at the last state; "
                  "--energy-error-limit raises the limit",
                  "the energy balance is lost: %.6g held against %.6g given (%.1f %% of the largest given)", held,
                  given, 100.0 * error / e->largest);
}
