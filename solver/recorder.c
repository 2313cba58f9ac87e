/* The recorder: the hooks of a run. It decides each cycle what is written, and serves signals, d3kil and progress. */
#include "solver/recorder.h"

#include <math.h>

#include "io/checkpoint.h"
#include "solver/memory.h"
#include "solver/schedule.h"
#include "solver/signals.h"

static const double look_interval = 0.5;         /* seconds between two looks at d3kil */
static const double energy_warning_share = 0.02; /* of the largest energy given */
/* Where velocities jump, the full-step kinetic energy is off for a cycle (docs/theory.md, L5); what is lost stays so.
 */
enum { ENERGY_WARNING_CYCLES = 3 };

double recorder_energy_error(const Energies *energy)
{
    const double held = energy->kinetic + energy->internal + energy->hourglass + energy->damping + energy->contact;
    const double given = energy->initial + energy->external_work + energy->airbag_work;
    return energy->largest > 0.0 ? fabs(held - given) / energy->largest : 0.0;
}

static void watch_energy(Recorder *recorder, const State *state)
{
    /* The ratio stays 1 in the first cycles of a start from rest, which the loop does not judge. */
    if (recorder->energy_warned || state->energy->ratio == 1.0) return;
    const double error = recorder_energy_error(state->energy);
    recorder->energy_off = error > energy_warning_share ? recorder->energy_off + 1 : 0;
    if (recorder->energy_off < ENERGY_WARNING_CYCLES) return;
    recorder->energy_warned = true;
    diagnostics_add(recorder->diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, NULL,
                    "cycle %lld, time %.6g: the energy balance is off by %.1f %% of the largest given; look at "
                    "glstat.csv and try a smaller TSSFAC",
                    (long long)state->clock->cycle, state->clock->time, 100.0 * error);
    log_write_messages(recorder->log);
}

/* The stress of the shells has given more than it received (docs/theory.md, L8). */
static void watch_fabric(Recorder *recorder, const Model *model, const State *state)
{
    const Energies *energy = state->energy;
    if (recorder->fabric_warned || !(-energy->internal > model->energy_error_limit * energy->largest)) return;
    if (state->clock->cycle < energy->judged_from) return;
    recorder->fabric_warned = true;
    diagnostics_add(
        recorder->diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, NULL,
        "cycle %lld, time %.6g: the stress of the shells has given %.1f %% of the loads' energy more than it "
        "received: fabric of FORM 0 or 1 with CSE = 1 can do that; DAMP = 0.05 or more makes it less, FORM = 2 cannot",
        (long long)state->clock->cycle, state->clock->time, -100.0 * energy->internal / energy->largest);
    log_write_messages(recorder->log);
}

/* Contact that was too fast or too deep is told once, with its first place. */
static void watch_contact(Recorder *recorder, const State *state)
{
    const ContactClock *contact = state->contact;
    if (!contact) return;
    if (contact->fast > 0 && !recorder->fast_warned)
        diagnostics_add(
            recorder->diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, "*CONTACT",
            "time %.6g: node %lld met a surface faster than one contact thickness in a step; it is held, but "
            "thicker contact (SST, MST) or a smaller TSSFAC would be safer",
            contact->fast_time, (long long)contact->fast_node);
    if (contact->lost > 0 && !recorder->lost_warned)
        diagnostics_add(
            recorder->diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, "*CONTACT",
            "time %.6g: node %lld went deeper into a surface than contact follows and passes through; raise "
            "SOFSCL or the thickness",
            contact->lost_time, (long long)contact->lost_node);
    const bool told = (contact->fast > 0 && !recorder->fast_warned) || (contact->lost > 0 && !recorder->lost_warned);
    recorder->fast_warned = contact->fast > 0;
    recorder->lost_warned = contact->lost > 0;
    if (told) log_write_messages(recorder->log);
}

static void serve_switch(Recorder *recorder, const Model *model, const State *state, double wall)
{
    const SenseSwitch value = signals_read_switch(recorder->switch_file);
    switch (value) {
    case SENSE_NONE:
        return;
    case SENSE_STOP:
        recorder->stop = recorder->stopped_by_user = true;
        break;
    case SENSE_PRINT:
        progress_print(&recorder->progress, model, state, wall);
        progress_finish_line(&recorder->progress);
        break;
    case SENSE_CHECKPOINT:
        recorder->want_checkpoint = true;
        break;
    case SENSE_STATE:
        recorder->want_states = true;
        break;
    case SENSE_UNKNOWN:
        break;
    }
    if (value == SENSE_UNKNOWN)
        log_write_event(recorder->log, state->clock, "%s holds no known switch (sw1 sw2 sw3 sw4): removed",
                        recorder->switch_file);
    else
        log_write_event(recorder->log, state->clock, "sense switch sw%d", (int)value);
}

/* One line for each sensor that fires in this cycle. */
static void watch_sensors(const Recorder *recorder, const Model *model, const State *state)
{
    for (int i = 0; i < model->sensor_count; i++)
        if (state->gas[model->sensor_airbag[i]].inflow_start == state->clock->time)
            log_write_event(recorder->log, state->clock, "the sensor of airbag %d fires", model->sensors[i].airbag_id);
}

