/* matsum: energies, mass and momentum of each part over time. */
#include "io/results_files.h"

const HistoryFormat results_matsum_format = {
    "matsum.csv", "time,part,internal_energy,kinetic_energy,hourglass_energy,mass,x_momentum,y_momentum,z_momentum",
    "matsum", " time ="};

static void write_legend(FILE *ascii, const Model *model)
{
    fprintf(ascii, "\n{BEGIN LEGEND}\n Entity #        Title\n");
    for (int p = 0; p < model->part_count; p++)
        fprintf(ascii, "%9d     %-70.70s\n", model->parts[p].id, model->parts[p].title);
    fprintf(ascii, "{END LEGEND}\n\n");
}

/* x-rbv .. z-rbv: mean velocity of the part, its momentum over its mass. */
static void write_ascii_part(FILE *ascii, const Part *part, double internal, double kinetic, double hourglass,
                             const double *momentum)
{
    const double mass = part->mass + part->point_mass;
    double q[3], v[3];
    for (int c = 0; c < 3; c++) {
        q[c] = history_clip(momentum[c]);
        v[c] = mass > 0 ? history_clip(momentum[c] / mass) : 0;
    }
    fprintf(ascii, part->id < 100000 ? " mat.#=%5d   " : " mat.#=%8d", part->id);
    fprintf(ascii, "          inten=%13.4E     kinen=%13.4E     eroded_ie=%13.4E     eroded_ke=%13.4E\n",
            history_clip(internal), history_clip(kinetic), 0.0, 0.0);
    fprintf(ascii, " x-mom=%13.4E     y-mom=%13.4E     z-mom=%13.4E\n", q[0], q[1], q[2]);
    fprintf(ascii, " x-rbv=%13.4E     y-rbv=%13.4E     z-rbv=%13.4E\n", v[0], v[1], v[2]);
    fprintf(ascii, "                         hgeng=%13.4E     +mass=%13.4E     eroded_he=%13.4E\n",
            history_clip(hourglass), 0.0, 0.0);
}

int results_write_matsum(Results *results, const Model *model, const State *state, const StepView *view)
{
    History *history = &results->history[HISTORY_MATSUM];
    double time = state->clock->time;
    if (model->part_count == 0) return 0;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    if (history->ascii.fresh) write_legend(history->ascii.stream, model);
    fprintf(history->ascii.stream, "\n\n time =%13.4E\n", time);
    for (int p = 0; p < model->part_count; p++) {
        const double *momentum = view->part_momentum + 3 * (ptrdiff_t)p;
        fprintf(history->csv.stream, "%.17g,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", time, model->parts[p].id,
                state->part_energy[p], view->part_kinetic[p], state->part_hourglass[p],
                model->parts[p].mass + model->parts[p].point_mass, momentum[0], momentum[1], momentum[2]);
        write_ascii_part(history->ascii.stream, &model->parts[p], state->part_energy[p], view->part_kinetic[p],
                         state->part_hourglass[p], momentum);
    }
    return history_commit(history, time);
}
