/* glstat: the energy ledger over time. */
#include <inttypes.h>

#include "io/results_files.h"

const HistoryFormat results_glstat_format = {
    "glstat.csv",
    "time,cycle,time_step,kinetic_energy,internal_energy,hourglass_energy,damping_energy,contact_energy,external_work,"
    "airbag_work,total_energy,energy_ratio,dt_element",
    "glstat", " dt of cycle"};

static void write_line(FILE *ascii, const char *name, double value)
{
    fprintf(ascii, " %s%14.5E\n", name, history_clip(value));
}

/* Mean velocity of the model: momentum over mass. */
static void mean_velocity(const Model *model, const StepView *view, double velocity[3])
{
    double mass = 0;
    velocity[0] = velocity[1] = velocity[2] = 0;
    for (int p = 0; p < model->part_count; p++) {
        mass += model->parts[p].mass + model->parts[p].point_mass;
        for (int c = 0; c < 3; c++) velocity[c] += view->part_momentum[3 * p + c];
    }
    for (int i = 0; i < model->point_mass_count; i++) {
        const PointMass *point = &model->point_masses[i];
        if (point->part >= 0) continue;
        mass += point->mass;
        for (int c = 0; c < 3; c++) velocity[c] += point->mass * view->v[3 * (ptrdiff_t)point->node + c];
    }
    for (int c = 0; c < 3 && mass > 0; c++) velocity[c] /= mass;
}

/* LS-DYNA has one external work; the gas's work on the walls is part of it. */
static void write_ascii(FILE *ascii, const Model *model, const State *state, const StepView *view, double total)
{
    const Energies *energy = state->energy;
    double velocity[3];
    mean_velocity(model, view, velocity);
    if (view->critical_element >= 0)
        fprintf(ascii, "\n\n dt of cycle%8" PRId64 " is controlled by shell %9d of part %9d\n\n", state->clock->cycle,
                model->element_id[view->critical_element],
                model->parts[model->element_part[view->critical_element]].id);
    else
        fprintf(ascii, "\n\n dt of cycle%8" PRId64 " is controlled by load curve\n\n", state->clock->cycle);
    write_line(ascii, "time...........................", state->clock->time);
    write_line(ascii, "time step......................", state->clock->step);
    write_line(ascii, "kinetic energy.................", energy->kinetic);
    write_line(ascii, "internal energy................", energy->internal);
    write_line(ascii, "hourglass energy ..............", energy->hourglass);
    write_line(ascii, "system damping energy..........", energy->damping);
    write_line(ascii, "sliding interface energy.......", energy->contact);
    write_line(ascii, "external work..................", energy->external_work + energy->airbag_work);
    write_line(ascii, "eroded kinetic energy..........", 0);
    write_line(ascii, "eroded internal energy.........", 0);
    write_line(ascii, "eroded hourglass energy........", 0);
    write_line(ascii, "total energy...................", total);
    write_line(ascii, "total energy / initial energy..", energy->ratio);
    write_line(ascii, "energy ratio w/o eroded energy.", energy->ratio);
    write_line(ascii, "global x velocity..............", velocity[0]);
    write_line(ascii, "global y velocity..............", velocity[1]);
    write_line(ascii, "global z velocity..............", velocity[2]);
}

int results_write_glstat(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_GLSTAT];
    const Energies *energy = state->energy;
    double total = energy->kinetic + energy->internal + energy->hourglass + energy->damping + energy->contact;
    int go = history_begin(history, state->clock->time, model->title);
    if (go <= 0) return go;
    fprintf(history->csv.stream,
            "%.17g,%" PRId64 ",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", state->clock->time,
            state->clock->cycle, state->clock->step, energy->kinetic, energy->internal, energy->hourglass,
            energy->damping, energy->contact, energy->external_work, energy->airbag_work, total, energy->ratio,
            view->element_step);
    write_ascii(history->ascii.stream, model, state, view, total);
    return history_commit(history, state->clock->time);
}