/* One line for each seam and tie that has torn since the last cycle. */
static void watch_seams(Recorder *recorder, const Model *model, const State *state)
{
    for (int i = 0; recorder->seams_watched && i < model->seam_count; i++)
        if (state->seam_torn[i] >= recorder->seams_from && state->seam_torn[i] < state->clock->time)
            log_write_event(recorder->log, state->clock, "the seam between nodes %d and %d has torn",
                            model->node_id[model->seams[i].node[0]], model->node_id[model->seams[i].node[1]]);
    for (int i = 0; recorder->seams_watched && i < model->ties.count; i++)
        if (state->tie_broken[i] >= recorder->seams_from && state->tie_broken[i] < state->clock->time)
            log_write_event(recorder->log, state->clock, "the tied nodes at node %d have come apart",
                            model->node_id[model->ties.node[model->ties.ties[i].first_node]]);
    recorder->seams_from = state->clock->time;
    recorder->seams_watched = true;
}

/* A line when elements have eroded, and whenever there are twice as many. */
static void watch_erosion(Recorder *recorder, const Model *model, const State *state)
{
    const int64_t count = *state->eroded_count;
    if (recorder->next_eroded == 0) /* what had eroded before a restart is no news */
        recorder->next_eroded = count > 0 ? 2 * count : 1;
    if (count < recorder->next_eroded) return;
    recorder->next_eroded = 2 * count;
    int e = 0;
    while (e < model->element_count - 1 && !state->eroded[model->element_slot[e]]) e++;
    log_write_event(recorder->log, state->clock, "%lld element%s eroded so far, the first in the deck's order is %d",
                    (long long)count, count == 1 ? " has" : "s have", model->element_id[e]);
}

static bool recorder_due(void *user, const Model *model, const State *state, bool last)
{
    Recorder *recorder = user;
    const double wall = progress_now();
    if (model->seam_count + model->ties.count > 0) watch_seams(recorder, model, state);
    if (model->has_erosion) watch_erosion(recorder, model, state);
    recorder->asked = true;
    recorder->due = schedule_due(&recorder->plan, state->clock);
    recorder->want_checkpoint = recorder->want_checkpoint || schedule_checkpoint_due(&recorder->plan, state->clock);
    if (signals_stop_requested() && !recorder->stop) {
        recorder->stop = recorder->stopped_by_user = true;
        log_write_event(recorder->log, state->clock, "stopped by a signal");
    }
    if (wall >= recorder->next_look) {
        recorder->next_look = wall + look_interval;
        serve_switch(recorder, model, state, wall);
    }
    watch_energy(recorder, state);
    watch_fabric(recorder, model, state);
    if (model->sensor_count > 0) watch_sensors(recorder, model, state);
    progress_update(&recorder->progress, model, state, wall);
    return last || recorder->due || recorder->want_states || recorder->want_checkpoint || recorder->stop;
}

/* Writes the kinds of the mask; all are tried even if one fails. */
static int write_kinds(Recorder *recorder, unsigned kinds, const Model *model, const State *state, const StepView *view)
{
    static const struct {
        unsigned kind;
        int (*write)(Results *results, const Model *model, const State *state, const StepView *view);
    } writers[] = {
        {SCHEDULE_GLSTAT, results_write_glstat}, {SCHEDULE_ABSTAT, results_write_abstat},
        {SCHEDULE_NODOUT, results_write_nodout}, {SCHEDULE_RBDOUT, results_write_rbdout},
        {SCHEDULE_RCFORC, results_write_rcforc}, {SCHEDULE_RWFORC, results_write_rwforc},
        {SCHEDULE_MATSUM, results_write_matsum}, {SCHEDULE_STATES, results_write_state},
        {SCHEDULE_GCEOUT, results_write_gceout},
    };
    int failed = 0;
    for (size_t i = 0; i < sizeof writers / sizeof *writers; i++)
        if (kinds & writers[i].kind) failed |= writers[i].write(recorder->results, model, state, view);
    return failed ? -1 : 0;
}

static int recorder_emit(void *user, const Model *model, const State *state, const StepView *view, bool last)
{
    Recorder *recorder = user;
    unsigned kinds = recorder->due;
    watch_contact(recorder, state);
    /* The loop emits without asking when it has failed: that last good state is written in full. */
    if (last || recorder->stop || !recorder->asked) kinds |= schedule_kinds(&recorder->plan);
    if (recorder->want_states) kinds |= SCHEDULE_STATES;
    if (write_kinds(recorder, kinds, model, state, view)) recorder->write_failed = true;
    /* Only results that were due count in the state, so that a stop and a restart leave no trace in its bits. */
    if (recorder->due & SCHEDULE_STATES) recorder->state->clock->states_written++;
    schedule_advance(&recorder->plan, recorder->state->clock, recorder->due);
    recorder->last_time = state->clock->time;
    recorder->memory = memory_in_use();
    if (last || recorder->stop) progress_finish(&recorder->progress, model, state);
    recorder->due = 0;
    recorder->want_states = recorder->asked = false;
    return recorder->stop || recorder->write_failed ? 1 : 0;
}

int recorder_write_checkpoint(Recorder *recorder, const Model *model, const State *state)
{
    recorder->want_checkpoint = false;
    if (results_flush(recorder->results) ||
        checkpoint_write(recorder->checkpoint, model, state, recorder->diagnostics)) {
        recorder->write_failed = true;
        return -1;
    }
    recorder->checkpoint_cycle = state->clock->cycle;
    log_write_event(recorder->log, state->clock, "checkpoint %s", recorder->checkpoint);
    return 0;
}

static void recorder_completed(void *user, const Model *model, const State *state)
{
    Recorder *recorder = user;
    if (recorder->want_checkpoint || recorder->stop) recorder_write_checkpoint(recorder, model, state);
}

RunHooks recorder_hooks(Recorder *recorder)
{
    return (RunHooks){.user = recorder, .due = recorder_due, .emit = recorder_emit, .completed = recorder_completed};
}
